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
//! contour that was interpolated within the reach of the filter; a block of which any part was counts in its whole
//! length.
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
mod set_path;
#[cfg(test)]
mod tests;

use crate::axis::AxisVec;
use crate::contour::{Contour, ROUNDING_MM, Sight, WARY};
pub(crate) use meter::What;
pub use meter::{Change, Meter};
pub(crate) use set_path::{SetPath, distance};
use smallvec::SmallVec;

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
        let mut vector = AxisVec::zeros(self.axes());
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
        let mut point = AxisVec::zeros(a.len());
        let component = |part: u32| {
            let u = f64::from(part) / f64::from(parts);
            between::on_the_line((a, b), u, &mut point);
            around.worst_component(&point, (u - 0.5).abs() * length)
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
        let (first, last) = (first.max(self.first()), last.min(self.end().checked_sub(1)?));
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
        let (mut low, mut high) = (first, last);
        while low < high {
            let certain = self.way(low + 1) + look(low);
            low = self.first_beyond(certain, (low + 1, high));
            if low < high {
                high -= 1;
                let certain = self.way(high) - look(high);
                high = self.last_before(certain, (low, high));
            }
        }
        let (d2, k) = search.best;
        let mut vector = AxisVec::zeros(self.axes());
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
        let mut vector = AxisVec::zeros(self.axes());
        let mut best: Option<(f64, AxisVec)> = None;
        for k in first.max(self.first())..last.min(self.end().saturating_sub(1)) {
            let (Some(from), Some(to)) = (self.get(k), self.get(k + 1)) else { continue };
            let largest = component::least(point, (from, to), &mut vector);
            if best.as_ref().is_none_or(|(least, _)| largest < *least) {
                best = Some((largest, vector.clone()));
            }
        }
        best.map(|(_, vector)| vector)
    }
}
