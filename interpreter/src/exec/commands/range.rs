//! Ranges of the numbers in brackets.

use crate::diag::Condition;
use crate::exec::values::number::is_whole;

/// A range of numbers and the condition for values outside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    low: f64,
    high: f64,
    /// Whether the lower end is excluded.
    open: bool,
    /// Whether fractions are excluded.
    whole: bool,
    pub(super) condition: Condition,
}

/// From `low` to `high`.
pub(in crate::exec) const fn between(low: f64, high: f64) -> Range {
    Range { low, high, open: false, whole: false, condition: Condition::Range }
}

/// From `low` upwards.
pub(in crate::exec) const fn at_least(low: f64) -> Range {
    between(low, f64::MAX)
}

/// Above 0.
pub(in crate::exec) const fn above_zero() -> Range {
    Range { open: true, ..at_least(0.0) }
}

/// Above 0, up to `high`.
pub(in crate::exec) const fn above_zero_to(high: f64) -> Range {
    Range { open: true, ..between(0.0, high) }
}

impl Range {
    /// A condition other than 21296, or K-RANGE in the bracket of an axis.
    pub(in crate::exec) const fn or(self, condition: Condition) -> Self {
        Self { condition, ..self }
    }

    /// Whole numbers only.
    pub(in crate::exec) const fn whole(self) -> Self {
        Self { whole: true, ..self }
    }

    pub(super) fn contains(&self, x: f64) -> bool {
        (self.low..=self.high).contains(&x)
            && !(self.open && x <= self.low)
            && (!self.whole || is_whole(x))
    }

    /// Text for the message of an invalid value.
    pub(super) fn allowed(&self) -> String {
        let Self { low, high, .. } = self;
        if self.whole {
            return format!("whole numbers {low} to {high}");
        }
        match (self.open, *high < f64::MAX) {
            (true, false) => format!("values above {low}"),
            (true, true) => format!("values above {low}, up to {high}"),
            (false, false) => format!("{low} upwards"),
            (false, true) => format!("{low} to {high}"),
        }
    }

    /// Text for `explain`.
    pub(super) fn short(&self) -> String {
        let Self { low, high, .. } = self;
        match (self.open, *high < f64::MAX) {
            (true, false) => format!("above {low}"),
            (true, true) => format!("above {low} to {high}"),
            (false, false) => format!(">= {low}"),
            (false, true) => format!("{low}..{high}"),
        }
    }
}
