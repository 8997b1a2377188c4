//! Curve of piecewise polynomials up to degree five per axis, parameterised by path length.
//!
//! Each piece has a parameter `x` in `0..=1`. Its arc length over the feed axes is integrated by Gauss quadrature with
//! five points, on sub-intervals that are halved until the whole and the sum of both halves agree; `s` is converted to
//! `x` by Newton's method on the table of sub-intervals.

mod nearest;

use super::extremes;
use super::piece::{self, Coefficients, Pace, PolyPiece, section, slope, value};
use crate::axis::AxisVec;
use smallvec::SmallVec;
use std::sync::{Arc, OnceLock};

/// Agreement of the integral over a sub-interval with that over its halves, relative to the length of the curve.
const SPLIT: f64 = 1e-13;
/// Largest depth of halving.
const DEPTH: u32 = 12;
/// Newton step, as a share of a sub-interval, that is the last one: the step squares the error, so that only rounding is left.
const EXACT: f64 = 1e-8;
/// As [`EXACT`], where 1e-7 of the length is enough ([`PolyPath::near`]).
const GUESS: f64 = 1e-4;

/// Smallest distance beyond its ends that counts for a curve, in mm and relative to its position: less is rounding.
const BEYOND: (f64, f64) = (1e-9, 1e-12);

/// Gauss-Legendre on `-1..=1`: nodes and weights for five points.
#[rustfmt::skip]
const GAUSS: [(f64, f64); 5] = [
    (0.0, 0.568_888_888_888_888_9),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
];

/// Sub-interval of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cell {
    piece: usize,
    from: f64,
    to: f64,
    /// Path length at `from`.
    s: f64,
    /// Radius in mm over all axes, around the point at the middle of the parameter, that contains the whole
    /// sub-interval.
    radius: f64,
    /// Derivative of the path length with respect to the parameter in mm at both ends.
    rates: [f64; 2],
}

/// Whether a position is outside a range by more than rounding.
fn is_beyond(x: f64, (low, high): (f64, f64)) -> bool {
    let slack = BEYOND.0 + BEYOND.1 * x.abs();
    x < low - slack || x > high + slack
}

/// Derivatives of all axes with respect to path length at one point.
#[derive(Clone, Debug)]
struct Derivatives {
    first: AxisVec,
    second: AxisVec,
    third: AxisVec,
}

/// The largest derivatives of a curve.
#[derive(Clone, Debug)]
struct Extremes {
    /// Largest absolute derivatives with respect to `s`, see [`PolyPath::extremes`].
    derivatives: [AxisVec; 3],
    /// For each sub-interval, the largest `|q''|` of an axis in 1/mm, rounded up.
    bends: Box<[f64]>,
}

/// A curve of polynomials, `s` measured over the feed axes (over all axes if none of them moves).
#[derive(Clone, Debug)]
pub struct PolyPath {
    start: AxisVec,
    end: AxisVec,
    /// Shared, like the cells: the remainder of a block is a copy of it.
    pieces: Arc<[PolyPiece]>,
    /// Axes over which the path length is measured.
    measured: SmallVec<[bool; 8]>,
    cells: Arc<[Cell]>,
    /// Points at the middle of the cells' parameters, axis by axis, with which every search begins.
    middles: Arc<[f64]>,
    length: f64,
    /// Searched when first needed: a check of the program, and curves that are dropped in favour of a corner, do without
    /// them.
    extremes: Arc<OnceLock<Extremes>>,
}

impl PartialEq for PolyPath {
    /// Whether both are the same curve; everything else follows from that.
    fn eq(&self, other: &Self) -> bool {
        self.start == other.start
            && self.end == other.end
            && self.pieces == other.pieces
            && self.measured == other.measured
    }
}

