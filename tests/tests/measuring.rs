//! Measuring runs with a probe from the real-time inputs: G100 with its types, G106, G310, G101 and G102.
//!
//! Programs after the examples of the TF5200 programming manual (206171147, 206177803, 206185227, 206197003, 206208011),
//! with targets as printed there. The expected results are known beforehand: the points where a straight line meets the surface.

use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::machine::Machine;
use kontur_kit::near;
use kontur_tests::{Run, machine, run_with_inputs};

/// The built-in machine with a linear slope of 1000 mm/s2 in X and Y.
fn linear(more: &[&str]) -> (Machine, Vec<Diagnostic>) {
    let stages = ["a_stufe_1", "a_stufe_2", "a_grenz_stufe_1", "a_grenz_stufe_2"];
    let mut settings: Vec<String> =
        stages.iter().map(|s| format!("X,Y.getriebe[0].lslope_profil.{s}=1000")).collect();
    settings.extend(more.iter().map(ToString::to_string));
    machine(&settings.iter().map(String::as_str).collect::<Vec<_>>())
}

/// The output of `#MSG` in the program, in order.
fn said(run: &Run) -> Vec<String> {
    let own = run.diagnostics.iter().filter(|d| d.id.to_string() == "K-0081");
    own.map(|d| d.text.clone()).collect()
}

fn end(run: &Run, axis: usize) -> f64 {
    run.records.last().unwrap().axes[axis].ipo
}

/// From X5 Y0 to X10 Y10: a surface at X8 is met at Y6.
const TYPE_1: &str = "%MEAS_RUN\n#SLOPE [TYPE=STEP]\nN10 G90 G00 X0 Y0 Z0\nN20 X5\nN30 G100 X10 Y10 F500\n\
    #MSG [\"%.4f %.4f %d %.4f %.4f\", V.A.MESS.X, V.A.MESS.Y, V.A.MERF.X, V.A.MOFFS.X, V.A.MOFFS.Y]\n";

#[test]
fn the_surface_is_measured_and_the_rest_of_the_run_is_dropped() {
    let program = format!("{TYPE_1}N40 G01 X7\nN50 M30\n");
    let run = run_with_inputs(linear(&[]), &program, &[(0.0, "X_probe_mm", 8.0)]);
    assert_eq!(said(&run), ["8.0000 6.0000 1 -2.0000 -4.0000"]);
    assert!(run.errors().is_empty() && !run.totals.aborted);
    let of_run = |line: u32| run.records.iter().filter(move |r| r.line == line);
    // every set position of the run lies on its line, and it ends soon after the surface: by the lag and the braking distance, not at the
    // target
    for r in of_run(5) {
        near(r.axes[1].ipo, 2.0 * (r.axes[0].ipo - 5.0), 1e-9);
    }
    let rest = of_run(5).next_back().unwrap();
    let (x, y) = (rest.axes[0].ipo, rest.axes[1].ipo);
    assert!(x > 8.0 && x < 8.2, "{x}");
    // N40 continues from there: Y stays, X goes back
    near(end(&run, 0), 7.0, 1e-9);
    near(end(&run, 1), y, 1e-9);
}

/// A signal at a given time: braking from v = 500/60 mm/s takes v^2 / 2a, where a is what the steeper axis (2 / sqrt 5 of the distance)
/// reaches with 1000 mm/s2.
#[test]
fn a_signal_at_a_time_brakes_the_path_from_the_next_cycle_on() {
    let program = format!("{TYPE_1}N50 M30\n");
    let run = run_with_inputs(linear(&[]), &program, &[(0.5, "probe", 1.0), (0.6, "probe", 0.0)]);
    let v = 500.0 / 60.0;
    let at = &run.records[(0.5 / run.cycle_s).round() as usize];
    near(at.path.v_mm_s, v, 1e-9);
    let s = run.records.last().unwrap().path.s_mm;
    let a = 1000.0 * 5.0_f64.sqrt() / 2.0;
    near(s - at.path.s_mm, v * v / (2.0 * a), 1e-9);
    // the latched values are the actual positions of that cycle
    let latched = format!("{:.4} {:.4} 1", at.axes[0].act, at.axes[1].act);
    assert!(said(&run)[0].starts_with(&latched), "{:?}, {latched}", said(&run));
}

