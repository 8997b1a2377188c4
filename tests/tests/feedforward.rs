//! Feedforward of axes and spindles in runs of programs. The names of the rows are those of the ledger.

use kontur_interpreter::diag::Condition;
use kontur_tests::{Run, programs, run, run_on, sample_machine};

/// Lag in per cent of the lag without feedforward (speed / Kv, Kv 50/s), in the middle of the motion of a line.
fn percent(run: &Run, line: u32, axis: usize) -> f64 {
    let of_line: Vec<_> = run.records.iter().filter(|r| r.line == line).collect();
    assert!(of_line.len() > 300, "line {line}: {} cycles, {:?}", of_line.len(), run.diagnostics);
    let at = of_line.len() * 7 / 10;
    let (before, now) = (&of_line[at - 1].axes[axis], &of_line[at].axes[axis]);
    let speed = (now.reference - before.reference) / run.cycle_s;
    100.0 * now.lag * 50.0 / speed
}

#[track_caller]
fn lags(run: &Run, line: u32, want: &[f64]) {
    for (axis, want) in want.iter().enumerate() {
        let is = percent(run, line, axis);
        assert!((is - want).abs() < 0.01, "axis {axis}: {is} %, expected {want}");
    }
}

/// A move back and forth, with each way long enough to reach constant speed.
const FORTH: &str = "G90 G01 X100 Y100 Z100 F6000";
const BACK: &str = "G90 G01 X0 Y0 Z0 F6000";

fn program(lines: &[&str]) -> String {
    format!("%P\n{}\nM30\n", lines.join("\n"))
}

/// Off at program start, with weights of 100 %, whatever has run before. Conformance: F022, F027.
#[test]
fn a_program_starts_without_feedforward() {
    let first = run(&program(&["G135 G136 X50", FORTH]), &[]);
    lags(&first, 3, &[50.0, 0.0, 0.0]);
    let second = run(&program(&[FORTH, "G135", BACK]), &[]);
    lags(&second, 2, &[100.0, 100.0, 100.0]);
    assert!(second.records.iter().filter(|r| r.line == 2).all(|r| r.axes[0].ff.abs() <= 0.0));
    lags(&second, 4, &[0.0, 0.0, 0.0]);
}

/// All axes of the group, through further blocks, until G137. Conformance: F024, F031, F034.
#[test]
fn g135_and_g137_are_modal() {
    let run = run(&program(&["G135", FORTH, BACK, FORTH, "G137", BACK, FORTH]), &[]);
    for line in [3, 4, 5] {
        lags(&run, line, &[0.0, 0.0, 0.0]);
    }
    for line in [7, 8] {
        lags(&run, line, &[100.0, 100.0, 100.0]);
    }
}

/// Only axes for which P-AXIS-00223 allows it. Conformance: F006, F024.
#[test]
fn axes_without_feedforward_stay_without() {
    let run = run(&program(&["G135", FORTH]), &["Y.vorsteuer.vorsteuerung=NONE"]);
    lags(&run, 3, &[0.0, 100.0, 0.0]);
}

/// Conformance: F025, F029, F030, F032, F033.
#[test]
fn weights_of_the_axes() {
    let listing = [
        "G135 (Select feedforward control; weighting)",
        "G136 X80 Y95 Z0 (weighting; here, the Z axis)",
        FORTH,
    ];
    let two_blocks = run(&program(&listing), &[]);
    assert_eq!(two_blocks.diagnostics, []);
    lags(&two_blocks, 4, &[20.0, 5.0, 100.0]);
    let one_block = run(&program(&["G135 G136 X80 Y95", FORTH]), &[]);
    lags(&one_block, 3, &[20.0, 5.0, 0.0]);
    // the words are weights: nothing moves before the motion block
    for run in [&two_blocks, &one_block] {
        for r in run.records.iter().filter(|r| r.line < 3) {
            assert!(r.axes[..3].iter().all(|a| a.ipo.abs() <= 0.0), "{r:?}");
        }
    }
}

/// Conformance: F028.
#[test]
fn switching_keeps_the_weights() {
    let run = run(&program(&["G136 X80", "G135", FORTH, "G137", BACK, "G135", FORTH]), &[]);
    lags(&run, 4, &[20.0, 0.0, 0.0]);
    lags(&run, 6, &[100.0, 100.0, 100.0]);
    lags(&run, 8, &[20.0, 0.0, 0.0]);
}

/// Conformance: F026.
#[test]
fn a_weight_is_100_percent_at_most() {
    let more = run(&program(&["G135 G136 X120", FORTH]), &[]);
    let all = run(&program(&["G135 G136 X100", FORTH]), &[]);
    assert_eq!(more.said(), ["K-0020"]);
    assert_eq!(more.records, all.records);
}

