//! Memory of queued blocks that have been left, for the next ones: see [`SpareBlocks`].

use crate::block::{Block, SpareBlocks};
use crate::limits::SlopeTable;
use crate::queue::Queued;
use crate::realtime::Override;
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

    /// Derives the limits of a block and shares it, in the memory of the first one that was left unless somebody still has that.
    pub(super) fn place(
        &mut self,
        block: Box<Block>,
        table: &SlopeTable,
        ratios: &Override,
    ) -> Arc<Queued> {
        if let Some(mut first) = self.left.pop_front() {
            if let Some(place) = Arc::get_mut(&mut first) {
                self.blocks.add(place.become_block(block, table, ratios));
                return first;
            }
            self.left.push_front(first);
        }
        Arc::new(Queued::with(block, table, ratios))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::block;
    use kontur_filters::time::CycleTime;

    fn programmed(seq: u64) -> Block {
        block(seq, [0.0, 0.0], [seq as f64, 0.0], 10.0)
    }

    fn place(spent: &mut Spent, seq: u64) -> Arc<Queued> {
        let block = programmed(seq);
        let table = SlopeTable::of(&block, CycleTime::from_us(1000).unwrap());
        spent.place(Box::new(block), &table, &Override::default())
    }

    /// A block that somebody still has keeps its memory and its content; one that nobody has gives its memory away, and the
    /// new block is what it would be elsewhere.
    #[test]
    fn only_what_nobody_has_is_overwritten() {
        let mut spent = Spent::default();
        let (first, second) = (place(&mut spent, 1), place(&mut spent, 2));
        let places = [Arc::as_ptr(&first), Arc::as_ptr(&second)];
        spent.keep(Arc::clone(&first));
        spent.keep(second);
        let third = place(&mut spent, 3);
        assert!(!places.contains(&Arc::as_ptr(&third)));
        assert_eq!((first.block.seq, third.block.seq), (1, 3));
        assert!(spent.blocks.is_empty());
        drop(first);
        let (fourth, fifth) = (place(&mut spent, 4), place(&mut spent, 5));
        assert_eq!([Arc::as_ptr(&fourth), Arc::as_ptr(&fifth)], places);
        let anew = Queued::new(programmed(4), CycleTime::from_us(1000).unwrap());
        assert_eq!(format!("{fourth:?}"), format!("{anew:?}"));
        assert!(!spent.blocks.is_empty());
    }

    /// Blocks that somebody never leaves do not accumulate.
    #[test]
    fn few_are_kept() {
        let mut spent = Spent::default();
        let held = place(&mut spent, 1);
        for _ in 0..3 * MOST {
            spent.keep(Arc::clone(&held));
        }
        assert_eq!(Arc::strong_count(&held), 1 + MOST);
    }
}
