//! The programmed contour within reach of the filters, and the distance of a set point from it.

mod around;
mod seen;
mod sight;

use crate::axis::AxisVec;
use crate::junction::TANGENT;
use crate::path::{Ball, LinePath, Path};
use crate::queue::Queued;
use smallvec::SmallVec;
use std::collections::VecDeque;
use std::ops::Range;
use std::sync::Arc;

use around::nearest;
pub(crate) use around::{Around, Nearest};
pub(crate) use sight::Sight;

/// Entries whose paths begin closer together than this, in mm of path length, belong to the same path.
pub(crate) const SAME_START_MM: f64 = 1e-9;

/// Relative excess in length up to which a vector may count as the shortest one.
pub(crate) const WARY: f64 = 0.05;

/// Allowance for rounding of a distance in mm.
pub(crate) const ROUNDING_MM: f64 = 1e-9;

/// Weight of a block further away than the nearest one: the eighth power of the ratio of the two distances.
fn fading(least: f64, distance: f64) -> f64 {
    let square = |x: f64| x * x;
    if distance > least { square(square(square(least / distance))) } else { 1.0 }
}

/// Blocks as the interpolator entered them. A block that is split by a change of speed is entered again for its
/// remainder.
#[derive(Clone, Debug, Default)]
pub(crate) struct Contour {
    blocks: VecDeque<Passed>,
    /// Number of blocks forgotten so far, hence the number of the first one.
    forgotten: u64,
}

/// A block with the time and the path length of its entry.
#[derive(Clone, Debug)]
pub(crate) struct Passed {
    /// Time in cycles.
    pub(crate) cycles: f64,
    /// Path length of the program in mm.
    pub(crate) s_mm: f64,
    pub(crate) queued: Arc<Queued>,
    /// Whether it may have been entered faster than its feed rate (G901).
    pub(crate) above_feed: bool,
}

impl Passed {
    /// Whether both are parts of one path: the path as a whole starts at the same place for both.
    fn is_part_of_the_same(&self, other: &Self) -> bool {
        let start = |p: &Self| p.s_mm - p.queued.offset;
        self.queued.block.seq == other.queued.block.seq
            && (start(self) - start(other)).abs() < SAME_START_MM
    }
}

impl Passed {
    /// Vector to `point` from the nearest point on the path of the block, and the square of its length in mm2.
    #[inline]
    fn vector_to(&self, point: &[f64], out: &mut [f64]) -> f64 {
        self.queued.block.path.vector_to(point, out)
    }

    /// Distance in mm between the ends of the path over all axes.
    #[inline]
    fn chord(&self) -> f64 {
        let path = &self.queued.block.path;
        let (from, to) = (&path.start()[..], &path.end()[..]);
        let n = from.len();
        let to = &to[..n];
        let mut square = 0.0;
        for i in 0..n {
            square += (to[i] - from[i]) * (to[i] - from[i]);
        }
        f64::sqrt(square)
    }

    /// Whether the direction of an axis changes between two blocks.
    fn turns_into(&self, next: &Self) -> bool {
        let (out, into) = (&self.queued.ends.tangent_out, &next.queued.ends.tangent_in);
        out.iter().zip(into.iter()).any(|(a, b)| (a - b).abs() > TANGENT)
    }
}

impl Contour {
    /// Adds the block that is entered at `cycles` (not before the times added so far) and at path length `s_mm`.
    pub(crate) fn enter(&mut self, cycles: f64, s_mm: f64, queued: Arc<Queued>) {
        let above_feed = self.blocks.back().is_some_and(|before| {
            // the remainder of a block inherits this from the start of the block
            if queued.offset > 0.0 {
                before.above_feed
            } else {
                before.queued.brakes_late_into(&queued)
            }
        });
        self.blocks.push_back(Passed { cycles, s_mm, queued, above_feed });
    }

    /// Corrects the time in cycles and the path length in mm at which a block, given by its index, is entered.
    pub(crate) fn enter_again(&mut self, index: usize, cycles: f64, s_mm: f64) {
        let passed = &mut self.blocks[index];
        (passed.cycles, passed.s_mm) = (cycles, s_mm);
    }

    /// Keeps the first `count` blocks.
    pub(crate) fn truncate(&mut self, count: usize) {
        self.blocks.truncate(count);
    }

    /// The block added last.
    pub(crate) fn last(&self) -> Option<&Passed> {
        self.blocks.back()
    }

    /// Adds a block that has already been entered in another contour.
    pub(crate) fn append(&mut self, passed: Passed) {
        self.blocks.push_back(passed);
    }

    /// Forgets the blocks that were left before `cycles` and passes them to `left`; returns their number.
    pub(crate) fn forget_before(
        &mut self,
        cycles: f64,
        mut left: impl FnMut(Arc<Queued>),
    ) -> usize {
        let mut count = 0;
        while self.blocks.len() > 1 && self.blocks[1].cycles < cycles {
            self.blocks.pop_front().into_iter().for_each(|passed| left(passed.queued));
            count += 1;
        }
        self.forgotten += count as u64;
        count
    }

    /// Forgets the first `count` blocks.
    pub(crate) fn forget(&mut self, count: usize) {
        // mostly a single one: a drain costs more
        for _ in 0..count {
            self.blocks.pop_front();
        }
        self.forgotten += count as u64;
    }

    /// Removes and returns the blocks that are to be entered at `cycles` or later.
    pub(crate) fn part_at(&mut self, cycles: f64) -> VecDeque<Passed> {
        self.blocks.split_off(self.blocks.partition_point(|b| b.cycles < cycles))
    }

    /// Number of blocks.
    pub(crate) fn len(&self) -> usize {
        self.blocks.len()
    }

