//! Centre, end and faults of a programmed arc.

mod faults;

use super::plane::PlaneImage;
use crate::diag::Condition;
use crate::exec::block::choice::PathMode;
use crate::exec::block::collected::{Placed, Words};
use crate::exec::block::groups::{Act, Group};
use crate::exec::block::modal::Modal;
use crate::exec::contour::local_ends;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::geometry::angle::{cos_deg, sin_deg};
use crate::exec::geometry::arc::{self, Arc, ArcError};
use crate::exec::geometry::coordinates::{Coordinates, Target};
use crate::exec::motion::state::{ContourLines, MotionState};
use crate::exec::report::{Report, Subject};
use crate::exec::values::number::LARGEST_MM;
use crate::machine::Channel;
use crate::syntax::ast::Span;
use faults::{arc_fault, note_moved_centre, other_pitch};
use kontur_motion::axis::AxisVec;
use kontur_motion::path::{ArcPath, ArcShape, Path, TiltedArc};

impl Modal {
    /// I, J and K of a block in the plane of its arc. With P-CHAN-00159 = 1 the last values apply to those that the block
    /// omits.
    ///
    /// Assumption: when both a modal centre and a modal radius exist, the later one applies.
    fn centre_words(
        &mut self,
        channel: &Channel,
        words: &Words<'_>,
        plane: [usize; 2],
        span: Span,
    ) -> [Option<Placed>; 2] {
        let written = plane.map(|main| words.centre[main]);
        if !channel.language.modal_centres {
            return written;
        }
        let unit = self.unit_mm();
        if words.radius.is_some() {
            self.centre_mm = [None; 3];
            return written;
        }
        for (main, word) in plane.into_iter().zip(written) {
            if let Some((value, _)) = word {
                self.centre_mm[main] = Some(value * unit);
                self.radius_mm = None;
            }
        }
        plane.map(|main| {
            words.centre[main].or(self.centre_mm[main].map(|value| (value / unit, span)))
        })
    }
}

/// Centre, R and G163 exclude each other.
fn defined_once(words: &Words<'_>, has_centre: bool) -> Outcome<()> {
    let by_word = words.with(Act::Radius);
    if let (Some(g), true) = (by_word, has_centre || words.radius.is_some()) {
        let text = "G163 beside I, J, K or R: the radius is given twice";
        return Err(Fault::new(Condition::CentreWithG163, text, g.span));
    }
    match words.radius {
        Some((_, at)) if has_centre => {
            Err(Fault::new(Condition::CentreAndRadius, "centre and radius in one block", at))
        }
        _ => Ok(()),
    }
}

impl Geometry {
    /// The axes of a plane given by its main axes.
    fn axes_of_plane(&self, main: [usize; 2], span: Span) -> Outcome<[usize; 2]> {
        let axis = |m: usize| {
            self.coordinates.main_axis(m).ok_or_else(|| {
                let text = "the plane of the arc has no axis in the channel";
                Fault::new(Condition::AxisOrCommandExpected, text, span)
            })
        };
        Ok([axis(main[0])?, axis(main[1])?])
    }

    /// Travel in mm between two positions along the main axis that is not in a plane.
    fn height_over(&self, plane: [usize; 2], [start, end]: [&AxisVec; 2]) -> f64 {
        let normal =
            (0..3).find(|i| !plane.contains(i)).and_then(|m| self.coordinates.main_axis(m));
        normal.map_or(0.0, |axis| end[axis] - start[axis])
    }

    /// Centre in axis coordinates, or in program coordinates if the plane is oblique to the axes; `way`: independent travel of
    /// the axes.
    fn centre(
        &self,
        start: &AxisVec,
        plane: &PlaneImage,
        words: [Option<Placed>; 2],
        modal: &Modal,
        way: &AxisVec,
    ) -> [f64; 2] {
        let values = words.map(|word| word.map_or(0.0, |(value, _)| value * modal.unit_mm()));
        let [first, second] = plane.main;
        let of =
            |axes: &AxisVec, m: usize| self.coordinates.main_axis(m).map_or(0.0, |axis| axes[axis]);
        let from = [of(start, first), of(start, second)];
        if plane.tilt.is_some() {
            if modal.centre_absolute {
                return values;
            }
            return [from[0] + values[0], from[1] + values[1]];
        }
        let main = modal.plane.main_axes();
        let mut p = [0.0; 3];
        (p[main[0]], p[main[1]]) = (values[0], values[1]);
        if modal.centre_absolute {
            let q = self.coordinates.to_machine(p);
            return [q[first] - of(way, first), q[second] - of(way, second)];
        }
        let d = self.coordinates.frame().direction(p);
        [from[0] + d[first], from[1] + d[second]]
    }

