//! The programmed contour that is still within reach of the filters, and the distance of a set point from it.

use crate::axis::AxisVec;
use crate::junction::TANGENT;
use crate::path::{LinePath, Path};
use crate::queue::Queued;
use smallvec::SmallVec;
use std::collections::VecDeque;
use std::ops::Range;
use std::sync::Arc;

/// Entries whose paths begin closer together than this, in mm of path length, have the same path.
pub(crate) const SAME_START_MM: f64 = 1e-9;

/// Share by which a vector may be longer than the shortest one and still be taken for it.
pub(crate) const WARY: f64 = 0.05;

/// What rounding may make of a distance in mm.
pub(crate) const ROUNDING_MM: f64 = 1e-9;

/// How much say a block has that is further away than the nearest one: the eighth power of the ratio of both distances.
fn fading(least: f64, distance: f64) -> f64 {
    let square = |x: f64| x * x;
    if distance > least { square(square(square(least / distance))) } else { 1.0 }
}

/// Blocks as the interpolator entered them. One that a change of speed divides is entered once more for its rest.
#[derive(Clone, Debug, Default)]
pub(crate) struct Contour {
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

impl Passed {
    /// Vector from the nearest point of the path of the block to a point, and the square of its length.
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
            // the rest of a block goes on as the block began
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
        count
    }

    /// Forgets so many blocks.
    pub(crate) fn forget(&mut self, count: usize) {
        // one at a time, mostly: a drain costs more than that
        for _ in 0..count {
            self.blocks.pop_front();
        }
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
        let same = |b: &&Passed| b.queued.block.seq == last.queued.block.seq;
        count + self.blocks.range(count..).take_while(same).count()
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

    /// The blocks that can be the nearest one of those interpolated between two moments (cycles) to a point of the line
    /// between two points, or be taken for it; also of those interpolated up to `slack` cycles before and behind. Half the
    /// length of the line from its middle a block is nearer, or further, by that much at most.
    pub(crate) fn around(
        &self,
        line: (&[f64], &[f64]),
        (from, to): (f64, f64),
        slack: (f64, f64),
    ) -> Around<'_> {
        let Range { start, end } = self.entries(from, to);
        let among = start..self.whole(end);
        // a separate search would end a step or two further
        let mut all = start..end;
        while all.start > 0 && self.blocks[all.start].cycles > from - slack.0 {
            all.start -= 1;
        }
        while self.blocks.get(all.end).is_some_and(|b| b.cycles <= to + slack.1) {
            all.end += 1;
        }
        all.end = if all.end == end { among.end } else { self.whole(all.end) };
        let middle = &mut AxisVec::zeros(line.0.len())[..];
        let mut half = 0.0;
        for ((m, a), b) in middle.iter_mut().zip(line.0).zip(line.1) {
            *m = 0.5 * (a + b);
            half += 0.25 * (b - a) * (b - a);
        }
        let half: f64 = f64::sqrt(half);
        let mut around = Around { blocks: SmallVec::new(), half };
        let vector = &mut AxisVec::zeros(middle.len())[..];
        let mut far = |passed: &Passed| passed.vector_to(middle, vector).sqrt();
        let within = |least: f64| (1.0 + WARY) * (least + half) + half;
        // a filter takes the set point half of its length back as a rule: that block leaves few of the others
        let guess =
            Some(all.start.midpoint(all.end)).filter(|i| all.contains(i) && among.contains(i));
        let guessed = guess.map_or(f64::INFINITY, |i| far(&self.blocks[i]));
        let mut most = within(guessed);
        for (passed, i) in self.blocks.range(all.clone()).zip(all) {
            let is_guess = guess == Some(i);
            if is_guess || passed.queued.ball.may_be_within(middle, most + ROUNDING_MM) {
                let distance = if is_guess { guessed } else { far(passed) };
                let (block, counts) = (passed.queued.block.seq, among.contains(&i));
                if counts {
                    most = most.min(within(distance));
                }
                around.blocks.push(Candidate { passed, block, distance, counts });
            }
        }
        around.blocks.retain(|b| b.distance <= most);
        around
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

    /// Moments in cycles and places of the kinks between the first `end` blocks that were passed behind `from`.
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

/// Blocks of a contour, see [`Contour::around`].
pub(crate) struct Around<'a> {
    blocks: SmallVec<[Candidate<'a>; 16]>,
    /// Half the length of the line in mm.
    half: f64,
}

struct Candidate<'a> {
    passed: &'a Passed,
    /// Number of the block.
    block: u64,
    /// From the middle of the line in mm.
    distance: f64,
    /// Within reach of the second moment without slack.
    counts: bool,
}

impl<'a> Around<'a> {
    /// As [`Contour::nearest`] between the two moments without slack.
    pub(crate) fn nearest(&self, point: &[f64], out: &mut [f64]) -> Option<Nearest<'a>> {
        nearest(self.blocks.iter().filter(|b| b.counts).map(|b| b.passed), point, out)
    }

