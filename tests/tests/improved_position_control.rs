//! Improved Position Control in runs of programs. The names of the rows are those of the ledger.

use kontur_tests::{Run, programs, run_on, sample_machine};
use std::f64::consts::TAU;

/// A program on a sample machine with settings.
fn on(machine: &str, settings: &[String], program: &str) -> Run {
    run_on(sample_machine(machine, settings), program)
}

/// A stage that is too strong: the run ends with a message, and every value is a number. Conformance: I011.
#[test]
fn an_unstable_axis_ends_the_run() {
    let stage = "X.lr_param.improved_position_control.stage[0]";
    let settings = [
        format!("{stage}.filter[0].order=3"),
        format!("{stage}.weight_fact_num=7"),
        "X.lr_param.improved_position_control.v_add_max_fact=2000".to_owned(),
    ];
    let program = "%P\nG90 G01 X500 F16362\nG04 5\nX0\nG04 20\nM30\n";
    let run = on("rack_and_pinion", &settings, program);
    assert!(run.totals.aborted, "{:?}", run.diagnostics);
    assert!(run.diagnostics.iter().any(|d| d.is_error()), "{:?}", run.diagnostics);
    let mut ids: Vec<_> = run.diagnostics.iter().map(|d| d.id).collect();
    ids.dedup();
    assert_eq!(ids.len(), run.diagnostics.len(), "each error once: {:?}", run.diagnostics);
    assert!(run.records.len() < 20_000, "stopped, not run to the end: {}", run.records.len());
    for r in &run.records {
        let a = &r.axes[0];
        assert!([a.act, a.load, a.tcp, a.tcp_acc, a.vadd, a.cmd].iter().all(|x| x.is_finite()));
    }
}

/// The rows of the reference experiment (spec 60/3.2, computed there by a simulation of its own) that are stable or unstable: with the
/// small limit of the additive speed the lag stays small, and an unstable axis swings for ever after its motion.
/// Conformance: I011.
#[test]
fn a_loop_that_swings_within_its_limits_ends_the_run() {
    let stages = "X.lr_param.improved_position_control.stage";
    let alone = format!("{stages}[1].mode=0");
    let order = |order: u32| vec![alone.clone(), format!("{stages}[0].filter[0].order={order}")];
    let weight = |weight: u32| vec![alone.clone(), format!("{stages}[0].weight_fact_num={weight}")];
    let delay = |cycles: u32| {
        let delay = format!("kontur.axis[1].ipc.delay_cycles={cycles}");
        vec![delay, format!("{stages}[1].filter[0].q_factor=4")]
    };
    let ends = |settings: &[String]| {
        let run = on("rack_and_pinion", settings, "%P\nG90 G01 X500 F16362\nG04 5\nM30\n");
        let swings = run.diagnostics.iter().any(|d| d.text.contains("swinging"));
        assert_eq!(run.totals.aborted, swings, "{settings:?}: {:?}", run.diagnostics);
        // the motion takes 2.1 s
        assert!(!swings || run.records.last().unwrap().k < 4_000, "{settings:?}");
        swings
    };
    for stable in [vec![], weight(1), weight(3), weight(5), order(2), delay(0), delay(2), delay(3)]
    {
        assert!(!ends(&stable), "{stable:?}");
    }
    for unstable in [order(3), delay(4)] {
        assert!(ends(&unstable), "{unstable:?}");
    }
}

/// `#MACHINE DATA` between two motions: the axis comes to rest before it takes over the new weight, and uses it from then on.
/// Conformance: I024.
#[test]
fn new_parameters_wait_for_standstill() {
    let stage = "lr_param.improved_position_control.stage[0]";
    let with = |line: &str| {
        on("rack_and_pinion", &[], &format!("%P\nG90 G01 X100 F16362\n{line}\nG01 X200\nM30\n"))
    };
    let changed = with(&format!("#MACHINE DATA [AX=X AXPARAM=\"{stage}.weight_fact_num 0\"]"));
    let plain = with("G04 0.5");
    // 70603: a weight of 0 turns the function off
    let additive = |run: &Run, line| {
        let of_line = run.of_line(line);
        of_line.map(|r| r.axes[0].vadd.abs()).fold(0.0, f64::max)
    };
    assert!(additive(&changed, 2) > 1.0 && additive(&plain, 4) > 1.0);
    assert!(additive(&changed, 4) <= 0.0, "{}", additive(&changed, 4));
    let first = changed.records.iter().position(|r| r.line == 4).unwrap();
    let before = &changed.records[first - 1];
    assert!(before.path.v_mm_s.abs() <= 0.0 && (before.axes[0].set - 100.0).abs() <= 0.0);
}

