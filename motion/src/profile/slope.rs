//! Limits of the path speed over one span, and the functions of them that the look-ahead uses.

use super::fit::{Infeasible, add_rounding_down};
use super::ramped::RampedLimits;
use super::row::Profile;
use super::step::StepLimits;

/// Bisection steps for the speed at which the acceleration is zero between two legs of braking.
const HALVINGS: u32 = 50;
/// Relative difference of speeds that cannot be due to rounding.
const CLEARLY: f64 = 1e-9;

/// Path limits of one span: how its velocity may change.
///
/// All velocities are `>= 0` in mm/s (deg/s), lengths in mm (deg).
#[derive(Clone, Debug, PartialEq)]
pub enum SlopeLimits {
    /// STEP: acceleration jumps, levels by velocity.
    Step(StepLimits),
    /// TRAPEZ and SIN2: acceleration changes in ramps.
    Ramped(RampedLimits),
}

impl SlopeLimits {
    /// Length of the speed-up from `v0` to `v1 >= v0`.
    pub fn up_distance(&self, v0: f64, v1: f64) -> f64 {
        match self {
            Self::Step(l) => l.up().distance(v0, v1),
            Self::Ramped(l) => l.up().distance(v0, v1 - v0),
        }
    }

    /// Length of the braking from `v1` to `ve <= v1`.
    pub fn down_distance(&self, v1: f64, ve: f64) -> f64 {
        match self {
            Self::Step(l) => l.down().distance(ve, v1),
            Self::Ramped(l) => l.down().distance(ve, v1 - ve),
        }
    }

    /// Duration in s of the speed-up from `v0` to `v1 >= v0`.
    pub fn up_time(&self, v0: f64, v1: f64) -> f64 {
        match self {
            Self::Step(l) => l.up().duration(v0, v1),
            Self::Ramped(l) => l.up().duration(v1 - v0),
        }
    }

    /// Duration in s of the braking from `v1` to `ve <= v1`.
    pub fn down_time(&self, v1: f64, ve: f64) -> f64 {
        match self {
            Self::Step(l) => l.down().duration(ve, v1),
            Self::Ramped(l) => l.down().duration(v1 - ve),
        }
    }

    /// Largest velocity that can be reached from `v0` within `length`.
    ///
    /// With constant ramp time any change of speed takes at least both ramps; on a shorter length the result is `v0`.
    pub fn reach_up(&self, v0: f64, length: f64) -> f64 {
        match self {
            Self::Step(l) => l.up().reach(v0, length),
            Self::Ramped(l) => add_rounding_down(v0, l.up().reach(v0, length)),
        }
    }

    /// Largest velocity from which braking to `ve` fits into `length`.
    ///
    /// Increases with `length` but, with ramps, not always with `ve`: the acceleration has to be zero at `ve`, so
    /// braking to a very low speed can take longer than braking to rest. Lowering one boundary velocity of a plan can
    /// therefore make its neighbours infeasible, and both passes of the look-ahead have to be repeated.
    pub fn reach_down(&self, ve: f64, length: f64) -> f64 {
        match self {
            Self::Step(l) => l.down().reach(ve, length),
            Self::Ramped(l) => add_rounding_down(ve, l.down().reach(ve, length)),
        }
    }

    /// Whether `v1` is clearly reached from `v0` within `length`. [`Self::reach_up`] is then at least `v1` and need not
    /// be evaluated: it takes a cube root, this function at most a square root.
    pub(crate) fn clearly_reaches_up(&self, v0: f64, v1: f64, length: f64) -> bool {
        match self {
            Self::Step(_) => false,
            Self::Ramped(l) => l.up().distance(v0, v1 * (1.0 + CLEARLY) - v0) <= length,
        }
    }

    /// Whether braking from `v1` clearly reaches `ve` within `length`, see [`Self::clearly_reaches_up`].
    pub(crate) fn clearly_reaches_down(&self, v1: f64, ve: f64, length: f64) -> bool {
        match self {
            Self::Step(_) => false,
            Self::Ramped(l) => l.down().distance(ve, v1 * (1.0 + CLEARLY) - ve) <= length,
        }
    }

    /// See [`RampedLimits::constant_ramps_s`].
    pub(crate) fn constant_ramps_s(&self) -> f64 {
        match self {
            Self::Step(_) => 0.0,
            Self::Ramped(l) => l.constant_ramps_s(),
        }
    }

