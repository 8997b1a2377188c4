//! Change of the tool radius by a line perpendicular to the contour: `#TRC [PERPENDICULAR_RADIUS_CHANGE=1]`.
//!
//! Source: TF5200 programming manual, TRC option PERPENDICULAR_RADIUS_CHANGE (483740299).
//! Assumption: the figures do not show the position. The corner between the two elements is computed with the larger of the two
//! radii, so that the tool never comes nearer to the contour than its smaller radius, and never nearer than its new radius to
//! the following elements. A larger radius is applied perpendicular to the element before the corner, a smaller one
//! perpendicular to the element after it.

use super::active::{Active, Watched, at_contour};
use super::corner::{above, inner_corner, straight, straight_before};
use super::element::{Element, emit_between};
use super::failure::{Fallible, too_tight};
use crate::diag::Condition;
use crate::exec::contour::bottleneck::{Cut, Watch};
use crate::exec::contour::item::Item;
use crate::exec::contour::motion::Motion;
use crate::exec::geometry::planar::Side;
use crate::exec::geometry::point::{Point, cross, sub};
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
    /// Continues with an element that has a different distance on the same side of the contour.
    pub(super) fn change_radius(
        self,
        motion: Box<Motion>,
        side: Side,
        distance: f64,
        out: &mut Vec<Item>,
        cut: &mut Option<Cut>,
    ) -> Fallible<Self> {
        if distance.abs() > self.distance.abs() {
            self.grow(motion, side, distance, out, cut)
        } else {
            self.shrink(motion, side, distance, out, cut)
        }
    }

    /// A smaller radius: the corner with the old one, then a line towards the element after it.
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
        let line = straight_before(&next.last.motion, &at, plane, from, to);
        out.extend(line.map(|line| at_contour(line, distance)));
        next.distance = distance;
        next.last.start = to;
        next.watch = Watch::default();
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
        let line = straight(&template, &at, plane, from, to);
        out.extend(line.map(|line| at_contour(line, distance)));
        emit_between(between, to, plane, out);
        let active = |last: Element| {
            let watch = Watch::default();
            Self { distance, perpendicular, plane, tilt, last, between: Vec::new(), watch }
        };
        // the corner starts perpendicular to its own tangent; nothing remains of the element before it
        let stub = sub(corner, u);
        match straight(&template, &at, plane, stub, corner).filter(|_| !inside) {
            Some(line) => {
                let ends = Side::Line { from: stub, to: corner };
                active(Element {
                    motion: line,
                    side: ends,
                    start: to,
                    approach: false,
                    tangential: false,
                })
                .join(motion, side, out, cut)
            }
            None => {
                Ok(active(Element { motion, side, start: to, approach: false, tangential: false }))
            }
        }
    }
}
