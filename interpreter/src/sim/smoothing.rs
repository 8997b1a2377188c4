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
    /// Whether the path rests after the last motion.
    rests: bool,
    /// What follows a wait at a rounded corner.
    behind: Vec<Block>,
    /// Places already reported: condition, file, line.
    said: BTreeSet<(Condition, u32, u32)>,
    /// The motions that did not pass unchanged.
    pub(super) changed: Changed,
}

impl Smoothing {
    /// Empty stages.
    pub(super) fn new(cycle: CycleTime) -> Self {
        let (splining, contouring) = (Splining::new(cycle), Contouring::new(cycle));
        let (said, changed) = (BTreeSet::new(), Changed::default());
        Self { splining, contouring, rests: true, behind: Vec::new(), said, changed }
    }

    /// Takes a programmed motion; final blocks go to the planner.
    pub(super) fn push(&mut self, block: Box<Block>, planner: &mut Planner) {
        if self.splining.passes(&block) && self.contouring.passes(&block) {
            self.rests = false;
            planner.push(block);
            return;
        }
        self.changed.begin(block.seq);
        let behind = !self.rests && self.splining.is_empty() && self.contouring.passes(&block);
        if behind && let Some(before) = planner.last_block() {
            self.splining.begin_behind(before);
        }
        self.rests = false;
        for block in self.splining.push(*block, planner.kernels()) {
            for block in self.contouring.push(block, planner.kernels()) {
                self.changed.add(&block);
                planner.push(block);
            }
        }
    }

    /// Lets the path wait at the corner after the last motion, if it may become a curve.
    pub(super) fn wait_here(&mut self) -> bool {
        self.contouring.stop_here()
    }

    /// Whether a motion is the block after a corner, rather than one of a spline.
    pub(super) fn joins_corner(&self, block: &Block) -> bool {
        self.splining.passes(block)
    }

    /// As [`Self::push`], where the path waits at the end of the block before: what is driven before that goes to the
    /// planner, the rest is kept until [`Self::resume`]. Returns whether the place of the wait is found; until then the next
    /// motion is to be pushed in the same way.
    pub(super) fn push_behind_stop(&mut self, block: Box<Block>, planner: &mut Planner) -> bool {
        self.changed.begin(block.seq);
        let parted = self.contouring.push_behind_stop(*block, planner.kernels());
        let found = parted.iter().any(|blocks| !blocks.is_empty());
        self.part(parted, planner);
        found
    }

    /// The end of the block before the wait stays as programmed.
    pub(super) fn flush_behind_stop(&mut self, planner: &mut Planner) {
        let parted = self.contouring.flush_behind_stop();
        self.part(parted, planner);
    }

    fn part(&mut self, [before, after]: [Vec<Block>; 2], planner: &mut Planner) {
        for block in before.iter().chain(&after) {
            self.changed.add(block);
        }
        for block in before {
            planner.push(block);
        }
        self.behind = after;
    }

    /// Passes what follows a wait within a curve to the planner; false if there is nothing.
    pub(super) fn resume(&mut self, planner: &mut Planner) -> bool {
        let waits = !self.behind.is_empty();
        self.behind.drain(..).for_each(|block| planner.push(block));
        waits
    }

    /// Passes everything to the planner, where the path stops after the last motion.
    pub(super) fn flush(&mut self, planner: &mut Planner) {
        for block in self.splining.flush(planner.kernels()) {
            for block in self.contouring.push(block, planner.kernels()) {
                self.changed.add(&block);
                planner.push(block);
            }
        }
        for block in self.contouring.flush() {
            self.changed.add(&block);
            planner.push(block);
        }
        self.rests = true;
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
