//! Chamfers and roundings between two motions (G301, G302, `#CHR`, `#CHF`, `#RND`).
//!
//! Source: TF5200 programming manual: the size of a chamfer is the distance of its ends from the corner, on an arc
//! measured as a chord (206615051); a rounding is a tangential arc of the given radius. No rounding is inserted at a tangential
//! transition (206621707), nor a chamfer where a line continues straight on. Assumption: the ends of a chamfer of a given length
//! (`#CHF`) are equally far from the corner too, so that it has the same inclination to both elements.
//!
//! The feed is that of `#FRC`, else the E word of the motion before (206811147). Assumption: without them it is that of the next
//! motion, also rapid; the English page names that motion, an older German one the motion before.

use crate::diag::Condition;
use crate::exec::contour::motion::{FeedCourse, Motion};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::planar::{Side, cut, intersections, swept};
use crate::exec::geometry::point::{Point, cross, dot, norm, sub};
use crate::exec::step::SourceRef;
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::Feed;
use kontur_motion::path::{ArcPath, ArcShape, LinePath, Path};
use std::f64::consts::PI;

/// Fraction of an element that counts as rounding.
const NEAR: f64 = 1e-9;
/// Factor between the distances tested in the search for the ends of a chamfer.
const GROWTH: f64 = 1.02;
/// Bisections of such a distance: down to rounding.
const HALVINGS: u32 = 48;

/// Kind of the inserted element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Kind {
    /// By the distance of its ends from the corner.
    Chamfer,
    /// By its length (`#CHF`).
    ChamferLength,
    Rounding,
}

/// Parameters of the insertion.
#[derive(Clone, Debug)]
pub(in crate::exec) struct Insertion {
    pub(in crate::exec) kind: Kind,
    pub(in crate::exec) size_mm: f64,
    /// `#FRC`: its feed rate.
    pub(in crate::exec) feed: Option<Feed>,
    pub(in crate::exec) span: Span,
    pub(in crate::exec) source: SourceRef,
}

/// An inserted element.
pub(in crate::exec) struct Inserted {
    pub(in crate::exec::contour) motion: Box<Motion>,
    /// Whether a part remains of the motion before it, and of the one after it.
    pub(in crate::exec::contour) leaves: [bool; 2],
}

/// The element between two motions, which are trimmed; `None` at a tangential transition.
///
/// It belongs to the contour of the motion before it: tool radius compensation that ends, begins or changes with the motion
/// after it does so after the element.
pub(in crate::exec) fn between(
    before: &mut Motion,
    after: &mut Motion,
    insertion: &Insertion,
) -> Outcome<Option<Inserted>> {
    let plane = before.plane;
    let sides = sides(before, after, insertion.span)?;
    let [a, b] = &sides;
    let (u, w) = (a.tangent(true), b.tangent(false));
    let turn = cross(u, w);
    let lines = matches!((a, b), (Side::Line { .. }, Side::Line { .. }));
    if turn.abs() < 1e-9 && dot(u, w) > 0.0 && (lines || insertion.kind == Kind::Rounding) {
        return Ok(None);
    }
    let misfit = || {
        let text = format!(
            "a chamfer or rounding of {} mm does not fit between the two motions",
            insertion.size_mm
        );
        Fault::new(Condition::Range, text, insertion.span)
    };
    let (ends, centre) = places(&sides, turn, insertion).ok_or_else(misfit)?;
    let corner = before.block.path.end().clone();
    let [p, q] = ends.map(|xy| {
        let mut v = corner.clone();
        (v[plane[0]], v[plane[1]]) = (xy[0], xy[1]);
        v
    });
    let feed_axes = after.block.dynamics.feed_axes.clone();
    let element = match centre {
        None => LinePath::new(p.clone(), q.clone(), &feed_axes).map(Path::Line),
        Some(centre) => rounding(&p, &q, (centre, plane, turn > 0.0), &feed_axes),
    };
    let feed = match before.block.end_velocity_mm_s {
        Some(_) => before.feed_behind(),
        None => after.feed_beside(),
    };
    let element = element.ok_or_else(misfit)?;
    let others = [a.start_point(), b.end_point()];
    let leaves = [0, 1].map(|i| norm(sub(ends[i], others[i])) > NEAR * insertion.size_mm);
    if leaves[0] {
        let rest = cut(&before.block.path, None, Some(&p), &feed_axes);
        before.block.path = rest.ok_or_else(misfit)?;
    }
    let mut inserted = after.clone();
    if leaves[1] {
        let rest = cut(&after.block.path, Some(&q), None, &feed_axes);
        after.block.path = rest.ok_or_else(misfit)?;
    }
    inserted.block.path = element;
    inserted.compensation.clone_from(&before.compensation);
    inserted.course = course_of_element(before, after, insertion)?;
    // E belongs to the end of its own block
    inserted.block.end_velocity_mm_s = None;
    inserted.events = std::mem::take(&mut after.events);
    inserted.block.feed = insertion.feed.unwrap_or(feed);
    Ok(Some(Inserted { motion: Box::new(inserted), leaves }))
}

/// An arc about a centre in the plane, to the left or to the right.
fn rounding(
    p: &AxisVec,
    q: &AxisVec,
    (centre_mm, plane, left): (Point, [usize; 2], bool),
    feed_axes: &[bool],
) -> Option<Path> {
    let sweep_rad = swept(centre_mm, p, q, plane, left);
    let shape = ArcShape { plane, centre_mm, sweep_rad };
    ArcPath::new(p.clone(), q.clone(), shape, feed_axes).map(Path::Arc)
}

