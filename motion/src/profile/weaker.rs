//! Limits of several blocks as the limits of one span.

use super::leg::LegLimits;
use super::slope::SlopeLimits;
use super::step::StepLimits;

impl SlopeLimits {
    /// Limits that keep both: the smaller acceleration, and of the ramps the smaller jerk.
    #[must_use]
    pub fn weaker(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::Ramped(a), Self::Ramped(b)) => Self::Ramped(a.combine(b, LegLimits::weaker)),
            (Self::Step(a), Self::Step(b)) => Self::Step(StepLimits::weaker(a, b)),
            // slopes of different kind are never one span
            _ => self.clone(),
        }
    }

    /// True if acceleration and ramp times differ by at most the given ratio.
    pub(crate) fn nearly_equals(&self, other: &Self, ratio: f64) -> bool {
        match (self, other) {
            (Self::Ramped(a), Self::Ramped(b)) => a.all(b, |x, y| x.nearly_equals(y, ratio)),
            (a, b) => a == b,
        }
    }

    /// Accelerations times `ratio`, positive, with the same ramp times.
    #[must_use]
    pub fn scaled(&self, ratio: f64) -> Self {
        match self {
            Self::Ramped(a) => Self::Ramped(a.combine(a, |leg, _| leg.scaled(ratio))),
            Self::Step(a) => Self::Step(a.scaled(ratio)),
        }
    }
}