/// P-AXIS-00255: even under G137. Conformance: F078.
#[test]
fn default_active() {
    let settings = ["X.vorsteuer.default_active=1"];
    let run = run(&program(&["G137", FORTH]), &settings);
    lags(&run, 3, &[0.0, 100.0, 100.0]);
}

/// Every kind of drive and of axis. Conformance: F014.
#[test]
fn drives_and_axes() {
    for drive in 1..=8 {
        let kind = format!("X.kenngr.antr_typ={drive}");
        let run = run(&program(&["G135", FORTH]), &[&kind]);
        lags(&run, 3, &[0.0, 0.0, 0.0]);
    }
    let run = run(&program(&["G135", FORTH]), &["Z.kenngr.achs_typ=ACHSTYP_ROTATOR"]);
    lags(&run, 3, &[0.0, 0.0, 0.0]);
}

/// Axes of unequal gain on an arc. Conformance: F013.
#[test]
fn feedforward_keeps_the_arc() {
    let error = |first: &str| {
        let run = run(
            &program(&["G00 X20 Y0", first, "G04 1", "G03 X20 Y0 I-20 J0 F6000"]),
            &["X.getriebe[0].kv=5000", "Y.getriebe[0].kv=2500"],
        );
        let arc = run.records.iter().filter(|r| r.line == 5);
        let radius = |r: &kontur_interpreter::record::CycleRecord| {
            (libm::hypot(r.axes[0].act, r.axes[1].act) - 20.0).abs()
        };
        arc.map(radius).fold(0.0, f64::max)
    };
    let (without, with) = (error("G137"), error("G135"));
    assert!(without > 0.5, "{without}");
    assert!(with < 0.1 * without, "{with} of {without}");
}

/// Spindles on the machine with two of them: S and S2 after X, Y, Z. Conformance: F014, F035, F036, F037, F038, F039,
/// F040, F042.
#[test]
fn feedforward_of_spindles() {
    let lag = |first: &[&str], axis: usize| {
        let start = if axis == 3 { "S1000 M3" } else { "S2[REV1000 M3]" };
        let mut lines = first.to_vec();
        lines.extend([start, "G04 3"]);
        let run = run_on(sample_machine("two_spindles", &[]), &program(&lines));
        assert!(!run.totals.aborted, "{:?}", run.diagnostics);
        let n = run.records.len() - 20;
        let (before, now) = (&run.records[n - 1].axes[axis], &run.records[n].axes[axis]);
        let turn = (now.reference - before.reference + 180.0).rem_euclid(360.0) - 180.0;
        let rpm = turn / run.cycle_s / 6.0;
        assert!((rpm - 1000.0).abs() < 1e-6, "{rpm} rpm");
        100.0 * now.lag * 50.0 / (6.0 * rpm)
    };
    for (first, axis, want) in [
        (&[][..], 3, 100.0),
        (&["S[G135]"], 3, 0.0),
        (&["S[G136=80]", "S[G135]"], 3, 20.0),
        (&["S[G135]", "S[G137]"], 3, 100.0),
        (&["S2[G135 G136=90]"], 4, 10.0),
        (&["S2[G135]", "S2[G136=0]"], 4, 100.0),
        (&["S2[G135]"], 4, 0.0),
    ] {
        let is = lag(first, axis);
        assert!((is - want).abs() < 0.01, "{first:?}: {is} %, expected {want}");
    }
}

/// Conformance: F041.
#[test]
fn feedforward_of_spindles_stands_alone() {
    let run = run(&program(&["S[G135 M3 REV1000]"]), &[]);
    let found = run.diagnostics.iter().find(|d| d.is_error()).unwrap();
    let at = found.source.as_ref().unwrap();
    assert_eq!(at.line, 2);
    assert!(run.records.is_empty() && at.length > 0, "{found:?}");
}

/// Lag of the spindles in the sample program: what each form of the command leaves of v / Kv = 6000 / 50 deg.
/// Conformance: F035, F036, F037, F038, F039.
#[test]
fn the_sample_program_of_the_spindles() {
    let text = std::fs::read_to_string(programs().join("spindle_feedforward.nc")).unwrap();
    let run = run_on(sample_machine("two_spindles", &[]), &text);
    assert!(!run.totals.aborted && run.diagnostics.is_empty(), "{:?}", run.diagnostics);
    // ten cycles before each change
    for (k, s, s2) in [
        (990, 120.0, 120.0),
        (1490, 0.0, 120.0),
        (1990, 0.0, 12.0),
        (2490, 24.0, 12.0),
        (2990, 120.0, 120.0),
    ] {
        let lag = |axis: usize| run.records[k].axes[axis].lag;
        assert!((lag(3) - s).abs() < 1e-6, "S in cycle {k}: {}", lag(3));
        assert!((lag(4) - s2).abs() < 1e-6, "S2 in cycle {k}: {}", lag(4));
    }
    let last = run.records.last().unwrap();
    assert!(last.axes[3].vel.abs() < 1e-9 && last.axes[4].vel.abs() < 1e-9, "M5");
}

