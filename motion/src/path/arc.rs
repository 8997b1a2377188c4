//! Arc in a plane of two axes, the others linear in the angle (helix).

mod nearest;

use super::line::feed_length;
use crate::axis::AxisVec;
use nearest::Fan;

/// The parameters of an arc in addition to its end points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcShape {
    /// Channel indices of the two plane axes, first and second (G17: X Y, G18: Z X, G19: Y Z).
    pub plane: [usize; 2],
    /// Centre in mm, in the plane axes.
    pub centre_mm: [f64; 2],
    /// Swept angle in rad, positive counter-clockwise in (first, second); may exceed one turn.
    pub sweep_rad: f64,
}

/// An arc or helix, with `s` proportional to the angle.
///
/// A difference between the radii at start and end (rounding of the program, or G164) is distributed linearly over the
/// angle, so that both ends are met exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct ArcPath {
    start: AxisVec,
    end: AxisVec,
    shape: ArcShape,
    /// Angle of the start point.
    start_rad: f64,
    /// Distance of the start point from the centre.
    radius_start: f64,
    /// Distance of the end point from the centre.
    radius_end: f64,
    /// Slope of the axes outside the plane, per s; zero in the plane.
    linear: AxisVec,
    length: f64,
    /// The directions of its points, if it is a plane circle.
    fan: Option<Fan>,
}

impl ArcPath {
    /// An arc; `None` if the radius or the sweep is zero or not finite.
    pub fn new(start: AxisVec, end: AxisVec, shape: ArcShape, feed_axes: &[bool]) -> Option<Self> {
        let [a, b] = shape.plane;
        let from = |p: &AxisVec| (p[a] - shape.centre_mm[0], p[b] - shape.centre_mm[1]);
        let (sx, sy) = from(&start);
        let (ex, ey) = from(&end);
        let (radius_start, radius_end) = (libm::hypot(sx, sy), libm::hypot(ex, ey));
        let mut flat_end = end.clone();
        (flat_end[a], flat_end[b]) = (start[a], start[b]);
        let arc = 0.5 * (radius_start + radius_end) * shape.sweep_rad.abs();
        let straight = if start[..] == flat_end[..] {
            0.0
        } else {
            // slaved axes do not count; the plane is always part of the feed group
            let only_feed: Vec<bool> = (0..start.len())
                .map(|i| i != a && i != b && feed_axes.get(i).copied().unwrap_or(true))
                .collect();
            if only_feed.iter().any(|&f| f) {
                let masked: AxisVec = (0..start.len())
                    .map(|i| if only_feed[i] { flat_end[i] } else { start[i] })
                    .collect();
                feed_length(&start, &masked, &only_feed)
            } else {
                0.0
            }
        };
        let length = libm::hypot(arc, straight);
        if !(length.is_finite() && radius_start > 0.0 && radius_end > 0.0 && arc > 0.0) {
            return None;
        }
        let linear = start.iter().zip(flat_end.iter()).map(|(s, e)| (e - s) / length).collect();
        let start_rad = libm::atan2(sy, sx);
        let mut out = Self {
            start,
            end,
            shape,
            start_rad,
            radius_start,
            radius_end,
            linear,
            length,
            fan: None,
        };
        out.fan = Fan::of(&out);
        Some(out)
    }

    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    pub(crate) fn start(&self) -> &AxisVec {
        &self.start
    }

    pub(super) fn end(&self) -> &AxisVec {
        &self.end
    }

    /// Plane, centre and sweep.
    pub fn shape(&self) -> &ArcShape {
        &self.shape
    }

    /// Mean radius in mm.
    pub fn radius(&self) -> f64 {
        0.5 * (self.radius_start + self.radius_end)
    }

    /// Angle in rad at the start.
    pub fn start_angle(&self) -> f64 {
        self.start_rad
    }

    /// `dq/ds` of the axes outside the plane (constant); zero in the plane.
    pub(crate) fn tangent_outside_plane(&self, out: &mut [f64]) {
        out.copy_from_slice(&self.linear);
    }

