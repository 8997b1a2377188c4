//! Step 1: the fastest profile.
//!
//! Three properties make it short. The displacements possible in a given duration are an interval that starts, at the
//! shortest duration, with the single displacement of the fastest change of velocity; so
//! - a larger displacement is first reached by a profile towards higher positions, a smaller one by its mirror image,
//!   unless durations just above the shortest are followed by impossible ones (`isolated`);
//! - a profile through a peak velocity (`peak`) is the fastest in its direction if it never reverses;
//! - quartics only have to be solved where the acceleration stays on one side of zero in its falling ramp.
//!
//! With `a1` the peak of the acceleration (phases 1..3) and `a2` its lowest value (phases 3..7), those are
//! - `free`: no limit reached, `a1² - a2²` follows from the change of velocity, `x = a1 - a2` solves a quartic;
//! - `one_limit`: `a1` at its limit for some time, `x = a1 - a2` solves a quartic;
//!   the same for `a2`, by reversing the problem.
//!
//! The quartics are those of Ruckig with jerk 1 (Copyright (c) 2021 Lars Berscheid, MIT License, see the notice
//! in `RUCKIG-LICENSE`).

use super::candidate::{Candidate, displacement};
use super::peak::Peak;
use super::polynomial::roots_in;
use super::scaled::Problem;

/// The fastest profile of a problem whose boundary states are admissible.
pub(super) fn fastest(problem: &Problem) -> Option<Candidate> {
    let mirror = problem.mirrored();
    let mut search = Search { best: None };
    let change = FastestChange::new(problem, &mirror);
    let surplus = problem.distance - change.distance;
    // where the change is a single ramp, rounding moves it by the square root of the precision
    let near = 1e-6 * (1.0 + problem.distance.abs()) + problem.distance_rounding;
    let [up, down] = [(problem, false), (&mirror, true)];
    // outside the limits a peak may exceed its limit, and the properties above do not hold
    let outside = problem.v0 > problem.v_max || problem.v0 < problem.v_min;
    let proven = !change.isolated && !outside;
    if surplus.abs() <= near || !proven {
        // a single bump has no freedom left: rounding may have excluded every other profile
        for (p, mirrored) in [up, down] {
            search.bumps(p, mirrored);
        }
        if search.best.is_some() && proven {
            return search.best;
        }
    }
    let margin = if outside { f64::INFINITY } else { 1.0 + 1e-9 };
    for (p, mirrored) in if surplus >= 0.0 { [up, down] } else { [down, up] } {
        let found = search.through_peak(p, mirrored);
        if !found || !proven || !never_reverses(p) {
            search.quartics(p, mirrored, margin);
        }
        if search.best.is_some() && proven {
            return search.best;
        }
    }
    if search.best.is_none() {
        // rounding has excluded these profiles: accept any that passes the check
        for (p, mirrored) in [up, down] {
            search.bumps(p, mirrored);
            search.quartics(p, mirrored, f64::INFINITY);
        }
    }
    search.best
}

/// The fastest change of velocity and acceleration, with any displacement.
struct FastestChange {
    distance: f64,
    /// Slightly longer durations are possible, but not all of them: the acceleration has one sign, and bringing it to
    /// zero on the way would already change the velocity too much.
    isolated: bool,
}

impl FastestChange {
    fn new(problem: &Problem, mirror: &Problem) -> Self {
        let Problem { v0, a0, ve, ae, .. } = *problem;
        let gain = ve - v0;
        let straight = 0.5 * (ae - a0).abs() * (a0 + ae);
        let (p, sign) = if gain < straight { (mirror, -1.0) } else { (problem, 1.0) };
        let square = bump_square(p);
        let t = bump(p, square, square.max(0.0).sqrt());
        let distance = sign * displacement(p.v0, p.a0, &t);
        let through_zero = 0.5 * (a0 * a0.abs() + ae * ae.abs());
        let rounding = 1e-9 * (through_zero.abs() + straight.abs());
        let (low, high) = (straight.min(through_zero), straight.max(through_zero));
        let isolated = a0 * ae > 0.0 && gain >= low - rounding && gain <= high + rounding;
        Self { distance, isolated }
    }
}

/// Square of the peak of a single bump of acceleration.
fn bump_square(problem: &Problem) -> f64 {
    let Problem { v0, a0, ve, ae, .. } = *problem;
    ve - v0 + 0.5 * (a0 * a0 + ae * ae)
}

/// The acceleration rises to a peak and falls to its final value.
fn bump(problem: &Problem, square: f64, peak: f64) -> [f64; 3] {
    let Problem { a0, ae, a_max, .. } = *problem;
    if peak > a_max {
        [a_max - a0, (square - a_max * a_max) / a_max, a_max - ae]
    } else {
        let least = a0.max(ae);
        let peak = if (peak - least).abs() <= 1e-12 { least } else { peak };
        [peak - a0, 0.0, peak - ae]
    }
}

/// Whether the motion never moves towards lower positions between start and end.
fn never_reverses(problem: &Problem) -> bool {
    let Problem { v0, a0, ve, ae, .. } = *problem;
    let (rising, falling) = (a0.min(0.0), ae.max(0.0));
    v0 >= 0.5 * rising * rising && ve >= 0.5 * falling * falling
}

