//! The point of an arc that is nearest to another point.

use super::ArcPath;
use crate::axis::AxisVec;
use std::f64::consts::PI;

/// Angle in rad up to which an arc on both sides of a point lies within its [`ArcPath::side`].
const SIDE_RAD: f64 = 1.0;
/// Sine of it, rounded down.
const SIDE_SIN: f64 = 0.84;
/// Largest change of the radius per rad, in radii, with which the squared distance is convex on a side.
const GROWTH: f64 = 0.25;
/// Relative difference between the radii at both ends up to which it is rounding.
const ALIKE: f64 = 1e-12;
/// Step of Newton's method, in lengths of the arc, after which the remaining error, about its square, is rounding.
const LAST_STEP: f64 = 1e-9;

/// The directions in which the points of a plane circle lie, as seen from its centre.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fan {
    /// Unit vector to the middle of the arc, in the plane.
    middle: [f64; 2],
    /// Square of the distance of both ends from there, in radii; infinite for a full circle.
    chord2: f64,
}

impl Fan {
    /// `None` if the distance of a point also depends on something else: a height, or a radius that changes.
    pub(super) fn of(arc: &ArcPath) -> Option<Self> {
        let is_plane = arc.linear.iter().all(|l| *l == 0.0);
        let is_circle = (arc.radius_end - arc.radius_start).abs() <= ALIKE * arc.radius_start;
        let half = 0.5 * arc.shape.sweep_rad;
        let (sin, cos) = libm::sincos(arc.start_rad + half);
        // unlike a cosine, a chord also tells small angles apart
        let chord = if half.abs() < PI { 2.0 * libm::sin(0.5 * half) } else { f64::INFINITY };
        (is_plane && is_circle).then_some(Self { middle: [cos, sin], chord2: chord * chord })
    }
}

impl ArcPath {
    /// Vector to `point` from the nearest point, and the square of its length.
    pub(in crate::path) fn vector_to(&self, point: &[f64], out: &mut [f64]) -> f64 {
        if !self.vector_from_circle(point, out) {
            self.position(self.nearest(point), out);
            for (out, p) in out.iter_mut().zip(point) {
                *out = p - *out;
            }
        }
        out.iter().map(|c| c * c).sum()
    }

    /// The vector from a plane circle on which a point lies at the same angle, without computing that angle.
    fn vector_from_circle(&self, point: &[f64], out: &mut [f64]) -> bool {
        let Some(Fan { middle, chord2 }) = &self.fan else { return false };
        let [a, b] = self.shape.plane;
        let [x, y] = [point[a] - self.shape.centre_mm[0], point[b] - self.shape.centre_mm[1]];
        let away = f64::sqrt(x * x + y * y);
        let off = [x - away * middle[0], y - away * middle[1]];
        let is_inside = off[0] * off[0] + off[1] * off[1] <= chord2 * away * away;
        if away <= 0.0 || !is_inside {
            return false;
        }
        for ((out, p), start) in out.iter_mut().zip(point).zip(self.start.iter()) {
            *out = p - start;
        }
        let share = (away - self.radius()) / away;
        (out[a], out[b]) = (share * x, share * y);
        true
    }

    /// Nearest point: for a plane arc the point at the same angle; for a helix Newton's method from that angle in every
    /// turn (the distance has at most one minimum per turn within half a turn of it).
    pub(in crate::path) fn nearest(&self, point: &[f64]) -> f64 {
        let [a, b] = self.shape.plane;
        let (px, py) = (point[a] - self.shape.centre_mm[0], point[b] - self.shape.centre_mm[1]);
        let angle = libm::atan2(py, px);
        let turn = 2.0 * PI;
        let sweep = self.shape.sweep_rad;
        // angle from the start to the point in the direction of rotation
        let delta = (angle - self.start_rad) * sweep.signum();
        let first = delta - turn * libm::floor(delta / turn);
        if let Some(s) = self.on_one_side(point, first, px * px + py * py) {
            return s;
        }
        let mut best = (f64::INFINITY, 0.0);
        let mut candidate = |s: f64| {
            let (s, d) = self.polish(point, s.clamp(0.0, self.length));
            if d < best.0 {
                best = (d, s);
            }
        };
        candidate(0.0);
        candidate(self.length);
        let turns = libm::ceil(sweep.abs() / turn) as u32;
        // for a helix with many turns only those close to the height of the point can contain the nearest point
        let (from, to) = self.turn_range(point, turns);
        for k in from..=to {
            let phi = first + turn * f64::from(k);
            if phi <= sweep.abs() {
                candidate(phi / sweep.abs() * self.length);
            }
        }
        best.1
    }

