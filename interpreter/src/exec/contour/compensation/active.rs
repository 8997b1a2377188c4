//! Active compensation: one element after another, with the corner between them.

use super::corner::{above, corner_arc, inner_corner, straight, straight_corner};
use super::element::{Course, Element, emit_between};
use super::failure::{Fallible, too_tight};
use crate::diag::Condition;
use crate::exec::contour::bottleneck::{Cut, Watch};
use crate::exec::contour::item::Item;
use crate::exec::contour::motion::Motion;
use crate::exec::fault::Fault;
use crate::exec::geometry::planar::Side;
use crate::exec::geometry::point::{Point, cross, dot};
use crate::exec::step::SourceRef;
use crate::syntax::ast::Span;
use kontur_motion::path::Tilt;
use smallvec::SmallVec;

/// Maximum number of steps between two motions while a corner is pending.
const BETWEEN_MAX: usize = 1000;

/// Change of direction up to which a corner may count as smooth: the parallels then differ by less than a millionth of the tool
/// radius.
const ALL_BUT_SMOOTH: f64 = 1e-6;

/// An inserted line along which the tool stays at the contour.
pub(super) fn at_contour(mut line: Box<Motion>, distance: f64) -> Item {
    line.engaged = Some(distance > 0.0);
    Item::Motion(line)
}

/// Active compensation.
#[derive(Debug)]
pub(super) struct Active {
    /// Distance to the left of the contour, negative to the right.
    pub(super) distance: f64,
    /// G237.
    pub(super) perpendicular: bool,
    pub(super) plane: [usize; 2],
    pub(super) tilt: Option<Box<Tilt>>,
    pub(super) last: Element,
    pub(super) between: Vec<Item>,
    pub(super) watch: Watch,
}

impl Active {
    pub(super) fn hold(&mut self, item: Item, span: Span) -> Fallible<()> {
        if self.between.len() >= BETWEEN_MAX {
            let text = format!("more than {BETWEEN_MAX} blocks without motion in the plane");
            return Err(Fault::new(Condition::Compensation, text, span));
        }
        self.between.push(item);
        Ok(())
    }

    /// Completes the last element at the corner to the next one; a bottleneck is recorded in `cut`.
    pub(super) fn join(
        mut self,
        motion: Box<Motion>,
        side: Side,
        out: &mut Vec<Item>,
        cut: &mut Option<Cut>,
    ) -> Fallible<Self> {
        let mut watched = Watched::new(&mut self, out);
        let mut next = self.corner(motion, side, out)?;
        watched.compare(out, cut);
        next.watch = watched.watch;
        Ok(next)
    }

    pub(super) fn corner(
        self,
        motion: Box<Motion>,
        side: Side,
        out: &mut Vec<Item>,
    ) -> Fallible<Self> {
        if self.last.course.approaches() {
            return self.end_approach(motion, side, out);
        }
        let (u, w) = (self.last.side.tangent(true), side.tangent(false));
        let turn = cross(u, w);
        let smooth = turn.abs() < 1e-9 && dot(u, w) > 0.0;
        let back = turn.abs() < 1e-9 && dot(u, w) < 0.0;
        if smooth {
            let end = above(side.start_point(), u, self.distance);
            self.go_on(motion, side, end, out)
        } else if turn * self.distance < 0.0 || back {
            self.outer(motion, side, out)
        } else {
            self.inner(motion, side, turn, out)
        }
    }

    /// The last element ends here, and the next one begins on its parallel.
    fn go_on(
        self,
        motion: Box<Motion>,
        side: Side,
        at: Point,
        out: &mut Vec<Item>,
    ) -> Fallible<Self> {
        self.last.emit(at, self.plane, self.distance, out)?;
        emit_between(self.between, at, self.plane, out);
        Ok(Self { last: Element::parallel(motion, side, at), between: Vec::new(), ..self })
    }

    /// The approach ends above the first point of the contour.
    fn end_approach(self, motion: Box<Motion>, side: Side, out: &mut Vec<Item>) -> Fallible<Self> {
        let direction = side.tangent(false);
        let after = above(side.start_point(), direction, self.distance);
        if self.last.course != Course::TangentialApproach {
            return self.go_on(motion, side, after, out);
        }
        self.last.emit_arc(after, direction, self.plane, out)?;
        emit_between(self.between, after, self.plane, out);
        Ok(Self { last: Element::parallel(motion, side, after), between: Vec::new(), ..self })
    }

    /// An inside corner: both parallels end where they meet.
    fn inner(
        self,
        motion: Box<Motion>,
        side: Side,
        turn: f64,
        out: &mut Vec<Item>,
    ) -> Fallible<Self> {
        let (sides, corner) = ([&self.last.side, &side], side.start_point());
        let before = above(corner, self.last.side.tangent(true), self.distance);
        let exact = inner_corner(&self.last.side, &side, corner, self.distance);
        // two nearly tangent parallels have no intersection that is robust against rounding
        let at = exact.or((turn.abs() < ALL_BUT_SMOOTH).then_some(before)).ok_or_else(|| {
            if sides.iter().all(|side| matches!(side, Side::Arc { .. })) {
                let text = "the tool is too large for the corner between two arcs";
                return Fault::new(Condition::ToolBetweenArcs, text, motion.span)
                    .in_block(motion.source);
            }
            let short = sides.into_iter().min_by(|a, b| a.reach().total_cmp(&b.reach()));
            let condition = match short {
                Some(Side::Arc { .. }) => Condition::ArcRunsBack,
                _ => Condition::LineRunsBack,
            };
            too_tight(condition, &motion)
        })?;
        self.go_on(motion, side, at, out)
    }

