//! The summary as named numbers: one row of a table of runs.

use super::{AxisSummary, Summary};
use crate::diag::{Id, Severity};

/// A result of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// Name, ending with the unit.
    pub name: String,
    /// Value; NaN if the run has none.
    pub value: f64,
    /// Digits after the point in a text table.
    pub decimals: usize,
}

/// A result of an axis: word, suffix after the unit, value, decimals.
type OfAxis = (&'static str, &'static str, fn(&AxisSummary) -> f64, usize);

const OF_AXIS: [OfAxis; 6] = [
    ("vel", "_s", |a| a.max_vel, 6),
    ("acc", "_s2", |a| a.max_acc, 4),
    ("jerk", "_s3", |a| a.max_jerk, 2),
    ("err", "", |a| a.max_err, 7),
    ("dev", "", |a| a.max_dev.unwrap_or(f64::NAN), 7),
    ("lag", "", |a| a.max_lag, 7),
];

impl Summary {
    /// All numbers of a run in a table of runs, the same set for every run of a machine.
    pub fn results(&self) -> Vec<Measure> {
        let measure =
            |name: &str, value, decimals| Measure { name: name.to_owned(), value, decimals };
        let error = self.max_contour_error.as_ref().map_or(f64::NAN, |e| e.mm);
        let mut all = vec![
            measure("cycles", self.cycles as f64, 0),
            measure("duration_s", self.duration_s, 6),
            measure("ideal_duration_s", self.ideal_duration_s, 6),
            measure("path_mm", self.path_length_mm, 7),
            measure("contour_err_mm", error, 7),
        ];
        for axis in &self.axes {
            for (word, suffix, of, decimals) in OF_AXIS {
                let name = format!("{}_{word}_max_{}{suffix}", axis.name, axis.unit);
                all.push(Measure { name, value: of(axis), decimals });
            }
        }
        let limits = self.time_by_v_limit_s.iter();
        all.extend(limits.map(|(name, time)| measure(&format!("{name}_time_s"), *time, 6)));
        all
    }

    /// ID of the first error, if there was one.
    pub fn first_error(&self) -> Option<Id> {
        self.messages.iter().find(|m| m.is_error()).map(|m| m.id)
    }

    /// Number of warnings.
    pub fn warnings(&self) -> usize {
        self.messages.iter().filter(|m| m.severity == Severity::Warning).count()
    }
}
