//! Roots of the equations that slope profiles lead to.

/// Root of `c3 x³ + c1 x = d` for `c3 > 0`, `c1 >= 0`, `d >= 0`: the single, non-negative one.
///
/// Cardano's formula in a form without differences of large numbers.
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
/// Newton's method from `guess`, with bisection whenever a step leaves the bracket. It stops after 64 steps or after a
/// step below `precision`, relative to the root; where it converges quadratically, the error is then the square of that
/// step.
#[inline] // the function is evaluated in place
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
        // written so that a NaN step (slope 0) leads to bisection
        let next = if newton >= lo && newton <= hi { newton } else { 0.5 * (lo + hi) };
        let step = (next - x).abs();
        x = next;
        if step <= precision * x.abs() {
            break;
        }
    }
    x
}

/// Two arguments, at most `precision` times their initial distance apart, that enclose the only root of a function, by
/// regula falsi from two arguments with their function values. The function has the sign of `low` at the first one, but
/// not at the second one, which is the root itself if it is met exactly.
pub(crate) fn enclosed_root(
    (mut low, mut at_low): (f64, f64),
    (mut high, mut at_high): (f64, f64),
    precision: f64,
    mut eval: impl FnMut(f64) -> f64,
) -> (f64, f64) {
    let close = precision * (high - low);
    let mut stays = None;
    while high - low > close && at_high != 0.0 {
        // a step close to the root is extended across it
        let least = 0.5 * close / (high - low);
        let step = (at_low / (at_low - at_high)).clamp(least, 1.0 - least);
        let x = low + step * (high - low);
        let here = eval(x);
        let raises_low = here * at_low > 0.0;
        if raises_low {
            (low, at_low) = (x, here);
        } else {
            (high, at_high) = (x, here);
        }
        // an end that is kept twice counts half (Illinois)
        if stays == Some(raises_low) {
            *(if raises_low { &mut at_high } else { &mut at_low }) *= 0.5;
        }
        stays = Some(raises_low);
    }
    (low, high)
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
    fn a_root_is_enclosed_in_few_steps_and_from_both_sides() {
        let steps = std::cell::Cell::new(0);
        for power in [1, 3, 9] {
            for sign in [1.0, -1.0] {
                steps.set(0);
                let f = |x: f64| sign * ((0..power).fold(1.0, |y, _| y * x) - 0.3);
                let counted = |x: f64| {
                    steps.set(steps.get() + 1);
                    f(x)
                };
                let (low, high) = enclosed_root((0.0, f(0.0)), (1.0, f(1.0)), 1e-12, counted);
                assert!(f(low) * f(0.0) > 0.0 && f(high) * f(0.0) <= 0.0, "{power}: {low} {high}");
                assert!(low <= high && (high - low <= 1e-12 || f(high) == 0.0), "{power}: {low}");
                assert!(steps.get() <= 30, "{power}: {} steps", steps.get());
            }
        }
        let half = enclosed_root((0.0, 1.0), (1.0, -1.0), 1e-12, |x| 1.0 - 2.0 * x).1;
        assert!((half - 0.5).abs() < 1e-12);
    }

    #[test]
    fn bracketed_newton_survives_a_flat_start() {
        let x = increasing_root(0.0, 8.0, 0.0, 1e-9, |x| (x * x * x - 8.0, 3.0 * x * x));
        assert!((x - 2.0).abs() < 1e-14);
    }
}
