//! Largest derivatives with respect to path length on a polynomial piece, with proven bounds.
//!
//! With `N = |P'|^2` over the measured axes every derivative of an axis with respect to path length is a quotient
//! `F / N^e`: `q' = p' / N^(1/2)`, and from one to the next `F_next = F' N - e F N'` with `e_next = e + 3/2`. Up to a
//! positive factor, the same `F_next` is the derivative of the quotient with respect to the parameter. The extremes of
//! `q'`, `q''` and `q'''` are therefore at the ends of the piece and at the zeros of polynomials. Their Bernstein
//! coefficients bound the number of zeros (Descartes' rule of signs: none without a change of sign, exactly one with a
//! single change) and the deviation of the quotient from its values at the ends (half the largest slope). Pieces for
//! which neither is sufficient are halved.

use super::piece::{PolyPiece, section};
use crate::axis::AxisVec;
use crate::profile::roots::enclosed_root;
use smallvec::SmallVec;

/// Largest number of halvings of a piece, and the share by which a bound may exceed the value reached if halving ends
/// earlier.
const DEEPEST: u32 = 24;
const TIGHT: f64 = 1e-6;
/// Accuracy of a zero. The quotient is flat there, so half the digits of the zero give all digits of the quotient.
const FLAT: f64 = 1e-9;

/// Coefficients of a polynomial, lowest power first, without trailing zeros. Pieces of degree five give at most 26.
type Poly = SmallVec<[f64; 26]>;

fn trimmed(mut p: Poly) -> Poly {
    while p.last() == Some(&0.0) {
        p.pop();
    }
    p
}

