//! G112: another gear stage of axes and spindles, that is, another set of the parameters `getriebe[i]` of their lists.
//!
//! The mechanical change is programmed with functions of its own; the positions stay.
//!
//! Source: TF5200 programming manual 206730251, 208157451; diagnosis 60285 (259710859), 3210 (249505419).
//!
//! Assumptions: the path comes to rest and the axes are in position (P-AXIS-00236) before the change; gantry slaves keep their
//! own stage; a spindle is at rest after M5, whether or not its ramp has ended, and the change waits for the end of the ramp.

use crate::diag::{Condition, ValueKind};
use crate::exec::block::collected::{GWord, Words};
use crate::exec::decoder::{Decoder, report_consequences};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::step::{Event, SpindleState, Sync};
use crate::exec::values::number::whole;
use crate::machine::Axis;
use crate::syntax::ast::Span;
use std::sync::Arc;

impl Decoder {
    /// G112 with the words of axes and spindles; each value is the number of a gear stage (P-AXIS-00135).
    pub(in crate::exec) fn change_gears(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        if words.axes.is_empty() && words.speeds.is_empty() {
            let text = "G112 without an axis or a spindle";
            return Err(Fault::new(Condition::AxisMissing, text, g.span));
        }
        for (axis, number, span) in &words.axes {
            let before = self.machine.axes[*axis].gear();
            let known = self.machine.chain_issues(*axis);
            let machine = Arc::make_mut(&mut self.machine);
            select(&mut machine.axes[*axis], *number, *span)?;
            let axis_number = machine.axes[*axis].number();
            if machine.axes[*axis].gear() != before {
                // a following error would become another speed command with the other gain
                self.sync(Sync::FlushWait);
                self.sync(Sync::ExactStop { alone: true });
                report_consequences(&self.machine, *axis, &known, &mut self.report, *span);
                self.axis_changes(axis_number, *span);
            }
        }
        for (spindle, number, span) in &words.speeds {
            self.change_spindle_gear(*spindle, *number, *span)?;
        }
        Ok(())
    }

    fn change_spindle_gear(&mut self, spindle: usize, number: f64, span: Span) -> Outcome<()> {
        let state = &self.motion.spindles[spindle];
        let name = state.name.clone();
        let Some(index) = state.index else {
            let what = format!("G112 of {name}, which has no list,");
            return Err(Fault::unsupported(what, span));
        };
        if state.runs || state.is_turning() {
            let text = format!("G112: spindle {name} is turning");
            let axis = &self.machine.spindles[index];
            return Err(Fault::new(Condition::GearWhileMoving, text, span)
                .with(|d| d.axis(axis.number(), axis.name())));
        }
        let listed = &mut Arc::make_mut(&mut self.machine).spindles[index];
        let before = listed.gear();
        select(listed, number, span)?;
        if listed.gear() != before {
            let (number, dynamics) = (listed.number(), Box::new(listed.dynamics()));
            self.sync(Sync::Spindle { spindle: index, state: SpindleState::Rest });
            self.contour.event(Event::SpindleDynamics { spindle: index, dynamics });
            self.axis_changes(number, span);
            // the S word was within the limit of the stage before
            self.motion.spindles[spindle].check_speed(&self.machine, &mut self.report, span);
        }
        Ok(())
    }
}

/// 3210 if the list has no stage with this number.
fn select(axis: &mut Axis, number: f64, span: Span) -> Outcome<()> {
    if whole(number, 1, u32::from(u16::MAX)).is_some_and(|number| axis.change_gear(number)) {
        return Ok(());
    }
    let text = format!("axis {} has no gear stage {number}", axis.name());
    let (logical, name) = (axis.number(), axis.name().to_owned());
    Err(Fault::new(Condition::GearUnknown, text, span)
        .with(|d| d.axis(logical, name).value(ValueKind::Wrong, number, "-")))
}
