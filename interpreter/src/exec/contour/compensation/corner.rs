//! Geometry of the corners of a compensated contour.

use crate::exec::contour::item::Item;
use crate::exec::contour::motion::Motion;
use crate::exec::geometry::planar::{Curve, Side, intersections};
use crate::exec::geometry::point::{Point, cross, dot, norm, sub};
use kontur_motion::axis::AxisVec;
use kontur_motion::path::{ArcPath, ArcShape, LinePath, Path};
use smallvec::SmallVec;
use std::f64::consts::{PI, TAU};

/// Angle up to which an inserted element counts as tangential (TANGENTIAL_LIMIT of `#TRC`, 1067243147): 3 deg.
///
/// Assumption: an arc at such a corner does not slow the path below the speed that the kink in its place would permit; the
/// page says only that a smaller limit means more braking.
const TANGENTIAL_RAD: f64 = 3.0 * PI / 180.0;

/// Points of an outer corner between extended tangents: their intersection or, if that is further than `reach` from the ends of
/// the parallels, two points at this distance from them.
pub(super) fn straight_corner(
    u: Point,
    w: Point,
    before: Point,
    after: Point,
    radius: f64,
    reach: f64,
) -> SmallVec<[Point; 3]> {
    let cos = dot(u, w);
    // radius * tan(half of the angle); infinite or NaN where the contour reverses
    let d = radius * cross(u, w).abs() / (1.0 + cos);
    if d <= reach * (1.0 + 1e-12) {
        return SmallVec::from_slice(&[[before[0] + d * u[0], before[1] + d * u[1]]]);
    }
    SmallVec::from_slice(&[
        [before[0] + reach * u[0], before[1] + reach * u[1]],
        [after[0] - reach * w[0], after[1] - reach * w[1]],
    ])
}

/// A line inserted by the compensation, with the other axes at their positions in `at`.
pub(super) fn straight(
    template: &Motion,
    at: &AxisVec,
    plane: [usize; 2],
    from: Point,
    to: Point,
) -> Option<Box<Motion>> {
    let place = |p: Point| {
        let mut v = at.clone();
        (v[plane[0]], v[plane[1]]) = (p[0], p[1]);
        v
    };
    let path = LinePath::new(place(from), place(to), &template.block.dynamics.feed_axes)?;
    let mut motion = template.clone();
    motion.block.path = Path::Line(path);
    motion.block.feed = template.feed_behind();
    motion.events.clear();
    Some(Box::new(motion))
}

/// The same before a motion; the E word of that motion applies to its own end.
pub(super) fn straight_before(
    next: &Motion,
    at: &AxisVec,
    plane: [usize; 2],
    from: Point,
    to: Point,
) -> Option<Box<Motion>> {
    let mut template = next.clone();
    template.block.end_velocity_mm_s = None;
    straight(&template, at, plane, from, to)
}

/// The point at a distance to the left of a direction.
pub(super) fn above(p: Point, direction: Point, distance: f64) -> Point {
    [p[0] - distance * direction[1], p[1] + distance * direction[0]]
}

/// Arc about an outer corner.
pub(super) fn corner_arc(
    before: &Motion,
    after: &Motion,
    plane: [usize; 2],
    corner: Point,
    from: Point,
    to: Point,
    distance: f64,
) -> Option<Item> {
    let (a, b) = (sub(from, corner), sub(to, corner));
    let angle = libm::atan2(cross(a, b), dot(a, b));
    // on the left of the contour the tool moves clockwise about the corner
    let sweep_rad = match (distance > 0.0, angle > 0.0) {
        (true, true) => angle - TAU,
        (false, false) => angle + TAU,
        _ => angle,
    };
    let shape = ArcShape { plane, centre_mm: corner, sweep_rad };
    let place = |p: Point| {
        let mut v = after.block.path.start().clone();
        (v[plane[0]], v[plane[1]]) = (p[0], p[1]);
        v
    };
    let feed_axes = &after.block.dynamics.feed_axes;
    let path = ArcPath::new(place(from), place(to), shape, feed_axes)?;
    let mut arc = before.clone();
    arc.block.path = Path::Arc(path);
    arc.block.feed = before.feed_behind();
    arc.block.tangential = angle.abs() <= TANGENTIAL_RAD;
    arc.engaged = Some(distance > 0.0);
    arc.events.clear();
    Some(Item::Motion(Box::new(arc)))
}

/// Intersection of the parallels nearest to the corner, if it lies on both elements.
pub(super) fn inner_corner(a: &Side, b: &Side, corner: Point, distance: f64) -> Option<Point> {
    let (p, q): (Curve, Curve) = (a.parallel(distance), b.parallel(distance));
    intersections(&p, &q)
        .into_iter()
        .filter(|x| on(a, a.foot(*x)) && on(b, b.foot(*x)))
        .min_by(|x, y| norm(sub(*x, corner)).total_cmp(&norm(sub(*y, corner))))
}

fn on(side: &Side, foot: Point) -> bool {
    (-1e-9..=1.0 + 1e-9).contains(&side.share_of(foot))
}

pub(super) fn side_sweep(side: &Side) -> f64 {
    match side {
        Side::Line { .. } => 0.0,
        Side::Arc { sweep_rad, .. } => *sweep_rad,
    }
}

/// Swept angle of an arc with trimmed ends; trimming removes less than half a turn.
pub(super) fn trimmed(side: &Side, start: Point, end: Point) -> f64 {
    let Side::Arc { centre, start_rad, sweep_rad, .. } = side else { return 0.0 };
    let angle = |p: Point| {
        let r = sub(p, *centre);
        libm::atan2(r[1], r[0])
    };
    let small = |x: f64| x - TAU * ((x + PI) / TAU).floor();
    let at_start = small(angle(start) - start_rad);
    let at_end = small(angle(end) - (start_rad + sweep_rad));
    sweep_rad - at_start + at_end
}
