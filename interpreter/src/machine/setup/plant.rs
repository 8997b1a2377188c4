//! Drive and mechanics of one axis: the vendor's simulated drive or a model of `kontur.lis`.

use crate::machine::Axis;
use crate::machine::overrides::OVERRIDE;
use crate::machine::parameters::Setting;
use crate::machine::table::param::{Number, Param, Place};
use crate::machine::table::{Indices, axis_drive, own as of};
use kontur_filters::control::plant::{
    Disturbance, ModalConfig, Mode, PlantConfig, PlantModel, SpeedLoop, TwoMassConfig,
};

/// The simulated axis as configured by the lists.
pub(super) fn config(axis: &Axis) -> PlantConfig {
    let amplitude_mm_s2 = axis.get(of::DISTURBANCE_AMPLITUDE);
    let disturbance = Disturbance {
        amplitude_mm_s2,
        frequency_hz: axis.get(of::DISTURBANCE_FREQUENCY),
        full_speed_mm_s: axis.get(of::DISTURBANCE_FULL_SPEED),
    };
    PlantConfig {
        model: model(axis),
        dead_time_cycles: axis.get(axis_drive::SIMU_DEAD_TIME) as usize,
        disturbance: Some(disturbance).filter(|d| d.amplitude_mm_s2.abs() > 0.0),
    }
}

/// The first key in `kontur.lis` that belongs to a model other than that of the axis, and the model that reads it.
pub(super) fn of_another_model(axis: &Axis) -> Option<(Place, &'static str)> {
    const TWO_MASS: &str = "TWO_MASS";
    const BOTH: &str = "TWO_MASS and MODAL";
    let readers = [
        (of::TIME_CONSTANT, "PT1"),
        (of::SPEED_GAIN, BOTH),
        (of::SPEED_INTEGRAL, BOTH),
        (of::CURRENT_TIME, BOTH),
        (of::MASS_MOTOR, TWO_MASS),
        (of::MASS_LOAD, TWO_MASS),
        (of::RESONANCE, TWO_MASS),
        (of::DAMPING, TWO_MASS),
    ];
    // a model that is tried instead of the one in the list
    let model_by = axis.set_by(of::PLANT_MODEL.at(axis.number()));
    if model_by.and_then(|by| by.at.as_ref()).is_some_and(|at| &*at.file == OVERRIDE) {
        return None;
    }
    let model = axis.get(of::PLANT_MODEL).unwrap_or_default();
    axis.own_settings().find_map(|(indices, setting)| {
        let row = setting.row;
        let of_modes = row.key.starts_with("kontur.axis[i].plant.mode[j]").then_some("MODAL");
        let reader = readers.iter().find(|(param, _)| param.place().row.key == row.key);
        let reader = reader.map(|(_, reader)| *reader).or(of_modes)?;
        (!reader.split(" and ").any(|name| name == model))
            .then_some((Place { row, indices }, reader))
    })
}

/// The first parameter of the vendor's simulated drive that a list changes although `kontur.lis` selects another model.
pub(super) fn of_the_simulated_drive(axis: &Axis) -> Option<(Indices, &Setting)> {
    // the sampling time has a message of its own, which also compares it with the cycle
    let sampling = [axis_drive::SIMU_SAMPLING_NUM, axis_drive::SIMU_SAMPLING_DENOM]
        .map(|param| param.place().row.key);
    let model = axis.get(of::PLANT_MODEL).unwrap_or_default();
    if matches!(model.as_ref(), "" | "SIMU") {
        return None;
    }
    axis.parameters().settings().find(|(_, setting)| {
        let row = setting.row;
        row.needs_simu() && !sampling.contains(&row.key) && setting.is_changed()
    })
}

fn model(axis: &Axis) -> PlantModel {
    let speed_loop = || SpeedLoop {
        gain_per_s: axis.get(of::SPEED_GAIN),
        integral_time_s: Some(axis.get(of::SPEED_INTEGRAL)),
        current_time_s: axis.get(of::CURRENT_TIME),
    };
    match axis.get(of::PLANT_MODEL).as_deref() {
        Some("PT1") => PlantModel::FirstOrder { time_constant_s: axis.get(of::TIME_CONSTANT) },
        Some("TWO_MASS") => PlantModel::TwoMass(TwoMassConfig {
            load_to_motor_ratio: load_to_motor(axis),
            resonance_hz: axis.get(of::RESONANCE),
            damping_ratio: axis.get(of::DAMPING),
            speed_loop: speed_loop(),
        }),
        Some("MODAL") => {
            PlantModel::Modal(ModalConfig { modes: modes(axis), speed_loop: speed_loop() })
        }
        _ if axis.get(axis_drive::SIMU_FOLLOWS) => PlantModel::Follow,
        _ => PlantModel::Simulated {
            damping_ratio: axis.listed(axis_drive::SIMU_DAMPING_NUM)
                / axis.listed(axis_drive::SIMU_DAMPING_DENOM),
            natural_rad_s: axis.listed(axis_drive::SIMU_FREQUENCY_NUM)
                / axis.listed(axis_drive::SIMU_FREQUENCY_DENOM),
        },
    }
}

/// The masses of TWO_MASS that are set, of the motor and of the load.
fn masses(axis: &Axis) -> [Option<f64>; 2] {
    [of::MASS_MOTOR, of::MASS_LOAD]
        .map(|mass| axis.set_by(mass.at(axis.number())).map(|_| axis.get(mass)))
}

/// The mass of TWO_MASS that is set alone, but is no share of the whole; equal masses replace it.
pub(super) fn no_share(axis: &Axis) -> Option<Place> {
    let mass = match masses(axis) {
        [Some(motor), None] if motor >= 1.0 => of::MASS_MOTOR,
        [None, Some(load)] if load >= 1.0 => of::MASS_LOAD,
        _ => return None,
    };
    let is_two_mass = axis.get(of::PLANT_MODEL).as_deref() == Some("TWO_MASS");
    is_two_mass.then(|| mass.at(axis.number()).place())
}

/// Ratio of the masses of TWO_MASS. One alone is a share of the whole, and the other side has the rest; without any,
/// they are equal.
fn load_to_motor(axis: &Axis) -> f64 {
    match masses(axis) {
        [Some(motor), Some(load)] => load / motor,
        [Some(motor), None] if motor < 1.0 => (1.0 - motor) / motor,
        [None, Some(load)] if load < 1.0 => load / (1.0 - load),
        _ => 1.0,
    }
}

/// Modes that have a frequency, in the order of their numbers.
fn modes(axis: &Axis) -> Vec<Mode> {
    let mode = |index: u32| {
        let part = |param: Param<Number>| axis.get(param.and(index));
        Mode {
            frequency_hz: axis.get(of::MODE_FREQUENCY.and(index)).unwrap_or_default(),
            damping_ratio: part(of::MODE_DAMPING),
            motor: part(of::MODE_MOTOR),
            load: part(of::MODE_LOAD),
            tool: part(of::MODE_TOOL),
            disturbance: part(of::MODE_DISTURBANCE),
        }
    };
    axis.own_settings()
        .filter(|(_, setting)| setting.row.key == of::MODE_FREQUENCY.place().row.key)
        .map(|(indices, _)| mode(indices[1]))
        .collect()
}
