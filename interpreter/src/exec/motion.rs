//! The motion of a block: target, path, feed and limits; or the dwell.

use super::arc::{self, ArcError};
use super::contour::{Compensated, Motion, local_ends};
use super::coordinates::Target;
use super::decoder::Decoder;
use super::fault::{Fault, Outcome, own};
use super::groups::{Act, Group};
use super::insertion::{Insertion, Kind};
use super::modal::{Compensation, Corners, FeedType, PathMode};
use super::modulo;
use super::step::Sync;
use super::words::{GWord, Placed, Words};
use crate::diag::ValueKind;
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::{Block, Feed};
use kontur_motion::path::{ArcPath, ArcShape, LinePath, Path, Tilt, TiltedArc};

/// Longest dwell in s: 32 bits of microseconds. Source: TF5200 diagnosis, 20752.
const DWELL_MAX_S: f64 = 4294.967295;

impl Decoder {
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
            let outcome = self.dwell(g, words);
            self.keep(outcome);
            return;
        }
        let is_arc = matches!(self.modal.path, PathMode::Clockwise | PathMode::CounterClockwise);
        let centre = words.centre.iter().flatten().next();
        // a full circle needs no end point
        let full_circle = is_arc && centre.is_some() && words.group(Group::Insertion).is_none();
        if takes_axes.is_some() || (words.axes.is_empty() && !full_circle) {
            self.unused_words(words, takes_axes);
            return;
        }
        let outcome = self.motion(words, is_arc, span);
        self.keep(outcome);
        let once = words.g.iter().any(|g| g.row.act == Act::ExactStopOnce);
        let after_rapid =
            self.modal.path == PathMode::Rapid && self.machine.channel.exact_stop_after_g00;
        if once || self.modal.exact_stop || after_rapid {
            self.sync(Sync::ExactStop);
        }
    }

    /// I, J, K and E that nothing uses.
    fn unused_words(&mut self, words: &Words<'_>, takes_axes: Option<GWord>) {
        let inserted = words.group(Group::Insertion).is_some();
        if words.centre[0].is_some() && inserted {
            return;
        }
        if let Some((_, span)) = words.centre.iter().flatten().next() {
            let text = "I, J and K have no meaning without an arc";
            self.note(Fault::kontur(own::ODD, text, *span).warning());
        }
        let rotates = takes_axes.is_some_and(|g| g.row.act == Act::Rotate);
        if let (Some((radius, _)), false) = (words.radius, rotates) {
            // kept for the next arc
            self.modal.radius_mm = Some(radius * self.unit_mm());
        }
        if let Some((_, span)) = words.end_feed {
            let text = "E has no meaning without motion";
            self.note(Fault::kontur(own::ODD, text, span).warning());
        }
    }

    fn dwell(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        let main = self.coordinates.main_axis(0);
        let of_axis = words.axes.iter().find(|(axis, _, _)| Some(*axis) == main);
        let revolutions = words.speeds.first();
        let forms = [g.value.is_some(), of_axis.is_some(), revolutions.is_some()];
        if forms.iter().filter(|f| **f).count() > 1 {
            let text = "G04 with two times: write G04 2.5 or G04 X2.5";
            return Err(Fault::vendor(20013, text, g.span));
        }
        let (seconds, span) = if let Some(value) = g.value {
            (value, g.span)
        } else if let Some((_, value, span)) = of_axis {
            (*value, *span)
        } else if let Some((spindle, turns, span)) = revolutions {
            let rpm = self.spindles[*spindle].rpm.abs();
            if rpm == 0.0 {
                let text = "G04 S: the spindle has no speed";
                return Err(Fault::vendor(20007, text, *span));
            }
            (turns * 60.0 / rpm, *span)
        } else if let Some((_, _, span)) = words.axes.first() {
            let text = "G04: the time stands behind the first main axis";
            return Err(Fault::vendor(20014, text, *span));
        } else {
            return Err(Fault::kontur(own::SYNTAX, "G04 without a time", g.span));
        };
        let others: Vec<(usize, Span)> = words
            .axes
            .iter()
            .filter(|(axis, _, _)| of_axis.is_none() || Some(*axis) != main)
            .map(|(axis, _, span)| (*axis, *span))
            .collect();
        for (axis, span) in others {
            let number = self.machine.axes[axis].number();
            let name = self.axis_name(axis).to_owned();
            let text = format!("G04 with the further axis {name}, which does not move");
            self.note(Fault::vendor(20685, text, span).with(|d| d.axis(number, name)));
        }
        self.dwell_for(seconds, span)
    }

    /// Waits for a time at rest; 20752 outside the range.
    pub(super) fn dwell_for(&mut self, seconds: f64, span: Span) -> Outcome<()> {
        if !(0.0..=DWELL_MAX_S).contains(&seconds) {
            let text = format!("dwell of {seconds} s is outside 0 to {DWELL_MAX_S} s");
            return Err(Fault::vendor(20752, text, span).with(|d| {
                d.value(ValueKind::Wrong, seconds * 1e6, "us")
                    .value(ValueKind::LowerLimit, 0.0, "us")
                    .value(ValueKind::UpperLimit, DWELL_MAX_S * 1e6, "us")
            }));
        }
        self.sync(Sync::Dwell { seconds });
        Ok(())
    }

    fn motion(&mut self, words: &Words<'_>, is_arc: bool, span: Span) -> Outcome<()> {
        let start = self.coordinates.target().clone();
        let mut targets: smallvec::SmallVec<[Target; 8]> = words
            .axes
            .iter()
            .enumerate()
            .map(|(i, (axis, value, _))| Target {
                axis: *axis,
                value: value * self.axis_unit(*axis),
                absolute: words.is_absolute(i, self.modal.absolute),
            })
            .collect();
        let suppressed = words.hashes.iter().find(|(h, _, _)| &*h.name == "SUPPRESS OFFSETS");
        for target in targets.iter_mut().filter(|t| t.absolute) {
            if self.machine.axes[target.axis].is_modulo() {
                let turn = words.turns.iter().find(|(axis, _)| *axis == target.axis);
                let turn = turn.map(|(_, sign)| *sign).transpose().map_err(two_readings)?;
                let offset = match suppressed {
                    Some(_) => 0.0,
                    None => self.coordinates.active_offset(target.axis),
                };
                target.value = modulo::unwrapped(target.value, turn, start[target.axis] - offset);
            }
        }
        match suppressed {
            Some((_, _, at)) if targets.iter().any(|t| !t.absolute) => {
                let text = "#SUPPRESS OFFSETS acts only with G90";
                return Err(Fault::vendor(20985, text, *at));
            }
            Some((_, _, at)) if !self.coordinates.frame().is_identity() => {
                let what = "#SUPPRESS OFFSETS in a frame";
                return Err(Fault::unsupported(what, *at));
            }
            Some(_) => self.coordinates.program_without_offsets(&targets),
            None => self.coordinates.program(&targets),
        }
        let path = if is_arc {
            Some(self.arc(&start, words, span)?)
        } else {
            let end = self.coordinates.target().clone();
            if let Some((_, at)) = words.centre.iter().flatten().next()
                && words.group(Group::Insertion).is_none()
            {
                let text = "I, J and K have no meaning in a straight motion";
                self.note(Fault::kontur(own::ODD, text, *at).warning());
            }
            if let Some((radius, _)) = words.radius {
                self.modal.radius_mm = Some(radius * self.unit_mm());
            }
            LinePath::new(self.on_path(&start), self.on_path(&end), &self.feed_axes).map(Path::Line)
        };
        // a block without way needs no feed
        let Some(path) = path else { return Ok(()) };
        // a compensated path is known later
        if self.modal.compensation == Compensation::Off {
            self.check_limits(&path, words, span);
        }
        self.join_for(&path);
        let at = words.axes.first().map_or(span, |(_, _, at)| *at);
        let feed = self.feed_of(&path, at)?;
        let end_velocity_mm_s = match words.end_feed {
            Some(end) => self.end_velocity(end, feed)?,
            None => None,
        };
        let rapid = feed == Feed::Rapid;
        let full = words.g.iter().any(|g| g.row.act == Act::FullOverride);
        let (low, high) =
            path.extent().unwrap_or_else(|| (path.start().clone(), path.end().clone()));
        let moved = (0..low.len()).filter(|i| low[*i].to_bits() != high[*i].to_bits());
        let feed_ratio = if full { 1.0 } else { self.overrides.ratio(rapid, moved) };
        let once = |act: Act| words.g.iter().any(|g| g.row.act == act);
        let stops = self.modal.exact_stop || once(Act::ExactStopOnce);
        let rounds = !stops && (self.modal.contouring || once(Act::ContourOnce));
        let (plane, tilt, compensation) = self.plane_and_compensation(span)?;
        // of a block with an error nothing moves; what was said before it is still said
        if self.failed() && !self.checking {
            return Ok(());
        }
        // a large thing: made where it stays
        let motion = Box::new(Motion {
            block: Block {
                seq: 0,
                path,
                feed,
                feed_ratio,
                full_override: full,
                end_velocity_mm_s,
                slope: self.modal.slope,
                dynamics: self.dynamics(rapid),
                tolerance: self.shaping.tolerance(),
                contour: if rounds { Some(self.contouring.settings()) } else { self.hsc.contour() },
                spline: self.hsc.spline(),
            },
            source: self.source,
            events: self.contour.take_events(),
            plane,
            tilt,
            local: false,
            compensation,
            span,
        });
        self.moved = true;
        for fault in self.contour.motion(motion) {
            self.note(Box::new(fault));
        }
        for fault in self.limits_of_compensated() {
            self.note(Box::new(fault));
        }
        Ok(())
    }

    /// Axes of the active plane, its coordinate system if it lies askew to the axes, and the compensation.
    fn plane_and_compensation(
        &self,
        span: Span,
    ) -> Outcome<([usize; 2], Option<Tilt>, Option<Compensated>)> {
        let main = self.modal.plane.main_axes();
        let frame = self.coordinates.frame();
        let axis = |m: usize| self.coordinates.main_axis(m);
        let compensated = self.modal.compensation != Compensation::Off;
        let tilt = self.tilt(span)?;
        let (plane, keeps_sense) = match frame.image_of_plane(main[0], main[1]) {
            Some(image) if tilt.is_none() => image,
            _ => ([main[0], main[1]], true),
        };
        let (Some(first), Some(second)) = (axis(plane[0]), axis(plane[1])) else {
            if compensated {
                let text = "the plane of the tool radius compensation has no axis in the channel";
                return Err(Fault::vendor(20200, text, span));
            }
            return Ok(([0, 0], tilt, None));
        };
        let left = (self.modal.compensation == Compensation::Left) == keeps_sense;
        let radius = self.tools.active.radius_mm;
        let compensation = compensated.then_some(Compensated {
            distance_mm: if left { radius } else { -radius },
            straight_corners: self.modal.corners == Corners::Straight,
            perpendicular: self.modal.perpendicular_selection,
        });
        Ok(([first, second], tilt, compensation))
    }

    /// The frame, if the active plane lies askew to the axes in it.
    fn tilt(&self, span: Span) -> Outcome<Option<Tilt>> {
        let main = self.modal.plane.main_axes();
        let frame = self.coordinates.frame();
        if frame.image_of_plane(main[0], main[1]).is_some() {
            return Ok(None);
        }
        let axis = |m: usize| self.coordinates.main_axis(m);
        let (Some(x), Some(y), Some(z)) = (axis(0), axis(1), axis(2)) else {
            let text = "a coordinate system turned in space needs three main axes";
            return Err(Fault::vendor(20200, text, span));
        };
        let (axes, origin) = ([x, y, z], self.coordinates.to_machine([0.0; 3]));
        let t_mm = std::array::from_fn(|i| origin[i] - self.independent.way[axes[i]]);
        Ok(Some(Tilt { axes, m: frame.m, t_mm }))
    }

    /// A path against the software limits (P-AXIS-00177, P-AXIS-00178), with the points where an arc turns round.
    fn check_limits(&mut self, path: &Path, words: &Words<'_>, span: Span) {
        let Some((low, high)) = path.extent() else { return };
        for axis in 0..low.len() {
            let at = words.axes.iter().find(|(a, _, _)| *a == axis).map_or(span, |(_, _, s)| *s);
            let end = path.end()[axis];
            if let Some(fault) = self.outside_limits(axis, low[axis], high[axis], Some(end), at) {
                self.note(fault);
            }
        }
    }

    /// Compensated motions against the software limits.
    pub(super) fn limits_of_compensated(&mut self) -> Vec<Fault> {
        let mut faults = Vec::new();
        for (low, high, source, span) in self.contour.take_driven() {
            for axis in 0..low.len() {
                let fault = self.outside_limits(axis, low[axis], high[axis], None, span);
                faults.extend(fault.map(|f| *f.in_block(source)));
            }
        }
        faults
    }

    /// 21897 for an axis that moves between `low` and `high` and leaves its limits.
    fn outside_limits(
        &self,
        axis: usize,
        low: f64,
        high: f64,
        end: Option<f64>,
        span: Span,
    ) -> Option<Box<Fault>> {
        if low.to_bits() == high.to_bits() {
            return None;
        }
        let limits @ (least, most) = self.limits_mm[axis]?;
        let outside = |x: f64| !(least..=most).contains(&x);
        // the path leaves out what the axis has gone as an independent axis
        let way = self.independent.way[axis];
        let (low, high) = (low + way, high + way);
        // the end of the block is what the program says
        let (what, x) = match end.map(|end| end + way).filter(|end| outside(*end)) {
            Some(end) => ("target", end),
            None if outside(low) => ("lowest position", low),
            None if outside(high) => ("highest position", high),
            None => return None,
        };
        Some(self.limit_fault(axis, what, x, limits, span))
    }

    /// 21897 for a target outside the software limits of its axis.
    pub(super) fn check_limit(&mut self, axis: usize, target: f64, at: Span) {
        let Some(limits @ (low, high)) = self.limits_mm[axis] else { return };
        if !(low..=high).contains(&target) {
            let fault = self.limit_fault(axis, "target", target, limits, at);
            self.note(fault);
        }
    }

    fn limit_fault(
        &self,
        axis: usize,
        what: &str,
        x: f64,
        (least, most): (f64, f64),
        span: Span,
    ) -> Box<Fault> {
        let name = self.axis_name(axis).to_owned();
        let number = self.machine.axes[axis].number();
        let text = format!("axis {name}: {what} {x} is outside its limits {least} to {most}");
        let fault = Fault::vendor(21897, text, span).with(|d| {
            d.axis(number, name)
                .value(ValueKind::Current, x * 1e4, "0.1um")
                .value(ValueKind::LowerLimit, least * 1e4, "0.1um")
                .value(ValueKind::UpperLimit, most * 1e4, "0.1um")
                .parameter("P-AXIS-00177")
        });
        let behaviour = self.machine.axes[axis].text("kenngr.swe_behaviour");
        if behaviour.as_deref() == Some("WARNING") { fault.warning() } else { fault }
    }

    /// Position of the axes without the ways that they have gone as independent axes.
    fn on_path(&self, position: &AxisVec) -> AxisVec {
        position.iter().zip(self.independent.way.iter()).map(|(x, way)| x - way).collect()
    }

    fn arc(&mut self, from: &AxisVec, words: &Words<'_>, span: Span) -> Outcome<Path> {
        let from = &self.on_path(from);
        let target = self.on_path(self.coordinates.target());
        let main = self.modal.plane.main_axes();
        let tilt = self.tilt(span)?;
        let image = self.coordinates.frame().image_of_plane(main[0], main[1]);
        // askew to the axes the arc is one of the coordinate system
        let (image, keeps_sense) =
            image.filter(|_| tilt.is_none()).unwrap_or(([main[0], main[1]], true));
        let (start, end) = match &tilt {
            Some(tilt) => local_ends(tilt, from, &target),
            None => (from.clone(), target.clone()),
        };
        let axis = |m: usize| {
            self.coordinates.main_axis(m).ok_or_else(|| {
                let text = "the plane of the arc has no axis in the channel";
                Fault::vendor(20200, text, span)
            })
        };
        let plane = [axis(image[0])?, axis(image[1])?];
        let in_plane = |p: &AxisVec| [p[plane[0]], p[plane[1]]];
        let (s, e) = (in_plane(&start), in_plane(&end));
        let ccw = (self.modal.path == PathMode::CounterClockwise) == keeps_sense;
        let centre_words = [words.centre[main[0]], words.centre[main[1]]];
        let has_centre = centre_words.iter().any(Option::is_some);
        if let Some((radius, at)) = words.radius {
            if has_centre {
                let text = "centre and radius in one block";
                return Err(Fault::vendor(21024, text, at));
            }
            self.modal.radius_mm = Some(radius * self.unit_mm());
        }
        let found = if let (false, Some(radius)) = (has_centre, self.modal.radius_mm) {
            arc::by_radius(s, e, radius, ccw)
        } else {
            let centre = self.centre(&start, main, image, tilt.is_some(), centre_words);
            let limits = &self.machine.channel.arc_centre;
            arc::by_centre(s, e, centre, ccw, self.modal.centre_correction, limits)
        };
        let at = words.radius.or(centre_words[0]).or(centre_words[1]);
        let g = words.group(Group::Path).map_or(span, |g| g.span);
        let at = at.map_or(g, |(_, at)| at);
        let mut arc = found.map_err(|e| arc_fault(e, at))?;
        let pitch_word = words.centre[main[2]];
        if let Some((pitch, at)) = pitch_word {
            let normal =
                (0..3).find(|i| !image.contains(i)).and_then(|m| self.coordinates.main_axis(m));
            let height = normal.map_or(0.0, |axis| end[axis] - start[axis]);
            if pitch == 0.0 || height == 0.0 {
                if pitch != 0.0 {
                    let text = "a pitch has no meaning without a way along the third axis";
                    self.note(Fault::kontur(own::ODD, text, at).warning());
                }
            } else {
                arc.sweep_rad = arc::with_turns(arc.sweep_rad, height, pitch * self.unit_mm());
            }
        }
        self.last_arc.centre_mm = [arc.centre[0] - s[0], arc.centre[1] - s[1]];
        self.last_arc.plane = image;
        self.last_arc.shift_mm = arc.shift;
        self.last_arc.radius_mm =
            libm::hypot(self.last_arc.centre_mm[0], self.last_arc.centre_mm[1]);
        let shape = ArcShape { plane, centre_mm: arc.centre, sweep_rad: arc.sweep_rad };
        let arc = ArcPath::new(start, end, shape, &self.feed_axes)
            .ok_or_else(|| arc_fault(ArcError::RadiusZero, at))?;
        Ok(match tilt {
            Some(tilt) => Path::Tilted(Box::new(TiltedArc::new(arc, tilt, from.clone(), target))),
            None => Path::Arc(arc),
        })
    }

    /// Centre in the coordinates of the axes, or of the program if the plane lies askew to them.
    fn centre(
        &self,
        start: &AxisVec,
        main: [usize; 3],
        image: [usize; 2],
        tilted: bool,
        words: [Option<Placed>; 2],
    ) -> [f64; 2] {
        let value = |w: Option<Placed>| w.map_or(0.0, |(v, _)| v * self.unit_mm());
        let from = |m: usize| self.coordinates.main_axis(m).map_or(0.0, |axis| start[axis]);
        if tilted {
            let c = words.map(value);
            if self.modal.centre_absolute {
                return c;
            }
            return [from(image[0]) + c[0], from(image[1]) + c[1]];
        }
        let mut p = [0.0; 3];
        (p[main[0]], p[main[1]]) = (value(words[0]), value(words[1]));
        if self.modal.centre_absolute {
            let q = self.coordinates.to_machine(p);
            let way = |m: usize| {
                self.coordinates.main_axis(m).map_or(0.0, |axis| self.independent.way[axis])
            };
            return [q[image[0]] - way(image[0]), q[image[1]] - way(image[1])];
        }
        let d = self.coordinates.frame().direction(p);
        [from(image[0]) + d[image[0]], from(image[1]) + d[image[1]]]
    }

    /// Feed of a block with this path.
    fn feed_of(&mut self, path: &Path, span: Span) -> Outcome<Feed> {
        if self.modal.path == PathMode::Rapid {
            return Ok(Feed::Rapid);
        }
        let Some(word) = self.modal.feed().filter(|f| f.value > 0.0) else {
            let key = "20008".to_owned();
            let text = "the feed is 0: no F word has been programmed";
            self.note_once(&key, Fault::vendor(20008, text, span));
            // the block is left out, the positions go on
            return Ok(Feed::PathVelocity(1.0));
        };
        let unit_mm = if word.inch && self.feed_is_linear(path) { 25.4 } else { 1.0 };
        Ok(match self.modal.feed_type {
            FeedType::PerMinute => Feed::PathVelocity(
                word.value * unit_mm * self.machine.channel.feed_unit_mm_min / 60.0,
            ),
            FeedType::Time => Feed::Duration(word.value),
            FeedType::ShareOfMaximum => Feed::ShareOfMaximum(word.value / 100.0),
            FeedType::PerRevolution => {
                let rpm = self.spindles[0].rpm.abs();
                if rpm == 0.0 {
                    let text = "feed per revolution, but the main spindle has no speed";
                    return Err(Fault::vendor(60132, text, span));
                }
                Feed::PathVelocity(word.value * unit_mm * rpm / 60.0)
            }
        })
    }

    /// True unless only rotary axes move.
    fn feed_is_linear(&self, path: &Path) -> bool {
        !path.is_straight()
            || (0..path.start().len())
                .any(|i| self.is_linear(i) && path.start()[i].to_bits() != path.end()[i].to_bits())
    }

    /// Unit of an F word with G94 in mm/s.
    pub(super) fn feed_unit_mm_s(&self) -> f64 {
        self.unit_mm() * self.machine.channel.feed_unit_mm_min / 60.0
    }

    fn end_velocity(&self, (value, span): Placed, feed: Feed) -> Outcome<Option<f64>> {
        let Feed::PathVelocity(v) = feed else {
            let text = "E acts only with G94 and not in rapid traverse";
            return Err(Fault::kontur(own::SYNTAX, text, span));
        };
        if self.modal.feed_type != FeedType::PerMinute || value < 0.0 {
            let text = "E acts only with G94 and is not negative";
            return Err(Fault::kontur(own::SYNTAX, text, span));
        }
        Ok(Some((value * self.feed_unit_mm_s()).min(v)))
    }

    /// Chamfer or rounding in front of the next motion.
    pub(super) fn insert(&mut self, kind: Kind, size_mm: f64, feed_mm_s: Option<f64>, span: Span) {
        let insertion = Insertion { kind, size_mm, feed_mm_s, span, source: self.source };
        if let Some(fault) = self.contour.insert(insertion) {
            self.note(fault);
        }
    }
}