    /// Keeps the first `count` blocks and appends others.
    pub(crate) fn restore(&mut self, count: usize, mut others: VecDeque<Passed>) {
        self.truncate(count);
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

    /// Index after the programmed block that contains the last of the first `count` entries: a rounded corner or a
    /// spline is planned in parts, whose ends have no meaning outside the planner.
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

    /// Components of the shortest vector to `point` from the contour between two times (cycles), and where it starts.
    /// The block at the second time counts as a whole. `None`, and zeros, if there is no contour yet.
    pub(crate) fn nearest(
        &self,
        point: &[f64],
        from: f64,
        to: f64,
        out: &mut [f64],
    ) -> Option<Nearest<'_>> {
        nearest(self.blocks.range(self.numbers(from, to)), point, out)
    }

    /// Indices of the blocks that [`Self::nearest`] examines.
    fn numbers(&self, from: f64, to: f64) -> Range<usize> {
        let Range { start, end } = self.entries(from, to);
        start..self.whole(end)
    }

    /// Largest component of the shortest vector to a point from the blocks between the path lengths `from..=to`. A
    /// block that is slightly further away has slightly less weight, so that the result does not jump where two blocks
    /// are equally near.
    pub(crate) fn aside(&self, point: &[f64], from: f64, to: f64) -> f64 {
        let first = self.blocks.partition_point(|b| b.s_mm <= from).saturating_sub(1);
        let last = self.blocks.partition_point(|b| b.s_mm <= to).max(first);
        let end = self.whole(last);
        let mut vector = AxisVec::zeros(point.len());
        let mut vectors: SmallVec<[(f64, f64); 16]> = SmallVec::new();
        let mut measure = |passed: &Passed| {
            let distance = passed.vector_to(point, &mut vector).sqrt();
            let component = vector.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
            vectors.push((distance, component));
            distance
        };
        let guess = first.midpoint(end);
        let guessed = self.blocks.get(guess).filter(|_| guess < end).map(&mut measure);
        let mut least = guessed.unwrap_or(f64::INFINITY);
        // lower bound of the distance of the end of the block before: every block begins where the last one ends
        let mut away = 0.0;
        for (i, passed) in (first..end).zip(self.blocks.range(first..end)) {
            // a straight block is measured at once
            let ball = passed.queued.ball.as_deref();
            // twice as far away the weight of any component is less than that of the largest one of the nearest block
            let far = 2.0 * least + ROUNDING_MM;
            away -= ball.map_or_else(|| passed.chord(), Ball::width);
            if i == guess {
                away = least;
            } else if away <= far {
                away = ball.map_or(0.0, |ball| ball.distance_from(point));
                if away <= far {
                    away = measure(passed);
                    least = least.min(away);
                }
            }
        }
        vectors.iter().map(|(d, c)| c * fading(least, *d)).fold(0.0, f64::max)
    }

    /// Number of blocks that were entered up to a time in cycles.
    pub(crate) fn entered(&self, moment: f64) -> usize {
        self.blocks.partition_point(|b| b.cycles <= moment)
    }

    /// As [`Self::entered`], searched from the number `near` of a few cycles earlier or later.
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

    /// Number of a block, counted from the very first one.
    pub(crate) const fn number(&self, index: usize) -> u64 {
        self.forgotten + index as u64
    }

    /// Index of the block with this number, `None` if it has been forgotten.
    pub(crate) fn index(&self, number: u64) -> Option<usize> {
        number.checked_sub(self.forgotten).map(|index| index as usize)
    }

    /// Times in cycles and positions of the kinks between the first `end` blocks that were passed after `from`.
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

    /// Largest `|q''|` in 1/mm of those of the first `end` blocks that had not been left at `from`.
    pub(crate) fn bend(&self, from: f64, end: usize) -> f64 {
        let mut bend = 0.0_f64;
        for passed in self.blocks.iter().take(end).rev() {
            bend = bend.max(passed.queued.bend);
            if passed.cycles <= from {
                break;
            }
        }
        bend
    }

    /// Reads points of the contour, fastest for points close to the previous one.
    pub(crate) fn walk(&self) -> Walk<'_> {
        Walk { contour: self, at: None }
    }
}

/// See [`Contour::walk`].
pub(crate) struct Walk<'a> {
    contour: &'a Contour,
    /// Index of the block of the last point.
    at: Option<usize>,
}

impl<'a> Walk<'a> {
    /// Point of the contour at a path length of the program; beyond the known contour its end point.
    pub(crate) fn position(&mut self, s_mm: f64, out: &mut [f64]) {
        if let Some((passed, s)) = self.seek(s_mm) {
            passed.queued.block.path.position(s, out);
        }
    }

    /// Path length of the program at the foot of a point on the tangent at another path length.
    pub(crate) fn foot(&mut self, s_mm: f64, point: &[f64]) -> f64 {
        let Some((passed, s)) = self.seek(s_mm) else { return s_mm };
        let (mut at, mut along) = (AxisVec::zeros(point.len()), AxisVec::zeros(point.len()));
        passed.queued.block.path.position(s, &mut at);
        passed.queued.block.path.tangent(s, &mut along);
        let (mut dot, mut square) = (0.0, 0.0);
        for ((at, along), to) in at.iter().zip(along.iter()).zip(point) {
            dot += (to - at) * along;
            square += along * along;
        }
        s_mm + dot / square
    }

    /// Weighted sum of the points near some path lengths, see [`Path::near`], for results that are measured exactly
    /// later.
    pub(crate) fn sum_near(&mut self, places: impl Iterator<Item = (f64, f64)>, out: &mut [f64]) {
        out.fill(0.0);
        let mut point = AxisVec::zeros(out.len());
        // on a single straight line the weighted sum of the path lengths is enough
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

    /// The block at a path length of the program, and the path length within its path.
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
