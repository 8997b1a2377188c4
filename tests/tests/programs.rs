//! The sample programs: those that must run give no messages, those that must fail fail as stated in their first line.

use kontur::Exit;
use kontur_interpreter::diag::{Condition, Diagnostic, Id};
use kontur_tests::command::{Folder, run_line};
use kontur_tests::{Run, machine, programs, run, run_on, sample_machine};
use std::ops::RangeInclusive;

fn text(name: &str) -> String {
    std::fs::read_to_string(programs().join(name)).unwrap()
}

#[test]
fn sample_programs_run_clean() {
    let names = "square_corner feedforward_lag arc_and_helix parametric_pocket independent_axes inputs_of_axes \
                 feedhold_and_override slopes late_braking corner_rounding";
    for name in names.split(' ') {
        let run = run(&text(&format!("{name}.nc")), &[]);
        assert!(!run.totals.aborted, "{name}: {:?}", run.diagnostics);
        assert!(run.ids().is_empty(), "{name}: {:?}", run.diagnostics);
    }
}

/// HSC mean of order 20: in the first pass the corners are cut and the delay is 10 ms, in the second pass set = ipo.
#[test]
fn hsc_square() {
    let run = run_on(sample_machine("xyz_hsc", &[]), &text("square_corner_hsc.nc"));
    assert!(!run.totals.aborted, "{:?}", run.diagnostics);
    assert_eq!(run.totals.filter_delay_cycles[..2], [10.0, 10.0]);
    let pass =
        |lines: RangeInclusive<u32>| run.records.iter().filter(move |r| lines.contains(&r.line));
    let cut = pass(6..=9).map(|r| r.contour_err_mm).fold(0.0, f64::max);
    assert!(cut > 1e-3, "{cut}");
    assert!(pass(11..=14).count() > 100);
    assert!(pass(11..=14).all(|r| r.axes[0].set.to_bits() == r.axes[0].ipo.to_bits()));
}

/// Time of motion in s over the lines of a program, in whole cycles.
fn moving_s(run: &Run, lines: &RangeInclusive<u32>) -> f64 {
    let way: Vec<f64> =
        run.records.iter().filter(|r| lines.contains(&r.line)).map(|r| r.path.s_mm).collect();
    let end = way.last().unwrap() - 1e-9;
    // and the cycle of arrival
    (way.iter().filter(|s| **s < end).count() + 1) as f64 * run.cycle_s
}

/// `L/v + v/a`, and one more ramp time if there are ramps; over two blocks, of which the first is too short for its feed, the time is the
/// same.
#[test]
fn slopes() {
    let (a, ramp_s, v) = (3500.0, 0.03, 150.0);
    let one = 20.0 / v + v / a + ramp_s;
    for (profile, want) in [(0, one - ramp_s), (1, one), (2, one), (3, one)] {
        let setting = format!("channel.prog_start.slope.profile={profile}");
        let run = run(&text("slopes.nc"), &setting);
        for lines in [10..=10, 12..=13] {
            let is = moving_s(&run, &lines);
            assert!(
                is >= want - 1e-9 && is < want + 2.0 * run.cycle_s,
                "slope {profile}, lines {lines:?}: {is} s, {want} s expected"
            );
        }
    }
}

/// Every sample program has a row with a command that names it.
#[test]
fn every_program_is_listed() {
    let list = text("README.md");
    for folder in ["", "fail/"] {
        for file in std::fs::read_dir(programs().join(folder)).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_none_or(|e| e != "nc") {
                continue;
            }
            let name = format!("{folder}{}", path.file_name().unwrap().to_str().unwrap());
            let row = list.lines().find(|l| l.starts_with(&format!("| `{name}` |")));
            let row = row.unwrap_or_else(|| panic!("{name} has no row"));
            let mut code = row.split('`').skip(1).step_by(2);
            let named =
                |c: &str| c.starts_with("kontur ") && c.contains(&format!("programs/{name}"));
            assert!(code.any(named), "{name} has no command");
        }
    }
}

