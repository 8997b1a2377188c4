//! Change of the tool radius: along the next line, or by a line perpendicular to the contour
//! (`#TRC [PERPENDICULAR_RADIUS_CHANGE=1]`).
//!
//! Source: TF5200 programming manual, reaction to change in tool radius (207830795), TRC option PERPENDICULAR_RADIUS_CHANGE
//! (483740299).
//! Assumption: the pages show the positions in figures only. Along a line the distance changes linearly; the corner before it
//! is that of the old radius and the corner after it that of the new one, so that the neighbouring elements keep their
//! distances and the tool is never nearer to the contour than its smaller radius.
//! Assumption: with the option the corner between the two elements is computed with the larger of the two
//! radii, so that the tool never comes nearer to the contour than its smaller radius, and never nearer than its new radius to
//! the following elements. A larger radius is applied perpendicular to the element before the corner, a smaller one
//! perpendicular to the element after it; after an approach, which ends perpendicular to the next element, either is applied
//! there.

use super::active::{Active, Watched, at_contour};
use super::corner::{above, inner_corner, straight, straight_before};
use super::element::{Course, Element, emit_between};
use super::failure::{Fallible, too_tight};
use crate::diag::Condition;
use crate::exec::contour::bottleneck::Cut;
use crate::exec::contour::item::Item;
use crate::exec::contour::motion::Motion;
use crate::exec::geometry::planar::Side;
use crate::exec::geometry::point::{Point, cross, dot, sub};
use kontur_motion::axis::AxisVec;

/// Direction of an element where a point is on its normal.
fn tangent_at(side: &Side, p: Point) -> Point {
    match side {
        Side::Line { .. } => side.tangent(false),
        Side::Arc { centre, sweep_rad, .. } => {
            let r = sub(p, *centre);
            let l = libm::hypot(r[0], r[1]);
            let sign = sweep_rad.signum();
            [-sign * r[1] / l, sign * r[0] / l]
        }
    }
}

impl Active {
    /// Continues with a line along which the distance changes, on the same side of the contour.
    pub(super) fn change_along(
        mut self,
        motion: Box<Motion>,
        side: Side,
        distance: f64,
        out: &mut Vec<Item>,
        cut: &mut Option<Cut>,
    ) -> Fallible<Self> {
        let (before, plane) = (self.distance, self.plane);
        let at = motion.block.path.start().clone();
        let mut watched = Watched::new(&mut self, out);
        let mut next = self.corner(motion, side, out)?;
        let along = side.tangent(false);
        let foot = above(side.start_point(), along, before);
        // the lines of G25 reach beyond the start of the next one: the distance changes from there on
        if dot(sub(foot, next.last.start), along) > 0.0 {
            let from = std::mem::replace(&mut next.last.start, foot);
            let line = straight_before(&next.last.motion, &at, plane, from, foot);
            out.extend(line.map(|line| at_contour(line, before)));
        }
        watched.compare(out, cut);
        next.watch = watched.watch;
        next.last.course = Course::RadiusChange(before);
        next.distance = distance;
        Ok(next)
    }

    /// Continues with an element that has a different distance on the same side of the contour, reached by a perpendicular line.
    pub(super) fn change_across(
        self,
        motion: Box<Motion>,
        side: Side,
        distance: f64,
        out: &mut Vec<Item>,
        cut: &mut Option<Cut>,
    ) -> Fallible<Self> {
        if distance.abs() > self.distance.abs() && !self.last.course.approaches() {
            self.grow(motion, side, distance, out, cut)
        } else {
            self.shrink(motion, side, distance, out, cut)
        }
    }

    /// The corner with the old radius, then a line perpendicular to the element after it.
    fn shrink(
        self,
        motion: Box<Motion>,
        side: Side,
        distance: f64,
        out: &mut Vec<Item>,
        cut: &mut Option<Cut>,
    ) -> Fallible<Self> {
        let (before, plane) = (self.distance, self.plane);
        let at = motion.block.path.start().clone();
        let mut next = self.join(motion, side, out, cut)?;
        let from = next.last.start;
        let to = above(from, tangent_at(&side, from), distance - before);
        if let Some(line) = straight_before(&next.last.motion, &at, plane, from, to) {
            let found = next.watch.motion(&line, plane, [before, distance].map(f64::abs));
            *cut = cut.or(found);
            out.push(at_contour(line, distance));
        }
        next.distance = distance;
        next.last.start = to;
        Ok(next)
    }

    /// A larger radius: a line away from the element before the corner, then the corner with the new one.
    fn grow(
        mut self,
        motion: Box<Motion>,
        side: Side,
        distance: f64,
        out: &mut Vec<Item>,
        cut: &mut Option<Cut>,
    ) -> Fallible<Self> {
        let (before, plane) = (self.distance, self.plane);
        let corner = side.start_point();
        let (u, w) = (self.last.side.tangent(true), side.tangent(false));
        let turn = cross(u, w);
        let inside = turn.abs() >= 1e-9 && turn * distance > 0.0;
        let to = if inside {
            inner_corner(&self.last.side, &side, corner, distance)
                .ok_or_else(|| too_tight(Condition::Compensation, &motion))?
        } else {
            above(corner, u, distance)
        };
        let tangent = if inside { tangent_at(&self.last.side, to) } else { u };
        let from = above(to, tangent, before - distance);
        let at: AxisVec = motion.block.path.start().clone();
        let template = self.last.motion.clone();
        let mut watched = Watched::new(&mut self, out);
        let Self { perpendicular, tilt, last, between, .. } = self;
        last.emit(from, plane, before, out)?;
        watched.compare(out, cut);
        let mut watch = watched.watch;
        if let Some(line) = straight(&template, &at, plane, from, to) {
            *cut = cut.or(watch.motion(&line, plane, [before, distance].map(f64::abs)));
            out.push(at_contour(line, distance));
        }
        emit_between(between, to, plane, out);
        let active =
            |last| Self { distance, perpendicular, plane, tilt, last, between: Vec::new(), watch };
        // the corner starts perpendicular to its own tangent; nothing remains of the element before it
        let stub = sub(corner, u);
        match straight(&template, &at, plane, stub, corner).filter(|_| !inside) {
            Some(line) => {
                let ends = Side::Line { from: stub, to: corner };
                let last = Element { motion: line, side: ends, start: to, course: Course::Corner };
                active(last).join(motion, side, out, cut)
            }
            None => Ok(active(Element::parallel(motion, side, to))),
        }
    }
}
