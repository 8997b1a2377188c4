//! State restored at the end of a cycle: G functions without values, centre and radius of arcs, the feed rate.
//!
//! G functions with values or axis words (G92, G129, G159=2, G351) and the settings of `#` commands are kept. With
//! `#RETAIN CYCLE CHANGES` and P-CHAN-00210 = 1 everything is kept, as in subroutines. `V.G.CYCLE_CHANGES_MODAL` sets
//! P-CHAN-00210 for the current cycle and those after it (assumption: the page only names the variable). Source:
//! channel parameters 476043659.
//!
//! Assumption: G96 is kept, because it has a value (S), and so is G97, which ends it.
//!
//! Assumption: a system of `#CS` that the cycle leaves open, or closes, retains its current zero offset; G69 in a cycle
//! is kept, because G68 has values.

use super::state::BeforeCycle;
use crate::exec::block::modal::Modal;
use crate::exec::decoder::Decoder;
use crate::syntax::ast::Span;

impl Decoder {
    pub(super) fn enter_cycle(&mut self) -> BeforeCycle {
        let retains = self.calls.cycle_changes_stay;
        BeforeCycle {
            modal: self.modal.clone(),
            systems: self.geometry.coordinates.systems(),
            zero_group: self.geometry.coordinates.zero_group(),
            feedforward: self.motion.feedforward.on,
            spline: self.contour.akima.selected,
            retains: std::mem::replace(&mut self.calls.retain_cycle_changes, retains),
        }
    }

    pub(super) fn leave_cycle(&mut self, before: BeforeCycle) {
        let BeforeCycle { modal, systems, zero_group, feedforward, spline, retains } = before;
        if std::mem::replace(&mut self.calls.retain_cycle_changes, retains) {
            return;
        }
        if feedforward != self.motion.feedforward.on {
            self.motion.feedforward.on = feedforward;
            self.contour.event(self.motion.feedforward.event());
        }
        if spline != self.contour.akima.selected {
            self.report.extend(self.contour.akima.select(spline, Span::default()));
        }
        let coordinates = &mut self.geometry.coordinates;
        let (group, by_value) = zero_group;
        let (now, stays) = coordinates.zero_group();
        if systems == coordinates.systems() && group != now && !stays {
            coordinates.select_zero_group(group, by_value);
        }
        let mirrored = modal.mirrored;
        if mirrored != self.modal.mirrored {
            for (main, mirrored) in mirrored.into_iter().enumerate() {
                if let Some(axis) = self.geometry.coordinates.main_axis(main) {
                    self.geometry.coordinates.set_mirrored(axis, mirrored);
                }
            }
        }
        let restored = Modal { commanded: self.modal.commanded, ..modal };
        if self.modal != restored {
            self.modal = restored;
            self.geometry.apply_tool(self.modal.plane.main_axes());
            self.motion.limits.changed();
        }
    }
}
