//! Memory of blocks that have been run, for the next ones.

use super::Block;

/// Blocks that nobody needs any more.
///
/// A block is programmed on one thread and left on another one, hundreds of blocks later. An allocator keeps only a few pieces
/// of memory per thread; whatever goes beyond that takes a lock, which costs a tenth of the time of a run of short blocks.
#[derive(Debug, Default)]
#[expect(clippy::vec_box, reason = "it is the memory of the boxes that is kept")]
pub struct SpareBlocks(Vec<Box<Block>>);

impl SpareBlocks {
    /// Largest number of blocks that are kept: more than a look-ahead of the usual size and what is on its way to it.
    const MOST: usize = 1024;

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds a block that was left.
    pub(crate) fn add(&mut self, block: Box<Block>) {
        if self.0.len() < Self::MOST {
            self.0.push(block);
        }
    }

    /// Takes all blocks of another list.
    pub fn append(&mut self, other: &mut Self) {
        let room = Self::MOST - self.0.len();
        other.0.truncate(room);
        self.0.append(&mut other.0);
    }

    /// Takes an earlier block, to be turned into the next one.
    pub fn take(&mut self) -> Option<Box<Block>> {
        self.0.pop()
    }

    /// Boxes a block, in the memory of an earlier one if there is one.
    pub fn place(&mut self, block: Block) -> Box<Block> {
        let Some(mut place) = self.take() else { return Box::new(block) };
        *place = block;
        place
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::block;

    fn boxed(seq: u64) -> Box<Block> {
        Box::new(block(seq, [0.0, 0.0], [1.0 + seq as f64, 0.0], 10.0))
    }

    /// A block in the memory of another one is what it would be elsewhere, and no list grows beyond its bound.
    #[test]
    fn memory_is_used_again() {
        let mut spare = SpareBlocks::default();
        for seq in 0..2 * SpareBlocks::MOST as u64 {
            spare.add(boxed(seq));
        }
        let mut all = SpareBlocks::default();
        all.add(boxed(1));
        all.append(&mut spare);
        assert!(spare.is_empty());
        let places: Vec<*const Block> = all.0.iter().map(|block| &raw const **block).collect();
        assert_eq!(places.len(), SpareBlocks::MOST);
        let mut placed_before = Vec::new();
        for seq in 0..places.len() as u64 {
            let placed = all.place(*boxed(seq));
            assert!(places.contains(&(&raw const *placed)));
            assert_eq!(format!("{placed:?}"), format!("{:?}", boxed(seq)));
            // otherwise the allocator could give its memory to the next one
            placed_before.push(placed);
        }
        assert!(all.is_empty());
        assert_eq!(all.place(*boxed(7)).seq, 7);
    }
}
