//! Override, feedhold, additional interface, force and encoder offset from time-stamped inputs, in runs of programs.

use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::machine::Machine;
use kontur_interpreter::record::{AxisRecord, Rest, SpeedLimit};
use kontur_tests::command::command;
use kontur_tests::{Run, machine, run_with_inputs};

/// 100 mm at 100 mm/s with the linear slope and 1000 mm/s2.
const LINE: &str = "%P\n#SLOPE [TYPE=STEP]\nG90 G01 X100 F6000\nM30\n";

/// The built-in machine with 1000 mm/s2 in every stage of the linear slope.
fn linear(more: &[&str]) -> (Machine, Vec<Diagnostic>) {
    let stages = ["a_stufe_1", "a_stufe_2", "a_grenz_stufe_1", "a_grenz_stufe_2"];
    let mut settings: Vec<String> =
        stages.iter().map(|s| format!("X.getriebe[0].lslope_profil.{s}=1000")).collect();
    settings.extend(more.iter().map(ToString::to_string));
    machine(&settings.iter().map(String::as_str).collect::<Vec<_>>())
}

fn under(inputs: &[(f64, &str, f64)]) -> Run {
    run_with_inputs(linear(&[]), LINE, inputs)
}

fn x_at(run: &Run, time_s: f64) -> f64 {
    let k = (time_s / run.cycle_s).round() as usize;
    run.records[k.min(run.records.len() - 1)].axes[0].ipo
}

/// Time of the first cycle at the target.
fn arrival_s(run: &Run, target: f64) -> f64 {
    let k = run.records.iter().position(|r| (r.axes[0].ipo - target).abs() < 1e-9);
    k.map_or(f64::INFINITY, |k| k as f64 * run.cycle_s)
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9, "{a} instead of {b}");
}

fn own_ids(run: &Run) -> Vec<String> {
    run.diagnostics.iter().map(|d| d.id.to_string()).collect()
}

/// Braking from 0.5 s on takes 0.1 s and 5 mm; from 1 s on the other 50 mm take 0.6 s.
#[test]
fn feedhold_and_release() {
    let run = under(&[(0.5, "feedhold", 1.0), (1.0, "feedhold", 0.0)]);
    near(x_at(&run, 0.5), 45.0);
    near(x_at(&run, 0.55), 48.75);
    near(x_at(&run, 0.6), 50.0);
    near(x_at(&run, 1.0), 50.0);
    near(x_at(&run, 1.1), 55.0);
    near(arrival_s(&run, 100.0), 1.6);
    assert_eq!(run.rested(Rest::Held), 400);
    assert_eq!(run.records[800].path.limit, SpeedLimit::Stop);
    assert!(!run.totals.aborted && own_ids(&run).is_empty());
}

/// With its own deceleration of 500 mm/s2 (P-CHAN-00097, P-AXIS-00024) it takes 0.2 s and 10 mm.
#[test]
fn feedhold_with_its_own_deceleration() {
    let settings = ["channel.use_drive_curr_limit=1", "X.getriebe[0].lslope_profil.a_feedh=500"];
    let inputs = [(0.5, "feedhold", 1.0), (1.0, "feedhold", 0.0)];
    let run = run_with_inputs(linear(&settings), LINE, &inputs);
    near(x_at(&run, 0.6), 52.5);
    near(x_at(&run, 0.7), 55.0);
    assert_eq!(run.rested(Rest::Held), 300);
}

/// A hold that begins before the first motion, and one inside a dwell, only shift what follows.
#[test]
fn feedhold_before_motions() {
    let run = under(&[(0.0, "feedhold", 1.0), (0.25, "feedhold", 0.0)]);
    near(x_at(&run, 0.25), 0.0);
    near(x_at(&run, 0.3), 1.25);
    near(arrival_s(&run, 100.0), 1.35);
    let program = "%P\n#SLOPE [TYPE=STEP]\nG90 G01 X10 F6000\nG04 1\nX20\nM30\n";
    let inputs = [(0.5, "feedhold", 1.0), (1.5, "feedhold", 0.0)];
    let run = run_with_inputs(linear(&[]), program, &inputs);
    // 10 mm take 0.2 s, the dwell ends at 1.2 s
    near(x_at(&run, 1.5), 10.0);
    near(arrival_s(&run, 20.0), 1.7);
    assert_eq!(run.rested(Rest::Held), 300);
}

/// Nothing will release the path: the run ends, and says so.
#[test]
fn held_for_ever() {
    for inputs in [(0.5, "feedhold", 1.0), (0.5, "override_percent", 0.0)] {
        let run = under(&[inputs]);
        assert_eq!(own_ids(&run), ["K-0083"]);
        assert!(run.totals.aborted && run.records.len() < 610, "{}", run.records.len());
        near(run.records.last().unwrap().axes[0].ipo, 50.0);
    }
}

