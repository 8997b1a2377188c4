//! Limits of several blocks combined into the limits of one span.

use super::slope::SlopeLimits;
use super::step::StepLimits;

impl SlopeLimits {
    /// Limits within those of both: the smaller acceleration and, for each ramp, the smaller jerk.
    #[must_use]
    pub fn weaker(&self, other: &Self) -> Self {
        self.weakest(std::iter::once(other))
    }

    /// Limits within these and all others, see [`Self::weaker`].
    pub(crate) fn weakest<'a>(&self, others: impl Iterator<Item = &'a Self> + Clone) -> Self {
        // slopes of different kinds never form one span
        match self {
            Self::Ramped(own) => {
                Self::Ramped(own.weakest(others.filter_map(|other| match other {
                    Self::Ramped(other) => Some(other),
                    Self::Step(_) => None,
                })))
            }
            Self::Step(own) => {
                let steps = others.filter_map(|other| match other {
                    Self::Step(other) => Some(other),
                    Self::Ramped(_) => None,
                });
                Self::Step(steps.fold(own.clone(), |own, other| StepLimits::weaker(&own, other)))
            }
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
            Self::Ramped(a) => Self::Ramped(a.scaled(ratio)),
            Self::Step(a) => Self::Step(a.scaled(ratio)),
        }
    }
}
