//! How far the filtered path leaves the contour: one definition for planner, trace and summary.
//!
//! ```text
//!             (b) corner -> set path
//!        V  .---- the vertex is missed by this much
//!        |\ v
//!   -----+-*.                set points *, joined by straight lines,
//!      ^    *--*----*---     because the drive interpolates between them
//!      |        (a) set path -> contour
//!   contour
//! ```
//!
//! (a) Every point of the *set path* (the filtered set points joined by straight lines) has a nearest point on the
//! contour that was interpolated within the reach of the filter.
//! (b) Every point of the contour has a nearest point on the set path of those cycles in which the filter still holds
//! it. This covers the tips of reversals, acute corners and whole detours that a set path misses without ever being far
//! from some other part of the contour.
//!
//! Both are shortest vectors over all axes; `AX_DEV` bounds each of their components. Plans are checked against this
//! definition. In the output, a point of (b) whose shortest vector exceeds the tolerance still counts as within it if
//! another vector to the set path does not exceed it, since the set path gets there. The shortest vector may lead to a
//! way back that is only slightly nearer, along another axis, and that ends with the last cycle that counts.
//!
//! Between two samples (a) is evaluated where it can be larger than at both of them: where the nearest point moves from
//! one block to another, and at the middle of a curved block. (b) is evaluated at block boundaries with a kink and, on
//! curved blocks, at the interpolated points. Along a straight block (b) is not longer than (a) by continuity, as long as
//! all axes have the same filter, and has about its direction. Where the vector of (a) turns from one cycle to the next,
//! beside a corner, (b) has directions between. In the output of a run without a tolerance, the interpolated points that
//! the filters hold are evaluated there on straight blocks as well, and points between them: where the nearest point
//! passes to another part of the set path, because the vector then turns, and on curved blocks whose points are far apart;
//! all of them only where they may be larger than the largest ones of the run so far, because what counts is the largest
//! value of a run. With unequal filters the interpolated points are evaluated on all blocks. The planner chooses its
//! points by a bound on what lies between them.

mod between;
mod component;
mod gauge;
mod meter;
#[cfg(test)]
mod tests;

use crate::axis::AxisVec;
use crate::contour::{Contour, ROUNDING_MM, Sight, WARY};
pub(crate) use meter::What;
pub use meter::{Change, Meter};
use smallvec::SmallVec;
use std::ops::Range;

/// A block whose tolerance could not be kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unkept {
    /// Number of the block.
    pub seq: u64,
    /// Remaining deviation in mm.
    pub deviation_mm: f64,
    /// Tolerance in mm.
    pub tolerance_mm: f64,
}

/// Largest number of parts into which the line between two set points is divided where the reach is in doubt.
const PARTS: u32 = 8;

/// Relative excess in length up to which a vector to a point of the contour may count as the shortest one. On a
/// straight set path that is 4.5 % of the vector along the path.
pub(crate) const ALIKE: f64 = 1e-3;

/// Relative excess in length up to which the components of a vector from the contour to a set point count.
pub const HARDLY_LONGER: f64 = WARY;

/// Set points of consecutive cycles.
#[derive(Clone, Debug, Default)]
pub(crate) struct SetPath {
    axes: usize,
    first: u64,
    /// Coordinates of all axes, cycle after cycle.
    values: Vec<f64>,
    /// Length of the set path in mm at each set point, measured from some point before the first.
    ways: Vec<f64>,
}

/// The line of the set path that is nearest to a point.
struct Search {
    /// Square of the distance in mm2, and number of the line.
    best: (f64, u64),
    /// Distance in mm up to which another line may count as the nearest one.
    alike: f64,
}

impl Search {
    /// Considers another line; of equally near lines the first is kept.
    fn take(&mut self, k: u64, d2: f64) {
        if d2 < self.best.0 || d2 <= self.best.0 && k < self.best.1 {
            self.best = (d2, k);
            self.alike = (1.0 + ALIKE) * d2.sqrt();
        }
    }
}

/// Largest components found, and the length of the vectors.
#[derive(Clone, Debug, Default)]
pub(crate) struct Excursion {
    /// Component with the largest absolute value, per axis.
    pub(crate) vector: AxisVec,
    /// Length of the longest vector in mm.
    pub(crate) length: f64,
}