impl PolyPath {
    /// A curve from the start of the first piece to the end of the last one, as [`Self::new`].
    pub(crate) fn through(pieces: Vec<PolyPiece>, feed_axes: &[bool]) -> Option<Self> {
        let start = piece::point(pieces.first()?, 0.0);
        let end = piece::point(pieces.last()?, 1.0);
        Self::new(start, end, pieces, feed_axes)
    }

    /// Lowest and highest position of an axis in mm (deg), to a nanometre. A curve that turns at one of its ends does
    /// not exceed it by rounding.
    pub fn extent(&self, axis: usize) -> (f64, f64) {
        let (start, end) = (self.start[axis], self.end[axis]);
        let (mut low, mut high) = (start.min(end), start.max(end));
        let mut left: Vec<Coefficients> = self.pieces.iter().map(|piece| piece[axis]).collect();
        while let Some(part) = left.pop() {
            // the part stays between its smallest and largest Bernstein coefficient
            if !extremes::bernstein(&part).into_iter().any(|x| is_beyond(x, (low, high))) {
                continue;
            }
            for x in [0.5, 0.0, 1.0].map(|x| value(&part, x)) {
                if is_beyond(x, (low, high)) {
                    (low, high) = (low.min(x), high.max(x));
                }
            }
            left.extend([(0.0, 0.5), (0.5, 1.0)].map(|(from, to)| section(&part, from, to)));
        }
        (low, high)
    }

    /// A curve through the pieces in order; `None` if it has no length or is not finite.
    ///
    /// `start` and `end` are met exactly; the pieces are expected to begin and end there up to rounding.
    pub fn new(
        start: AxisVec,
        end: AxisVec,
        pieces: Vec<PolyPiece>,
        feed_axes: &[bool],
    ) -> Option<Self> {
        let moves = |i: usize| pieces.iter().any(|p| p[i][1..].iter().any(|c| *c != 0.0));
        let feed = |i: usize| feed_axes.get(i).copied().unwrap_or(true);
        let n = start.len();
        let any = (0..n).any(|i| feed(i) && moves(i));
        let measured = (0..n).map(|i| !any || feed(i)).collect();
        let mut path = Self {
            start,
            end,
            pieces: pieces.into(),
            measured,
            cells: Arc::from([]),
            middles: Arc::from([]),
            length: 0.0,
            extremes: Arc::default(),
        };
        let coarse: f64 = (0..path.pieces.len()).map(|p| path.gauss(p, 0.0, 1.0)).sum();
        if !(coarse.is_finite() && coarse > 0.0) {
            return None;
        }
        let mut cells = Vec::new();
        for p in 0..path.pieces.len() {
            path.subdivide(p, (0.0, 1.0), coarse, 0, &mut cells);
        }
        let mut middles = vec![0.0; n * cells.len()];
        for (cell, middle) in cells.iter().zip(middles.chunks_exact_mut(n)) {
            path.point(cell.piece, cell.middle(), middle);
        }
        path.middles = middles.into();
        path.cells = cells.into();
        Some(path)
    }

    /// Number of sub-intervals.
    pub(crate) fn cells(&self) -> usize {
        self.cells.len()
    }

    /// The curve from the start of sub-interval `from` to the start of sub-interval `to`; `None` as in [`Self::new`].
    pub(crate) fn section(&self, from: usize, to: usize) -> Option<Self> {
        let mut pieces: Vec<PolyPiece> = Vec::new();
        let cells = self.cells.get(from..to)?;
        for run in cells.chunk_by(|a, b| a.piece == b.piece) {
            let (first, last) = (run.first()?, run.last()?);
            let cut = |c| piece::section(c, first.from, last.to);
            pieces.push(self.pieces[first.piece].iter().map(cut).collect());
        }
        let end_of = |cell: &Cell, x: f64| {
            let mut point = AxisVec::zeros(self.start.len());
            self.point(cell.piece, x, &mut point);
            point
        };
        let (first, last) = (cells.first()?, cells.last()?);
        let start = if from == 0 { self.start.clone() } else { end_of(first, first.from) };
        let end = if to == self.cells.len() { self.end.clone() } else { end_of(last, last.to) };
        Self::new(start, end, pieces, &self.measured)
    }

