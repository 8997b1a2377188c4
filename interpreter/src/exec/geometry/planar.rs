//! Lines and arcs in a plane of two axes: tangents, parallels, intersections, trimming.

use super::point::{Point, cross, dot, norm, sub};
use kontur_motion::axis::AxisVec;
use kontur_motion::path::{ArcPath, ArcShape, LinePath, Path};

/// A motion within a plane.
#[derive(Clone, Copy, Debug)]
pub(in crate::exec) enum Side {
    Line { from: Point, to: Point },
    Arc { centre: Point, radius: f64, start_rad: f64, sweep_rad: f64 },
}

pub(in crate::exec) const TURN: f64 = std::f64::consts::TAU;

fn polar(centre: Point, radius: f64, rad: f64) -> Point {
    [centre[0] + radius * libm::cos(rad), centre[1] + radius * libm::sin(rad)]
}

impl Side {
    /// The part of a path within a plane; `None` for an arc in another plane.
    pub(in crate::exec) fn of(path: &Path, plane: [usize; 2]) -> Option<Self> {
        let (start, end) = (path.start(), path.end());
        let pick = |p: &AxisVec| [p[plane[0]], p[plane[1]]];
        match path {
            Path::Line(_) => Some(Self::Line { from: pick(start), to: pick(end) }),
            Path::Arc(arc) if arc.shape().plane == plane => Some(Self::Arc {
                centre: arc.shape().centre_mm,
                radius: arc.radius(),
                start_rad: arc.start_angle(),
                sweep_rad: arc.shape().sweep_rad,
            }),
            // programs contain lines and arcs only
            Path::Arc(_) | Path::Tilted(_) | Path::Curve(_) => None,
        }
    }

    /// First point.
    pub(in crate::exec) fn start_point(&self) -> Point {
        match self {
            Self::Line { from, .. } => *from,
            Self::Arc { centre, radius, start_rad, .. } => polar(*centre, *radius, *start_rad),
        }
    }

    /// Last point.
    pub(in crate::exec) fn end_point(&self) -> Point {
        match self {
            Self::Line { to, .. } => *to,
            Self::Arc { centre, radius, start_rad, sweep_rad } => {
                polar(*centre, *radius, start_rad + sweep_rad)
            }
        }
    }

    /// Direction at its start (`false`) or end.
    pub(in crate::exec) fn tangent(&self, at_end: bool) -> Point {
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

    /// Share 0..1 of the length at which a point of the element lies; values outside this range are not on the element.
    pub(in crate::exec) fn share_of(&self, p: Point) -> f64 {
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

    /// The point at a distance (chord) from the end (`from_end`) or start.
    pub(in crate::exec) fn at_distance(&self, distance: f64, from_end: bool) -> Option<Point> {
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

    /// The curve of the element, offset by `d` to its left, as line or circle.
    pub(in crate::exec) fn parallel(&self, d: f64) -> Curve {
        match self {
            Self::Line { from, .. } => {
                let t = self.tangent(false);
                let left = [-t[1], t[0]];
                Curve::Line { point: [from[0] + d * left[0], from[1] + d * left[1]], along: t }
            }
            Self::Arc { centre, radius, sweep_rad, .. } => {
                // the left side of a counter-clockwise arc is towards its centre
                let r = if *sweep_rad > 0.0 { radius - d } else { radius + d };
                Curve::Circle { centre: *centre, radius: r }
            }
        }
    }

    /// Foot of the perpendicular from a point to the curve of the element.
    pub(in crate::exec) fn foot(&self, p: Point) -> Point {
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
pub(in crate::exec) enum Curve {
    Line { point: Point, along: Point },
    Circle { centre: Point, radius: f64 },
}

/// Common points of two curves.
pub(in crate::exec) fn intersections(a: &Curve, b: &Curve) -> Vec<Point> {
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

/// Swept angle from one point to another about a centre, in the given sense, in (0, 2 pi].
pub(in crate::exec) fn swept(
    c: Point,
    p: &AxisVec,
    q: &AxisVec,
    plane: [usize; 2],
    ccw: bool,
) -> f64 {
    let from = sub([p[plane[0]], p[plane[1]]], c);
    let to = sub([q[plane[0]], q[plane[1]]], c);
    let angle = libm::atan2(cross(from, to), dot(from, to));
    match (ccw, angle > 0.0) {
        (true, false) => angle + TURN,
        (false, true) => angle - TURN,
        _ => angle,
    }
}

/// A path with its start or end replaced.
pub(in crate::exec) fn cut(
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
            let sweep_rad = swept(shape.centre_mm, &from, &to, shape.plane, shape.sweep_rad > 0.0);
            ArcPath::new(from, to, ArcShape { sweep_rad, ..shape }, feed_axes).map(Path::Arc)
        }
        Path::Tilted(_) | Path::Curve(_) => None,
    }
}
