//! The limits of one block: path velocity and path slope, derived from the axes that move in it.
//!
//! On a path with one profile `s(t)` every axis follows `q_i(s)`: its velocity is `v |q_i'|`, its acceleration
//! `|a q_i' + v^2 q_i''|`. Each limit below is a separate function of the block alone; for transitions between blocks
//! see [`crate::junction`].
//!
//! Called once per block, when it enters the queue ([`crate::queue::Queued::new`]).
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! use kontur_motion::limits::{PathExtremes, PathSpeeds};
//!
//! // 1000 mm/s per axis: on the diagonal the path may be sqrt(2) times as fast
//! let block = block(1, [0.0, 0.0], [10.0, 10.0], 2000.0);
//! let speeds = PathSpeeds::of(&block, &PathExtremes::of(&block.path));
//! assert!((speeds.axis_mm_s - 1000.0 * 2.0_f64.sqrt()).abs() < 1e-9);
//! assert_eq!(speeds.programmed_mm_s, 2000.0);
//! ```

mod slope;

use crate::axis::{AxisDynamics, AxisVec};
use crate::block::{Block, ChannelDynamics, CurveJerk, Feed, Slope, SlopeKind};
use crate::cap::{Cap, SpeedLimit};
use crate::path::{ArcPath, Path, TiltedArc};

pub(crate) use slope::SlopeTable;

/// Largest absolute values of the path derivatives of every axis over one block.
#[derive(Clone, Debug)]
pub struct PathExtremes {
    /// `max |q_i'|`.
    pub first: AxisVec,
    /// `max |q_i''|` in 1/mm; empty for a line, where there are none.
    pub second: AxisVec,
    /// `max |q_i'''|` in 1/mm2; empty for a line.
    pub third: AxisVec,
    /// Lengths of the vectors `q''` in 1/mm and `q'''` in 1/mm2: the largest values on arcs, upper bounds on curves
    /// (the axes reach their maxima at different places).
    pub lengths: [f64; 2],
}

/// `max |cos(x - phase)|` over the angles that an arc actually covers: 1 if a multiple of pi is among them, otherwise
/// the larger end value.
fn largest_cos(arc: &ArcPath, phase: f64) -> f64 {
    let (from, to) = swept(arc);
    let (lo, hi) = ((from - phase) / std::f64::consts::PI, (to - phase) / std::f64::consts::PI);
    if hi.floor() >= lo.ceil() {
        1.0
    } else {
        libm::cos(from - phase).abs().max(libm::cos(to - phase).abs())
    }
}

/// Angles of an arc, the smaller one first.
fn swept(arc: &ArcPath) -> (f64, f64) {
    let (start, sweep) = (arc.start_angle(), arc.shape().sweep_rad);
    if sweep > 0.0 { (start, start + sweep) } else { (start + sweep, start) }
}

/// Largest derivatives of an arc tilted to the axes. For its three axes they are upper bounds, the sum of the circular
/// part and the height of a helix.
fn tilted_extremes(tilted: &TiltedArc) -> PathExtremes {
    let arc = tilted.arc();
    let mut extremes = arc_extremes(arc);
    let rate = arc.shape().sweep_rad.abs() / arc.length();
    for axis in tilted.tilt().axes {
        let ([first, second], drift) = tilted.shares(axis);
        let amplitude = arc.radius() * libm::hypot(first, second);
        let phase = libm::atan2(second, first);
        // position amplitude cos(angle - phase), slope its sine
        let cos = amplitude * largest_cos(arc, phase);
        let sin = amplitude * largest_cos(arc, phase + std::f64::consts::FRAC_PI_2);
        extremes.first[axis] = sin * rate + drift.abs();
        extremes.second[axis] = cos * rate * rate;
        extremes.third[axis] = sin * rate * rate * rate;
    }
    extremes
}

/// Largest derivatives over the angular range that an arc actually covers.
fn arc_extremes(arc: &ArcPath) -> PathExtremes {
    let n = arc.start().len();
    let [a, b] = arc.shape().plane;
    let sweep = arc.shape().sweep_rad;
    let rate = sweep.abs() / arc.length();
    let radius = arc.radius();
    let (cos, sin) = (largest_cos(arc, 0.0), largest_cos(arc, std::f64::consts::FRAC_PI_2));
    let mut first = AxisVec::zeros(n);
    arc.tangent_outside_plane(&mut first);
    for v in first.iter_mut() {
        *v = v.abs();
    }
    let (mut second, mut third) = (AxisVec::zeros(n), AxisVec::zeros(n));
    let (v1, v2, v3) = (radius * rate, radius * rate * rate, radius * rate * rate * rate);
    (first[a], first[b]) = (v1 * sin, v1 * cos);
    (second[a], second[b]) = (v2 * cos, v2 * sin);
    (third[a], third[b]) = (v3 * sin, v3 * cos);
    PathExtremes { first, second, third, lengths: [v2, v3] }
}

