#![expect(clippy::float_cmp, reason = "exact values are what is tested")]

use super::*;
use crate::control::fault::Issue;

const T: CycleTime = CycleTime::DEFAULT;

fn plant(model: PlantModel) -> Plant {
    Plant::new(&PlantConfig { model, ..PlantConfig::default() }, T).unwrap()
}

fn speed(speed_mm_s: f64) -> PlantInput {
    PlantInput { speed_mm_s, ..PlantInput::default() }
}

fn every_model() -> Vec<PlantModel> {
    let speed_loop =
        SpeedLoop { gain_per_s: 200.0, integral_time_s: Some(0.03), current_time_s: 0.0005 };
    vec![
        PlantModel::Follow,
        PlantModel::VENDOR_DEFAULT,
        PlantModel::FirstOrder { time_constant_s: 0.005 },
        PlantModel::TwoMass(TwoMassConfig {
            load_to_motor_ratio: 3.0,
            resonance_hz: 60.0,
            damping_ratio: 0.02,
            speed_loop,
        }),
        PlantModel::Modal(ModalConfig::rack_and_pinion()),
    ]
}

#[test]
fn first_order_step_response_is_the_closed_form() {
    let ta = 0.005;
    let mut plant = plant(PlantModel::FirstOrder { time_constant_s: ta });
    plant.start(0.0);
    for k in 1..=200_u32 {
        plant.advance(speed(100.0));
        let t = f64::from(k) * 1e-3;
        let rise = -libm::expm1(-t / ta);
        let m = plant.measured();
        assert!((m.motor_mm_s - 100.0 * rise).abs() < 1e-11, "speed in cycle {k}");
        assert!((m.motor_mm - 100.0 * (t - ta * rise)).abs() < 1e-11, "position in cycle {k}");
    }
}

#[test]
fn simulated_drive_step_response_is_the_closed_form() {
    let (d, w0) = (0.6, 100.0);
    let mut plant = plant(PlantModel::VENDOR_DEFAULT);
    plant.start(0.0);
    let wd = w0 * f64::sqrt(1.0 - d * d);
    for k in 1..=200_u32 {
        plant.advance(speed(100.0));
        let t = f64::from(k) * 1e-3;
        let swing = libm::cos(wd * t) + d / f64::sqrt(1.0 - d * d) * libm::sin(wd * t);
        let want = 100.0 * (1.0 - libm::exp(-d * w0 * t) * swing);
        assert!((plant.measured().motor_mm_s - want).abs() < 1e-11, "speed in cycle {k}");
    }
    // after the transient the position trails by v 2D/w0
    let lag = 100.0 * 0.2 - plant.measured().motor_mm;
    assert!((lag - 100.0 * 2.0 * d / w0).abs() < 1e-4, "lag {lag}");
}

#[test]
fn two_half_steps_are_one_full_step() {
    let half = CycleTime::from_us(500).unwrap();
    for model in every_model().into_iter().skip(1) {
        let config = PlantConfig { model, ..PlantConfig::default() };
        let mut whole = Plant::new(&config, T).unwrap();
        let mut halves = Plant::new(&config, half).unwrap();
        for k in 0..500_u32 {
            let input = PlantInput {
                speed_mm_s: f64::from(k % 7),
                acc_mm_s2: f64::from(k % 5),
                force_mm_s2: f64::from(k % 3),
                reference_mm: 0.0,
            };
            whole.advance(input);
            halves.advance(input);
            halves.advance(input);
            let (a, b) = (whole.measured(), halves.measured());
            for (x, y) in
                [(a.motor_mm, b.motor_mm), (a.load_mm, b.load_mm), (a.tcp_mm_s, b.tcp_mm_s)]
            {
                assert!((x - y).abs() <= 1e-12 * y.abs().max(1.0), "{config:?} {k}: {x} {y}");
            }
        }
    }
}

