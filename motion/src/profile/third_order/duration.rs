//! Step 2: a profile of prescribed duration.
//!
//! First choice: a phase of constant velocity `v` between two independent changes of speed, each towards higher
//! or lower velocity, so both sign patterns (up-down-down-up, up-down-up-down) occur. For a fixed duration the
//! velocity at every instant, and with it the displacement, grows with `v`: where `v` is possible, bisection finds
//! it. Possible are the `v` whose changes of speed fit into the duration: at most two ranges, next to the two
//! velocities at which start and target settle.
//!
//! Displacements between those ranges have no phase of constant velocity. There a blend of the two profiles at the
//! edges is taken: limits and equations are convex in the acceleration over time, so it keeps all of them.

use super::leg::{Leg, settled_velocity};
use super::scaled::Problem;
use smallvec::SmallVec;

/// Phases (duration, jerk) in scaled units.
pub(super) type Phases = SmallVec<[(f64, f64); 16]>;

/// `None` if no profile lasts `duration`.
pub(super) fn with_duration(problem: &Problem, duration: f64) -> Option<Phases> {
    let family = Family { problem: *problem, duration };
    let ranges = family.ranges();
    let distance = problem.distance;
    let slack = 1e-12 * (distance.abs() + duration) + problem.distance_rounding;
    let mut below: Option<f64> = None;
    for (lo, hi) in ranges {
        let (at_lo, at_hi) = (family.displacement(lo), family.displacement(hi));
        if at_lo > distance + slack {
            let below = below?;
            let from = family.displacement(below);
            let weight = (distance - from) / (at_lo - from);
            return Some(blend(&family.phases(below), &family.phases(lo), weight));
        }
        if at_hi >= distance - slack {
            let v = bisect(lo, hi, |v| family.displacement(v) <= distance);
            return Some(family.phases(v));
        }
        below = Some(hi);
    }
    None
}

/// All profiles of one duration with a phase of constant velocity.
struct Family {
    problem: Problem,
    duration: f64,
}

impl Family {
    fn legs(&self, v: f64) -> (Leg, Leg) {
        let Problem { v0, a0, ve, ae, a_max, a_min, .. } = self.problem;
        (Leg::new(v0, a0, v, a_min, a_max), Leg::new(ve, -ae, v, -a_max, -a_min))
    }

    /// What the changes of speed leave for the constant velocity.
    fn cruise(&self, v: f64) -> f64 {
        let (first, last) = self.legs(v);
        self.duration - first.duration() - last.duration()
    }

    fn displacement(&self, v: f64) -> f64 {
        let Problem { v0, a0, ve, ae, .. } = self.problem;
        let (first, last) = self.legs(v);
        let cruise = (self.duration - first.duration() - last.duration()).max(0.0);
        first.displacement(v0, a0) + v * cruise + last.displacement(ve, -ae)
    }

    fn phases(&self, v: f64) -> Phases {
        let (first, last) = self.legs(v);
        let mut phases: Phases = first.t.into_iter().zip(first.jerks()).collect();
        phases.push((self.cruise(v).max(0.0), 0.0));
        phases.extend(last.t.into_iter().zip(last.jerks()).rev());
        phases
    }

    /// Ranges of possible velocities, ascending.
    ///
    /// The time of the changes of speed grows outwards from the two settled velocities; between them it is
    /// concave, so what exceeds the duration there is one gap around its maximum.
    fn ranges(&self) -> SmallVec<[(f64, f64); 2]> {
        let Problem { v0, a0, ve, ae, v_max, v_min, .. } = self.problem;
        let (s0, se) = (settled_velocity(v0, a0), settled_velocity(ve, -ae));
        let (left, right) = (s0.min(se).clamp(v_min, v_max), s0.max(se).clamp(v_min, v_max));
        let fits = |v: f64| self.cruise(v) >= 0.0;
        let top = slowest(left, right, |v| self.cruise(v));
        let mut ranges = SmallVec::new();
        let upper = || bisect(right, v_max, fits);
        if fits(left) {
            let lo = bisect(left, v_min, fits);
            if fits(top) && fits(right) {
                ranges.push((lo, upper()));
                return ranges;
            }
            ranges.push((lo, bisect(left, top, fits)));
        }
        if fits(right) {
            ranges.push((bisect(right, top, fits), upper()));
        }
        ranges
    }
}

/// The point furthest from `from` towards `to` up to which `holds` is true; `to` if it is true there.
fn bisect(from: f64, to: f64, holds: impl Fn(f64) -> bool) -> f64 {
    if holds(to) {
        return to;
    }
    let (mut good, mut bad) = (from, to);
    for _ in 0..200 {
        let middle = 0.5 * (good + bad);
        if (middle - good).abs() <= f64::MIN_POSITIVE || (middle - bad).abs() <= f64::MIN_POSITIVE {
            break;
        }
        if holds(middle) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    good
}

/// Least point of a convex function on an interval, by thirds.
fn slowest(mut lo: f64, mut hi: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..100 {
        let third = (hi - lo) / 3.0;
        let (x, y) = (lo + third, hi - third);
        if f(x) < f(y) {
            hi = y;
        } else {
            lo = x;
        }
    }
    0.5 * (lo + hi)
}

/// Weighted mean of two profiles of equal duration.
fn blend(a: &Phases, b: &Phases, weight: f64) -> Phases {
    let mut phases = Phases::new();
    let (mut a, mut b) = (a.iter().copied(), b.iter().copied());
    let (mut left, mut right) = (a.next(), b.next());
    while let (Some((t, j)), Some((u, k))) = (left, right) {
        let step = t.min(u);
        phases.push((step, (1.0 - weight) * j + weight * k));
        left = if t > u { Some((t - u, j)) } else { a.next() };
        right = if u > t { Some((u - t, k)) } else { b.next() };
    }
    phases
}