    /// As [`Contour::nearest`] between the two moments with slack.
    pub(crate) fn nearest_of_all(&self, point: &[f64], out: &mut [f64]) -> Option<Nearest<'a>> {
        nearest(self.blocks.iter().map(|b| b.passed), point, out)
    }

    /// True if the slack adds no block: [`Self::nearest`] and [`Self::nearest_of_all`] are the same.
    pub(crate) fn all_count(&self) -> bool {
        self.blocks.iter().all(|b| b.counts)
    }

    /// True if some other block can be nearer somewhere on the line: on the way of half the line, one comes nearer and the other
    /// goes away by that much at most.
    pub(crate) fn may_be_nearer_than(&self, nearest: &Nearest<'_>) -> bool {
        let (mut own, mut other) = (f64::INFINITY, f64::INFINITY);
        for b in &self.blocks {
            let least = if b.block == nearest.block { &mut own } else { &mut other };
            *least = least.min(b.distance);
        }
        other.is_finite() && other <= own + 2.0 * self.half
    }

    /// Largest component of all vectors to a point that could be called the shortest: those from any of the blocks that are
    /// longer by at most `WARY` than the shortest one without slack. Between points that are looked at, and with another
    /// idea of what is within reach, another block may be the nearest.
    pub(crate) fn worst_component(&self, point: &[f64]) -> f64 {
        let mut vector = AxisVec::zeros(point.len());
        let mut least = f64::INFINITY;
        let mut found: SmallVec<[(f64, f64); 16]> = SmallVec::new();
        for Candidate { passed, counts, .. } in &self.blocks {
            let square = passed.vector_to(point, &mut vector);
            if *counts {
                least = least.min(square);
            }
            found.push((square, vector.iter().fold(0.0, |m: f64, c| m.max(c.abs()))));
        }
        if least.is_infinite() {
            return 0.0;
        }
        let within = (1.0 + WARY) * (1.0 + WARY) * least;
        found.iter().filter(|f| f.0 <= within).map(|f| f.1).fold(0.0, f64::max)
    }
}

/// The block that the shortest vector starts on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest<'a> {
    /// Length of the vector in mm.
    pub(crate) distance: f64,
    /// Programmed block, the same for all parts of it.
    pub(crate) block: u64,
    passed: &'a Passed,
}

impl<'a> Nearest<'a> {
    /// Its path if it is a straight line.
    pub(crate) fn line(&self) -> Option<&'a LinePath> {
        match &self.passed.queued.block.path {
            Path::Line(line) => Some(line),
            _ => None,
        }
    }

    /// Shortest vector from the path of this block to a point, and its length in mm.
    pub(crate) fn vector_to(&self, point: &[f64], out: &mut [f64]) -> f64 {
        self.passed.vector_to(point, out).sqrt()
    }
}

/// Shortest vector from the paths of the blocks to a point; `None`, and no vector, if there are no blocks.
fn nearest<'a>(
    mut blocks: impl Iterator<Item = &'a Passed>,
    point: &[f64],
    out: &mut [f64],
) -> Option<Nearest<'a>> {
    let Some(first) = blocks.next() else {
        out.fill(0.0);
        return None;
    };
    let mut best = (first.vector_to(point, out), first);
    let mut before = first;
    let vector = &mut AxisVec::zeros(point.len())[..];
    for passed in blocks {
        // every path is searched over its whole length, so once is enough for its parts
        if before.is_part_of_the_same(passed) {
            continue;
        }
        before = passed;
        let square = passed.vector_to(point, vector);
        if square < best.0 {
            best = (square, passed);
            out.copy_from_slice(vector);
        }
    }
    let (square, passed) = best;
    Some(Nearest { distance: square.sqrt(), block: passed.queued.block.seq, passed })
}
