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
use self::plane::InPlane;
use super::block::choice::{Compensation, FeedType, PathMode};
use super::block::collected::{GWord, Words};
use super::block::groups::{Act, Group};
use super::block::modal::Modal;
use super::contour::FeedCourse;
use super::contour::Motion;
use super::decoder::Decoder;
use super::fault::{Fault, Outcome};
use super::step::Sync;
use super::values::number::LARGEST_MM;
use crate::diag::Condition;
use crate::exec::geometry::Geometry;
use crate::exec::geometry::coordinates::Coordinates;
use crate::exec::motion::state::{Contouring, MotionState};
use crate::exec::report::{Report, Subject};
use crate::machine::table::tool;
use crate::syntax::ast::Span;
use kontur_motion::block::{Block, Feed, SlopeKind};
use kontur_motion::path::{LinePath, Path};

/// The G60 of a block.
fn exact_stop_once<'w>(words: &'w Words<'_>) -> Option<&'w GWord> {
    words.g.iter().find(|g| g.row.act == Act::ExactStopOnce)
}

impl Modal {
    /// Whether braking to a lower feed rate may begin after the end of this block: G901 without G09 (source: TF5200 programming
    /// manual, G08/G09/G900/G901).
    fn brakes_late(&self, early_once: bool, span: Span, report: &mut Report) -> bool {
        let late = self.late_braking && !early_once;
        if late && self.commanded.slope.kind == SlopeKind::Hsc {
            let text = "G901 has no effect with the slope HSC";
            report.note_once(Subject::G(901), Fault::new(Condition::Ignored, text, span));
        }
        late
    }

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

impl Geometry {
    /// 120180: a point of a spline must move a main axis.
    fn spline_leads(&self, path: &Path, span: Span) -> Outcome<()> {
        let moves = |axis: usize| {
            path.extent(axis).is_none_or(|(low, high)| low.to_bits() != high.to_bits())
        };
        let mut main = (0..3).filter_map(|i| self.coordinates.main_axis(i));
        if main.any(moves) {
            return Ok(());
        }
        let text = "spline point without motion of a main axis";
        Err(Fault::new(Condition::SplineWithoutMainAxis, text, span))
    }
}

impl MotionState {
    /// 120566: the feed rate of contoured motions refers to the main axes.
    ///
    /// Source: TF5200 diagnosis 265098635.
    fn contouring_fits(&self, coordinates: &Coordinates, span: Span) -> Outcome<()> {
        if self.feeds_main_axes(coordinates) {
            return Ok(());
        }
        let text = "contouring, but the feed axes (#FGROUP, P-CHAN-00011) are not the main axes";
        Err(Fault::new(Condition::ContouringFeedGroup, text, span))
    }

