//! Cubic B-splines with one knot per control point: knots evened out, basis, derivatives.
//!
//! Control point `j` has the knot `t[j]`, and its basis function lives on `t[j - 2]..t[j + 2]`. Both ends are mirrored
//! (`c[-1] = 2 c[0] - c[1]`), which makes them exact ends without curvature.

/// Passes of the binomial filter that evens knots out: 64 give the same curves, 4 and 2 a ripple of the speed through
/// chords of 0.02 to 0.1 mm.
const PASSES: usize = 16;

/// Evens values out by `(1 2 1) / 4`, odd about both ends: a positive filter, so that order and ends are kept. Equal
/// steps stay equal.
pub(super) fn evened(values: &mut [f64]) {
    for _ in 0..PASSES {
        let mut before = values.first().copied().unwrap_or(0.0);
        for i in 1..values.len().saturating_sub(1) {
            let here = values[i];
            values[i] = here + 0.25 * ((values[i + 1] - here) - (here - before));
            before = here;
        }
    }
}

/// A B-spline.
#[derive(Debug)]
pub(super) struct Spline {
    /// The knots with two mirrored ones at either end.
    knots: Vec<f64>,
    /// The control points by axis, with a mirrored one at either end.
    points: Vec<Vec<f64>>,
}

impl Spline {
    /// Through control points by axis; at least three.
    pub(super) fn new(knots: &[f64], points: &[Vec<f64>]) -> Self {
        let ends = |t: &[f64], count: usize| {
            let last = t.len() - 1;
            let before = (1..=count).rev().map(|k| 2.0 * t[0] - t[k]);
            let behind = (1..=count).map(|k| 2.0 * t[last] - t[last - k]);
            before.chain(t.iter().copied()).chain(behind).collect::<Vec<f64>>()
        };
        let points = points.iter().map(|p| ends(p, 1)).collect();
        Self { knots: ends(knots, 2), points }
    }

    /// Number of intervals between knots.
    pub(super) fn len(&self) -> usize {
        self.knots.len() - 5
    }

    pub(super) fn knot(&self, j: usize) -> f64 {
        self.knots[j + 2]
    }

    /// The interval of a parameter, from the one of a smaller parameter on.
    pub(super) fn interval(&self, from: usize, x: f64) -> usize {
        let mut j = from;
        while j + 1 < self.len() && self.knot(j + 1) <= x {
            j += 1;
        }
        j
    }

    /// Values at `x` in interval `j` of the basis functions of the control points `j - 1..=j + 2` (Cox and de Boor).
    pub(super) fn basis(&self, j: usize, x: f64) -> [f64; 4] {
        let [a, b, c, d, e, f] = std::array::from_fn(|k| self.knots[j + k]);
        let (n0, n1) = ((d - x) / (d - c), (x - c) / (d - c));
        let m0 = (d - x) / (d - b) * n0;
        let m1 = (x - b) / (d - b) * n0 + (e - x) / (e - c) * n1;
        let m2 = (x - c) / (e - c) * n1;
        [
            (d - x) / (d - a) * m0,
            (x - a) / (d - a) * m0 + (e - x) / (e - b) * m1,
            (x - b) / (e - b) * m1 + (f - x) / (f - c) * m2,
            (x - c) / (f - c) * m2,
        ]
    }

    /// Factors of the control points `j - 1..=j + 1` in the second derivative at knot `j`.
    fn second_factors(&self, j: usize) -> [f64; 3] {
        let k = |i: usize| self.knots[j + i];
        let whole = 6.0 / (k(3) - k(1));
        let (before, behind) = (whole / (k(3) - k(0)), whole / (k(4) - k(1)));
        [before, -(before + behind), behind]
    }

    /// Factors of the control points `j - 1..=j + 2` in the third derivative on interval `j`.
    pub(super) fn third_factors(&self, j: usize) -> [f64; 4] {
        let h = self.knot(j + 1) - self.knot(j);
        let (a, b) = (self.second_factors(j), self.second_factors(j + 1));
        [-a[0] / h, (b[0] - a[1]) / h, (b[1] - a[2]) / h, b[2] / h]
    }

    /// Second derivative of an axis at knot `j`.
    pub(super) fn second(&self, axis: usize, j: usize) -> f64 {
        if j == 0 || j == self.len() {
            return 0.0;
        }
        let c = &self.points[axis][j..j + 3];
        let [before, _, behind] = self.second_factors(j);
        behind * (c[2] - c[1]) - before * (c[1] - c[0])
    }

    /// Distance of an axis from `p` at `x` in interval `j`.
    pub(super) fn beyond(&self, axis: usize, basis: &[f64; 4], j: usize, p: f64) -> f64 {
        let c = &self.points[axis][j..j + 4];
        basis.iter().zip(c).map(|(b, c)| b * (c - p)).sum()
    }
}
