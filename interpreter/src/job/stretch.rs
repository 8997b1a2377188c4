//! Consecutive cycles between the simulation and the sink of a run.

use crate::record::{Asked, CycleRecord, RowBuffer};
use crate::sim::{Messages, Samples, Simulation};

/// Consecutive cycles. It ends with a cycle that raises messages, so that these come when the sink has read it.
#[derive(Debug, Default)]
pub(super) struct Stretch {
    /// What the sink reads; nothing if it does not read and nothing was measured.
    pub(super) rows: RowBuffer,
    /// What is measured against the contour, as long as no other thread has it.
    pub(super) samples: Samples,
    /// Number of cycles, and of those that were taken.
    pub(super) count: usize,
    pub(super) taken: usize,
    /// The last cycle.
    pub(super) last: CycleRecord,
    /// Raised in the last cycle or, if no more cycles follow, after it.
    pub(super) messages: Option<Messages>,
}

impl Stretch {
    /// Most cycles.
    pub(super) const ROOM: usize = RowBuffer::ROOM;

    /// Computes up to `most` cycles; false if there are no more after them. `asked`: none if nobody reads them.
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
        if self.count > 0 {
            self.last.clone_from(simulation.record());
        }
        more
    }

    /// Takes what was measured.
    pub(super) fn fill(&mut self) {
        self.samples.fill(&mut self.rows);
        self.samples.fill_last(&mut self.last);
    }

    /// All cycles have been taken.
    pub(super) const fn is_over(&self) -> bool {
        self.taken == self.count
    }
}