/// From 100 to 50 mm/s in 0.05 s and 3.75 mm; then 50 mm at 50 mm/s, and 1.25 mm of braking.
#[test]
fn override_in_the_middle_and_from_the_start() {
    let run = under(&[(0.5, "override_percent", 50.0)]);
    near(x_at(&run, 0.5), 45.0);
    near(x_at(&run, 0.55), 48.75);
    near(x_at(&run, 1.55), 98.75);
    near(arrival_s(&run, 100.0), 1.6);
    let run = under(&[(0.0, "override_percent", 50.0)]);
    near(arrival_s(&run, 100.0), 2.05);
    // 0.15 s at up to 150 mm/s, back to 100 at 0.5 s
    let run = under(&[(0.0, "override_percent", 150.0), (0.5, "override_percent", 100.0)]);
    near(x_at(&run, 0.5), 11.25 + 0.35 * 150.0);
    near(x_at(&run, 0.55), 63.75 + 6.25);
}

/// P-CHAN-00056: 200 % asked for, 125 % allowed by the list; without an entry nothing is limited. 100 mm at `v`, and ramps of
/// 1000 mm/s2.
#[test]
fn the_channel_limits_the_override() {
    for (settings, v) in [(&["channel.max_vb_override=1250"][..], 125.0), (&[], 200.0)] {
        let run = run_with_inputs(linear(settings), LINE, &[(0.0, "override_percent", 200.0)]);
        near(arrival_s(&run, 100.0), 100.0 / v + v / 1000.0);
        assert_eq!(own_ids(&run), ["K-0142"]);
    }
    let run = run_with_inputs(
        linear(&["channel.max_vb_override=1500"]),
        LINE,
        &[(0.0, "override_percent", 150.0)],
    );
    assert_eq!(own_ids(&run), Vec::<String>::new());
}

/// With ramps of 30 ms and 3500 mm/s2 the change from 100 to 50 mm/s reaches no constant acceleration: it takes
/// `2 sqrt(50 / j)` with `j = 3500 / 0.03`, at 75 mm/s in the mean.
#[test]
fn override_with_jerk_limit() {
    let program = "%P\nG90 G01 X100 F6000\nM30\n";
    let run = run_with_inputs(machine(&[]), program, &[(0.5, "override_percent", 50.0)]);
    let plain = run_with_inputs(machine(&[]), program, &[]);
    near(x_at(&run, 0.5), x_at(&plain, 0.5));
    let change_s = 2.0 * (50.0 * 0.03 / 3500.0_f64).sqrt();
    near(x_at(&run, 0.6), x_at(&plain, 0.5) + 75.0 * change_s + 50.0 * (0.1 - change_s));
}

/// `#OVERRIDE` times the real-time one; G166 frees its block from both.
#[test]
fn programmed_overrides_multiply() {
    let program = "%P\n#SLOPE [TYPE=STEP]\n#OVERRIDE [FEED_FACT=50]\nG90 G01 X100 F6000\nM30\n";
    let half = [(0.0, "override_percent", 50.0)];
    let run = run_with_inputs(linear(&[]), program, &half);
    near(arrival_s(&run, 100.0), 4.025);
    let free = program.replace("G01 X100", "G01 G166 X100");
    let run = run_with_inputs(linear(&[]), &free, &half);
    near(arrival_s(&run, 100.0), 1.1);
}

/// P-CHAN-00181: one override for both, the smaller one, or its own. 100 mm in rapid at 200 mm/s.
#[test]
fn rapid_override() {
    let program = "%P\n#SLOPE [TYPE=STEP]\nG90 G00 X100\nM30\n";
    let inputs = [(0.0, "override_percent", 50.0), (0.0, "rapid_override_percent", 25.0)];
    // 100 / v + v / 1000
    for (mode, v, ids) in [
        ("NOT_USED", 100.0, vec!["K-0077"]),
        ("MINIMUM_OF_G0_G1", 50.0, vec![]),
        ("ACTIVE", 50.0, vec![]),
        ("2", 50.0, vec![]),
        ("ACTIVE_EXTENDED", 50.0, vec!["K-0075"]),
    ] {
        let settings =
            ["X.getriebe[0].vb_eilgang=200000", &format!("channel.g00_override_mode={mode}")];
        let run = run_with_inputs(linear(&settings), program, &inputs);
        near(arrival_s(&run, 100.0), 100.0 / v + v / 1000.0);
        assert_eq!(own_ids(&run), ids, "{mode}");
    }
    let settings =
        ["X.getriebe[0].vb_eilgang=200000", "channel.g00_override_mode=MINIMUM_OF_G0_G1"];
    let inputs = [(0.0, "override_percent", 50.0), (0.0, "rapid_override_percent", 100.0)];
    let run = run_with_inputs(linear(&settings), program, &inputs);
    near(arrival_s(&run, 100.0), 1.1);
}