/// The slave of a gantry pair gets its own additive speed, with the parameters of its master. Conformance: I027.
#[test]
fn a_gantry_slave_has_its_additive_speed() {
    let ipc = "X.lr_param.improved_position_control";
    let entries = "enable=1 v_add_max_fact=100 stage[0].mode=1 stage[0].filter[0].order=1 \
                   stage[0].filter[0].fg_f0=20 stage[0].filter[0].q_factor=2";
    let settings: Vec<String> = entries.split_whitespace().map(|e| format!("{ipc}.{e}")).collect();
    let run = on("gantry", &settings, "%P\nG90 G01 X50 F6000\nM30\n");
    assert!(!run.totals.aborted, "{:?}", run.diagnostics);
    let (master, slave) = (run.axis(0, |a| a.vadd), run.axis(3, |a| a.vadd));
    assert!(slave.iter().any(|v| v.abs() > 0.01));
    // equal drives: equal speeds
    assert_eq!(master, slave);
    assert!(run.axis(1, |a| a.vadd).iter().all(|v| v.abs() <= 0.0));
}

/// A bridge whose two drives ring at 53 Hz: master and slave both settle, with the parameters of the master alone.
/// Conformance: I025.
#[test]
fn a_gantry_pair_is_damped() {
    let ipc = "X.lr_param.improved_position_control";
    let mut settings = Vec::new();
    for (name, number) in [("X", 1), ("X2", 4)] {
        settings.extend([format!("{name}.getriebe[0].kv=3000")]);
        let plant = "load_encoder=1 plant.model=MODAL plant.kp=200 plant.tn_us=30000 plant.ti_us=500 \
                     plant.mode[0].f0=53 plant.mode[0].damping=0.01 plant.mode[0].phi_motor=0.2 \
                     plant.mode[0].phi_load=0.2 plant.mode[0].phi_tcp=0.8 plant.mode[0].phi_dist=0.8 \
                     plant.disturbance.amplitude=56.9 plant.disturbance.frequency=53 \
                     plant.disturbance.full_speed=100 ipc.delay_cycles=1";
        settings.extend(plant.split_whitespace().map(|e| format!("kontur.axis[{number}].{e}")));
    }
    let stage = "enable=1 v_add_max_fact=100 stage[0].mode=1 stage[0].filter[0].order=1 \
                 stage[0].filter[0].fg_f0=53 stage[0].filter[0].q_factor=10 stage[0].weight_fact_num=2";
    let amplitudes = |settings: &[String]| {
        let run = on("gantry", settings, "%P\nG135\nG90 G01 X300 F6000\nM30\n");
        assert!(!run.totals.aborted, "{:?}", run.diagnostics);
        [0, 3].map(|axis| {
            // half a second at constant speed: whole periods of 53 Hz within a thousand cycles
            let acc = &run.axis(axis, |a| a.tcp_acc)[1500..2500];
            let (mut re, mut im) = (0.0, 0.0);
            for (i, a) in acc.iter().enumerate() {
                let phase = TAU * 0.053 * i as f64;
                re += a * libm::cos(phase);
                im += a * libm::sin(phase);
            }
            2.0 * libm::hypot(re, im) / acc.len() as f64
        })
    };
    let plain = amplitudes(&settings);
    settings.extend(stage.split_whitespace().map(|e| format!("{ipc}.{e}")));
    let damped = amplitudes(&settings);
    for (damped, plain) in damped.into_iter().zip(plain) {
        assert!(plain > 100.0, "mm/s2: {plain}");
        assert!(damped < 0.6 * plain, "{damped} of {plain}");
    }
}

fn sample(name: &str) -> String {
    std::fs::read_to_string(programs().join(name)).unwrap()
}

/// A bridge: the second drive follows the set positions of the first. With a different gain it lags by v / Kv, and under G135 not at all.
#[test]
fn the_sample_program_of_the_gantry() {
    let text = sample("gantry.nc");
    for (kv, second) in [(5000, 2.0), (4000, 2.5)] {
        let run = on("gantry", &[format!("X2.getriebe[0].kv={kv}")], &text);
        assert!(!run.totals.aborted && run.diagnostics.is_empty(), "{:?}", run.diagnostics);
        assert!(run.records.iter().all(|r| r.axes[3].set.to_bits() == r.axes[0].set.to_bits()));
        let lags = |block: u64| {
            let all: Vec<_> = run.records.iter().filter(|r| r.block == Some(block)).collect();
            let r = all[all.len() * 3 / 4];
            [r.axes[0].lag.abs(), r.axes[3].lag.abs()]
        };
        for (block, want) in [(20, [2.0, second]), (40, [0.0, 0.0])] {
            for (is, want) in lags(block).into_iter().zip(want) {
                assert!((is - want).abs() < 1e-5, "Kv {kv}, N{block}: {is}, expected {want}");
            }
        }
    }
}
