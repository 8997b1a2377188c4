//! Moments on the time axis, inside cycles as well.

use kontur_filters::time::CycleTime;

/// A moment: seconds after a cycle tick, kept as a sum with its rounding error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Moment {
    pub(crate) origin: u64,
    after_s: f64,
    error_s: f64,
}

impl Moment {
    pub(crate) fn tick(origin: u64) -> Self {
        Self { origin, ..Self::default() }
    }

    /// Neumaier sum, so that a motion of a million spans stays on its ticks.
    pub(crate) fn plus(mut self, s: f64) -> Self {
        let sum = self.after_s + s;
        self.error_s +=
            if self.after_s >= s { (self.after_s - sum) + s } else { (s - sum) + self.after_s };
        self.after_s = sum;
        self
    }

    pub(crate) fn seconds(self) -> f64 {
        self.after_s + self.error_s
    }

    /// Whether both are whole cycles apart: motions that start there have the same states in their cycles.
    pub(crate) fn is_whole_cycles_from(self, other: Self) -> bool {
        (self.after_s, self.error_s) == (other.after_s, other.error_s)
    }

    /// The moment in cycles since the start of the program.
    pub(crate) fn cycles(self, cycle: CycleTime) -> f64 {
        self.origin as f64 + self.seconds() / cycle.seconds()
    }

    /// First tick that is not before this moment: `ceil(D / T - 1e-9)`.
    pub(crate) fn next_tick(self, cycle: CycleTime) -> u64 {
        self.origin + (self.seconds() / cycle.seconds() - 1e-9).ceil().max(0.0) as u64
    }
}