impl Excursion {
    pub(crate) fn none(axes: usize) -> Self {
        Self { vector: AxisVec::zeros(axes), length: 0.0 }
    }

    fn clear(&mut self) {
        self.vector.fill(0.0);
        self.length = 0.0;
    }

    fn take(&mut self, vector: &[f64]) {
        let n = vector.len();
        let kept = &mut self.vector[..n];
        let mut square = 0.0;
        for i in 0..n {
            if vector[i].abs() > kept[i].abs() {
                kept[i] = vector[i];
            }
            square += vector[i] * vector[i];
        }
        self.length = self.length.max(f64::sqrt(square));
    }

    /// Largest absolute component in mm.
    pub(crate) fn largest(&self) -> f64 {
        self.vector.iter().fold(0.0, |m, c| m.max(c.abs()))
    }

    /// Axis of the largest component.
    pub(crate) fn axis(&self) -> usize {
        let abs = |i: &usize| self.vector[*i].abs();
        (0..self.vector.len()).max_by(|a, b| abs(a).total_cmp(&abs(b))).unwrap_or(0)
    }
}

impl SetPath {
    /// Without set points; the next one is that of cycle `first`.
    pub(crate) fn starting(first: u64, axes: usize) -> Self {
        Self { axes, first, values: Vec::new(), ways: Vec::new() }
    }

    /// Restarts with the set point of cycle `k` only.
    fn restart(&mut self, k: u64, point: &[f64]) {
        (self.axes, self.first) = (point.len(), k);
        self.values.clear();
        self.ways.clear();
        self.push(point);
    }

    pub(crate) fn axes(&self) -> usize {
        self.axes
    }

    /// Adds the set point of the next cycle.
    pub(crate) fn push(&mut self, point: &[f64]) {
        let n = point.len();
        let way = self.ways.last().map_or(0.0, |way| {
            let before = &self.values[self.values.len() - n..][..n];
            let mut square = 0.0;
            for i in 0..n {
                square += (point[i] - before[i]) * (point[i] - before[i]);
            }
            way + f64::sqrt(square)
        });
        self.ways.push(way);
        self.values.extend_from_slice(point);
    }

    /// The cycle after the last one.
    pub(crate) fn end(&self) -> u64 {
        self.first + self.ways.len() as u64
    }

    /// Forgets the set points before cycle `k`; not in every call.
    pub(crate) fn forget_before(&mut self, k: u64) {
        let old = (k.saturating_sub(self.first) as usize).min(self.ways.len());
        if 2 * old > self.ways.len() {
            self.values.drain(..old * self.axes);
            self.ways.drain(..old);
            self.first += old as u64;
        }
    }

    pub(crate) fn get(&self, k: u64) -> Option<&[f64]> {
        let at = k.checked_sub(self.first)? as usize * self.axes;
        self.values.get(at..at + self.axes)
    }

    /// (a) between cycle `k - 1` and cycle `k`, from the contour interpolated between two moments (cycles). Returns the
    /// shortest vector to the set point of cycle `k` with its length in mm, if there is a contour.
    pub(crate) fn leaves(
        &self,
        contour: &Contour,
        k: u64,
        (from, to): (f64, f64),
        sight: &mut Sight,
        out: &mut Excursion,
    ) -> Option<(f64, AxisVec)> {
        let here = self.get(k)?;
        let mut vector = AxisVec::zeros(self.axes);
        let Some(before) = k.checked_sub(1).and_then(|k| self.get(k)) else {
            let now = contour.nearest(here, from, to, &mut vector);
            out.take(&vector);
            return now.map(|now| (now.distance, vector));
        };
        let around = contour.around((before, here), (from, to), (1.0, 0.0), sight);
        let now = around.nearest(here, &mut vector);
        out.take(&vector);
        let shortest = now.map(|now| (now.distance, vector.clone()));
        between::largest(&around, (before, here), now, out);
        shortest
    }

