//! `#MCS ON`: frames and offsets are suspended; programmed coordinates are axis positions.
//!
//! Source: TF5200 programming manual, temporary transition to the machine coordinate system.

use super::Coordinates;
use super::active::{Active, Suspended};
use super::layer::NO_GROUP;
use kontur_motion::axis::AxisVec;

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
        let kept = Active { channel_group: self.active.channel_group, ..Active::none(n) };
        let active = std::mem::replace(&mut self.active, kept);
        self.suspended = Some(Box::new(Suspended { active, without_tools, tool_aside: true }));
        self.tool = AxisVec::zeros(n);
        self.select_zero_group(NO_GROUP, false);
        self.frame_changed();
    }

    /// `#MCS OFF`; the offsets of the selected tool are restored with [`set_tool`](Self::set_tool). Returns false if it was not
    /// on.
    pub(in crate::exec) fn leave_machine(&mut self) -> bool {
        let Some(before) = self.suspended.take() else { return false };
        self.active = before.active;
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