    /// Derivative of the path length with respect to the parameter.
    fn rate(&self, piece: usize, x: f64) -> f64 {
        let axes = &self.pieces[piece][..];
        let measured = &self.measured[..axes.len()];
        let mut sum = 0.0;
        for i in 0..axes.len() {
            if measured[i] {
                let d = slope(&axes[i], x);
                sum += d * d;
            }
        }
        f64::sqrt(sum)
    }

    fn gauss(&self, piece: usize, from: f64, to: f64) -> f64 {
        let (mid, half) = (0.5 * (from + to), 0.5 * (to - from));
        half * GAUSS.iter().map(|(x, w)| w * self.rate(piece, mid + half * x)).sum::<f64>()
    }

    fn subdivide(
        &mut self,
        piece: usize,
        (from, to): (f64, f64),
        scale: f64,
        depth: u32,
        cells: &mut Vec<Cell>,
    ) {
        let mid = 0.5 * (from + to);
        let whole = self.gauss(piece, from, to);
        let halves = self.gauss(piece, from, mid) + self.gauss(piece, mid, to);
        if depth < DEPTH && (whole - halves).abs() > SPLIT * scale {
            self.subdivide(piece, (from, mid), scale, depth + 1, cells);
            self.subdivide(piece, (mid, to), scale, depth + 1, cells);
        } else {
            let radius = nearest::radius(&self.pieces[piece], from, to);
            let rates = [from, to].map(|x| self.rate(piece, x));
            cells.push(Cell { piece, from, to, s: self.length, radius, rates });
            self.length += whole;
        }
    }

    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    /// First point.
    pub fn start(&self) -> &AxisVec {
        &self.start
    }

    pub(crate) fn end(&self) -> &AxisVec {
        &self.end
    }

    pub(crate) fn pieces(&self) -> &[PolyPiece] {
        &self.pieces
    }

    /// Cell at `s`, the path length inside the cell, and the length of the cell.
    fn cell_at(&self, s: f64) -> (&Cell, f64, f64) {
        let s = s.clamp(0.0, self.length);
        let i = self.cells.partition_point(|c| c.s <= s).saturating_sub(1);
        let cell = &self.cells[i];
        let until = self.cells.get(i + 1).map_or(self.length, |c| c.s);
        (cell, s - cell.s, until - cell.s)
    }

    /// Piece and parameter at `s`.
    pub(crate) fn locate(&self, s: f64) -> (usize, f64) {
        self.parameter(s, EXACT)
    }

    /// As [`Self::position`] to 1e-7 of the length, at half the cost.
    pub(super) fn near(&self, s: f64, out: &mut [f64]) {
        let (piece, x) = self.parameter(s, GUESS);
        self.point(piece, x, out);
    }

