//! `#MAIN SPINDLE`: which spindle S and M3 to M5 are for.

use kontur_tests::{Run, run_on, sample_machine};

/// Speed of a spindle in rev/min at the end of a line of the program.
fn rpm(run: &Run, spindle: usize, line: u32) -> f64 {
    let last = run.records.iter().rposition(|r| r.line == line).unwrap();
    let set = |k: usize| run.records[k].axes[3 + spindle].set;
    (set(last) - set(last - 1)) / run.cycle_s / 6.0
}

/// After the manual's example (changing the main spindle): by name, by logical number, and back to that of the lists.
#[test]
fn the_main_spindle_changes() {
    let run = run_on(
        sample_machine("two_spindles", &[]),
        "S100 M3 S2[REV200 M3]\nG04 0.5\n#MAIN SPINDLE [S2]\nS110 M3\nG04 0.5\n#MAIN SPINDLE [4]\n\
         S120 M4\nG04 0.5\n#MAIN SPINDLE [5]\nM5\n#MAIN SPINDLE\nS150 M3\nG04 0.5\nM5\nG04 0.5\nM30\n",
    );
    assert_eq!(run.ids(), [0_u32; 0], "{:?}", run.diagnostics);
    for (line, speeds) in [
        (2, [100.0, 200.0]),
        (5, [100.0, 110.0]),
        (8, [-120.0, 110.0]),
        (13, [150.0, 0.0]),
        (15, [0.0, 0.0]),
    ] {
        for (spindle, want) in speeds.into_iter().enumerate() {
            let is = rpm(&run, spindle, line);
            assert!((is - want).abs() < 1e-6, "line {line}, spindle {spindle}: {is}, not {want}");
        }
    }
}

/// With MVS_SVS for M3 (P-CHAN-00045) the motion beside it begins when the spindle has its speed (M and H functions 286059787).
#[test]
fn a_motion_waits_for_its_spindle() {
    let first_moved = |settings: &[&str]| {
        let run = run_on(sample_machine("two_spindles", settings), "S1000 M3 G01 F1000 X10\nM30\n");
        let moved = run.records.iter().position(|r| r.path.v_mm_s > 0.0).unwrap();
        let set = |k: usize| run.records[k].axes[3].set;
        (set(moved) - set(moved.saturating_sub(1))) / run.cycle_s / 6.0
    };
    assert!(first_moved(&[]) < 500.0);
    let waited = first_moved(&["channel.spindel[0].m3_synch=MVS_SVS"]);
    assert!((waited - 1000.0).abs() < 1e-6, "{waited}");
}

/// Programmable override (208269707): it scales the speed of its spindle alone, at once, for M3 and M4, until it is changed.
#[test]
fn an_override_acts_on_its_spindle_alone() {
    let run = run_on(
        sample_machine("two_spindles", &[]),
        "S[M3 REV500] S2[M3 REV200]\nG04 1\nS[OVERRIDE SPEED_FACT=20]\nG04 1\nS[REV400 M4]\nG04 1\n\
         S[OVERRIDE SPEED_FACT=100]\nG04 1\nM5\nS2[M5]\nG04 1\nM30\n",
    );
    assert_eq!(run.ids(), [0_u32; 0], "{:?}", run.diagnostics);
    for (line, speeds) in
        [(2, [500.0, 200.0]), (4, [100.0, 200.0]), (6, [-80.0, 200.0]), (8, [-400.0, 200.0])]
    {
        for (spindle, want) in speeds.into_iter().enumerate() {
            let is = rpm(&run, spindle, line);
            assert!((is - want).abs() < 1e-6, "line {line}, spindle {spindle}: {is}, not {want}");
        }
    }
}