    /// Keeps centre and radius of an arc for the system variables and for arcs that refer to it; `absolute`: its centre was
    /// programmed in absolute coordinates.
    fn keep_arc(
        &mut self,
        arc: &Arc,
        start: &AxisVec,
        plane: [usize; 2],
        absolute: bool,
        way: &AxisVec,
    ) {
        let centre_mm = [0, 1].map(|k| arc.centre[k] - start[plane[k]]);
        let last = &mut self.last_arc;
        (last.centre_mm, last.programmed_mm, last.shift_mm) = (centre_mm, centre_mm, arc.shift);
        last.radius_mm = libm::hypot(centre_mm[0], centre_mm[1]);
        if absolute {
            let mut centre = start.clone();
            for k in 0..2 {
                centre[plane[k]] = arc.centre[k] + way[plane[k]];
            }
            let programmed = self.coordinates.program_at(&centre);
            self.last_arc.programmed_mm = plane.map(|axis| programmed[axis]);
        }
    }
}

impl ContourLines {
    /// `#CANG`: the end of an arc given by the centre and the angle of the arc instead of an end point.
    ///
    /// Source: TF5200 diagnosis, 22253; no page prints more. Assumption: the angle is in degrees and positive, its direction
    /// is that of G02 or G03.
    pub(super) fn arc_angle(
        &mut self,
        words: &Words<'_>,
        is_arc: bool,
        coordinates: &Coordinates,
        modal: &Modal,
    ) -> Outcome<()> {
        let Some((_, angle, at)) = words.hashes.iter().find(|(hash, _, _)| &*hash.name == "CANG")
        else {
            return Ok(());
        };
        let at = *at;
        if !is_arc {
            let text = "#CANG needs G02 or G03";
            return Err(Fault::new(Condition::Syntax, text, at)
                .hint("write the arc in this block: G02 I5 #CANG=90"));
        }
        let Some(angle) = angle.filter(|angle| *angle > 0.0 && *angle <= 360.0) else {
            let text = "#CANG needs an angle above 0 and up to 360 deg";
            return Err(Fault::new(Condition::Range, text, at));
        };
        let [first, second, _] = modal.plane.main_axes();
        let plane = [first, second].map(|m| coordinates.main_axis(m));
        let [Some(x), Some(y)] = plane else {
            let text = "the plane of the arc has no axis in the channel";
            return Err(Fault::new(Condition::AxisOrCommandExpected, text, at));
        };
        if let Some((_, _, end)) = words.axes.iter().find(|(axis, _, _)| *axis == x || *axis == y) {
            let text = "#CANG together with an end point in the plane of the arc";
            return Err(Fault::new(Condition::CircleAngleAndEnd, text, *end));
        }
        let centre = [words.centre[first], words.centre[second]];
        if centre.iter().all(Option::is_none) {
            let text = "#CANG without a centre";
            return Err(Fault::new(Condition::ArcRadiusZero, text, at).hint("write I, J or K"));
        }
        let here = [x, y].map(|axis| coordinates.programmed(axis));
        let given = centre.map(|word| word.map_or(0.0, |(value, _)| value * modal.unit_mm()));
        let to_centre =
            if modal.centre_absolute { [given[0] - here[0], given[1] - here[1]] } else { given };
        let counter = modal.path == PathMode::CounterClockwise;
        let (sin, cos) = (sin_deg(angle), cos_deg(angle));
        let sin = if counter { sin } else { -sin };
        // the vector from the centre to the start, rotated
        let [a, b] = to_centre;
        let end = [here[0] + a - (a * cos - b * sin), here[1] + b - (a * sin + b * cos)];
        self.targets = vec![
            Target { axis: x, value: end[0], absolute: true },
            Target { axis: y, value: end[1], absolute: true },
        ];
        Ok(())
    }
}

impl MotionState {
    /// 120462 if the feed group is neither the axes of the arc (with its pitch) nor only axes outside it.
    ///
    /// The page does not define F for this case. Here it is the feed rate in the plane, as without `#FGROUP`.
    fn feed_group_fits(
        &self,
        plane: [usize; 2],
        coordinates: &Coordinates,
        channel: &Channel,
        report: &mut Report,
        span: Span,
    ) -> Outcome<()> {
        let feed = self.limits.feed_axes();
        // the group of the lists consists of the main axes, also after an axis exchange
        if *feed == channel.feed.axes {
            return Ok(());
        }
        let in_group = |axis: usize| feed.get(axis).copied().unwrap_or(false);
        let is_main = |axis: usize| coordinates.main_index(axis).is_some();
        let group = || (0..feed.len()).filter(|axis| in_group(*axis));
        let whole = plane.into_iter().all(in_group) && group().all(is_main);
        if !group().any(is_main) && group().next().is_some() {
            return Err(Fault::unsupported(
                "an arc whose F applies along other axes (#FGROUP)",
                span,
            ));
        }
        if whole || group().next().is_none() {
            return Ok(());
        }
        let text = "the axes of #FGROUP are not those of the arc: F applies in the plane";
        report.note_once(Subject::Only, Fault::new(Condition::FeedGroupOfArc, text, span));
        Ok(())
    }
}

/// An arc in its plane, as the words of its block give it.
struct Given {
    arc: Arc,
    /// By I, J and K, otherwise by a radius.
    has_centre: bool,
    /// The word that gives it.
    at: Span,
}