impl PathExtremes {
    /// The extremes of a path.
    pub fn of(path: &Path) -> Self {
        match path {
            Path::Line(line) => {
                let n = line.direction().len();
                let mut first = AxisVec::zeros(n);
                let (shares, direction) = (&mut first[..n], &line.direction()[..n]);
                for i in 0..n {
                    shares[i] = direction[i].abs();
                }
                let (second, third) = (AxisVec::default(), AxisVec::default());
                Self { first, second, third, lengths: [0.0; 2] }
            }
            Path::Arc(arc) => arc_extremes(arc),
            Path::Tilted(tilted) => tilted_extremes(tilted),
            Path::Curve(curve) => {
                let [first, second, third] = curve.extremes().clone();
                let norm = |v: &AxisVec| v.iter().map(|c| c * c).sum::<f64>().sqrt();
                let lengths = [norm(&second), norm(&third)];
                Self { first, second, third, lengths }
            }
        }
    }
}

/// `min_i limit_i / share_i` over the axes that move.
pub(crate) fn weakest(
    axes: &[AxisDynamics],
    share: &[f64],
    limit: impl Fn(&AxisDynamics) -> f64,
) -> f64 {
    let n = axes.len().min(share.len());
    least(&share[..n], |i| limit(&axes[i]))
}

/// As [`weakest`], for limits by the index of the axis.
#[inline]
fn least(share: &[f64], limit: impl Fn(usize) -> f64) -> f64 {
    let mut least = f64::INFINITY;
    for (i, u) in share.iter().enumerate() {
        if *u > 0.0 {
            least = least.min(limit(i) / u);
        }
    }
    least
}

/// Acceleration that an axis may use for curvature and kinks: the smaller of its acceleration and deceleration in the
/// active mode (Assumption: the documents relate it to G00 or feed, but not to acceleration or deceleration).
pub(crate) fn contour_acceleration(axis: &AxisDynamics, slope: Slope, rapid: bool) -> f64 {
    match (slope.kind, rapid) {
        (SlopeKind::Step, false) => axis.step_feed.acc_mm_s2[0].min(axis.step_feed.dec_mm_s2[0]),
        (SlopeKind::Step, true) => axis.step_rapid.acc_mm_s2[0].min(axis.step_rapid.dec_mm_s2[0]),
        (_, false) => axis.feed.acc_mm_s2.min(axis.feed.dec_mm_s2),
        (_, true) => axis.rapid.acc_mm_s2,
    }
}

/// Longest ramp time of an axis in the active mode, in s.
pub(crate) fn longest_ramp(axis: &AxisDynamics, rapid: bool) -> f64 {
    if rapid { axis.rapid.ramp_s } else { axis.feed.ramps_s.into_iter().fold(0.0, f64::max) }
}

/// Velocity limit of the axes on a path (P-AXIS-00212; P-AXIS-00209 in rapid).
pub(crate) fn axis_velocity(d: &ChannelDynamics, x: &PathExtremes, rapid: bool) -> f64 {
    weakest(
        &d.axes,
        &x.first,
        |a| if rapid { a.v_rapid_mm_s.min(a.v_max_mm_s) } else { a.v_max_mm_s },
    )
}

/// Velocity limit from centripetal acceleration: `v^2 max|q_i''| <= a_i`.
pub(crate) fn curve_acceleration(
    d: &ChannelDynamics,
    x: &PathExtremes,
    slope: Slope,
    rapid: bool,
) -> f64 {
    weakest(&d.axes, &x.second, |a| contour_acceleration(a, slope, rapid)).sqrt()
}

/// Velocity limit from the contour jerk, non-linear slopes: `v^3 max|q_i'''| <= a_i / t_i`.
///
/// `t_i` is the geometric ramp time (P-AXIS-00199) on arcs; on polynomials P-CHAN-00110 selects it.
pub fn curve_jerk(
    d: &ChannelDynamics,
    x: &PathExtremes,
    slope: Slope,
    rapid: bool,
    check: CurveJerk,
) -> f64 {
    if slope.kind == SlopeKind::Step || check == CurveJerk::Unlimited {
        return f64::INFINITY;
    }
    libm::cbrt(weakest(&d.axes, &x.third, |a| {
        let ramp = if check == CurveJerk::Ramps { longest_ramp(a, rapid) } else { a.tr_geom_s };
        if ramp > 0.0 { contour_acceleration(a, slope, rapid) / ramp } else { f64::INFINITY }
    }))
}

