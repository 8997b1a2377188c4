//! The problem in units in which the jerk is 1 and the states are of order 1.

use super::task::{MotionState, ThirdOrderLimits};

/// Units of time and length: `jerk · time³ = length`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    pub(super) time: f64,
    pub(super) velocity: f64,
    pub(super) acceleration: f64,
    pub(super) length: f64,
}

impl Units {
    /// The time in which the jerk alone produces the largest of all given differences; `None` if there is none.
    pub(super) fn of(start: &MotionState, end: &MotionState, jerk: f64) -> Option<Self> {
        let distance = (end.p_mm - start.p_mm).abs();
        let velocity = start.v_mm_s.abs().max(end.v_mm_s.abs());
        let acceleration = start.a_mm_s2.abs().max(end.a_mm_s2.abs());
        let time =
            rough_cbrt(distance / jerk).max((velocity / jerk).sqrt()).max(acceleration / jerk);
        let acceleration = jerk * time;
        let velocity = acceleration * time;
        (time > 0.0).then_some(Self { time, velocity, acceleration, length: velocity * time })
    }
}

/// Cube root within 6 %, from a third of the exponent; a unit need not be exact.
fn rough_cbrt(x: f64) -> f64 {
    // two thirds of the bits of 1.0, less a correction that balances the error within an octave
    const OFFSET: u64 = 0x2a9f_7893_782d_a1ce;
    if x > 0.0 { f64::from_bits(x.to_bits() / 3 + OFFSET) } else { 0.0 }
}

/// Velocity that remains when acceleration `a` is reduced to zero at once, with jerk 1.
pub(super) fn settled_velocity(v: f64, a: f64) -> f64 {
    v + 0.5 * a * a.abs()
}

/// Displacement, boundary states and limits with jerk 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Problem {
    pub(super) distance: f64,
    pub(super) v0: f64,
    pub(super) a0: f64,
    pub(super) ve: f64,
    pub(super) ae: f64,
    pub(super) v_max: f64,
    pub(super) v_min: f64,
    pub(super) a_max: f64,
    pub(super) a_min: f64,
    /// Rounding error of the displacement, from the magnitude of the positions.
    pub(super) distance_rounding: f64,
}

impl Problem {
    pub(super) fn new(
        start: &MotionState,
        end: &MotionState,
        limits: &ThirdOrderLimits,
        units: &Units,
    ) -> Self {
        let size = start.p_mm.abs().max(end.p_mm.abs());
        let [length, velocity, acceleration] =
            [units.length, units.velocity, units.acceleration].map(f64::recip);
        Self {
            distance: (end.p_mm - start.p_mm) * length,
            v0: start.v_mm_s * velocity,
            a0: start.a_mm_s2 * acceleration,
            ve: end.v_mm_s * velocity,
            ae: end.a_mm_s2 * acceleration,
            v_max: limits.v_max_mm_s * velocity,
            v_min: limits.v_min_mm_s * velocity,
            a_max: limits.a_max_mm_s2 * acceleration,
            a_min: limits.a_min_mm_s2 * acceleration,
            distance_rounding: 4.0 * f64::EPSILON * size * length,
        }
    }

    /// The mirror image: positions change sign.
    pub(super) fn mirrored(&self) -> Self {
        Self {
            distance: -self.distance,
            v0: -self.v0,
            a0: -self.a0,
            ve: -self.ve,
            ae: -self.ae,
            v_max: -self.v_min,
            v_min: -self.v_max,
            a_max: -self.a_min,
            a_min: -self.a_max,
            ..*self
        }
    }

    /// The same motion reversed and mirrored: displacement, velocities and jerks keep their sign.
    pub(super) fn reversed(&self) -> Self {
        Self {
            v0: self.ve,
            a0: -self.ae,
            ve: self.v0,
            ae: -self.a0,
            a_max: -self.a_min,
            a_min: -self.a_max,
            ..*self
        }
    }
}
