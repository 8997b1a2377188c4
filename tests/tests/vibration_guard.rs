//! The Vibration Guard in runs of programs. The names of the rows are those of the ledger.

use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_tests::{Run, Settings, run, run_on, sample_machine};

/// Square of 1 mm from the present position of the axes, at F4000.
const SQUARE: &str = "G01 X0 Y1 F4000\nX1 Y1\nX1 Y0\nX0 Y0";

fn program(lines: &[&str]) -> String {
    format!("%P\nG90\n{}\nM30\n", lines.join("\n"))
}

fn on(lines: &[&str], settings: impl Settings) -> Run {
    run(&program(lines), settings)
}

fn largest(run: &Run, f: impl Fn(&kontur_interpreter::record::CycleRecord) -> f64) -> f64 {
    run.records.iter().map(|r| f(r).abs()).fold(0.0, f64::max)
}

/// The same for a kernel.
fn kernel_delay(mode: u8, freq_hz: f64, damping: f64) -> f64 {
    let settings = VibGuardSettings { mode, freq_hz, damping };
    settings.kernel(CycleTime::DEFAULT).unwrap().delay_cycles()
}

fn near(is: f64, want: f64) {
    kontur_kit::near(is, want, 1e-6);
}

/// From the list: from program start, axis by axis; unequal delays are reported. Conformance: V003, V025.
#[test]
fn lists_activate_single_axes() {
    let lines = ["G01 X100 Y100 F6000"];
    let run = on(&lines, "X.vib_guard.active=1");
    assert!(!run.is_unshaped(0) && run.is_unshaped(1));
    let run = on(&lines, "X.vib_guard: active=1, freq=20; Y.vib_guard: active=1, freq=40");
    let of = |f| kernel_delay(1, f, 0.1);
    let filtered = on(&["G01 X10 Y10 F6000"], "X.filter[0]: enable=1, order=4, fg_f0=15");
    let [unequal] = &filtered.diagnostics[..] else { panic!("{:?}", filtered.diagnostics) };
    assert!(unequal.text.contains("X 18.447 ms") && unequal.text.contains("Y 0.000 ms"));
    let text: Vec<&str> = run.diagnostics.iter().map(|d| d.text.as_str()).collect();
    let delays = [format!("{:.1}", of(20.0)), format!("{:.1}", of(40.0))];
    assert!(
        text.iter().any(|t| delays.iter().all(|d| t.contains(d.as_str()))),
        "{delays:?}: {text:?}"
    );
    assert!(!run.totals.aborted);
}

/// From the program: all axes at once, modal until OFF, without any preparation. Conformance: V004, V027, V042, V044.
#[test]
fn the_command_activates_all_axes() {
    let run = on(
        &[
            "#VIB GUARD ON [MODE=2 FREQ=40]",
            "G01 X100 Y100 Z100 F6000",
            "X0 Y0 Z0",
            "#VIB GUARD OFF",
            "X100 Y100 Z100",
        ],
        &[],
    );
    assert_eq!(run.diagnostics, []);
    for r in run.records.iter().filter(|r| r.line <= 5) {
        let behind = |i: usize| r.axes[i].ipo - r.axes[i].set;
        near(behind(0), behind(1));
        near(behind(0), behind(2));
    }
    let diagonal = kernel_delay(2, 40.0, 0.1) / 3.0_f64.sqrt();
    near(run.delay_cycles(4), diagonal);
    near(run.delay_cycles(5), -diagonal);
    for r in run.of_line(7) {
        assert_eq!(r.axes[0].set.to_bits(), r.axes[0].ipo.to_bits());
    }
}

/// The longer the cycle, the faster the kink, the larger the error. Conformance: V022.
#[test]
fn the_error_grows_with_the_cycle() {
    let error = |us: u32| {
        let cycle = format!("kontur.cycle_time_us={us}");
        let run = on(&["#VIB GUARD ON [MODE=2 FREQ=40]", SQUARE], &cycle);
        largest(&run, |r| r.contour_err_mm)
    };
    let (one, two, four) = (error(1000), error(2000), error(4000));
    assert!(one < two && two < four, "{one} {two} {four}");
}

/// Speed at a corner of 90 degrees: a T with the weight of 10 %, times ACC_FACT. Conformance: V050, V051.
#[test]
fn acc_fact() {
    let corner = |weight: u32, acc_fact: u32| {
        let settings = format!("X,Y.getriebe[0].dynamik.a_trans_weight={weight}");
        let text = program(&[
            "#SLOPE [TYPE=TRAPEZ]",
            &format!("#VIB GUARD ON [MODE=2 FREQ=40 ACC_FACT={acc_fact}]"),
            "G01 X5 F4000",
            "Y5",
        ]);
        let run = run_on(sample_machine("vendor_defaults", &settings), &text);
        assert!(!run.totals.aborted, "{:?}", run.diagnostics);
        let moving = run.records.iter().filter(|r| r.axes[0].ipo > 4.0 && r.axes[1].ipo < 1.0);
        let slowest = moving.map(|r| r.path.v_mm_s).fold(f64::MAX, f64::min);
        (slowest, run)
    };
    let (one, three) = (corner(100, 1).0, corner(100, 3).0);
    assert!((one - 0.1).abs() < 0.01, "{one}");
    assert!((three - 0.3).abs() < 0.01, "{three}");
    let (without, ignored) = (corner(0, 1).1, corner(0, 3).1);
    assert_eq!(ignored.records, without.records);
    assert!(
        ignored.diagnostics.iter().any(|d| d.text.contains("ACC_FACT")),
        "{:?}",
        ignored.diagnostics
    );
}
