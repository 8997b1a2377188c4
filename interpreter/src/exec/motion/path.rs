//! A motion on the path: targets, path, feed and limits become a block for the planner.

use super::feed;
use super::plane::InPlane;
use crate::diag::Condition;
use crate::exec::block::choice::{Compensation, FeedType, PathMode};
use crate::exec::block::collected::Words;
use crate::exec::block::groups::{Act, Group};
use crate::exec::block::modal::Modal;
use crate::exec::contour::{Contour, FeedCourse, Motion, PathOf};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::geometry::coordinates::Coordinates;
use crate::exec::motion::state::{Contouring, MotionState};
use crate::exec::output::output;
use crate::exec::report::{Report, Subject};
use crate::machine::Channel;
use crate::machine::table::tool;
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::{Block, Feed, SlopeKind, SplineSettings};
use kontur_motion::path::{LinePath, Path};

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

    /// Words of arcs in a straight motion: R is kept for the next arc.
    fn keep_radius(&mut self, words: &Words<'_>, report: &mut Report) {
        if let Some((_, at)) = words.centre.iter().flatten().next()
            && words.group(Group::Insertion).is_none()
        {
            let text = "I, J and K have no meaning in a straight motion";
            report.note(Fault::new(Condition::Odd, text, *at).warning());
        }
        if let Some((radius, at)) = words.radius {
            self.radius_mm = Some(radius * self.unit_mm());
            // in a block with an error, such as a cycle of another control, a complaint about R would only distract
            if !report.failed() {
                let text = "R has no meaning in a straight motion: it is kept for the next arc";
                report.note(Fault::new(Condition::Odd, text, at).warning());
            }
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
    /// Motions and modes that cannot be combined with a spline (G151).
    fn spline_fits(
        &self,
        rapid: bool,
        coordinates: &Coordinates,
        modal: &Modal,
        span: Span,
    ) -> Outcome<()> {
        let what = if rapid {
            "G00 in a spline"
        } else if modal.compensation != Compensation::Off {
            "a spline with tool radius compensation"
        } else if !coordinates.frame().only_shifts() {
            "a spline in a rotated or mirrored system"
        } else if modal.feed_type == FeedType::PerRevolution && self.cutting.speed.is_some() {
            "a spline with G95 under G96"
        } else {
            return Ok(());
        };
        Err(Fault::unsupported(what, span))
    }

    /// The straight path between two positions of the axes; `None` without travel.
    pub(super) fn line(&self, start: AxisVec, end: AxisVec) -> Option<Path> {
        let (start, end) = (self.independent.on_path(start), self.independent.on_path(end));
        LinePath::new(start, end, self.limits.feed_axes()).map(Path::Line)
    }

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
        self.limits.feed_axes().iter().enumerate().all(|(axis, member)| *member == is_main(axis))
    }

    /// Tolerances of the active B-spline, which has one for the feed group and one for all other axes.
    ///
    /// PATH_DEV belongs to the main axes and TRACK_DEV to the others (207308683); with another feed group (P-CHAN-00240 = 1)
    /// both groups keep the smaller one.
    pub(super) fn spline_settings(
        &self,
        coordinates: &Coordinates,
        contour: &Contour,
    ) -> Option<SplineSettings> {
        let spline = contour.hsc.spline()?;
        if self.feeds_main_axes(coordinates) {
            return Some(spline);
        }
        let limits =
            [spline.path_dev_mm, spline.track_dev_deg].into_iter().filter(|dev| *dev > 0.0);
        let least = limits.reduce(f64::min).unwrap_or(0.0);
        Some(SplineSettings { path_dev_mm: least, track_dev_deg: least, ..spline })
    }

    /// The ramp times of motions in coordinate systems are the longest ones of the main axes (P-CHAN-00758).
    pub(super) fn update_ramps(&mut self, coordinates: &Coordinates, channel: &Channel) {
        let longest = channel.dynamics.longest_ramp_in_systems && coordinates.systems() > 0;
        let main = |i| coordinates.main_axis(i).filter(|_| longest);
        self.limits.use_longest_ramps_of([0, 1, 2].map(main));
    }

    /// Whether polynomial contouring is active: G261, or G61 at the corner after the last motion.
    pub(in crate::exec) fn is_contouring(&self, modal: &Modal, contour: &Contour) -> bool {
        let once = self.contouring == Contouring::Once;
        modal.contouring || once && contour.has_contoured_corner()
    }

    /// Whether the corner at the end of the block is rounded by contouring. What an exact stop or contouring does to HSC is noted.
    fn rounds_corner(
        &mut self,
        words: &Words<'_>,
        modal: &Modal,
        contour: &mut Contour,
        report: &mut Report,
        span: Span,
    ) -> bool {
        let stops = modal.exact_stop || words.has(Act::ExactStopOnce);
        let rounds = !stops && (modal.contouring || words.has(Act::ContourOnce));
        if rounds {
            self.contouring = if modal.contouring { Contouring::Modal } else { Contouring::Once };
        }
        if stops {
            contour.spline_stops(span, report);
        }
        if rounds && contour.hsc.contour().is_some() {
            let text = "G61, G261 and #HSC [OPMODE=1] at once: the corner is rounded by #CONTOUR MODE, not within CONTERROR";
            let fault = Fault::new(Condition::Fallback, text, span);
            report
                .note_once("CONTERROR", fault.hint("switch one of the two off: G260 or #HSC OFF"));
        }
        rounds
    }

    /// Whether the feed group permits contouring and B-splines.
    fn group_fits_corner(
        &self,
        rounds: bool,
        coordinates: &Coordinates,
        channel: &Channel,
        contour: &Contour,
        span: Span,
    ) -> Outcome<()> {
        if rounds {
            self.contouring_fits(coordinates, span)?;
        }
        if contour.hsc.spline().is_some()
            && !channel.spline_feed_of_group
            && !self.feeds_main_axes(coordinates)
        {
            let what = "a feed group other than the main axes on a B-spline (P-CHAN-00240 = 0)";
            return Err(Fault::unsupported(what, span));
        }
        Ok(())
    }
}