    /// Piece and parameter at `s`, by Newton's method, whose first step of at most `enough` of a sub-interval is the last one.
    ///
    /// The parameter is first estimated by a cubic in the path length with the correct values and slopes at both ends
    /// of a cell.
    fn parameter(&self, s: f64, enough: f64) -> (usize, f64) {
        let (cell, want, whole) = self.cell_at(s);
        let (mut low, mut high) = (cell.from, cell.to);
        if whole <= 0.0 {
            return (cell.piece, low);
        }
        let (u, width) = ((want / whole).clamp(0.0, 1.0), high - low);
        // a cubic with end slopes of up to three times the mean slope is monotonic (Fritsch and Carlson, 1980)
        let [start, end] = cell.rates.map(|rate| (whole / rate).min(3.0 * width));
        let v = 1.0 - u;
        let mut x = low + width * u * u * (3.0 - 2.0 * u) + u * v * (v * start - u * end);
        for _ in 0..50 {
            let miss = self.gauss(cell.piece, cell.from, x) - want;
            let newton = x - miss / self.rate(cell.piece, x);
            if (newton - x).abs() <= enough * width {
                x = newton;
                break;
            }
            if miss > 0.0 {
                high = x;
            } else {
                low = x;
            }
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - x).abs() <= 1e-16 {
                break;
            }
            x = next;
        }
        (cell.piece, x.clamp(cell.from, cell.to))
    }

    pub(super) fn position(&self, s: f64, out: &mut [f64]) {
        if s <= 0.0 {
            out.copy_from_slice(&self.start);
        } else if s >= self.length {
            out.copy_from_slice(&self.end);
        } else {
            let (piece, x) = self.locate(s);
            self.point(piece, x, out);
        }
    }

    fn point(&self, piece: usize, x: f64, out: &mut [f64]) {
        for ((o, c), start) in out.iter_mut().zip(&self.pieces[piece]).zip(self.start.iter()) {
            // an axis that does not move keeps its exact bits
            *o = if c[1..].iter().all(|c| *c == 0.0) && c[0].to_bits() == start.to_bits() {
                *start
            } else {
                value(c, x)
            };
        }
    }

    fn pace(&self, piece: usize, x: f64) -> Pace {
        Pace::at(&self.pieces[piece], &self.measured, x)
    }

    /// `q'`, `q''`, `q'''` with respect to path length.
    fn derivatives(&self, piece: usize, x: f64) -> Derivatives {
        let pace = self.pace(piece, x);
        let axes = &self.pieces[piece];
        let n = axes.len();
        let mut out = Derivatives {
            first: AxisVec::zeros(n),
            second: AxisVec::zeros(n),
            third: AxisVec::zeros(n),
        };
        for (i, c) in axes.iter().enumerate() {
            [out.first[i], out.second[i], out.third[i]] = pace.derivatives(c, x);
        }
        out
    }

    pub(super) fn tangent(&self, s: f64, out: &mut [f64]) {
        let (piece, x) = self.locate(s);
        out.copy_from_slice(&self.derivatives(piece, x).first);
    }

    pub(super) fn curvature(&self, s: f64, out: &mut [f64]) {
        let (piece, x) = self.locate(s);
        out.copy_from_slice(&self.derivatives(piece, x).second);
    }

    /// Largest `|q'|`, `|q''|` in 1/mm and `|q'''|` in 1/mm2 of every axis over the curve.
    pub(crate) fn extremes(&self) -> &[AxisVec; 3] {
        &self.found_extremes().derivatives
    }

    fn found_extremes(&self) -> &Extremes {
        self.extremes.get_or_init(|| self.find_extremes())
    }

    fn find_extremes(&self) -> Extremes {
        let zeros = || AxisVec::zeros(self.start.len());
        let mut largest = [zeros(), zeros(), zeros()];
        // the values at the ends make most of the search inside unnecessary
        let last = self.cells.last().map(|c| (c.piece, c.to));
        for (piece, x) in self.cells.iter().map(|c| (c.piece, c.from)).chain(last) {
            let Derivatives { first, second, third } = self.derivatives(piece, x);
            for (extreme, d) in largest.iter_mut().zip([first, second, third]) {
                for (extreme, d) in extreme.iter_mut().zip(d.iter()) {
                    *extreme = extreme.max(d.abs());
                }
            }
        }
        let inside = |cell: &Cell| {
            let piece = &self.pieces[cell.piece];
            extremes::raise(&mut largest, piece, &self.measured, (cell.from, cell.to))
        };
        let bends = self.cells.iter().map(inside).collect();
        Extremes { derivatives: largest, bends }
    }

    /// Sub-intervals as the path length at their ends and the largest `|q''|` of an axis in 1/mm, rounded up.
    pub(crate) fn bends(&self) -> impl Iterator<Item = (f64, f64)> {
        let ends = self.cells.iter().skip(1).map(|c| c.s).chain([self.length]);
        ends.zip(self.found_extremes().bends.iter().copied())
    }
}

#[cfg(test)]
mod tests;
