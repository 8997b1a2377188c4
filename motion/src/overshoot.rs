//! Overshoot of a kernel with negative weights (windowed sinc) at a start or a stop: the set point swings beyond the
//! end of the path.
//!
//! When the path brakes from a speed `v` with a deceleration `a` to rest, the filtered set point passes the end. After
//! an abrupt stop it does so by `v` times an area of the kernel; a braking phase longer than the kernel leaves `a`
//! times a second moment of its tail. A lower acceleration therefore keeps a tolerance at any speed, while a lower
//! speed would have to be close to zero. Starts are stops reversed in time.

use kontur_filters::kernel::{Kernel, Tap};

/// Bisection steps for the ratio of accelerations.
const BISECTIONS: usize = 20;
/// Smallest acceleration that is searched for, as a share of the present one.
const LEAST: f64 = 1e-7;

/// Largest distance in mm by which the set point swings beyond either end of a move that accelerates to `v` mm/s and
/// decelerates with `a` mm/s2.
pub(crate) fn beyond_the_end(kernel: &Kernel, cycle_s: f64, v: f64, a: f64) -> f64 {
    let braking_s = v / a;
    // distance from the rest position `t` seconds before it is reached
    let back = |t: f64| {
        let ramp = t.clamp(0.0, braking_s);
        0.5 * a * ramp * ramp + v * (t - braking_s).max(0.0)
    };
    let length = kernel.length();
    let pull = |tap: &Tap, cycles: u32| tap.weight * back(cycle_s * f64::from(cycles));
    let beyond = |n: u32| {
        let taps = kernel.taps();
        let stop: f64 = taps.iter().map(|tap| pull(tap, tap.delay.saturating_sub(n))).sum();
        let start: f64 = taps.iter().map(|tap| pull(tap, n.saturating_sub(tap.delay))).sum();
        -stop.min(start)
    };
    (0..=length).map(beyond).fold(0.0, f64::max)
}

/// Largest acceleration in mm/s2, up to `a`, with which a single start or stop keeps the tolerance in mm; the move
/// reaches at most `v` mm/s and is `length` mm long.
pub(crate) fn gentle(
    kernel: &Kernel,
    cycle_s: f64,
    (v, length): (f64, f64),
    a: f64,
    tolerance: f64,
) -> f64 {
    let keeps =
        |a: f64| beyond_the_end(kernel, cycle_s, v.min((a * length).sqrt()), a) <= tolerance;
    if keeps(a) {
        return a;
    }
    let (mut low, mut high) = (LEAST * a, a);
    for _ in 0..BISECTIONS {
        let mid = (low * high).sqrt();
        if keeps(mid) { low = mid } else { high = mid }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;

    const T: f64 = 0.001;

    fn kernel(weights: &[f64]) -> Kernel {
        let taps = weights.iter().zip(0..).map(|(&weight, delay)| Tap { delay, weight });
        Kernel::from_taps(taps).unwrap()
    }

    /// Weights -1/4, 3/2, -1/4: one cycle after an abrupt stop only the oldest weight still sees the path, one cycle
    /// before its end, so the set point is `v T / 4` beyond the end; with braking over more than a cycle it is
    /// `a T^2 / 8`.
    #[test]
    fn closed_forms_of_three_weights() {
        let k = kernel(&[-0.25, 1.5, -0.25]);
        let abrupt = beyond_the_end(&k, T, 100.0, 1e12);
        assert!((abrupt - 0.25 * 100.0 * T).abs() < 1e-6, "{abrupt}");
        let long = beyond_the_end(&k, T, 100.0, 5000.0);
        assert!((long - 0.125 * 5000.0 * T * T).abs() < 1e-15, "{long}");
    }

    #[test]
    fn positive_weights_stay_inside() {
        let k = kernel(&[1.0, 2.0, 5.0, 1.0]);
        assert!(beyond_the_end(&k, T, 100.0, 5000.0) <= 0.0);
        assert!((gentle(&k, T, (100.0, 10.0), 5000.0, 1e-9) - 5000.0).abs() < 1e-12);
    }

    /// Closed form: `a = 8 tolerance / T^2`.
    #[test]
    fn the_gentle_acceleration_uses_the_tolerance() {
        let k = kernel(&[-0.25, 1.5, -0.25]);
        let a = gentle(&k, T, (100.0, 1000.0), 50_000.0, 1e-4);
        assert!((a / 800.0 - 1.0).abs() < 1e-4, "{a}");
    }
}