impl Contour {
    /// A spline (G151) excludes B-splines and contouring; `rounds`: contouring of this block.
    fn spline_stands_alone(&self, rounds: bool, span: Span) -> Outcome<()> {
        if self.hsc.spline().is_some() {
            let text = "a spline (G151) while #HSC ON [BSPLINE] is active";
            return Err(Fault::new(Condition::SplineInSurface, text, span));
        }
        if rounds || self.hsc.contour().is_some() {
            let text = "a spline (G151) combined with contouring or #HSC";
            return Err(Fault::new(Condition::SplineWithContouring, text, span));
        }
        Ok(())
    }

    /// The path of the next motion that counts for the software limits.
    pub(super) fn path_of_next(&self, modal: &Modal) -> PathOf {
        let with_tool = modal.compensation != Compensation::Off || self.departure_follows();
        if with_tool { PathOf::Tool } else { PathOf::Program }
    }
}

impl Decoder {
    pub(super) fn motion(&mut self, words: &Words<'_>, is_arc: bool, span: Span) -> Outcome<()> {
        let Some(path) = self.path_of_block(words, is_arc, span)? else { return Ok(()) };
        self.join(self.motion.independent.moved_by(&path));
        let at = words.axes.first().map_or(span, |(_, _, at)| *at);
        let feed = self.feed_of_block(&path, at)?;
        let end_velocity_mm_s = match words.end_feed {
            Some(end) => self.modal.end_velocity(end, feed, &self.machine, &path)?,
            None => None,
        };
        let rapid = feed == Feed::Rapid;
        let full = words.has(Act::FullOverride);
        let feed_ratio = if full { 1.0 } else { self.motion.override_of(&path, rapid) };
        let (rounds, late_braking) = self.end_of_block(words, span)?;
        let course = self.feed_course(words, &path, feed, rounds, span)?;
        let hsc = (
            self.contour.hsc.contour(),
            self.motion.spline_settings(&self.geometry.coordinates, &self.contour),
        );
        let shaped = rounds || hsc.0.is_some() || hsc.1.is_some() || self.contour.akima.selected;
        self.motion.areas.fit(shaped, &self.names, span)?;
        let in_plane = self.geometry.in_plane(&self.modal, &self.motion, span)?;
        let (feed, course) = match self.cutting_feed(&path, feed, rounds, &in_plane, span)? {
            Some((mean, follows)) => (mean, Some(follows)),
            None => (feed, course),
        };
        if self.contour.akima.selected {
            self.contour.spline_stands_alone(rounds, span)?;
            self.motion.spline_fits(rapid, &self.geometry.coordinates, &self.modal, span)?;
            self.geometry.spline_leads(&path, span)?;
        }
        // a block with an error causes no motion; conditions reported before it are still output
        if self.report.failed() && !self.checking {
            return Ok(());
        }
        let (contour, spline) = hsc;
        self.motion.update_ramps(&self.geometry.coordinates, &self.machine.channel);
        let block = self.spare.place(Block {
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
            contour: if rounds { Some(self.contour.contouring.settings()) } else { contour },
            spline,
            tangential: false,
        });
        feed::check_time(&block, at, &mut self.report);
        self.send(block, in_plane, course, span);
        Ok(())
    }