#[test]
fn two_masses_are_one_antiphase_mode() {
    let ratio: f64 = 3.0;
    let speed_loop =
        SpeedLoop { gain_per_s: 20.0, integral_time_s: Some(0.1), current_time_s: 0.0005 };
    let mut two = plant(PlantModel::TwoMass(TwoMassConfig {
        load_to_motor_ratio: ratio,
        resonance_hz: 40.0,
        damping_ratio: 0.03,
        speed_loop,
    }));
    let load = -f64::sqrt(1.0 / ratio);
    let mode = Mode {
        frequency_hz: 40.0,
        damping_ratio: 0.03,
        motor: f64::sqrt(ratio),
        load,
        tool: load,
        disturbance: load,
    };
    let mut modal = plant(PlantModel::Modal(ModalConfig { modes: vec![mode], speed_loop }));
    for k in 0..300_u32 {
        let input = PlantInput {
            speed_mm_s: if k < 100 { 50.0 } else { -20.0 },
            acc_mm_s2: if k % 40 < 20 { 300.0 } else { 0.0 },
            force_mm_s2: f64::from(k % 11) * 20.0,
            reference_mm: 0.0,
        };
        two.advance(input);
        modal.advance(input);
        let (a, b) = (two.measured(), modal.measured());
        for (x, y) in [
            (a.motor_mm, b.motor_mm),
            (a.motor_mm_s, b.motor_mm_s),
            (a.load_mm, b.load_mm),
            (a.load_mm_s, b.load_mm_s),
        ] {
            assert!((x - y).abs() < 1e-9, "cycle {k}: {x} {y}");
        }
    }
}

/// The velocity loop doubles the damping of the mode at 53 Hz (0.010 without it) and hardly changes that at 11 Hz
/// (0.020): 0.0211 and 0.0223 by the eigenvalues of the closed loop.
#[test]
fn velocity_loop_damps_the_modes() {
    use crate::analysis::decay::Decay;
    for (mode, frequency_hz, damping) in [(0, 53.0, 0.0211), (1, 11.0, 0.0223)] {
        let mut config = ModalConfig::rack_and_pinion();
        // the tool point moves relative to the load by one mode only; the dynamics are the same
        config.modes[1 - mode].tool = config.modes[1 - mode].load;
        let mut plant = plant(PlantModel::Modal(config));
        plant.start(0.0);
        plant.advance(speed(100.0));
        (0..200).for_each(|_| assert!(plant.advance(speed(0.0))));
        let ringing: Vec<f64> = (0..3000)
            .map(|_| {
                plant.advance(speed(0.0));
                plant.measured().tcp_mm_s - plant.measured().load_mm_s
            })
            .collect();
        let found = Decay::of(&ringing, 1000.0).unwrap();
        assert!((found.freq_hz / frequency_hz - 1.0).abs() < 0.02, "{found:?}");
        assert!((found.damping / damping - 1.0).abs() < 0.05, "{found:?}, expected {damping}");
    }
}

#[test]
fn undamped_mode_keeps_its_energy() {
    let w = std::f64::consts::TAU * 53.0;
    let mode = Mode {
        frequency_hz: 53.0,
        damping_ratio: 0.0,
        motor: 0.0,
        load: 1.0,
        tool: 0.0,
        disturbance: 1.0,
    };
    let speed_loop = SpeedLoop { gain_per_s: 1.0, integral_time_s: None, current_time_s: 0.01 };
    let mut plant = plant(PlantModel::Modal(ModalConfig { modes: vec![mode], speed_loop }));
    plant.start(0.0);
    plant.advance(PlantInput { force_mm_s2: 1000.0, ..PlantInput::default() });
    // the load moves with mode and body, the tool point with the body alone
    let energy = |m: &Measured| {
        let (q, p) = (m.load_mm - m.tcp_mm, m.load_mm_s - m.tcp_mm_s);
        w * w * q * q + p * p
    };
    let before = energy(plant.measured());
    (0..100_000).for_each(|_| assert!(plant.advance(PlantInput::default())));
    let after = energy(plant.measured());
    assert!((after / before - 1.0).abs() < 1e-9, "{before} {after}");
}

