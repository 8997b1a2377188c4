//! Feedforward of axes and spindles in runs of programs. The names of the rows are those of the ledger.

use kontur_interpreter::diag::Condition;
use kontur_tests::{Run, run};

fn program(lines: &[&str]) -> String {
    format!("%P\n{}\nM30\n", lines.join("\n"))
}

/// Axes of unequal gain on an arc. Conformance: F013.
#[test]
fn feedforward_keeps_the_arc() {
    let error = |first: &str| {
        let run = run(
            &program(&["G00 X20 Y0", first, "G04 1", "G03 X20 Y0 I-20 J0 F6000"]),
            &["X.getriebe[0].kv=5000", "Y.getriebe[0].kv=2500"],
        );
        let arc = run.of_line(5);
        let radius = |r: &kontur_interpreter::record::CycleRecord| {
            (libm::hypot(r.axes[0].act, r.axes[1].act) - 20.0).abs()
        };
        arc.map(radius).fold(0.0, f64::max)
    };
    let (without, with) = (error("G137"), error("G135"));
    assert!(without > 0.5, "{without}");
    assert!(with < 0.1 * without, "{with} of {without}");
}

/// `#MACHINE DATA` while the axes still follow: where the value equals the one in force nothing changes, and another gain appears as
/// another speed command, without a jump of the axis.
#[test]
fn machine_data_move_no_axis() {
    for settings in ["", "X.filter[0]: enable=1, type=PT1, order=1"] {
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
    let settings = "X.filter[0]: enable=1, order=1, fg_f0=15; \
                    X.filter[1]: enable=1, type=HIGHPASS, order=2, share_percent=50; \
                    X.filter[2]: enable=1, order=1, fg_f0=15";
    for changed in [
        "filter[0].fg_f0 25",
        "filter[2].fg_f0 25",
        "filter[0].enable 0",
        "filter[2].enable 0",
        "filter[1].fg_f0 25",
        "filter[1].order 1",
    ] {
        let command = format!("#MACHINE DATA [AX=X AXPARAM=\"{changed}\"]");
        let run = run(&program(&["G01 X20 F6000", &command, "G04 0.2", "X20.001"]), settings);
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
    let with = |window: &str| {
        let filter = "X.filter[0]: enable=1, type=PT1, order=1, time_constant=30000";
        let settings = format!("{filter}; X.kenngr.filter_position_window={window}");
        let run = run(&program(&["G60 G01 X20 F6000", "G01 X40"]), &settings);
        let (count, slowest) = run.totals.stops.axes[&0];
        assert_eq!(count, 2, "window {window}");
        slowest.settling_s
    };
    // 0.1 mm before the target the actual position is still outside its window of 0.01 mm
    assert!(with("1000") > 0.05 && with("0.4") < 0.002);
}

/// The path rests while the axis is still moving after its filter, or moves alone: switching causes a step in its command of the share
/// times its speed, and K-0022 names that jump. When both are at rest there is no message.
#[test]
fn a_switch_with_filters_is_reported() {
    let guard = "X.vib_guard: active=1, mode=3, freq=3";
    let low_pass = "X.filter[0]: enable=1, type=PT1, order=1, time_constant=50000";
    let asyn = "G135\nX[INDP_ASYN G90 G01 FEED=6000 POS=50]\nG04 0.2\nG137\nG04 1";
    for (settings, text, told) in [
        (guard, "G135\nG01 F6000 X20\nG137", true),
        (guard, "G135\nG01 F6000 X20\nG136 X50\nG04 0.1\nX0", true),
        (guard, "G135\nG01 F6000 X20\n#FLUSH WAIT\nG137", false),
        (low_pass, "G135\nG01 F6000 X20\nG137", true),
        ("", "G135\nG01 F6000 X20\nG137", false),
        ("", asyn, true),
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
