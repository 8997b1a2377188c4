//! Even speeds: the highest constant speed at which a stretch of the path keeps the tolerance.
//!
//! They depend only on the path, the filters and the tolerance, not on the plan. A search therefore starts with them as
//! demands if the free plan does not keep the tolerance ([`super::foresee`]): where they limit the speed, a higher feed rate
//! has no effect.

use super::Kernels;
use super::violation::within;
use crate::axis::AxisVec;
use crate::contour::{Contour, ROUNDING_MM};
use crate::deviation::{SetPath, distance};
use kontur_filters::time::CycleTime;

/// Share of the tolerance by which an even speed aims below it.
const AIM: f64 = 0.01;
/// Halvings in the search for a speed.
const HALVINGS: u32 = 24;
/// Places, to each side of a point of the contour, at which the set path is compared with the point.
const PLACES: i32 = 4;
/// Ratio to the largest part of a deviation from which on another part counts as similar.
pub(super) const ALIKE: f64 = 0.3;

/// A contour traversed at constant speed.
pub(super) struct Evenly<'a> {
    pub(super) contour: &'a Contour,
    pub(super) kernels: &'a Kernels,
    pub(super) cycle: CycleTime,
    /// Limits in path length that are not passed: nothing beyond them is held by the filters any more.
    pub(super) between: (f64, f64),
}

impl Evenly<'_> {
    /// Whether no component by which the set point around path length `middle` leaves the contour at a speed in mm/s
    /// exceeds `aim` mm.
    pub(super) fn stays(&self, middle: f64, speed: f64, aim: f64) -> bool {
        let mut x = AxisVec::zeros(self.kernels.axes.len());
        self.set_point(middle, speed, &mut x);
        // no point of the contour is nearer than the nearest one: at most speeds that keep the tolerance the one at the
        // middle is near enough
        let mut at = AxisVec::zeros(x.len());
        self.contour.walk().position(middle, &mut at);
        if distance(&x, &at) + ROUNDING_MM <= aim {
            return true;
        }
        let reach = self.reach(speed);
        self.contour.aside(&x, middle - reach, middle + reach) <= aim
    }

    /// Largest component in mm by which the set path around path length `at` misses a point there, at a speed in mm/s.
    pub(super) fn misses(&self, point: &[f64], at: f64, speed: f64) -> f64 {
        let reach = self.reach(speed);
        let axes = self.kernels.axes.len();
        let mut x = AxisVec::zeros(axes);
        let mut path = SetPath::starting(0, axes);
        for i in -PLACES..=PLACES {
            let s = at + 0.5 * reach * f64::from(i) / f64::from(PLACES);
            self.set_point(s, speed, &mut x);
            path.push(&x);
        }
        path.shortest(point).iter().fold(0.0, |most, c| c.abs().max(most))
    }

    /// Path length in mm within the filters.
    fn reach(&self, speed: f64) -> f64 {
        speed * f64::from(self.kernels.length()) * self.cycle.seconds()
    }

    /// Set point around path length `s`.
    fn set_point(&self, s: f64, speed: f64, out: &mut AxisVec) {
        let Self { contour, kernels, cycle, between } = self;
        let step = speed * cycle.seconds();
        let mut walk = contour.walk();
        let place = |(weight, delay): &(f64, f64)| {
            (*weight, (s + step * (kernels.delay - delay)).max(between.0).min(between.1))
        };
        // equal kernels share their taps
        if !kernels.unequal
            && let Some(coarse) = kernels.coarse.first()
        {
            walk.sum_near(coarse.iter().map(place), out);
            return;
        }
        let mut sum = out.clone();
        for (i, coarse) in kernels.coarse.iter().enumerate() {
            walk.sum_near(coarse.iter().map(place), &mut sum);
            out[i] = sum[i];
        }
    }
}

/// The limit for a run at constant speed.
pub(super) fn aim(tolerance_mm: f64) -> f64 {
    within(tolerance_mm) - AIM * tolerance_mm
}

/// The speed in mm/s just below the lowest one that does not keep the tolerance, starting from a guess; at most `most`,
/// at least `least`. A higher speed may keep it again, but the search does not reach it.
pub(super) fn fastest(guess: f64, least: f64, most: f64, keeps: impl Fn(f64) -> bool) -> f64 {
    let step = std::f64::consts::SQRT_2;
    let (mut low, mut high) = (guess.min(most), guess.min(most));
    if keeps(low) {
        loop {
            if low >= most {
                return most;
            }
            high = (low * step).min(most);
            if !keeps(high) {
                break;
            }
            low = high;
        }
    } else {
        loop {
            low = high / step;
            if low <= least {
                return least;
            }
            if keeps(low) {
                break;
            }
            high = low;
        }
    }
    for _ in 0..HALVINGS {
        if high - low <= 1e-3 * low {
            break;
        }
        let mid = 0.5 * (low + high);
        if keeps(mid) { low = mid } else { high = mid }
    }
    low
}
