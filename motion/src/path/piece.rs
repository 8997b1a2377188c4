//! One polynomial piece of a curve over its own parameter in `0..=1`.

use crate::axis::AxisVec;
use smallvec::SmallVec;

/// Coefficients of one axis over one piece, lowest power first.
pub type Coefficients = [f64; 6];

/// One polynomial per axis, in channel order.
pub type PolyPiece = SmallVec<[Coefficients; 4]>;

/// Position of an axis.
pub(super) fn value(c: &Coefficients, x: f64) -> f64 {
    c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5]))))
}

/// First derivative with respect to the parameter.
pub(super) fn slope(c: &Coefficients, x: f64) -> f64 {
    c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * (4.0 * c[4] + x * 5.0 * c[5])))
}

/// Second derivative with respect to the parameter.
pub(super) fn bend(c: &Coefficients, x: f64) -> f64 {
    2.0 * c[2] + x * (6.0 * c[3] + x * (12.0 * c[4] + x * 20.0 * c[5]))
}

/// Third derivative with respect to the parameter.
pub(super) fn twist(c: &Coefficients, x: f64) -> f64 {
    6.0 * c[3] + x * (24.0 * c[4] + x * 60.0 * c[5])
}

/// Derivatives of the path length with respect to the parameter at one point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    rate: f64,
    rate2: f64,
    growth: f64,
    growth2: f64,
}

impl Pace {
    /// From the derivatives of the measured axes with respect to the parameter.
    pub(super) fn at(piece: &PolyPiece, measured: &[bool], x: f64) -> Self {
        let (mut dot12, mut dot22, mut dot13) = (0.0, 0.0, 0.0);
        let mut rate2 = 0.0;
        for (c, _) in piece.iter().zip(measured).filter(|(_, m)| **m) {
            let (d1, d2, d3) = (slope(c, x), bend(c, x), twist(c, x));
            rate2 += d1 * d1;
            dot12 += d1 * d2;
            dot22 += d2 * d2;
            dot13 += d1 * d3;
        }
        let rate = rate2.sqrt();
        let growth = dot12 / rate;
        let growth2 = (dot22 + dot13 - growth * growth) / rate;
        Self { rate, rate2, growth, growth2 }
    }

    /// Derivatives of one axis with respect to path length.
    pub(super) fn derivatives(self, c: &Coefficients, x: f64) -> [f64; 3] {
        let Self { rate, rate2, growth, growth2 } = self;
        let (d1, d2, d3) = (slope(c, x), bend(c, x), twist(c, x));
        let first = d1 / rate;
        let second = (d2 - first * growth) / rate2;
        let third = ((d3 - first * growth2) / rate2 - 3.0 * second * growth / rate) / rate;
        [first, second, third]
    }
}

/// The polynomial over `from..=to` as one over `0..=1`.
pub(crate) fn section(c: &Coefficients, from: f64, to: f64) -> Coefficients {
    let mut out = *c;
    // Horner shift by `from`
    for k in 0..out.len() {
        for i in (k..out.len() - 1).rev() {
            out[i] += from * out[i + 1];
        }
    }
    let mut scale = 1.0;
    for c in &mut out {
        *c *= scale;
        scale *= to - from;
    }
    out
}

/// Smallest share of a piece that becomes one of its own.
const SLIVER: f64 = 1e-9;

/// The pieces in parts that end at these places, given by piece and parameter in ascending order, and the remainder.
pub(crate) fn divided(
    pieces: impl IntoIterator<Item = PolyPiece>,
    ends: impl IntoIterator<Item = (usize, f64)>,
) -> Vec<Vec<PolyPiece>> {
    let mut ends = ends.into_iter().peekable();
    let (mut out, mut here) = (Vec::new(), Vec::new());
    for (i, piece) in pieces.into_iter().enumerate() {
        let part = |from: f64, to: f64| piece.iter().map(|c| section(c, from, to)).collect();
        let mut passed = 0.0;
        while let Some((_, end)) = ends.next_if(|(of, _)| *of == i) {
            if end - passed > SLIVER {
                here.push(part(passed, end));
                passed = end;
            }
            out.push(std::mem::take(&mut here));
        }
        if passed == 0.0 {
            here.push(piece);
        } else if 1.0 - passed > SLIVER {
            here.push(part(passed, 1.0));
        }
    }
    out.push(here);
    out
}

/// Position on a piece.
pub(crate) fn point(piece: &PolyPiece, x: f64) -> AxisVec {
    piece.iter().map(|c| c.iter().rev().fold(0.0, |sum, c| sum * x + c)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_runs_through_the_same_points() {
        let c = [1.0, -2.0, 0.5, 3.0, -1.0, 0.25];
        let whole = PolyPiece::from_slice(&[c]);
        let part = PolyPiece::from_slice(&[section(&c, 0.25, 0.75)]);
        for x in [0.0, 0.3, 1.0] {
            assert!((point(&whole, 0.25 + 0.5 * x)[0] - point(&part, x)[0]).abs() < 1e-14);
        }
    }
}