/// The two motions in their plane.
fn sides(before: &Motion, after: &Motion, span: Span) -> Outcome<[Side; 2]> {
    if before.tilt != after.tilt {
        let what = "a chamfer or rounding between two coordinate systems";
        return Err(Fault::unsupported(what, span));
    }
    let plane = before.plane;
    let flat = |m: &Motion| stays_in(&m.block.path, plane).then(|| Side::of(&m.block.path, plane));
    let (Some(Some(a)), Some(Some(b))) = (flat(before), flat(after)) else {
        let what = "a chamfer or rounding between motions outside the active plane";
        return Err(Fault::unsupported(what, span));
    };
    Ok([a, b])
}

/// Ends of the element, and the centre of a rounding; `None` where it does not fit. `turn` is the sine of the corner.
fn places(
    [a, b]: &[Side; 2],
    turn: f64,
    insertion: &Insertion,
) -> Option<([Point; 2], Option<Point>)> {
    let size_mm = insertion.size_mm;
    Some(match insertion.kind {
        Kind::Chamfer => {
            let (p, q) = ends_at(a, b, size_mm)?;
            ([p, q], None)
        }
        Kind::ChamferLength => {
            let (p, q) = ends_apart(a, b, size_mm)?;
            ([p, q], None)
        }
        Kind::Rounding => {
            let (p, q, centre) = tangent_arc(a, b, turn, size_mm)?;
            ([p, q], Some(centre))
        }
    })
}

/// The change of the feed rate along the element: under G95 and G96 it follows the speed of the spindle, unless the element has
/// a feed rate of its own.
fn course_of_element(
    before: &Motion,
    after: &Motion,
    insertion: &Insertion,
) -> Outcome<Option<FeedCourse>> {
    let follows = |course: &FeedCourse| matches!(course, FeedCourse::PerRevolution(_));
    let own = insertion.feed.is_some() || before.block.end_velocity_mm_s.is_some();
    let Some(course) = after.course.filter(|course| follows(course) && !own) else {
        return Ok(None);
    };
    if after.block.contour.is_some() || after.block.spline.is_some() {
        let what = "a chamfer or rounding with contouring or splines, G95 and G96";
        return Err(Fault::unsupported(what, insertion.span));
    }
    Ok(Some(course))
}

/// Ends of a chamfer at a distance from the corner, on an arc as a chord.
fn ends_at(a: &Side, b: &Side, distance: f64) -> Option<(Point, Point)> {
    Some((end_at(a, distance, true)?, end_at(b, distance, false)?))
}

/// The point at a distance (chord) from the end or start of an element; its other end if nothing of it would remain.
fn end_at(side: &Side, distance: f64, from_end: bool) -> Option<Point> {
    let (start, end) = (side.start_point(), side.end_point());
    let whole = norm(sub(end, start));
    let is_whole = match side {
        Side::Line { .. } => true,
        Side::Arc { sweep_rad, .. } => sweep_rad.abs() <= PI,
    };
    if is_whole && (distance - whole).abs() <= NEAR * whole {
        return Some(if from_end { start } else { end });
    }
    side.at_distance(distance, from_end)
}

/// Ends of a chamfer of a given length, equally far from the corner: the nearest ones.
fn ends_apart(a: &Side, b: &Side, length: f64) -> Option<(Point, Point)> {
    let apart = |(p, q): (Point, Point)| norm(sub(p, q));
    // the two distances and the chamfer form a triangle
    let mut low = 0.5 * length;
    if apart(ends_at(a, b, low)?) >= length {
        return ends_at(a, b, low);
    }
    let mut high = loop {
        let next = low * GROWTH;
        if apart(ends_at(a, b, next)?) >= length {
            break next;
        }
        low = next;
    };
    for _ in 0..HALVINGS {
        let mid = 0.5 * (low + high);
        if apart(ends_at(a, b, mid)?) >= length { high = mid } else { low = mid }
    }
    ends_at(a, b, high)
}

/// Contact points and centre of the arc of radius `r` that touches both sides.
fn tangent_arc(a: &Side, b: &Side, turn: f64, r: f64) -> Option<([f64; 2], [f64; 2], [f64; 2])> {
    let d = if turn > 0.0 { r } else { -r };
    let corner = match a {
        Side::Line { to, .. } => *to,
        Side::Arc { centre, radius, start_rad, sweep_rad } => {
            let at = start_rad + sweep_rad;
            [centre[0] + radius * libm::cos(at), centre[1] + radius * libm::sin(at)]
        }
    };
    let on = |share: f64| (-NEAR..=1.0 + NEAR).contains(&share);
    intersections(&a.parallel(d), &b.parallel(d))
        .into_iter()
        .map(|c| (a.foot(c), b.foot(c), c))
        .filter(|(p, q, _)| on(a.share_of(*p)) && on(b.share_of(*q)))
        .min_by(|x, y| norm(sub(x.2, corner)).total_cmp(&norm(sub(y.2, corner))))
}

/// Whether no axis outside the plane moves, except for rounding in a coordinate system rotated in space.
fn stays_in(path: &Path, plane: [usize; 2]) -> bool {
    const ROUNDING_MM: f64 = 1e-9;
    let (start, end) = (path.start(), path.end());
    (0..start.len()).all(|i| plane.contains(&i) || (end[i] - start[i]).abs() < ROUNDING_MM)
}