/// P-CHAN-00066: 200 mm/s programmed, 100 allowed by the axis; 50 % are 50 of what is reached, 100 of what is programmed.
#[test]
fn what_the_override_multiplies() {
    let program = "%P\n#SLOPE [TYPE=STEP]\nG90 G01 X100 F12000\nM30\n";
    for (mode, v) in [(0, 50.0), (1, 100.0), (2, 50.0)] {
        let settings = [
            "X.getriebe[0].dynamik.vb_max=100000",
            "X.getriebe[0].vb_eilgang=100000",
            "X.getriebe[0].lslope_profil.vb_stufe_1_2=100000",
            "X.getriebe[0].lslope_profil.vb_grenz_stufe_1_2=100000",
            &format!("channel.override_weight_prog_feed={mode}"),
        ];
        let half = [(0.0, "override_percent", 50.0)];
        let run = run_with_inputs(linear(&settings), program, &half);
        near(arrival_s(&run, 100.0), 100.0 / v + v / 1000.0);
    }
}

/// A time stamp between two cycles acts in the later one, one on a cycle in that cycle.
#[test]
fn time_stamps_between_cycles() {
    let program = "%P\nG04 0.1\nM30\n";
    let on = ["X.lr_param.add_interface.enable=1"];
    for (time_s, first) in [(0.01, 10), (0.0101, 11), (0.0109, 11), (0.011, 11)] {
        let run = run_with_inputs(machine(&on), program, &[(time_s, "X_add_mm", 0.01)]);
        let added = run.axis(0, |a| a.add);
        assert_eq!(added.iter().position(|x| *x > 0.0), Some(first));
    }
}

/// The additional interface with the settings after `filter[0]`, a step of 1 mm in cycle 10.
fn additional(filter: &str) -> Run {
    let prefix = "X.lr_param.add_interface";
    let mut settings = vec![format!("{prefix}.enable=1")];
    settings.extend(filter.split_whitespace().map(|entry| format!("{prefix}.filter[0].{entry}")));
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    run_with_inputs(machine(&settings), "%P\nG04 1\nM30\n", &[(0.01, "X_add_mm", 1.0)])
}

/// What flows through the interface: the input, its filter, and the sum after the axis filters that the controller
/// follows; set position and deviation are those of the program. Conformance: A012, A106.
#[test]
fn additional_position() {
    let run = additional("");
    let added = run.axis(0, |a| a.add);
    let expected = |k: usize| if k < 10 { 0.0 } else { 1.0 };
    assert!(added.iter().enumerate().all(|(k, x)| (x - expected(k)).abs() <= 0.0));
    let set = |a: &AxisRecord| a.set.abs() + a.ipo.abs() + a.err.abs() + a.dev.abs();
    assert!(run.axis(0, set).iter().all(|x| *x <= 0.0));
    let last = run.records.last().unwrap().axes[0];
    near(last.reference, 1.0);
    near(last.act, 1.0);
    assert!(own_ids(&run).is_empty());
    // off: the input has no effect, and a message says so
    let off = run_with_inputs(machine(&[]), "%P\nG04 1\nM30\n", &[(0.01, "X_add_mm", 1.0)]);
    assert_eq!(own_ids(&off), ["K-0077"]);
    assert!(off.axis(0, |a| a.add.abs() + a.act.abs()).iter().all(|x| *x <= 0.0));
}

/// PT1 of 10 ms: `1 - p^n / (1 + g)` with `g = tan(T / 2 tau)`, `p = (1 - g) / (1 + g)`. Conformance: A057.
#[test]
fn additional_pt1() {
    let run = additional("enable=1 order=1 type=PT1 time_constant=10000 share_percent=100");
    let g = libm::tan(0.05);
    let p = (1.0 - g) / (1.0 + g);
    for (k, x) in run.axis(0, |a| a.add).into_iter().enumerate().skip(10) {
        near(x, 1.0 - libm::pow(p, (k - 10) as f64) / (1.0 + g));
    }
    assert!(own_ids(&run).is_empty());
}

/// The axis filter and the filter of the interface act each on its own part.
#[test]
fn both_filters_add_up() {
    let settings = [
        "X.filter[0].enable=1",
        "X.filter[0].order=1",
        "X.filter[0].type=TIME_DELAY",
        "X.filter[0].time_constant=3000",
        "X.lr_param.add_interface.enable=1",
        "X.lr_param.add_interface.filter[0].enable=1",
        "X.lr_param.add_interface.filter[0].order=1",
        "X.lr_param.add_interface.filter[0].type=TIME_DELAY",
        "X.lr_param.add_interface.filter[0].time_constant=5000",
    ];
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
    // the controller gets the sum after its buffer
    let delay = (0..10).find(|d| {
        (10..run.records.len()).all(|k| (reference[k] - set[k - d] - added[k - d]).abs() < 1e-12)
    });
    assert!(delay.is_some());
}

