//! How far a spline is from the polygon it was fitted to.
//!
//! With `P(t)` on the polygon and `F(t)` on the spline, `e = F - P` has the second derivative of `F` on each edge, which
//! is linear between knots. On a part `[a, b]` of an edge therefore
//! `|e| <= max(|e(a)|, |e(b)|) + (b - a)^2 / 8 max |F''|`, the largest over the knots around it. This compares equal
//! parameters: it bounds the distance of the spline from the polygon, that of the polygon from the spline, and that of
//! every part of the spline from its own edge.

use super::knots::Spline;

/// Parts of an edge that are bounded separately.
const PARTS: u32 = 4;
/// Smallest length of a leg of the control polygon as a share of its knot interval: shorter ones fold or loop.
const SHORTEST: f64 = 0.25;

/// Upper bound of the distance over every edge of the polygon with the vertices `points` (by axis) at the parameters
/// `at`. The axes of the spline are those of `points`.
pub(super) fn bounds(spline: &Spline, at: &[f64], points: &[&[f64]]) -> Vec<f64> {
    let axes = 0..points.len();
    let length =
        |squares: &mut dyn Iterator<Item = f64>| squares.map(|c| c * c).sum::<f64>().sqrt();
    let bends: Vec<f64> = (0..=spline.len())
        .map(|j| length(&mut axes.clone().map(|axis| spline.second(axis, j))))
        .collect();
    let mut interval = 0;
    let mut off_at = |i: usize, part: u32| {
        let u = f64::from(part) / f64::from(PARTS);
        let x = at[i] + u * (at[i + 1] - at[i]);
        interval = spline.interval(interval, x);
        let basis = spline.basis(interval, x);
        let off = length(&mut axes.clone().map(|axis| {
            let p = points[axis];
            spline.beyond(axis, &basis, interval, p[i] + u * (p[i + 1] - p[i]))
        }));
        (off, interval)
    };
    let (mut last, mut from) = off_at(0, 0);
    (0..at.len() - 1)
        .map(|i| {
            let quarter = (at[i + 1] - at[i]) / f64::from(PARTS);
            let mut most = 0.0_f64;
            for part in 1..=PARTS {
                let (off, to) = off_at(i, part);
                let bend = bends[from..=to + 1].iter().copied().fold(0.0, f64::max);
                most = most.max(off.max(last) + 0.125 * quarter * quarter * bend);
                (last, from) = (off, to);
            }
            most
        })
        .collect()
}

/// Whether a leg of the control polygon is long enough for its interval.
pub(super) fn is_in_order(length: f64, interval: f64) -> bool {
    length >= SHORTEST * interval
}
