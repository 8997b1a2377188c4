//! What is known of the distances of blocks from a point that moves.
//!
//! On its way from one place to another a point comes nearer to a block by the length of that way at most. So a distance that
//! was measured once is a lower bound later, and of the blocks within reach of a filter most need not be measured again in
//! the next cycle: a block is looked at once more when the point has come as far as it was away.

use crate::axis::AxisVec;
use std::collections::VecDeque;
use std::ops::Range;

/// Steps after which distances are measured again: what rounding adds to the way stays far below what it is allowed to be.
const STEPS: u32 = 256;

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sight {
    /// Where the point is.
    at: AxisVec,
    /// How far it has gone in mm, by steps so many.
    way: f64,
    steps: u32,
    /// Number of the block of the first bound.
    first: u64,
    /// Way in mm before which the point cannot be at a block, block by block.
    clear: VecDeque<f64>,
    /// Number of the block that was nearest.
    pub(super) nearest: Option<u64>,
    /// Numbers of the blocks that the search within reach ended at.
    pub(super) entered: Option<(u64, u64)>,
}

impl Sight {
    /// Moves the point; bounds are kept of the blocks with some numbers.
    pub(super) fn look_from(&mut self, point: &[f64], blocks: Range<u64>) {
        self.steps += 1;
        if self.at.len() == point.len() && self.steps < STEPS {
            let mut square = 0.0;
            for (at, to) in self.at.iter_mut().zip(point) {
                square += (to - *at) * (to - *at);
                *at = *to;
            }
            self.way += f64::sqrt(square);
        } else {
            (self.at, self.way, self.steps) = (AxisVec::from_slice(point), 0.0, 0);
            self.clear.clear();
        }
        if self.clear.is_empty() || !(self.first..self.end()).contains(&blocks.start) {
            self.clear.clear();
            self.first = blocks.start;
        }
        while self.first < blocks.start {
            self.clear.pop_front();
            self.first += 1;
        }
        while self.end() < blocks.end {
            self.clear.push_back(f64::NEG_INFINITY);
        }
    }

    fn end(&self) -> u64 {
        self.first + self.clear.len() as u64
    }

    /// How far the point has gone in mm.
    pub(super) const fn way(&self) -> f64 {
        self.way
    }

    /// Of each block, from the first one that is looked at: the way in mm before which the point cannot be there.
    pub(super) fn clear(&mut self) -> impl Iterator<Item = &mut f64> {
        self.clear.iter_mut()
    }
}
