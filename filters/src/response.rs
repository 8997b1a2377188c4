//! Analysis: frequency response, group delay, step response, residual vibration.
//!
//! Nothing here runs in a cycle; tests, plots and the choice of parameters use it.
//!
//! Order of calls: convert a frequency to an [`Angle`] on the unit circle, then evaluate the response of kernels and
//! filters at it.
//!
//! ```
//! use kontur_filters::kernel::Kernel;
//! use kontur_filters::response::Angle;
//! use kontur_filters::time::CycleTime;
//!
//! let at = Angle::of(50.0, CycleTime::DEFAULT);
//! let response = Kernel::delay(5).response(at);
//! // 5 ms are a quarter of a period of 50 Hz
//! assert!((response.phase_deg() + 90.0).abs() < 1e-9 && response.magnitude_db().abs() < 1e-9);
//! ```

use crate::kernel::{Kernel, Tap};
use crate::stage::Stage;
use crate::time::CycleTime;
use crate::vibration::damped_ratio;
use nalgebra::Complex;
use std::f64::consts::PI;
use std::ops::{Add, Div, Mul, Sub};

/// A frequency as the angle it advances per cycle, `2 pi f T`; pi is half the sampling frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    per_cycle_rad: f64,
}

impl Angle {
    /// The angle of `f_hz` in the cycle time `cycle`.
    pub fn of(f_hz: f64, cycle: CycleTime) -> Self {
        Self { per_cycle_rad: 2.0 * PI * f_hz * cycle.seconds() }
    }
}

/// Frequency response of a linear stage at one frequency, with its slope along the frequency.
///
/// Responses of stages in series multiply, of stages in parallel they add.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// Complex gain: output over input for `exp(j w t)`.
    pub gain: Complex<f64>,
    /// Derivative of the gain by the angle per cycle.
    slope: Complex<f64>,
}

impl Response {
    /// The response of a stage that passes its input unchanged.
    pub const ONE: Self = Self::constant(1.0);

    /// The response of a frequency-independent gain.
    pub const fn constant(gain: f64) -> Self {
        Self { gain: Complex::new(gain, 0.0), slope: Complex::new(0.0, 0.0) }
    }

    /// The response of a delay by `cycles`.
    pub fn delay(cycles: f64, at: Angle) -> Self {
        let (sin, cos) = libm::sincos(cycles * at.per_cycle_rad);
        let gain = Complex::new(cos, -sin);
        Self { gain, slope: gain * Complex::new(0.0, -cycles) }
    }

    /// `scale * cos(angle / 2)` and `j sin(angle / 2)`: their ratio is the bilinear image of `s / (2 scale / T)`, and
    /// both stay finite at half the sampling frequency.
    pub(crate) fn bilinear(scale: f64, at: Angle) -> (Self, Self) {
        let (sin, cos) = libm::sincos(0.5 * at.per_cycle_rad);
        let denominator = Self {
            gain: Complex::new(scale * cos, 0.0),
            slope: Complex::new(-0.5 * scale * sin, 0.0),
        };
        let numerator = Self { gain: Complex::new(0.0, sin), slope: Complex::new(0.0, 0.5 * cos) };
        (denominator, numerator)
    }

    /// The same response times a number.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self { gain: self.gain * factor, slope: self.slope * factor }
    }

    /// Amplitude ratio.
    pub fn magnitude(&self) -> f64 {
        libm::hypot(self.gain.re, self.gain.im)
    }

    /// Amplitude ratio in dB, minus infinity for a zero.
    pub fn magnitude_db(&self) -> f64 {
        20.0 * libm::log10(self.magnitude())
    }

    /// Phase in degrees, above -180 to 180; meaningless at a zero.
    pub fn phase_deg(&self) -> f64 {
        libm::atan2(self.gain.im, self.gain.re).to_degrees()
    }

    /// Group delay in cycles, the slope of the phase; not a number at a zero.
    pub fn group_delay_cycles(&self) -> f64 {
        0.0 - (self.slope / self.gain).im
    }
}

impl Add for Response {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { gain: self.gain + other.gain, slope: self.slope + other.slope }
    }
}

impl Sub for Response {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { gain: self.gain - other.gain, slope: self.slope - other.slope }
    }
}

impl Mul for Response {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            gain: self.gain * other.gain,
            slope: self.slope * other.gain + self.gain * other.slope,
        }
    }
}

impl Div for Response {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let gain = self.gain / other.gain;
        Self { gain, slope: (self.slope - gain * other.slope) / other.gain }
    }
}

