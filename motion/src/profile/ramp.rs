//! One ramp of acceleration: from zero to a plateau in a given time.

use std::f64::consts::PI;

/// Shape of an acceleration ramp of a non-linear slope (P-CHAN-00071).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RampShape {
    /// Acceleration changes linearly: constant jerk.
    Trapez,
    /// Acceleration follows sin²: continuous jerk, its peak is π/2 times that of the linear ramp.
    Sin2,
}

/// Additional state of a ramp relative to a motion at its initial velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct RampState {
    pub(super) s: f64,
    pub(super) v: f64,
    pub(super) a: f64,
    pub(super) j: f64,
}

impl RampShape {
    /// Ratio of the peak jerk of a ramp to its mean jerk.
    pub(crate) fn peak_jerk(self) -> f64 {
        match self {
            Self::Trapez => 1.0,
            Self::Sin2 => 0.5 * PI,
        }
    }

    /// Distance gained by a whole rising ramp, over `a t²`.
    pub(super) fn rise_factor(self) -> f64 {
        match self {
            Self::Trapez => 1.0 / 6.0,
            Self::Sin2 => 0.25 - 1.0 / (PI * PI),
        }
    }

    /// State at time `x` in `0..=t` after the start of a ramp from 0 to `a`.
    ///
    /// Sin2, with `z = πx/(2t)`: `a sin²z`, velocity `(a t / 2π)(2z - sin 2z)`, distance
    /// `a (t/π)² (z² - sin²z)`; the differences are evaluated without cancellation.
    pub(super) fn rise(self, a: f64, t: f64, x: f64) -> RampState {
        if t <= 0.0 {
            return RampState { s: 0.0, v: 0.0, a, j: 0.0 };
        }
        match self {
            Self::Trapez => {
                let j = a / t;
                RampState { s: j * x * x * x / 6.0, v: 0.5 * j * x * x, a: j * x, j }
            }
            Self::Sin2 => {
                let z = 0.5 * PI * x / t;
                let sin = libm::sin(z);
                let unit = t / PI;
                RampState {
                    s: a * unit * unit * minus_sin(z) * (z + sin),
                    v: 0.5 * a * unit * minus_sin(2.0 * z),
                    a: a * sin * sin,
                    j: 0.5 * a / unit * libm::sin(2.0 * z),
                }
            }
        }
    }
}

/// `x - sin x`, accurate for small `x`.
fn minus_sin(x: f64) -> f64 {
    if x.abs() > 0.5 {
        return x - libm::sin(x);
    }
    let y = x * x;
    let tail = 1.0 - y / 110.0 * (1.0 - y / 156.0 * (1.0 - y / 210.0));
    x * y / 6.0 * (1.0 - y / 20.0 * (1.0 - y / 42.0 * (1.0 - y / 72.0 * tail)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_gains_half_the_velocity_of_the_plateau() {
        for shape in [RampShape::Trapez, RampShape::Sin2] {
            let end = shape.rise(1200.0, 0.04, 0.04);
            assert!((end.v - 24.0).abs() < 1e-12);
            assert!((end.a - 1200.0).abs() < 1e-9);
            let s = shape.rise_factor() * 1200.0 * 0.04 * 0.04;
            assert!((end.s - s).abs() < 1e-14, "{shape:?}");
        }
    }

    #[test]
    fn peak_jerk_of_sin2_is_in_the_middle_and_half_pi_times_larger() {
        let middle = RampShape::Sin2.rise(1000.0, 0.05, 0.025);
        assert!((middle.j - 31_415.926_535_897_93).abs() < 1e-9);
        assert!(RampShape::Sin2.rise(1000.0, 0.05, 0.0).j.abs() < 1e-9);
        assert!(RampShape::Sin2.rise(1000.0, 0.05, 0.05).j.abs() < 1e-9);
    }

    #[test]
    fn series_and_sine_agree_where_they_meet() {
        for x in [0.499_999, 0.3, 0.1] {
            assert!((minus_sin(x) - (x - libm::sin(x))).abs() < 1e-16);
        }
        assert!((minus_sin(1e-6) / 1e-18 - 1.0 / 6.0).abs() < 1e-12);
    }
}
