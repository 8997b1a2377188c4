//! The programmed contour that is still within reach of the filters, and the distance of a set point from it.

mod around;
mod sight;

use crate::axis::AxisVec;
use crate::junction::TANGENT;
use crate::path::{LinePath, Path};
use crate::queue::Queued;
use smallvec::SmallVec;
use std::collections::VecDeque;
use std::ops::Range;
use std::sync::Arc;

use around::nearest;
pub(crate) use around::{Around, Nearest};
pub(crate) use sight::Sight;

/// Entries whose paths begin closer together than this, in mm of path length, have the same path.
pub(crate) const SAME_START_MM: f64 = 1e-9;

/// Share by which a vector may be longer than the shortest one and still be taken for it.
pub(crate) const WARY: f64 = 0.05;

/// What rounding may make of a distance in mm.
pub(crate) const ROUNDING_MM: f64 = 1e-9;

/// Weight of a block that is further away than the nearest one: the eighth power of the ratio of both distances.
fn fading(least: f64, distance: f64) -> f64 {
    let square = |x: f64| x * x;
    if distance > least { square(square(square(least / distance))) } else { 1.0 }
}

/// Blocks as the interpolator entered them. One that a change of speed divides is entered once more for its rest.
#[derive(Clone, Debug, Default)]
pub(crate) struct Contour {
    blocks: VecDeque<Passed>,
    /// Number of the first block: of those forgotten so far.
    forgotten: u64,
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

impl Passed {
    /// True unless the block is straight.
    fn is_bent(&self) -> bool {
        !self.queued.block.path.is_straight()
    }

    /// Vector from the nearest point of the path of the block to a point, and the square of its length.
    #[inline]
    fn vector_to(&self, point: &[f64], out: &mut [f64]) -> f64 {
        self.queued.block.path.vector_to(point, out)
    }

    /// True if the direction of an axis changes between two blocks.
    fn turns_into(&self, next: &Self) -> bool {
        let (out, into) = (&self.queued.ends.tangent_out, &next.queued.ends.tangent_in);
        out.iter().zip(into.iter()).any(|(a, b)| (a - b).abs() > TANGENT)
    }
}

impl Contour {
    /// Adds the block that is entered at `cycles` (not before the moments added so far) and at path length `s_mm`.
    pub(crate) fn enter(&mut self, cycles: f64, s_mm: f64, queued: Arc<Queued>) {
        let above_feed = self.blocks.back().is_some_and(|before| {
            // the rest of a block continues as the block began
            if queued.offset > 0.0 {
                before.above_feed
            } else {
                before.queued.brakes_late_into(&queued)
            }
        });
        self.blocks.push_back(Passed { cycles, s_mm, queued, above_feed });
    }

    /// The block added last.
    pub(crate) fn last(&self) -> Option<&Passed> {
        self.blocks.back()
    }

    /// Adds a block that has entered another contour.
    pub(crate) fn append(&mut self, passed: Passed) {
        self.blocks.push_back(passed);
    }

    /// Forgets blocks that were left before `cycles`; returns how many.
    pub(crate) fn forget_before(&mut self, cycles: f64) -> usize {
        let mut count = 0;
        while self.blocks.len() > 1 && self.blocks[1].cycles < cycles {
            self.blocks.pop_front();
            count += 1;
        }
        self.forgotten += count as u64;
        count
    }

    /// Forgets so many blocks.
    pub(crate) fn forget(&mut self, count: usize) {
        // one at a time, mostly: a drain costs more than that
        for _ in 0..count {
            self.blocks.pop_front();
        }
        self.forgotten += count as u64;
    }

    /// Takes out the blocks that are to be entered at `cycles` or later.
    pub(crate) fn part_at(&mut self, cycles: f64) -> VecDeque<Passed> {
        self.blocks.split_off(self.blocks.partition_point(|b| b.cycles < cycles))
    }

    /// Number of blocks.
    pub(crate) fn len(&self) -> usize {
        self.blocks.len()
    }

    /// The first `count` blocks, and others after them.
    pub(crate) fn restore(&mut self, count: usize, mut others: VecDeque<Passed>) {
        self.blocks.truncate(count);
        self.blocks.append(&mut others);
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
        let same = |b: &Passed| b.queued.block.seq == last.queued.block.seq;
        let mut end = count;
        while self.blocks.get(end).is_some_and(same) {
            end += 1;
        }
        end
    }

    /// Components of the shortest vector from the contour between two moments (cycles) to `point`, and where it starts. The
    /// block of the second moment counts as a whole. `None`, and zero, if there is no contour yet.
    pub(crate) fn nearest(
        &self,
        point: &[f64],
        from: f64,
        to: f64,
        out: &mut [f64],
    ) -> Option<Nearest<'_>> {
        nearest(self.blocks.range(self.numbers(from, to)), point, out)
    }

    /// Numbers of the blocks that [`Self::nearest`] looks at.
    fn numbers(&self, from: f64, to: f64) -> Range<usize> {
        let Range { start, end } = self.entries(from, to);
        start..self.whole(end)
    }

