//! Even speeds: the highest constant speed at which a stretch of the path keeps the tolerance.
//!
//! They depend only on the path, the filters and the tolerance, not on the plan. A search therefore starts with them as
//! demands if the free plan does not keep the tolerance ([`foresee`]): where they limit the speed, a higher feed rate
//! has no effect.

use super::marks::STRAIGHT;
use super::violation::within;
use super::{Demands, Kernels};
use crate::axis::AxisVec;
use crate::contour::{Contour, ROUNDING_MM};
use crate::deviation::{SetPath, distance};
use crate::queue::Queued;
use kontur_filters::time::CycleTime;
use std::sync::Arc;

/// Share of the tolerance by which an even speed aims below it.
const AIM: f64 = 0.01;
/// Halvings in the search for a speed.
const HALVINGS: u32 = 24;
/// Places, to each side of a point of the contour, at which the set path is compared with the point.
const PLACES: i32 = 4;
/// Rounds that refine a guess.
const ROUNDS: u32 = 8;
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

/// A kink of the contour ahead.
struct Kink {
    /// Boundary of the window; `s`: path length there.
    boundary: usize,
    s: f64,
    /// Length of the change of direction.
    turn: f64,
    /// Whether the path turns back by more than 90 deg.
    acute: bool,
    tolerance_mm: f64,
    /// Highest speed in mm/s of the two adjacent blocks.
    feed: f64,
}

/// Whether the filters are equal and without overshoot: the speeds at kinks are then known before any trial.
pub(super) fn foresees(kernels: &Kernels) -> bool {
    kernels.any() && !kernels.unequal && !kernels.overshoot
}

/// Demands even speeds at the kinks of a window that begins at path length `start`, and between kinks within reach of
/// each other; false if this changes nothing. Kinks too close to the end of the window are examined again when more
/// blocks are known.
pub(super) fn foresee(
    demands: &mut Demands,
    window: &[Arc<Queued>],
    past: &Contour,
    start: f64,
    (kernels, cycle): (&Kernels, CycleTime),
) -> bool {
    let Some(kernel) = kernels.longest().filter(|_| foresees(kernels)) else { return false };
    let mut contour = past.clone();
    let mut end = start;
    for queued in window {
        contour.enter(f64::INFINITY, end, Arc::clone(queued));
        end += queued.length;
    }
    let between = (f64::NEG_INFINITY, f64::INFINITY);
    let evenly = Evenly { contour: &contour, kernels, cycle, between };
    let [m1, reach] =
        [kernel.m1_cycles(), f64::from(kernel.length())].map(|cycles| cycles * cycle.seconds());
    let delay = kernel.delay_cycles() * cycle.seconds();
    let side = delay.max(reach - delay);
    let kinks = kinks(window, start);
    let first = kinks.partition_point(|k| k.boundary < demands.foreseen).saturating_sub(1);
    demands.foreseen = window.len();
    let mut before: Option<(&Kink, f64)> = None;
    let mut changes = false;
    for (i, kink) in kinks.iter().enumerate().skip(first) {
        // the mean path beyond a kink falls with the distance from it, below a straight line to the end of the filter
        let part = |k: &Kink, speed: f64| k.turn * m1 * (speed - (k.s - kink.s).abs() / side);
        let parts = |speed: f64| {
            let behind = kinks[i..].iter().map(move |k| part(k, speed)).take_while(|p| *p > 0.0);
            let ahead = kinks[..i].iter().rev().map(move |k| part(k, speed));
            behind.chain(ahead.take_while(|p| *p > 0.0))
        };
        let aim = aim(kink.tolerance_mm);
        let mut guess = kink.feed.min(aim / (m1 * kink.turn));
        for _ in 0..ROUNDS {
            let sum: f64 = parts(guess).sum();
            if sum <= aim {
                break;
            }
            guess *= (aim / sum).max(0.5);
        }
        let even = if guess >= kink.feed {
            kink.feed
        } else {
            let point = window[kink.boundary].block.path.start();
            fastest(guess, 1e-3 * guess, kink.feed, |speed| {
                evenly.stays(kink.s, speed, aim)
                    && (!kink.acute || evenly.misses(point, kink.s, speed) <= aim)
            })
        };
        if kink.s + even * reach > end {
            demands.foreseen = demands.foreseen.min(kink.boundary);
        }
        let largest = parts(even).fold(0.0, f64::max);
        if even >= kink.feed || part(kink, even) < ALIKE * largest {
            continue;
        }
        let cap = &mut demands.cap[kink.boundary];
        changes |= even < *cap;
        *cap = cap.min(even);
        if let Some((other, speed)) = before {
            let speed = speed.max(even);
            if kink.s - other.s <= speed * reach {
                for feed in &mut demands.feed[other.boundary..kink.boundary] {
                    *feed = feed.min(speed);
                }
            }
        }
        before = Some((kink, even));
    }
    changes
}

/// The kinks of a window that begins at path length `start`.
fn kinks(window: &[Arc<Queued>], start: f64) -> Vec<Kink> {
    let mut s = start;
    let mut out = Vec::new();
    for (b, pair) in window.windows(2).enumerate() {
        let [from, to] = [&pair[0], &pair[1]];
        s += from.length;
        let tolerances = [from, to].map(|q| q.block.tolerance.ax_dev_mm.unwrap_or(f64::INFINITY));
        let tolerance_mm = tolerances[0].min(tolerances[1]);
        let (out_of, into) = (&from.ends.tangent_out, &to.ends.tangent_in);
        let turns = out_of.iter().zip(into.iter()).map(|(a, b)| (b - a) * (b - a));
        let turn = turns.sum::<f64>().sqrt();
        // the remainder of a block continues without a kink
        if turn <= STRAIGHT || to.offset > 0.0 || tolerance_mm.is_infinite() {
            continue;
        }
        let acute = out_of.iter().zip(into.iter()).map(|(a, b)| a * b).sum::<f64>() < 0.0;
        let feed = from.velocity.v_mm_s.max(to.velocity.v_mm_s);
        out.push(Kink { boundary: b + 1, s, turn, acute, tolerance_mm, feed });
    }
    out
}
