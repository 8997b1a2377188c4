//! Step 1: the fastest profile.
//!
//! Candidates towards higher positions. `a1` is the peak of the acceleration (phases 1..3), `a2` its lowest value
//! (phases 3..7):
//! - `direct`: one bump of acceleration without return, where the others degenerate (`a1 = a2`);
//! - `velocity_limit`: cruise at the highest velocity; the changes of speed before and after are independent;
//! - `both_limits`: `a1` and `a2` at their limits for some time, a quadratic for the highest velocity;
//! - `free`: no limit reached, `a1² - a2²` follows from the change of velocity, `x = a1 - a2` solves a quartic;
//! - `one_limit`: `a1` at its limit for some time, `x = a1 - a2` solves a quartic;
//!   the same for `a2`, by reversing the problem.
//!
//! The quartics are those of Ruckig with jerk 1 (Copyright (c) 2021 Lars Berscheid, MIT License, see the notice
//! in `RUCKIG-LICENSE`).

use super::candidate::{Candidate, UP_DOWN_DOWN_UP, displacement};
use super::leg::{Leg, rising, settled_velocity};
use super::polynomial::roots_in;
use super::scaled::Problem;

/// The fastest profile of a problem whose boundary states are admissible.
pub(super) fn fastest(problem: &Problem) -> Option<Candidate> {
    let mut search = Search { best: None };
    let mirror = problem.mirrored();
    // first: near the end of a motion rounding may have closed every other way
    search.direct(problem, false);
    search.direct(&mirror, true);
    if unique(problem) {
        // the displacement of the fastest change of velocity alone decides the direction
        let up = direct_distance(problem) <= problem.distance;
        let (first, second) = if up { (problem, &mirror) } else { (&mirror, problem) };
        if search.best.is_none() {
            search.upwards(first, !up, true);
        }
        if search.best.is_none() {
            search.upwards(second, up, true);
        }
    } else {
        search.upwards(problem, false, false);
        search.upwards(&mirror, true, false);
    }
    search.best
}

/// True if one boundary is at rest or both have no acceleration: then the displacement grows with the duration
/// on the branch of the solution, and the first valid candidate is the fastest.
fn unique(problem: &Problem) -> bool {
    let Problem { v0, a0, ve, ae, .. } = *problem;
    match (a0 == 0.0, ae == 0.0) {
        (true, true) => true,
        (true, false) => v0 == 0.0,
        (false, true) => ve == 0.0,
        (false, false) => false,
    }
}

/// Displacement of the fastest change from `(v0, a0)` to `(ve, ae)`, where one acceleration is zero.
fn direct_distance(problem: &Problem) -> f64 {
    let Problem { v0, a0, ve, ae, a_min, a_max, .. } = *problem;
    if ae == 0.0 {
        Leg::new(v0, a0, ve, a_min, a_max).displacement(v0, a0)
    } else {
        Leg::new(ve, -ae, v0, -a_max, -a_min).displacement(ve, -ae)
    }
}

struct Search {
    best: Option<Candidate>,
}

impl Search {
    fn offer(&mut self, problem: &Problem, t: [f64; 7], mirrored: bool, reversed: bool) -> bool {
        let Some(found) = Candidate::checked(problem, t, UP_DOWN_DOWN_UP) else { return false };
        if self.best.is_none_or(|best| found.duration < best.duration) {
            let found = if reversed { found.reversed() } else { found };
            self.best = Some(if mirrored { found.mirrored() } else { found });
        }
        true
    }

    fn upwards(&mut self, problem: &Problem, mirrored: bool, first_only: bool) {
        let cheapest_first: [fn(&mut Self, &Problem, bool) -> bool; 5] = [
            Self::velocity_limit,
            Self::both_limits,
            Self::free,
            |search, problem, mirrored| search.one_limit(problem, mirrored, false),
            |search, problem, mirrored| search.one_limit(&problem.reversed(), mirrored, true),
        ];
        for case in cheapest_first {
            if case(self, problem, mirrored) && first_only {
                return;
            }
        }
    }

