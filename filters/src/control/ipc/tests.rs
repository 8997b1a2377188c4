#![expect(clippy::float_cmp, reason = "exact values are what is tested")]

use super::*;
use crate::control::fault::IpcParameter;

const T: CycleTime = CycleTime::DEFAULT;

fn stage(mode: IpcMode) -> IpcStageConfig {
    IpcStageConfig {
        mode,
        weight_num: 2.0,
        weight_denom: 1.0,
        filters: vec![IpcFilterConfig {
            kind: IpcFilterType::BandPass,
            order: 1,
            frequency_hz: 53.0,
            quality: 10.0,
        }],
        oscillator_damping: 0.2,
    }
}

fn config(stages: Vec<IpcStageConfig>) -> IpcConfig {
    IpcConfig { enable: true, limit_ratio: 0.1, stages, ..IpcConfig::default() }
}

/// Conformance: I026, I035, I037, I041, I043, I046.
#[test]
fn errors_switch_the_axis_off_and_warnings_do_not() {
    let range = |what, value| Issue::IpcRange { stage: 0, what, value };
    let with = |change: fn(&mut IpcStageConfig)| {
        let mut s = stage(IpcMode::Indirect);
        change(&mut s);
        config(vec![s])
    };
    let numerator = Issue::IpcNumerator { stage: 0, value: 0.0 };
    let denominator = Issue::IpcDenominator { stage: 0, value: -1.0 };
    let weight = Issue::IpcWeight { stage: 0, weight: 8.0 };
    for (config, issue, active) in [
        (with(|s| s.filters[0].frequency_hz = 0.0), range(IpcParameter::Frequency, 0.0), false),
        (with(|s| s.filters[0].frequency_hz = -1.0), range(IpcParameter::Frequency, -1.0), false),
        (with(|s| s.filters[0].frequency_hz = 500.0), range(IpcParameter::Frequency, 500.0), false),
        (with(|s| s.weight_num = 0.0), numerator, false),
        (with(|s| s.weight_denom = -1.0), denominator, false),
        (with(|s| s.filters[0].order = 0), range(IpcParameter::Order, 0.0), false),
        (with(|s| s.filters[0].order = 4), range(IpcParameter::Order, 4.0), false),
        (with(|s| s.filters[0].quality = 11.0), range(IpcParameter::Quality, 11.0), false),
        (with(|s| s.oscillator_damping = 1.0), range(IpcParameter::Damping, 1.0), false),
        (
            with(|s| s.filters[0].kind = IpcFilterType::AllPass),
            range(IpcParameter::BandPass, 1.0),
            false,
        ),
        (with(|s| s.weight_num = 8.0), weight, true),
        (IpcConfig { limit_ratio: 0.0, ..with(|_| ()) }, Issue::IpcNoLimit, true),
        (IpcConfig { gantry_slave: true, ..with(|_| ()) }, Issue::IpcGantrySlave, false),
    ] {
        let what = format!("{issue:?}");
        assert_eq!(config.check(T), [issue], "{what}");
        assert_eq!(config.active(T), active, "{what}");
        assert!(IpcConfig { enable: false, ..config }.check(T).is_empty(), "{what} while off");
    }
    assert!(with(|_| ()).check(T).is_empty());
    let direct = with(|s| {
        s.mode = IpcMode::Direct;
        s.oscillator_damping = -1.0;
    });
    assert!(direct.active(T), "DIRECT needs no damping");
    let mut near = stage(IpcMode::Direct);
    near.filters[0].frequency_hz = 56.0;
    assert_eq!(
        config(vec![stage(IpcMode::Direct), near]).check(T),
        [Issue::IpcOverlap { stages: (0, 1) }]
    );
}

/// Conformance: I007.
#[test]
fn direct_falls_back_to_the_motor() {
    let mut ipc =
        Ipc::new(&IpcConfig { delay_cycles: 0, ..config(vec![stage(IpcMode::Direct)]) }, 500.0, T);
    let mut other = ipc.clone();
    let a = ipc.step(&IpcInput { motor_mm_s: 3.0, direct_mm_s: None, command_mm_s: 9.0 });
    let b = other.step(&IpcInput { motor_mm_s: 0.0, direct_mm_s: Some(3.0), command_mm_s: 0.0 });
    assert_eq!(a, b);
    assert!(a.speed_mm_s < 0.0, "counter-movement");
}

#[test]
fn delay_shifts_the_output() {
    let run = |delay_cycles| -> Vec<f64> {
        let config = IpcConfig { delay_cycles, ..config(vec![stage(IpcMode::Direct)]) };
        let mut ipc = Ipc::new(&config, 500.0, T);
        (0..50_u32)
            .map(|k| {
                ipc.step(&IpcInput { motor_mm_s: f64::from(k % 7), ..IpcInput::default() })
                    .speed_mm_s
            })
            .collect()
    };
    let prompt = run(0);
    for delay in 1..=5 {
        assert_eq!(run(delay)[delay..], prompt[..50 - delay]);
        assert!(run(delay)[..delay].iter().all(|v| *v == 0.0));
    }
}

