//! Fastest change to a velocity with zero acceleration, jerk 1.

use super::candidate::ramped;

/// Times of the three phases and the sign of the jerk in the first: `+1` raises the velocity at zero
/// acceleration, `-1` lowers it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    pub(super) t: [f64; 3],
    pub(super) sign: f64,
}

/// Velocity that remains when acceleration `a` is reduced to zero at once.
pub(super) fn settled_velocity(v: f64, a: f64) -> f64 {
    v + 0.5 * a * a.abs()
}

impl Leg {
    /// From `(v0, a0)` to `(v1, 0)` within accelerations `a_min..=a_max`.
    pub(super) fn new(v0: f64, a0: f64, v1: f64, a_min: f64, a_max: f64) -> Self {
        if v1 >= settled_velocity(v0, a0) {
            Self { t: rising(v1 - v0, a0, a_max), sign: 1.0 }
        } else {
            Self { t: rising(v0 - v1, -a0, -a_min), sign: -1.0 }
        }
    }

    pub(super) fn duration(&self) -> f64 {
        self.t.iter().sum()
    }

    pub(super) fn jerks(&self) -> [f64; 3] {
        [self.sign, 0.0, -self.sign]
    }

    /// Displacement from velocity `v0`, acceleration `a0`.
    pub(super) fn displacement(&self, v0: f64, a0: f64) -> f64 {
        let (mut s, mut v, mut a) = (0.0, v0, a0);
        for (t, j) in self.t.into_iter().zip(self.jerks()) {
            s += t * (v + t * (0.5 * a + t * j / 6.0));
            v += t * (a + 0.5 * t * j);
            a = ramped(a, t * j);
        }
        s
    }
}

/// Phases that gain `gain` from acceleration `a0`: up to a peak, stay there if it is the limit, down to zero.
///
/// Triangle: `peak² - a0²/2 = gain`.
pub(super) fn rising(gain: f64, a0: f64, a_max: f64) -> [f64; 3] {
    let square = gain + 0.5 * a0 * a0;
    let peak = square.max(0.0).sqrt();
    if peak <= a0 {
        // nothing to gain: straight down; the time is that of `a0` so that exactly zero is left
        [0.0, 0.0, a0.max(0.0)]
    } else if peak <= a_max {
        [peak - a0, 0.0, peak]
    } else {
        [(a_max - a0).max(0.0), (square - a_max * a_max) / a_max, a_max]
    }
}