/// Every command of the list as written: those of `fail/` and `exact_stop_timeout.nc` end with an error, the others finish. The sweep
/// runs in `figures.rs`.
#[test]
fn every_listed_command_runs() {
    let folder = tempfile::tempdir().unwrap();
    let list = text("README.md");
    let rows = list.lines().filter(|l| l.starts_with("| "));
    let code = rows.flat_map(|row| row.split('`').skip(1).step_by(2));
    let listed: Vec<&str> = code.filter(|c| c.starts_with("kontur ")).collect();
    assert!(listed.len() >= 27, "{listed:?}");
    for line in listed.into_iter().filter(|c| !c.starts_with("kontur sweep ")) {
        let outcome = run_line(line, folder.path());
        let fails = line.contains("programs/fail/") || line.contains("exact_stop_timeout");
        let want = if fails { Exit::Aborted } else { Exit::Finished };
        assert_eq!(outcome.exit, want, "{line}\n{}", outcome.err);
    }
}

/// The lessons: every program has its commands, and every command runs.
#[test]
fn every_command_of_the_lessons_runs() {
    let folder = tempfile::tempdir().unwrap();
    let list = text("lessons/README.md");
    let code: Vec<&str> = list.split('`').skip(1).step_by(2).collect();
    let commands: Vec<&str> =
        code.into_iter().filter(|c| c.starts_with("kontur ") && c.contains(".nc")).collect();
    let mut programs_found = 0;
    for file in std::fs::read_dir(programs().join("lessons")).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_some_and(|e| e == "nc") {
            let name = path.file_name().unwrap().to_str().unwrap();
            let of = commands.iter().filter(|c| c.contains(&format!("programs/lessons/{name}")));
            assert!(of.count() >= 2, "{name}: a command and a picture");
            programs_found += 1;
        }
    }
    assert_eq!(programs_found, 8);
    for line in commands {
        let outcome = run_line(line, folder.path());
        assert_eq!(outcome.exit, Exit::Finished, "{line}\n{}", outcome.err);
    }
}