fn value(p: &[f64], x: f64) -> f64 {
    p.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

fn slope(p: &[f64]) -> Poly {
    let mut out = Poly::from_slice(p.get(1..).unwrap_or_default());
    for (k, c) in out.iter_mut().enumerate() {
        *c *= (k + 1) as f64;
    }
    out
}

/// Adds `factor a b`.
fn add_product(out: &mut Poly, factor: f64, a: &[f64], b: &[f64]) {
    if a.is_empty() || b.is_empty() {
        return;
    }
    if out.len() < a.len() + b.len() - 1 {
        out.resize(a.len() + b.len() - 1, 0.0);
    }
    // the factors of pieces of degree three to five
    match b.len() {
        4 => add_rows::<4>(out, factor, a, b),
        5 => add_rows::<5>(out, factor, a, b),
        6 => add_rows::<6>(out, factor, a, b),
        7 => add_rows::<7>(out, factor, a, b),
        8 => add_rows::<8>(out, factor, a, b),
        9 => add_rows::<9>(out, factor, a, b),
        _ => {
            for (i, a) in a.iter().enumerate() {
                add_scaled(&mut out[i..], factor * a, b);
            }
        }
    }
}

/// As [`add_product`], with a factor whose length is known: without loops and calls inside.
#[inline]
fn add_rows<const N: usize>(out: &mut [f64], factor: f64, a: &[f64], b: &[f64]) {
    let Some(b) = b.first_chunk::<N>() else { return };
    for (i, a) in a.iter().enumerate() {
        if let Some(out) = out[i..].first_chunk_mut::<N>() {
            add_scaled(out, factor * a, b);
        }
    }
}

#[inline]
fn add_scaled(out: &mut [f64], a: f64, b: &[f64]) {
    for (o, b) in out.iter_mut().zip(b) {
        *o += a * b;
    }
}

/// Bernstein coefficients over `0..=1`: the polynomial stays between the smallest and the largest of them.
pub(super) fn bernstein(p: &[f64]) -> Poly {
    let mut out = Poly::from_slice(p);
    let n = out.len().saturating_sub(1);
    let mut choose = 1.0;
    for (i, c) in out.iter_mut().enumerate() {
        *c /= choose;
        choose *= (n - i) as f64 / (i + 1) as f64;
    }
    let sums = &mut out[..];
    for k in 1..=n {
        // each value is computed from the previous ones
        let mut before = sums[k - 1];
        for sum in &mut sums[k..] {
            before = std::mem::replace(sum, *sum + before);
        }
    }
    out
}

/// Number of sign changes between successive coefficients, ignoring zeros.
fn changes(p: &[f64]) -> usize {
    let (mut count, mut last) = (0, 0.0_f64);
    for c in p.iter().copied().filter(|c| *c != 0.0) {
        count += usize::from(last != 0.0 && c.is_sign_negative() != last.is_sign_negative());
        last = c;
    }
    count
}

/// The only zero of a polynomial between 0 and 1.
fn zero(p: &[f64]) -> f64 {
    enclosed_root((0.0, value(p, 0.0)), (1.0, value(p, 1.0)), FLAT, |x| value(p, x)).1
}

/// `|P'|^2` with its smallest Bernstein coefficient.
struct Speed {
    square: Poly,
    slope: Poly,
    least: f64,
}

impl Speed {
    fn new(piece: &PolyPiece, measured: &[bool]) -> Self {
        let mut square = Poly::new();
        for (c, _) in piece.iter().zip(measured).filter(|(_, m)| **m) {
            let d = trimmed(slope(c));
            add_product(&mut square, 1.0, &d, &d);
        }
        let least = bernstein(&square).iter().copied().fold(f64::INFINITY, f64::min);
        Self { slope: slope(&square), square, least }
    }

    /// The numerator of the derivative that follows `F / N^e`, with `twice` = `2 e`.
    fn next(&self, f: &Poly, twice: i32) -> Poly {
        let mut out = Poly::new();
        add_product(&mut out, 1.0, &slope(f), &self.square);
        add_product(&mut out, -0.5 * f64::from(twice), f, &self.slope);
        trimmed(out)
    }

    /// `|F| / N^e` at a parameter value; 0 where the path has no direction.
    fn quotient(&self, f: &Poly, twice: i32, x: f64) -> f64 {
        let q = value(f, x).abs() / half_power(value(&self.square, x), twice);
        if q.is_finite() { q } else { 0.0 }
    }
}

/// `x^(twice / 2)`.
fn half_power(x: f64, twice: i32) -> f64 {
    let whole = (0..twice / 2).fold(1.0, |product, _| product * x);
    if twice % 2 == 1 { whole * x.sqrt() } else { whole }
}

/// Raises the largest `|q'|`, `|q''|` and `|q'''|` of the axes to include those on a piece between two parameter
/// values; up to rounding they are never below the true maxima. Returns a bound of `|q''|` on it over all axes, in
/// 1/mm.
pub(super) fn raise(
    largest: &mut [AxisVec; 3],
    piece: &PolyPiece,
    measured: &[bool],
    (from, to): (f64, f64),
) -> f64 {
    let part = piece.iter().map(|c| section(c, from, to)).collect();
    halve(largest, &part, measured, 0)
}

fn halve(largest: &mut [AxisVec; 3], part: &PolyPiece, measured: &[bool], depth: u32) -> f64 {
    let speed = Speed::new(part, measured);
    let (mut bend, mut open) = (0.0_f64, false);
    for (i, c) in part.iter().enumerate() {
        let mut f = trimmed(slope(c));
        let mut twice = 1;
        for (order, largest) in largest.iter_mut().enumerate() {
            if f.is_empty() {
                break;
            }
            let next = speed.next(&f, twice);
            let bound = settle(&speed, (&f, &next), twice, &mut largest[i], depth);
            open |= bound.is_none();
            if order == 1 {
                bend = bend.max(bound.unwrap_or(0.0));
            }
            f = next;
            twice += 3;
        }
    }
    if open {
        let mut half = |from: f64, to: f64| {
            let half = part.iter().map(|c| section(c, from, to)).collect();
            halve(largest, &half, measured, depth + 1)
        };
        bend = half(0.0, 0.5).max(half(0.5, 1.0));
    }
    bend
}

/// Raises the largest `|F| / N^e` to include a piece and returns a bound on it; `None` if the piece has to be halved
/// for that.
fn settle(
    speed: &Speed,
    (f, next): (&Poly, &Poly),
    twice: i32,
    largest: &mut f64,
    depth: u32,
) -> Option<f64> {
    let ends = speed.quotient(f, twice, 0.0).max(speed.quotient(f, twice, 1.0));
    *largest = largest.max(ends);
    let slopes = bernstein(next);
    let steepest = slopes.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let bound = ends + 0.5 * steepest / half_power(speed.least, twice + 2);
    let bounded = speed.least > 0.0 && bound.is_finite();
    if bounded && bound <= *largest {
        return Some(bound);
    }
    match changes(&slopes) {
        0 => return Some(ends),
        1 => {
            let extreme = ends.max(speed.quotient(f, twice, zero(next)));
            *largest = largest.max(extreme);
            return Some(extreme);
        }
        _ => {}
    }
    if bounded && bound <= (1.0 + TIGHT) * *largest {
        *largest = bound;
        return Some(bound);
    }
    (depth >= DEEPEST).then(|| {
        let bound = if bounded { bound } else { ends };
        *largest = largest.max(bound);
        bound
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_kit::Random;

    /// `q'`, `q''`, `q'''` of an axis by the chain rule, written out.
    fn by_chain_rule(piece: &PolyPiece, measured: &[bool], i: usize, x: f64) -> [f64; 3] {
        let d = |c: &[f64; 6], k: usize| -> f64 {
            let factor = |p: usize| (0..k).map(|m| (p - m) as f64).product::<f64>();
            (k..6).map(|p| factor(p) * c[p] * libm::pow(x, (p - k) as f64)).sum()
        };
        let over = |a: usize, b: usize| -> f64 {
            let axes = piece.iter().zip(measured).filter(|(_, m)| **m);
            axes.map(|(c, _)| d(c, a) * d(c, b)).sum()
        };
        // s' = v, s'' = w, s''' = u
        let v = over(1, 1).sqrt();
        let w = over(1, 2) / v;
        let u = (over(2, 2) + over(1, 3) - w * w) / v;
        let [d1, d2, d3] = [1, 2, 3].map(|k| d(&piece[i], k));
        let first = d1 / v;
        let second = (d2 - first * w) / (v * v);
        let third = (d3 - first * u - 3.0 * second * v * w) / (v * v * v);
        [first, second, third]
    }

    fn extremes(piece: &PolyPiece, measured: &[bool]) -> ([AxisVec; 3], f64) {
        let zeros = AxisVec::zeros(piece.len());
        let mut out = [zeros.clone(), zeros.clone(), zeros];
        let bend = raise(&mut out, piece, measured, (0.0, 1.0));
        (out, bend)
    }

    /// Cubics like those of splines, quartics like those of rounded corners, quintics; with and without a slaved axis.
    #[test]
    fn no_dense_sample_exceeds_them_and_they_are_reached() {
        let mut random = Random::from_state(7);
        for case in 0..300 {
            let degree = 2 + case % 4;
            let wild = [0.05, 0.4, 1.5][case % 3];
            let piece: PolyPiece = (0..3)
                .map(|i| {
                    let mut c = [0.0; 6];
                    c[0] = 100.0 * random.between(-1.0, 1.0);
                    c[1] = if i == 0 { 1.0 } else { random.between(-1.0, 1.0) };
                    for c in &mut c[2..=degree] {
                        *c = wild * random.between(-1.0, 1.0);
                    }
                    c
                })
                .collect();
            let measured = [true, true, case % 2 == 0];
            let (got, bend) = extremes(&piece, &measured);
            let samples = 4000;
            let mut sampled = [[0.0_f64; 3]; 3];
            for k in 0..=samples {
                let x = f64::from(k) / f64::from(samples);
                for i in 0..3 {
                    let derivatives = by_chain_rule(&piece, &measured, i, x);
                    for (largest, d) in sampled.iter_mut().zip(derivatives) {
                        largest[i] = largest[i].max(d.abs());
                    }
                }
            }
            for order in 0..3 {
                for i in 0..3 {
                    let (got, here) = (got[order][i], sampled[order][i]);
                    let what = format!("{case}: axis {i}, order {order}: {got} {here}");
                    assert!(got >= here * (1.0 - 1e-10) - 1e-13, "{what}");
                    // the peaks of near cusps are between samples
                    let seen = sampled[1].iter().all(|bend| *bend < 300.0);
                    assert!(!seen || got <= here * (1.0 + 1e-2) + 1e-12, "{what}");
                }
            }
            let most = sampled[1].iter().copied().fold(0.0, f64::max);
            assert!(bend >= most * (1.0 - 1e-10), "{case}: {bend} {most}");
        }
    }

    /// Parabola `y = a x^2` from its vertex, `x` from 0 to 1, with closed forms at the vertex and at the maximum of
    /// `q'''`.
    #[test]
    fn a_parabola_has_its_closed_forms() {
        let a = 2.0;
        let x = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
        let y = [0.0, 0.0, a, 0.0, 0.0, 0.0];
        let (got, bend) = extremes(&PolyPiece::from_slice(&[x, y]), &[true, true]);
        let slope = 2.0 * a;
        assert!((got[0][0] - 1.0).abs() < 1e-15, "dx/ds = 1 at the vertex");
        assert!((got[0][1] - slope / libm::hypot(1.0, slope)).abs() < 1e-15);
        // y'' = 2 a / (1 + m^2)^2 with m = 2 a x is largest at the vertex
        assert!((got[1][1] - 2.0 * a).abs() < 1e-13 && bend >= 2.0 * a);
        // x'' = -2 a m / (1 + m^2)^2 is largest at m = 1 / sqrt 3
        let m2 = 1.0_f64 / 3.0;
        let second = 2.0 * a * m2.sqrt() / ((1.0 + m2) * (1.0 + m2));
        assert!((got[1][0] - second).abs() < 1e-12 * second);
        // y''' = -16 a^2 m / (1 + m^2)^3.5 is largest at m = 1 / sqrt 6
        let m2 = 1.0_f64 / 6.0;
        let third = 16.0 * a * a * m2.sqrt() / libm::pow(1.0 + m2, 3.5);
        assert!((got[2][1] - third).abs() < 1e-12 * third, "{} {third}", got[2][1]);
    }

    /// Straight pieces, axes at rest, a piece that starts from rest: zero curvature, and the search terminates.
    #[test]
    fn pieces_without_a_bend() {
        let (even, uneven) = ([0.0, 3.0, 0.0, 0.0, 0.0, 0.0], [0.0, 0.5, 0.4, 0.1, 0.0, 0.0]);
        for c in [even, uneven, [0.0, 0.0, 1.0, 0.5, 0.0, 0.0]] {
            let double = c.map(|c| 2.0 * c);
            let piece = PolyPiece::from_slice(&[c, double, [5.0, 0.0, 0.0, 0.0, 0.0, 0.0]]);
            let (got, bend) = extremes(&piece, &[true; 3]);
            let five = 5.0_f64.sqrt();
            assert!((got[0][0] - 1.0 / five).abs() < 1e-12);
            assert!((got[0][1] - 2.0 / five).abs() < 1e-12);
            assert!(got[1].iter().all(|b| *b < 1e-9) && bend < 1e-9, "{got:?}");
            assert!(got.iter().all(|d| d[2] == 0.0));
        }
    }
}
