//! A possible solution, and the check that every solution has to pass.

use super::scaled::Problem;

/// Jerk of the seven phases of a profile towards higher positions.
const UP_DOWN_DOWN_UP: [f64; 7] = [1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0];

/// Tolerance for rounding of the final velocity and of limits, in the units of the problem.
const ROUNDING: f64 = 1e-12;

/// Error of the final displacement, relative to the distance travelled. Solved candidates are far better; a
/// single bump of acceleration has no freedom left to meet a position that is itself rounded.
const DISTANCE_ERROR: f64 = 1e-10;

/// Error of the final displacement relative to the terms of its sum, which may cancel.
const CANCELLATION: f64 = 1e-13;

const SIXTH: f64 = 1.0 / 6.0;

/// Seven phases in scaled units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    t: [f64; 7],
    /// Jerk of the first ramp, `+1` or `-1` in the mirror image.
    sign: f64,
    pub(super) duration: f64,
}

/// Acceleration after a phase. A residue of a ramp to zero is rounding and would add up over a long cruise.
fn ramped(a: f64, change: f64) -> f64 {
    let next = a + change;
    if next.abs() <= 1e-14 * change.abs() { 0.0 } else { next }
}

/// Displacement from velocity `v`, acceleration `a` over the phases `t`, the first of up to seven.
pub(super) fn displacement<const N: usize>(mut v: f64, mut a: f64, t: &[f64; N]) -> f64 {
    let mut s = 0.0;
    for (t, j) in t.iter().zip(UP_DOWN_DOWN_UP) {
        s += t * (v + t * (0.5 * a + t * j * SIXTH));
        v += t * (a + 0.5 * t * j);
        a = ramped(a, t * j);
    }
    s
}

impl Candidate {
    /// Integrates the phases and compares with the problem: times not negative, final state met, limits kept.
    ///
    /// Velocity limits apply from the moment the velocity is inside, since a brake may have to end earlier; until then
    /// the velocity must not move further out.
    pub(super) fn checked(problem: &Problem, mut t: [f64; 7]) -> Option<Self> {
        let total: f64 = t.iter().map(|t| t.abs()).sum();
        let least = -ROUNDING * (1.0 + total);
        // written so that NaN fails
        if !t.iter().all(|t| *t >= least) {
            return None;
        }
        t = t.map(|t| t.max(0.0));
        let (mut s, mut v, mut a) = (0.0, problem.v0, problem.a0);
        let (mut travelled, mut terms, mut kept) = (0.0, 0.0, true);
        let excess = ROUNDING * (1.0 + problem.v_max.min(1.0));
        let (top, bottom) = (problem.v_max + excess, problem.v_min - excess);
        // until the velocity is inside for the first time
        let (mut highest, mut lowest) = (top.max(v), bottom.min(v));
        for (i, j) in [1.0, -1.0, -1.0, 1.0].into_iter().enumerate() {
            if v <= top && v >= bottom {
                (highest, lowest) = (top, bottom);
            }
            let ramp = t[2 * i];
            let change = ramp * j;
            let next = ramped(a, change);
            if a * next < 0.0 {
                let extreme = v - 0.5 * a * a * j;
                kept &= extreme <= highest && extreme >= lowest;
            }
            let ds = ramp * (v + ramp * (0.5 * a + SIXTH * change));
            terms += ramp * (v.abs() + ramp * (0.5 * a.abs() + SIXTH * ramp));
            travelled += ds.abs();
            s += ds;
            v += ramp * (a + 0.5 * change);
            a = next;
            kept &= v <= highest && v >= lowest;
            kept &= a <= problem.a_max + ROUNDING && a >= problem.a_min - ROUNDING;
            let Some(&hold) = t.get(2 * i + 1) else { continue };
            if hold > 0.0 {
                if v <= top && v >= bottom {
                    (highest, lowest) = (top, bottom);
                }
                let ds = hold * (v + 0.5 * hold * a);
                terms += hold * (v.abs() + 0.5 * hold * a.abs());
                travelled += ds.abs();
                s += ds;
                v += hold * a;
                kept &= v <= highest && v >= lowest;
            }
        }
        let slack = DISTANCE_ERROR * (travelled + problem.distance.abs())
            + CANCELLATION * terms
            + problem.distance_rounding;
        let met = (s - problem.distance).abs() <= slack
            && (v - problem.ve).abs() <= excess
            && (a - problem.ae).abs() <= ROUNDING * (1.0 + total);
        (kept && met).then(|| Self { t, sign: 1.0, duration: t.iter().sum() })
    }

    /// Duration and jerk of every phase.
    pub(super) fn phases(&self) -> impl Iterator<Item = (f64, f64)> {
        let sign = self.sign;
        self.t.into_iter().zip(UP_DOWN_DOWN_UP).map(move |(t, j)| (t, sign * j))
    }

    /// The same phases in mirrored space.
    pub(super) fn mirrored(mut self) -> Self {
        self.sign = -self.sign;
        self
    }

    /// The same phases reversed and mirrored; the jerks are the same in both cases.
    pub(super) fn reversed(mut self) -> Self {
        self.t.reverse();
        self
    }
}
