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
