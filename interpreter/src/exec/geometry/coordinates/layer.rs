//! A coordinate system with its own zero offsets, G92 and position presets.

use crate::exec::geometry::frame::Frame;
use kontur_motion::axis::AxisVec;
use std::collections::BTreeMap;

/// A zero-offset group without entries.
pub(super) const NO_GROUP: u32 = u32::MAX;

/// A coordinate system and the offsets in it.
#[derive(Clone, Debug)]
pub(super) struct Layer {
    /// Its frame in the system below, including the offsets of that system.
    pub(super) system: Frame,
    /// The number under which it is stored; `None` without a number.
    pub(super) number: Option<u32>,
    /// Active zero-offset group, 0 = G53.
    pub(super) zero_group: u32,
    /// Whether it was selected by G159.
    pub(super) zero_group_by_value: bool,
    /// Values of `V.G.NP_AKT`, valid until another group is selected.
    pub(super) zero_written: BTreeMap<usize, f64>,
    /// G92.
    pub(super) preset: AxisVec,
    /// `#PSET`.
    pub(super) position_preset: AxisVec,
}

impl Layer {
    /// Without offsets.
    pub(super) fn new(system: Frame, axes: usize) -> Self {
        Self {
            system,
            number: None,
            zero_group: NO_GROUP,
            zero_group_by_value: false,
            zero_written: BTreeMap::new(),
            preset: AxisVec::zeros(axes),
            position_preset: AxisVec::zeros(axes),
        }
    }
}
