//! Measuring runs with a probe from the real-time inputs: G100 with its types, G106, G310, G101 and G102.
//!
//! Programs after the examples of the TF5200 programming manual (206171147, 206177803, 206185227, 206197003, 206208011),
//! with targets as printed there. The expected results are known beforehand: the points where a straight line meets the surface.

use kontur_kit::near;
use kontur_tests::{Run, linear_machine, run_with_inputs};

/// The output of `#MSG` in the program, in order.
fn said(run: &Run) -> Vec<String> {
    let own = run.diagnostics.iter().filter(|d| d.id.to_string() == "K-0081");
    own.map(|d| d.text.clone()).collect()
}

fn end(run: &Run, axis: usize) -> f64 {
    run.records.last().unwrap().axes[axis].ipo
}

/// From X5 Y0 to X10 Y10: a surface at X8 is met at Y6.
const TYPE_1: &str = "%MEAS_RUN\n#SLOPE [TYPE=STEP]\nN10 G90 G00 X0 Y0 Z0\nN20 X5\nN30 G100 X10 Y10 F500\n\
    #MSG [\"%.4f %.4f %d %.4f %.4f\", V.A.MESS.X, V.A.MESS.Y, V.A.MERF.X, V.A.MOFFS.X, V.A.MOFFS.Y]\n";

#[test]
fn the_surface_is_measured_and_the_rest_of_the_run_is_dropped() {
    let program = format!("{TYPE_1}N40 G01 X7\nN50 M30\n");
    let run = run_with_inputs(linear_machine(&[]), &program, &[(0.0, "X_probe_mm", 8.0)]);
    assert_eq!(said(&run), ["8.0000 6.0000 1 -2.0000 -4.0000"]);
    assert!(run.errors().is_empty() && !run.totals.aborted);
    let of_run = |line: u32| run.records.iter().filter(move |r| r.line == line);
    // every set position of the run lies on its line, and it ends soon after the surface: by the lag and the braking distance, not at the
    // target
    for r in of_run(5) {
        near(r.axes[1].ipo, 2.0 * (r.axes[0].ipo - 5.0), 1e-9);
    }
    let rest = of_run(5).next_back().unwrap();
    let (x, y) = (rest.axes[0].ipo, rest.axes[1].ipo);
    assert!(x > 8.0 && x < 8.2, "{x}");
    // N40 continues from there: Y stays, X goes back
    near(end(&run, 0), 7.0, 1e-9);
    near(end(&run, 1), y, 1e-9);
}

/// A signal at a given time: braking from v = 500/60 mm/s takes v^2 / 2a, where a is what the steeper axis (2 / sqrt 5 of the distance)
/// reaches with 1000 mm/s2.
#[test]
fn a_signal_at_a_time_brakes_the_path_from_the_next_cycle_on() {
    let program = format!("{TYPE_1}N50 M30\n");
    let run =
        run_with_inputs(linear_machine(&[]), &program, &[(0.5, "probe", 1.0), (0.6, "probe", 0.0)]);
    let v = 500.0 / 60.0;
    let at = &run.records[(0.5 / run.cycle_s).round() as usize];
    near(at.path.v_mm_s, v, 1e-9);
    let s = run.records.last().unwrap().path.s_mm;
    let a = 1000.0 * 5.0_f64.sqrt() / 2.0;
    near(s - at.path.s_mm, v * v / (2.0 * a), 1e-9);
    // the latched values are the actual positions of that cycle
    let latched = format!("{:.4} {:.4} 1", at.axes[0].act, at.axes[1].act);
    assert!(said(&run)[0].starts_with(&latched), "{:?}, {latched}", said(&run));
}

/// Type 3: with G106 the path continues to the target, without G106 it stops.
#[test]
fn through_to_the_target() {
    let of = |g106: &str| {
        let run = TYPE_1.replace("F500", &format!("F500 {g106}"));
        let program = format!("#MEAS [TYPE=3]\n{run}N50 M30\n");
        run_with_inputs(linear_machine(&[]), &program, &[(0.0, "Y_probe_mm", 6.0)])
    };
    let (through, stopped) = (of("G106"), of(""));
    assert_eq!(said(&through), said(&stopped));
    assert_eq!(said(&through), ["8.0000 6.0000 1 -2.0000 -4.0000"]);
    near(end(&through, 0), 10.0, 1e-9);
    // without a drop in speed at the signal
    let slow = through
        .records
        .iter()
        .filter(|r| r.line == 6 && r.axes[0].ipo > 6.0 && r.axes[0].ipo < 9.0);
    assert!(slow.into_iter().all(|r| (r.path.v_mm_s - 500.0 / 60.0).abs() < 1e-9));
    assert!(end(&stopped, 0) < 8.2);
}
