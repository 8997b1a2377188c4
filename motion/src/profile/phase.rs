//! A phase: a part of a motion in which the acceleration follows one ramp or is constant.

use super::ramp::{RampShape, RampState};
use super::roots::increasing_root;
use std::f64::consts::FRAC_1_PI;

/// Relative size of the last step to a root; the error is its square.
const ROOT: f64 = 1e-9;

/// State of the path coordinate at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Path length since the start of the profile in mm.
    pub s_mm: f64,
    /// Path velocity in mm/s.
    pub v_mm_s: f64,
    /// Path acceleration in mm/s2.
    pub a_mm_s2: f64,
    /// Path jerk in mm/s3; 0 where the acceleration jumps.
    pub j_mm_s3: f64,
}

/// A phase in which the acceleration follows one ramp or is constant, from its state at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Phase {
    /// Path length at the start in mm.
    pub(crate) s: f64,
    /// Velocity there in mm/s.
    pub(crate) v: f64,
    /// Acceleration there in mm/s2.
    pub(crate) a: f64,
    /// Jerk in mm/s3; for a sine-square ramp the mean jerk.
    pub(crate) j: f64,
    /// Duration in s.
    pub(crate) t: f64,
    /// The sine-square ramp of which this is a part; `None`: constant jerk.
    sine: Option<Sine>,
}

/// Position of a phase on a sine-square ramp.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sine {
    /// Time of the ramp before the start of the phase in s.
    skip: f64,
    /// Duration of the ramp in s.
    whole: f64,
}

impl Phase {
    /// A state, as a phase without duration.
    pub(crate) fn state(s: f64, v: f64, a: f64) -> Self {
        Self { s, v, a, j: 0.0, t: 0.0, sine: None }
    }

    /// From a state along a whole ramp with this (mean) jerk.
    pub(crate) fn ramp(self, shape: RampShape, j: f64, t: f64) -> Self {
        let curved = shape == RampShape::Sin2 && j != 0.0 && t > 0.0;
        Self { j, t, sine: curved.then_some(Sine { skip: 0.0, whole: t }), ..self }
    }

    /// The state `t` s after the start, as the start of a phase without duration.
    #[inline]
    pub(crate) fn after(&self, t: f64) -> Self {
        let (way, v, a) = self.way_after(t);
        Self::state(self.s + way, v, a)
    }

    /// Path length travelled in the first `t` s, and velocity and acceleration after them.
    #[inline]
    fn way_after(&self, t: f64) -> (f64, f64, f64) {
        match self.sine {
            None => self.way_at_constant_jerk(t),
            Some(sine) => self.way_on_ramp(sine, t),
        }
    }

    #[inline]
    fn way_at_constant_jerk(&self, t: f64) -> (f64, f64, f64) {
        let Self { v, a, j, .. } = *self;
        let way = t * (v + t * (0.5 * a + t * j / 6.0));
        (way, v + t * (a + 0.5 * t * j), a + t * j)
    }

    fn way_on_ramp(&self, sine: Sine, t: f64) -> (f64, f64, f64) {
        let (from, to) = (self.on_ramp(sine, 0.0), self.on_ramp(sine, t));
        let base = self.a - from.a;
        let way = t * (self.v - from.v + 0.5 * t * base) + (to.s - from.s);
        (way, self.v + t * base + (to.v - from.v), base + to.a)
    }

    fn on_ramp(&self, sine: Sine, t: f64) -> RampState {
        let x = (sine.skip + t).clamp(0.0, sine.whole);
        RampShape::Sin2.rise(self.j * sine.whole, sine.whole, x)
    }

    /// The state `t` s after the start, a time outside the phase counting as its start or end; rounding must not lead beyond
    /// the path length `ahead` at which the next phase begins, nor backwards at a stop.
    #[inline]
    pub(super) fn state_after(&self, t: f64, ahead: f64) -> State {
        let t = t.clamp(0.0, self.t);
        let (way, v, a) = self.way_after(t);
        State {
            s_mm: (self.s + way).min(ahead),
            v_mm_s: v.max(0.0),
            a_mm_s2: a,
            j_mm_s3: self.jerk_after(t),
        }
    }

    #[inline]
    pub(crate) fn end(&self) -> Self {
        self.after(self.t)
    }

    /// The same phase from another path length on.
    pub(super) fn placed_at(self, s: f64) -> Self {
        Self { s, ..self }
    }

    /// The first `t` s of the phase.
    pub(crate) fn until(self, t: f64) -> Self {
        Self { t, ..self }
    }

    /// The remainder of the phase `t` s after its start.
    pub(crate) fn rest(&self, t: f64) -> Self {
        let sine = self.sine.map(|s| Sine { skip: s.skip + t, ..s });
        Self { j: self.j, t: self.t - t, sine, ..self.after(t) }
    }

    /// The phase reversed in time and direction, measured from the other end of `length` mm.
    pub(crate) fn reversed(&self, length: f64) -> Self {
        let end = self.end();
        let sine = self.sine.map(|s| Sine { skip: s.whole - s.skip - self.t, ..s });
        Self { s: length - end.s, v: end.v, a: -end.a, sine, ..*self }
    }

    /// Whether the acceleration follows a sine-square ramp.
    pub(super) fn is_curved(&self) -> bool {
        self.sine.is_some()
    }

    /// Jerk in mm/s3 `t` s after the start.
    pub(super) fn jerk_after(&self, t: f64) -> f64 {
        self.sine.map_or(self.j, |sine| self.on_ramp(sine, t).j)
    }

    /// Time in `0..=t` at which `s` is reached; the velocity must not be negative.
    pub(crate) fn time_at(&self, s: f64) -> f64 {
        let want = s - self.s;
        if want <= 0.0 {
            return 0.0;
        }
        let whole = self.way_after(self.t).0;
        if want >= whole {
            return self.t;
        }
        if self.j == 0.0 {
            let Self { v, a, .. } = *self;
            return (2.0 * want / (v + (v * v + 2.0 * a * want).max(0.0).sqrt())).min(self.t);
        }
        let (most, guess) = (self.t, self.t * want / whole);
        let short = |(way, v, _): (f64, f64, f64)| {
            #[cfg(test)]
            crate::closed_forms::add();
            (way - want, v)
        };
        // branch on the kind of ramp once, not in every step
        match self.sine {
            None => {
                increasing_root(0.0, most, guess, ROOT, |t| short(self.way_at_constant_jerk(t)))
            }
            Some(sine) => {
                increasing_root(0.0, most, guess, ROOT, |t| short(self.way_on_ramp(sine, t)))
            }
        }
    }

    /// The point inside the phase at which the acceleration passes through zero.
    pub(super) fn turn(&self) -> Option<Self> {
        let turn = match self.sine {
            None => -self.a / self.j,
            Some(sine) => {
                // a + da (sin2(z) - sin2(z at the start)) = 0
                let ratio = (self.on_ramp(sine, 0.0).a - self.a) / (self.j * sine.whole);
                2.0 * sine.whole * FRAC_1_PI * libm::asin(ratio.max(0.0).sqrt()) - sine.skip
            }
        };
        (turn > 0.0 && turn < self.t).then(|| self.after(turn))
    }

    /// Highest velocity of the phase.
    pub(crate) fn peak(&self) -> f64 {
        let ends = self.v.max(self.end().v);
        self.turn().map_or(ends, |turn| ends.max(turn.v))
    }

    /// Lowest velocity of the phase.
    pub(crate) fn lowest(&self) -> f64 {
        let ends = self.v.min(self.end().v);
        self.turn().map_or(ends, |turn| ends.min(turn.v))
    }
}
