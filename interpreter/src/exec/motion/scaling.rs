//! `#SCALE`: contours enlarged or reduced by factors per axis.
//!
//! A factor acts on the coordinate words of its axis in motions, on centres, radii and pitches of arcs and on the targets
//! of independent axes, about the zero point of the active coordinate system. Offsets, feeds, tolerances and tool data keep
//! their values, and switching moves nothing.
//!
//! Source: TF5200 programming manual, enlarging and reducing contours (207656459). The page names lines, arcs and
//! positioning axes; what it shows only in pictures, or not at all, is refused.

use crate::diag::Condition;
use crate::exec::block::choice::PathMode;
use crate::exec::block::collected::Words;
use crate::exec::block::groups::{Act, Group};
use crate::exec::block::modal::Modal;
use crate::exec::contour::Contour;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::names::AxisNames;
use crate::exec::report::Report;
use crate::machine::Machine;
use crate::syntax::ast::Span;

impl Geometry {
    /// `#SCALE ON X2 Y2`, `#SCALE X2`, `#SCALE OFF`: returns whether the axis words of the block belong to the command.
    pub(in crate::exec) fn scaling_words(
        &mut self,
        words: &Words<'_>,
        machine: &Machine,
        names: &AxisNames,
        report: &mut Report,
    ) -> bool {
        let found = words.hashes.iter().find_map(|(hash, _, at)| match &*hash.name {
            "SCALE" => Some((None, *at)),
            "SCALE ON" => Some((Some(true), *at)),
            "SCALE OFF" => Some((Some(false), *at)),
            _ => None,
        });
        let Some((switch, at)) = found else { return false };
        let outcome = self.switch_scaling(switch, words, machine, names, at);
        report.keep(outcome);
        if switch == Some(true) && words.axes.is_empty() && self.scale.is_one() {
            let text = "#SCALE ON has no effect: all factors are 1";
            report.note(Fault::new(Condition::Odd, text, at).hint("#SCALE ON X2 Y2"));
        }
        true
    }

    fn switch_scaling(
        &mut self,
        switch: Option<bool>,
        words: &Words<'_>,
        machine: &Machine,
        names: &AxisNames,
        at: Span,
    ) -> Outcome<()> {
        let factors = &words.axes;
        let before = words.axis_before(at).or(words.of_the_path().map(|g| g.span));
        if let Some(span) = before {
            let text = "#SCALE beside a path word: axis words after it are factors";
            return Err(Fault::new(Condition::CommandNotAlone, text, span));
        }
        if let (Some(false), Some((_, _, span))) = (switch, factors.first()) {
            let text = "#SCALE OFF does not take factors";
            return Err(Fault::new(Condition::TokenUnknown, text, *span));
        }
        if switch.is_none() && factors.is_empty() {
            let text = "#SCALE needs ON, OFF or factors";
            return Err(Fault::new(Condition::TokenUnknown, text, at).hint("#SCALE ON X2 Y2"));
        }
        if let (true, Some((_, _, span))) = (self.scale.is_on(), factors.first()) {
            let text = "the factors of #SCALE cannot change while scaling is on";
            return Err(Fault::new(Condition::Syntax, text, *span).hint("write #SCALE OFF first"));
        }
        for (axis, factor, span) in factors {
            if !machine.axes[*axis].is_linear() {
                let what = format!("#SCALE of the rotary axis {}", names.name(*axis));
                return Err(Fault::unsupported(what, *span));
            }
            if *factor <= 0.0 || !factor.is_finite() {
                let name = names.name(*axis);
                let text = format!("#SCALE {name}{factor}: a factor must be greater than 0");
                return Err(Fault::new(Condition::KeyRange, text, *span));
            }
        }
        for (axis, factor, _) in factors {
            self.scale.set(*axis, *factor);
        }
        if let Some(on) = switch {
            self.scale.switch(on);
        }
        Ok(())
    }

    /// Refuses what the page does not describe for scaled contours.
    pub(super) fn scaling_fits(
        &self,
        words: &Words<'_>,
        modal: &Modal,
        contour: &Contour,
        span: Span,
    ) -> Outcome<()> {
        if !self.scale.is_on() {
            return Ok(());
        }
        let measures = words.group(Group::Measuring).is_some_and(|g| g.row.act == Act::Measure);
        let lines = |name: &str| matches!(name, "ANG" | "CANG");
        let what = if measures {
            "a measuring run"
        } else if modal.path.is_thread() {
            "a thread"
        } else if modal.path == PathMode::ArcInSpace {
            "G303"
        } else if contour.akima.selected {
            "a spline"
        } else if self.coordinates.is_machine() {
            "a motion in machine coordinates (#MCS)"
        } else if modal.diameter.is_some() {
            "diameter programming (G51)"
        } else if words.hashes.iter().any(|(hash, _, _)| lines(&hash.name)) {
            "#ANG or #CANG"
        } else {
            return Ok(());
        };
        Err(Fault::unsupported(format!("{what} with #SCALE"), span))
    }
}
