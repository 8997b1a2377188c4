//! `#MCS ON`: frames and offsets are put aside, the words of the program are positions of the axes.
//!
//! Source: TF5200 programming manual, temporary transition to the machine coordinate system.

use super::super::frame::Frame;
use super::{Coordinates, Rotation};
use kontur_motion::axis::AxisVec;
use std::collections::BTreeMap;

/// A zero-offset group without entries.
const NO_GROUP: u32 = u32::MAX;

/// Frames and offsets that come back with `#MCS OFF`.
#[derive(Clone, Debug)]
pub(super) struct Suspended {
    applied: AxisVec,
    zero_group: u32,
    zero_written: BTreeMap<usize, f64>,
    preset: AxisVec,
    position_preset: AxisVec,
    measuring: AxisVec,
    mirrored: Vec<bool>,
    rotation: Option<Rotation>,
    systems: Vec<Frame>,
    /// EX TOOL: a tool change does not act before `#MCS OFF`.
    without_tools: bool,
}

impl Coordinates {
    /// The words of the program are positions of the axes (`#MCS ON`).
    pub(in crate::exec) fn is_machine(&self) -> bool {
        self.suspended.is_some()
    }

    /// `#MCS ON`, with EX TOOL `without_tools`.
    pub(in crate::exec) fn enter_machine(&mut self, without_tools: bool) {
        if self.suspended.is_some() {
            return;
        }
        let n = self.target.len();
        let zeros = || AxisVec::zeros(n);
        self.suspended = Some(Box::new(Suspended {
            applied: std::mem::replace(&mut self.applied, zeros()),
            zero_group: std::mem::replace(&mut self.zero_group, NO_GROUP),
            zero_written: std::mem::take(&mut self.zero_written),
            preset: std::mem::replace(&mut self.preset, zeros()),
            position_preset: std::mem::replace(&mut self.position_preset, zeros()),
            measuring: std::mem::replace(&mut self.measuring, zeros()),
            mirrored: std::mem::replace(&mut self.mirrored, vec![false; n]),
            rotation: self.rotation.take(),
            systems: std::mem::take(&mut self.systems),
            without_tools,
        }));
        self.tool = zeros();
        self.frame_changed();
    }

    /// `#MCS OFF`; the offsets of the tool in use come back with [`set_tool`](Self::set_tool). False if it was not on.
    pub(in crate::exec) fn leave_machine(&mut self) -> bool {
        let Some(before) = self.suspended.take() else { return false };
        let Suspended { applied, zero_group, preset, position_preset, mirrored, .. } = *before;
        (self.applied, self.zero_group, self.preset) = (applied, zero_group, preset);
        (self.position_preset, self.mirrored) = (position_preset, mirrored);
        (self.rotation, self.systems) = (before.rotation, before.systems);
        (self.measuring, self.zero_written) = (before.measuring, before.zero_written);
        self.frame_changed();
        true
    }

    /// Tool offsets do not act: `#MCS ON EX TOOL`.
    pub(in crate::exec) fn is_without_tools(&self) -> bool {
        self.suspended.as_ref().is_some_and(|suspended| suspended.without_tools)
    }
}