struct Search {
    best: Option<Candidate>,
}

impl Search {
    fn offer(&mut self, problem: &Problem, t: [f64; 7], mirrored: bool, reversed: bool) -> bool {
        let Some(found) = Candidate::checked(problem, t) else { return false };
        if self.best.is_none_or(|best| found.duration < best.duration) {
            let found = if reversed { found.reversed() } else { found };
            self.best = Some(if mirrored { found.mirrored() } else { found });
        }
        true
    }

    fn through_peak(&mut self, problem: &Problem, mirrored: bool) -> bool {
        let t = Peak::new(problem).and_then(|peak| peak.times());
        t.is_some_and(|t| self.offer(problem, t, mirrored, false))
    }

    /// Profiles without a peak velocity: the falling ramp starts below zero or ends above it. `margin` widens the range
    /// of its length beyond that.
    fn quartics(&mut self, problem: &Problem, mirrored: bool, margin: f64) {
        let Problem { a0, ae, .. } = *problem;
        let everything = margin.is_infinite();
        if a0 < 0.0 || ae > 0.0 || everything {
            self.free(problem, mirrored, margin);
        }
        if ae > 0.0 || everything {
            self.one_limit(problem, mirrored, false, margin);
        }
        if a0 < 0.0 || everything {
            self.one_limit(&problem.reversed(), mirrored, true, margin);
        }
    }

    fn free(&mut self, problem: &Problem, mirrored: bool, margin: f64) {
        let Problem { distance, v0, a0, ve, ae, a_max, a_min, .. } = *problem;
        let (s0, se) = (a0 * a0, ae * ae);
        // a1² - a2²
        let squares = 0.5 * (s0 - se) + ve - v0;
        let c = [
            1.0,
            0.0,
            -2.0 * (s0 + se - 2.0 * (v0 + ve)),
            4.0 / 3.0 * (s0 * a0 - se * ae + 3.0 * (ae * ve - a0 * v0)) - 4.0 * distance,
            -squares * squares,
        ];
        let times = |x: f64| {
            let middle = 0.5 * squares / x;
            [middle + 0.5 * x - a0, 0.0, x, 0.0, 0.0, 0.0, 0.5 * x - middle + ae]
        };
        // longer ramps pass through zero
        let longest = (a_max - a_min).min(margin * squares.abs().sqrt());
        for x in roots_in(&c, (a0 - ae).max(0.0), longest) {
            if x > 0.0 {
                let x = polished(problem, x, &times, quartic_slope(&c, x) / (4.0 * x));
                self.offer(problem, times(x), mirrored, false);
            }
        }
    }

    fn one_limit(&mut self, problem: &Problem, mirrored: bool, reversed: bool, margin: f64) {
        let Problem { distance, v0, a0, ve, ae, a_max: a, a_min, .. } = *problem;
        let (s0, se, s) = (a0 * a0, ae * ae, a * a);
        let c = [
            1.0,
            -2.0 * a,
            s - se + 2.0 * ve,
            0.0,
            (se * se - s0 * s0) / 4.0
                + 2.0 / 3.0 * a * (s0 * a0 - se * ae)
                + 2.0 * a * (ae * ve - a0 * v0)
                - 0.5 * s0 * (s - 2.0 * v0)
                + 0.5 * se * (s - 2.0 * ve)
                + (ve * ve - v0 * v0 - 2.0 * a * distance)
                - s * (ve - v0),
        ];
        let hold = (0.5 * (s0 - se) + ve - v0) / a;
        let times = |x: f64| [a - a0, hold - 2.0 * x + x * x / a, x, 0.0, 0.0, 0.0, ae - a + x];
        // longer ramps pass through zero
        let longest = (a - a_min).min(margin * a);
        for x in roots_in(&c, (a - ae).max(0.0), longest) {
            let x = polished(problem, x, &times, quartic_slope(&c, x) / (2.0 * a));
            self.offer(problem, times(x), mirrored, reversed);
        }
    }

    /// A single bump of acceleration; the peak itself may be negative.
    fn bumps(&mut self, problem: &Problem, mirrored: bool) {
        let square = bump_square(problem);
        let root = square.max(0.0).sqrt();
        for peak in [root, -root] {
            let [up, hold, down] = bump(problem, square, peak);
            self.offer(problem, [up, hold, down, 0.0, 0.0, 0.0, 0.0], mirrored, false);
        }
    }
}

fn quartic_slope(c: &[f64; 5], x: f64) -> f64 {
    ((4.0 * c[0] * x + 3.0 * c[1]) * x + 2.0 * c[2]) * x + c[3]
}

/// Newton steps on the integrated displacement, as long as they reduce its error.
fn polished(problem: &Problem, x: f64, times: &impl Fn(f64) -> [f64; 7], slope: f64) -> f64 {
    let error = |x: f64| displacement(problem.v0, problem.a0, &times(x)) - problem.distance;
    let (mut x, mut e) = (x, error(x));
    for _ in 0..3 {
        let next = x - e / slope;
        let reduced = error(next);
        if reduced.is_nan() || reduced.abs() >= 0.5 * e.abs() {
            break;
        }
        (x, e) = (next, reduced);
    }
    x
}
