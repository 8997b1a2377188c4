//! Events after the path has come to rest: arrival of the axes, waits that cannot end, stops after an error.

use kontur_interpreter::diag::{Diagnostic, Id};
use kontur_interpreter::record::Rest;
use kontur_tests::{Run, machine, run, run_on, run_with_inputs, sample_machine};

fn errors(run: &Run) -> Vec<&Diagnostic> {
    run.diagnostics.iter().filter(|d| d.is_error()).collect()
}

fn line(d: &Diagnostic) -> u32 {
    d.source.as_ref().map_or(0, |s| s.line)
}

/// The only error of a run: its kontur number, axis and line.
fn only(run: &Run) -> (Id, String, u32) {
    let [d] = errors(run)[..] else { panic!("{:?}", run.diagnostics) };
    (d.id, d.axis.as_ref().unwrap().name.clone(), line(d))
}

const G60: &str = "%P\nG90\nG60 G01 X10 F6000\nY5\nM30\n";

/// A force that never goes away keeps the axis 0.1 mm from its target (force x Ta / Kv): this is reported within one settling time of a
/// standstill, where the wait used to have no end.
#[test]
fn a_wait_that_cannot_end() {
    let off = "X.getriebe[0].position_settling_time=0";
    let run = run_with_inputs(machine(&[off]), G60, &[(0.0, "X_force_mm_s2", -1000.0)]);
    assert_eq!(only(&run), (Id::Kontur(130), "X".to_owned(), 3));
    assert!(run.totals.aborted);
    let d = errors(&run)[0];
    let text = d.text.as_str();
    assert!(
        text.contains("axis X") && text.contains("0.1 mm") && text.contains("0.01 mm"),
        "{text}"
    );
    let rest = run.records.iter().rposition(|r| (r.axes[0].lag - 0.1).abs() > 1e-4).unwrap();
    let said = usize::try_from(d.cycle.unwrap()).unwrap();
    assert!(said - rest < 2000, "{said} {rest}: 1 s is the settling time of a list without one");
    // the force of the plant itself, and one that oscillates by about 0.1 mm without end
    for disturbance in ["amplitude=-1000", "amplitude=-1000, frequency=0"] {
        let settings = format!("{off}; kontur.axis[1].plant.disturbance: {disturbance}");
        assert_eq!(only(&kontur_tests::run(G60, &settings)).0, Id::Kontur(130));
    }
}

/// The trace ends when the axes have arrived; the totals say how long that took: ln(lag / window) / Kv within some cycles of the lag of
/// the drive.
#[test]
fn the_end_waits_for_the_axes() {
    let run = run("%P\nG90\nG01 X100 F6000\nM30\n", &[]);
    assert_eq!(run.diagnostics, []);
    let last = run.records.last().unwrap();
    assert!((last.axes[0].act - 100.0).abs() <= 0.01, "{}", last.axes[0].act);
    let rest = run.records.iter().position(|r| r.axes[0].set >= 100.0).unwrap();
    assert_eq!(run.rested(Rest::Arrival), run.records.len() - 1 - rest);
    let stop = &run.totals.stops.axes[&0];
    assert_eq!((stop.0, stop.1.source.line), (1, 3));
    // t2 - t1 is the value in the trace and follows from the positions
    assert!((stop.1.settling_s - last.axes[0].settling_s).abs() < 1e-12);
    assert!((stop.1.settling_s - run.rested(Rest::Arrival) as f64 * run.cycle_s).abs() < 2e-3);
    let ramp = &run.records[rest..];
    assert!(ramp.windows(2).all(|w| w[1].axes[0].settling_s > w[0].axes[0].settling_s - 1e-12));
}

/// An error of one side of a gantry bridge brakes both along the path.
#[test]
fn both_sides_of_a_gantry() {
    // a following error of the slave in full motion
    let lag = "X2.getriebe[0]: slep_ueberw_typ=4, slep_max=10000, slep_min=10000, kv=2000";
    let run = run_on(sample_machine("gantry", lag), "%P\nG90\nG01 X400 F30000\nM30\n");
    assert_eq!(only(&run).0, Id::Vendor(70020));
    let most = |axis: usize| run.records.iter().map(|r| r.axes[axis].acc.abs()).fold(0.0, f64::max);
    let slave = run.records[0].axes.len() - 1;
    for axis in [0, slave] {
        assert!(most(axis) <= 6000.0 * 1.0001, "axis {axis}: {} mm/s2", most(axis));
    }
    for r in &run.records {
        assert!((r.axes[0].set - r.axes[slave].set).abs() < 1e-9, "they stay together");
    }
}

/// P-AXIS-00236 and P-AXIS-00532 of a spindle: a stop that takes too long, in degrees.
#[test]
fn a_spindle_that_does_not_arrive() {
    let late = run(
        "%P\nS[M19 POS=90]\nG04 5\nM30\n",
        &["S.getriebe[0].kv=100", "S.getriebe[0].position_settling_time=10000"],
    );
    assert_eq!(only(&late).0, Id::Vendor(70082));
    let text = &errors(&late)[0].text;
    assert!(text.contains("deg") && !text.contains("mm"), "{text}");
}

/// `#CHANNEL INIT [ACTPOS]` (206709515): the actual position becomes the set position. The set position goes back by the lag, and the
/// axis, whose encoder keeps counting, moves to it without a jump.
#[test]
fn an_actual_position_that_is_taken_over_lets_the_axis_move() {
    let run = kontur_tests::run("G01 X10 F6000\n#CHANNEL INIT [ACTPOS]\nG04 1\nM30\n", &[]);
    assert_eq!(run.ids(), [0_u32; 0], "{:?}", run.diagnostics);
    let (set, act) = (run.axis(0, |a| a.set), run.axis(0, |a| a.act));
    let taken = (1..set.len()).find(|k| set[*k] < set[k - 1]).unwrap();
    let lag = set[taken - 1] - act[taken - 1];
    assert!(lag > 1e-4, "{lag}");
    assert!((set[taken] - act[taken - 1]).abs() < 1e-9, "{} {}", set[taken], act[taken - 1]);
    // in its motion the axis was slowing down; at no time is it faster, and it ends at its new set position
    let most = (act[taken - 1] - act[taken - 2]).abs();
    for k in taken..act.len() {
        assert!((act[k] - act[k - 1]).abs() <= most * (1.0 + 1e-9), "{k}");
    }
    assert!((act[act.len() - 1] - set[taken]).abs() < 1e-6);
}
