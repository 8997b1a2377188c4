//! The blocks near a line between two set points, out of those within reach of the filters.

use super::sight::Sight;
use super::{Contour, Passed, ROUNDING_MM, WARY};
use crate::axis::AxisVec;
use crate::path::{LinePath, Path};
use smallvec::SmallVec;
use std::ops::Range;

impl Contour {
    /// The blocks that can be nearest to a point on the line between two points, or may count as such, out of those
    /// interpolated between two moments (cycles), and of those interpolated up to `slack` cycles before and after. The
    /// distance of a block from any point on the line differs from that to the midpoint by at most half the length of
    /// the line.
    ///
    /// `sight` holds the distances known from earlier lines; it has no influence on which blocks are found.
    pub(crate) fn around(
        &self,
        line: (&[f64], &[f64]),
        moments: (f64, f64),
        slack: (f64, f64),
        sight: &mut Sight,
    ) -> Around<'_> {
        let reached = self.within_reach(moments, sight);
        let among = reached.start..self.whole(reached.end);
        let all = self.with_slack(&reached, &among, moments, slack);
        let n = line.0.len();
        let (a, b) = (&line.0[..n], &line.1[..n]);
        let middle = &mut AxisVec::zeros(n)[..n];
        let mut half = 0.0;
        for i in 0..n {
            middle[i] = 0.5 * (a[i] + b[i]);
            half += 0.25 * (b[i] - a[i]) * (b[i] - a[i]);
        }
        let half: f64 = f64::sqrt(half);
        sight.look_from(middle, self.number(all.start)..self.number(all.end));
        let mut around = Around { blocks: SmallVec::new(), half };
        if self.is_of_one_path(all.clone()) {
            let (i, counts) = (all.start.max(among.start), !among.is_empty());
            let passed = &self.blocks[i];
            let (block, distance) = (passed.queued.block.seq, 0.0);
            around.blocks.push(Candidate { passed, block, distance, counts });
            return around;
        }
        self.search(middle, &among, all, sight, &mut around);
        around
    }

    /// Adds the blocks out of `all` that can be nearest to a point on the line around `middle`; those of `among` count.
    fn search<'a>(
        &'a self,
        middle: &[f64],
        among: &Range<usize>,
        all: Range<usize>,
        sight: &mut Sight,
        around: &mut Around<'a>,
    ) {
        let vector = &mut AxisVec::zeros(middle.len())[..];
        let half = around.half;
        let within = |least: f64| (1.0 + WARY) * (least + half) + half;
        // a filter usually delays the set point by half its length: the block there rules out most of the others
        let last = sight.nearest.and_then(|number| self.index(number));
        let guess = last
            .filter(|i| among.contains(i))
            .or_else(|| Some(all.start.midpoint(all.end)).filter(|i| among.contains(i)));
        let mut far = |passed: &Passed| passed.vector_to(middle, vector).sqrt();
        let guessed = guess.map_or(f64::INFINITY, |i| far(&self.blocks[i]));
        let mut most = within(guessed);
        let mut nearest = (f64::INFINITY, sight.nearest);
        let way = sight.way();
        for (i, clear) in all.zip(sight.clear()) {
            let is_guess = guess == Some(i);
            if !is_guess && *clear > way + most + ROUNDING_MM {
                continue;
            }
            let passed = &self.blocks[i];
            let distance = if is_guess {
                guessed
            } else {
                let ball = passed.queued.ball.as_ref();
                let bound = ball.map_or(0.0, |ball| ball.distance_from(middle));
                if bound > most + ROUNDING_MM {
                    *clear = way + bound;
                    continue;
                }
                far(passed)
            };
            *clear = way + distance;
            if distance > most {
                continue;
            }
            let (block, counts) = (passed.queued.block.seq, among.contains(&i));
            if counts {
                most = most.min(within(distance));
                if distance < nearest.0 {
                    nearest = (distance, Some(self.number(i)));
                }
            }
            around.blocks.push(Candidate { passed, block, distance, counts });
        }
        sight.nearest = nearest.1;
        around.blocks.retain(|b| b.distance <= most);
    }

    /// Whether all blocks that [`Self::around`] searches are parts of one path: no point has vectors from several.
    pub(crate) fn is_one_path(
        &self,
        moments: (f64, f64),
        slack: (f64, f64),
        sight: &mut Sight,
    ) -> bool {
        let reached = self.within_reach(moments, sight);
        let among = reached.start..self.whole(reached.end);
        self.is_of_one_path(self.with_slack(&reached, &among, moments, slack))
    }

    fn is_of_one_path(&self, all: Range<usize>) -> bool {
        let mut blocks = self.blocks.range(all);
        blocks.next().is_some_and(|first| blocks.all(|passed| first.is_part_of_the_same(passed)))
    }

    /// Entries interpolated between two moments (cycles).
    #[inline]
    pub(super) fn within_reach(&self, (from, to): (f64, f64), sight: &mut Sight) -> Range<usize> {
        let index = |number: u64| self.index(number).unwrap_or_default();
        let (entered, end) = match sight.entered {
            Some((first, end)) => {
                (self.entered_near(from, index(first)), self.entered_near(to, index(end)))
            }
            None => (self.entered(from), self.entered(to)),
        };
        sight.entered = Some((self.number(entered), self.number(end)));
        let start = entered.saturating_sub(1);
        start..end.max(start)
    }

    /// Blocks interpolated up to `slack` cycles before and after two moments, between which the entries `reached` were, and as whole
    /// blocks those of `among`.
    fn with_slack(
        &self,
        reached: &Range<usize>,
        among: &Range<usize>,
        (from, to): (f64, f64),
        slack: (f64, f64),
    ) -> Range<usize> {
        let mut all = reached.clone();
        while all.start > 0 && self.blocks[all.start].cycles > from - slack.0 {
            all.start -= 1;
        }
        while self.blocks.get(all.end).is_some_and(|b| b.cycles <= to + slack.1) {
            all.end += 1;
        }
        all.end = if all.end == reached.end { among.end } else { self.whole(all.end) };
        all
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
    /// Distance from the midpoint of the line in mm, to compare several; 0 if there is one path only.
    distance: f64,
    /// Whether it is within reach without the slack.
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

    /// Whether the slack adds no block, so that [`Self::nearest`] and [`Self::nearest_of_all`] are the same.
    pub(crate) fn all_count(&self) -> bool {
        self.blocks.iter().all(|b| b.counts)
    }

    /// Whether there is one block only.
    pub(crate) fn is_single(&self) -> bool {
        self.blocks.len() == 1
    }

    /// Whether another block can be nearer somewhere on the line. Over half the line the two distances can change by at
    /// most half its length each.
    pub(crate) fn may_be_nearer_than(&self, nearest: &Nearest<'_>) -> bool {
        let (mut own, mut other) = (f64::INFINITY, f64::INFINITY);
        for b in &self.blocks {
            let least = if b.block == nearest.block { &mut own } else { &mut other };
            *least = least.min(b.distance);
        }
        other.is_finite() && other <= own + 2.0 * self.half
    }

    /// Largest component of all vectors to a point that may count as the shortest: those from any block that are longer
    /// than the shortest one without slack by at most `WARY`. Between the examined points, and with a different
    /// definition of reach, another block may be the nearest. The point lies on the line, `off` mm from its midpoint.
    pub(crate) fn worst_component(&self, point: &[f64], off: f64) -> f64 {
        let counting = self.blocks.iter().filter(|b| b.counts);
        let Some(guess) = counting.min_by(|a, b| a.distance.total_cmp(&b.distance)) else {
            return 0.0;
        };
        let mut vector = AxisVec::zeros(point.len());
        let mut found: SmallVec<[(f64, f64); 16]> = SmallVec::new();
        let mut measure = |passed: &Passed| {
            let square = passed.vector_to(point, &mut vector);
            found.push((square, vector.iter().fold(0.0, |m: f64, c| m.max(c.abs()))));
            square
        };
        let alike = (1.0 + WARY) * (1.0 + WARY);
        let mut least = measure(guess.passed);
        for b in self.blocks.iter().filter(|b| !std::ptr::eq(*b, guess)) {
            let bound = (b.distance - off - ROUNDING_MM).max(0.0);
            if bound * bound > alike * least {
                continue;
            }
            let square = measure(b.passed);
            if b.counts {
                least = least.min(square);
            }
        }
        let within = alike * least;
        found.iter().filter(|f| f.0 <= within).map(|f| f.1).fold(0.0, f64::max)
    }
}