/// Without a signal the run goes to its target; the type, the list and the program decide what that means.
#[test]
fn a_missing_signal() {
    let program = format!("{TYPE_1}N50 M30\n");
    let run = run_with_inputs(linear(&[]), &program, &[]);
    assert_eq!(said(&run), ["0.0000 0.0000 0 0.0000 0.0000"]);
    near(end(&run, 1), 10.0, 1e-9);
    assert!(run.errors().is_empty());
    let listed = run_with_inputs(linear(&["channel.meas_error_no_signal=1"]), &program, &[]);
    assert_eq!(listed.errors(), ["K-0133"]);
    let commanded = program.replace("N10", "#MEAS [ERR_NO_SIGNAL=1]\nN10");
    assert_eq!(run_with_inputs(linear(&[]), &commanded, &[]).errors(), ["K-0133"]);
    // the program overrides the list in both directions
    let excused = program.replace("N10", "#MEAS [ERR_NO_SIGNAL=0]\nN10");
    let run = run_with_inputs(linear(&["channel.meas_error_no_signal=1"]), &excused, &[]);
    assert!(run.errors().is_empty());
}

/// Type 2: one axis at the speed of P-AXIS-00215, whatever F is; a missing signal is an error.
#[test]
fn one_axis_at_its_own_speed() {
    let program = "%MEAS_RUN\n#MEAS MODE [2]\nN10 G90 G00 X0 Y0 Z0\nN20 Y5\nN30 G100 X10\n\
        #MSG [\"%.4f %d\", V.A.MESS.X, V.G.MEAS_TYPE]\nN40 G01 X7 F6000\nN50 M30\n";
    let run = run_with_inputs(linear(&[]), program, &[(0.0, "X_probe_mm", 8.0)]);
    assert_eq!(said(&run), ["8.0000 2"]);
    let most = run.records.iter().filter(|r| r.line == 5).map(|r| r.path.v_mm_s);
    near(most.fold(0.0, f64::max), 16.666, 1e-9);
    assert_eq!(run_with_inputs(linear(&[]), program, &[]).errors(), ["K-0133"]);
}

/// Type 3: with G106 the path continues to the target, without G106 it stops.
#[test]
fn through_to_the_target() {
    let of = |g106: &str| {
        let run = TYPE_1.replace("F500", &format!("F500 {g106}"));
        let program = format!("#MEAS [TYPE=3]\n{run}N50 M30\n");
        run_with_inputs(linear(&[]), &program, &[(0.0, "Y_probe_mm", 6.0)])
    };
    let (through, stopped) = (of("G106"), of(""));
    assert_eq!(said(&through), said(&stopped));
    assert_eq!(said(&through), ["8.0000 6.0000 1 -2.0000 -4.0000"]);
    near(end(&through, 0), 10.0, 1e-9);
    // without a drop in speed at the signal
    let slow = through
        .records
        .iter()
        .filter(|r| r.line == 6 && r.axes[0].ipo > 6.0 && r.axes[0].ipo < 9.0);
    assert!(slow.into_iter().all(|r| (r.path.v_mm_s - 500.0 / 60.0).abs() < 1e-9));
    assert!(end(&stopped, 0) < 8.2);
}

/// G310: with a signal the program continues at the label from the positions of the axes, without a signal with the block after it.
#[test]
fn an_interrupted_motion_jumps() {
    let program = "#MEAS MODE [5]\nN10 G00 X0 Y0\nN20 G310 G01 F1000 X10 Y20 $GOTO[N_LABEL]\nN30 G01 X20\n\
        N40 $GOTO[ENDE]\nN50 [N_LABEL] X0 Y0\nN60 [ENDE] M30\n";
    let hit = run_with_inputs(linear(&[]), program, &[(0.0, "X_probe_mm", 5.0)]);
    assert!(hit.errors().is_empty());
    near(end(&hit, 0), 0.0, 1e-9);
    assert!(hit.records.iter().all(|r| r.axes[0].ipo < 5.5 && r.line != 4));
    let missed = run_with_inputs(linear(&[]), program, &[]);
    near(end(&missed, 0), 20.0, 1e-9);
    near(end(&missed, 1), 20.0, 1e-9);
}

/// Measuring offset = measured - target = -2, -4: with factors 1 and 7 the program is shifted by -2 and -28, effective with the next
/// absolute words, until G102.
#[test]
fn measuring_offsets() {
    let program = format!(
        "{TYPE_1}N60 G101 X1 Y7\nN70 G01 X0 Y0\n#MSG [\"%.4f %.4f\", V.A.MEIN.X, V.A.ACS.ABS.Y]\n\
         N80 G91 X1\n#MSG [\"%.4f\", V.A.ACS.ABS.X]\nN90 G90 G102 Y1\nN100 Y0 X0\nM30\n"
    );
    let run = run_with_inputs(linear(&[]), &program, &[(0.0, "X_probe_mm", 8.0)]);
    assert_eq!(said(&run)[1..], ["-2.0000 -28.0000", "-1.0000"]);
    near(end(&run, 0), -2.0, 1e-9);
    near(end(&run, 1), 0.0, 1e-9);
    assert_eq!(run_with_inputs(linear(&[]), &program, &[]).errors(), ["K-0134"]);
}

