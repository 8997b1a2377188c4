//! A possible solution, and the check every solution has to pass.

use super::scaled::Problem;

/// Jerk of the seven phases of a profile towards higher positions.
pub(super) const UP_DOWN_DOWN_UP: [f64; 7] = [1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0];

/// Error of the final velocity and excess over limits that is rounding, in the problem's units.
const ROUNDING: f64 = 1e-12;

/// Error of the final displacement, relative to the distance travelled. Solved candidates are far better; a
/// single bump of acceleration has no freedom left to meet a position that is itself rounded.
const DISTANCE_ERROR: f64 = 1e-10;

/// Error of the final displacement, relative to the terms it is the sum of; they may cancel.
const CANCELLATION: f64 = 1e-13;

/// Seven phases in scaled units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) t: [f64; 7],
    pub(super) j: [f64; 7],
    pub(super) duration: f64,
}

/// Acceleration after a phase; what is left of a ramp to zero is rounding, and would add up over a long cruise.
pub(super) fn ramped(a: f64, change: f64) -> f64 {
    let next = a + change;
    if next.abs() <= 1e-14 * change.abs() { 0.0 } else { next }
}

/// Displacement from velocity `v`, acceleration `a` over phases of jerk `j`.
pub(super) fn displacement(mut v: f64, mut a: f64, t: &[f64; 7], j: &[f64; 7]) -> f64 {
    let mut s = 0.0;
    for (t, j) in t.iter().zip(j) {
        s += t * (v + t * (0.5 * a + t * j / 6.0));
        v += t * (a + 0.5 * t * j);
        a = ramped(a, t * j);
    }
    s
}

impl Candidate {
    /// Integrates the phases and compares with the problem: times not negative, final state met, limits kept.
    ///
    /// Velocity limits hold from the moment the velocity is inside: a brake may have
    /// to end before; until then it must not move further out.
    pub(super) fn checked(problem: &Problem, mut t: [f64; 7], j: [f64; 7]) -> Option<Self> {
        let total: f64 = t.iter().map(|t| t.abs()).sum();
        let least = -ROUNDING * (1.0 + total);
        for t in &mut t {
            if t.is_nan() || *t < least {
                return None;
            }
            *t = t.max(0.0);
        }
        let (mut s, mut v, mut a) = (0.0, problem.v0, problem.a0);
        let (mut travelled, mut terms, mut kept) = (0.0, 0.0, true);
        let excess = ROUNDING * (1.0 + problem.v_max.min(1.0));
        let (top, bottom) = (problem.v_max + excess, problem.v_min - excess);
        let mut inside = false;
        for (&t, &j) in t.iter().zip(&j) {
            if t == 0.0 {
                continue;
            }
            inside |= v <= top && v >= bottom;
            let allowed = |v: f64| {
                if inside {
                    v <= top && v >= bottom
                } else {
                    v <= top.max(problem.v0) && v >= bottom.min(problem.v0)
                }
            };
            let ds = t * (v + t * (0.5 * a + t * j / 6.0));
            let next = ramped(a, t * j);
            if a * next < 0.0 {
                kept &= allowed(v - 0.5 * a * a / j);
            }
            travelled += ds.abs();
            terms += t * (v.abs() + t * (0.5 * a.abs() + t * j.abs() / 6.0));
            s += ds;
            v += t * (a + 0.5 * t * j);
            a = next;
            kept &= allowed(v) && a <= problem.a_max + ROUNDING && a >= problem.a_min - ROUNDING;
        }
        let slack = DISTANCE_ERROR * (travelled + problem.distance.abs())
            + CANCELLATION * terms
            + problem.distance_rounding;
        let met = (s - problem.distance).abs() <= slack
            && (v - problem.ve).abs() <= excess
            && (a - problem.ae).abs() <= ROUNDING * (1.0 + total);
        (kept && met).then(|| Self { t, j, duration: t.iter().sum() })
    }

    /// The same phases in mirrored space.
    pub(super) fn mirrored(mut self) -> Self {
        self.j = self.j.map(|j| -j);
        self
    }

    /// The same phases run backwards and mirrored.
    pub(super) fn reversed(mut self) -> Self {
        self.t.reverse();
        self.j.reverse();
        self
    }
}