/// Largest additive speed for cosines of amplitude 1 at `f_hz` in the speed of the motor and in the command.
fn response(config: &IpcConfig, f_hz: f64, motor: f64, command: f64) -> Vec<f64> {
    let mut ipc = Ipc::new(config, 500.0, T);
    let cosine = |k: u32| libm::cos(std::f64::consts::TAU * f_hz * 1e-3 * f64::from(k));
    let step = |k: u32| {
        let motor_mm_s = motor * cosine(k);
        ipc.step(&IpcInput { motor_mm_s, direct_mm_s: None, command_mm_s: command * cosine(k) })
    };
    (0..8000).map(step).map(|out| out.speed_mm_s).collect()
}

fn peak(out: &[f64]) -> f64 {
    out[6000..].iter().map(|v| v.abs()).fold(0.0, f64::max)
}

/// The weight in DIRECT, 1 / (2 D) of it after an oscillator, up to the limits. Conformance: I015, I041, I042, I044, I047.
#[test]
fn weight_and_oscillator_set_the_amplitude() {
    let amplitude = |config: &IpcConfig| peak(&response(config, 53.0, 1.0, 1.0));
    for (weight_num, oscillator_damping) in [(0.5, 0.2), (1.0, 0.2), (2.0, 0.2), (1.0, 0.1)] {
        for (mode, gain) in [
            (IpcMode::Direct, 1.0),
            (IpcMode::Indirect, 0.5 / oscillator_damping),
            (IpcMode::SetPoint, 0.5 / oscillator_damping),
            (IpcMode::NotActive, 0.0),
        ] {
            let stage = IpcStageConfig { weight_num, oscillator_damping, ..stage(mode) };
            let (is, want) = (amplitude(&config(vec![stage])), weight_num * gain);
            assert!((is - want).abs() <= 1e-3 * want, "{mode:?} {weight_num}: {is}, not {want}");
        }
    }
    let heavy = IpcStageConfig { weight_num: 20.0, ..stage(IpcMode::Direct) };
    assert!((amplitude(&config(vec![heavy])) - 7.0).abs() < 1e-2, "limited to 7.0");
    let off = IpcConfig { enable: false, ..config(vec![stage(IpcMode::Direct)]) };
    assert_eq!(amplitude(&off), 0.0);
    let tight = IpcConfig { limit_ratio: 0.002, ..config(vec![stage(IpcMode::Direct)]) };
    assert_eq!(amplitude(&tight), 1.0, "0.2 % of 500 mm/s");
}

/// 53 Hz with Q 10: bandwidth 5.3 Hz at -3 dB; at 11 Hz attenuated by at least 20 dB. Conformance: I009, I033.
#[test]
fn a_stage_cuts_its_band_out() {
    let direct = || config(vec![IpcStageConfig { weight_num: 1.0, ..stage(IpcMode::Direct) }]);
    let gain = |f_hz| peak(&response(&direct(), f_hz, 1.0, 0.0));
    assert!(gain(11.0) < 0.1, "{}", gain(11.0));
    let edge = |mut inside: f64, mut outside: f64| {
        for _ in 0..20 {
            let middle = 0.5 * (inside + outside);
            if gain(middle) > 0.5_f64.sqrt() { inside = middle } else { outside = middle }
        }
        inside
    };
    let width = edge(53.0, 70.0) - edge(53.0, 40.0);
    // the bilinear transform narrows the band by 3 % at 53 Hz
    assert!((width - 5.3).abs() < 0.16, "{width}");
}

/// DIRECT and INDIRECT use the measured speed, `SET_POINT` the command; the last two simulate the oscillation.
/// Conformance: I012, I016, I043.
#[test]
fn what_the_modes_listen_to() {
    let with = |mode, damping, motor, command| {
        let stage = IpcStageConfig { oscillator_damping: damping, ..stage(mode) };
        response(&config(vec![stage]), 53.0, motor, command)
    };
    for mode in [IpcMode::Direct, IpcMode::Indirect] {
        assert_eq!(with(mode, 0.2, 1.0, 0.0), with(mode, 0.2, 1.0, 5.0), "{mode:?}");
        assert_eq!(peak(&with(mode, 0.2, 0.0, 5.0)), 0.0, "{mode:?}");
    }
    let set_point = |motor, command| with(IpcMode::SetPoint, 0.2, motor, command);
    assert_eq!(set_point(0.0, 1.0), set_point(5.0, 1.0));
    assert_eq!(peak(&set_point(5.0, 0.0)), 0.0);
    assert_eq!(with(IpcMode::Direct, 0.2, 1.0, 1.0), with(IpcMode::Direct, 0.3, 1.0, 1.0));
    for mode in [IpcMode::Indirect, IpcMode::SetPoint] {
        assert_ne!(with(mode, 0.2, 1.0, 1.0), with(mode, 0.3, 1.0, 1.0), "{mode:?}");
    }
}
