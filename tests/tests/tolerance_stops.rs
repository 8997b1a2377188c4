//! `AX_DEV` where the path rests or changes its speed for other reasons: dwells and stops shorter than the kernel, override and feedhold
//! from outside. The contour is computed in this test, not taken from the program's own column.

use kontur_interpreter::record::SpeedLimit;
use kontur_kit::{from_polyline, largest};
use kontur_tests::{Run, machine, run, run_with_inputs};

/// Rounding of the sums over the kernel.
const SLACK_MM: f64 = 1e-9;

/// Largest component of the deviation of the set positions from the polyline in the XY plane.
fn off_polyline(run: &Run, corners: &[[f64; 2]]) -> f64 {
    let polyline: Vec<Vec<f64>> = corners.iter().map(|c| c.to_vec()).collect();
    let off = |p: &Vec<f64>| largest(&from_polyline(p, &polyline));
    run.set(2).iter().map(off).fold(0.0, f64::max)
}

/// The end of the motion before a stop is final when the motion after it is planned; that motion waits until the tolerance is kept, and
/// no longer than without the stop.
#[test]
fn stops_shorter_than_the_kernel() {
    let program = |slope: &str, guard: &str, stop: &str| {
        format!(
            "#SLOPE [TYPE={slope}]\n#VIB GUARD ON [{guard} AX_DEV=0.01]\nG01 X10 F3000\n{stop}\nG01 Y5\nM30\n"
        )
    };
    let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 5.0]];
    for slope in ["TRAPEZ", "SIN2", "HSC", "STEP"] {
        for guard in ["MODE=2 FREQ=20", "MODE=3 FREQ=8 DAMPING=0", "MODE=4 FREQ=30"] {
            let plain = run(&program(slope, guard, ""), &[]);
            for stop in ["G04 0.005", "G04 X0.03", "#TIME 0.001", "M00", "M01", "#FLUSH"] {
                let run = run(&program(slope, guard, stop), &[]);
                assert!(run.diagnostics.is_empty(), "{:?}", run.diagnostics);
                let off = off_polyline(&run, &corners);
                assert!(off <= 0.01 + SLACK_MM, "{slope} {guard} {stop}: {off}");
                let more = run.records.len().saturating_sub(plain.records.len());
                assert!(more <= 31, "{slope} {guard} {stop}: {more} cycles more");
            }
        }
    }
}

/// A change of override or a feedhold while the path speeds up on a curve: the speed that the tolerance allows there is also kept after
/// it.
#[test]
fn changes_of_speed_on_an_arc() {
    let (ratio, hold) = ("override_percent", "feedhold");
    let inputs: [Vec<(f64, &str, f64)>; 5] = [
        vec![(0.02, ratio, 50.0)],
        vec![(0.01, ratio, 99.0)],
        vec![(0.0, ratio, 30.0), (0.01, ratio, 31.0), (0.02, ratio, 100.0)],
        vec![(0.1, hold, 1.0), (0.4, hold, 0.0), (0.41, ratio, 99.0)],
        vec![(0.1, hold, 1.0), (0.11, hold, 0.0), (0.12, ratio, 99.0)],
    ];
    for slope in ["TRAPEZ", "SIN2", "HSC", "STEP"] {
        let program = format!(
            "#SLOPE [TYPE={slope}]\n#FILTER ON [ORDER=100 AX_DEV=0.05]\nG01 F12000\nG02 X20 Y0 I10 J0\nM30\n"
        );
        for input in &inputs {
            let run = run_with_inputs(machine("X,Y,Z.filter_fir.type=2"), &program, input);
            assert!(run.diagnostics.is_empty(), "{:?}", run.diagnostics);
            for p in run.set(2) {
                let (x, y) = (p[0] - 10.0, p[1]);
                let off = 1.0 - 10.0 / libm::hypot(x, y);
                let off = (off * x).abs().max((off * y).abs());
                // the ends of the half circle are not on it
                assert!(off <= 0.05 + SLACK_MM || y <= 0.0, "{slope} {input:?}: {off} at {p:?}");
            }
        }
    }
}

/// The trace names what limits the speed on an arc.
#[test]
fn the_reason_on_an_arc() {
    let program = "#VIB GUARD ON [MODE=2 FREQ=20 AX_DEV=0.01]\nG01 F6000\nG02 X20 Y0 I10 J0\nM30\n";
    let run = run(program, &[]);
    let top = run.records.iter().map(|r| r.path.v_mm_s).fold(0.0, f64::max);
    // about 1.2 s at 25 mm/s, at both ends of the arc as nearly as the search for their speed goes
    let held: Vec<_> = run.records.iter().filter(|r| r.path.v_mm_s > 0.99 * top).collect();
    assert!(held.len() > 1000, "{}", held.len());
    let by_stop = held.iter().filter(|r| r.path.limit != SpeedLimit::AxDev).count();
    assert!(by_stop < 10, "{by_stop} cycles before the stop");
}
