//! The contouring curve: two polynomials of fourth order per axis that meet at the interim point.
//!
//! Position, tangent and curvature at both ends are those of the blocks; at the interim point the position and the
//! first three derivatives with respect to the parameter agree. These are ten conditions for ten coefficients, so the
//! curve is unique once the parameter speeds at the ends are chosen: the corner distances. Between two lines with equal
//! corner distance `d` it is the curve `P = C - d alpha u1 + d beta u2` with `alpha = 1 - x + x^3/4 - x^4/16` and
//! `beta = x^3/4 - x^4/16`, and its interim point is `3/8 d sin(theta/2)` away from the corner.
//!
//! Source: TF5200, polynomial contouring (two polynomials of fourth order, tangent and curvature continuous).
//! Assumption: C3 at the interim point; the documents do not give the coefficients.

use crate::axis::AxisVec;
use crate::path::piece::section;
use crate::path::{Coefficients, Path, PolyPiece};

/// Where the curve leaves or meets a block: position, first and second derivative with respect to path length.
#[derive(Clone, Debug)]
pub(super) struct End {
    pub(super) point: AxisVec,
    pub(super) tangent: AxisVec,
    pub(super) curvature: AxisVec,
}

impl End {
    pub(super) fn of(path: &Path, s: f64) -> Self {
        let n = path.start().len();
        let (mut point, mut tangent, mut curvature) =
            (AxisVec::zeros(n), AxisVec::zeros(n), AxisVec::zeros(n));
        path.position(s, &mut point);
        path.tangent(s, &mut tangent);
        path.curvature(s, &mut curvature);
        Self { point, tangent, curvature }
    }
}

/// Both halves of a curve, the second one in its direction of travel.
#[derive(Clone, Debug)]
pub(super) struct Blend {
    pub(super) halves: [PolyPiece; 2],
}

impl Blend {
    /// The curve from `a` to `b`; `rate_a`, `rate_b`: parameter speeds there in mm. Axes with an `interim` coordinate
    /// pass through it with two continuous derivatives instead of three.
    pub(super) fn new(
        a: &End,
        b: &End,
        rate_a: f64,
        rate_b: f64,
        interim: impl Fn(usize) -> Option<f64>,
    ) -> Self {
        let mut halves = [PolyPiece::new(), PolyPiece::new()];
        for i in 0..a.point.len() {
            // the second half is described from its end, where its parameter starts
            let (a0, a1) = (a.point[i], rate_a * a.tangent[i]);
            let (b0, b1) = (b.point[i], -rate_b * b.tangent[i]);
            let a2 = 0.5 * rate_a * rate_a * a.curvature[i];
            let b2 = 0.5 * rate_b * rate_b * b.curvature[i];
            let middle = interim(i).map(|m| (m - a0 - a1 - a2, m - b0 - b1 - b2));
            let ((sum3, diff3), (sum4, diff4)) = if let Some((ma, mb)) = middle {
                // a3 + a4 = ma, b3 + b4 = mb; first and second derivative agree
                let sum4 = -(a1 + b1) - 2.0 * (a2 + b2) - 3.0 * (ma + mb);
                let diff4 = (b2 - a2) / 3.0 - (ma - mb);
                ((ma + mb - sum4, ma - mb - diff4), (sum4, diff4))
            } else {
                // position and three derivatives agree
                let sum3 = -0.5 * (a1 + b1) - (a2 + b2);
                let gap = (b0 - a0) + (b1 - a1) + (b2 - a2);
                let diff4 = (b2 - a2) / 3.0 - gap;
                ((sum3, gap - diff4), (-0.25 * sum3, diff4))
            };
            let half = |sign: f64, c0: f64, c1: f64, c2: f64| -> Coefficients {
                [c0, c1, c2, 0.5 * (sum3 + sign * diff3), 0.5 * (sum4 + sign * diff4), 0.0]
            };
            halves[0].push(half(1.0, a0, a1, a2));
            halves[1].push(section(&half(-1.0, b0, b1, b2), 1.0, 0.0));
        }
        Self { halves }
    }

    /// The interim point.
    pub(super) fn interim(&self) -> AxisVec {
        self.halves[1].iter().map(|c| c[0]).collect()
    }

    /// Both halves divided into `parts` pieces of equal parameter range.
    pub(super) fn pieces(&self, parts: u32) -> impl Iterator<Item = PolyPiece> + '_ {
        let at = move |k: u32| f64::from(k) / f64::from(parts);
        self.halves.iter().flat_map(move |half| {
            (0..parts).map(move |k| half.iter().map(|c| section(c, at(k), at(k + 1))).collect())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_lines_give_the_documented_coefficients() {
        let end = |x: f64, y: f64, u: [f64; 2]| End {
            point: AxisVec::from_slice(&[x, y]),
            tangent: AxisVec::from_slice(&u),
            curvature: AxisVec::zeros(2),
        };
        let d = 2.0;
        let (a, b) = (end(-d, 0.0, [1.0, 0.0]), end(0.0, d, [0.0, 1.0]));
        let blend = Blend::new(&a, &b, d, d, |_| None);
        let want =
            [[-d, d, 0.0, -0.25 * d, d / 16.0, 0.0], [0.0, 0.0, 0.0, 0.25 * d, -d / 16.0, 0.0]];
        for (got, want) in blend.halves[0].iter().zip(want) {
            assert!(got.iter().zip(want).all(|(g, w)| (g - w).abs() < 1e-15), "{got:?}");
        }
        let m = blend.interim();
        assert!((m[0] + 0.1875 * d).abs() < 1e-15 && (m[1] - 0.1875 * d).abs() < 1e-15);
    }
}