impl Decoder {
    /// The path of G02 and G03 from a position to the target of the block.
    pub(super) fn arc(&mut self, from: AxisVec, words: &Words<'_>, span: Span) -> Outcome<Path> {
        let from = &self.motion.independent.on_path(from);
        let target = self.motion.independent.on_path(self.geometry.coordinates.target().clone());
        let main = self.modal.plane.main_axes();
        // in a plane oblique to the axes, the arc is given in the coordinate system
        let image = self.geometry.image_of_plane(main, &self.motion.independent.way, span)?;
        let (start, end) = match &image.tilt {
            Some(tilt) => local_ends(tilt, from, &target),
            None => (from.clone(), target.clone()),
        };
        let plane = self.geometry.axes_of_plane(image.main, span)?;
        let Given { mut arc, has_centre, at } =
            self.given_arc(words, &image, plane, [&start, &end], span)?;
        if let Some((pitch, at)) = words.centre[main[2]].filter(|(pitch, _)| *pitch != 0.0) {
            let height = self.geometry.height_over(image.main, [&start, &end]);
            let pitch_mm = pitch * self.modal.unit_mm() * self.geometry.scale_of_main(main[2]);
            wind(&mut arc, height, pitch_mm, &mut self.report, at);
        }
        let absolute = self.modal.centre_absolute && has_centre && image.tilt.is_none();
        let way = &self.motion.independent.way;
        self.geometry.keep_arc(&arc, &start, plane, absolute, way);
        self.geometry.last_arc.plane = image.main;
        let shape = ArcShape { plane, centre_mm: arc.centre, sweep_rad: arc.sweep_rad };
        self.motion.feed_group_fits(
            plane,
            &self.geometry.coordinates,
            &self.machine.channel,
            &mut self.report,
            span,
        )?;
        let arc = ArcPath::new(start, end, shape, self.motion.limits.feed_axes())
            .ok_or_else(|| arc_fault(ArcError::RadiusZero, at))?;
        Ok(match image.tilt {
            Some(tilt) => Path::Tilted(Box::new(TiltedArc::new(arc, *tilt, from.clone(), target))),
            None => Path::Arc(arc),
        })
    }

    /// The arc by centre or radius; `plane`: the axes of its plane.
    fn given_arc(
        &mut self,
        words: &Words<'_>,
        image: &PlaneImage,
        plane: [usize; 2],
        [start, end]: [&AxisVec; 2],
        span: Span,
    ) -> Outcome<Given> {
        let in_plane = |p: &AxisVec| [p[plane[0]], p[plane[1]]];
        let (s, e) = (in_plane(start), in_plane(end));
        let ccw = (self.modal.path == PathMode::CounterClockwise) == image.keeps_sense;
        let [first, second, _] = self.modal.plane.main_axes();
        let scale = self.geometry.scale_of_plane([first, second], span)?;
        let centre_words = self
            .modal
            .centre_words(&self.machine.channel, words, [first, second], span)
            .map(|word| word.map(|(value, at)| (value * scale, at)));
        let has_centre = centre_words.iter().any(Option::is_some);
        defined_once(words, has_centre)?;
        if let Some((radius, _)) = words.radius {
            self.modal.radius_mm = Some(radius * self.modal.unit_mm());
        }
        let g = words.group(Group::Path).map_or(span, |g| g.span);
        let found = if has_centre {
            let way = &self.motion.independent.way;
            let centre = self.geometry.centre(start, image, centre_words, &self.modal, way);
            let limits = &self.machine.channel.arc_centre;
            arc::by_centre(s, e, centre, ccw, self.modal.centre_correction, limits)
                .inspect(|arc| note_moved_centre(arc, [s, e], centre, limits, &mut self.report, g))
        } else if let Some(radius) = self.modal.radius_mm {
            arc::by_radius(s, e, radius * scale, ccw)
        } else {
            // without a centre, radius programming is expected; centre correction does not apply to it
            let text = "neither a centre (I, J, K) nor a radius (R): the arc is not defined";
            return Err(Fault::new(Condition::ArcRadiusZero, text, g)
                .hint("write I, J, K or R; R is modal"));
        };
        let at = words.radius.or(centre_words[0]).or(centre_words[1]).map_or(g, |(_, at)| at);
        let arc = found.map_err(|e| arc_fault(e, at))?;
        if !has_centre && arc.centre.iter().any(|x| x.abs() > LARGEST_MM) {
            let text = "the centre of this radius is outside the data format";
            return Err(Fault::new(Condition::CentreTooFar, text, at));
        }
        Ok(Given { arc, has_centre, at })
    }
}

/// Adds the turns of a helix with this pitch; K-0109 for a pitch that says something else than the helix does.
fn wind(arc: &mut Arc, height_mm: f64, pitch_mm: f64, report: &mut Report, at: Span) {
    if height_mm == 0.0 {
        let text = "a pitch has no meaning without travel along the third axis";
        report.note(Fault::new(Condition::Odd, text, at).warning());
        return;
    }
    arc.sweep_rad = arc::with_turns(arc.sweep_rad, height_mm, pitch_mm);
    if let Some(text) = other_pitch(arc.sweep_rad, height_mm, pitch_mm) {
        report.note_once("pitch of a helix", Fault::new(Condition::Odd, text, at));
    }
}