/// The block from which the shortest vector starts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest<'a> {
    /// Length of the vector in mm.
    pub(crate) distance: f64,
    /// Programmed block; all its parts have the same number.
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
pub(super) fn nearest<'a>(
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
        // every path is searched over its whole length, so one search covers all its parts
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::{Arc, block};
    use crate::path::{ArcPath, ArcShape};
    use crate::queue::Queued;
    use kontur_filters::time::CycleTime;
    use proptest::prelude::*;

    /// One block per three cycles; each turns by an angle in rad and has a length in mm; some are arcs.
    fn contour(turns: &[(f64, f64, bool)]) -> (Contour, Vec<Path>) {
        let (mut contour, mut paths) = (Contour::default(), Vec::new());
        let (mut at, mut heading, mut s_mm) = ([0.0, 0.0], 0.0, 0.0);
        for ((turn, length, is_arc), i) in turns.iter().zip(0_u32..) {
            heading += turn;
            let (sin, cos) = libm::sincos(heading);
            let to = if *is_arc {
                // half a circle to the left
                [at[0] - length * sin, at[1] + length * cos]
            } else {
                [at[0] + length * cos, at[1] + length * sin]
            };
            let mut block = block(u64::from(i) + 1, at, to, 10.0);
            if *is_arc {
                let centre_mm = [0.5 * (at[0] + to[0]), 0.5 * (at[1] + to[1])];
                let shape = ArcShape { plane: [0, 1], centre_mm, sweep_rad: std::f64::consts::PI };
                let [from, to] = [at, to].map(|p| AxisVec::from_slice(&p));
                block.path = Path::Arc(ArcPath::new(from, to, shape, &[true; 2]).unwrap());
                heading += std::f64::consts::PI;
            }
            paths.push(block.path.clone());
            let cycle = CycleTime::from_us(1000).unwrap();
            contour.enter(3.0 * f64::from(i), s_mm, Arc::new(Queued::new(block, cycle)));
            s_mm += paths[paths.len() - 1].length();
            at = to;
        }
        (contour, paths)
    }

    /// Distance of a point from 400 points on each path, and the spacing of these points.
    fn of_many_points(paths: &[Path], point: [f64; 2]) -> (f64, f64) {
        let (mut least, mut apart, mut q) = (f64::INFINITY, 0.0_f64, [0.0; 2]);
        for path in paths {
            for i in 0..=400 {
                path.position(path.length() * f64::from(i) / 400.0, &mut q);
                least = least.min(libm::hypot(q[0] - point[0], q[1] - point[1]));
            }
            apart = apart.max(path.length() / 400.0);
        }
        (least, apart)
    }

    /// Largest component of the vectors from some blocks to a point, each with a weight that depends on the ratio of its
    /// length to the shortest one of the blocks that count.
    fn largest_of<'a>(
        blocks: impl Iterator<Item = (&'a Passed, bool)>,
        point: &[f64; 2],
        weight: impl Fn(f64) -> f64,
    ) -> f64 {
        let vectors = blocks.map(|(passed, counts)| {
            let path = &passed.queued.block.path;
            let mut q = [0.0; 2];
            path.position(path.nearest(point), &mut q);
            let off = [0, 1].map(|i| (point[i] - q[i]).abs());
            (libm::hypot(off[0], off[1]), off[0].max(off[1]), counts)
        });
        let vectors: Vec<_> = vectors.collect();
        let counting = vectors.iter().filter(|v| v.2);
        let least = counting.map(|v| v.0).fold(f64::INFINITY, f64::min);
        vectors.iter().map(|v| v.1 * weight(v.0 / least)).fold(0.0, f64::max)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// Set points that trail a contour, with jumps. On every line between two of them the nearest block is found,
        /// and the result with the distances from earlier lines is that of a fresh search, also while blocks are
        /// forgotten.
        #[test]
        fn what_is_known_from_earlier_lines_hides_no_block(
            turns in prop::collection::vec((-2.5..2.5f64, 0.02..3.0f64, prop::bool::weighted(0.2)), 3..30),
            asides in prop::collection::vec(prop::array::uniform2(-0.6..0.6f64), 8),
            (wide, late, reach) in (prop::bool::ANY, 0..9_u32, 3..14_u32),
            u in 0.0..1.0f64,
        ) {
            let (mut contour, paths) = contour(&turns);
            let (mut sight, mut of_points, mut before) = (Sight::default(), Sight::default(), [0.0; 2]);
            for k in 0..3 * turns.len() as u32 {
                let mut here = [0.0; 2];
                let at = k.saturating_sub(late);
                let path = &paths[at as usize / 3];
                path.position(path.length() * f64::from(at % 3) / 3.0, &mut here);
                for (here, aside) in here.iter_mut().zip(asides[k as usize % 8]) {
                    *here += if wide { aside } else { 0.01 * aside };
                }
                let (from, to) = (f64::from(k) - f64::from(reach), f64::from(k));
                let around = contour.around((&before, &here), (from, to), (1.0, 0.0), &mut sight);
                let other = contour.around((&before, &here), (from, to), (1.0, 0.0), &mut Sight::default());
                let reached = &paths[(from.max(0.0) / 3.0) as usize..=k as usize / 3];
                for u in [0.0, u, 1.0] {
                    let point = [0, 1].map(|i| before[i] + u * (here[i] - before[i]));
                    let mut vectors = [[0.0; 2]; 4];
                    let found = around.nearest(&point, &mut vectors[0]).unwrap();
                    let alone = contour.nearest(&point, from, to, &mut vectors[1]).unwrap();
                    prop_assert_eq!((found.block, vectors[0]), (alone.block, vectors[1]));
                    let (many, apart) = of_many_points(reached, point);
                    prop_assert!((found.distance - many).abs() <= apart, "{} {many}", found.distance);
                    let all = around.nearest_of_all(&point, &mut vectors[2]).unwrap();
                    let others = other.nearest_of_all(&point, &mut vectors[3]).unwrap();
                    prop_assert_eq!((all.block, vectors[2]), (others.block, vectors[3]));
                    prop_assert!(all.distance <= found.distance);
                    let of_all = around.blocks.iter().map(|b| (b.passed, b.counts));
                    let alike = |ratio| f64::from(ratio <= 1.0 + WARY);
                    let most = largest_of(of_all, &point, alike);
                    let off = (u - 0.5).abs() * 2.0 * around.half;
                    prop_assert!((around.worst_component(&point, off) - most).abs() < 1e-12);
                }
                // any blocks of the contour, also those far from the point
                let count = contour.blocks.len();
                let [i, j] = asides[k as usize % 8].map(|at| ((at + 0.6) * 0.8 * count as f64) as usize);
                let (i, j) = (i.min(j), i.max(j));
                let blocks = contour.blocks.range(i..=j).map(|passed| (passed, true));
                let most = largest_of(blocks, &here, |ratio| libm::pow(ratio, -8.0).min(1.0));
                let stretch = [i, j].map(|i| contour.blocks[i].s_mm);
                prop_assert!((contour.aside(&here, stretch[0], stretch[1]) - most).abs() < 1e-12);
                let mut vectors = [[0.0; 2]; 2];
                let seen = contour.nearest_in_sight(&here, (from, to), &mut of_points, &mut vectors[0]);
                let alone = contour.nearest(&here, from, to, &mut vectors[1]).map(|n| n.distance);
                prop_assert_eq!((seen, vectors[0]), (alone, vectors[1]));
                before = here;
                drop((around, other));
                contour.forget_before(from - 4.0, drop);
            }
        }
    }
}
