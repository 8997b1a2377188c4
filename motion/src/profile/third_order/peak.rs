//! Profiles through a peak velocity at zero acceleration: the common case, solved without trial.
//!
//! The changes of speed up to the peak and down from it are independent, and the displacement of both is a closed form
//! of the peak velocity `v`. It increases with `v` (close to a reversal it may decrease first, but then crosses the
//! wanted one only once). Comparing it at the velocities where a limit takes effect therefore shows which limits are
//! reached, and only the equation of that case is solved.

use super::scaled::{Problem, settled_velocity};
use crate::profile::roots::increasing_root;

/// Change of speed from a boundary state to a peak velocity `v` with zero acceleration.
///
/// Without plateau the peak of the acceleration `a` follows from `v = base + a²`, and the displacement is
/// `a³ + 2 base a - offset`; with plateau it is `v²/(2 limit) + limit v/2 + plateau_offset`.
#[derive(Clone, Copy, Debug)]
struct Rise {
    a0: f64,
    limit: f64,
    base: f64,
    offset: f64,
    plateau_offset: f64,
}

impl Rise {
    fn new(v0: f64, a0: f64, limit: f64) -> Self {
        let base = v0 - 0.5 * a0 * a0;
        let offset = a0 * (base + a0 * a0 / 6.0);
        let plateau_offset = 0.5 * base * (limit - base / limit) - offset;
        Self { a0, limit, base, offset, plateau_offset }
    }

    /// Peak velocity above which the acceleration stays at its limit for some time.
    fn plateau_velocity(&self) -> f64 {
        self.base + self.limit * self.limit
    }

    fn displacement(&self, v: f64) -> f64 {
        if v > self.plateau_velocity() {
            0.5 * v * (v / self.limit + self.limit) + self.plateau_offset
        } else {
            let a = (v - self.base).max(0.0).sqrt();
            a * (a * a + 2.0 * self.base) - self.offset
        }
    }

    /// Ramp, plateau and ramp to zero if the acceleration reaches `a` without plateau.
    fn ramps(&self, a: f64) -> [f64; 3] {
        [a - self.a0, 0.0, a]
    }

    /// The same with plateau.
    fn plateau(&self, v: f64) -> [f64; 3] {
        let limit = self.limit;
        [limit - self.a0, (v - self.base) / limit - limit, limit]
    }

    fn to_velocity(self, v: f64) -> [f64; 3] {
        if v > self.plateau_velocity() {
            self.plateau(v)
        } else {
            // no velocity to gain: straight down; the time is that of `a0` so that exactly zero remains
            self.ramps((v - self.base).max(0.0).sqrt().max(self.a0))
        }
    }
}

/// All profiles of a problem towards higher positions that pass a peak velocity.
pub(super) struct Peak {
    distance: f64,
    v_max: f64,
    lowest: f64,
    up: Rise,
    down: Rise,
}

impl Peak {
    /// `None` if the peak velocity cannot be inside its limit.
    pub(super) fn new(problem: &Problem) -> Option<Self> {
        let Problem { distance, v0, a0, ve, ae, v_max, a_max, a_min, .. } = *problem;
        // there are no profiles with a peak below the settled velocities
        let lowest = settled_velocity(v0, a0).max(settled_velocity(ve, -ae));
        let allowed = lowest <= v_max * (1.0 + 1e-12) + 1e-12;
        let (up, down) = (Rise::new(v0, a0, a_max), Rise::new(ve, -ae, -a_min));
        allowed.then_some(Self { distance, v_max, lowest, up, down })
    }

