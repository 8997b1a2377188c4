//! Override, additional interface, force and encoder offset from time-stamped inputs, in runs of programs.

use kontur_kit::near;
use kontur_tests::command::{Folder, command};
use kontur_tests::{Run, machine, run_with_inputs};

fn x_at(run: &Run, time_s: f64) -> f64 {
    let k = (time_s / run.cycle_s).round() as usize;
    run.records[k.min(run.records.len() - 1)].axes[0].ipo
}

/// The additional interface with the settings after `filter[0]`, and a step of 1 mm in cycle 10.
fn additional(filter: &str) -> Run {
    let prefix = "X.lr_param.add_interface";
    let settings = format!("{prefix}.enable=1; {prefix}.filter[0]: {filter}");
    run_with_inputs(machine(&settings), "%P\nG04 1\nM30\n", &[(0.01, "X_add_mm", 1.0)])
}

/// PT1 of 10 ms: `1 - p^n / (1 + g)` with `g = tan(T / 2 tau)`, `p = (1 - g) / (1 + g)`. Conformance: A057.
#[test]
fn additional_pt1() {
    let run = additional("enable=1, order=1, type=PT1, time_constant=10000, share_percent=100");
    let g = libm::tan(0.05);
    let p = (1.0 - g) / (1.0 + g);
    for (k, x) in run.axis(0, |a| a.add).into_iter().enumerate().skip(10) {
        near(x, 1.0 - libm::pow(p, (k - 10) as f64) / (1.0 + g), 1e-9);
    }
    assert!(run.said().is_empty());
}

/// The axis filter and the filter of the interface each act on their own part.
#[test]
fn both_filters_add_up() {
    let delay = "enable=1, order=1, type=TIME_DELAY, time_constant";
    let settings = format!(
        "X.filter[0]: {delay}=3000; X.lr_param.add_interface.enable=1; X.lr_param.add_interface.filter[0]: {delay}=5000"
    );
    let inputs = [(0.1, "X_add_mm", 0.25), (0.3, "X_add_mm", -0.5)];
    let run = run_with_inputs(machine(&settings), "%P\nG90 G01 X50 F6000\nM30\n", &inputs);
    let (ipo, set) = (run.axis(0, |a| a.ipo), run.axis(0, |a| a.set));
    let (added, reference) = (run.axis(0, |a| a.add), run.axis(0, |a| a.reference));
    for k in 8..run.records.len() {
        assert_eq!(set[k].to_bits(), ipo[k - 3].to_bits());
        let input = if k < 105 {
            0.0
        } else if k < 305 {
            0.25
        } else {
            -0.5
        };
        assert_eq!(added[k].to_bits(), f64::to_bits(input));
    }
    // the controller receives the sum after its buffer
    let delay = (0..10).find(|d| {
        (10..run.records.len()).all(|k| (reference[k] - set[k - d] - added[k - d]).abs() < 1e-12)
    });
    assert!(delay.is_some());
}

/// Friction (a force) or a measuring error (an encoder offset) raises 70082 in a program that runs without them. The force keeps the axis
/// 0.1 mm away; the encoder slips back by 0.2 mm every 20 ms, of which `exp(-1)` remains each time.
/// Conformance: P004.
#[test]
fn disturbed_axis_misses_the_exact_stop() {
    let program = "%P\nG90 G01 G60 X10 F6000\nG01 X20\nM30\n";
    let run = |inputs: &[(f64, &str, f64)]| run_with_inputs(machine(&[]), program, inputs);
    let slips: Vec<(f64, &str, f64)> = (0..100)
        .map(f64::from)
        .map(|n| (0.1 + 0.02 * n, "X_encoder_offset_mm", -0.2 * n))
        .collect();
    assert_eq!(run(&[]).ids(), [0; 0]);
    for inputs in [vec![(0.0, "X_force_mm_s2", -1000.0)], slips] {
        let run = run(&inputs);
        assert_eq!(run.ids(), [70082]);
        assert!(run.totals.aborted);
    }
}

