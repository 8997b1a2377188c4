//! Chamfers and roundings between two motions (G301, G302, `#CHR`, `#CHF`, `#RND`).
//!
//! Source: TF5200 programming manual: the size of a chamfer is the distance of its ends from the corner, on an arc
//! measured as a chord; a rounding is a tangential arc of the given radius. Nothing is inserted at a tangential
//! transition.

use super::contour::Motion;
use super::fault::{Fault, Outcome};
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::Feed;
use kontur_motion::path::{ArcPath, ArcShape, LinePath, Path};

/// Which element is inserted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// By the distance of its ends from the corner.
    Chamfer,
    /// By its own length (`#CHF`).
    ChamferLength,
    Rounding,
}

/// What is to be inserted.
#[derive(Clone, Debug)]
pub(super) struct Insertion {
    pub(super) kind: Kind,
    pub(super) size_mm: f64,
    /// `#FRC`: path velocity in mm/s within it.
    pub(super) feed_mm_s: Option<f64>,
    pub(super) span: Span,
}

/// A side of the corner in the plane.
#[derive(Clone, Copy, Debug)]
enum Side {
    Line { from: [f64; 2], to: [f64; 2] },
    Arc { centre: [f64; 2], radius: f64, start_rad: f64, sweep_rad: f64 },
}

const TURN: f64 = std::f64::consts::TAU;

fn sub(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn norm(a: [f64; 2]) -> f64 {
    libm::hypot(a[0], a[1])
}

impl Side {
    /// The motion within its plane; `None` if it moves other axes too or lies in another plane.
    fn of(motion: &Motion, plane: [usize; 2]) -> Option<Self> {
        let path = &motion.block.path;
        let (start, end) = (path.start(), path.end());
        let still = |i: usize| start[i].to_bits() == end[i].to_bits();
        if (0..start.len()).any(|i| !plane.contains(&i) && !still(i)) {
            return None;
        }
        let pick = |p: &AxisVec| [p[plane[0]], p[plane[1]]];
        match path {
            Path::Line(_) => Some(Self::Line { from: pick(start), to: pick(end) }),
            Path::Arc(arc) if arc.shape().plane == plane => Some(Self::Arc {
                centre: arc.shape().centre_mm,
                radius: arc.radius(),
                start_rad: arc.start_angle(),
                sweep_rad: arc.shape().sweep_rad,
            }),
            Path::Arc(_) | Path::Curve(_) => None,
        }
    }

    /// Direction at its beginning (`false`) or end.
    fn tangent(&self, at_end: bool) -> [f64; 2] {
        match self {
            Self::Line { from, to } => {
                let d = sub(*to, *from);
                let l = norm(d);
                [d[0] / l, d[1] / l]
            }
            Self::Arc { start_rad, sweep_rad, .. } => {
                let angle = if at_end { start_rad + sweep_rad } else { *start_rad };
                let sign = sweep_rad.signum();
                [-sign * libm::sin(angle), sign * libm::cos(angle)]
            }
        }
    }

    /// Share 0..1 of the way at which a point of the element lies; outside, it is not on it.
    fn share_of(&self, p: [f64; 2]) -> f64 {
        match self {
            Self::Line { from, to } => {
                let d = sub(*to, *from);
                dot(sub(p, *from), d) / dot(d, d)
            }
            Self::Arc { centre, start_rad, sweep_rad, .. } => {
                let r = sub(p, *centre);
                let delta = (libm::atan2(r[1], r[0]) - start_rad) * sweep_rad.signum();
                let turned = delta - TURN * (delta / TURN).floor();
                turned / sweep_rad.abs()
            }
        }
    }

    /// The point at a distance (chord) from the end (`from_end`) or beginning.
    fn at_distance(&self, distance: f64, from_end: bool) -> Option<[f64; 2]> {
        match self {
            Self::Line { from, to } => {
                let d = sub(*to, *from);
                let l = norm(d);
                let k = if from_end { l - distance } else { distance };
                (k > 0.0 && k < l).then(|| [from[0] + d[0] * k / l, from[1] + d[1] * k / l])
            }
            Self::Arc { centre, radius, start_rad, sweep_rad } => {
                let half = distance / (2.0 * radius);
                if half > 1.0 {
                    return None;
                }
                let angle = 2.0 * libm::asin(half);
                let away = if from_end { sweep_rad.abs() - angle } else { angle };
                if !(away > 0.0 && away < sweep_rad.abs()) {
                    return None;
                }
                let at = start_rad + sweep_rad.signum() * away;
                Some([centre[0] + radius * libm::cos(at), centre[1] + radius * libm::sin(at)])
            }
        }
    }

    /// The element's curve moved by `d` to its left, as line or circle.
    fn parallel(&self, d: f64) -> Curve {
        match self {
            Self::Line { from, .. } => {
                let t = self.tangent(false);
                let left = [-t[1], t[0]];
                Curve::Line { point: [from[0] + d * left[0], from[1] + d * left[1]], along: t }
            }
            Self::Arc { centre, radius, sweep_rad, .. } => {
                // left of a counter-clockwise arc is towards its centre
                let r = if *sweep_rad > 0.0 { radius - d } else { radius + d };
                Curve::Circle { centre: *centre, radius: r }
            }
        }
    }

    /// Foot of a point on the element's curve.
    fn foot(&self, p: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Line { from, .. } => {
                let t = self.tangent(false);
                let k = dot(sub(p, *from), t);
                [from[0] + k * t[0], from[1] + k * t[1]]
            }
            Self::Arc { centre, radius, .. } => {
                let r = sub(p, *centre);
                let l = norm(r);
                [centre[0] + r[0] / l * radius, centre[1] + r[1] / l * radius]
            }
        }
    }
}