    /// Largest component of (a) between cycle `k - 1` and cycle `k` over all vectors that may count as the shortest,
    /// including those from blocks within `slack` cycles of the two moments. Points on the line are at most `apart` mm
    /// from each other, as long as `PARTS` of them are enough.
    pub(crate) fn doubtful(
        &self,
        contour: &Contour,
        k: u64,
        (from, to): (f64, f64),
        (slack, apart): (f64, f64),
        sight: &mut Sight,
    ) -> f64 {
        let ends = k.checked_sub(1).and_then(|before| Some((self.get(before)?, self.get(k)?)));
        let Some((a, b)) = ends else { return 0.0 };
        let around = contour.around((a, b), (from, to), (slack, slack), sight);
        let length = a.iter().zip(b).map(|(a, b)| (b - a) * (b - a)).sum::<f64>().sqrt();
        let parts = (length / apart).ceil().clamp(1.0, f64::from(PARTS)) as u32;
        let component = |part: u32| {
            let u = f64::from(part) / f64::from(parts);
            let point: AxisVec = a.iter().zip(b).map(|(a, b)| a + u * (b - a)).collect();
            around.worst_component(&point)
        };
        (1..=parts).map(component).fold(0.0, f64::max)
    }

    /// (b) of a point of the contour, from the set path between two cycles; returns the cycle that comes nearest and
    /// the vector to it. Beyond `wary_mm` every vector that may count as the shortest is included. `near`: a cycle that
    /// may come near; it does not change the result.
    pub(crate) fn misses(
        &self,
        point: &[f64],
        (first, last): (u64, u64),
        near: Option<u64>,
        wary_mm: f64,
        out: &mut Excursion,
    ) -> Option<(u64, AxisVec)> {
        let (first, last) = (first.max(self.first), last.min(self.end().checked_sub(1)?));
        if first >= last {
            return None;
        }
        // a first guess rules out most other lines: between neighbouring lines a distance falls by their length at
        // most. The remaining ones are examined from both ends: the line lies between them, so that each end rules out
        // its half at once
        let guess = near.map_or(first.midpoint(last), |k| k.clamp(first + 1, last) - 1);
        let guessed = self.to_line(guess, point).0;
        let mut search = Search { best: (guessed, guess), alike: (1.0 + ALIKE) * guessed.sqrt() };
        // the shortest vector found so far is not shorter than the one found in the end
        let mut near: SmallVec<[(u64, f64); 16]> = SmallVec::new();
        let (wary, alike) = (wary_mm * wary_mm, (1.0 + ALIKE) * (1.0 + ALIKE));
        let mut look = |k: u64| {
            let d2 = if k == guess { guessed } else { self.to_line(k, point).0 };
            search.take(k, d2);
            let shortest = search.best.0;
            if shortest > wary && d2 <= alike * shortest {
                near.push((k, d2));
            }
            d2.sqrt() - search.alike - ROUNDING_MM
        };
        let way = |k: u64| self.ways[(k - self.first) as usize];
        let (mut low, mut high) = (first, last);
        while low < high {
            let certain = way(low + 1) + look(low);
            low += 1;
            while low < high && way(low + 1) < certain {
                low += 1;
            }
            if low < high {
                high -= 1;
                let certain = way(high) - look(high);
                while low < high && way(high - 1) > certain {
                    high -= 1;
                }
            }
        }
        let (d2, k) = search.best;
        let mut vector = AxisVec::zeros(self.axes);
        self.aside(k, point, &mut vector);
        out.take(&vector);
        let nearest = vector.clone();
        if d2 > wary {
            let within = alike * d2;
            near.sort_unstable_by_key(|(k, _)| *k);
            for (k, d2) in near {
                if d2 <= within {
                    self.aside(k, point, &mut vector);
                    out.take(&vector);
                }
            }
        }
        Some((k + 1, nearest))
    }

    /// The vector from a point of the contour to the set path between two cycles with the smallest largest component.
    fn reaches(&self, point: &[f64], (first, last): (u64, u64)) -> Option<AxisVec> {
        let mut vector = AxisVec::zeros(self.axes);
        let mut best: Option<(f64, AxisVec)> = None;
        for k in first.max(self.first)..last.min(self.end().saturating_sub(1)) {
            let (Some(from), Some(to)) = (self.get(k), self.get(k + 1)) else { continue };
            let largest = component::least(point, (from, to), &mut vector);
            if best.as_ref().is_none_or(|(least, _)| largest < *least) {
                best = Some((largest, vector.clone()));
            }
        }
        best.map(|(_, vector)| vector)
    }

    /// Distance in mm of a point from the line that ends at the set point of cycle `k`.
    pub(crate) fn distance(&self, k: u64, point: &[f64]) -> f64 {
        self.to_line(k.saturating_sub(1), point).0.sqrt()
    }

