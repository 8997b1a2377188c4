//! Real roots of polynomials up to degree four.

use crate::profile::roots::increasing_root;
use smallvec::SmallVec;

/// Roots found in an interval, ascending; a double root may appear twice.
pub(super) type Roots = SmallVec<[f64; 6]>;

/// Roots of `c[0] x^n + ... + c[n]` in `lo..=hi`.
///
/// The roots of the derivative divide the interval into monotonic pieces, each with at most one root, which a
/// safeguarded Newton iteration finds. Unlike the closed forms of degree three and four this loses neither digits nor
/// roots near a double root; an extremum that touches zero within rounding counts as a root.
pub(super) fn roots_in(c: &[f64], lo: f64, hi: f64) -> Roots {
    let mut found = Roots::new();
    match *c {
        [] | [_] => {}
        [0.0, ..] => return roots_in(&c[1..], lo, hi),
        [a, b] => found.push(-b / a),
        [a, b, c] => quadratic(a, b, c, &mut found),
        _ => return isolated(c, lo, hi),
    }
    found.retain(|x| *x >= lo && *x <= hi);
    found
}

fn quadratic(a: f64, b: f64, c: f64, found: &mut Roots) {
    let d = b * b - 4.0 * a * c;
    if d < 0.0 {
        return;
    }
    // the sum of equal signs first, the other root from the product
    let q = -0.5 * (b + d.sqrt().copysign(b));
    let (x, y) = (q / a, if q == 0.0 { 0.0 } else { c / q });
    found.push(x.min(y));
    found.push(x.max(y));
}

fn isolated(c: &[f64], lo: f64, hi: f64) -> Roots {
    let degree = c.len() - 1;
    let mut slope = [0.0; 4];
    for (i, (s, value)) in slope.iter_mut().zip(&c[..degree]).enumerate() {
        *s = value * (degree - i) as f64;
    }
    let slope = &slope[..degree];
    let largest = c[1..].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let bound = 1.0 + largest / c[0].abs();
    let (lo, hi) = (lo.max(-bound), hi.min(bound));
    let mut found = Roots::new();
    if lo.is_nan() || hi.is_nan() || lo > hi {
        return found;
    }
    let mut left = (lo, value(c, lo));
    touching(c, left, &mut found);
    for x in roots_in(slope, lo, hi).into_iter().chain([hi]) {
        let right = (x, value(c, x));
        if left.1 * right.1 < 0.0 {
            let sign = if right.1 > 0.0 { 1.0 } else { -1.0 };
            let guess = 0.5 * (left.0 + right.0);
            let both = |x: f64| (sign * value(c, x), sign * value(slope, x));
            found.push(increasing_root(left.0, right.0, guess, 1e-8, both));
        }
        touching(c, right, &mut found);
        left = right;
    }
    found
}

/// Adds `x` as a root if the value there is within rounding.
fn touching(c: &[f64], (x, f): (f64, f64), found: &mut Roots) {
    let scale = c.iter().fold(0.0, |sum, value| sum * x.abs() + value.abs());
    if f.abs() <= 32.0 * f64::EPSILON * scale {
        found.push(x);
    }
}

fn value(c: &[f64], x: f64) -> f64 {
    c.iter().fold(0.0, |sum, value| sum * x + value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_roots(c: &[f64], want: &[f64]) {
        let got = roots_in(c, 0.0, 100.0);
        for x in want {
            assert!(got.iter().any(|y| (x - y).abs() <= 1e-7 * x.abs().max(1e-7)), "{x}: {got:?}");
        }
        for y in &got {
            assert!(
                want.iter().any(|x| (x - y).abs() <= 1e-7 * x.abs().max(1e-7)),
                "{y}: {want:?}"
            );
        }
    }

    #[test]
    fn products_of_known_factors() {
        assert_roots(&[1.0, -10.0, 35.0, -50.0, 24.0], &[1.0, 2.0, 3.0, 4.0]);
        assert_roots(&[1.0, -6.0, 11.0, -6.0], &[1.0, 2.0, 3.0]);
        assert_roots(&[1.0, 0.0, 0.0, 0.0, -1e-12], &[1e-3]);
        // (x - 2)² (x² + 1)
        assert_roots(&[1.0, -4.0, 5.0, -4.0, 4.0], &[2.0]);
        assert_roots(&[0.0, 0.0, 1.0, -3.0, 2.0], &[1.0, 2.0]);
        assert_roots(&[1.0, -1e8, 1.0], &[1e-8]);
        assert_roots(&[1.0, 0.0, 1.0], &[]);
    }
}
