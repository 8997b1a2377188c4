//! `#PSET` and `#PRESET`: coordinates for the current positions of the axes.

use crate::diag::Condition;
use crate::exec::block::choice::Compensation;
use crate::exec::block::collected::Words;
use crate::exec::block::modal::Modal;
use crate::exec::contour::Contour;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::names::AxisNames;
use crate::exec::output::Output;
use crate::exec::values::number::LARGEST_MM;
use crate::machine::Machine;
use crate::syntax::ast::Span;

impl Geometry {
    /// Whether the modes, the other words and the axes of the block permit the command.
    fn presets_allowed(
        &self,
        words: &Words<'_>,
        sets: bool,
        modal: &Modal,
        contour: &Contour,
        at: Span,
    ) -> Outcome<()> {
        if let Some(g) = words.of_the_path() {
            let text = format!("G{:02} in the block of #PSET or #PRESET", g.row.number);
            return Err(Fault::new(Condition::PresetWithPath, text, g.span));
        }
        if let Some(span) = words.axis_before(at) {
            let text = "a word of an axis before #PSET or #PRESET";
            return Err(Fault::new(Condition::CommandNotAlone, text, span));
        }
        let coordinates = &self.coordinates;
        if (0..coordinates.target().len()).any(|axis| coordinates.mirrored(axis)) {
            let text = "#PSET and #PRESET cannot be used with mirroring";
            return Err(Fault::new(Condition::PresetWhileMirrored, text, at));
        }
        if !sets && contour.awaits_departure() {
            let text = "#PRESET before the motion that ends tool radius compensation";
            return Err(Fault::new(Condition::FlushAfterCompensation, text, at));
        }
        let conflict = if modal.compensation != Compensation::Off {
            Some((Condition::PresetWithCompensation, "tool radius compensation"))
        } else if modal.diameter.is_some() {
            Some((Condition::PresetWithDiameters, "diameter programming (G51)"))
        } else if coordinates.rotation().is_some() {
            Some((Condition::Syntax, "rotation"))
        } else {
            None
        };
        if let Some((condition, what)) = conflict {
            let text = format!("#PSET and #PRESET cannot be used with {what}");
            return Err(Fault::new(condition, text, at));
        }
        let beside = words.axes.iter().find(|(axis, _, _)| coordinates.main_index(*axis).is_none());
        if let Some((_, _, span)) = beside.filter(|_| coordinates.systems() > 0) {
            let what =
                "#PSET and #PRESET of an axis that is not a main axis, in a coordinate system";
            return Err(Fault::unsupported(what, *span));
        }
        Ok(())
    }

    /// A coordinate of an axis in mm, scaled (`#SCALE`). That of `#PSET` is, too: offsets are not scaled (207656459), so that only
    /// then the axis need not move to be there (207101835).
    pub(in crate::exec) fn scaled_mm(
        &self,
        axis: usize,
        value: f64,
        machine: &Machine,
        modal: &Modal,
    ) -> f64 {
        value * modal.axis_unit(&machine.axes[axis]) * self.scale.factor(axis)
    }

    /// 20604 for a value of `#PSET` outside the data format, 20711 if the resulting offset is (251955595, 252303755).
    fn presets_fit(
        &self,
        words: &Words<'_>,
        sets: bool,
        machine: &Machine,
        modal: &Modal,
        names: &AxisNames,
    ) -> Outcome<()> {
        for (axis, value, span) in words.axes.iter().filter(|_| sets) {
            let value_mm = self.scaled_mm(*axis, *value, machine, modal);
            let offset_mm = self.coordinates.target()[*axis] - value_mm;
            let (condition, what) = if value_mm.abs() > LARGEST_MM {
                (Condition::PresetTooLarge, "the position")
            } else if offset_mm.abs() > LARGEST_MM {
                (Condition::PresetOffsetTooLarge, "the offset")
            } else {
                continue;
            };
            let text =
                format!("#PSET {}{value}: {what} is outside the data format", names.name(*axis));
            return Err(Fault::new(condition, text, *span));
        }
        Ok(())
    }

    /// `#PSET X10`, `#PRESET X0`, `#PRESET`: returns whether the axis words of the block belong to the command.
    pub(super) fn position_presets(
        &mut self,
        words: &Words<'_>,
        modal: &Modal,
        names: &AxisNames,
        output: &mut Output<'_>,
    ) -> bool {
        let named = |h: &str| words.hashes.iter().find(|(hash, _, _)| &*hash.name == h);
        let (sets, at) = match (named("PSET"), named("PRESET")) {
            (Some((_, _, at)), _) => (true, *at),
            (None, Some((_, _, at))) => (false, *at),
            (None, None) => return false,
        };
        if let Err(fault) = self
            .presets_allowed(words, sets, modal, output.contour, at)
            .and_then(|()| self.presets_fit(words, sets, output.machine, modal, names))
        {
            output.report.note(fault);
            return true;
        }
        for (axis, value, _) in &words.axes {
            let value = sets.then(|| self.scaled_mm(*axis, *value, output.machine, modal));
            self.coordinates.preset_position(*axis, value);
        }
        if words.axes.is_empty() && !sets {
            for axis in 0..output.machine.axes.len() {
                self.coordinates.preset_position(axis, None);
            }
        } else if words.axes.is_empty() {
            output.report.note(
                Fault::new(Condition::Syntax, "#PSET without axis words", at)
                    .hint("write the axes and their coordinates: #PSET X0 Y0"),
            );
        }
        true
    }
}