/// G135 between blocks that run on causes a step in the speed command of the moving axis; after an exact stop it does not.
#[test]
fn switching_in_motion_is_reported() {
    let switched = |first: &str| {
        let run = run(&program(&[first, "G135", "G01 X100 F6000"]), &[]);
        let found =
            run.diagnostics.iter().find(|d| d.id == Condition::FeedforwardSwitchedMoving).cloned();
        (found, run.diagnostics.len())
    };
    let (found, count) = switched("G90 G01 X50 F6000");
    let found = found.unwrap();
    assert_eq!(count, 1, "once");
    assert!(!found.is_error(), "{}", found.text);
    assert_eq!(switched("G90 G60 G01 X50 F6000"), (None, 0));
    assert_eq!(switched("G04 0.1"), (None, 0));
}

/// `#MACHINE DATA` while the axes still follow: where the value equals the one in force nothing changes, and another gain appears as
/// another speed command, without a jump of the axis.
#[test]
fn machine_data_move_no_axis() {
    for settings in
        [&[][..], &["X.filter[0].enable=1", "X.filter[0].type=PT1", "X.filter[0].order=1"]]
    {
        let with = |command: &str| {
            run(&program(&["G135", "G01 X10 F6000", command, "G04 0.2", "X20"]), settings)
        };
        let plain = with("#FLUSH WAIT");
        let moved = |run: &Run, of: fn(&Run, usize) -> f64| -> Vec<f64> {
            (1..run.records.len()).map(|k| of(run, k) - of(run, k - 1)).collect()
        };
        let act = |run: &Run, k: usize| run.records[k].axes[0].act;
        for same in ["getriebe[0].kv 5000", "vorsteuer.vorsteuerung VEL", "filter[1].enable 0"] {
            let run = with(&format!("#MACHINE DATA [AX=X AXPARAM=\"{same}\"]"));
            assert!(!run.totals.aborted, "{same}: {:?}", run.diagnostics);
            let axes = |run: &Run| run.records.iter().map(|r| r.axes.clone()).collect::<Vec<_>>();
            assert!(axes(&run) == axes(&plain), "{same}");
        }
        for other in ["getriebe[0].kv 2000", "filter[0].enable 0", "vorsteuer.vorsteuerung NONE"] {
            let run = with(&format!("#MACHINE DATA [AX=X AXPARAM=\"{other}\"]"));
            let fastest = moved(&run, act).into_iter().fold(0.0, |m: f64, d| m.max(d.abs()));
            // 100 mm/s, and slightly more where the axis overshoots
            assert!(fastest < 0.12, "{other}: {fastest} mm in a cycle");
        }
    }
}

/// `#MACHINE DATA` of one standard filter leaves the state of the others unchanged: a high-pass keeps the part that it holds back, so an
/// axis at rest does not move; a changed filter keeps it too.
#[test]
fn machine_data_of_a_filter_leave_the_others() {
    let high_pass = ["enable=1", "type=HIGHPASS", "order=2", "share_percent=50"];
    let low_pass = ["enable=1", "order=1", "fg_f0=15"];
    let settings: Vec<String> = [("0", &low_pass[..]), ("1", &high_pass), ("2", &low_pass)]
        .iter()
        .flat_map(|(i, keys)| keys.iter().map(move |key| format!("X.filter[{i}].{key}")))
        .collect();
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    for changed in [
        "filter[0].fg_f0 25",
        "filter[2].fg_f0 25",
        "filter[0].enable 0",
        "filter[2].enable 0",
        "filter[1].fg_f0 25",
        "filter[1].order 1",
    ] {
        let command = format!("#MACHINE DATA [AX=X AXPARAM=\"{changed}\"]");
        let run = run(&program(&["G01 X20 F6000", &command, "G04 0.2", "X20.001"]), &settings);
        let after = run.records.iter().filter(|r| r.line > 2).map(|r| r.axes[0].set);
        // half of the distance is held back, also of the micrometre at the end
        let far = after.fold(0.0, |far: f64, set| far.max((set - 10.0).abs()));
        assert!(far < 0.0011, "{changed}: {far} mm from 10");
    }
}

/// The timer of an exact stop starts where the filters count as settled, P-AXIS-00351: the larger this is, the earlier; and no stop is
/// missed.
#[test]
fn the_exact_stop_waits_for_settled_filters() {
    let filter = ["enable=1", "type=PT1", "order=1", "time_constant=30000"];
    let with = |window: &str| {
        let mut settings: Vec<String> = filter.iter().map(|k| format!("X.filter[0].{k}")).collect();
        settings.push(format!("X.kenngr.filter_position_window={window}"));
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        let run = run(&program(&["G60 G01 X20 F6000", "G01 X40"]), &settings);
        let (count, slowest) = run.totals.stops.axes[&0];
        assert_eq!(count, 2, "window {window}");
        slowest.settling_s
    };
    // 0.1 mm before the target the actual position is still outside its window of 0.01 mm
    assert!(with("1000") > 0.05 && with("0.4") < 0.002);
}

