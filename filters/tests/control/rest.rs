//! Skipped cycles: an axis that is only computed while it does not rest gives the same output as one computed in every
//! cycle.

use kontur_filters::control::monitor::{LagMonitorConfig, LagMonitorType};
use kontur_filters::control::plant::{Disturbance, ModalConfig, PlantModel};
use kontur_filters::control::{
    AxisControl, AxisControlConfig, AxisInputs, Encoder, FeedforwardConfig, FeedforwardMode,
};
use kontur_filters::time::CycleTime;
use proptest::prelude::*;

const FIRST_ORDER: PlantModel = PlantModel::FirstOrder { time_constant_s: 0.005 };

fn plants() -> impl Strategy<Value = PlantModel> {
    prop_oneof![
        3 => Just(FIRST_ORDER),
        2 => Just(PlantModel::VENDOR_DEFAULT),
        1 => Just(PlantModel::Follow),
        1 => Just(PlantModel::Modal(ModalConfig::rack_and_pinion())),
    ]
}

prop_compose! {
    pub(crate) fn configs()(
        model in plants(),
        kind in prop::sample::select(&[
            LagMonitorType::Off,
            LagMonitorType::Standard,
            LagMonitorType::Linear,
            LagMonitorType::VelocityIndependent,
        ][..]),
        lag_min_mm in prop::sample::select(&[2.0, 1e-4][..]),
        mode in prop::sample::select(&[0_u16, 1, 7, 0x101, 0x203][..]),
        (dead_time_cycles, delay_cycles) in (0..4_usize, 0..3_usize),
        shift_s in prop::sample::select(&[0.0, 0.02][..]),
        disturbed in prop::bool::weighted(0.1),
        direct in prop::bool::weighted(0.2),
    ) -> AxisControlConfig {
        let mut config = AxisControlConfig::new(500.0, 1e4, 1e6);
        let mode = FeedforwardMode::from_bits_truncate(mode);
        config.feedforward = FeedforwardConfig { mode, velocity_delay_s: 2.5e-3, ..Default::default() };
        config.position.kv_per_s = 50.0;
        config.plant.model = model;
        config.plant.dead_time_cycles = dead_time_cycles;
        config.plant.disturbance = disturbed
            .then_some(Disturbance { amplitude_mm_s2: 5.0, frequency_hz: 3.0, full_speed_mm_s: 0.0 });
        config.lag = LagMonitorConfig { kind, lag_min_mm, delay_cycles, shift_s, ..Default::default() };
        config.encoder = if direct { Encoder::Direct } else { Encoder::Motor };
        config
    }
}

/// A part of a run: cycles, speed in mm per cycle, gain, jerk limitation, and another change at its beginning.
pub(crate) fn stretches() -> impl Strategy<Value = Vec<(u32, f64, f64, bool, u8)>> {
    let cycles = prop_oneof![2 => 1..60_u32, 1 => 2000..9000_u32];
    let speed = prop_oneof![2 => Just(0.0), 1 => -0.2..0.2];
    let gain = prop::sample::select(&[0.0, 0.0, 0.8][..]);
    prop::collection::vec((cycles, speed, gain, any::<bool>(), 0..12_u8), 1..8)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn a_cycle_left_out_is_the_one_before(config in configs(), stretches in stretches()) {
        let mut always = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
        let mut seldom = always.clone();
        let (mut set_mm, mut inputs) = (0.0, AxisInputs::default());
        let mut last = None;
        for (cycles, speed, gain, jerk_limited, change) in stretches {
            match change {
                0 => inputs.force_mm_s2 = 40.0 - inputs.force_mm_s2,
                1 => inputs.additional_mm = 0.1 - inputs.additional_mm,
                2 => inputs.encoder_offset_mm = 0.01 - inputs.encoder_offset_mm,
                3 => [&mut always, &mut seldom].into_iter().for_each(|a| a.expect_stop(set_mm)),
                4 => [&mut always, &mut seldom].into_iter().for_each(AxisControl::halt),
                5 => [&mut always, &mut seldom].into_iter().for_each(AxisControl::open_loop),
                _ => {}
            }
            for _ in 0..cycles {
                set_mm += speed;
                let leave_out = seldom.rests_under(set_mm, gain, jerk_limited, &inputs);
                always.set_inputs(inputs);
                let out = format!("{:?}", always.step(set_mm, gain, jerk_limited));
                if leave_out {
                    prop_assert_eq!(Some(&out), last.as_ref());
                    prop_assert!(always.faults().is_empty());
                } else {
                    seldom.set_inputs(inputs);
                    let asked = format!("{:?}", seldom.step(set_mm, gain, jerk_limited));
                    prop_assert_eq!(&asked, &out);
                    prop_assert_eq!(always.faults(), seldom.faults());
                }
                prop_assert_eq!(always.distance_mm().to_bits(), seldom.distance_mm().to_bits());
                last = Some(out);
            }
        }
    }
}

/// An axis at standstill does rest: at once where it starts, and some time after a motion.
#[test]
fn axes_come_to_rest() {
    for model in [FIRST_ORDER, PlantModel::VENDOR_DEFAULT, PlantModel::Follow] {
        let mut config = AxisControlConfig::new(500.0, 1e4, 1e6);
        config.plant.model = model.clone();
        let mut axis = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
        let mut cycles = |set_mm: f64, most: u32| {
            let rests =
                |axis: &AxisControl| axis.rests_under(set_mm, 0.0, true, &AxisInputs::default());
            (0..most).find(|_| {
                axis.step(set_mm, 0.0, true);
                rests(&axis)
            })
        };
        assert!(cycles(0.0, 40).is_some(), "{model:?}");
        assert!(cycles(0.1, 20_000).is_some_and(|k| k >= 32), "{model:?}");
    }
}
