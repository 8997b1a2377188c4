//! Step 2: a profile of prescribed duration.
//!
//! First choice: a phase of constant velocity `v` between two independent changes of speed, each towards higher
//! or lower velocity, so both sign patterns (up-down-down-up, up-down-up-down) occur. For a fixed duration the
//! velocity at every instant, and with it the displacement, grows with `v`: where `v` is possible, bisection finds
//! it. Possible are the `v` whose changes of speed fit into the duration: at most two ranges, next to the two
//! velocities at which start and target settle.
//!
//! Displacements outside these ranges have no phase of constant velocity. The possible displacements are an interval
//! whose ends are either ends of the ranges or an extremal profile (`extremal`); in between, a blend of the two
//! nearest profiles is a solution: limits and equations are convex in the acceleration over time.

use super::candidate::{Candidate, UP_DOWN_DOWN_UP, displacement};
use super::leg::{Leg, settled_velocity};
use super::scaled::Problem;
use smallvec::SmallVec;

/// Phases (duration, jerk) in scaled units.
pub(super) type Phases = SmallVec<[(f64, f64); 16]>;

/// `None` if no profile lasts `duration`.
pub(super) fn with_duration(problem: &Problem, duration: f64) -> Option<Phases> {
    let family = Family { problem: *problem, duration };
    let Ranges { found, least_missing, most_missing } = family.ranges();
    let distance = problem.distance;
    let slack = 1e-12 * (distance.abs() + duration) + problem.distance_rounding;

    // solutions for smaller displacements than wanted
    let mut below = None;
    if least_missing && let Some(least) = extremal(&problem.mirrored(), duration) {
        below = Some((-least.0, least.1.mirrored().phases().collect()));
    }
    for (lo, hi) in found {
        let at_lo = family.displacement(lo);
        if at_lo > distance + slack {
            return blend(below?, (at_lo, family.phases(lo)), distance, slack);
        }
        let at_hi = family.displacement(hi);
        if at_hi >= distance - slack {
            let v = bisect(lo, hi, |v| family.displacement(v) <= distance);
            return Some(family.phases(v));
        }
        below = Some((at_hi, family.phases(hi)));
    }
    if !most_missing {
        return None;
    }
    let most = extremal(problem, duration)?;
    blend(below?, (most.0, most.1.phases().collect()), distance, slack)
}

/// The profile of largest displacement among those that last `duration`, as far as it has no phase of constant
/// velocity: acceleration rises as long as possible, falls, and rises to its final value at the end.
///
/// With the falling ramp on the line `c - t`, the gain of velocity grows with `c`.
fn extremal(problem: &Problem, duration: f64) -> Option<(f64, Candidate)> {
    let Problem { v0, a0, ve, ae, a_max, a_min, .. } = *problem;
    let times = |c: f64| {
        let peak = (0.5 * (c + a0)).min(a_max);
        let valley = (0.5 * (c - duration + ae)).max(a_min);
        let (rise, last) = (peak - a0, ae - valley);
        let (high, low) = (c - peak - rise, duration - last - (c - valley));
        [rise, high, peak - valley, 0.0, 0.0, low, last]
    };
    let gain = |t: &[f64; 7]| {
        let (mut v, mut a) = (0.0, a0);
        for (t, j) in t.iter().zip(&UP_DOWN_DOWN_UP) {
            v += t * (a + 0.5 * t * j);
            a += t * j;
        }
        v
    };
    let c = bisect(a0, ae + duration, |c| gain(&times(c)) <= ve - v0);
    let t = times(c);
    let distance = displacement(v0, a0, &t);
    let own = Problem { distance, ..*problem };
    Candidate::checked(&own, t).map(|found| (distance, found))
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

    /// Ranges of possible constant velocities.
    ///
    /// The time of the changes of speed grows outwards from the two settled velocities; between them it is
    /// concave, so what exceeds the duration there is one gap around its maximum.
    fn ranges(&self) -> Ranges {
        let Problem { v0, a0, ve, ae, v_max, v_min, .. } = self.problem;
        let (s0, se) = (settled_velocity(v0, a0), settled_velocity(ve, -ae));
        let (left, right) = (s0.min(se).clamp(v_min, v_max), s0.max(se).clamp(v_min, v_max));
        let fits = |v: f64| self.cruise(v) >= 0.0;
        let top = slowest(left, right, |v| self.cruise(v));
        let mut found = SmallVec::new();
        let (least_missing, most_missing) = (!fits(left), !fits(right));
        if !least_missing && !most_missing && fits(top) {
            found.push((bisect(left, v_min, fits), bisect(right, v_max, fits)));
        } else {
            if !least_missing {
                found.push((bisect(left, v_min, fits), bisect(left, top, fits)));
            }
            if !most_missing {
                found.push((bisect(right, top, fits), bisect(right, v_max, fits)));
            }
        }
        Ranges { found, least_missing, most_missing }
    }
}

/// Ranges of possible constant velocities, ascending, and whether the profiles of least and largest displacement
/// are outside of them.
struct Ranges {
    found: SmallVec<[(f64, f64); 2]>,
    least_missing: bool,
    most_missing: bool,
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

/// The weighted mean of two profiles of equal duration, given with their displacements, that has displacement
/// `distance`.
fn blend(below: (f64, Phases), above: (f64, Phases), distance: f64, slack: f64) -> Option<Phases> {
    if distance < below.0 - slack || distance > above.0 + slack {
        return None;
    }
    let span = above.0 - below.0;
    let weight = if span > 0.0 { ((distance - below.0) / span).clamp(0.0, 1.0) } else { 0.0 };
    let mut phases = Phases::new();
    let (mut a, mut b) = (below.1.into_iter(), above.1.into_iter());
    let (mut left, mut right) = (a.next(), b.next());
    while let (Some((t, j)), Some((u, k))) = (left, right) {
        let step = t.min(u);
        phases.push((step, (1.0 - weight) * j + weight * k));
        left = if t > u { Some((t - u, j)) } else { a.next() };
        right = if u > t { Some((u - t, k)) } else { b.next() };
    }
    Some(phases)
}