/// An unbounded line or circle.
#[derive(Clone, Copy, Debug)]
pub(super) enum Curve {
    Line { point: [f64; 2], along: [f64; 2] },
    Circle { centre: [f64; 2], radius: f64 },
}

/// Common points of two curves.
pub(super) fn intersections(a: &Curve, b: &Curve) -> Vec<[f64; 2]> {
    match (*a, *b) {
        (Curve::Line { point: p, along: u }, Curve::Line { point: q, along: w }) => {
            let c = cross(u, w);
            if c.abs() < 1e-12 {
                return Vec::new();
            }
            let k = cross(sub(q, p), w) / c;
            vec![[p[0] + k * u[0], p[1] + k * u[1]]]
        }
        (Curve::Line { point, along }, Curve::Circle { centre, radius })
        | (Curve::Circle { centre, radius }, Curve::Line { point, along }) => {
            let k = dot(sub(centre, point), along);
            let foot = [point[0] + k * along[0], point[1] + k * along[1]];
            let d = norm(sub(centre, foot));
            let rest = (radius.abs() - d) * (radius.abs() + d);
            if rest < -1e-12 {
                return Vec::new();
            }
            let h = rest.max(0.0).sqrt();
            [-h, h].map(|h| [foot[0] + h * along[0], foot[1] + h * along[1]]).to_vec()
        }
        (Curve::Circle { centre: p, radius: r }, Curve::Circle { centre: q, radius: s }) => {
            let d = sub(q, p);
            let l = norm(d);
            if l < 1e-12 {
                return Vec::new();
            }
            let k = (l * l + r * r - s * s) / (2.0 * l);
            let rest = (r.abs() - k) * (r.abs() + k);
            if rest < -1e-12 {
                return Vec::new();
            }
            let h = rest.max(0.0).sqrt();
            let (u, w) = ([d[0] / l, d[1] / l], [-d[1] / l, d[0] / l]);
            [-h, h].map(|h| [p[0] + k * u[0] + h * w[0], p[1] + k * u[1] + h * w[1]]).to_vec()
        }
    }
}

