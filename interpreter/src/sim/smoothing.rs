//! Between program and planner: short blocks become splines, corners become curves.

use super::totals::Changed;
use crate::diag::Condition;
use crate::exec::SourceRef;
use kontur_filters::time::CycleTime;
use kontur_motion::block::Block;
use kontur_motion::contouring::{Contouring, Notice};
use kontur_motion::planner::Planner;
use kontur_motion::spline::Splining;
use std::collections::BTreeSet;

/// The two stages in order.
#[derive(Debug)]
pub(super) struct Smoothing {
    splining: Splining,
    contouring: Contouring,
    /// Places already reported: condition, file, line.
    said: BTreeSet<(Condition, u32, u32)>,
    /// The motions that did not pass unchanged.
    pub(super) changed: Changed,
}

impl Smoothing {
    /// Empty stages.
    pub(super) fn new(cycle: CycleTime) -> Self {
        let (splining, contouring) = (Splining::new(cycle), Contouring::new(cycle));
        Self { splining, contouring, said: BTreeSet::new(), changed: Changed::default() }
    }

    /// Takes a programmed motion; final blocks go to the planner.
    pub(super) fn push(&mut self, block: Box<Block>, planner: &mut Planner) {
        if self.splining.passes(&block) && self.contouring.passes(&block) {
            planner.push(block);
            return;
        }
        self.changed.begin(block.seq);
        for block in self.splining.push(*block, planner.has_kernels()) {
            for block in self.contouring.push(block, planner.has_kernels()) {
                self.changed.add(&block);
                planner.push(block);
            }
        }
    }

    /// Passes everything to the planner, where the path stops after the last motion.
    pub(super) fn flush(&mut self, planner: &mut Planner) {
        for block in self.splining.flush(planner.has_kernels()) {
            for block in self.contouring.push(block, planner.has_kernels()) {
                self.changed.add(&block);
                planner.push(block);
            }
        }
        for block in self.contouring.flush() {
            self.changed.add(&block);
            planner.push(block);
        }
    }

    /// The corners since the last call that were not contoured as programmed.
    pub(super) fn take_notices(&mut self) -> Vec<Notice> {
        let mut notices = self.splining.take_notices();
        notices.append(&mut self.contouring.take_notices());
        notices
    }

    /// Whether this is the first message of this condition about a place.
    pub(super) fn is_new(&mut self, condition: Condition, source: SourceRef) -> bool {
        self.said.insert((condition, source.file, source.line))
    }
}
