//! Exact stop and its time limit in runs of programs. The names of the rows are those of the ledger.

use kontur_interpreter::explain::explain;
use kontur_tests::{Run, programs, run};

/// A gain of 10/s: from 100 mm/s it takes half a second into a window of 0.05 mm.
fn stop(program: &str, settling_us: i32) -> Run {
    let slow = format!("X.getriebe[0]: position_settling_time={settling_us}, kv=1000, window=500");
    run(program, &format!("{slow}; X,Y,Z.vorsteuer.vorsteuerung=NONE"))
}

/// The message, its reaction class, the frozen axis, and no further block.
/// Conformance: P001, P002, P011, P012.
#[test]
fn an_axis_that_does_not_arrive_ends_the_program() {
    let run = stop("%P\nG90 G60 G01 X50 Y20 F6000\nG60 X60 Y30\nM30\n", 200_000);
    assert!(run.totals.aborted);
    assert_eq!(run.ids(), [70082], "{:?}", run.diagnostics);
    let message = &run.diagnostics[0];
    assert_eq!(message.axis.as_ref().unwrap().name, "X");
    let explained = explain("70082").unwrap().to_string();
    assert!(explained.contains("class 5: the faulty axis stops abruptly"), "{explained}");
    assert!(explained.contains("class 6: complete reset of the channel"), "{explained}");
    let at = usize::try_from(message.cycle.unwrap()).unwrap();
    // (k - k1) T >= t3, counted from the cycle in which the set position has reached its target
    let t1 = run.axis(0, |a| a.set).iter().position(|x| x.to_bits() == 50_f64.to_bits()).unwrap();
    assert_eq!(at - t1, 200);
    for r in &run.records[t1..] {
        assert_eq!(r.axes[0].set.to_bits(), 50_f64.to_bits());
        assert_eq!(r.axes[1].set.to_bits(), 20_f64.to_bits(), "no further block");
    }
    assert!(run.records.len() > at, "the trace continues to standstill");
    assert!(run.records.iter().all(|r| r.line < 3));
}

/// Both stops of the program as a user runs it: 0.6 s are enough, 0.2 s are not. Conformance: P005, P006, P007, P010,
/// P015.
#[test]
fn the_program_of_the_timeout() {
    let text = std::fs::read_to_string(programs().join("exact_stop_timeout.nc")).unwrap();
    let run = run(&text, &[]);
    assert!(run.totals.aborted);
    assert_eq!(run.ids(), [70082], "{:?}", run.diagnostics);
    let at = |axis: usize, x: f64| {
        run.axis(axis, |a| a.set).iter().position(|s| (s - x).abs() <= 0.0).unwrap()
    };
    // an abrupt stop would need ln(10 / 0.05) / Kv = 530 ms; braking with 3500 mm/s2 shortens it
    let begins = run.axis(1, |a| a.ipo).iter().position(|y| *y > 0.0).unwrap();
    let waited = begins - at(0, 100.0);
    assert!((470..=530).contains(&waited), "{waited} ms");
    let message = run.diagnostics.iter().find(|d| d.is_error()).unwrap();
    let raised = usize::try_from(message.cycle.unwrap()).unwrap();
    let back = raised - 200;
    assert!(run.records[back - 1].axes[0].set > 0.0 && run.records[back].axes[0].set.abs() <= 0.0);
    assert!(run.records.iter().all(|r| r.block != Some(100)), "nothing follows");
    // the axis stays where it is, up to v Ta, and the trace continues until it is at rest
    let here = run.records[raised].axes[0].act;
    assert!((here - run.records[raised].axes[0].set).abs() > 1.0, "far from its target");
    assert!(run.records[raised..].iter().all(|r| (r.axes[0].act - here).abs() < 0.08));
    let [.., before, last] = run.records.as_slice() else { panic!("an empty trace") };
    assert!((last.axes[0].act - before.axes[0].act).abs() < 1.1e-4, "0.1 mm/s");
    assert!(last.axes[0].lag.abs() < 0.02, "{}", last.axes[0].lag);
}

/// A run with lag monitoring on X only, and the cycle of its error.
fn lag_monitor(kind: u32, settings: &str) -> (Run, Option<usize>) {
    let all = format!("X.getriebe[0]: {settings}, slep_ueberw_typ={kind}");
    let run = run("%P\nG90 G01 X100 Y40 F6000\nX0 Y0\nM30\n", &all);
    let error = run.diagnostics.iter().find(|d| d.is_error());
    let at = error.map(|d| usize::try_from(d.cycle.unwrap()).unwrap());
    if at.is_some() {
        assert_eq!(run.ids(), [70020], "the reaction raises nothing more: {:?}", run.diagnostics);
    }
    (run, at)
}

/// Type 4: the limit itself decides. Reaction class 8: the set position is frozen and the loop opened, so that the drive stops within its
/// own time constant; the rest of the group brakes along the path.
#[test]
fn following_error_of_type_4() {
    let (run, at) = lag_monitor(4, "slep_max=1000, slep_min=1000");
    let at = at.unwrap();
    let first = run.axis(0, |a| a.lag).iter().position(|lag| lag.abs() > 0.1).unwrap();
    assert_eq!(at, first);
    assert!(run.totals.aborted);
    let frozen = run.records[at].axes[0].ipo;
    let stopping = &run.records[at + 1..];
    assert!(
        stopping
            .iter()
            .all(|r| (r.axes[0].set - frozen).abs() <= 0.0 && r.axes[0].cmd.abs() <= 0.0)
    );
    // v' = -v / Ta: each step is exp(-T / Ta) of the one before
    let act: Vec<f64> = run.records[at + 1..].iter().map(|r| r.axes[0].act).collect();
    let steps: Vec<f64> = act.windows(2).map(|w| w[1] - w[0]).collect();
    for w in steps.windows(2) {
        assert!((w[1] - w[0] * libm::exp(-1.0 / 5.0)).abs() < 1e-12, "{w:?}");
    }
    assert!(steps[0] > 1e-3 && *steps.last().unwrap() < 1e-4, "until it is at rest");
    // Y: braking with the limits of the path, not frozen
    let y: Vec<f64> = stopping.iter().map(|r| r.axes[1].set).collect();
    assert!(y[0] > run.records[at].axes[1].set && y.windows(2).all(|w| w[1] >= w[0]));
    assert!(run.records.last().unwrap().axes[1].vel.abs() <= 0.0);
    // suppressed, or a limit that is wide enough: no message
    assert_eq!(lag_monitor(4, "slep_max=25000, slep_min=25000").1, None);
}