/// The element between two motions, which are cut; `None` at a tangential transition.
pub(super) fn between(
    before: &mut Motion,
    after: &mut Motion,
    insertion: &Insertion,
) -> Outcome<Option<Box<Motion>>> {
    let span = insertion.span;
    let plane = before.plane;
    let (Some(a), Some(b)) = (Side::of(before, plane), Side::of(after, plane)) else {
        let what = "a chamfer or rounding between motions outside the active plane";
        return Err(Fault::unsupported(what, span));
    };
    let (u, w) = (a.tangent(true), b.tangent(false));
    let turn = cross(u, w);
    if turn.abs() < 1e-9 && dot(u, w) > 0.0 {
        return Ok(None);
    }
    let reversal = || {
        let text = format!(
            "a chamfer or rounding of {} mm does not fit between the two motions",
            insertion.size_mm
        );
        Fault::kontur(super::fault::own::RANGE, text, span)
    };
    let (p, q, centre) = match insertion.kind {
        Kind::Chamfer | Kind::ChamferLength => {
            let d = match insertion.kind {
                // distance from the corner of an isosceles triangle with this base
                Kind::ChamferLength => {
                    let half_angle = 0.5 * libm::acos((-dot(u, w)).clamp(-1.0, 1.0));
                    insertion.size_mm / (2.0 * libm::sin(half_angle))
                }
                _ => insertion.size_mm,
            };
            let p = a.at_distance(d, true).ok_or_else(reversal)?;
            let q = b.at_distance(d, false).ok_or_else(reversal)?;
            (p, q, None)
        }
        Kind::Rounding => {
            let (p, q, c) = tangent_arc(&a, &b, turn, insertion.size_mm).ok_or_else(reversal)?;
            (p, q, Some(c))
        }
    };
    let corner = before.block.path.end().clone();
    let point = |xy: [f64; 2]| {
        let mut v = corner.clone();
        (v[plane[0]], v[plane[1]]) = (xy[0], xy[1]);
        v
    };
    let feed_axes = after.block.dynamics.feed_axes.clone();
    let (p, q) = (point(p), point(q));
    let element = match centre {
        None => LinePath::new(p.clone(), q.clone(), &feed_axes).map(Path::Line),
        Some(centre_mm) => {
            let sweep_rad = swept(centre_mm, &p, &q, plane, turn > 0.0);
            let shape = ArcShape { plane, centre_mm, sweep_rad };
            ArcPath::new(p.clone(), q.clone(), shape, &feed_axes).map(Path::Arc)
        }
    };
    let cut_before = cut(&before.block.path, None, Some(&p), &feed_axes);
    let cut_after = cut(&after.block.path, Some(&q), None, &feed_axes);
    let (Some(element), Some(cut_before), Some(cut_after)) = (element, cut_before, cut_after)
    else {
        return Err(reversal());
    };
    before.block.path = cut_before;
    after.block.path = cut_after;
    let mut inserted = after.clone();
    inserted.block.path = element;
    inserted.events = std::mem::take(&mut after.events);
    if let (Some(v), Feed::PathVelocity(_)) = (insertion.feed_mm_s, inserted.block.feed) {
        inserted.block.feed = Feed::PathVelocity(v);
    }
    Ok(Some(Box::new(inserted)))
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
    let on = |share: f64| share > 0.0 && share < 1.0;
    intersections(&a.parallel(d), &b.parallel(d))
        .into_iter()
        .map(|c| (a.foot(c), b.foot(c), c))
        .filter(|(p, q, _)| on(a.share_of(*p)) && on(b.share_of(*q)))
        .min_by(|x, y| norm(sub(x.2, corner)).total_cmp(&norm(sub(y.2, corner))))
}

fn swept(c: [f64; 2], p: &AxisVec, q: &AxisVec, plane: [usize; 2], ccw: bool) -> f64 {
    let from = sub([p[plane[0]], p[plane[1]]], c);
    let to = sub([q[plane[0]], q[plane[1]]], c);
    let angle = libm::atan2(cross(from, to), dot(from, to));
    match (ccw, angle > 0.0) {
        (true, false) => angle + TURN,
        (false, true) => angle - TURN,
        _ => angle,
    }
}

/// A path with another start or end on it.
pub(super) fn cut(
    path: &Path,
    start: Option<&AxisVec>,
    end: Option<&AxisVec>,
    feed_axes: &[bool],
) -> Option<Path> {
    let from = start.unwrap_or(path.start()).clone();
    let to = end.unwrap_or(path.end()).clone();
    match path {
        Path::Line(_) => LinePath::new(from, to, feed_axes).map(Path::Line),
        Path::Arc(arc) => {
            let shape = *arc.shape();
            let sweep_rad =
                swept(shape.centre_mm, &from, &to, shape.plane, shape.sweep_rad > 0.0);
            ArcPath::new(from, to, ArcShape { sweep_rad, ..shape }, feed_axes).map(Path::Arc)
        }
        // programs hold lines and arcs only
        Path::Curve(_) => None,
    }
}
