//! Override of spindles (`S[OVERRIDE ..]`) and what the program reads of them (`V.SPDL`, `V.SPDL_PROG`).

use super::{Event, Sync, clean, run_on, said};
use crate::exec::step::SpindleMotion;

fn motions(text: &str) -> Vec<SpindleMotion> {
    let run = clean(text);
    let found = run.events().into_iter().filter_map(|e| match e {
        Event::Spindle { motion, .. } => Some(*motion),
        _ => None,
    });
    found.collect()
}

/// 208269707: the override acts on a spindle that moves, at once and until it is changed.
#[test]
fn an_override_scales_the_speed_of_a_spindle() {
    use SpindleMotion::{Clockwise, CounterClockwise, Stop};
    assert_eq!(
        motions(
            "S[M3 REV1000]\nS[OVERRIDE SPEED_FACT=20]\nS[REV500]\nM4\nS[OVERRIDE SPEED_FACT=150]\nM5\nS[OVERRIDE SPEED_FACT=100]\nM3\nM30\n"
        ),
        [
            Clockwise { rpm: 1000.0 },
            Clockwise { rpm: 200.0 },
            Clockwise { rpm: 100.0 },
            CounterClockwise { rpm: 100.0 },
            CounterClockwise { rpm: 750.0 },
            Stop,
            Clockwise { rpm: 500.0 },
        ]
    );
    // 10 revolutions at half of 1000 rev/min
    let run = clean("S1000 M3\nS[OVERRIDE SPEED_FACT=50]\nG04 S10\nM30\n");
    let waits =
        |sync: &&Sync| matches!(sync, Sync::Dwell { seconds } if (seconds - 1.2).abs() < 1e-12);
    assert!(run.syncs().iter().any(waits), "{:?}", run.syncs());
}

#[test]
fn mistakes_in_an_override() {
    assert_eq!(said("S[OVERRIDE SPEED_FACT=20 SPEED_FACT=30]"), ["21422"]);
    assert_eq!(said("S[OVERRIDE]"), ["21867"]);
    assert_eq!(said("S[M3 OVERRIDE SPEED_FACT=20]")[0], "21867");
    assert_eq!(said("S[OVERRIDE SPEED_FACT=0]").len(), 1);
    // what counts with the speed of the main spindle
    for text in ["G95 F0.1 G01 X1", "G33 Z5 K1", "M5\nG63 Z5 F100"] {
        let ids = said(&format!("M3 S500\nS[OVERRIDE SPEED_FACT=50]\n{text}"));
        assert!(ids.contains(&"K-0019".to_owned()), "{text}: {ids:?}");
    }
}

/// The list of 207909259.
#[test]
fn variables_of_spindles() {
    let value = |before: &str, name: &str| {
        let run = run_on(
            &["Z.kenngr.achs_mode=0x41"],
            &format!("G18 G00 X20 Z30\n{before}\nG94 G01 F1000 Y[{name} / 100]\nM30\n"),
        );
        assert!(!run.ids().iter().any(|id| !id.starts_with("K-")), "{name}: {:?}", run.ids());
        run.end[1] * 100.0
    };
    for (before, name, wanted) in [
        ("M3 S1500", "V.SPDL_PROG.SPEED.S", 1500.0),
        ("M3 S1500\nS[OVERRIDE SPEED_FACT=50]", "V.SPDL_PROG.SPEED.S", 1500.0),
        ("", "V.SPDL_PROG.MOVE_CMD.S", 5.0),
        ("M3 S5", "V.SPDL_PROG.MOVE_CMD.S", 3.0),
        ("M4 S5", "V.SPDL_PROG.MOVE_CMD.S", 4.0),
        ("S[M3 REV5]\nM5", "V.SPDL_PROG.MOVE_CMD.S", 5.0),
        ("M19 S200 S.POS100", "V.SPDL_PROG.POSITION.S", 100.0),
        ("S100\nG04 S2", "V.SPDL_PROG.DWELL_ROT_COUNT.S", 2.0),
        ("G196 S1200", "V.SPDL_PROG.MAX_SPEED.S", 1200.0),
        ("M3\nG96 S40", "V.SPDL_PROG.CONST_CUT_SPEED.S", 40.0),
        ("", "V.SPDL_PROG.CONST_CUT_SPEED.S", 0.0),
        ("", "V.SPDL.NBR_IN_CHANNEL", 1.0),
        ("", "V.SPDL.PLC_CONTROL.S", 0.0),
        ("V.SPDL.M_FCT_FREE=0", "V.SPDL.M_FCT_FREE", 0.0),
    ] {
        let is = value(before, name);
        assert!((is - wanted).abs() < 1e-9, "{before}: {name} is {is}, not {wanted}");
    }
    assert_eq!(said("V.SPDL.M_FCT_FREE=1"), ["K-0019"]);
    assert_eq!(said("V.SPDL_PROG.SPEED.S=1"), ["20100"]);
    assert_eq!(said("P1=V.SPDL_PROG.SPEED.S9"), ["21947"]);
}