    /// An outside corner: lines or an arc from one parallel to the other.
    fn outer(self, motion: Box<Motion>, side: Side, out: &mut Vec<Item>) -> Fallible<Self> {
        let Self { distance, plane, .. } = self;
        let (u, w) = (self.last.side.tangent(true), side.tangent(false));
        let corner = side.start_point();
        let (before, after) = (above(corner, u, distance), above(corner, w, distance));
        let stretch = motion.compensation.and_then(|c| c.straight_corners);
        let mut points = match stretch {
            Some(factor) => {
                let radius = distance.abs();
                straight_corner(u, w, before, after, radius, factor * radius)
            }
            None => SmallVec::from_slice(&[before]),
        };
        // a line on its parallel is extended, after any other element its tangent is inserted
        let extended = matches!(self.last.side, Side::Line { .. })
            && matches!(self.last.course, Course::Parallel | Course::Corner);
        let end = if extended { points[0] } else { before };
        let template = self.last.motion.clone();
        self.last.emit(end, plane, distance, out)?;
        emit_between(self.between, end, plane, out);
        let start = if stretch.is_some() {
            if !matches!(side, Side::Line { .. }) {
                points.push(after);
            }
            let mut from = end;
            for to in points {
                let line = straight(&template, motion.block.path.start(), plane, from, to);
                out.extend(line.map(|line| at_contour(line, distance)));
                from = to;
            }
            from
        } else {
            out.extend(corner_arc(&template, &motion, plane, corner, before, after, distance));
            after
        };
        Ok(Self { last: Element::parallel(motion, side, start), between: Vec::new(), ..self })
    }

    /// The contour runs back along itself and changes its side: the tool reverses at its current position.
    pub(super) fn turn_back(
        self,
        motion: Box<Motion>,
        side: Side,
        out: &mut Vec<Item>,
        cut: &mut Option<Cut>,
    ) -> Fallible<Self> {
        let Self { distance, perpendicular, plane, tilt, .. } = self;
        let (tilt, watch) = (tilt.clone(), Watch::default());
        let start = Self { tilt: None, ..self }.finish(out, cut)?;
        let last = Element::parallel(motion, side, start);
        let between = Vec::new();
        Ok(Self { distance: -distance, perpendicular, plane, tilt, last, between, watch })
    }

    /// Completes the last element perpendicular to its end and returns that point; a bottleneck is recorded in `cut`.
    pub(super) fn finish(mut self, out: &mut Vec<Item>, cut: &mut Option<Cut>) -> Fallible<Point> {
        let mut watched = Watched::new(&mut self, out);
        let Self { distance, plane, last, between, .. } = self;
        if last.course == Course::TangentialApproach {
            let text = "G05: the approach is not followed by a contour";
            return Err(Fault::new(Condition::Compensation, text, last.motion.span)
                .hint("its arc touches the following motion")
                .in_block(last.motion.source));
        }
        let at = above(last.side.end_point(), last.side.tangent(true), distance);
        last.emit(at, plane, distance, out)?;
        watched.compare(out, cut);
        emit_between(between, at, plane, out);
        Ok(at)
    }

    /// As [`finish`](Self::finish), then perpendicular back to the contour (G237).
    pub(super) fn return_to_contour(
        self,
        out: &mut Vec<Item>,
        cut: &mut Option<Cut>,
    ) -> Fallible<()> {
        let (plane, template) = (self.plane, self.last.motion.clone());
        let end = self.last.motion.block.path.end();
        let to = [end[plane[0]], end[plane[1]]];
        let at = self.finish(out, cut)?;
        let line = straight(&template, template.block.path.end(), plane, at, to);
        out.extend(line.map(Item::Motion));
        Ok(())
    }
}

/// The last element while its path is determined: elements after `done` are checked against the contour.
pub(super) struct Watched {
    pub(super) watch: Watch,
    /// The element of the contour; `None` if only its corner is to come.
    side: Option<Side>,
    source: SourceRef,
    /// Approaches are not checked: the tool is not yet at the contour.
    checked: bool,
    plane: [usize; 2],
    /// Tool radius at its start and end.
    radii: [f64; 2],
    done: usize,
}

impl Watched {
    pub(super) fn new(active: &mut Active, out: &[Item]) -> Self {
        let last = &active.last;
        let radius = active.distance.abs();
        let before = if let Course::RadiusChange(d) = last.course { d.abs() } else { radius };
        Self {
            side: (last.course != Course::Corner).then_some(last.side),
            source: last.motion.source,
            checked: !last.course.approaches(),
            plane: active.plane,
            radii: [before, radius],
            done: out.len(),
            watch: std::mem::take(&mut active.watch),
        }
    }

    /// A bottleneck is recorded in `cut`.
    pub(super) fn compare(&mut self, out: &[Item], cut: &mut Option<Cut>) {
        if self.checked {
            let way = &out[self.done..];
            let found = self.watch.element(self.side, self.source, way, self.plane, self.radii);
            *cut = cut.or(found);
        }
    }
}
