//! Limits of several blocks combined into the limits of one span.

use super::leg::LegLimits;
use super::slope::SlopeLimits;
use super::step::StepLimits;

impl SlopeLimits {
    /// Limits within those of both: the smaller acceleration and, for each ramp, the smaller jerk.
    #[must_use]
    pub fn weaker(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::Ramped(a), Self::Ramped(b)) => Self::Ramped(a.combine(b, LegLimits::weaker)),
            (Self::Step(a), Self::Step(b)) => Self::Step(StepLimits::weaker(a, b)),
            // slopes of different kinds never form one span
            _ => self.clone(),
        }
    }

    /// Whether accelerations and ramp times differ by at most the given ratio.
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
