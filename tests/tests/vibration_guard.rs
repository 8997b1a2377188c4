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
    assert!((is - want).abs() < 1e-6, "{is} is not {want}");
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

/// A program that keeps the tolerance anyway is unchanged; 0 means no monitoring. Conformance: V026, V048.
#[test]
fn the_tolerance_acts_only_where_it_must() {
    let with = |key: &str| {
        let command = format!("#VIB GUARD ON [MODE=2 FREQ=40{key}]");
        on(&[&command, "G01 X10 F600", "X20 Y0.2", "X30 Y0.6"], &[])
    };
    let plain = with("");
    let deviation = largest(&plain, |r| r.axes[1].dev);
    assert!(deviation > 0.0 && deviation < 0.05, "{deviation}");
    // without a tolerance, `dev` is measured more finely
    let motion = |run: &Run| -> Vec<_> {
        run.records
            .iter()
            .map(|r| (r.path, r.axes.iter().map(|a| a.set).collect::<Vec<_>>()))
            .collect()
    };
    assert_eq!(motion(&with(" AX_DEV=0.05")), motion(&plain));
    let square =
        |key: &str| on(&[&format!("#VIB GUARD ON [MODE=2 FREQ=40{key}]"), SQUARE], &[]).records;
    assert_eq!(square(" AX_DEV=0"), square(""));
    assert_ne!(square(" AX_DEV=0.01"), square(""));
    let run = on(&["#VIB GUARD ON [AX_DEV=-0.01]", SQUARE], &[]);
    assert_eq!(run.said(), ["K-0034"]);
    assert!(run.totals.aborted);
}

/// The list prepares, the program switches; the words of the program take precedence. Conformance: V028, V029.
#[test]
fn lists_and_program() {
    let motion = "G01 X100 F6000";
    let run = on(&["#VIB GUARD ON", motion], "X,Y,Z.vib_guard: mode=3, freq=20");
    near(run.delay_cycles(4), kernel_delay(3, 20.0, 0.1));
    let active = "X,Y,Z.vib_guard: active=1, mode=1, freq=30";
    let run =
        on(&[motion, "#VIB GUARD ON [MODE=4 FREQ=50]", "X200", "#VIB GUARD OFF", "X300"], active);
    near(run.delay_cycles(3), kernel_delay(1, 30.0, 0.1));
    near(run.delay_cycles(5), kernel_delay(4, 50.0, 0.1));
    near(run.delay_cycles(7), 0.0);
}

/// Axis exchange switches the guard of the program off; that of the list stays on. Conformance: V039, V040, V041.
#[test]
fn axis_exchange() {
    let motion = "G01 X100 F6000";
    let run = on(&["#VIB GUARD ON", "#PUT AX [Z]", motion], &[]);
    assert!(run.is_unshaped(0) && !run.totals.aborted);
    assert!(
        run.diagnostics.iter().any(|d| d.text.contains("Vibration Guard")),
        "{:?}",
        run.diagnostics
    );
    let run = on(&["#VIB GUARD ON", "#PUT AX [Z]", "#VIB GUARD ON", motion], &[]);
    near(run.delay_cycles(6), kernel_delay(1, 30.0, 0.1));
    let run = on(&["#PUT AX [Z]", motion], "X,Y,Z.vib_guard.active=1");
    near(run.delay_cycles(4), kernel_delay(1, 30.0, 0.1));
}

/// Keys in any order, and defaults; ranges are rows of `shaping.txt`. Conformance: V043, V045, V046, V047, V052.
#[test]
fn keys_of_the_command() {
    let records = |command: &str| on(&[command, SQUARE], &[]).records;
    assert_eq!(records("#VIB GUARD ON [FREQ=6 MODE=2]"), records("#VIB GUARD ON [MODE=2 FREQ=6]"));
    let motion = "G01 X100 F6000";
    near(on(&["#VIB GUARD ON", motion], &[]).delay_cycles(4), kernel_delay(1, 30.0, 0.1));
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
