//! A 90 degree corner passed at constant speed, with equal filters in both axes: how far the path leaves the contour.
//!
//! The tool approaches along x, passes the corner (0, 0) and leaves along y without slowing down. Slowing down at the
//! corner only reduces the error, so this is the worst case of a filter at a given feed rate.
//!
//! [`CornerPath::drive`] takes any stage; for a kernel alone [`kernel_error_mm`] gives the error directly:
//!
//! ```
//! use kontur_filters::analysis::corner::{CornerPath, kernel_error_mm};
//! use kontur_filters::kernel::KernelFilter;
//! use kontur_filters::time::CycleTime;
//! use kontur_filters::vib_guard::VibGuardSettings;
//! use std::sync::Arc;
//!
//! let cycle = CycleTime::DEFAULT;
//! let kernel = VibGuardSettings { mode: 1, freq_hz: 20.0, damping: 0.1 }.kernel(cycle).unwrap();
//! let error_mm = kernel_error_mm(&kernel, 50.0, cycle);
//! let path = CornerPath::drive(&KernelFilter::new(Arc::new(kernel), 0.0), 50.0, cycle).unwrap();
//! // two impulses cut the corner off by a straight line between points half a period apart
//! assert!(path.contour_error_mm > 0.0 && path.contour_error_mm <= error_mm + 1e-9);
//! ```

use crate::kernel::Kernel;
use crate::stage::Stage;
use crate::time::CycleTime;

/// The path through the corner and its errors.
#[derive(Clone, Debug, PartialEq)]
pub struct CornerPath {
    /// Filtered positions (x, y) in mm, one per cycle, from before the corner to after the filters have settled.
    pub points: Vec<[f64; 2]>,
    /// Largest distance of the path from the contour in mm, measured on the polyline: between two samples the path may
    /// be further off than at both of them.
    pub contour_error_mm: f64,
    /// Smallest distance of the path from the corner in mm.
    pub corner_distance_mm: f64,
}

/// Longest transient that is computed, in cycles.
const LONGEST_CYCLES: u32 = 1 << 18;

/// Cycles after which the step response of a stage stays within `window` of its input; `None` if it never does (a
/// high-pass or band-pass) or needs more than 2^18 cycles.
pub fn settling_cycles<S: Stage + Clone>(stage: &S, window: f64) -> Option<u32> {
    let mut stage = stage.clone();
    stage.settle(0.0);
    let mut settled = 0;
    let mut n = 0;
    // A constant output marks the end only if it lasts as long as the transient itself; otherwise it may be a zero
    // crossing.
    loop {
        for _ in 0..=n.max(64) {
            n += 1;
            if (stage.step(1.0) - 1.0).abs() > window {
                settled = n;
            }
        }
        if 2 * settled < n {
            return Some(settled);
        }
        if n > LONGEST_CYCLES {
            return None;
        }
    }
}

impl CornerPath {
    /// Drives two copies of `stage` through the corner at `speed_mm_s`, the corner on a sample.
    ///
    /// `None` for a stage that never settles on its input.
    pub fn drive<S: Stage + Clone>(stage: &S, speed_mm_s: f64, cycle: CycleTime) -> Option<Self> {
        const WINDOW: f64 = 1e-9;
        let settled = settling_cycles(stage, WINDOW)?;
        let reach = i64::from(settled) + 2;
        let per_cycle = speed_mm_s * cycle.seconds();
        let (mut x_axis, mut y_axis) = (stage.clone(), stage.clone());
        // Both axes have moved at constant speed long enough for the start-up transient to have decayed to a pure
        // delay.
        x_axis.settle(-2.0 * reach as f64 * per_cycle);
        y_axis.settle(0.0);
        let mut points = Vec::new();
        for n in -2 * reach..=2 * reach {
            let s = n as f64 * per_cycle;
            let point = [x_axis.step(s.min(0.0)), y_axis.step(s.max(0.0))];
            if n >= -reach {
                points.push(point);
            }
        }
        let (contour_error_mm, corner_distance_mm) = measure(&points);
        Some(Self { points, contour_error_mm, corner_distance_mm })
    }
}

/// Largest distance from the contour and smallest distance from the corner of a polyline.
fn measure(points: &[[f64; 2]]) -> (f64, f64) {
    let (mut error, mut corner) = (0.0_f64, f64::INFINITY);
    for pair in points.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let at = |t: f64| [from[0] + t * dx, from[1] + t * dy];
        // The distance to the nearer leg is largest at an end or where both legs are equally far.
        let equal = [1.0, -1.0].map(|sign| {
            let (before, after) = (from[0] + sign * from[1], to[0] + sign * to[1]);
            (before / (before - after)).clamp(0.0, 1.0)
        });
        for t in [0.0, 1.0].into_iter().chain(equal.into_iter().filter(|t| t.is_finite())) {
            error = error.max(distance(at(t)));
        }
        let foot = -(from[0] * dx + from[1] * dy) / (dx * dx + dy * dy);
        if foot.is_finite() {
            let [x, y] = at(foot.clamp(0.0, 1.0));
            corner = corner.min(libm::hypot(x, y));
        }
    }
    (error, corner)
}

/// Distance from the contour: x up to 0 on y = 0, then y from 0 on x = 0.
fn distance([x, y]: [f64; 2]) -> f64 {
    let corner = libm::hypot(x, y);
    let first = if x <= 0.0 { y.abs() } else { corner };
    let second = if y >= 0.0 { x.abs() } else { corner };
    first.min(second)
}

/// Contour error of a kernel at a 90 degree corner passed at `speed_mm_s`, in mm; equal to the delay-aligned error of
/// each axis.
///
/// `v M1 T` if no tap is negative (a velocity jump `v` of an axis shifts its aligned output by that much), otherwise
/// the error of the driven corner.
pub fn kernel_error_mm(kernel: &Kernel, speed_mm_s: f64, cycle: CycleTime) -> f64 {
    if !kernel.has_negative_taps() {
        return speed_mm_s * kernel.m1_cycles() * cycle.seconds();
    }
    let stage = crate::kernel::KernelFilter::new(kernel.clone().into(), 0.0);
    CornerPath::drive(&stage, speed_mm_s, cycle).map_or(f64::NAN, |path| path.contour_error_mm)
}