    fn velocity_limit(&mut self, problem: &Problem, mirrored: bool) -> bool {
        let Problem { distance, v0, a0, ve, ae, v_max, a_max, a_min, .. } = *problem;
        // profiles with their peak below the settled velocities do not exist
        let highest = settled_velocity(v0, a0).max(settled_velocity(ve, -ae));
        if v_max <= 0.0 || highest > v_max * (1.0 + 1e-12) + 1e-12 {
            return false;
        }
        let [t0, t1, t2] = rising(v_max - v0, a0, a_max);
        let [t6, t5, t4] = rising(v_max - ve, -ae, -a_min);
        let mut t = [t0, t1, t2, 0.0, t4, t5, t6];
        // what rounding makes of the limit: over a long cruise the difference would show
        let cruise = v0 + t0 * (a0 + 0.5 * t0) + t1 * (a0 + t0) + t2 * (a0 + t0 - 0.5 * t2);
        t[3] = (distance - displacement(v0, a0, &t, &UP_DOWN_DOWN_UP)) / cruise;
        self.offer(problem, t, mirrored, false)
    }

    fn free(&mut self, problem: &Problem, mirrored: bool) -> bool {
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
        let mut found = false;
        for x in roots_in(&c, (a0 - ae).max(0.0), a_max - a_min) {
            if x > 0.0 {
                let x = polished(problem, x, &times, quartic_slope(&c, x) / (4.0 * x));
                found |= self.offer(problem, times(x), mirrored, false);
            }
        }
        found
    }

    fn one_limit(&mut self, problem: &Problem, mirrored: bool, reversed: bool) -> bool {
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
        let mut found = false;
        for x in roots_in(&c, (a - ae).max(0.0), a - a_min) {
            let x = polished(problem, x, &times, quartic_slope(&c, x) / (2.0 * a));
            found |= self.offer(problem, times(x), mirrored, reversed);
        }
        found
    }

    fn both_limits(&mut self, problem: &Problem, mirrored: bool) -> bool {
        let Problem { distance, v0, a0, ve, ae, a_max, a_min, .. } = *problem;
        // distance of a leg with plateau to peak velocity v: v²/(2a) + a v/2 + part
        let part = |v: f64, a0: f64, a: f64| {
            let ramp = a - a0;
            let reached = v + 0.5 * ramp * (a + a0);
            ramp * (v + ramp * (0.5 * a0 + ramp / 6.0))
                - reached * reached / (2.0 * a)
                - a * a * a / 24.0
        };
        let b = -a_min;
        let c = [
            0.5 / a_max + 0.5 / b,
            0.5 * (a_max + b),
            part(v0, a0, a_max) + part(ve, -ae, b) - distance,
        ];
        let mut found = false;
        for v in roots_in(&c, f64::NEG_INFINITY, f64::INFINITY) {
            let hold = |v0: f64, a0: f64, a: f64| (v - v0 + 0.5 * a0 * a0 - a * a) / a;
            let (up, down) = (hold(v0, a0, a_max), hold(ve, -ae, b));
            let t = [a_max - a0, up, a_max, 0.0, b, down, b + ae];
            found |= self.offer(problem, t, mirrored, false);
        }
        found
    }

    /// Acceleration goes up to a peak and down to its final value.
    fn direct(&mut self, problem: &Problem, mirrored: bool) {
        let Problem { v0, a0, ve, ae, a_max, .. } = *problem;
        let square = ve - v0 + 0.5 * (a0 * a0 + ae * ae);
        let least = a0.max(ae);
        let root = square.max(0.0).sqrt();
        if root > a_max {
            let hold = (square - a_max * a_max) / a_max;
            let t = [a_max - a0, hold, a_max - ae, 0.0, 0.0, 0.0, 0.0];
            self.offer(problem, t, mirrored, false);
        } else {
            // the peak itself may be negative
            for peak in [root, -root] {
                let peak = if (peak - least).abs() <= 1e-12 { least } else { peak };
                let t = [peak - a0, 0.0, peak - ae, 0.0, 0.0, 0.0, 0.0];
                self.offer(problem, t, mirrored, false);
            }
        }
    }
}

fn quartic_slope(c: &[f64; 5], x: f64) -> f64 {
    ((4.0 * c[0] * x + 3.0 * c[1]) * x + 2.0 * c[2]) * x + c[3]
}

/// Newton steps on the integrated displacement itself, as long as they reduce its error.
fn polished(problem: &Problem, x: f64, times: &impl Fn(f64) -> [f64; 7], slope: f64) -> f64 {
    let error = |x: f64| {
        displacement(problem.v0, problem.a0, &times(x), &UP_DOWN_DOWN_UP) - problem.distance
    };
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
