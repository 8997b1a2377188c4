//! Consecutive cycles between the simulation and the sink of a run.

use crate::record::{Asked, CycleRecord, RowBuffer};
use crate::sim::{Messages, Samples, Simulation};

/// Consecutive cycles. A stretch ends with a cycle that raises messages, which are passed on after the sink has read
/// that cycle.
#[derive(Debug, Default)]
pub(super) struct Stretch {
    /// The cycles for the sink; empty if it does not read and nothing was measured.
    pub(super) rows: RowBuffer,
    /// Samples to be measured against the contour, unless another thread has them.
    pub(super) samples: Samples,
    /// Number of cycles, and number of those that were taken.
    pub(super) count: usize,
    pub(super) taken: usize,
    /// The last cycle.
    pub(super) last: CycleRecord,
    /// Messages raised in the last cycle or, if no more cycles follow, after it.
    pub(super) messages: Option<Messages>,
}

impl Stretch {
    /// Most cycles.
    pub(super) const ROOM: usize = RowBuffer::ROOM;

    /// Computes up to `most` cycles; false if there are no more after them. `asked`: `None` if nobody reads them.
    pub(super) fn compute(
        &mut self,
        simulation: &mut Simulation,
        most: usize,
        asked: Option<Asked>,
    ) -> bool {
        let Self { rows, samples, .. } = self;
        rows.clear(simulation.chains().len(), asked.unwrap_or_default());
        samples.clear();
        (self.count, self.taken, self.messages) = (0, 0, None);
        let most = most.min(Self::ROOM);
        let mut more = true;
        while more && self.count < most && self.messages.is_none() {
            let left = most - self.count;
            let count = simulation.next_cycles(left, asked.is_some(), rows, samples);
            self.count += count;
            more = count > 0;
            self.messages = simulation.take_messages();
            // from here on cycles that nobody reads are measured
            if rows.len() > 0 && rows.len() < self.count {
                break;
            }
        }
        samples.ends = !more;
        if self.count > 0 {
            self.last.clone_from(simulation.record());
        }
        more
    }

    /// Applies the measured results.
    pub(super) fn fill(&mut self) {
        self.samples.fill(&mut self.rows);
        self.samples.fill_last(&mut self.last);
    }

    /// Whether all cycles have been taken.
    pub(super) const fn is_over(&self) -> bool {
        self.taken == self.count
    }
}
