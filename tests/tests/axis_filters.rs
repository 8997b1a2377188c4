//! Axis filters and HSC filters in runs of programs. The names of the rows are those of the ledger.

use kontur_tests::{Run, largest_step, run};

/// A low-pass of order 4 at 15 Hz in one axis.
fn low_pass(axis: &str) -> [String; 3] {
    ["enable=1", "order=4", "fg_f0=15"].map(|entry| format!("{axis}.filter[0].{entry}"))
}

/// HSC mean in the path axes.
fn hsc(entries: &str) -> Vec<String> {
    let all = format!("prototype=HSC {entries}");
    let of = |axis: &'static str| {
        all.split_whitespace().map(move |e| format!("{axis}.filter[0].{e}")).collect::<Vec<_>>()
    };
    ["X", "Y", "Z"].into_iter().flat_map(of).collect()
}

fn on(program: &str, settings: &[String]) -> Run {
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    run(program, &settings)
}

fn ipo(run: &Run, axis: usize) -> Vec<f64> {
    run.axis(axis, |a| a.ipo)
}

fn set(run: &Run, axis: usize) -> Vec<f64> {
    run.axis(axis, |a| a.set)
}

/// First cycle within 1 um (0.001 deg) of a value.
fn reaches(values: &[f64], end: f64) -> usize {
    values.iter().position(|x| (x - end).abs() < 1e-3).unwrap()
}

/// `TIME_DELAY` of 2000 us in an axis: the interpolated position of two cycles before, bit for bit. Conformance: A065.
#[test]
fn an_axis_is_two_cycles_late() {
    let delay = ["enable=1", "type=TIME_DELAY", "order=1", "time_constant=2000"];
    let settings = delay.map(|entry| format!("X.filter[0].{entry}"));
    let run = on("%P\nG90 G01 X10 Y10 F6000\nG02 X20 Y0 J-10\nG01 X0 Y0\nM30\n", &settings);
    let (x, set_x) = (ipo(&run, 0), set(&run, 0));
    assert!(x.len() > 300, "{}", x.len());
    assert!(run.is_unshaped(1), "Y has no filter");
    for k in 2..x.len() {
        assert_eq!(set_x[k].to_bits(), x[k - 2].to_bits(), "cycle {k}");
    }
}

/// After the interpolator, on the axis that has the filter. Conformance: A001, A003.
#[test]
fn set_follows_the_interpolated_position() {
    let run = on("%P\nG90 G01 X10 Y10 F6000\nM30\n", &low_pass("X"));
    let (x, set_x) = (ipo(&run, 0), set(&run, 0));
    assert!(reaches(&set_x, 10.0) > reaches(&x, 10.0) + 20);
    assert!((set_x.last().unwrap() - 10.0).abs() < 1e-4);
    assert!(run.is_unshaped(1) && !run.is_unshaped(0));
}

/// Rotary axes, and modulo axes through 360 degrees. Conformance: A004, A005.
#[test]
fn rotary_axes() {
    let mut settings = low_pass("Z").to_vec();
    settings.push("Z.kenngr.achs_typ=ACHSTYP_ROTATOR".to_owned());
    let run = on("%P\nG90 G01 Z90 F3600\nM30\n", &settings);
    assert!(reaches(&set(&run, 2), 90.0) > reaches(&ipo(&run, 2), 90.0) + 20);
    assert!((set(&run, 2).last().unwrap() - 90.0).abs() < 1e-4);

    settings.push("Z.kenngr.achs_mode=0x4".to_owned());
    let run = on("%P\nG91 G01 Z400 F20000\nM30\n", &settings);
    let set = set(&run, 2);
    assert!(!run.is_unshaped(2));
    let unwrapped = |w: &[f64]| (w[1] - w[0] + 180.0).rem_euclid(360.0) - 180.0;
    let steps: Vec<f64> = set.windows(2).map(unwrapped).collect();
    assert!(steps.iter().all(|s| s.abs() <= 20000.0 / 60.0 * 1e-3 + 1e-9));
    assert!((steps.iter().sum::<f64>() - 400.0).abs() < 1e-3);
}

/// The speed of a spindle without ramps is smoothed. Conformance: A006.
#[test]
fn spindles() {
    let mut settings = low_pass("S").to_vec();
    for ramp in ["tr_beschl_zu", "tr_beschl_ab", "tr_brems_zu", "tr_brems_ab"] {
        settings.push(format!("S.getriebe[0].slope_profil.{ramp}=0"));
    }
    let run = on("%P\nS1000 M3\nG04 1\nM5\nG04 1\nM30\n", &settings);
    let jump = |x: &[f64]| {
        let speed: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
        let acc: Vec<f64> = speed.windows(2).map(|w| w[1] - w[0]).collect();
        largest_step(&acc)
    };
    let (ipo, set) = (ipo(&run, 3), set(&run, 3));
    assert!(ipo.last().unwrap() > &1000.0, "the spindle turns");
    assert!(jump(&set) < 0.5 * jump(&ipo), "{} {}", jump(&set), jump(&ipo));
}