    /// The nearest point if it lies on the side of the arc that faces the point, and this is a single one; otherwise
    /// `None`. `first` is the angle in rad from the start to the point, within one turn, `square` the square of its
    /// distance from the axis in mm2.
    ///
    /// On this side, in polar coordinates around the axis, half the second derivative of the squared distance by the
    /// angle `x` is `dr^2 + 2 rho dr sin x + rho r cos x` plus that of the height, which is positive: there is a single
    /// minimum. Everything else is further away than `rho sin x` at its border.
    fn on_one_side(&self, point: &[f64], first: f64, square: f64) -> Option<f64> {
        let (turn, whole) = (2.0 * PI, self.shape.sweep_rad.abs());
        let is_near = |centre: f64| centre > -SIDE_RAD && centre < whole + SIDE_RAD;
        let centre = match (is_near(first - turn), is_near(first)) {
            (true, false) => first - turn,
            (false, true) => first,
            _ => return None,
        };
        let growth = (self.radius_end - self.radius_start).abs();
        let least = self.radius_start.min(self.radius_end);
        if is_near(first + turn) || growth > GROWTH * least * whole {
            return None;
        }
        let at = |angle: f64| angle.clamp(0.0, whole) / whole * self.length;
        if self.fan.is_some() {
            return Some(at(centre));
        }
        let (low, high) = (at(centre - SIDE_RAD), at(centre + SIDE_RAD));
        let (mut s, mut before) = (at(centre), f64::INFINITY);
        for _ in 0..20 {
            let [distance2, slope, bend] = self.approach(point, s);
            if distance2 > before || bend <= 0.0 {
                return None;
            }
            let next = (s - slope / bend).clamp(low, high);
            if (next - s).abs() <= LAST_STEP * self.length {
                let inside = (next > low || low <= 0.0) && (next < high || high >= self.length);
                let alone = distance2 <= SIDE_SIN * SIDE_SIN * square;
                return Some(next).filter(|_| inside && alone);
            }
            (s, before) = (next, distance2);
        }
        None
    }

    fn turn_range(&self, point: &[f64], turns: u32) -> (u32, u32) {
        let (mut dot, mut norm) = (0.0, 0.0);
        for ((p, s), l) in point.iter().zip(self.start.iter()).zip(self.linear.iter()) {
            dot += (p - s) * l;
            norm += l * l;
        }
        if turns <= 2 || norm <= 0.0 {
            return (0, turns.min(2));
        }
        let at = (dot / norm / self.length).clamp(0.0, 1.0) * f64::from(turns);
        let mid = libm::floor(at) as u32;
        (mid.saturating_sub(1), (mid + 1).min(turns))
    }

    fn distance2(&self, point: &[f64], s: f64) -> f64 {
        let mut q = AxisVec::zeros(point.len());
        self.position(s, &mut q);
        q.iter().zip(point).map(|(q, p)| (q - p) * (q - p)).sum()
    }

    /// Newton's method on the derivative of the squared distance; keeps the old value if a step does not help. Returns
    /// the path length and the squared distance there.
    fn polish(&self, point: &[f64], s: f64) -> (f64, f64) {
        if self.fan.is_some() {
            return (s, self.distance2(point, s));
        }
        let (mut s, mut here) = (s, self.approach(point, s));
        for _ in 0..20 {
            let [square, first, second] = here;
            if second <= 0.0 {
                break;
            }
            let next = (s - first / second).clamp(0.0, self.length);
            if (next - s).abs() <= 1e-13 * self.length {
                return (next, self.distance2(point, next));
            }
            let there = self.approach(point, next);
            if there[0] > square {
                break;
            }
            (s, here) = (next, there);
        }
        (s, here[0])
    }

