//! How far the filtered path leaves the contour: one definition for the planner, the trace and the summary.
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
//! (a) Every point of the *set path* (the filtered set points joined by straight lines) has a nearest point on the contour
//! that was interpolated within the reach of the filter.
//! (b) Every point of the contour has a nearest point on the set path of the cycles in which the filter still holds it: so
//! the tips of reversals, acute corners and whole detours count that a set path passes by without ever being far from
//! some other part of the contour.
//!
//! Both are shortest vectors over all axes; what is bounded by `AX_DEV` is each of their components. A plan is held to that.
//! In what is output, a point of (b) whose shortest vector exceeds the tolerance is within it if another vector is: the set
//! path comes to it. A way back that is a little nearer, but by another axis, can end with the last cycle that counts.
//!
//! Between two samples (a) is taken where it can be larger than at both of them: where the nearest point passes from one
//! block to another, and half way on a bent block. (b) is taken at the borders of blocks with a kink between them and, on
//! bent blocks, at the interpolated points. Along a straight block (b) follows from (a) by continuity, as long as all axes
//! have the same filter; otherwise the interpolated points count there, too.

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

/// Parts into which the line between two set points is divided at most where it is in doubt what is within reach.
const PARTS: u32 = 8;

/// Share by which a vector to a point of the contour may be longer than the shortest one and still be taken for it. On a
/// straight set path that is 4.5 % of the vector along the path.
pub(crate) const ALIKE: f64 = 1e-3;

/// Share by which a vector from the contour to a set point may be longer than the shortest one while its components count.
pub const HARDLY_LONGER: f64 = WARY;

/// Set points of consecutive cycles.
#[derive(Clone, Debug, Default)]
pub(crate) struct SetPath {
    axes: usize,
    first: u64,
    /// Axis by axis, cycle by cycle.
    values: Vec<f64>,
    /// Length of the set path in mm up to each set point, from some point before the first.
    ways: Vec<f64>,
}

/// The line of the set path that is nearest to a point.
struct Search {
    /// Square of its distance, and its number.
    best: (f64, u64),
    /// How far away another line may be that could be called the nearest one, in mm.
    alike: f64,
}

impl Search {
    /// Takes another line; the first one of those equally near is found.
    fn take(&mut self, k: u64, d2: f64) {
        if d2 < self.best.0 || d2 <= self.best.0 && k < self.best.1 {
            self.best = (d2, k);
            self.alike = (1.0 + ALIKE) * d2.sqrt();
        }
    }
}

/// Largest components found, with the vector that one of them belongs to.
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

    /// Largest absolute component.
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
    /// No set points yet; the next one is that of cycle `first`.
    pub(crate) fn starting(first: u64, axes: usize) -> Self {
        Self { axes, first, values: Vec::new(), ways: Vec::new() }
    }

    /// The set point of cycle `k` alone.
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

    /// Forgets what lies before cycle `k`, now and then.
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

    /// (a) between cycle `k - 1` and cycle `k`, from the contour interpolated between two moments (cycles). The shortest
    /// vector to the set point of cycle `k` comes back with its length in mm, if there is a contour.
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

    /// Largest component of (a) between cycle `k - 1` and cycle `k`, whatever could be called the shortest vector: from
    /// blocks within `slack` cycles of the two moments, too. Points of the line count at most `apart` mm from each other,
    /// as long as `PARTS` of them are enough.
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

    /// (b) of a point of the contour, from the set path between two cycles; returns the cycle that comes nearest and the
    /// vector to it. Beyond `wary_mm` whatever could be called the shortest vector counts.
    pub(crate) fn misses(
        &self,
        point: &[f64],
        (first, last): (u64, u64),
        wary_mm: f64,
        out: &mut Excursion,
    ) -> Option<(u64, AxisVec)> {
        let (first, last) = (first.max(self.first), last.min(self.end().checked_sub(1)?));
        if first >= last {
            return None;
        }
        // a first guess excuses most of the others: from one line to the next a distance falls by their length at most. What
        // is left is looked at from both ends: the point lies between them, so either end excuses its half at once
        let guess = first.midpoint(last);
        let guessed = self.to_line(guess, point).0;
        let mut search = Search { best: (guessed, guess), alike: (1.0 + ALIKE) * guessed.sqrt() };
        let mut near: SmallVec<[(u64, f64); 16]> = SmallVec::new();
        let mut look = |k: u64| {
            let d2 = if k == guess { guessed } else { self.to_line(k, point).0 };
            search.take(k, d2);
            if wary_mm.is_finite() {
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
        if d2 > wary_mm * wary_mm {
            let within = (1.0 + ALIKE) * (1.0 + ALIKE) * d2;
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

    /// The vector from a point of the contour to the set path between two cycles whose largest component is smallest.
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

    /// Distance in mm of a point from the line to the set point of cycle `k` from the one before.
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

    /// Square of the distance of a point from the line between cycle `k` and cycle `k + 1`, and where along the line.
    fn to_line(&self, k: u64, point: &[f64]) -> (f64, f64) {
        let n = point.len();
        let ends = k.checked_sub(self.first).and_then(|at| {
            let at = at as usize * n;
            self.values.get(at..at + 2 * n)
        });
        let Some((a, b)) = ends.map(|ends| ends.split_at(n)) else { return (f64::INFINITY, 0.0) };
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

    /// The shortest vector from a point to the line between cycle `k` and cycle `k + 1`.
    fn aside(&self, k: u64, point: &[f64], vector: &mut [f64]) {
        let u = self.to_line(k, point).1;
        let (Some(a), Some(b)) = (self.get(k), self.get(k + 1)) else { return };
        for (((v, p), a), b) in vector.iter_mut().zip(point).zip(a).zip(b) {
            *v = a + u * (b - a) - p;
        }
    }
}
