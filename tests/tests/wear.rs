//! Online tool compensation (`#OTC`): the effect of the wear on the axis positions, and measuring type 7 (a fixed stop shows in the lag).
//!
//! Programs after the examples of TF5200 online tool compensation (213664139). The expected offsets come from the direction of the
//! programmed contour and from the distance in the trace itself.

use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::machine::Machine;
use kontur_tests::{Run, machine, run_with_inputs, suite_machine};

/// The machine with a tool list: D1 is a grinding wheel of radius 2.
fn grinding() -> (Machine, Vec<Diagnostic>) {
    suite_machine("grinding", &[])
}

/// Additional positions of X, Y and Z in the middle of a line; its end belongs to the corner.
fn added(run: &Run, line: u32) -> [f64; 3] {
    let records: Vec<_> = run.of_line(line).collect();
    let record = records[records.len() / 2];
    [0, 1, 2].map(|axis| record.axes[axis].add)
}

/// Around a square, counter-clockwise with the wheel outside, or clockwise with G41.
fn square(otc: &str, side: &str) -> String {
    let y = if side == "G42" { "X102\nY100\nX2\nY0" } else { "Y100\nX102\nY0\nX2" };
    format!(
        "G26 D1 F6000 X-20\n{otc}\nG138 {side} G01 X2 Y0\n{y}\nG40 X-20 Y-5\n#OTC OFF\nG04 0.2\nM30\n"
    )
}

#[test]
fn wear_by_the_way_grows_with_it() {
    // 1e5 units of 0.1 um per metre are 10 mm per metre
    let text = square("#OTC ON [RADIUS CONT WEAR_CONST=100000]", "G42");
    let run = run_with_inputs(grinding(), &text, &[]);
    let start = run.of_line(3).next_back().unwrap().path.s_mm;
    for line in 4..=7 {
        let records: Vec<_> = run.of_line(line).collect();
        let middle = records[records.len() / 2];
        let offset: f64 = middle.axes[..3].iter().map(|a| a.add * a.add).sum::<f64>().sqrt();
        let wear = (middle.path.s_mm - start) * 0.01;
        // the cycle in which a block begins may count as part of either block
        assert!((offset - wear).abs() < 0.01 * 0.11, "{offset} instead of {wear}");
    }
    // the tool list has 1 um per metre; DISC omits it
    let listed = run_with_inputs(grinding(), &square("#OTC ON [RADIUS CONT]", "G42"), &[]);
    // about 350 mm to the middle of the last side
    let [x, ..] = added(&listed, 7);
    assert!((x - 0.35e-3).abs() < 0.02e-3, "{x}");
    let none = run_with_inputs(grinding(), &square("#OTC ON [RADIUS DISC]", "G42"), &[]);
    assert!(none.records.iter().all(|r| r.axes[..3].iter().all(|a| a.add == 0.0)));
}

#[test]
fn automatic_is_the_sum() {
    let text = square("#OTC ON [RADIUS AUTO WEAR_CONST=100000]", "G42");
    let both = run_with_inputs(grinding(), &text, &[(0.0, "wear_mm", 0.5)]);
    let text = text.replace("AUTO", "CONT");
    let way = run_with_inputs(grinding(), &text, &[(0.0, "wear_mm", 0.5)]);
    assert!((added(&both, 7)[0] - added(&way, 7)[0] - 0.5).abs() < 1e-9);
}

#[test]
fn a_change_is_followed_within_the_acceleration_of_the_axis() {
    for percent in [100.0, 5.0] {
        let text = square(&format!("#OTC ON [RADIUS DISC ACC_WEIGHT={percent}]"), "G42");
        let inputs = [(0.0, "wear_mm", 0.5), (1.5, "wear_mm", -0.4), (2.7, "wear_mm", 1.0)];
        let (built, warnings) = grinding();
        let limit = built.axes[0].dynamics().a_max_mm_s2 * percent / 100.0;
        let run = run_with_inputs((built, warnings), &text, &inputs);
        let t = run.cycle_s;
        for axis in 0..2 {
            let x: Vec<f64> = run.records.iter().map(|r| r.axes[axis].add).collect();
            for w in x.windows(3) {
                let a = (w[2] - 2.0 * w[1] + w[0]) / (t * t);
                assert!(a.abs() <= limit * (1.0 + 1e-6) + 1e-6, "{a} of {limit}");
            }
        }
    }
}

/// The built-in machine whose X moves to a fixed stop: 2 mm of lag.
fn stopping(more: &[&str]) -> (Machine, Vec<Diagnostic>) {
    let mut settings = vec!["X,Y.kenngr.messachse=1"];
    settings.extend(more);
    machine(&settings)
}

const STOP: [&str; 2] =
    ["X.kenngr.meas_signal_fixed_stop=1", "X.kenngr.fixed_stop_pos_lag_limit=20000"];

#[test]
fn a_fixed_stop_ends_the_run() {
    let text = "#MEAS MODE [7]\nG100 X50 F1200\nG01 Z[V.A.MERF.X]\nM30\n";
    // a force that the drive cannot overcome, throughout the run
    let force = [(1.0, "X_force_mm_s2", -30_000.0), (1.1, "X_force_mm_s2", 0.0)];
    let run = run_with_inputs(stopping(&STOP), text, &force);
    let at = run.records.iter().position(|r| r.axes[0].lag.abs() > 2.0).unwrap();
    assert!(run.records[at - 1].axes[0].lag.abs() <= 2.0);
    // before the stop the path is driven as programmed, after it there is only the braking distance
    let (here, rest) = (&run.records[at], run.records.last().unwrap());
    assert!((here.path.v_mm_s - 20.0).abs() < 1e-9);
    assert!(rest.axes[0].ipo > here.axes[0].ipo && rest.axes[0].ipo < here.axes[0].ipo + 2.0);
    assert!((rest.axes[2].ipo - 1.0).abs() < 1e-9, "the signal is known to the program");
    // the same without the force, with a lag that the run never reaches
    for (settings, inputs) in [
        (&STOP[..], &[][..]),
        (&["X.kenngr.measure.fixed_stop_detect.pos_lag_limit=1000000"][..], &force[..]),
    ] {
        let all: Vec<&str> = STOP.iter().chain(settings).copied().collect();
        let run = run_with_inputs(stopping(&all), text, inputs);
        assert!((run.records.last().unwrap().axes[0].ipo - 50.0).abs() < 1e-9);
        assert!(run.records.last().unwrap().axes[2].ipo.abs() < 1e-9);
    }
    let refused = run_with_inputs(stopping(&[]), text, &[]);
    assert_eq!(refused.said(), ["50059"]);
}
