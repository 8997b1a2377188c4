//! The main use: the square program end to end, judged only by its trace and its geometry.

use kontur_kit::{from_polyline, largest};
use kontur_tests::command::Folder;
use kontur_tests::{machine, programs, residual_mm, run};

fn square() -> Vec<Vec<f64>> {
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]].map(|p| p.to_vec()).to_vec()
}

fn deviation(point: &[f64]) -> f64 {
    largest(&from_polyline(point, &square()))
}

/// First pass within AX_DEV, second pass outside, third pass `set` = `ipo` bit for bit; no jump between the passes.
#[test]
fn three_passes() {
    let text = std::fs::read_to_string(programs().join("square_corner.nc")).unwrap();
    let line = |n: &str| text.lines().position(|l| l.starts_with(n)).unwrap() as u32 + 1;
    let run = run(&text, &[]);
    assert!(!run.totals.aborted, "{:?}", run.diagnostics);
    let pass = |from: &str, to: &str| {
        let lines = line(from)..=line(to);
        run.records.iter().filter(move |r| lines.contains(&r.line))
    };
    let dev =
        |r: &kontur_interpreter::record::CycleRecord| deviation(&[r.axes[0].set, r.axes[1].set]);
    assert!(pass("N30", "N60").map(dev).fold(0.0, f64::max) <= 0.01);
    assert!(pass("N80", "N110").map(dev).fold(0.0, f64::max) > 0.01);
    for r in pass("N130", "N160") {
        for a in &r.axes[..2] {
            assert_eq!(a.set.to_bits(), a.ipo.to_bits());
            assert_eq!(a.dev, 0.0);
        }
    }
    // the columns of kontur agree with the geometry
    for r in &run.records {
        let e = from_polyline(&[r.axes[0].set, r.axes[1].set], &square());
        assert!((r.contour_err_mm - libm::hypot(e[0], e[1])).abs() < 1e-9, "{r:?}");
    }
    for axis in 0..2 {
        let step = |f: &dyn Fn(&kontur_interpreter::record::AxisRecord) -> f64| {
            run.axis(axis, f).windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max)
        };
        assert!(step(&|a| a.set) <= step(&|a| a.ipo) + 1e-12);
    }
}

/// A plant at the set frequency keeps less than 0.1 % of the vibration of the unguarded run. Conformance: V001.
#[test]
fn residual_vibration() {
    for mode in 1..=4 {
        for freq in [7.3, 20.0, 40.0, 60.0] {
            let end = |guard: &str| {
                let run = run(&format!("%R\nG90 G01 F9000\n{guard}\nX40\nM30\n"), &[]);
                let set = run.axis(0, |a| a.set);
                assert_eq!(*set.last().unwrap(), 40.0);
                residual_mm(&set, run.cycle_s, freq, 0.1)
            };
            let on = end(&format!("#VIB GUARD ON [MODE={mode} FREQ={freq} DAMPING=0.1]"));
            let off = end("#VIB GUARD OFF");
            assert!(on < 1e-3 * off.max(1e-3), "mode {mode}, {freq} Hz: {on} of {off} mm");
        }
    }
}

/// The same simulation gives the same bits again, also after another program.
#[test]
fn same_bits_again() {
    let text = std::fs::read_to_string(programs().join("square_corner.nc")).unwrap();
    let first = run(&text, &[]);
    let other = run("%O\nG90 G01 X50 Y-20 F3000\nG02 X10 Y0 R40\nM30\n", &[]);
    assert!(!other.records.is_empty());
    assert_eq!(first.records, run(&text, &[]).records);
    // a value from the list and the same value from a setting
    let (plain, _) = machine(&[]);
    let kv = plain.axes[0].raw("getriebe[0].kv").unwrap();
    let set = run(&text, &format!("X.getriebe[0].kv={kv}"));
    assert_eq!(first.records, set.records);
}

/// The trace of the release build, byte for byte, from whichever build this test is part of.
///
/// `tests/golden/square_corner.csv` is written by
/// `cargo run --release -- run programs/square_corner.nc -o tests/golden/square_corner.csv --signals time,ipo,set`.
#[test]
fn same_bytes_as_the_release_build() {
    let (folder, program) = (Folder::new(&[]), programs().join("square_corner.nc"));
    let words = ["run", program.to_str().unwrap(), "--signals", "time,ipo,set", "-o", "@t.csv"];
    assert_eq!(folder.call(&words).exit, kontur::Exit::Finished);
    let golden = programs().join("../tests/golden/square_corner.csv");
    assert!(
        folder.read("t.csv") == std::fs::read_to_string(golden).unwrap(),
        "`kontur diff` of the two shows where they differ"
    );
}