    /// Phases of the profile with the wanted displacement, which is not below that of the fastest change of velocity;
    /// `None` if it is below that of the lowest peak.
    pub(super) fn times(&self) -> Option<[f64; 7]> {
        let Self { up, down, .. } = self;
        let missing = |v: f64| self.distance - up.displacement(v) - down.displacement(v);
        let (mut lo, mut hi) = (self.lowest, self.v_max);
        let cruise = missing(hi);
        if cruise >= 0.0 {
            return (hi > 0.0).then(|| self.cruise(cruise));
        }
        // otherwise the lowest peak belongs to the fastest change of velocity, which the caller has compared with
        let compare = up.a0 < 0.0 || down.a0 < 0.0;
        if compare && missing(lo) < 0.0 {
            return None;
        }
        let plateaus = [up.plateau_velocity(), down.plateau_velocity()];
        for v in plateaus {
            if v > lo && v < hi {
                *(if missing(v) >= 0.0 { &mut lo } else { &mut hi }) = v;
            }
        }
        let [up_holds, down_holds] = plateaus.map(|v| v <= lo);
        let (first, last) = match (up_holds, down_holds) {
            (true, true) => {
                let v = self.both_limits();
                (up.plateau(v), down.plateau(v))
            }
            (true, false) => {
                let a = one_limit(up, down, self.distance, lo, hi);
                (up.plateau(down.base + a * a), down.ramps(a))
            }
            (false, true) => {
                let a = one_limit(down, up, self.distance, lo, hi);
                (up.ramps(a), down.plateau(up.base + a * a))
            }
            (false, false) => {
                let (a, b) = self.no_limit(lo, hi);
                (up.ramps(a), down.ramps(b))
            }
        };
        Some(joined(first, 0.0, last))
    }

    /// At the highest velocity, for a distance.
    fn cruise(&self, distance: f64) -> [f64; 7] {
        let [first, last] = [self.up, self.down].map(|rise| rise.to_velocity(self.v_max));
        // the rounded value of the limit: over a long cruise the difference would matter
        let Rise { a0, base, .. } = self.up;
        let [t0, t1, t2] = first;
        let a1 = a0 + t0;
        let reached = base + 0.5 * a1 * a1 + t1 * a1 + t2 * (a1 - 0.5 * t2);
        joined(first, distance / reached, last)
    }

    /// Peak velocity with both plateaus: the upper root of a quadratic.
    fn both_limits(&self) -> f64 {
        let Self { up, down, .. } = self;
        let a = 0.5 / up.limit + 0.5 / down.limit;
        let b = 0.5 * (up.limit + down.limit);
        let c = up.plateau_offset + down.plateau_offset - self.distance;
        // avoids a difference of nearly equal numbers
        -2.0 * c / (b + (b * b - 4.0 * a * c).max(0.0).sqrt())
    }

    /// Peaks of the acceleration if none reaches its limit, from their sum `x` and the difference `d/x` of their
    /// squares: `x³/4 + s x - d²/(4x)` is the displacement without the offsets.
    fn no_limit(&self, lo: f64, hi: f64) -> (f64, f64) {
        let Self { up, down, .. } = self;
        let (d, s) = (down.base - up.base, up.base + down.base);
        let wanted = self.distance + up.offset + down.offset;
        let sum = |v: f64| (v - up.base).max(0.0).sqrt() + (v - down.base).max(0.0).sqrt();
        let (lo, hi) = (sum(lo), sum(hi));
        let x = increasing_root(lo, hi, hi, 1e-8, |x| {
            let r = d / x;
            let q = 0.25 * r * r;
            let p = 0.25 * x * x;
            (x * (p + s - q) - wanted, 3.0 * p + s + q)
        });
        let r = d / x;
        (0.5 * (x + r), 0.5 * (x - r))
    }
}

/// Peak of the acceleration of `free` while `held` is at its limit.
fn one_limit(held: &Rise, free: &Rise, distance: f64, lo: f64, hi: f64) -> f64 {
    let a_at = |v: f64| (v - free.base).max(0.0).sqrt();
    let (lo, hi) = (a_at(lo), a_at(hi));
    let (limit, base) = (held.limit, free.base);
    let wanted = distance - held.plateau_offset + free.offset;
    increasing_root(lo, hi, hi, 1e-8, |a| {
        let v = base + a * a;
        let w = v / limit;
        let held = 0.5 * v * (w + limit);
        let slope = 2.0 * a * (w + 0.5 * limit) + 3.0 * a * a + 2.0 * base;
        (held + a * (a * a + 2.0 * base) - wanted, slope)
    })
}

fn joined([t0, t1, t2]: [f64; 3], cruise: f64, [t6, t5, t4]: [f64; 3]) -> [f64; 7] {
    [t0, t1, t2, cruise, t4, t5, t6]
}
