//! Kind and number of an axis as stated in its list.

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

/// Bits of the axis mode (P-AXIS-00015).
pub(super) mod mode {
    /// No modulo calculation.
    pub(in crate::machine) const LINEAR: u32 = 0x1;
    /// Rotary axes and spindles count modulo.
    pub(in crate::machine) const MODULO: u32 = 0x4;
    /// Face turning axis: its words may be diameters.
    pub(in crate::machine) const FACE_TURNING: u32 = 0x40;
    /// Longitudinal turning axis.
    pub(in crate::machine) const LONGITUDINAL_TURNING: u32 = 0x80;
    /// Master of a gantry coupling.
    pub(in crate::machine) const GANTRY_MASTER: u32 = 0x1_0000;
    /// C axis: `#CYL` and `#FACE` turn the workpiece with it.
    pub(in crate::machine) const C_AXIS: u32 = 0x200;
    /// Slave of a gantry coupling.
    pub(in crate::machine) const GANTRY_SLAVE: u32 = 0x2_0000;
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