    /// Radius, angle and d(angle)/ds at `s`.
    fn polar(&self, s: f64) -> (f64, f64, f64) {
        let x = s / self.length;
        let radius = self.radius_start + (self.radius_end - self.radius_start) * x;
        (radius, self.start_rad + self.shape.sweep_rad * x, self.shape.sweep_rad / self.length)
    }

    pub(super) fn position(&self, s: f64, out: &mut [f64]) {
        if s <= 0.0 {
            out.copy_from_slice(&self.start);
            return;
        }
        if s >= self.length {
            out.copy_from_slice(&self.end);
            return;
        }
        for (i, o) in out.iter_mut().enumerate() {
            *o = self.start[i] + s * self.linear[i];
        }
        let (radius, angle, _) = self.polar(s);
        let (sin, cos) = libm::sincos(angle);
        let [a, b] = self.shape.plane;
        out[a] = self.shape.centre_mm[0] + radius * cos;
        out[b] = self.shape.centre_mm[1] + radius * sin;
    }

    pub(super) fn tangent(&self, s: f64, out: &mut [f64]) {
        out.copy_from_slice(&self.linear);
        let (radius, angle, rate) = self.polar(s.clamp(0.0, self.length));
        let growth = (self.radius_end - self.radius_start) / self.length;
        let (sin, cos) = libm::sincos(angle);
        let [a, b] = self.shape.plane;
        out[a] = growth * cos - radius * rate * sin;
        out[b] = growth * sin + radius * rate * cos;
    }

    pub(super) fn curvature(&self, s: f64, out: &mut [f64]) {
        out.fill(0.0);
        let (radius, angle, rate) = self.polar(s.clamp(0.0, self.length));
        let growth = (self.radius_end - self.radius_start) / self.length;
        let (sin, cos) = libm::sincos(angle);
        let [a, b] = self.shape.plane;
        out[a] = -radius * rate * rate * cos - 2.0 * growth * rate * sin;
        out[b] = -radius * rate * rate * sin + 2.0 * growth * rate * cos;
    }

    /// Path lengths at which the direction of travel of an axis reverses. `first` and `second` are its components along
    /// the directions of the plane, `drift` is its additional movement in mm per mm. Of each kind of reversal only the
    /// first and the last are returned, since a helix shifts them evenly.
    pub(super) fn turning_points(&self, [first, second]: [f64; 2], drift: f64) -> [Option<f64>; 4] {
        let sweep = self.shape.sweep_rad;
        let amplitude = self.radius() * libm::hypot(first, second);
        // derivative by the angle: -amplitude sin(angle - phase) + drift
        let drift = drift * self.length / sweep;
        let m = drift / amplitude;
        if amplitude <= 0.0 || m.abs() >= 1.0 {
            return [None; 4];
        }
        let phase = libm::atan2(second, first);
        let turn = 2.0 * std::f64::consts::PI;
        let mut found = [None; 4];
        for (k, angle) in [phase + libm::asin(m), phase + std::f64::consts::PI - libm::asin(m)]
            .into_iter()
            .enumerate()
        {
            let delta = (angle - self.start_rad) * sweep.signum();
            let near = delta - turn * libm::floor(delta / turn);
            if near <= sweep.abs() {
                let far = near + turn * libm::floor((sweep.abs() - near) / turn);
                found[2 * k] = Some(near / sweep.abs() * self.length);
                found[2 * k + 1] = Some(far / sweep.abs() * self.length);
            }
        }
        found
    }

    /// The part between two path lengths.
    pub(super) fn section(&self, from: f64, to: f64) -> Self {
        let mut out = self.clone();
        self.position(from, &mut out.start);
        self.position(to, &mut out.end);
        (out.radius_start, out.start_rad, _) = self.polar(from);
        (out.radius_end, _, _) = self.polar(to);
        out.length = to - from;
        out.shape.sweep_rad *= out.length / self.length;
        out.fan = Fan::of(&out);
        out
    }
}