#[test]
fn an_axis_at_rest_stays_bit_exact() {
    for model in every_model() {
        let mut plant = plant(model);
        plant.start(0.1 + 0.2);
        for _ in 0..100 {
            plant.advance(PlantInput { reference_mm: 0.1 + 0.2, ..PlantInput::default() });
            let m = plant.measured();
            assert_eq!(
                [m.motor_mm, m.load_mm, m.tcp_mm, m.motor_mm_s],
                [0.1 + 0.2, 0.1 + 0.2, 0.1 + 0.2, 0.0]
            );
        }
    }
}

#[test]
fn dead_time_delays_the_command_and_nothing_else() {
    let model = PlantModel::FirstOrder { time_constant_s: 0.005 };
    let mut prompt = plant(model.clone());
    let config = PlantConfig { model, dead_time_cycles: 3, disturbance: None };
    let mut late = Plant::new(&config, T).unwrap();
    let mut past = Vec::new();
    for k in 0..100_u32 {
        prompt.advance(speed(f64::from(k % 9)));
        late.advance(speed(f64::from(k % 9)));
        past.push(prompt.measured().motor_mm);
        if k >= 3 {
            assert_eq!(late.measured().motor_mm, past[k as usize - 3]);
        }
    }
}

#[test]
fn follow_repeats_the_reference_one_cycle_later() {
    let mut plant = plant(PlantModel::Follow);
    plant.start(1.0);
    plant.advance(PlantInput { reference_mm: 1.1, ..PlantInput::default() });
    assert_eq!(plant.measured().motor_mm, 1.1);
    assert!((plant.measured().motor_mm_s - 100.0).abs() < 1e-9);
}

/// A force held over the substeps equals the same external force; four substeps sample a sine at their midpoints.
#[test]
fn disturbance_acts_in_quarter_cycles() {
    let model = PlantModel::FirstOrder { time_constant_s: 0.005 };
    let disturbance =
        Disturbance { amplitude_mm_s2: 40.0, frequency_hz: 53.0, full_speed_mm_s: 0.0 };
    let config =
        PlantConfig { model: model.clone(), dead_time_cycles: 0, disturbance: Some(disturbance) };
    let mut coarse = Plant::new(&config, T).unwrap();
    let quarter = CycleTime::from_us(250).unwrap();
    let mut fine = Plant::new(&PlantConfig { disturbance: None, ..config }, quarter).unwrap();
    for k in 0..400_u32 {
        coarse.advance(PlantInput::default());
        for i in 0..4 {
            let t = (f64::from(4 * k + i) + 0.5) * 250e-6;
            let force_mm_s2 = 40.0 * libm::sin(std::f64::consts::TAU * 53.0 * t);
            fine.advance(PlantInput { force_mm_s2, ..PlantInput::default() });
        }
        assert!((coarse.measured().motor_mm - fine.measured().motor_mm).abs() < 1e-12);
    }
}

#[test]
fn corrections_and_refusals() {
    let config = PlantConfig {
        model: PlantModel::Simulated { damping_ratio: 1.2, natural_rad_s: 100.0 },
        dead_time_cycles: 9,
        disturbance: None,
    };
    let (config, issues) = config.checked();
    assert_eq!(
        issues,
        [Issue::SimulationDamping { damping_ratio: 1.2 }, Issue::DeadTime { cycles: 9 }]
    );
    assert_eq!(config.dead_time_cycles, 5);
    assert_eq!(config.model, PlantModel::Simulated { damping_ratio: 0.999, natural_rad_s: 100.0 });
    for model in [
        PlantModel::FirstOrder { time_constant_s: 0.0 },
        PlantModel::Simulated { damping_ratio: 0.5, natural_rad_s: f64::NAN },
    ] {
        assert!(Plant::new(&PlantConfig { model, ..PlantConfig::default() }, T).is_err());
    }
}
