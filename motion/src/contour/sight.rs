//! Lower bounds of the distances between blocks and a moving point.
//!
//! A point that moves from one place to another comes nearer to a block by the distance travelled at most. A distance
//! that was measured once therefore gives a lower bound later, and most of the blocks within reach of a filter need not
//! be measured again in the next cycle: a block is measured again once the point has travelled as far as the block was
//! away.

use crate::axis::AxisVec;
use std::collections::VecDeque;
use std::ops::Range;

/// Number of steps after which distances are measured again, so that rounding errors of the travelled distance stay far
/// below the allowance.
const STEPS: u32 = 256;

/// Lower bounds of distances, see the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sight {
    /// Position of the point.
    at: AxisVec,
    /// Distance travelled in mm, and the number of steps.
    way: f64,
    steps: u32,
    /// Number of the block of the first bound.
    first: u64,
    /// For each block the travelled distance in mm below which the point cannot have reached it.
    clear: VecDeque<f64>,
    /// Number of the block that was nearest.
    pub(super) nearest: Option<u64>,
    /// Numbers of the blocks at which the search within reach ended.
    pub(super) entered: Option<(u64, u64)>,
}

impl Sight {
    /// Moves the point and keeps the bounds of the blocks with these numbers.
    #[expect(clippy::inline_always, reason = "a call would not know the number of axes")]
    #[inline(always)]
    pub(super) fn look_from(&mut self, point: &[f64], blocks: Range<u64>) {
        self.steps += 1;
        let n = point.len();
        if self.at.len() == n && self.steps < STEPS {
            let at = &mut self.at[..n];
            let mut square = 0.0;
            for i in 0..n {
                square += (point[i] - at[i]) * (point[i] - at[i]);
                at[i] = point[i];
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

    /// Distance in mm that the point has travelled.
    pub(super) const fn way(&self) -> f64 {
        self.way
    }

    /// For each block, from the first examined one: the travelled distance in mm below which the point cannot have
    /// reached it.
    pub(super) fn clear(&mut self) -> impl Iterator<Item = &mut f64> {
        self.clear.iter_mut()
    }

    /// The bound of a block, counted from the first examined one.
    pub(super) fn bound(&mut self, i: usize) -> &mut f64 {
        &mut self.clear[i]
    }

    /// The bounds of the first `count` blocks, one part after the other.
    pub(super) fn bounds(&mut self, count: usize) -> [&mut [f64]; 2] {
        let (first, second) = self.clear.as_mut_slices();
        let of_first = count.min(first.len());
        [&mut first[..of_first], &mut second[..count - of_first]]
    }
}
