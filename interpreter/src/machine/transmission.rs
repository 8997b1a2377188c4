//! Feed constant and gear between the motor and the axis, in the units of the lists.

use super::axis::Axis;
use super::kind::AxisKind;
use super::table::{axis_control, axis_drive};

/// Whether a ratio or constant scales nothing.
pub(super) fn is_one(x: f64) -> bool {
    (x - 1.0).abs() <= 0.0
}

/// Feed constant: path in 0.1 um, and the corresponding revolutions of the gear output.
pub(super) fn feed_constant(axis: &Axis) -> [f64; 2] {
    [axis_drive::FEED_CONSTANT_PATH, axis_drive::FEED_CONSTANT_REVS].map(|param| axis.listed(param))
}

/// Gear ratio: revolutions of input and output.
pub(super) fn gear(axis: &Axis) -> [f64; 2] {
    [axis_control::GEAR_IN, axis_control::GEAR_OUT].map(|param| axis.listed(param))
}

/// Motor-side scaling (a feed constant or gear ratio other than 1) means a rotary motor, otherwise the motor of a linear
/// axis is linear.
pub(super) fn has_rotary_motor(axis: &Axis) -> bool {
    axis.kind() != AxisKind::Linear
        || !feed_constant(axis).into_iter().chain(gear(axis)).all(is_one)
}

/// Whether P-AXIS-00362 or P-AXIS-00363 is not 1, so that the feed constant determines the resolution.
pub(super) fn feed_constant_given(axis: &Axis) -> bool {
    !feed_constant(axis).into_iter().all(is_one)
}
