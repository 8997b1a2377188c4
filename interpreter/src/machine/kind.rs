//! Kind and number of an axis, as its list states them.

use super::parameters::Parameters;
use super::table::axis_general;

/// Kind of an axis (P-AXIS-00018).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisKind {
    /// Translatory: mm.
    Linear,
    /// Rotary: degrees.
    Rotary,
    /// Spindle: degrees, speed in rpm.
    Spindle,
}

/// Logical axis number of an axis list.
pub(super) fn logical_number(parameters: &Parameters) -> u32 {
    parameters.get(axis_general::NUMBER)
}

/// Kind of axis of an axis list.
pub(super) fn kind_of(parameters: &Parameters) -> AxisKind {
    match parameters.get(axis_general::KIND) {
        2 => AxisKind::Rotary,
        4 => AxisKind::Spindle,
        _ => AxisKind::Linear,
    }
}
