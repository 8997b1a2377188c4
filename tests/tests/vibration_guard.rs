//! The Vibration Guard in runs of programs. The names of the rows are those of the ledger.

use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_tests::{Run, largest_step, run, run_on, sample_machine};

/// Square of 1 mm from the present position of the axes, at F4000.
const SQUARE: &str = "G01 X0 Y1 F4000\nX1 Y1\nX1 Y0\nX0 Y0";

fn program(lines: &[&str]) -> String {
    format!("%P\nG90\n{}\nM30\n", lines.join("\n"))
}

fn on(lines: &[&str], settings: &[String]) -> Run {
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    run(&program(lines), &settings)
}

/// `vib_guard` entries in the path axes.
fn listed(entries: &str) -> Vec<String> {
    let of = |axis: &'static str| {
        entries.split_whitespace().map(move |e| format!("{axis}.vib_guard.{e}")).collect::<Vec<_>>()
    };
    ["X", "Y", "Z"].into_iter().flat_map(of).collect()
}

fn strings(settings: &[&str]) -> Vec<String> {
    settings.iter().map(|s| (*s).to_owned()).collect()
}

/// Names of the axes in errors.
fn refused_for(run: &Run) -> Vec<String> {
    assert!(run.totals.aborted, "{:?}", run.diagnostics);
    let errors = run.diagnostics.iter().filter(|d| d.is_error());
    errors.map(|d| d.axis.as_ref().map_or("?".to_owned(), |a| a.name.clone())).collect()
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
    let run = on(&lines, &strings(&["X.vib_guard.active=1"]));
    assert!(!run.is_unshaped(0) && run.is_unshaped(1));
    let unequal = [
        "X.vib_guard.active=1",
        "X.vib_guard.freq=20",
        "Y.vib_guard.active=1",
        "Y.vib_guard.freq=40",
    ];
    let run = on(&lines, &strings(&unequal));
    let of = |f| kernel_delay(1, f, 0.1);
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
    for r in run.records.iter().filter(|r| r.line == 7) {
        assert_eq!(r.axes[0].set.to_bits(), r.axes[0].ipo.to_bits());
    }
}

/// Errors at corners and on curves, none at rest. Conformance: V007.
#[test]
fn smoothing_leaves_the_contour() {
    for motion in ["G01 X10 F4000\nY10", "G03 X0 Y0 I5 J0 F4000"] {
        let run = on(&["#VIB GUARD ON [MODE=2 FREQ=40]", motion], &[]);
        assert!(largest(&run, |r| r.contour_err_mm) > 1e-3, "{motion}");
        assert!(largest(&run, |r| r.axes[0].err) > 1e-3, "{motion}");
        let last = run.records.last().unwrap();
        assert!(last.contour_err_mm.abs() < 1e-9 && last.axes[0].err.abs() < 1e-9, "{last:?}");
    }
}