    /// Largest component of the shortest vector to a point from the blocks that the path lengths `from..=to` lie in. A block
    /// that is hardly further away counts hardly less, so that where two of them are equally near nothing jumps.
    pub(crate) fn aside(&self, point: &[f64], from: f64, to: f64) -> f64 {
        let first = self.blocks.partition_point(|b| b.s_mm <= from).saturating_sub(1);
        let last = self.blocks.partition_point(|b| b.s_mm <= to).max(first);
        let mut q = AxisVec::zeros(point.len());
        let mut vectors: SmallVec<[(f64, f64); 16]> = SmallVec::new();
        for passed in self.blocks.range(first..self.whole(last)) {
            let distance = passed.vector_to(point, &mut q).sqrt();
            let component = q.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
            vectors.push((distance, component));
        }
        let least = vectors.iter().map(|v| v.0).fold(f64::INFINITY, f64::min);
        vectors.iter().map(|(d, c)| c * fading(least, *d)).fold(0.0, f64::max)
    }

    /// Number of blocks that were entered up to a moment in cycles.
    pub(crate) fn entered(&self, moment: f64) -> usize {
        self.blocks.partition_point(|b| b.cycles <= moment)
    }

    /// The same, searched from what it was a few cycles away.
    pub(crate) fn entered_near(&self, moment: f64, near: usize) -> usize {
        let mut count = near.min(self.blocks.len());
        while count > 0 && self.blocks[count - 1].cycles > moment {
            count -= 1;
        }
        while self.blocks.get(count).is_some_and(|b| b.cycles <= moment) {
            count += 1;
        }
        count
    }

    /// Number of a block, counted from the first one of all.
    pub(crate) const fn number(&self, index: usize) -> u64 {
        self.forgotten + index as u64
    }

    /// Index of the block with this number, unless it is forgotten.
    pub(crate) fn index(&self, number: u64) -> Option<usize> {
        number.checked_sub(self.forgotten).map(|index| index as usize)
    }

    /// Moments in cycles and places of the kinks between the first `end` blocks that were passed after `from`.
    pub(crate) fn kinks(&self, from: f64, end: usize) -> impl Iterator<Item = (f64, AxisVec)> + '_ {
        let mut first = end;
        while first > 1 && self.blocks[first - 1].cycles > from {
            first -= 1;
        }
        let pairs = (first.max(1)..end).map(|i| (&self.blocks[i - 1], &self.blocks[i]));
        pairs.filter(|(a, b)| !a.is_part_of_the_same(b) && a.turns_into(b)).map(|(_, passed)| {
            let queued = &passed.queued;
            let mut point = queued.block.path.start().clone();
            queued.block.path.position(queued.offset, &mut point);
            (passed.cycles, point)
        })
    }

    /// True if the last of the first `end` blocks bends.
    pub(crate) fn is_bent(&self, end: usize) -> bool {
        end.checked_sub(1).and_then(|i| self.blocks.get(i)).is_some_and(|b| b.queued.bend > 0.0)
    }

    /// Points of the contour near each other.
    pub(crate) fn walk(&self) -> Walk<'_> {
        Walk { contour: self, at: None }
    }
}

/// See [`Contour::walk`].
pub(crate) struct Walk<'a> {
    contour: &'a Contour,
    /// Block of the last point.
    at: Option<usize>,
}

impl<'a> Walk<'a> {
    /// Point of the contour at a path length of the program; the ends of what is known beyond them.
    pub(crate) fn position(&mut self, s_mm: f64, out: &mut [f64]) {
        if let Some((passed, s)) = self.seek(s_mm) {
            passed.queued.block.path.position(s, out);
        }
    }

    /// Weighted sum of the points near some path lengths, see [`Path::near`]: for what is measured later anyway.
    pub(crate) fn sum_near(&mut self, places: impl Iterator<Item = (f64, f64)>, out: &mut [f64]) {
        out.fill(0.0);
        let mut point = AxisVec::zeros(out.len());
        // on one straight line the sum of the path lengths is enough
        let mut on_line: Option<(&LinePath, f64, f64)> = None;
        let add = |on_line: Option<(&LinePath, f64, f64)>, out: &mut [f64]| {
            let Some((line, weights, ways)) = on_line else { return };
            let ends = line.start().iter().zip(line.direction().iter());
            for (sum, (start, direction)) in out.iter_mut().zip(ends) {
                *sum += weights * start + ways * direction;
            }
        };
        for (weight, s_mm) in places {
            let Some((passed, s)) = self.seek(s_mm) else { return };
            match (&passed.queued.block.path, &mut on_line) {
                (Path::Line(line), Some((last, weights, ways))) if std::ptr::eq(*last, line) => {
                    *weights += weight;
                    *ways += weight * s;
                }
                (Path::Line(line), last) => {
                    add(last.replace((line, weight, weight * s)), out);
                }
                (path, _) => {
                    path.near(s, &mut point);
                    for (sum, p) in out.iter_mut().zip(point.iter()) {
                        *sum += weight * p;
                    }
                }
            }
        }
        add(on_line, out);
    }

    /// The block at a path length of the program, and how far along its path that is.
    fn seek(&mut self, s_mm: f64) -> Option<(&'a Passed, f64)> {
        let blocks = &self.contour.blocks;
        let mut i =
            self.at.unwrap_or_else(|| blocks.partition_point(|b| b.s_mm <= s_mm).saturating_sub(1));
        while i > 0 && blocks[i].s_mm > s_mm {
            i -= 1;
        }
        while blocks.get(i + 1).is_some_and(|b| b.s_mm <= s_mm) {
            i += 1;
        }
        self.at = Some(i);
        let passed = blocks.get(i)?;
        let queued = &passed.queued;
        Some((passed, queued.offset + (s_mm - passed.s_mm).clamp(0.0, queued.length)))
    }
}