impl Kernel {
    /// Frequency response at one frequency.
    pub fn response(&self, at: Angle) -> Response {
        self.taps().iter().fold(Response::constant(0.0), |sum, tap| {
            sum + Response::delay(f64::from(tap.delay), at).scaled(tap.weight)
        })
    }

    /// The kernel as impulses, for [`residual_vibration_ratio`].
    pub fn impulses(&self, cycle: CycleTime) -> Vec<Impulse> {
        let impulse = |tap: &Tap| Impulse {
            time_s: cycle.time_of(u64::from(tap.delay)),
            amplitude: tap.weight,
        };
        self.taps().iter().map(impulse).collect()
    }
}

/// One impulse of a shaper in continuous time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impulse {
    /// Time in s.
    pub time_s: f64,
    /// Share of the input.
    pub amplitude: f64,
}

/// The first `cycles` outputs after the input of a stage at rest at 0 has jumped to 1. The stage is left in motion.
pub fn step_response(stage: &mut impl Stage, cycles: usize) -> Vec<f64> {
    stage.settle(0.0);
    (0..cycles).map(|_| stage.step(1.0)).collect()
}

/// Amplitude of a vibration of `freq_hz` (undamped natural frequency) and `damping` after the last of the `impulses`,
/// as a share of what a single impulse of the same sum at the time of the last one leaves.
///
/// `V = exp(-z w tn) sqrt(C^2 + S^2)` with `C, S = sum A_i exp(z w t_i) cos, sin(w sqrt(1 - z^2) t_i)`.
pub fn residual_vibration_ratio(impulses: &[Impulse], freq_hz: f64, damping: f64) -> f64 {
    let w = 2.0 * PI * freq_hz;
    let damped = w * damped_ratio(damping);
    let last = impulses.iter().map(|impulse| impulse.time_s).fold(0.0, f64::max);
    let (mut cosine, mut sine) = (0.0, 0.0);
    for &Impulse { time_s, amplitude } in impulses {
        let left = amplitude * libm::exp(damping * w * (time_s - last));
        let (sin, cos) = libm::sincos(damped * time_s);
        cosine += left * cos;
        sine += left * sin;
    }
    libm::hypot(cosine, sine)
}

/// The real frequencies around a set frequency between which a shaper keeps the residual vibration below a limit.
///
/// The vendor's table of permitted deviations normalises the set frequency by the real one
/// ([`set_over_real`](Self::set_over_real)), its worked example the real frequency by the set one
/// ([`real_over_set`](Self::real_over_set)). The two differ by several percent, so both are available.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensitivityBand {
    /// The frequency the shaper is set to in Hz.
    pub set_hz: f64,
    /// Lowest real frequency in Hz.
    pub low_hz: f64,
    /// Highest real frequency in Hz.
    pub high_hz: f64,
}

impl SensitivityBand {
    /// The band of `impulses` set to `set_hz` for vibrations of `damping`, searched outward from `set_hz`; `None` if
    /// the residual exceeds `limit_ratio` at `set_hz` itself.
    ///
    /// The search ends at a tenth and at ten times the set frequency; if the residual is within the limit up to there,
    /// that end is returned.
    pub fn of(impulses: &[Impulse], set_hz: f64, damping: f64, limit_ratio: f64) -> Option<Self> {
        let within =
            |ratio: f64| residual_vibration_ratio(impulses, ratio * set_hz, damping) <= limit_ratio;
        within(1.0).then(|| Self {
            set_hz,
            low_hz: set_hz * edge(&within, -0.001, 0.1),
            high_hz: set_hz * edge(&within, 0.001, 10.0),
        })
    }

    /// Permitted deviation `f_set / f_real - 1` as (negative, positive) limit.
    pub fn set_over_real(&self) -> (f64, f64) {
        (self.set_hz / self.high_hz - 1.0, self.set_hz / self.low_hz - 1.0)
    }

    /// Permitted deviation `f_real / f_set - 1` as (negative, positive) limit.
    pub fn real_over_set(&self) -> (f64, f64) {
        (self.low_hz / self.set_hz - 1.0, self.high_hz / self.set_hz - 1.0)
    }
}

/// The last ratio on the way from 1 to `end` for which `within` holds: in steps, then bisecting the step that leaves
/// the range.
fn edge(within: &impl Fn(f64) -> bool, step: f64, end: f64) -> f64 {
    let steps = ((end - 1.0) / step).round();
    let mut inside = 1.0;
    let mut k = 0.0;
    let mut outside = loop {
        if k >= steps {
            return end;
        }
        k += 1.0;
        let ratio = 1.0 + k * step;
        if !within(ratio) {
            break ratio;
        }
        inside = ratio;
    };
    for _ in 0..50 {
        let middle = 0.5 * (inside + outside);
        if within(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}
