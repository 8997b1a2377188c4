//! Roots of the equations met by slope profiles.

/// Root of `c3 x³ + c1 x = d` for `c3 > 0`, `c1 >= 0`, `d >= 0`: the single, non-negative one.
///
/// Cardano's formula written without a difference of large numbers.
pub(super) fn monotone_cubic(c3: f64, c1: f64, d: f64) -> f64 {
    if d <= 0.0 {
        return 0.0;
    }
    let p = c1 / (3.0 * c3);
    let q = d / (2.0 * c3);
    let u = libm::cbrt(q + (q * q + p * p * p).sqrt());
    // x = u - p/u with u³ - (p/u)³ = 2q; dividing by the other factor avoids the cancellation
    let w = p / u;
    2.0 * q / (u * u + p + w * w)
}

/// Root of an increasing function in `lo..=hi` with `f(lo) <= 0 <= f(hi)`; `eval` gives value and slope.
///
/// Newton from `guess`, bisection whenever a step leaves the bracket; stops after 64 steps or after a step of less
/// than `precision`, relative to the root: where Newton converges quadratically, the error is then its square.
pub(super) fn increasing_root(
    mut lo: f64,
    mut hi: f64,
    guess: f64,
    precision: f64,
    eval: impl Fn(f64) -> (f64, f64),
) -> f64 {
    let mut x = if guess >= lo && guess <= hi { guess } else { 0.5 * (lo + hi) };
    for _ in 0..64 {
        let (value, slope) = eval(x);
        if value > 0.0 {
            hi = x;
        } else {
            lo = x;
        }
        let newton = x - value / slope;
        // written so that a NaN step (slope 0) bisects
        let next = if newton >= lo && newton <= hi { newton } else { 0.5 * (lo + hi) };
        let step = (next - x).abs();
        x = next;
        if step <= precision * x.abs() {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubic_over_many_decades() {
        for e in -60..60 {
            let root = libm::pow(10.0, f64::from(e) / 4.0);
            for c1 in [0.0, 1e-9, 1.0, 1e9] {
                let d = (root * root + c1) * root;
                let x = monotone_cubic(1.0, c1, d);
                assert!((x - root).abs() <= 2e-15 * root, "{root} {c1} {x}");
            }
        }
        assert!(monotone_cubic(1.0, 0.0, 0.0).abs() < f64::MIN_POSITIVE);
    }

    #[test]
    fn bracketed_newton_survives_a_flat_start() {
        let x = increasing_root(0.0, 8.0, 0.0, 1e-9, |x| (x * x * x - 8.0, 3.0 * x * x));
        assert!((x - 2.0).abs() < 1e-14);
    }
}
