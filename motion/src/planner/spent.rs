//! Memory of queued blocks that have been left, for the next ones: see [`SpareBlocks`].

use crate::block::SpareBlocks;
use crate::queue::Queued;
use std::collections::VecDeque;
use std::sync::Arc;

/// Largest number of blocks that wait until whoever measures the output has left them as well.
const MOST: usize = 1024;

/// Queued blocks that the planner has left, in order.
#[derive(Debug, Default)]
pub(super) struct Spent {
    left: VecDeque<Arc<Queued>>,
    /// The programmed blocks of those whose memory serves others by now.
    pub(super) blocks: SpareBlocks,
}

impl Clone for Spent {
    /// Another planner has no use for this memory.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Spent {
    /// Keeps a block that the planner needs no more.
    pub(super) fn keep(&mut self, queued: Arc<Queued>) {
        if self.left.len() == MOST {
            self.left.pop_front();
        }
        self.left.push_back(queued);
    }

    /// Shares a block, in the memory of the first one that was left unless somebody still has that.
    pub(super) fn place(&mut self, queued: Queued) -> Arc<Queued> {
        let Some(mut first) = self.left.pop_front() else { return Arc::new(queued) };
        let Some(place) = Arc::get_mut(&mut first) else {
            self.left.push_front(first);
            return Arc::new(queued);
        };
        let before = std::mem::replace(place, queued);
        self.blocks.add(before.block);
        first
    }
}
