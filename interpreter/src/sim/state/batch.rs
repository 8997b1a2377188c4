//! Cycles of the axes that were computed in a row.

use crate::record::AxisRecord;
use crate::sim::chain::Mark;
use crate::sim::spindle::Spindle;
use kontur_filters::control::fault::Fault;
use kontur_motion::ahead::Ahead;

/// Cycles after the current one whose axes have already been computed.
#[derive(Debug, Default)]
pub(in crate::sim) struct Batch {
    pub(in crate::sim) ahead: Ahead,
    /// How many of them wait to be taken.
    pub(in crate::sim) computed: usize,
    /// How many are tried: after a fault few, because what lies after the next one is computed in vain.
    pub(in crate::sim) tried: usize,
    /// Cycle before which cycles are computed singly, because too few follow in a row.
    pub(in crate::sim) single_before: u64,
    /// Least number of single cycles when too few follow in a row.
    pub(in crate::sim) patience: u64,
    /// Faults of the last computed cycle.
    pub(in crate::sim) faults: Vec<(usize, Fault)>,
    /// The chains and their records before the row, and the spindles.
    pub(in crate::sim) marks: Vec<Option<Mark>>,
    pub(in crate::sim) records_before: Vec<AxisRecord>,
    pub(in crate::sim) spindles_before: Vec<Spindle>,
    /// Set positions of the spindles from the current cycle on.
    pub(in crate::sim) spindle_deg: Vec<Vec<f64>>,
    /// Of one chain from the current cycle on: interpolated setpoints, and set positions.
    pub(in crate::sim) ipo: Vec<f64>,
    pub(in crate::sim) set: Vec<f64>,
}

impl Batch {
    /// Whether computed cycles have not been taken yet.
    pub(in crate::sim) const fn is_pending(&self) -> bool {
        self.computed > 0
    }
}