/// The program does not switch standard filters. Conformance: A008.
#[test]
fn no_command_switches_a_standard_filter() {
    let run = on("%P\n#FILTER OFF\nG90 G01 X10 F6000\nM30\n", &low_pass("X"));
    assert!(!run.totals.aborted, "{:?}", run.diagnostics);
    assert!(reaches(&set(&run, 0), 10.0) > reaches(&ipo(&run, 0), 10.0) + 20);
}

/// Prepared by the list, effective by the command; `enable` has no influence. Conformance: A009, A087, A104.
#[test]
fn the_command_makes_hsc_effective() {
    let without = "%P\nG90 G01 X100 F6000\nM30\n";
    let with = "%P\n#FILTER ON[HSC]\nG90 G01 X100 F6000\nM30\n";
    for entries in ["type=8 order=20 enable=1", "type=8 order=20 enable=0"] {
        assert!(on(without, &hsc(entries)).is_unshaped(0), "{entries}");
        let run = on(with, &hsc(entries));
        assert!((run.delay_cycles(3) - 10.0).abs() < 1e-6, "{entries}: {}", run.delay_cycles(3));
    }
    let run = on(with, &hsc("type=8"));
    assert!((run.delay_cycles(3) - 5.0).abs() < 1e-6, "{}", run.delay_cycles(3));
}

/// Conformance: A071.
#[test]
fn both_spellings_of_filter_hsc() {
    let program = |word: &str| format!("%P\n#FILTER {word}\nG90 G01 X10 Y3 F6000\nM30\n");
    let settings = hsc("type=8 order=20");
    let (one, other) = (on(&program("ON[HSC]"), &settings), on(&program("ON [HSC]"), &settings));
    assert_eq!(one.diagnostics, []);
    assert_eq!(one.records, other.records);
}

/// Off and on with another order during machining, without a jump. Conformance: A073, A074.
#[test]
fn hsc_switches_between_blocks() {
    let settings = hsc("type=8 order=20");
    let run = on(
        "%P\n#FILTER ON[HSC]\nG90 G01 X100 F6000\n#FILTER OFF[HSC]\nX200\n#FILTER ON [HSC ORDER=40]\nX300\nM30\n",
        &settings,
    );
    assert!(!run.totals.aborted, "{:?}", run.diagnostics);
    assert!((run.delay_cycles(3) - 10.0).abs() < 1e-6);
    for r in run.records.iter().filter(|r| r.line == 5) {
        assert_eq!(r.axes[0].set.to_bits(), r.axes[0].ipo.to_bits());
    }
    assert!((run.delay_cycles(7) - 20.0).abs() < 1e-6);
    assert!(largest_step(&set(&run, 0)) <= largest_step(&ipo(&run, 0)) + 1e-12);
}

/// Axes of unequal order run asynchronously, and that is said. Conformance: A072.
#[test]
fn unequal_hsc_filters_are_reported() {
    let mut settings = hsc("type=8 order=20");
    settings.push("Y.filter[0].order=40".to_owned());
    let run = on("%P\n#FILTER ON[HSC]\nG90 G01 X10 F6000\nM30\n", &settings);
    let text: Vec<&str> = run.diagnostics.iter().map(|d| d.text.as_str()).collect();
    assert!(
        text.iter().any(|t| t.contains("10") && t.contains("20") && t.contains("ms")),
        "{text:?}"
    );
}

/// Standard filters delay as kernels do: 18.447 ms on one axis, nothing on the others. Conformance: A072.
#[test]
fn unequal_standard_filters_are_reported() {
    let program = "%P\nG90 G01 X10 Y10 F6000\nM30\n";
    let unequal = |settings: &[String]| -> Vec<String> {
        let run = on(program, settings);
        assert!(!run.totals.aborted, "{:?}", run.diagnostics);
        let found = run.diagnostics.iter().filter(|d| d.id.to_string() == "K-0112");
        found.map(|d| d.text.clone()).collect()
    };
    let one = unequal(&low_pass("X"));
    assert_eq!(one.len(), 1, "once: {one:?}");
    assert!(one[0].contains("X 18.447 ms") && one[0].contains("Y 0.000 ms"), "{one:?}");
    let all = ["X", "Y", "Z"].map(low_pass).concat();
    assert_eq!(unequal(&all), Vec::<String>::new());
}

/// A band stop that overshoots the largest speed by more than 9 %, and the raised threshold. Conformance: A048.
#[test]
fn a_band_stop_can_trip_the_monitoring() {
    let mut settings: Vec<String> =
        ["enable=1", "type=BANDSTOP", "order=2", "prototype=BUTTERWORTH", "fg_f0=20", "guete=4"]
            .map(|entry| format!("X.filter[0].{entry}"))
            .into();
    settings.push("X.getriebe[0].dynamik.vb_max=100000".to_owned());
    settings.push("X.getriebe[0].vb_eilgang=100000".to_owned());
    settings.push("X.kenngr.dyn_monitoring_a_err=0".to_owned());
    let program = "%P\n#SLOPE [TYPE=STEP]\nG90 G01 X100 F6000\nM30\n";
    let run = on(program, &settings);
    assert!(run.ids().contains(&50118), "{:?}", run.diagnostics);
    settings.push("X.kenngr.dyn_monitoring_v_err=200".to_owned());
    let run = on(program, &settings);
    assert!(!run.ids().contains(&50118), "{:?}", run.diagnostics);
}
