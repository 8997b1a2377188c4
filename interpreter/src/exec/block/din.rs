//! Execution of the words of a block, in this order: plane, unit and dimension; tool, offsets and frames; feed rate, spindle,
//! weights and modes; functions before the motion; motion or dwell; functions after it.
//!
//! Assumption: this order; the vendor documents only that the order of the words in the block is irrelevant.

mod functions;
mod insertions;
mod modes;
mod offsets;
mod presets;

use super::choice::{Compensation, FeedType, PathMode, Plane};
use super::collected::{CycleCall, GWord, Placed, Words};
use super::groups::{Act, Group};
use super::modal::{FeedWord, Modal};
use crate::diag::Condition;
use crate::exec::commands::addition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::motion::banding::banding_without_motion;
use crate::exec::output::output;
use crate::exec::report::{Report, Subject};
use crate::machine::SpindleMoment;
use crate::syntax::ast::{Call, Jump, Return, Span, Word};
use insertions::inserts_after;
use offsets::axis_functions;

/// Actions after a block: first a call, then the point where the program continues.
#[derive(Debug, Default)]
pub(in crate::exec) struct After<'b> {
    pub(in crate::exec) call: Option<CallAfter<'b>>,
    pub(in crate::exec) then: Then<'b>,
}

/// The call at the end of a block.
#[derive(Debug)]
pub(in crate::exec) enum CallAfter<'b> {
    Written(&'b Call, Span),
    Cycle(CycleCall),
    /// M06 with an assigned program.
    ToolChange(Span),
    /// D with an assigned program.
    ToolData(Span),
}