/// 3500 mm/s2: at 50 mm/s from 0.4143 s on; held from the tick after 0.8143 s to 1.2 s.
#[test]
fn sample_of_feedhold_and_override() {
    let file = |name: &str| kontur_tests::programs().join(name).display().to_string();
    let (program, csv) = (file("feedhold_and_override.nc"), file("feedhold_and_override.csv"));
    let json = command(["run", &program, "--input", &csv, "--summary", "json"]);
    assert_eq!(json.exit, kontur::Exit::Finished);
    assert!(json.out.contains("\"held_s\":0.385,"), "{json:?}");
    let text = command(["run", &program, "--input", &csv]).out;
    assert!(text.contains("held           0.385 s"), "{text}");
    let folder = Folder::new(&[("semicolons.csv", "t_s;override_percent\n0;50\n")]);
    // mistakes in a file refuse run and check; a missing file is not a mistake in a file
    for verb in ["run", "check"] {
        let refused = command([verb, &program, "--input", &program]);
        assert_eq!(refused.exit, kontur::Exit::Usage);
        assert!(refused.err.contains("K-0076") && refused.err.contains("t_s"), "{refused:?}");
        let refused = folder.call(&[verb, &program, "--input", "@semicolons.csv"]);
        assert_eq!(refused.exit, kontur::Exit::Usage);
        assert!(refused.err.contains("separated by semicolons"), "{refused:?}");
        let absent = command([verb, &program, "--input", "no_such_file.csv"]);
        assert_eq!(absent.exit, kontur::Exit::Io);
    }
    let both = command(["run", &program, "--input", &csv, "-o", &csv]);
    assert_eq!(both.exit, kontur::Exit::Usage, "{both:?}");
}

/// The three closed forms stated in the head of the program.
#[test]
fn sample_of_inputs_of_axes() {
    let text = std::fs::read_to_string(kontur_tests::programs().join("inputs_of_axes.nc")).unwrap();
    let settings = "X.lr_param.add_interface: enable=1, filter[0].enable=1, filter[0].time_constant=20000; \
                    Y.getriebe[0].window=2000";
    let inputs = [
        (0.1, "X_add_mm", 0.1),
        (0.2, "Y_force_mm_s2", -1000.0),
        (0.3, "Z_encoder_offset_mm", 0.05),
    ];
    let run = run_with_inputs(machine(settings), &text, &inputs);
    let [x, y, z] = [0, 1, 2].map(|axis| run.records.last().unwrap().axes[axis]);
    // 900 ms are 45 time constants
    near(x.add, 0.1, 1e-9);
    near(x.act, 0.1, 1e-9);
    near(y.lag, 0.1, 1e-9);
    near(z.act, 0.0, 1e-9);
    near(z.load, -0.05, 1e-9);
    assert_eq!(run.diagnostics, []);
}

/// A second hold, shortly after the first one is released and while the path still brakes for it, before a corner at which the
/// tolerance requires a rest: whenever it comes, every block is driven once and without a jump.
#[test]
fn two_holds_before_a_corner() {
    let program = "%P\n#SLOPE [TYPE=TRAPEZ]\n#VIB GUARD ON [MODE=4 FREQ=30 DAMPING=0.1 AX_DEV=0.02]\n\
                   G90 G01 X10 Y0 F2000\nX10 Y10 F6000\nX9 Y10\nM30\n";
    for ms in 290..345 {
        let at = |after: f64| 0.001 * f64::from(ms) + after;
        let holds = [(0.0, 1.0), (0.005, 0.0), (0.006, 1.0), (0.3, 0.0)];
        let inputs = holds.map(|(after, hold)| (at(after), "feedhold", hold));
        let run = run_with_inputs(machine(""), program, &inputs);
        assert!(!run.totals.aborted, "{ms} ms: {:?}", run.said());
        let (x, y) = (run.axis(0, |a| a.ipo), run.axis(1, |a| a.ipo));
        let steps = x.windows(2).zip(y.windows(2));
        let way: f64 = steps.map(|(x, y)| libm::hypot(x[1] - x[0], y[1] - y[0])).sum();
        near(way, 21.0, 1e-6);
        let last = run.records.last().unwrap();
        near(last.path.s_mm, 21.0, 1e-6);
    }
}

/// A feedhold in any of the last cycles of a motion: the path waits for its release, or is so near to its end that nothing is left to
/// hold; then no later feedhold stops it. In both cases it ends where the block ends.
#[test]
fn a_hold_at_the_end_of_the_last_motion() {
    let program = "%P\nG90 G01 X10 F3000\nM30\n";
    let plain = run_with_inputs(machine(&[]), program, &[]);
    for (column, on, off) in [("feedhold", 1.0, 0.0), ("override_percent", 0.0, 100.0)] {
        let mut held = true;
        for cycle in 150..plain.records.len() {
            let at = (cycle as f64 / 1000.0, column, on);
            let run = run_with_inputs(machine(&[]), program, &[at, (0.6, column, off)]);
            near(x_at(&run, f64::INFINITY), 10.0, 1e-9);
            let ends_as_planned = run.records.len() == plain.records.len();
            assert!(held || ends_as_planned, "{column} in cycle {cycle}");
            held = !ends_as_planned;
        }
        assert!(!held);
    }
}