/// The exercises of the lessons: the results of their formulas are what happens.
#[test]
fn the_exercises_have_their_answers() {
    let folder = Folder::new(&[]);
    let lesson = |name: &str, replace: &[(&str, &str)], more: &[&str]| -> serde_json::Value {
        let mut program = text(&format!("lessons/{name}.nc"));
        for (what, by) in replace {
            assert!(program.contains(what));
            program = program.replace(what, by);
        }
        std::fs::write(folder.path("part.nc"), program).unwrap();
        folder.summary(more)
    };
    let number = |s: &serde_json::Value, key: &str| s[key].as_f64().unwrap();
    let path_s = |s: &serde_json::Value| number(s, "duration_s") - number(s, "arrival_s");
    let near = |is: f64, want: f64, by: f64| assert!((is - want).abs() <= by, "{is}, not {want}");

    near(path_s(&lesson("1_one_move", &[("F6000", "F15066")], &[])), 0.5, 1.5e-3);
    near(path_s(&lesson("1_one_move", &[], &[])), 1.0586, 1.5e-3);

    let slope = |profile: &str| {
        let set = format!("channel.prog_start.slope.profile={profile}");
        path_s(&lesson("2_slopes", &[], &["--set", &set]))
    };
    near(slope("1") - slope("0"), 0.030, 1.5e-3);

    // path length and another column of a run
    let trace =
        |name: &str, replace: &[(&str, &str)], more: &[&str], column: &str| -> Vec<(f64, f64)> {
            lesson(name, replace, &[more, &["-o", "@trace.csv"]].concat());
            let trace = folder.table("trace.csv");
            trace.numbers("s_mm").into_iter().zip(trace.numbers(column)).collect()
        };
    let slowest = |name: &str, replace: &[(&str, &str)]| -> f64 {
        let rows = trace(name, replace, &[], "v_mm_s").into_iter();
        let near = rows.filter(|(s, _)| (15.0..25.0).contains(s));
        near.map(|(_, v)| v).fold(f64::INFINITY, f64::min)
    };
    // 10.08 degrees are passed at 20 mm/s
    let (x, y) =
        (20.0 + 20.0 * libm::cos(10.08_f64.to_radians()), 20.0 * libm::sin(10.08_f64.to_radians()));
    let turned = format!("X{x:.7} Y{y:.7}");
    near(slowest("3_corner", &[("N30 Y20", &turned)]), 20.0, 0.2);
    near(slowest("4_rounding", &[("V.E.DEV", "0.163")]), 30.0, 0.1);

    // the feed is kept up to 2.005 degrees
    let circle = |step: &str| path_s(&lesson("5_chords", &[("V.E.STEP", step)], &[]));
    near(circle("2"), circle("1"), 1.5e-3);
    assert!(circle("2.1") > circle("2") + 5e-3);

    // in the middle of that distance, at a constant speed
    let lag = |kv: &str| -> f64 {
        let set = format!("X.getriebe[0].kv={kv}");
        let rows = trace("6_lag", &[], &["--set", &set], "X_lag_mm");
        rows.iter().find(|(s, _)| *s > 60.0).unwrap().1
    };
    near(lag("20000"), 0.5, 1e-3);
    near(lag("5000"), 2.0, 1e-3);

    let error = |hz: &str| {
        lesson("7_guard", &[("V.E.HZ", hz)], &[])["max_contour_error"]["mm"].as_f64().unwrap()
    };
    assert!(error("47") > 0.01 && error("48") < 0.01 && error("49") < 0.01);

    let waits = lesson("8_times", &[], &[]);
    let flows = lesson("8_times", &[("N60 G04 0.1\n", ""), ("G60 ", "G01 ")], &[]);
    near(number(&waits, "duration_s") - number(&flows, "duration_s"), 1.14, 5e-3);
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
    let place = |d: &Diagnostic| {
        let at = d.source.as_ref().unwrap();
        format!("{}@{}:{}", d.id, at.line, at.column)
    };
    let ten = run(&text("fail/ten_mistakes.nc"), &[]).diagnostics;
    assert_eq!(
        ten.iter().map(place).collect::<Vec<_>>().join(" "),
        "20008@4:9 20131@6:5 20509@7:5 20203@8:11 K-0002@9:15 20925@10:7 21024@11:15 K-0014@12:9 22062@13:21 K-0001@14:13"
    );
    let ids: Vec<Id> = run(&text("fail/syntax.nc"), &[]).diagnostics.iter().map(|d| d.id).collect();
    assert_eq!(
        ids,
        [Condition::GUnknown, Condition::AxisTwice, Condition::CommandUnknown, Condition::Syntax]
    );
    let slow = [
        "X.getriebe[0].kv=1000",
        "X.getriebe[0].window=10",
        "X.getriebe[0].position_settling_time=20000",
    ];
    let late = run_on(machine(&slow), &text("fail/70082_exact_stop.nc"));
    assert!(late.totals.aborted && late.ids() == [70082]);
    assert_eq!(late.records.last().unwrap().axes[0].ipo, 50.0);
}

/// Twenty thousand short blocks: no message, no corner slower than the half circles between the rows allow, and the programmed feed
/// wherever the curvature allows it.
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

/// 10 ms of dwell at 1 ms give ten rows of the line of the dwell, also before the first motion.
#[test]
fn the_cycles_of_a_dwell_name_its_line() {
    let run = run("%P\nG04 0.01\nG90 G01 X1 F6000\nG04 X0.01\n#TIME 0.01\nY1\nM30\n", &[]);
    for line in [2, 4, 5] {
        let rows: Vec<_> = run.of_line(line).collect();
        assert_eq!(rows.len(), 10, "line {line}");
        assert!(rows.iter().all(|r| r.path.v_mm_s.abs() < 1e-9), "line {line}");
    }
}
