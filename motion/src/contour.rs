//! The programmed contour that is still within reach of the filters, and the distance of a set point from it.

use crate::axis::AxisVec;
use crate::queue::Queued;
use std::collections::VecDeque;
use std::ops::Range;
use std::sync::Arc;

/// Entries whose paths begin closer together than this, in mm of path length, have the same path.
pub(crate) const SAME_START_MM: f64 = 1e-9;

/// Blocks as the interpolator entered them. One that a change of speed divides is entered once more for its rest.
#[derive(Clone, Debug, Default)]
pub struct Contour {
    blocks: VecDeque<Passed>,
}

/// A block with the moment and the place of its entry.
#[derive(Clone, Debug)]
pub(crate) struct Passed {
    /// Moment in cycles.
    pub(crate) cycles: f64,
    /// Path length of the program in mm.
    pub(crate) s_mm: f64,
    pub(crate) queued: Arc<Queued>,
    /// It may have been entered faster than its feed (G901).
    pub(crate) above_feed: bool,
}

impl Passed {
    /// True if both are parts of one path: they are where the whole of it starts.
    fn is_part_of_the_same(&self, other: &Self) -> bool {
        let start = |p: &Self| p.s_mm - p.queued.offset;
        self.queued.block.seq == other.queued.block.seq
            && (start(self) - start(other)).abs() < SAME_START_MM
    }
}

impl Contour {
    /// Adds the block that is entered at `cycles` (not before the moments added so far) and at path length `s_mm`.
    pub(crate) fn enter(&mut self, cycles: f64, s_mm: f64, queued: Arc<Queued>) {
        let above_feed = self.blocks.back().is_some_and(|before| {
            // the rest of a block goes on as the block began
            if queued.offset > 0.0 {
                before.above_feed
            } else {
                before.queued.brakes_late_into(&queued)
            }
        });
        self.blocks.push_back(Passed { cycles, s_mm, queued, above_feed });
    }

    /// Forgets blocks that were left before `cycles`.
    pub(crate) fn forget_before(&mut self, cycles: f64) {
        while self.blocks.len() > 1 && self.blocks[1].cycles < cycles {
            self.blocks.pop_front();
        }
    }

    /// Forgets blocks that were to be entered at `cycles` or later.
    pub(crate) fn forget_from(&mut self, cycles: f64) {
        while self.blocks.back().is_some_and(|b| b.cycles >= cycles) {
            self.blocks.pop_back();
        }
    }

    /// Blocks that were being interpolated at some time in `from..=to` (cycles).
    pub(crate) fn between(&self, from: f64, to: f64) -> impl Iterator<Item = &Passed> {
        self.blocks.range(self.entries(from, to))
    }

    fn entries(&self, from: f64, to: f64) -> Range<usize> {
        let first = self.blocks.partition_point(|b| b.cycles <= from).saturating_sub(1);
        let last = self.blocks.partition_point(|b| b.cycles <= to).max(first);
        first..last
    }

    /// End of the programmed block that the last of the first `count` entries belongs to: a rounded corner or a spline is
    /// planned in parts, and where one of them ends means nothing outside.
    fn whole(&self, count: usize) -> usize {
        let Some(last) = count.checked_sub(1).and_then(|i| self.blocks.get(i)) else {
            return count;
        };
        let same = |b: &&Passed| b.queued.block.seq == last.queued.block.seq;
        count + self.blocks.range(count..).take_while(same).count()
    }

    /// Components of the shortest vector from the contour between two moments to `point`; returns its length. The block
    /// of the second moment counts as a whole.
    ///
    /// Zero if there is no contour yet.
    pub fn deviation(&self, point: &[f64], from: f64, to: f64, out: &mut [f64]) -> f64 {
        let Range { start, end } = self.entries(from, to);
        nearest(self.blocks.range(start..self.whole(end)), point, out)
    }

    /// Largest component of the shortest vector, whichever way a border within `slack` cycles of the two moments is
    /// counted (a sample that lies on the border of two blocks belongs to both), and with or without the rest of the
    /// block of the second moment.
    pub(crate) fn worst_component(&self, point: &[f64], from: f64, to: f64, slack: f64) -> f64 {
        let count = |t: f64| self.blocks.partition_point(|b| b.cycles <= t);
        let first = |t: f64| count(t).saturating_sub(1);
        let firsts = first(from - slack)..=first(from + 1e-6);
        let lasts = count(to - 1e-6).max(1)..=count(to + 1e-6).max(1);
        let mut vector = AxisVec::zeros(point.len());
        let mut worst = 0.0;
        for begin in firsts {
            let whole = lasts.clone().map(|end| self.whole(end)).max();
            let more = whole.filter(|whole| whole > lasts.end());
            for end in lasts.clone().chain(more) {
                let blocks = self.blocks.range(begin..end.max(begin + 1).min(self.blocks.len()));
                nearest(blocks, point, &mut vector);
                worst = vector.iter().fold(worst, |m: f64, c| m.max(c.abs()));
            }
        }
        worst
    }
}

/// Shortest vector from the paths of the blocks to a point.
fn nearest<'a>(blocks: impl Iterator<Item = &'a Passed>, point: &[f64], out: &mut [f64]) -> f64 {
    let mut best = f64::INFINITY;
    let mut q = AxisVec::zeros(point.len());
    let mut before: Option<&Passed> = None;
    for passed in blocks {
        // every path is searched over its whole length, so once is enough for its parts
        if before.is_some_and(|b| b.is_part_of_the_same(passed)) {
            continue;
        }
        before = Some(passed);
        let path = &passed.queued.block.path;
        path.position(path.nearest(point), &mut q);
        let d2: f64 = q.iter().zip(point).map(|(q, p)| (q - p) * (q - p)).sum();
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
