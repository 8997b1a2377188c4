//! Limits of the path speed over one span and the questions of the look-ahead.

use super::fit::{Infeasible, add_rounding_down};
use super::ramped::RampedLimits;
use super::row::Profile;
use super::step::StepLimits;

/// Halvings of the speed at which the acceleration stops between two legs of braking.
const HALVINGS: u32 = 50;

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

    /// Largest velocity that a speed-up from `v0` reaches within `length`.
    ///
    /// With constant ramp time any speed-up takes at least both ramps; on a shorter length the answer is `v0`.
    pub fn reach_up(&self, v0: f64, length: f64) -> f64 {
        match self {
            Self::Step(l) => l.up().reach(v0, length),
            Self::Ramped(l) => add_rounding_down(v0, l.up().reach(v0, length)),
        }
    }

    /// Largest velocity from which braking to `ve` fits into `length`.
    ///
    /// Grows with `length`, but with ramps not always with `ve`: acceleration has to be zero at `ve`, so braking
    /// to a crawl can take longer than braking to rest. Lowering one boundary velocity of a plan can make its
    /// neighbours infeasible; both passes of the look-ahead have to run again.
    pub fn reach_down(&self, ve: f64, length: f64) -> f64 {
        match self {
            Self::Step(l) => l.down().reach(ve, length),
            Self::Ramped(l) => add_rounding_down(ve, l.down().reach(ve, length)),
        }
    }

    /// The whole span: from `v0` to a peak of at most `vf`, then to `ve`, over exactly `length`.
    ///
    /// A `vf` below `max(v0, ve)` counts as that maximum. Where the boundary velocities miss the length by
    /// rounding (relative 1e-9 at most), the times of the profile are compressed by that ratio: velocities stay
    /// as given, acceleration exceeds its limit by the same ratio.
    ///
    /// # Errors
    /// [`Infeasible`] if the change from `v0` to `ve` alone needs more than `length`, or no speed is allowed.
    pub fn plan(&self, v0: f64, ve: f64, vf: f64, length: f64) -> Result<Profile, Infeasible> {
        match self {
            Self::Step(l) => l.plan(v0, ve, vf, length),
            Self::Ramped(l) => l.plan(v0, ve, vf, length),
        }
    }

    /// As [`Self::plan`] for a `v0` above the feed `vf >= ve`: brakes to the feed at once, holds it and continues to `ve`
    /// (G901).
    ///
    /// Where the acceleration has to stop at the feed and that does not fit, it stops at a lower speed.
    ///
    /// # Errors
    /// [`Infeasible`] if the change from `v0` to `ve` alone needs more than `length`, or no speed is allowed.
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
        // one leg, but for rounding, has no room for the other one
        if (hold > ve || hold > 0.0 && braking < length)
            && let Some(profile) = parts()
        {
            return Ok(profile);
        }
        self.plan(v0, ve, v0, length)
    }
}