/// Velocity limits of `#VECTOR LIMIT` on a curved path.
///
/// Assumption: P-CHAN-00350 (`vector.cir_radial_acc_limit`) extends the limit of the path acceleration to the centripetal
/// acceleration, as its key says; the acceleration along the path is limited on arcs in any case, since an older page names
/// G02 and G03 among the blocks that it limits (15425556619). Read literally, the page
/// (205691659) frees arcs from this limit without it.
fn vector_curve(d: &ChannelDynamics, x: &PathExtremes) -> f64 {
    let [k2, k3] = x.lengths;
    if k2 <= 0.0 {
        return f64::INFINITY;
    }
    let mut acc = d.vector.radial_acc_mm_s2.unwrap_or(f64::INFINITY);
    if d.vector_acc_on_arcs {
        acc = acc.min(d.vector.acc_mm_s2.unwrap_or(f64::INFINITY));
    }
    let jerk = d.vector.radial_jerk_mm_s3.unwrap_or(f64::INFINITY);
    (acc / k2).sqrt().min(libm::cbrt(jerk / k3))
}

/// Path velocities of a block before the real-time override: programmed and permitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSpeeds {
    /// Programmed velocity in mm/s, including the weights of the program; for rapid blocks that of the axes.
    pub programmed_mm_s: f64,
    /// Velocity limit from the axes in mm/s.
    pub axis_mm_s: f64,
    /// Velocity limit from the curvature in mm/s.
    pub curve_mm_s: f64,
    /// Velocity limit of `#VECTOR LIMIT` in mm/s, infinite without one.
    pub vector_mm_s: f64,
    /// G00.
    pub rapid: bool,
}

impl PathSpeeds {
    /// The speeds of a block.
    pub fn of(block: &Block, x: &PathExtremes) -> Self {
        let d = &block.dynamics;
        let rapid = block.feed == Feed::Rapid;
        let axis = axis_velocity(d, x, rapid);
        let ratio = block.feed_ratio;
        let programmed = match block.feed {
            Feed::Rapid => axis * ratio.min(1.0),
            Feed::PathVelocity(v) => v * ratio,
            Feed::Duration(t) => block.path.length() / t * ratio,
            Feed::ShareOfMaximum(share) => {
                weakest(&d.axes, &x.first, |a| a.v_max_mm_s) * share * ratio
            }
        };
        let check = match block.path {
            Path::Curve(_) => d.curve_jerk,
            _ => CurveJerk::Geometric,
        };
        let curve = if block.path.is_straight() {
            f64::INFINITY
        } else {
            curve_acceleration(d, x, block.slope, rapid)
                .min(curve_jerk(d, x, block.slope, rapid, check))
                .min(vector_curve(d, x))
        };
        Self {
            programmed_mm_s: programmed,
            axis_mm_s: axis,
            curve_mm_s: curve,
            vector_mm_s: d.vector.vel_mm_s.unwrap_or(f64::INFINITY),
            rapid,
        }
    }

    /// Velocity in mm/s that is not exceeded with any override (at most 200 %).
    pub fn fastest(&self) -> f64 {
        self.highest().min(2.0 * self.programmed_mm_s)
    }

    /// Velocity in mm/s that the limits permit.
    pub fn highest(&self) -> f64 {
        self.axis_mm_s.min(self.curve_mm_s).min(self.vector_mm_s)
    }

    /// Velocity in mm/s with `commanded` in place of the programmed one, and its reason.
    pub fn limited(&self, commanded: f64) -> Cap {
        let mut best = Cap::new(commanded.min(self.vector_mm_s), SpeedLimit::Feed);
        if self.axis_mm_s < best.v_mm_s || self.rapid && self.axis_mm_s <= best.v_mm_s {
            best = Cap::new(self.axis_mm_s, SpeedLimit::Axis);
        }
        best.lower(Cap::new(self.curve_mm_s, SpeedLimit::Curve))
    }
}

#[cfg(test)]
mod tests {
    use super::PathExtremes;
    use crate::axis::AxisVec;
    use crate::path::{ArcPath, ArcShape, Path};
    use std::f64::consts::TAU;

    /// Curvature of a helix of radius r and pitch 2 pi c: r / (r^2 + c^2), independent of its length; c = 0 for a
    /// circle.
    #[test]
    fn curvature_of_circles_and_helices() {
        for (turns, pitch) in [(1.0, 0.0), (0.1, 0.0), (1.0, 5.0), (3.0, 40.0)] {
            let r = 10.0;
            let angle = TAU * turns;
            let start = AxisVec::from_slice(&[r, 0.0, 0.0]);
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            let end = AxisVec::from_slice(&[r * cos, r * sin, pitch * turns]);
            let shape = ArcShape { plane: [0, 1], centre_mm: [0.0, 0.0], sweep_rad: angle };
            let path = Path::Arc(ArcPath::new(start, end, shape, &[]).unwrap());
            let c = pitch / TAU;
            let [second, third] = PathExtremes::of(&path).lengths;
            assert!((second - r / (r * r + c * c)).abs() < 1e-12, "{second}");
            assert!((third - r / libm::pow(r * r + c * c, 1.5)).abs() < 1e-12, "{third}");
        }
    }
}