    /// Whether the rates of both, see [`RampedLimits::rates`], are `same` pair by pair; false where there are none.
    pub(crate) fn has_same_rates(&self, other: &Self, same: impl Fn(f64, f64) -> bool) -> bool {
        match (self, other) {
            (Self::Ramped(a), Self::Ramped(b)) => a.all(b, |a, b| a.has_same_rates(b, &same)),
            _ => false,
        }
    }

    /// The whole span: from `v0` to a peak of at most `vf`, then to `ve`, over exactly `length`.
    ///
    /// A `vf` below `max(v0, ve)` counts as that maximum. If the boundary velocities miss the length by rounding
    /// (relative 1e-9 at most), the times of the profile are compressed by that ratio: velocities stay as given, the
    /// acceleration exceeds its limit by the same ratio.
    ///
    /// # Errors
    /// [`Infeasible`] if the change from `v0` to `ve` alone needs more than `length`, or the speed limit is 0.
    pub fn plan(&self, v0: f64, ve: f64, vf: f64, length: f64) -> Result<Profile, Infeasible> {
        match self {
            Self::Step(l) => l.plan(v0, ve, vf, length),
            Self::Ramped(l) => l.plan(v0, ve, vf, length),
        }
    }

    /// As [`Self::plan`] for a `v0` above the feed rate `vf >= ve`: brakes to the feed rate at once, holds it and
    /// continues to `ve` (G901).
    ///
    /// If there is no room for zero acceleration at the feed rate, it is brought to zero at a lower speed.
    ///
    /// # Errors
    /// [`Infeasible`] if the change from `v0` to `ve` alone needs more than `length`, or the speed limit is 0.
    pub(crate) fn plan_from_above(
        &self,
        v0: f64,
        ve: f64,
        vf: f64,
        length: f64,
    ) -> Result<Profile, Infeasible> {
        let distance = |hold: f64| self.down_distance(v0, hold) + self.down_distance(hold, ve);
        let mut hold = vf.min(v0);
        if distance(hold) > length {
            let (mut low, mut high) = (ve, hold);
            for _ in 0..HALVINGS {
                let mid = 0.5 * (low + high);
                if distance(mid) > length { high = mid } else { low = mid }
            }
            hold = low;
        }
        let braking = self.down_distance(v0, hold);
        let parts = || {
            let first = self.plan(v0, hold, v0, braking).ok()?;
            let second = self.plan(hold, ve, hold, length - braking).ok()?;
            Some(first.followed_by(&second))
        };
        // a leg that takes the whole length up to rounding leaves no room for the other one
        if (hold > ve || hold > 0.0 && braking < length)
            && let Some(profile) = parts()
        {
            return Ok(profile);
        }
        self.plan(v0, ve, v0, length)
    }
}

#[cfg(test)]
mod tests {
    use super::SlopeLimits;
    use crate::profile::{RampShape, RampedLimits};
    use proptest::prelude::*;

    proptest! {
        /// A velocity that is clearly reached is never above the reach itself, to the last bit, and values slightly
        /// below and above the reach are distinguished.
        #[test]
        fn what_is_clearly_reached_is_within_reach(
            sin2 in any::<bool>(),
            constant_ramp_time in any::<bool>(),
            (acc, dec) in (1.0..20_000.0f64, 1.0..20_000.0f64),
            ramps in prop::array::uniform4(prop_oneof![Just(0.0), 1e-4..0.5f64]),
            (v, length) in (prop_oneof![Just(0.0), 1e-9..2000.0f64], prop_oneof![0.0..1e-3f64, 1e-3..500.0f64]),
            offset in prop_oneof![Just(0.0), -1e-6..1e-6f64, -1e-13..1e-13f64],
        ) {
            let shape = if sin2 { RampShape::Sin2 } else { RampShape::Trapez };
            let slope = SlopeLimits::Ramped(RampedLimits::new(shape, constant_ramp_time, acc, dec, ramps));
            for up in [true, false] {
                let (reach, clearly): (f64, &dyn Fn(f64) -> bool) = if up {
                    (slope.reach_up(v, length), &|to| slope.clearly_reaches_up(v, to, length))
                } else {
                    (slope.reach_down(v, length), &|from| slope.clearly_reaches_down(from, v, length))
                };
                let asked = reach * (1.0 + offset);
                prop_assert!(!clearly(asked) || asked <= reach, "{asked} is beyond {reach}");
                prop_assert!(!clearly(f64::INFINITY) && !clearly(reach * (1.0 + 1e-8) + 1e-12));
                prop_assert!(reach <= v || clearly(0.5 * (v + reach)) || reach - v < 1e-6 * v);
                prop_assert!(length <= 0.0 || clearly(0.5 * v));
            }
        }
    }
}
