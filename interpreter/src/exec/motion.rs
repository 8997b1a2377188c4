//! The motion of a block: target, path, feed and limits; or the dwell.

mod angles;
mod arcs;
pub(super) mod areas;
pub(super) mod banding;
mod coupling;
mod cutting;
mod dwell;
pub(super) mod dynamics;
mod feed;
mod feed_course;
mod gears;
mod independent;
mod limits;
mod manual;
mod measuring;
mod oscillation;
pub(super) mod overrides;
mod path;
mod plane;
mod scaling;
mod set_position;
pub(super) mod slope;
mod space;
pub(super) mod spindles;
pub(super) mod state;
pub(super) mod straight;
mod targets;
mod technology;
mod threads;
mod tool_dynamics;
pub(super) mod wear;
pub(super) mod weight;

use self::angles::ContourLine;
use super::block::choice::PathMode;
use super::block::collected::{GWord, Words};
use super::block::groups::{Act, Group};
use super::block::modal::Modal;
use super::decoder::Decoder;
use super::fault::{Fault, Outcome};
use super::step::Sync;
use super::values::number::LARGEST_MM;
use crate::diag::Condition;
use crate::exec::report::Report;
use crate::syntax::ast::Span;

impl Modal {
    /// I, J, K and E that are not used.
    fn unused_words(&mut self, words: &Words<'_>, takes_axes: Option<GWord>, report: &mut Report) {
        let inserted = words.group(Group::Insertion).is_some();
        if words.centre[0].is_some() && inserted {
            return;
        }
        if let Some((_, span)) = words.centre.iter().flatten().next() {
            let text = "I, J and K have no meaning without an arc";
            report.note(Fault::new(Condition::Odd, text, *span).warning());
        }
        let rotates = takes_axes.is_some_and(|g| g.row.act == Act::Rotate);
        if let (Some((radius, span)), false) = (words.radius, rotates) {
            // R alone applies to the arcs that follow; in a block with G02 or G03 it would be taken for a radius
            self.radius_mm = Some(radius * self.unit_mm());
            if words.group(Group::Path).is_some() {
                let text = "R without an end point has no effect here: it is kept for the next arc";
                report.note(Fault::new(Condition::Odd, text, span).warning());
            }
        }
        if let Some((_, span)) = words.end_feed {
            let text = "E has no meaning without motion";
            report.note(Fault::new(Condition::Odd, text, span).warning());
        }
    }
}

impl Decoder {
    /// Moves, measures or dwells.
    pub(super) fn motion_or_dwell(
        &mut self,
        words: &Words<'_>,
        takes_axes: Option<GWord>,
        span: Span,
    ) {
        let path_word = words.group(Group::Path);
        if let Some(GWord { row, .. }) = path_word
            && let Act::Path(mode) = row.act
        {
            self.modal.path = mode;
        }
        if let Some(g) = path_word.filter(|g| g.row.act == Act::Dwell) {
            self.stop_without_motion(words);
            let outcome = self.dwell(g, words);
            self.report.keep(outcome);
            return;
        }
        let measures = words.group(Group::Measuring).is_some_and(|g| g.row.act == Act::Measure);
        if self.motion.areas.is_defining() && (measures || self.modal.path.is_thread()) {
            let text = "the contour of a control area must consist of G00, G01, G02 and G03";
            self.report.note(Fault::new(Condition::AreaOfArcs, text, span));
            return;
        }
        let fits = self.geometry.scaling_fits(words, &self.modal, &self.contour, span);
        if self.report.keep(fits).is_none() {
            return;
        }
        if let Some(g) = words.group(Group::Measuring).filter(|g| g.row.act == Act::Measure) {
            let outcome = self.measuring_run(g, words, span);
            self.report.keep(outcome);
            self.motion.measuring.jump(words.goto.filter(|_| words.jumps_on_signal()).cloned());
            return;
        }
        let outcome = self.move_axes(words, takes_axes, span);
        self.report.keep(outcome);
    }

    /// Moves the axes of the block: a contour line, a thread, or a motion on the path.
    fn move_axes(
        &mut self,
        words: &Words<'_>,
        takes_axes: Option<GWord>,
        span: Span,
    ) -> Outcome<()> {
        let is_arc = matches!(self.modal.path, PathMode::Clockwise | PathMode::CounterClockwise);
        let contour_line = self.motion.contour_line.contour_line(
            words,
            &self.geometry,
            &self.machine,
            &self.modal,
            self.report.source,
        )?;
        self.motion.contour_line.arc_angle(
            words,
            is_arc,
            &self.geometry.coordinates,
            &self.modal,
        )?;
        let unit = self.modal.unit_mm();
        let too_large = |(x, _): &&(f64, Span)| (x * unit).abs() > LARGEST_MM;
        if is_arc && let Some((x, span)) = words.centre.iter().flatten().find(too_large) {
            let text = format!("the centre {x} is outside the data format");
            return Err(Fault::new(Condition::CentreTooLarge, text, *span));
        }
        if contour_line == ContourLine::Waits {
            return Ok(());
        }
        // a full circle needs no end point
        let has_centre = words.centre.iter().flatten().next().is_some();
        let full_circle = is_arc && has_centre && words.group(Group::Insertion).is_none();
        if takes_axes.is_some() || (words.axes.is_empty() && !full_circle) {
            self.stop_without_motion(words);
            self.modal.unused_words(words, takes_axes, &mut self.report);
            return Ok(());
        }
        let outcome = if self.modal.path.is_thread() {
            self.thread_motion(words, span)
        } else {
            self.end_thread();
            self.contour_lines(&contour_line, words, span)
                .and_then(|()| self.motion(words, is_arc, span))
        };
        self.report.keep(outcome);
        self.stop_exactly(words);
        Ok(())
    }

    /// The axes settle at the end of a motion if G60, G360 or P-CHAN-00235 requires it.
    fn stop_exactly(&mut self, words: &Words<'_>) {
        let after_rapid = self.modal.path == PathMode::Rapid
            && self.machine.channel.language.exact_stop_after_g00;
        if words.has(Act::ExactStopOnce) || self.modal.exact_stop || after_rapid {
            self.sync(Sync::ExactStop { alone: self.machine.channel.independent.stops_join });
        }
    }

    /// 20003: G60 in a block that moves nothing.
    ///
    /// Assumption: the documents print only the warning. As at the end of every block with G60 the velocity is zero; the
    /// channel waits for the axes of the block, and this block has none.
    fn stop_without_motion(&mut self, words: &Words<'_>) {
        if let Some(g) = words.with(Act::ExactStopOnce) {
            let text = "G60 without motion: the path stops here without waiting for an axis";
            let hint = "write G60 in the block at the end of which the axes must have arrived";
            self.report.note(Fault::new(Condition::AxisMissing, text, g.span).hint(hint));
            self.contour.spline_stops(g.span, &mut self.report);
            self.sync(Sync::Dwell { seconds: 0.0 });
        }
    }
}