/// A measuring offset is added to the programmed position (342045451): the target of the run, programmed again, is the measured
/// surface, mirrored or not. In a turned system an offset of one axis would act on two: the pages differ, and it is refused.
#[test]
fn the_target_with_its_offset_is_the_surface() {
    let slope = "#SLOPE [TYPE=STEP]\nG90 G00 X0 Y0 Z0\n";
    // a rotation of the other axes does not matter
    for (mirror, target) in [("", "50"), ("G21", "-50"), ("G19\n#ROTATION ON [ANGLE=30]", "50")] {
        let program =
            format!("{slope}{mirror}\nG100 X{target} F600\nG101 X1\nG01 X{target}\nM30\n");
        let run = run_with_inputs(linear(&[]), &program, &[(0.0, "X_probe_mm", 20.1234)]);
        assert!(run.errors().is_empty(), "{:?}", run.errors());
        near(end(&run, 0), 20.1234, 1e-6);
    }
    for turn in ["#ROTATION ON [ANGLE=30]", "#CS ON [1,2,0,0,0,30]"] {
        let program = format!("{slope}{turn}\nG100 X50 F600\nG101 X1\nG01 X50\nM30\n");
        let run = run_with_inputs(linear(&[]), &program, &[(0.0, "X_probe_mm", 20.1234)]);
        assert!(run.errors().iter().any(|d| d.contains("K-0019")), "{turn}: {:?}", run.errors());
    }
}

/// The measured value contains the offsets, the value in the coordinates of the program does not.
#[test]
fn measured_values_and_offsets() {
    let program = "%P\nV.G.NP[1].V.X=3\nG54 G90 G00 X0\nG100 X10 F500\n\
        #MSG [\"%.4f %.4f %.4f %.4f\", V.A.MESS.X, V.A.MEAS.ACS.VALUE.X, V.A.MEAS.PCS.VALUE.X, V.A.MOFFS.X]\n\
        #MSG [\"%d\", V.A.ABS.X * 1000 - V.A.ACS.ABS.X * 1000]\nM30\n";
    let run = run_with_inputs(linear(&[]), program, &[(0.0, "X_probe_mm", 8.0)]);
    assert_eq!(said(&run), ["8.0000 8.0000 5.0000 -5.0000", "-3000"]);
}

/// A probe that is on already, and one that signals outside of a measuring run.
#[test]
fn signals_at_other_times() {
    let program = format!("{TYPE_1}N50 M30\n");
    let run = run_with_inputs(linear(&[]), &program, &[(0.01, "probe", 1.0)]);
    assert_eq!(run.ids(), [50052]);
    let run = run_with_inputs(linear(&[]), &program, &[(0.01, "probe", 1.0), (0.02, "probe", 0.0)]);
    assert!(run.errors().is_empty());
    near(end(&run, 0), 10.0, 1e-9);
}

/// A feedhold during a run only delays it.
#[test]
fn feedhold_in_a_run() {
    let program = format!("{TYPE_1}N50 M30\n");
    let inputs = [(0.0, "X_probe_mm", 8.0), (0.3, "feedhold", 1.0), (0.8, "feedhold", 0.0)];
    let held = run_with_inputs(linear(&[]), &program, &inputs);
    assert_eq!(said(&held), ["8.0000 6.0000 1 -2.0000 -4.0000"]);
}

/// The surface is not known beforehand: the check uses the target in its place, and refuses nothing that a run may do.
#[test]
fn a_check_refuses_no_measured_value() {
    let program =
        format!("{TYPE_1}N60 G101 X1\nN70 $IF V.A.MERF.X == 0\n#ERROR [ID100]\n$ENDIF\nM30\n");
    let run = run_with_inputs(linear(&[]), &program, &[(0.0, "X_probe_mm", 8.0)]);
    assert!(run.errors().is_empty() && !run.records.is_empty());
}

/// The check uses the target for the surface and never reaches the subroutine; the run does, and its rows show it.
#[test]
fn a_subroutine_that_only_the_run_reaches_is_named_in_the_trace() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.display().to_string()
    };
    file("near.nc", "N10 G01 X1 F3000\nN20 M17\n");
    let program = "N10 G100 X10 F500\nN20 $IF V.A.MESS.X < 9\nN30 L near.nc\nN40 $ENDIF\nN50 M30\n";
    let (program, inputs) = (file("part.nc", program), file("probe.csv", "t_s,X_probe_mm\n0,5\n"));
    let words = ["run", &program, "--input", &inputs, "-o", "-", "--signals", "time"];
    let output = kontur_tests::command::command(words);
    let mut lines = output.out.lines();
    assert_eq!(lines.next(), Some("t_s,line,block,file"), "{}", output.err);
    assert!(lines.next().unwrap().ends_with("part.nc"));
    assert!(output.out.lines().any(|line| line.contains(",1,10,") && line.ends_with("near.nc")));
}