    /// The feed of a block along its path.
    fn feed_of_block(&mut self, path: &Path, at: Span) -> Outcome<Feed> {
        let coordinates = &self.geometry.coordinates;
        self.motion.feed_of(path, coordinates, &self.modal, output!(self), at)
    }

    /// Whether the corner behind a block is rounded, and whether the block brakes late.
    fn end_of_block(&mut self, words: &Words<'_>, span: Span) -> Outcome<(bool, bool)> {
        let (contour, report) = (&mut self.contour, &mut self.report);
        let rounds = self.motion.rounds_corner(words, &self.modal, contour, report, span);
        let early_once = words.has(Act::EarlyBrakingOnce);
        let late_braking = self.modal.brakes_late(early_once, span, report);
        let (coordinates, channel) = (&self.geometry.coordinates, &self.machine.channel);
        self.motion.group_fits_corner(rounds, coordinates, channel, &self.contour, span)?;
        Ok((rounds, late_braking))
    }

    /// The path of a block to its targets, checked as far as it is known; `None` if it does not travel or belongs to a control area.
    fn path_of_block(
        &mut self,
        words: &Words<'_>,
        is_arc: bool,
        span: Span,
    ) -> Outcome<Option<Path>> {
        let left = std::mem::take(&mut self.motion.left_contour);
        if left && (is_arc || self.modal.path == PathMode::ArcInSpace) {
            let text = "an arc after G40 with G239: its start is not where it was programmed";
            return Err(Fault::new(Condition::CompensationInArc, text, span));
        }
        self.join(self.motion.independent.named_in(words, &self.machine.channel));
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
            self.contour.permits_arc_in_space(&self.modal, span)?;
            Some(self.geometry.arc_in_space(
                (start, before),
                words,
                &self.modal,
                &self.motion,
                span,
            )?)
        } else if is_arc {
            Some(self.arc(start, words, span)?)
        } else {
            self.modal.keep_radius(words, &mut self.report);
            self.motion.line(start, self.geometry.coordinates.target().clone())
        };
        if self.motion.areas.is_defining() {
            return self
                .motion
                .areas
                .area_block(path.as_ref(), words, &self.geometry, &self.modal, span)
                .map(|()| None);
        }
        // a block without travel needs no feed rate
        let Some(path) = path else { return Ok(None) };
        let begins = self.modal.compensation != Compensation::Off && !self.contour.compensates();
        if begins && self.motion.wear.on && !path.is_straight() {
            let text = "tool radius compensation starts with an arc while #OTC is on";
            return Err(Fault::new(Condition::WearSelectedInArc, text, span));
        }
        if self.contour.path_of_next(&self.modal) == PathOf::Program {
            let place = |axis| words.axes.iter().find(|(a, _, _)| *a == axis).map(|(_, _, at)| *at);
            let limits = self.geometry.limits(&self.motion, &self.names, &self.machine);
            limits.check(&path, place, &mut self.report, span);
        }
        Ok(Some(path))
    }

    /// Passes a motion on.
    pub(super) fn send(
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
        let path_of = self.contour.path_of_next(&self.modal);
        let motion = Box::new(Motion {
            block,
            path_of,
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
        self.report.extend(self.contour.motion(motion));
        if self.contour.has_to_report() {
            let limits = self.geometry.limits(&self.motion, &self.names, &self.machine);
            self.report.extend(self.contour.take_outside(&limits));
        }
    }
}