    /// Squared distance of a point from the arc at `s`, and half its first and half its second derivative. The sine of
    /// an angle costs more than all the rest, so position, tangent and curvature share it.
    fn approach(&self, point: &[f64], s: f64) -> [f64; 3] {
        let (radius, angle, rate) = self.polar(s);
        let growth = (self.radius_end - self.radius_start) / self.length;
        let (sin, cos) = libm::sincos(angle);
        let [a, b] = self.shape.plane;
        let mut out = [0.0; 3];
        for (i, p) in point.iter().enumerate() {
            let (position, tangent, curvature) = if i == a {
                (
                    self.shape.centre_mm[0] + radius * cos,
                    growth * cos - radius * rate * sin,
                    -radius * rate * rate * cos - 2.0 * growth * rate * sin,
                )
            } else if i == b {
                (
                    self.shape.centre_mm[1] + radius * sin,
                    growth * sin + radius * rate * cos,
                    -radius * rate * rate * sin + 2.0 * growth * rate * cos,
                )
            } else {
                (self.start[i] + s * self.linear[i], self.linear[i], 0.0)
            };
            // the ends are met exactly
            let position = if s <= 0.0 {
                self.start[i]
            } else if s >= self.length {
                self.end[i]
            } else {
                position
            };
            let aside = position - p;
            out[0] += aside * aside;
            out[1] += aside * tangent;
            out[2] += tangent * tangent + aside * curvature;
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::super::{ArcPath, ArcShape};
    use crate::axis::AxisVec;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(512))]

        /// Arcs and helices up to two turns, with growing radii, and points at any distance: of 20,000 points of the arc
        /// none is nearer, and the result is a point of the arc.
        #[test]
        fn no_point_of_an_arc_is_nearer(
            (start, sweep, drift) in (-3.2..3.2f64, 0.01..12.5f64, prop_oneof![Just(0.0), -2.0..2.0f64]),
            growth in prop_oneof![Just(0.0), Just(1e-15), -0.6..0.6f64],
            (angle, off, height) in (-3.2..3.2f64, prop_oneof![-1.0..2.0f64, -1e-3..1e-3f64], -1.0..1.0f64),
            (back, wide) in (prop::bool::ANY, prop::bool::ANY),
        ) {
            let sweep = if wide { sweep } else { 0.1 * sweep };
            let sweep = if back { -sweep } else { sweep };
            let [from, to] = [(start, 1.0, 0.0), (start + sweep, 1.0 + growth, drift)].map(|(at, radius, z)| {
                AxisVec::from_slice(&[2.0 + radius * libm::cos(at), 3.0 + radius * libm::sin(at), z])
            });
            let shape = ArcShape { plane: [0, 1], centre_mm: [2.0, 3.0], sweep_rad: sweep };
            let arc = ArcPath::new(from, to, shape, &[true; 3]).unwrap();
            let radius = 1.0 + off;
            let point = [2.0 + radius * libm::cos(angle), 3.0 + radius * libm::sin(angle), height * drift];
            let mut q = [0.0; 3];
            let mut apart = |s: f64| {
                arc.position(s, &mut q);
                q.iter().zip(&point).map(|(q, p)| (q - p) * (q - p)).sum::<f64>().sqrt()
            };
            let s = arc.nearest(&point);
            prop_assert!((0.0..=arc.length()).contains(&s));
            let found = apart(s);
            let all = (0..=20_000).map(|i| apart(arc.length() * f64::from(i) / 20_000.0));
            let least = all.fold(f64::INFINITY, f64::min);
            prop_assert!(found <= least + 1e-12, "{found} {least}");
            let mut vector = [0.0; 3];
            let square = arc.vector_to(&point, &mut vector);
            prop_assert!((square.sqrt() - found).abs() <= 1e-12);
            // its foot is a point of the arc
            let foot = [0, 1, 2].map(|i| point[i] - vector[i]);
            arc.position(arc.nearest(&foot), &mut q);
            prop_assert!(q.iter().zip(&foot).all(|(q, p)| (q - p).abs() <= 1e-9), "{q:?} {foot:?}");
        }
    }
}
