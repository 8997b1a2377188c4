//! Gear stages of an axis: sets of parameters `getriebe[i]`, of which one is in force (G112).
//!
//! Source: TF5200 axis parameters, P-AXIS-00079 (117429259) and P-AXIS-00135 (117585419): the first stage has the number 1, the
//! others have 0 unless the list states one.

use super::parameters::Parameters;
use super::table::param::{Param, Place, whole};
use super::table::{Indices, Row, axis_general};

/// Whether every gear stage has its own value of a parameter.
pub(super) fn is_of_gear(row: &Row) -> bool {
    row.key.starts_with("getriebe[i]")
}

/// The place of a parameter for a gear stage, given as an index.
pub(super) fn of_stage(stage: u32, place: Place) -> Place {
    let indices: Indices =
        if stage > 0 && is_of_gear(place.row) { [stage, 0] } else { place.indices };
    Place { indices, ..place }
}

/// [`of_stage`] for a typed parameter.
pub(super) fn param_of<K>(stage: u32, param: Param<K>) -> Param<K> {
    if stage > 0 && is_of_gear(param.place().row) { param.at(stage) } else { param }
}

/// Number of a gear stage; 0 if it cannot be selected.
pub(super) fn number_of(parameters: &Parameters, stage: u32) -> u32 {
    let default = u32::from(stage == 0);
    parameters.get(axis_general::GEAR_NUMBER.at(stage)).and_then(whole).unwrap_or(default)
}

/// Indices of the stages that have a number.
pub(super) fn stages(parameters: &Parameters) -> Vec<u32> {
    let key = axis_general::GEAR_NUMBER.place().row.key;
    let listed = parameters.settings().filter(|(_, s)| s.row.key == key).map(|([i, _], _)| i);
    let mut all: Vec<u32> = listed.filter(|i| *i > 0).collect();
    all.insert(0, 0);
    all.retain(|stage| number_of(parameters, *stage) > 0);
    all
}

/// The stage with a number.
pub(super) fn of_number(parameters: &Parameters, number: u32) -> Option<u32> {
    stages(parameters).into_iter().find(|stage| number_of(parameters, *stage) == number)
}

/// The stage in force at start-up; the first one if no stage has the number of P-AXIS-00079, which is reported with the list.
pub(super) fn at_start(parameters: &Parameters) -> u32 {
    of_number(parameters, parameters.get(axis_general::GEAR_STAGE)).unwrap_or(0)
}