    /// Whether the feed rate refers to the main axes.
    fn feeds_main_axes(&self, coordinates: &Coordinates) -> bool {
        let is_main = |axis: usize| coordinates.main_index(axis).is_some();
        (0..self.feed_axes.len()).all(|axis| self.feed_axes[axis] == is_main(axis))
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
        let fits = self.scaling_fits(words, span);
        if self.report.keep(fits).is_none() {
            return;
        }
        if let Some(g) = words.group(Group::Measuring).filter(|g| g.row.act == Act::Measure) {
            let outcome = self.measuring_run(g, words, span);
            self.report.keep(outcome);
            self.motion.measuring.jump(words.goto.filter(|_| words.jumps_on_signal()).cloned());
            return;
        }
        let is_arc = matches!(self.modal.path, PathMode::Clockwise | PathMode::CounterClockwise);
        let contour_line = self.contour_line(words);
        let Some(contour_line) = self.report.keep(contour_line) else { return };
        let angle = self.arc_angle(words, is_arc);
        if self.report.keep(angle).is_none() {
            return;
        }
        let centre = words.centre.iter().flatten().next();
        let unit = self.modal.unit_mm();
        let too_large = |(x, _): &&(f64, Span)| (x * unit).abs() > LARGEST_MM;
        if is_arc && let Some((x, span)) = words.centre.iter().flatten().find(too_large) {
            let text = format!("the centre {x} is outside the data format");
            self.report.note(Fault::new(Condition::CentreTooLarge, text, *span));
            return;
        }
        // a full circle needs no end point
        let full_circle = is_arc && centre.is_some() && words.group(Group::Insertion).is_none();
        if contour_line == ContourLine::Waits {
            return;
        }
        if takes_axes.is_some() || (words.axes.is_empty() && !full_circle) {
            self.stop_without_motion(words);
            self.modal.unused_words(words, takes_axes, &mut self.report);
            return;
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
    }

    /// The axes settle at the end of a motion if G60, G360 or P-CHAN-00235 requires it.
    fn stop_exactly(&mut self, words: &Words<'_>) {
        let after_rapid = self.modal.path == PathMode::Rapid
            && self.machine.channel.language.exact_stop_after_g00;
        if exact_stop_once(words).is_some() || self.modal.exact_stop || after_rapid {
            self.sync(Sync::ExactStop { alone: self.machine.channel.independent.stops_join });
        }
    }

    /// 20003: G60 in a block that moves nothing.
    ///
    /// Assumption: the documents print only the warning. As at the end of every block with G60 the velocity is zero; the
    /// channel waits for the axes of the block, and this block has none.
    fn stop_without_motion(&mut self, words: &Words<'_>) {
        if let Some(g) = exact_stop_once(words) {
            let text = "G60 without motion: the path stops here without waiting for an axis";
            let hint = "write G60 in the block at the end of which the axes must have arrived";
            self.report.note(Fault::new(Condition::AxisMissing, text, g.span).hint(hint));
            self.spline_stops(g.span);
            self.sync(Sync::Dwell { seconds: 0.0 });
        }
    }

    /// An exact stop ends a B-spline: K-0111 unless AUTO_OFF_G60 asks for it.
    fn spline_stops(&mut self, span: Span) {
        if self.contour.hsc.off_at_stop || self.contour.hsc.spline().is_none() {
            return;
        }
        let text = "an exact stop in a B-spline ends it here, as with AUTO_OFF_G60";
        let fault = Fault::new(Condition::Fallback, text, span)
            .hint("without this key, the default, it does not end the spline of the control");
        self.report.note_once("AUTO_OFF_G60", fault);
    }

    fn motion(&mut self, words: &Words<'_>, is_arc: bool, span: Span) -> Outcome<()> {
        let left = std::mem::take(&mut self.motion.left_contour);
        if left && (is_arc || self.modal.path == PathMode::ArcInSpace) {
            let text = "an arc after G40 with G239: its start is not where it was programmed";
            return Err(Fault::new(Condition::CompensationInArc, text, span));
        }
        self.join_named(words);
        let before = self.geometry.coordinates.programmed_point();
        let start = self.program_targets(words)?;
        if let Some(axis) = self.geometry.turned_offset() {
            let text = format!(
                "length and offset of the tool along {} are those of the machine axis in a turned coordinate system",
                self.names.name(axis)
            );
            let fault =
                Fault::new(Condition::Fallback, text, span).with(|d| d.parameter(tool::FIXED));
            self.report.note_once("tool_fixed", fault.hint("as with wz[i].tool_fixed 1"));
        }
        let path = if self.modal.path == PathMode::ArcInSpace {
            Some(self.arc_in_space(start, before, words, span)?)
        } else if is_arc {
            Some(self.arc(start, words, span)?)
        } else {
            let end = self.geometry.coordinates.target().clone();
            if let Some((_, at)) = words.centre.iter().flatten().next()
                && words.group(Group::Insertion).is_none()
            {
                let text = "I, J and K have no meaning in a straight motion";
                self.report.note(Fault::new(Condition::Odd, text, *at).warning());
            }
            if let Some((radius, at)) = words.radius {
                self.modal.radius_mm = Some(radius * self.modal.unit_mm());
                // in a block with an error, such as a cycle of another control, a complaint about R would only distract
                if !self.report.failed() {
                    let text = "R has no meaning in a straight motion: it is kept for the next arc";
                    self.report.note(Fault::new(Condition::Odd, text, at).warning());
                }
            }
            let (start, end) =
                (self.motion.independent.on_path(start), self.motion.independent.on_path(end));
            LinePath::new(start, end, &self.motion.feed_axes).map(Path::Line)
        };
        if self.motion.areas.is_defining() {
            return self.area_block(path.as_ref(), words, span);
        }
        // a block without travel needs no feed rate
        let Some(path) = path else { return Ok(()) };
        let begins = self.modal.compensation != Compensation::Off && !self.contour.compensates();
        if begins && self.motion.wear.on && !path.is_straight() {
            let text = "tool radius compensation starts with an arc while #OTC is on";
            return Err(Fault::new(Condition::WearSelectedInArc, text, span));
        }
        // the path with tool radius compensation is known only later
        if self.modal.compensation == Compensation::Off {
            let place = |axis| words.axes.iter().find(|(a, _, _)| *a == axis).map(|(_, _, at)| *at);
            self.check_limits(&path, place, span);
        }
        self.join_for(&path);
        let at = words.axes.first().map_or(span, |(_, _, at)| *at);
        let feed = self.feed_of(&path, at)?;
        let end_velocity_mm_s = match words.end_feed {
            Some(end) => self.modal.end_velocity(end, feed, &self.machine, &path)?,
            None => None,
        };
        let rapid = feed == Feed::Rapid;
        let full = words.g.iter().any(|g| g.row.act == Act::FullOverride);
        let moves = |axis: &usize| {
            path.extent(*axis).is_none_or(|(low, high)| low.to_bits() != high.to_bits())
        };
        let moved = (0..self.motion.feed_axes.len()).filter(moves);
        let feed_ratio = if full { 1.0 } else { self.motion.overrides.ratio(rapid, moved) };
        let once = |act: Act| words.g.iter().any(|g| g.row.act == act);
        let stops = self.modal.exact_stop || once(Act::ExactStopOnce);
        let rounds = !stops && (self.modal.contouring || once(Act::ContourOnce));
        if rounds {
            self.motion.contouring =
                if self.modal.contouring { Contouring::Modal } else { Contouring::Once };
        }
        if stops {
            self.spline_stops(span);
        }
        if rounds && self.contour.hsc.contour().is_some() {
            let text = "G61, G261 and #HSC [OPMODE=1] at once: the corner is rounded by #CONTOUR MODE, not within CONTERROR";
            let fault = Fault::new(Condition::Fallback, text, span);
            self.report
                .note_once("CONTERROR", fault.hint("switch one of the two off: G260 or #HSC OFF"));
        }
        let late_braking =
            self.modal.brakes_late(once(Act::EarlyBrakingOnce), span, &mut self.report);
        if rounds {
            self.motion.contouring_fits(&self.geometry.coordinates, span)?;
        }
        if self.contour.hsc.spline().is_some()
            && !self.machine.channel.spline_feed_of_group
            && !self.motion.feeds_main_axes(&self.geometry.coordinates)
        {
            let what = "a feed group other than the main axes on a B-spline (P-CHAN-00240 = 0)";
            return Err(Fault::unsupported(what, span));
        }
        let course = self.feed_course(words, &path, feed, rounds, span)?;
        let shaped = rounds
            || self.contour.hsc.contour().is_some()
            || self.contour.hsc.spline().is_some()
            || self.contour.akima.selected;
        self.motion.areas.fit(shaped, &self.names, span)?;
        let in_plane = self.in_plane(span)?;
        if self.contour.akima.selected {
            self.spline_fits(rapid, rounds, span)?;
            self.geometry.spline_leads(&path, span)?;
        }
        // a block with an error causes no motion; conditions reported before it are still output
        if self.report.failed() && !self.checking {
            return Ok(());
        }
        let block = Box::new(Block {
            seq: 0,
            path,
            feed,
            feed_ratio,
            full_override: full,
            end_velocity_mm_s,
            late_braking,
            slope: self.modal.commanded.slope,
            dynamics: self.motion.dynamics_of_block(&self.machine, &self.modal, rapid),
            tolerance: self.shaping.tolerance(),
            contour: if rounds {
                Some(self.contour.contouring.settings())
            } else {
                self.contour.hsc.contour()
            },
            spline: self.contour.hsc.spline(),
            tangential: false,
        });
        feed::check_time(&block, at, &mut self.report);
        let per_revolution = self.modal.feed_type == FeedType::PerRevolution && !rapid;
        if per_revolution && self.motion.cutting.speed.is_some() {
            return self.send_pieces(&block, &in_plane, span);
        }
        self.send(block, in_plane, course, span);
        Ok(())
    }

    /// Functions that cannot be combined with splines.
    fn spline_fits(&self, rapid: bool, rounds: bool, span: Span) -> Outcome<()> {
        if self.contour.hsc.spline().is_some() {
            let text = "a spline (G151) while #HSC ON [BSPLINE] is active";
            return Err(Fault::new(Condition::SplineInSurface, text, span));
        }
        if rounds || self.contour.hsc.contour().is_some() {
            let text = "a spline (G151) combined with contouring or #HSC";
            return Err(Fault::new(Condition::SplineWithContouring, text, span));
        }
        let what = if rapid {
            "G00 in a spline"
        } else if self.modal.compensation != Compensation::Off {
            "a spline with tool radius compensation"
        } else if !self.geometry.coordinates.frame().only_shifts() {
            "a spline in a rotated or mirrored system"
        } else if self.modal.feed_type == FeedType::PerRevolution
            && self.motion.cutting.speed.is_some()
        {
            "a spline with G95 under G96"
        } else {
            return Ok(());
        };
        Err(Fault::unsupported(what, span))
    }

    /// A motion with G95 under G96: its feed rate changes with the speed of the spindle.
    fn send_pieces(&mut self, block: &Block, in_plane: &InPlane, span: Span) -> Outcome<()> {
        if in_plane.compensation.is_some() {
            let what = "G95 under G96 with tool radius compensation";
            return Err(Fault::unsupported(what, span));
        }
        let Some(cutting) = self.motion.cutting.speed else { return Ok(()) };
        for (path, rpm) in cutting::pieces(cutting, &block.path, &self.motion.feed_axes, span)? {
            let feed = self.modal.feed_per_revolution(&self.machine, &path, rpm);
            let block = Box::new(Block { path, feed, ..block.clone() });
            let InPlane { plane, tilt, .. } = in_plane;
            let in_plane = InPlane { plane: *plane, tilt: tilt.clone(), compensation: None };
            self.send(block, in_plane, None, span);
        }
        Ok(())
    }

    /// Passes a motion on.
    fn send(
        &mut self,
        block: Box<Block>,
        in_plane: InPlane,
        course: Option<FeedCourse>,
        span: Span,
    ) {
        let InPlane { plane, tilt, compensation } = in_plane;
        let akima = self.contour.akima.selected && block.path.is_straight();
        let watch =
            self.motion.areas.watch(&self.geometry, &self.motion.independent.way, &self.names);
        let motion = Box::new(Motion {
            block,
            course,
            source: self.report.source,
            events: self.contour.take_events(),
            plane,
            tilt,
            local: false,
            compensation,
            engaged: None,
            tangential: std::mem::take(&mut self.contour.tangential),
            akima,
            watch,
            span,
        });
        self.moved = true;
        for fault in self.contour.motion(motion) {
            self.report.note(Box::new(fault));
        }
        for fault in self.limits_of_compensated() {
            self.report.note(Box::new(fault));
        }
    }
}
