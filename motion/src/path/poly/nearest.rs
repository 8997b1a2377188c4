//! The point of a curve nearest to another point: samples of the sub-intervals that can contain it, then bisection and
//! Newton's method next to the best sample.

use super::{Cell, PolyPath};
use crate::path::piece::{PolyPiece, bend, slope, value};
use smallvec::SmallVec;
use std::cmp::Ordering;

/// Samples per sub-interval in the search for the nearest point.
const SAMPLES: usize = 8;

impl Cell {
    /// Parameter of the sample in the middle.
    pub(super) fn middle(&self) -> f64 {
        self.sample(SAMPLES / 2)
    }

    /// Parameter of sample `k` of [`SAMPLES`].
    fn sample(&self, k: usize) -> f64 {
        self.from + (self.to - self.from) / SAMPLES as f64 * k as f64
    }
}

/// Bound of the distance between a piece on a parameter range and its point in the middle: the Taylor polynomial there
/// has the values `sum a_k t^k` with `|t|` up to half the width.
pub(super) fn radius(piece: &PolyPiece, from: f64, to: f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let of_axis = |c: &[f64; 6]| {
        let mut a = *c;
        // one Horner pass per coefficient shifts the polynomial to the middle
        for k in 0..a.len() {
            for j in (k..a.len() - 1).rev() {
                a[j] += middle * a[j + 1];
            }
        }
        a[1..].iter().rev().fold(0.0, |sum, a| (sum + a.abs()) * half)
    };
    // the margin is far above the rounding error
    piece.iter().map(of_axis).map(|r| r * r).sum::<f64>().sqrt() * (1.0 + 1e-9)
}

impl PolyPath {
    /// Upper bound in mm of the distance of any point of the curve from `point`.
    pub(in crate::path) fn radius_around(&self, point: &[f64]) -> f64 {
        let distance =
            |q: &[f64]| q.iter().zip(point).map(|(q, p)| (q - p) * (q - p)).sum::<f64>().sqrt();
        // the ends are met exactly, the pieces only up to rounding
        let ends = distance(&self.start).max(distance(&self.end));
        let middles = self.middles.chunks_exact(self.start.len());
        let cells = self.cells.iter().zip(middles).map(|(c, middle)| distance(middle) + c.radius);
        cells.fold(ends, f64::max)
    }

    pub(crate) fn nearest(&self, point: &[f64]) -> f64 {
        let (cell, x) = self.search(point);
        let cell = &self.cells[cell];
        cell.s + self.gauss(cell.piece, cell.from, x)
    }

    pub(in crate::path) fn nearest_point(&self, point: &[f64], out: &mut [f64]) {
        let (i, x) = self.search(point);
        let cell = &self.cells[i];
        if i == 0 && x <= cell.from {
            out.copy_from_slice(&self.start);
        } else if i + 1 == self.cells.len() && x >= cell.to {
            out.copy_from_slice(&self.end);
        } else {
            self.point(cell.piece, x, out);
        }
    }

    /// Sub-interval and parameter of the nearest point.
    fn search(&self, point: &[f64]) -> (usize, f64) {
        let step = |cell: &Cell| (cell.to - cell.from) / SAMPLES as f64;
        let to_middle = |q: &[f64]| q.iter().zip(point).map(|(q, p)| (q - p) * (q - p)).sum();
        let middles: SmallVec<[f64; 8]> =
            self.middles.chunks_exact(self.start.len()).map(to_middle).collect();
        let mut best = (f64::INFINITY, 0, 0.0);
        let mut look = |i: usize| {
            let cell = &self.cells[i];
            // every point of a sub-interval is within its radius of the middle
            let reach = best.0.sqrt() * (1.0 + 1e-9) + cell.radius;
            if middles[i] > reach * reach {
                return;
            }
            let places = std::array::from_fn(|k| cell.sample(k));
            let squares: [f64; SAMPLES + 1] = squares(&self.pieces[cell.piece], point, &places);
            for (x, d) in places.into_iter().zip(squares) {
                if d < best.0 {
                    best = (d, i, x);
                }
            }
        };
        // the sub-interval with the nearest middle rules out most of the others
        let first = (0..middles.len()).min_by(|a, b| middles[*a].total_cmp(&middles[*b]));
        first.into_iter().for_each(&mut look);
        (0..middles.len()).filter(|i| Some(*i) != first).for_each(&mut look);
        // if the best sample is at the border of a sub-interval, the nearest point may be in the next one
        let (_, i, x) = best;
        let mut nearest = (f64::INFINITY, i, x);
        let beside = [i.checked_sub(1), Some(i + 1).filter(|j| *j < self.cells.len())];
        for j in [Some(i)].into_iter().chain(beside).flatten() {
            let cell = &self.cells[j];
            let reach = nearest.0.sqrt() * (1.0 + 1e-9) + cell.radius;
            if middles[j] > reach * reach {
                continue;
            }
            let step = step(cell);
            let (low, high) = match j.cmp(&i) {
                Ordering::Less => (cell.to - step, cell.to),
                Ordering::Equal => ((x - step).max(cell.from), (x + step).min(cell.to)),
                Ordering::Greater => (cell.from, cell.from + step),
            };
            let piece = &self.pieces[cell.piece];
            let x = closest(piece, point, low, high);
            let [d] = squares(piece, point, &[x]);
            // of equally near points the first
            if d < nearest.0 || d <= nearest.0 && j < nearest.1 {
                nearest = (d, j, x);
            }
        }
        (nearest.1, nearest.2)
    }
}

/// Squares of the distances of a point from some places of a piece.
#[inline]
fn squares<const N: usize>(piece: &PolyPiece, point: &[f64], places: &[f64; N]) -> [f64; N] {
    let mut squares = [0.0; N];
    // place by place inside, so that several are computed at once
    for (c, p) in piece.iter().zip(point) {
        for (square, x) in squares.iter_mut().zip(places) {
            let off = value(c, *x) - p;
            *square += off * off;
        }
    }
    squares
}

/// Zero of the derivative of the squared distance between two parameter values of a piece, by bisection and Newton's
/// method.
fn closest(piece: &PolyPiece, point: &[f64], low: f64, high: f64) -> f64 {
    let slopes = |x: f64| -> (f64, f64) {
        let (mut first, mut second) = (0.0, 0.0);
        for (c, p) in piece.iter().zip(point) {
            let (d0, d1, d2) = (value(c, x) - p, slope(c, x), bend(c, x));
            first += d0 * d1;
            second += d1 * d1 + d0 * d2;
        }
        (first, second)
    };
    if slopes(low).0 >= 0.0 {
        return low;
    }
    if slopes(high).0 <= 0.0 {
        return high;
    }
    let (mut low, mut high) = (low, high);
    let mut x = 0.5 * (low + high);
    for _ in 0..60 {
        let (first, second) = slopes(x);
        if first > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let newton = x - first / second;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 1e-15 {
            return next;
        }
        x = next;
    }
    x
}