/// A constant force: velocity loop of first order with `Ta` = 5 ms and `kv` = 50/s lag by `F Ta / kv`.
#[test]
fn force_on_an_axis_at_rest() {
    let program = "%P\nG04 1\nM30\n";
    let run = run_with_inputs(machine(&[]), program, &[(0.1, "X_force_mm_s2", -1000.0)]);
    assert!(run.axis(0, |a| a.lag).iter().take(101).all(|x| *x <= 0.0));
    near(run.records.last().unwrap().axes[0].lag, 1000.0 * 0.005 / 50.0);
    near(run.records.last().unwrap().axes[1].lag, 0.0);
}

/// An encoder that reads 0.3 mm too much stops the axis 0.3 mm short.
#[test]
fn encoder_offset() {
    let program = "%P\nG90 G01 X10 F6000\nG04 1\nM30\n";
    let run = run_with_inputs(machine(&[]), program, &[(0.2, "X_encoder_offset_mm", 0.3)]);
    let last = run.records.last().unwrap().axes[0];
    near(last.act, 10.0);
    near(last.load, 9.7);
    let k = run.records.iter().position(|r| (r.axes[0].act - r.axes[0].load).abs() > 0.1);
    assert_eq!(k, Some(200));
}

/// Friction (a force) or a measuring fault (an encoder offset) raises 70082 in a program that runs without them. The
/// force keeps the axis 0.1 mm away; the encoder slips back by 0.2 mm every 20 ms, of which `exp(-1)` are left each time.
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

/// The inputs of an axis last over a change of its lists at standstill.
#[test]
fn inputs_last_over_machine_data() {
    let program =
        "%P\nG04 0.5\n#MACHINE DATA [AX=X AXPARAM=\"getriebe[0].kv 4000\"]\nG04 0.5\nM30\n";
    let settings = ["X.lr_param.add_interface.enable=1"];
    let inputs = [(0.01, "X_add_mm", 0.5), (0.01, "X_encoder_offset_mm", 0.125)];
    let run = run_with_inputs(machine(&settings), program, &inputs);
    for r in &run.records[450..] {
        let a = r.axes[0];
        assert!((a.act - 0.5).abs() < 1e-6 && (a.load - 0.375).abs() < 1e-6, "{a:?}");
        assert!(a.vel.abs() <= 0.0);
    }
    assert_eq!(run.ids(), [0; 0]);
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
    let folder = tempfile::tempdir().unwrap();
    // what is wrong with a file refuses run and check; a file that is not there is not a mistake in one
    for verb in ["run", "check"] {
        let refused = command([verb, &program, "--input", &program]);
        assert_eq!(refused.exit, kontur::Exit::Usage);
        assert!(refused.err.contains("K-0076") && refused.err.contains("t_s"), "{refused:?}");
        let semicolons = folder.path().join("semicolons.csv").display().to_string();
        std::fs::write(&semicolons, "t_s;override_percent\n0;50\n").unwrap();
        let refused = command([verb, &program, "--input", &semicolons]);
        assert_eq!(refused.exit, kontur::Exit::Usage);
        assert!(refused.err.contains("separated by semicolons"), "{refused:?}");
        let absent = command([verb, &program, "--input", "no_such_file.csv"]);
        assert_eq!(absent.exit, kontur::Exit::Io);
    }
    let both = command(["run", &program, "--input", &csv, "-o", &csv]);
    assert_eq!(both.exit, kontur::Exit::Usage, "{both:?}");
}

/// The three closed forms that the program's head states.
#[test]
fn sample_of_inputs_of_axes() {
    let text = std::fs::read_to_string(kontur_tests::programs().join("inputs_of_axes.nc")).unwrap();
    let filter = "X.lr_param.add_interface.filter[0]";
    let settings = [
        "X.lr_param.add_interface.enable=1",
        &format!("{filter}.enable=1"),
        &format!("{filter}.time_constant=20000"),
        "Y.getriebe[0].window=2000",
    ];
    let inputs = [
        (0.1, "X_add_mm", 0.1),
        (0.2, "Y_force_mm_s2", -1000.0),
        (0.3, "Z_encoder_offset_mm", 0.05),
    ];
    let run = run_with_inputs(machine(&settings), &text, &inputs);
    let [x, y, z] = [0, 1, 2].map(|axis| run.records.last().unwrap().axes[axis]);
    // 900 ms are 45 time constants
    near(x.add, 0.1);
    near(x.act, 0.1);
    near(y.lag, 0.1);
    near(z.act, 0.0);
    near(z.load, -0.05);
    assert_eq!(run.diagnostics, []);
}