/// The weights of exchanged axes are 100 % again, those of the others are kept. Source: spec 50/1 (programming manual).
#[test]
fn weights_return_with_an_exchange() {
    let forth = |number: u32| format!("N{number} {FORTH}");
    for (exchange, want) in [
        ("#PUT AX [X]\n#CALL AX [X,1,0]", [0.0, 50.0, 0.0]),
        ("#CALL AX [X,1,0]", [0.0, 50.0, 0.0]),
        ("#SET AX [X,1,0] [Y,2,1] [Z,3,2]", [0.0, 0.0, 0.0]),
        ("#PUT AX ALL\n#CALL AX [X,1,0] [Y,2,1] [Z,3,2]", [0.0, 0.0, 0.0]),
        ("#AX DEF DEFAULT", [0.0, 0.0, 0.0]),
    ] {
        let text =
            program(&["G135", "G136 X50 Y50", &forth(1), "G90 X0 Y0 Z0", exchange, &forth(2)]);
        let run = run(&text, &[]);
        lags(&run, 4, &[50.0, 50.0, 0.0]);
        let line = text.lines().position(|l| l.starts_with("N2")).unwrap() as u32 + 1;
        lags(&run, line, &want);
    }
}

/// The path rests while the axis is still moving after its filter, or moves alone: switching causes a step in its command of the share
/// times its speed, and K-0022 names that jump. When both are at rest there is no message.
#[test]
fn a_switch_with_filters_is_reported() {
    let guard = ["X.vib_guard.active=1", "X.vib_guard.mode=3", "X.vib_guard.freq=3"];
    let low_pass = [
        "X.filter[0].enable=1",
        "X.filter[0].type=PT1",
        "X.filter[0].order=1",
        "X.filter[0].time_constant=50000",
    ];
    let asyn = "G135\nX[INDP_ASYN G90 G01 FEED=6000 POS=50]\nG04 0.2\nG137\nG04 1";
    for (settings, text, told) in [
        (&guard[..], "G135\nG01 F6000 X20\nG137", true),
        (&guard[..], "G135\nG01 F6000 X20\nG136 X50\nG04 0.1\nX0", true),
        (&guard[..], "G135\nG01 F6000 X20\n#FLUSH WAIT\nG137", false),
        (&low_pass[..], "G135\nG01 F6000 X20\nG137", true),
        (&[][..], "G135\nG01 F6000 X20\nG137", false),
        (&[][..], asyn, true),
    ] {
        let run = run(&program(&[text]), settings);
        let found: Vec<_> = run
            .diagnostics
            .iter()
            .filter(|d| d.id == Condition::FeedforwardSwitchedMoving)
            .collect();
        assert_eq!(found.len(), usize::from(told), "{text}: {:?}", run.diagnostics);
        // without a jump of the weight the command changes by no more than the acceleration of a cycle, 3.5 mm/s
        let ff = run.axis(0, |a| a.ff);
        let jump = ff.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
        assert_eq!(jump > 5.0, told, "{text}: {jump}");
        if let Some(d) = found.first() {
            assert!(d.text.contains(&format!("jumps by {jump:.3} mm/s")), "{}: {jump}", d.text);
        }
    }
}

/// The effect of the list on G135 and G137 applies from `#MACHINE DATA` on: the largest lag of the motion is that with the same value in
/// the list, whose program needs no command.
#[test]
fn machine_data_switches_feedforward() {
    let most = |before: &str, settings: &[&str]| {
        let run = run(&format!("{before}G01 X50 F6000\nM30\n"), settings);
        run.records.iter().map(|r| r.axes[0].lag.abs()).fold(0.0, f64::max)
    };
    let data = |text: &str| format!("#MACHINE DATA [AX=X AXPARAM=\"vorsteuer.{text}\"]\n");
    let plain = most("", &[]);
    for (g, key, value) in
        [("", "default_active", 1), ("G135\n", "global_disable", 1), ("G135\n", "vorsteuerung", 0)]
    {
        let listed = most(g, &[&format!("X.vorsteuer.{key}={value}")]);
        let programmed = most(&format!("{g}{}", data(&format!("{key} {value}"))), &[]);
        assert!((listed - programmed).abs() < 1e-9, "{key}: {listed} {programmed} {plain}");
        // and not the lag without it
        let without = most(g, &[]);
        assert!((listed - without).abs() > 0.5 * plain, "{key}: {listed} {without}");
    }
}