/// The longer the cycle, the faster the kink, the larger the error. Conformance: V022.
#[test]
fn the_error_grows_with_the_cycle() {
    let error = |us: u32| {
        let cycle = format!("kontur.cycle_time_us={us}");
        let run = on(&["#VIB GUARD ON [MODE=2 FREQ=40]", SQUARE], &[cycle]);
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
    let run = on(&["#VIB GUARD ON", motion], &listed("mode=3 freq=20"));
    near(run.delay_cycles(4), kernel_delay(3, 20.0, 0.1));
    let active = listed("active=1 mode=1 freq=30");
    let run =
        on(&[motion, "#VIB GUARD ON [MODE=4 FREQ=50]", "X200", "#VIB GUARD OFF", "X300"], &active);
    near(run.delay_cycles(3), kernel_delay(1, 30.0, 0.1));
    near(run.delay_cycles(5), kernel_delay(4, 50.0, 0.1));
    near(run.delay_cycles(7), 0.0);
}

/// On, other values, off between blocks: no jump, every block ends where it should. Conformance: V030.
#[test]
fn switching_between_blocks() {
    let run = on(
        &[
            "G01 X10 F6000",
            "#VIB GUARD ON",
            "X20",
            "#VIB GUARD ON [FREQ=20]",
            "X30",
            "#VIB GUARD OFF",
            "X40",
        ],
        &[],
    );
    assert_eq!(run.diagnostics, []);
    let (ipo, set) = (run.axis(0, |a| a.ipo), run.axis(0, |a| a.set));
    assert!(largest_step(&set) <= largest_step(&ipo) + 1e-12);
    assert!(set.is_sorted(), "never back");
    for end in [10.0_f64, 20.0, 30.0, 40.0] {
        assert!(set.iter().any(|x| x.to_bits() == end.to_bits()), "{end}");
    }
}

/// `#FILTER` and `#VIB GUARD` in one program, in either order and through subroutines. Conformance: V032, V033.
#[test]
fn both_commands_in_one_program() {
    for (first, second) in [
        ("#FILTER ON [ORDER=20]", "#VIB GUARD ON"),
        ("#VIB GUARD ON", "#FILTER ON [ORDER=20]"),
        ("#VIB GUARD ON", "#FILTER ON[HSC]"),
        ("#FILTER ON[HSC]", "#VIB GUARD OFF"),
    ] {
        let run = on(&[first, second, "G01 X1 F1000"], &[]);
        assert!(run.ids().contains(&22060), "{first} {second}: {:?}", run.diagnostics);
        let conflict = run.diagnostics.iter().find(|d| d.id.to_string() == "22060").unwrap();
        assert_eq!(conflict.source.as_ref().unwrap().line, 4);
        assert!(run.records.is_empty() && run.totals.aborted);
    }
    let text = "%L SUB\nN10 #FILTER ON[HSC]\nN20 M17\n%MAIN\nN10 #VIB GUARD ON\nN20 LL SUB\nN30 G01 X1 F1000\nN40 M30\n";
    let run = run(text, &[]);
    assert!(run.ids().contains(&22060), "{:?}", run.diagnostics);
}

/// FIR filter and guard in one axis, and commands against lists: an error that names the axis. FIR in one axis, guard
/// in another: both act. Conformance: V031, V034, V035, V036, V037.
#[test]
fn conflicts_with_lists() {
    let fir =
        |axis: &str| ["enable=1", "type=1", "order=20"].map(|e| format!("{axis}.filter_fir.{e}"));
    let guard = |axis: &str| format!("{axis}.vib_guard.active=1");
    let motion = "G01 X10 Y10 F6000";
    let with = |fir: &[String], guard: Option<String>, lines: &[&str]| {
        let settings: Vec<String> = fir.iter().cloned().chain(guard).collect();
        on(lines, &settings)
    };
    let one_axis = with(&fir("X"), Some(guard("X")), &[motion]);
    assert!(refused_for(&one_axis).contains(&"X".to_owned()));
    let filter = with(&[], Some(guard("Y")), &["#FILTER ON [ORDER=20]", motion]);
    assert!(refused_for(&filter).contains(&"Y".to_owned()));
    let command = with(&fir("Y")[1..2], None, &["#VIB GUARD ON", motion]);
    assert!(refused_for(&command).contains(&"Y".to_owned()));
    let allowed = with(&fir("X"), Some(guard("Y")), &[motion]);
    assert!(!allowed.totals.aborted, "{:?}", allowed.diagnostics);
    assert!(!allowed.is_unshaped(0) && !allowed.is_unshaped(1));
    for command in ["#VIB GUARD OFF", "#FILTER OFF"] {
        let both = with(&fir("X"), Some(guard("Y")), &[command, motion]);
        assert!(!refused_for(&both).is_empty(), "{command}");
    }
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
    let run = on(&["#PUT AX [Z]", motion], &listed("active=1"));
    near(run.delay_cycles(4), kernel_delay(1, 30.0, 0.1));
}

/// Keys in any order, defaults, ranges. Conformance: V043, V045, V046, V047, V052.
#[test]
fn keys_of_the_command() {
    let records = |command: &str| on(&[command, SQUARE], &[]).records;
    assert_eq!(records("#VIB GUARD ON [FREQ=6 MODE=2]"), records("#VIB GUARD ON [MODE=2 FREQ=6]"));
    let motion = "G01 X100 F6000";
    near(on(&["#VIB GUARD ON", motion], &[]).delay_cycles(4), kernel_delay(1, 30.0, 0.1));
    for (key, id) in [
        ("MODE=5", "22062"),
        ("FREQ=0.5", "K-0034"),
        ("DAMPING=1.1", "K-0034"),
        ("DAMPING=1", "50820"),
        ("ACC_FACT=0.9", "K-0034"),
        ("ACC_FACT=11", "K-0034"),
    ] {
        let run = on(&[&format!("#VIB GUARD ON [{key}]"), motion], &[]);
        assert_eq!(run.said(), [id], "{key}");
        assert!(run.totals.aborted, "{key}");
    }
    for key in ["DAMPING=0", "ACC_FACT=1", "ACC_FACT=10", "MODE=4", "FREQ=1"] {
        let run = on(&[&format!("#VIB GUARD ON [{key}]"), motion], &[]);
        assert!(!run.totals.aborted, "{key}: {:?}", run.diagnostics);
    }
}

/// Inches under G70, if P-CHAN-00439 says so. Conformance: V049.
#[test]
fn tolerance_in_inch() {
    let dev = |considered: u32| {
        let setting = format!("channel.contouring_consider_inch={considered}");
        let lines = [
            "#VIB GUARD ON [MODE=2 FREQ=40]",
            "G70",
            "#VIB GUARD ON [AX_DEV=0.001]",
            "G71",
            SQUARE,
        ];
        let run = on(&lines, &[setting]);
        assert!(!run.totals.aborted, "{:?}", run.diagnostics);
        largest(&run, |r| r.axes[0].dev).max(largest(&run, |r| r.axes[1].dev))
    };
    assert!(dev(0) <= 0.001);
    assert!(dev(1) <= 0.0254 && dev(1) > 0.001, "{}", dev(1));
}

/// Speed at a corner of 90 degrees: a T with the weight of 10 %, times ACC_FACT. Conformance: V050, V051.
#[test]
fn acc_fact() {
    let corner = |weight: u32, acc_fact: u32| {
        let settings =
            ["X", "Y"].map(|axis| format!("{axis}.getriebe[0].dynamik.a_trans_weight={weight}"));
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
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

/// The manual's example: with tolerance, without, without guard. Conformance: V002, V054, V055, V057, V058, V059, V060.
#[test]
fn the_square_of_the_manual() {
    let square = ["X0 Y1", "X1 Y1", "X1 Y0", "X0 Y0"];
    let mut text = "N010 G00 G90 X0 Y0 Z0\nN020 #SLOPE[TYPE=TRAPEZ]\n".to_owned();
    let mut n = 30;
    for command in ["ON [MODE=2 FREQ=40 AX_DEV=0.01]", "ON", "OFF"] {
        text += &format!("N{n:03} #VIB GUARD {command}\n");
        n += 10;
        for (i, corner) in square.iter().enumerate() {
            let feed = if i == 0 { " F4000" } else { "" };
            text += &format!("N{n:03} G01 {corner}{feed}\n");
            n += 10;
        }
    }
    text += "N180 M30\n";
    let run = run(&text, &[]);
    assert!(!run.totals.aborted, "{:?}", run.diagnostics);
    let pass = |from: u64| {
        let blocks = from..=from + 30;
        run.records.iter().filter(move |r| r.block.is_some_and(|n| blocks.contains(&n)))
    };
    let dev = |from: u64| {
        pass(from)
            .flat_map(|r| [r.axes[0].dev, r.axes[1].dev])
            .fold(0.0, |m: f64, d| m.max(d.abs()))
    };
    assert!(dev(40) <= 0.010, "{}", dev(40));
    assert!(dev(90) > 0.010, "{}", dev(90));
    assert!(dev(140) <= 0.0);
    for r in pass(140) {
        assert!((0..2).all(|i| r.axes[i].set.to_bits() == r.axes[i].ipo.to_bits()), "{r:?}");
    }
    // the second pass keeps mode and frequency of the first one
    let alone = on(&["#VIB GUARD ON [MODE=2 FREQ=40]", SQUARE], &[]);
    near(
        largest(&alone, |r| r.axes[0].dev),
        pass(90).map(|r| r.axes[0].dev.abs()).fold(0.0, f64::max),
    );
}
