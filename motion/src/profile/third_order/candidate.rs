//! A possible solution, and the check every solution has to pass.

use super::scaled::Problem;

/// Jerk of the seven phases of a profile towards higher positions.
pub(super) const UP_DOWN_DOWN_UP: [f64; 7] = [1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0];

/// Error of the final velocity and excess over limits that is rounding, in the problem's units.
const ROUNDING: f64 = 1e-12;

/// Error of the final displacement, relative to the distance travelled.
const DISTANCE_ERROR: f64 = 1e-12;

/// Seven phases in scaled units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) t: [f64; 7],
    pub(super) j: [f64; 7],
    pub(super) duration: f64,
}

/// Displacement from velocity `v`, acceleration `a` over phases of jerk `j`.
pub(super) fn displacement(mut v: f64, mut a: f64, t: &[f64; 7], j: &[f64; 7]) -> f64 {
    let mut s = 0.0;
    for (t, j) in t.iter().zip(j) {
        s += t * (v + t * (0.5 * a + t * j / 6.0));
        v += t * (a + 0.5 * t * j);
        a += t * j;
    }
    s
}

impl Candidate {
    /// Integrates the phases and compares with the problem: times not negative, final state met, limits kept.
    ///
    /// The start is exempt from the velocity limits: it may lie on its way back from the brake.
    pub(super) fn checked(problem: &Problem, mut t: [f64; 7], j: [f64; 7]) -> Option<Self> {
        let total: f64 = t.iter().map(|t| t.abs()).sum();
        let least = -ROUNDING * (1.0 + total);
        for t in &mut t {
            // written so that NaN fails
            if !(*t >= least) {
                return None;
            }
            *t = t.max(0.0);
        }
        let (mut s, mut v, mut a) = (0.0, problem.v0, problem.a0);
        let (mut travelled, mut v_high, mut v_low) = (0.0, v, v);
        let (mut a_high, mut a_low) = (problem.ae, problem.ae);
        for (i, (&t, &j)) in t.iter().zip(&j).enumerate() {
            if t == 0.0 {
                continue;
            }
            let ds = t * (v + t * (0.5 * a + t * j / 6.0));
            let dv = t * (a + 0.5 * t * j);
            let next = a + t * j;
            if a * next < 0.0 && i > 0 {
                let extreme = v - 0.5 * a * a / j;
                v_high = v_high.max(extreme);
                v_low = v_low.min(extreme);
            }
            travelled += ds.abs();
            s += ds;
            v += dv;
            a = next;
            a_high = a_high.max(a);
            a_low = a_low.min(a);
            if i > 0 {
                v_high = v_high.max(v);
                v_low = v_low.min(v);
            }
        }
        let v_excess = ROUNDING * (1.0 + v_high.abs().max(v_low.abs()));
        let kept = v_high <= problem.v_max.max(problem.v0) + v_excess
            && v_low >= problem.v_min.min(problem.v0) - v_excess
            && a_high <= problem.a_max + ROUNDING
            && a_low >= problem.a_min - ROUNDING;
        let met = (s - problem.distance).abs()
            <= DISTANCE_ERROR * (travelled + problem.distance.abs()) + problem.distance_rounding
            && (v - problem.ve).abs() <= v_excess
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
