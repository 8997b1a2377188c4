//! When the words of the main spindle take effect: before, with or after the motion of their block.

use kontur_tests::{run_on, sample_machine};

/// With MVS_SVS for M3 (P-CHAN-00045) the motion in the same block begins when the spindle has reached its speed (M and H functions
/// 286059787): its actual speed is 0.9 times that of the program, or what P-AXIS-00217 says (117211787), or the set speed is whole.
#[test]
fn a_motion_waits_for_its_spindle() {
    let waits = "channel.spindel[0].m3_synch=MVS_SVS";
    // actual and set speed in rpm some cycles before the path begins
    let before = |settings: &[&str], cycles: usize| {
        let run = run_on(sample_machine("two_spindles", settings), "S1000 M3 G01 F1000 X10\nM30\n");
        let moved = run.records.iter().position(|r| r.path.v_mm_s > 0.0).unwrap();
        let speed = |at: [f64; 2]| (at[1] - at[0]) / run.cycle_s / 6.0;
        let k = moved.max(cycles + 1) - cycles;
        let axis = [k - 1, k].map(|k| run.records[k].axes[3]);
        (speed(axis.map(|a| a.act)), speed(axis.map(|a| a.set)))
    };
    assert!(before(&[], 0).0 < 500.0);
    // 0 is the default (diagnosis 262570123)
    for (percent, share) in [("100", 0.9), ("0", 0.9), ("500", 0.5), ("10", 0.99)] {
        let band = format!("S.kenngr.vb_prozent={percent}");
        let has_reached = |(act, set): (f64, f64)| act >= 1000.0 * share || set > 999.5;
        let [early, reached] = [3, 1].map(|cycles| before(&[waits, &band], cycles));
        assert!(!has_reached(early) && has_reached(reached), "{percent}: {early:?} {reached:?}");
    }
    let (_, set) = before(&[waits, "S.kenngr.vb_prozent=500"], 1);
    assert!(set < 1000.0, "the actual speed decides: {set}");
    // an encoder that turns on by 0 or 0.1 deg in a cycle, at 0.06 deg per cycle
    let coarse = [waits, "S.getriebe[0].wegaufn=1000", "S.getriebe[0].wegaufz=1"];
    let run = run_on(sample_machine("two_spindles", &coarse), "S10 M3 G01 F1000 X10\nM30\n");
    assert!(run.records.len() < 2000, "{}", run.records.len());
}

/// Kinds of synchronisation (149163787, 287516299): with MVS_SVS the state is reached before the motion of the block, MVS_SNS and MOS
/// begin with the motion, MNS_SNS begins only after it, and the path waits for all but MOS. For M4, M5 and the S word, from 2000 rev/min:
/// speed at the beginning and at the end of the motion of the block, and when the next one begins.
#[test]
fn functions_act_when_the_list_says() {
    let program =
        |word: &str| format!("S2000 M3\nG04 3\nG60 G01 F600 X1\nG60 {word} X2\nG60 X3\nM30\n");
    for (word, name, there) in [("M4", "m4", -2000.0), ("M5", "m5", 0.0), ("S400", "s", 400.0)] {
        for (kind, starts_changed, waits) in [
            ("MVS_SVS", Some(true), true),
            ("MVS_SNS", Some(false), true),
            ("MOS", Some(false), false),
            ("MNS_SNS", None, true),
        ] {
            let setting = format!("channel.spindel[0].{name}_synch={kind}");
            let settings = [&setting[..], "S.kenngr.vb_prozent=1"];
            let run = run_on(sample_machine("two_spindles", &settings), &program(word));
            assert_eq!(run.ids(), [0_u32; 0], "{:?}", run.diagnostics);
            let moves = |line: u32| {
                let moving: Vec<usize> = (0..run.records.len())
                    .filter(|k| run.records[*k].line == line && run.records[*k].path.v_mm_s > 0.0)
                    .collect();
                (moving[0], moving[moving.len() - 1])
            };
            let rpm = |k: usize| {
                let set = |k: usize| run.records[k].axes[3].set;
                (set(k) - set(k - 1)) / run.cycle_s / 6.0
            };
            let ((first, last), (next, _)) = (moves(4), moves(5));
            let is = |k: usize, want: f64| (rpm(k) - want).abs() < 1e-6;
            let case = format!("{word} {kind}: {} {} {}", rpm(first), rpm(last), rpm(next));
            match starts_changed {
                Some(true) => assert!(is(first, there), "{case}"),
                Some(false) => assert!(!is(first, there) && !is(last, 2000.0), "{case}"),
                None => assert!(is(first, 2000.0) && is(last, 2000.0), "{case}"),
            }
            assert_eq!(is(next, there), waits, "{case}");
        }
    }
}
