//! The sample programs: those that must run are clean, those that must fail fail as their first line says.

use kontur_interpreter::diag::Id;
use kontur_tests::{machine, programs, run, run_on, sample_machine};

fn text(name: &str) -> String {
    std::fs::read_to_string(programs().join(name)).unwrap()
}

#[test]
fn sample_programs_run_clean() {
    for name in [
        "square_corner",
        "feedforward_lag",
        "arc_and_helix",
        "parametric_pocket",
        "independent_axes",
        "inputs_of_axes",
        "feedhold_and_override",
    ] {
        let run = run(&text(&format!("{name}.nc")), &[]);
        assert!(!run.totals.aborted, "{name}: {:?}", run.diagnostics);
        assert!(run.ids().is_empty(), "{name}: {:?}", run.diagnostics);
    }
}

/// HSC mean of order 20: in the first pass the corners are cut and the delay is 10 ms, in the second set = ipo.
#[test]
fn hsc_square() {
    let run = run_on(sample_machine("xyz_hsc", &[]), &text("square_corner_hsc.nc"));
    assert!(!run.totals.aborted, "{:?}", run.diagnostics);
    assert_eq!(run.totals.filter_delay_cycles[..2], [10.0, 10.0]);
    let pass = |lines: std::ops::RangeInclusive<u32>| {
        run.records.iter().filter(move |r| lines.contains(&r.line))
    };
    let cut = pass(6..=9).map(|r| r.contour_err_mm).fold(0.0, f64::max);
    assert!(cut > 1e-3, "{cut}");
    assert!(pass(11..=14).all(|r| r.axes[0].set.to_bits() == r.axes[0].ipo.to_bits()));
}

/// v / Kv = 2 mm, none, a fifth, 2 mm again at the last cycle of constant speed.
#[test]
fn feedforward_lag() {
    let run = run(&text("feedforward_lag.nc"), &[]);
    for (block, want) in [(30, 2.0), (50, 0.0), (70, 0.4), (90, 2.0)] {
        let last = run
            .records
            .iter()
            .rfind(|r| r.block == Some(block) && (r.axes[0].vel.abs() - 100.0).abs() < 1e-6);
        let lag = last.unwrap().axes[0].lag.abs();
        assert!((lag - want).abs() < 2e-3, "N{block}: {lag} mm, {want} expected");
    }
}

#[test]
fn programs_that_must_fail() {
    for (name, id, line) in [
        ("22060_filter_and_guard", 22060, 7),
        ("22062_guard_mode", 22062, 4),
        ("50820_guard_damping", 50820, 4),
    ] {
        let run = run(&text(&format!("fail/{name}.nc")), &[]);
        assert!(run.totals.aborted && run.records.is_empty());
        let found = run.diagnostics.iter().find(|d| d.id == Id::Vendor(id));
        assert_eq!(found.unwrap().source.as_ref().unwrap().line, line, "{name}");
    }
    let ten = run(&text("fail/ten_mistakes.nc"), &[]);
    let places: Vec<String> = ten
        .diagnostics
        .iter()
        .map(|d| {
            let at = d.source.as_ref().unwrap();
            format!("{} {}:{}", d.id, at.line, at.column)
        })
        .collect();
    let expected = [
        "20008 4:9",
        "20131 6:5",
        "20509 7:5",
        "20203 8:11",
        "K-0002 9:15",
        "K-0012 10:7",
        "21024 11:15",
        "K-0014 12:9",
        "22062 13:21",
        "K-0001 14:13",
    ];
    assert_eq!(places, expected);
    let ids: Vec<Id> = run(&text("fail/syntax.nc"), &[]).diagnostics.iter().map(|d| d.id).collect();
    assert_eq!(ids, [Id::Vendor(20131), Id::Vendor(20203), Id::Vendor(20509), Id::Kontur(2)]);
    let slow = [
        "X.getriebe[0].kv=1000",
        "X.getriebe[0].window=10",
        "X.getriebe[0].position_settling_time=20000",
    ];
    let late = run_on(machine(&slow), &text("fail/70082_exact_stop.nc"));
    assert!(late.totals.aborted && late.ids() == [70082]);
    assert_eq!(late.records.last().unwrap().axes[0].ipo, 50.0);
}

/// Twenty thousand short blocks: no message, no corner slower than the half circles between the rows allow, and the
/// programmed feed wherever curvature allows it.
#[test]
fn surface_scan() {
    let run = run(&text("surface_scan.nc"), &[]);
    assert!(!run.totals.aborted && run.ids().is_empty(), "{:?}", run.diagnostics);
    assert!(run.totals.blocks >= 20_000);
    let inside = &run.records[100..run.records.len() - 100];
    let slowest = inside.iter().map(|r| r.path.v_mm_s).fold(f64::INFINITY, f64::min);
    // half circles of 0.25 mm radius at 3500 mm/s2 allow 29.6 mm/s, their chords of 7.5 degrees 26.7 mm/s
    assert!(slowest > 20.0, "{slowest} mm/s");
    let at_feed = inside.iter().filter(|r| r.path.v_mm_s > 49.999).count();
    assert!(at_feed as f64 > 0.9 * inside.len() as f64, "{at_feed} of {}", inside.len());
}

/// 10 ms of dwell at 1 ms are ten rows of the dwell's own line, also in front of the first motion.
#[test]
fn the_cycles_of_a_dwell_name_its_line() {
    let run = run("%P\nG04 0.01\nG90 G01 X1 F6000\nG04 X0.01\n#TIME 0.01\nY1\nM30\n", &[]);
    for line in [2, 4, 5] {
        let rows: Vec<_> = run.records.iter().filter(|r| r.line == line).collect();
        assert_eq!(rows.len(), 10, "line {line}");
        assert!(rows.iter().all(|r| r.path.v_mm_s.abs() < 1e-9), "line {line}");
    }
}
