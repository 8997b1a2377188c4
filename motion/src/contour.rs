//! The programmed contour that is still within reach of the filters, and the distance of a set point from it.

use crate::axis::AxisVec;
use crate::queue::Queued;
use std::collections::VecDeque;
use std::sync::Arc;

/// Blocks with the moment, in cycles, at which the interpolator entered them.
#[derive(Clone, Debug, Default)]
pub struct Contour {
    blocks: VecDeque<(f64, Arc<Queued>)>,
}

impl Contour {
    /// Adds the block that is entered at `cycles` (not before the moments added so far).
    pub(crate) fn enter(&mut self, cycles: f64, block: Arc<Queued>) {
        self.blocks.push_back((cycles, block));
    }

    /// Forgets blocks that were left before `cycles`.
    pub(crate) fn forget_before(&mut self, cycles: f64) {
        while self.blocks.len() > 1 && self.blocks[1].0 < cycles {
            self.blocks.pop_front();
        }
    }

    /// Forgets blocks that were to be entered at `cycles` or later.
    pub(crate) fn forget_from(&mut self, cycles: f64) {
        while self.blocks.back().is_some_and(|b| b.0 >= cycles) {
            self.blocks.pop_back();
        }
    }

    /// Blocks that were being interpolated at some time in `from..=to` (cycles), with the time of entry.
    pub(crate) fn between(
        &self,
        from: f64,
        to: f64,
    ) -> impl DoubleEndedIterator<Item = &(f64, Arc<Queued>)> {
        let first = self.blocks.partition_point(|b| b.0 <= from).saturating_sub(1);
        let last = self.blocks.partition_point(|b| b.0 <= to).max(first);
        self.blocks.range(first..last)
    }

    /// Components of the shortest vector from the contour between two moments to `point`; returns its length.
    ///
    /// Zero if there is no contour yet.
    pub fn deviation(&self, point: &[f64], from: f64, to: f64, out: &mut [f64]) -> f64 {
        let mut best = f64::INFINITY;
        let mut q = AxisVec::zeros(point.len());
        for (_, queued) in self.between(from, to) {
            let path = &queued.block.path;
            path.position(path.nearest(point), &mut q);
            let d2: f64 = q.iter().zip(point).map(|(q, p)| (p - q) * (p - q)).sum();
            if d2 < best {
                best = d2;
                for ((o, q), p) in out.iter_mut().zip(q.iter()).zip(point) {
                    *o = p - q;
                }
            }
        }
        if best.is_finite() {
            best.sqrt()
        } else {
            out.fill(0.0);
            0.0
        }
    }
}