/// The point where a program continues after a block.
#[derive(Debug, Default)]
pub(in crate::exec) enum Then<'b> {
    #[default]
    Next,
    Goto(&'b Jump),
    /// M17, M29, with the target that they name.
    Return(Option<(&'b Return, Span)>),
    /// M02, M30.
    End,
}

/// What the settings of a block leave to its motion.
struct Settings {
    /// The G function whose arguments the axis words are.
    takes_axes: Option<GWord>,
    /// The axis words are arguments of a command: nothing moves.
    arguments_only: bool,
    /// A speed of the main spindle that takes effect after the motion.
    late_speed: Option<Placed>,
}

impl Modal {
    /// Interpolation of the axes in a block: as programmed in it, otherwise the modal one.
    pub(in crate::exec) fn path_mode(&self, words: &Words<'_>) -> PathMode {
        match words.group(Group::Path).map(|g| g.row.act) {
            Some(Act::Path(mode)) => mode,
            _ => self.path,
        }
    }

    /// F.
    pub(in crate::exec) fn program_feed(
        &mut self,
        (value, span): Placed,
        report: &mut Report,
    ) -> Outcome<()> {
        let most = if self.feed_type == FeedType::ShareOfMaximum { 100.0 } else { 1e9 };
        if !(0.0..=most).contains(&value) {
            // a check continues, and blocks without F have no error themselves
            let word = FeedWord { value: 1.0, inch: self.inch };
            self.feeds[self.feed_type as usize].get_or_insert(word);
            let text = format!("F{value} is outside 0 to {most}");
            return Err(Fault::new(Condition::Range, text, span));
        }
        report.unsay(Condition::FeedZero, Subject::Only);
        let word = FeedWord { value, inch: self.inch };
        self.feeds[self.feed_type as usize] = Some(word);
        Ok(())
    }

    fn planes_and_units(
        &mut self,
        words: &Words<'_>,
        geometry: &mut Geometry,
        report: &mut Report,
    ) {
        for g in &words.g {
            match g.row.act {
                Act::Plane(plane) => self.set_plane(plane, geometry, report, g.span),
                Act::Inch(inch) => self.inch = inch,
                Act::Absolute(absolute) => self.absolute = absolute,
                // before G41 in the same block
                Act::Corners(corners) => self.corners = corners,
                _ => {}
            }
        }
    }

    fn set_plane(
        &mut self,
        plane: Plane,
        geometry: &mut Geometry,
        report: &mut Report,
        span: Span,
    ) {
        if plane != self.plane && self.compensation != Compensation::Off {
            let text = "the plane cannot be changed while tool radius compensation is active";
            report.note(Fault::new(Condition::PlaneWithCompensation, text, span));
            return;
        }
        if plane != self.plane && geometry.coordinates.rotation().is_some() {
            let text = "changing the plane switches the contour rotation off";
            report.note(Fault::new(Condition::Odd, text, span).warning());
            geometry.coordinates.set_rotation(None);
        }
        if plane != self.plane {
            self.plane = plane;
            // the tool length applies along the third axis of the plane
            geometry.apply_tool(self.plane.main_axes());
        }
    }
}

impl Decoder {
    /// Executes a block of words.
    pub(in crate::exec) fn execute_words<'b>(
        &mut self,
        written: &'b [Word],
        span: Span,
    ) -> After<'b> {
        let mut words = Words::default();
        self.collect(written, &mut words);
        if self.dialect.is_of_a_printer(&words, &mut self.report) {
            return After::default();
        }
        self.dialect.guard(&words, &mut self.report);
        let Settings { takes_axes, arguments_only, late_speed } = self.settings(&mut words);
        if let Err(fault) =
            self.motion.leaves_the_spindle(&words, &self.modal, &self.machine.channel)
        {
            self.report.note(fault);
            return After::default();
        }
        self.motion.functions_before(&words, &self.calls, output!(self));
        let (late, early): (Vec<_>, Vec<_>) =
            words.brackets.iter().copied().partition(|bracket| self.acts_late(bracket));
        for bracket in early {
            let outcome = self.bracket(bracket, &words);
            self.report.keep(outcome);
        }
        self.technology_wait(SpindleMoment::BeforeMotion);
        let banding = self.banding_of(&words);
        if !arguments_only {
            self.motion_or_dwell(&words, takes_axes, span);
        }
        if inserts_after(&words) {
            self.modal.insertions(&words, &self.geometry, &self.motion, output!(self));
        }
        if let Some(at) = banding
            && !self.moved
            && !self.report.failed()
        {
            self.report.note(banding_without_motion(&words, at));
        }
        let synchronous = self.motion.independent.take_synchronous();
        self.join(synchronous);
        if let Some((speed, span)) = late_speed {
            self.motion.s_word(0, speed, true, output!(self), span);
        }
        for bracket in late {
            let outcome = self.bracket(bracket, &words);
            self.report.keep(outcome);
        }
        let after = self.functions_after(&words);
        if let Some((hash, at)) = words.addition {
            let outcome = addition(self, hash, at);
            self.report.keep(outcome);
        }
        self.technology_wait(SpindleMoment::AfterMotion);
        after
    }

    /// The place of the function of edge banding for which the motion of a block stops.
    fn banding_of(&mut self, words: &Words<'_>) -> Option<Span> {
        let (geometry, modal, names) = (&self.geometry, &self.modal, &self.names);
        let banding = self.motion.banding_run(words, geometry, modal, names, output!(self));
        self.report.keep(banding).flatten()
    }

    /// Executes what precedes the functions and the motion of a block.
    fn settings(&mut self, words: &mut Words<'_>) -> Settings {
        let plane = self.modal.plane;
        self.modal.planes_and_units(words, &mut self.geometry, &mut self.report);
        if let Some(g) = words.group(Group::Plane).filter(|_| self.modal.plane != plane) {
            let (motion, geometry) = (&self.motion, &self.geometry);
            let worn = motion.apply_wear(geometry, &self.modal, &mut self.contour, g.span);
            self.report.keep(worn);
        }
        let takes_axes = axis_functions(words, &mut self.report);
        let at_once = self.machine.channel.offsets.tools_at_once;
        let tool_before = at_once.then(|| self.geometry.coordinates.tool().clone());
        self.tools_and_offsets(words, takes_axes);
        if let Some(before) = tool_before {
            let outcome =
                self.geometry.tool_moves(&before, words, takes_axes, &self.machine, &self.modal);
            self.report.keep(outcome);
        }
        let arguments_only =
            self.geometry.scaling_words(words, &self.machine, &self.names, &mut self.report)
                || self.geometry.position_presets(words, &self.modal, &self.names, output!(self))
                || self.contour.akima.spline_vectors(words, &mut self.report);
        self.motion.feed_before = self.modal.feed();
        self.feeds_and_modes(words, takes_axes);
        // after G04 the S word is a number of revolutions, after G74 a sequence, after G112 a gear stage
        let arguments =
            |g: &GWord| matches!(g.row.act, Act::Dwell | Act::Gear) || g.row.number == 74;
        let is_speed = !words.g.iter().any(arguments);
        let late_speed = is_speed
            .then(|| self.motion.spindle_speeds(words, &self.geometry, &self.modal, output!(self)))
            .flatten();
        Settings { takes_axes, arguments_only, late_speed }
    }
}
