//! A time at which a plan exceeds the tolerance, and the path lengths around it.

use super::MARGIN_MM;
use crate::axis::AxisVec;

/// A time at which the tolerance is exceeded.
#[derive(Clone, Debug)]
pub(super) struct Violation {
    /// Cycle of the set point that is too far away, or that is nearest to the missed point.
    pub(super) cycle: u64,
    /// Largest component in mm.
    pub(super) deviation_mm: f64,
    /// Its tolerance in mm.
    pub(super) tolerance_mm: f64,
    /// Axis of the largest component.
    pub(super) axis: usize,
    /// The deviation in mm, from the contour to the set point.
    pub(super) vector: AxisVec,
    /// Point of the contour that the set path misses, with its path length; `None`: the set path leaves the contour.
    pub(super) missed: Option<(AxisVec, f64)>,
}

impl Violation {
    pub(super) fn excess(&self) -> f64 {
        self.deviation_mm - within(self.tolerance_mm)
    }
}

/// The limit for a plan, slightly below the tolerance.
pub(super) fn within(tolerance_mm: f64) -> f64 {
    tolerance_mm - MARGIN_MM.min(0.1 * tolerance_mm)
}

/// Path lengths over a range of cycles.
pub(super) struct Record {
    first: u64,
    s_mm: Vec<f64>,
}

impl Record {
    /// An empty record for the cycles `first..=last`.
    pub(super) fn of((first, last): (u64, u64)) -> Self {
        Self { first, s_mm: Vec::with_capacity((last + 1).saturating_sub(first) as usize) }
    }

    pub(super) fn push(&mut self, s_mm: f64) {
        self.s_mm.push(s_mm);
    }

    /// Path length in cycle `k`, which lies in the record or within reach before it.
    pub(super) fn s(&self, k: u64) -> f64 {
        let at = k.saturating_sub(self.first) as usize;
        self.s_mm.get(at).or(self.s_mm.last()).copied().unwrap_or(0.0)
    }

    /// Last cycle of the record in which the path length does not exceed `s`: the end of a standstill there.
    pub(super) fn leaves(&self, s: f64) -> u64 {
        self.first + self.s_mm.partition_point(|passed| *passed <= s).saturating_sub(1) as u64
    }
}
