//! `#MCS ON`: frames and offsets are suspended; programmed coordinates are axis positions.
//!
//! Source: TF5200 programming manual, temporary transition to the machine coordinate system.

use super::super::frame::Frame;
use super::layer::{Layer, NO_GROUP};
use super::{Coordinates, Rotation};
use kontur_motion::axis::AxisVec;

/// Frames and offsets that `#MCS OFF` restores.
#[derive(Clone, Debug)]
pub(super) struct Suspended {
    applied: AxisVec,
    lowest: Layer,
    channel_group: Option<u32>,
    systems: Vec<Layer>,
    measuring: AxisVec,
    mirrored: Vec<bool>,
    rotation: Option<Rotation>,
    /// EX TOOL: a tool change takes effect only after `#MCS OFF`.
    without_tools: bool,
    /// Offsets of the tool that was selected before; those of a newly selected tool apply.
    tool_aside: bool,
}

impl Suspended {
    /// Coordinate systems to restore.
    pub(super) fn systems(&self) -> &[Layer] {
        &self.systems
    }
}

impl Coordinates {
    /// Whether programmed coordinates are axis positions (`#MCS ON`).
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
            lowest: std::mem::replace(&mut self.lowest, Layer::new(Frame::IDENTITY, n)),
            channel_group: self.channel_group,
            systems: std::mem::take(&mut self.systems),
            measuring: std::mem::replace(&mut self.measuring, zeros()),
            mirrored: std::mem::replace(&mut self.mirrored, vec![false; n]),
            rotation: self.rotation.take(),
            without_tools,
            tool_aside: true,
        }));
        self.tool = zeros();
        self.select_zero_group(NO_GROUP, false);
        self.frame_changed();
    }

    /// `#MCS OFF`; the offsets of the selected tool are restored with [`set_tool`](Self::set_tool). Returns false if it was not
    /// on.
    pub(in crate::exec) fn leave_machine(&mut self) -> bool {
        let Some(before) = self.suspended.take() else { return false };
        let Suspended { applied, lowest, channel_group, systems, .. } = *before;
        let Suspended { measuring, mirrored, rotation, .. } = *before;
        (self.applied, self.lowest, self.systems) = (applied, lowest, systems);
        self.channel_group = channel_group;
        (self.measuring, self.mirrored, self.rotation) = (measuring, mirrored, rotation);
        self.frame_changed();
        true
    }

    /// Called when tool data are programmed: between `#MCS ON` and `#MCS OFF` they apply, earlier ones do not.
    pub(in crate::exec) fn tool_programmed(&mut self) {
        if let Some(suspended) = &mut self.suspended {
            suspended.tool_aside = false;
        }
    }

    /// Whether tool offsets are suspended: EX TOOL, or no tool was programmed since `#MCS ON`.
    pub(in crate::exec) fn is_without_tools(&self) -> bool {
        self.suspended.as_ref().is_some_and(|before| before.without_tools || before.tool_aside)
    }
}
