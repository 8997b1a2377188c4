//! Exact stop and its time limit in runs of programs. The names of the rows are those of the ledger.

use kontur_interpreter::machine::explain::explain;
use kontur_tests::{Run, programs, run, run_on, sample_machine};

/// A gain of 10/s: from 100 mm/s it takes half a second into a window of 0.05 mm.
fn slow(settling_us: i32) -> [String; 6] {
    let settling = format!("X.getriebe[0].position_settling_time={settling_us}");
    let others = ["Y", "Z"].map(|axis| format!("{axis}.vorsteuer.vorsteuerung=NONE"));
    let [y, z] = others;
    let kv = "X.getriebe[0].kv=1000".to_owned();
    let window = "X.getriebe[0].window=500".to_owned();
    [settling, kv, window, "X.vorsteuer.vorsteuerung=NONE".to_owned(), y, z]
}

fn stop(program: &str, settling_us: i32) -> Run {
    let settings = slow(settling_us);
    run(program, &settings.iter().map(String::as_str).collect::<Vec<_>>())
}

/// The message, the class of its reaction, the frozen axis and what follows: nothing.
/// Conformance: P001, P002, P010, P011, P012.
#[test]
fn an_axis_that_does_not_arrive_ends_the_program() {
    let run = stop("%P\nG90 G60 G01 X50 Y20 F6000\nG60 X60 Y30\nM30\n", 200_000);
    assert!(run.totals.aborted);
    assert_eq!(run.ids(), [70082], "{:?}", run.diagnostics);
    let message = &run.diagnostics[0];
    assert_eq!(message.axis.as_ref().unwrap().name, "X");
    let explained = explain("70082").unwrap().to_string();
    assert!(explained.contains("class 5: the faulty axis stops abruptly"), "{explained}");
    assert!(explained.contains("class 6: complete reset of the channel"), "{explained}");
    let at = usize::try_from(message.cycle.unwrap()).unwrap();
    // (k - k1) T >= t3, counted from the cycle in which the set position has reached its target
    let t1 = run.axis(0, |a| a.set).iter().position(|x| x.to_bits() == 50_f64.to_bits()).unwrap();
    assert_eq!(at - t1, 200);
    for r in &run.records[t1..] {
        assert_eq!(r.axes[0].set.to_bits(), 50_f64.to_bits());
        assert_eq!(r.axes[1].set.to_bits(), 20_f64.to_bits(), "no further block");
    }
    assert!(run.records.len() > at, "the trace goes on to standstill");
    assert!(run.records.iter().all(|r| r.line < 3));
}

/// Conformance: P001, P006, P007.
#[test]
fn the_time_limit_decides() {
    let program = "%P\nG90 G60 G01 X100 F6000\nG60 X120\nM30\n";
    assert_eq!(stop(program, 400_000).ids(), [70082]);
    let run = stop(program, 600_000);
    assert_eq!(run.ids(), [0; 0], "{:?}", run.diagnostics);
    assert!(!run.totals.aborted);
}

/// G60 waits for the window, with the time monitoring on and off. Conformance: P015, P019.
#[test]
fn g60_waits_for_the_window() {
    for settling_us in [600_000, 0] {
        let run = stop("%P\nG90 G60 G01 X100 F6000\nG01 Y10\nM30\n", settling_us);
        assert_eq!(run.ids(), [0; 0], "{settling_us}: {:?}", run.diagnostics);
        let begins = run.records.iter().position(|r| r.axes[1].ipo.abs() > 0.0).unwrap();
        let stands = run.axis(0, |a| a.ipo).iter().position(|x| *x >= 100.0).unwrap();
        assert!(begins - stands > 400, "{begins} {stands}");
        // the actual position at the start of the cycle decides
        assert!(run.records[begins].axes[0].lag.abs() <= 0.05);
        assert!(run.records[stands..begins].iter().all(|r| r.axes[0].lag.abs() > 0.05));
    }
}

/// Not while the axis is interpolated: blocks without a stop between them. Conformance: P017.
#[test]
fn moving_axes_are_not_monitored() {
    let run = stop("%P\nG90 G01 X20 F6000\nX40\nX60\nX80\nX100\nX120\nM30\n", 1000);
    let passed = run.records.iter().position(|r| r.axes[0].ipo >= 119.0).unwrap();
    let message = run.diagnostics.iter().filter_map(|d| d.cycle).min().unwrap_or(u64::MAX);
    assert!(message > passed as u64, "only the last stop may be late");
}

/// The sample program with the settings that its first lines name. Conformance: P001, P002.
#[test]
fn the_sample_program_of_the_exact_stop() {
    let text = std::fs::read_to_string(programs().join("fail/70082_exact_stop.nc")).unwrap();
    let settings: Vec<&str> =
        text.lines().flat_map(str::split_whitespace).filter(|w| w.starts_with("X.")).collect();
    let run = run(&text, &settings);
    assert_eq!(run.ids(), [70082], "{:?}", run.diagnostics);
    assert!(run.totals.aborted);
}

/// A stage that is too strong: the run ends with a message, every number is one. Conformance: I011.
#[test]
fn an_unstable_axis_ends_the_run() {
    let stage = "X.lr_param.improved_position_control.stage[0]";
    let settings = [
        format!("{stage}.filter[0].order=3"),
        format!("{stage}.weight_fact_num=7"),
        "X.lr_param.improved_position_control.v_add_max_fact=2000".to_owned(),
    ];
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    let machine = sample_machine("rack_and_pinion", &settings);
    let run = run_on(machine, "%P\nG90 G01 X500 F16362\nG04 5\nX0\nG04 20\nM30\n");
    assert!(run.totals.aborted, "{:?}", run.diagnostics);
    assert!(run.diagnostics.iter().any(|d| d.is_error()), "{:?}", run.diagnostics);
    for r in &run.records {
        let a = &r.axes[0];
        assert!([a.act, a.load, a.tcp, a.tcp_acc, a.vadd, a.cmd].iter().all(|x| x.is_finite()));
    }
}

/// The slave of a gantry pair gets an additive speed of its own by its master's parameters. Conformance: I027.
#[test]
fn a_gantry_slave_has_its_additive_speed() {
    let ipc = "X.lr_param.improved_position_control";
    let entries = "enable=1 v_add_max_fact=100 stage[0].mode=1 stage[0].filter[0].order=1 \
                   stage[0].filter[0].fg_f0=20 stage[0].filter[0].q_factor=2";
    let settings: Vec<String> = entries.split_whitespace().map(|e| format!("{ipc}.{e}")).collect();
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    let run = run_on(sample_machine("gantry", &settings), "%P\nG90 G01 X50 F6000\nM30\n");
    assert!(!run.totals.aborted, "{:?}", run.diagnostics);
    let (master, slave) = (run.axis(0, |a| a.vadd), run.axis(3, |a| a.vadd));
    assert!(slave.iter().any(|v| v.abs() > 0.01));
    // equal drives: equal speeds
    assert_eq!(master, slave);
    assert!(run.axis(1, |a| a.vadd).iter().all(|v| v.abs() <= 0.0));
}
