//! M19: the angle that holds, the way round, the speed; G130 of a spindle.

use kontur_tests::{Run, run};

/// Set angle of the spindle at the end of a line of the program, counted on over the turns, in deg.
fn angle(run: &Run, line: u32) -> f64 {
    run.records[run.records.iter().rposition(|r| r.line == line).unwrap()].axes[3].set
}

/// Speeds of the spindle in rev/min while a line is in work.
fn speeds(run: &Run, line: u32) -> Vec<f64> {
    let at = |w: &[kontur_interpreter::record::CycleRecord]| {
        (w[1].line == line).then(|| (w[1].axes[3].set - w[0].axes[3].set) / run.cycle_s / 6.0)
    };
    run.records.windows(2).filter_map(at).collect()
}

fn turns(deg: f64) -> f64 {
    deg.rem_euclid(360.0)
}

/// The page's program (spindle-specific positioning, 208198923), with a pause after each block so that it ends.
#[test]
fn the_angle_holds_and_the_way_round_is_told() {
    let run = run(
        "%P\nS[REV100 POS45 M19 M3]\nG04 1\nS[M03 REV1000]\nG04 1\nS[M19 M4 REV150]\nG04 2\nS[M05]\nG04 0.5\n\
         S[M19]\nG04 0.5\nS[REV200 M19 POS90]\nG04 1\nS[M03 REV1000]\nG04 1\nS[M05]\nG04 1\nM30\n",
        &[],
    );
    assert_eq!(run.diagnostics, []);
    assert!((angle(&run, 3) - 45.0).abs() < 1e-9, "{}", angle(&run, 3));
    assert!(speeds(&run, 3).iter().all(|v| *v >= 0.0));
    // counter-clockwise out of M3: it stops first, and comes from above
    assert!((turns(angle(&run, 7)) - 45.0).abs() < 1e-6, "{}", angle(&run, 7));
    let least = speeds(&run, 7).into_iter().fold(0.0, f64::min);
    assert!((least + 150.0).abs() < 1e-6, "{least}");
    // it stands where M19 would turn it
    assert!((angle(&run, 11) - angle(&run, 9)).abs() < 1e-9);
    assert!((angle(&run, 13) - angle(&run, 11) - 45.0).abs() < 1e-6);
    let most = speeds(&run, 13).into_iter().fold(0.0, f64::max);
    assert!(most <= 200.0 + 1e-6 && most > 190.0, "{most}");
}

/// From rest the shorter way, out of a rotation in its direction, with M3 or M4 in theirs.
#[test]
fn the_shorter_way_and_the_direction_of_rotation() {
    for (block, want) in [
        ("M19 S200 S.POS100", 100.0),
        ("M19 S200 S.POS=100", 100.0),
        ("M19 S200 S.POS 100", 100.0),
        ("M19 S200 S.POS270", -90.0),
        ("M19 M3 S200 S.POS270", 270.0),
        ("M4 M19 S200 S.POS100", -260.0),
        ("S[M19 REV200 POS=200]", -160.0),
        ("S[M19 REV200 POS180]", 180.0),
        ("M19 S200", 0.0),
    ] {
        let run = run(&format!("%P\n{block}\nG04 1\nM30\n"), &[]);
        assert_eq!(run.diagnostics, [], "{block}");
        let is = angle(&run, 3);
        assert!((is - want).abs() < 1e-9, "{block}: {is}, not {want}");
    }
    let run = run("%P\nM4 S500\nG04 1\nM19 S.POS10\nG04 2\nM30\n", &[]);
    assert!((turns(angle(&run, 5)) - 10.0).abs() < 1e-6);
    assert!(speeds(&run, 5).iter().all(|v| *v <= 1e-9));
}

/// S[G130=70]: the ramp takes 1 / 0.7 of its time.
#[test]
fn the_acceleration_of_a_spindle_is_weighed() {
    let ramp_s = |text: &str| {
        let run = run(&format!("%P\n{text}\nM3 S6000\nG04 3\nM30\n"), &[]);
        assert_eq!(run.diagnostics, []);
        let slow = run.records.windows(2).filter(|w| {
            let v = (w[1].axes[3].set - w[0].axes[3].set) / run.cycle_s / 6.0;
            v > 1.0 && v < 5999.0
        });
        slow.count() as f64 * run.cycle_s
    };
    let (full, weighed) = (ramp_s(""), ramp_s("S[G130=70]"));
    assert!(full > 0.3, "{full}");
    assert!((weighed / full - 1.0 / 0.7).abs() < 0.01, "{weighed} {full}");
}