/// A sum behind the sign of a modulo axis.
fn two_readings(span: Span) -> Box<Fault> {
    let text =
        "the first sign behind a modulo axis is its direction of rotation, not that of a term";
    Fault::kontur(own::SYNTAX, text, span)
        .hint("put the position in brackets: C-[P1+5] turns in negative direction, C[-P1+5] the shortest way")
}

/// The diagnostic of an arc that does not exist.
fn arc_fault(error: ArcError, span: Span) -> Box<Fault> {
    match error {
        ArcError::RadiusZero => {
            Fault::vendor(20036, "the radius of the arc is 0", span).hint("is I, J or K missing?")
        }
        ArcError::FullCircleWithRadius => {
            let text = "a full circle cannot be programmed with R";
            Fault::vendor(20034, text, span).hint("use I, J, K")
        }
        ArcError::RadiusTooSmall { radius, half_chord } => {
            let text = format!(
                "radius {} is smaller than half the chord, {half_chord:.6} mm",
                radius.abs()
            );
            Fault::kontur(own::RADIUS_TOO_SMALL, text, span)
        }
        ArcError::CentreTooFar { shift, limit } => {
            let text = format!(
                "start, end and centre do not fit: the centre would have to move by {shift:.6} mm, at most {limit:.6} mm"
            );
            Fault::kontur(own::ARC_CENTRE, text, span)
                .with(|d| d.parameter("P-CHAN-00059"))
                .hint("G161 makes I, J, K absolute, G162 relative to the start point")
        }
        ArcError::RadiiDiffer { start, end, limit } => {
            let text = format!(
                "the radii at start and end differ by {:.6} mm, at most {limit:.6} mm",
                (start - end).abs()
            );
            Fault::vendor(21758, text, span).with(|d| {
                d.value(ValueKind::Current, (start - end).abs() * 1e4, "0.1um")
                    .value(ValueKind::Limit, limit * 1e4, "0.1um")
                    .value(ValueKind::StartValue, start * 1e4, "0.1um")
                    .value(ValueKind::TargetValue, end * 1e4, "0.1um")
                    .parameter("P-CHAN-00171")
            })
        }
    }
}