    /// Largest distance in mm of the set points of some cycles from the line through two points.
    pub(crate) fn bulge(&self, cycles: Range<u64>, from: &[f64], to: &[f64]) -> f64 {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let minus = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<AxisVec>();
        let along = minus(to, from);
        let square = dot(&along, &along);
        let beside = cycles.filter_map(|k| {
            let off = minus(self.get(k)?, from);
            let part = dot(&off, &along);
            let on_line = if square > 0.0 { part * part / square } else { 0.0 };
            Some(dot(&off, &off) - on_line)
        });
        beside.fold(0.0, f64::max).sqrt()
    }

    /// Sum of the angles in rad between the lines that end at the set points of some cycles; those known so far.
    pub(crate) fn turn(&self, cycles: Range<u64>) -> f64 {
        let n = self.axes;
        let mut before: Option<AxisVec> = None;
        let mut sum = 0.0;
        for k in cycles {
            let (Some(from), Some(to)) = (k.checked_sub(1).and_then(|k| self.get(k)), self.get(k))
            else {
                continue;
            };
            let mut along = AxisVec::zeros(n);
            let mut square = 0.0;
            for i in 0..n {
                along[i] = to[i] - from[i];
                square += along[i] * along[i];
            }
            if square > 0.0 {
                let scale = 1.0 / f64::sqrt(square);
                along.iter_mut().for_each(|c| *c *= scale);
                if let Some(before) = &before {
                    // the chord of the angle
                    let chord = along
                        .iter()
                        .zip(before.iter())
                        .map(|(a, b)| (a - b) * (a - b))
                        .sum::<f64>();
                    sum += 2.0 * libm::asin((0.5 * chord.sqrt()).min(1.0));
                }
                before = Some(along);
            }
        }
        sum
    }

    /// The shortest vector from a point to the lines between all set points.
    pub(crate) fn shortest(&self, point: &[f64]) -> AxisVec {
        let lines = self.first..self.end().saturating_sub(1);
        let nearest =
            lines.min_by(|a, b| self.to_line(*a, point).0.total_cmp(&self.to_line(*b, point).0));
        let mut vector = AxisVec::zeros(self.axes);
        if let Some(k) = nearest {
            self.aside(k, point, &mut vector);
        }
        vector
    }

    /// Square of the distance in mm2 of a point from the line between cycle `k` and cycle `k + 1`, and the position on
    /// the line.
    fn to_line(&self, k: u64, point: &[f64]) -> (f64, f64) {
        let n = point.len();
        let ends = k.checked_sub(self.first).and_then(|at| {
            let at = at as usize * n;
            self.values.get(at..at + 2 * n)
        });
        let Some((a, b)) = ends.map(|ends| ends.split_at(n)) else { return (f64::INFINITY, 0.0) };
        // the numbers of axes that occur have loops of known length
        match n {
            2 => foot(&a[..2], &b[..2], &point[..2]),
            3 => foot(&a[..3], &b[..3], &point[..3]),
            4 => foot(&a[..4], &b[..4], &point[..4]),
            _ => foot(a, b, point),
        }
    }

    /// The shortest vector from a point to the line between cycle `k` and cycle `k + 1`.
    fn aside(&self, k: u64, point: &[f64], vector: &mut [f64]) {
        let u = self.to_line(k, point).1;
        let (Some(a), Some(b)) = (self.get(k), self.get(k + 1)) else { return };
        for (((v, p), a), b) in vector.iter_mut().zip(point).zip(a).zip(b) {
            *v = a + u * (b - a) - p;
        }
    }
}

/// Square of the distance in mm2 of a point from the line between two others, and the position on the line.
#[inline]
fn foot(a: &[f64], b: &[f64], point: &[f64]) -> (f64, f64) {
    let n = a.len();
    let (b, point) = (&b[..n], &point[..n]);
    let (mut dot, mut norm) = (0.0, 0.0);
    for i in 0..n {
        let d = b[i] - a[i];
        dot += (point[i] - a[i]) * d;
        norm += d * d;
    }
    let u = if norm > 0.0 { (dot / norm).clamp(0.0, 1.0) } else { 0.0 };
    let mut d2 = 0.0;
    for i in 0..n {
        let c = a[i] + u * (b[i] - a[i]) - point[i];
        d2 += c * c;
    }
    (d2, u)
}
