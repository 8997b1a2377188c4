//! Drive and mechanics of one axis: the vendor's simulated drive or a model of `kontur.lis`.

use super::control::{cycles, raw};
use crate::machine::Axis;
use kontur_filters::control::plant::{
    Disturbance, ModalConfig, Mode, PlantConfig, PlantModel, SpeedLoop, TwoMassConfig,
};

/// The simulated axis as the lists state it.
pub(super) fn config(axis: &Axis) -> PlantConfig {
    let amplitude_mm_s2 = own(axis, "plant.disturbance.amplitude");
    let disturbance = Disturbance {
        amplitude_mm_s2,
        frequency_hz: own(axis, "plant.disturbance.frequency"),
        full_speed_mm_s: own(axis, "plant.disturbance.full_speed"),
    };
    PlantConfig {
        model: model(axis),
        dead_time_cycles: cycles(axis.raw("antr.simu.totzeit")),
        disturbance: Some(disturbance).filter(|d| d.amplitude_mm_s2.abs() > 0.0),
    }
}

/// Number of a key of `kontur.lis`; every key used has a default.
fn own(axis: &Axis, key: &str) -> f64 {
    let value = axis.own(key);
    debug_assert!(value.is_some(), "{key} is no number with a default");
    value.unwrap_or_default()
}

fn model(axis: &Axis) -> PlantModel {
    let speed_loop = || SpeedLoop {
        gain_per_s: own(axis, "plant.kp"),
        integral_time_s: Some(own(axis, "plant.tn_us")),
        current_time_s: own(axis, "plant.ti_us"),
    };
    match axis.own_text("plant.model").as_deref() {
        Some("PT1") => PlantModel::FirstOrder { time_constant_s: own(axis, "plant.ta_us") },
        Some("TWO_MASS") => PlantModel::TwoMass(TwoMassConfig {
            load_to_motor_ratio: own(axis, "plant.mass_load") / own(axis, "plant.mass_motor"),
            resonance_hz: own(axis, "plant.f0"),
            damping_ratio: own(axis, "plant.damping"),
            speed_loop: speed_loop(),
        }),
        Some("MODAL") => {
            PlantModel::Modal(ModalConfig { modes: modes(axis), speed_loop: speed_loop() })
        }
        _ if axis.flag("antr.simu.ist_gleich_soll") => PlantModel::Follow,
        _ => PlantModel::Simulated {
            damping_ratio: raw(axis, "antr.simu.daempfung_z") / raw(axis, "antr.simu.daempfung_n"),
            natural_rad_s: raw(axis, "antr.simu.eigenfrequenz_z")
                / raw(axis, "antr.simu.eigenfrequenz_n"),
        },
    }
}

/// Modes that have a frequency, in the order of their numbers.
fn modes(axis: &Axis) -> Vec<Mode> {
    let of = |index: u32| {
        let part = |key: &str| own(axis, &format!("plant.mode[{index}].{key}"));
        Mode {
            frequency_hz: part("f0"),
            damping_ratio: part("damping"),
            motor: part("phi_motor"),
            load: part("phi_load"),
            tool: part("phi_tcp"),
            disturbance: part("phi_dist"),
        }
    };
    axis.own_settings()
        .filter(|(_, setting)| setting.row.key == "kontur.axis[i].plant.mode[j].f0")
        .map(|(indices, _)| of(indices[1]))
        .collect()
}
