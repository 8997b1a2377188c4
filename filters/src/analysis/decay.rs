//! Frequency and damping of a vibration from a recording of its decay, by the logarithmic decrement.
//!
//! Source: TF5250 Vibration Guard, P-AXIS-00568: `delta = ln(A1 / A2)` of successive maxima,
//! `damping = 1 / sqrt(1 + (2 pi / delta)^2)`.
//!
//! Order of calls: a recording of the decay, then [`Decay::of`]; maxima read by hand go to [`damping_of_decrement`]
//! instead.
//!
//! ```
//! use kontur_filters::analysis::decay::{Decay, damping_of_decrement};
//! use std::f64::consts::TAU;
//!
//! // 10 Hz with damping 0.05, recorded at 1 kHz
//! let w = TAU * 10.0;
//! let swing = |k: i32| (-0.05 * w * f64::from(k) / 1e3).exp() * (w * f64::from(k) / 1e3).cos();
//! let decay = Decay::of(&(0..1000).map(swing).collect::<Vec<_>>(), 1000.0).unwrap();
//! assert!((decay.damping - 0.05).abs() < 1e-3 && (decay.freq_hz - 10.0).abs() < 0.05);
//! // by hand: a maximum that falls to a half from one to the next
//! assert!((damping_of_decrement(2_f64.ln()) - 0.1097).abs() < 1e-4);
//! ```

use crate::vibration::damped_ratio;
use std::f64::consts::PI;

/// The damping ratio of a logarithmic decrement `ln(A1 / A2)` of successive maxima.
pub fn damping_of_decrement(delta: f64) -> f64 {
    delta / libm::hypot(delta, 2.0 * PI)
}

/// A decaying vibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decay {
    /// Undamped natural frequency in Hz, the quantity that FREQ sets.
    pub freq_hz: f64,
    /// Damping ratio.
    pub damping: f64,
    /// Number of extremes (maxima and minima) that were used.
    pub extremes: usize,
}

/// Extremes smaller than this share of the largest one are treated as noise.
const FLOOR_RATIO: f64 = 0.05;

impl Decay {
    /// The decay after the largest extreme of `samples` taken at `rate_hz`; the samples swing about 0.
    ///
    /// Maxima and minima half a period apart are used down to 5 % of the first one. Their times give the damped
    /// frequency, the slope of the logarithm of their amplitudes gives the decrement, both by least squares. `None`
    /// with fewer than three extremes, or if the amplitude does not decay.
    pub fn of(samples: &[f64], rate_hz: f64) -> Option<Self> {
        let extremes = extremes(samples);
        let largest = |best: Option<usize>, (i, e): (usize, &Extreme)| match best {
            Some(b) if extremes[b].value.abs() >= e.value.abs() => Some(b),
            _ => Some(i),
        };
        let start = extremes.iter().enumerate().fold(None, largest)?;
        let floor = FLOOR_RATIO * extremes[start].value.abs();
        let tail: Vec<&Extreme> =
            extremes[start..].iter().take_while(|e| e.value.abs() >= floor).collect();
        if tail.len() < 3 {
            return None;
        }
        let half_period = slope(tail.iter().map(|e| e.at))?;
        let per_half_period = slope(tail.iter().map(|e| libm::log(e.value.abs())))?;
        let damping = damping_of_decrement(-2.0 * per_half_period);
        if !(half_period > 0.0 && damping.is_finite() && (0.0..1.0).contains(&damping)) {
            return None;
        }
        let damped_hz = 0.5 * rate_hz / half_period;
        let freq_hz = damped_hz / damped_ratio(damping);
        Some(Self { freq_hz, damping, extremes: tail.len() })
    }
}

#[derive(Clone, Copy, Debug)]
struct Extreme {
    /// Position in samples.
    at: f64,
    value: f64,
}

/// The largest sample of each section without a change of sign, refined by a parabola through its neighbours.
fn extremes(samples: &[f64]) -> Vec<Extreme> {
    let mut found = Vec::new();
    let mut from = 0;
    for to in 1..=samples.len() {
        if to < samples.len() && (samples[to] >= 0.0) == (samples[from] >= 0.0) {
            continue;
        }
        let stretch = from..to;
        let peak = stretch
            .fold(from, |best, i| if samples[i].abs() > samples[best].abs() { i } else { best });
        if peak > 0 && peak + 1 < samples.len() {
            found.push(vertex(peak, [samples[peak - 1], samples[peak], samples[peak + 1]]));
        }
        from = to;
    }
    found
}

/// The vertex of the parabola through three samples around `i`.
fn vertex(i: usize, [a, b, c]: [f64; 3]) -> Extreme {
    let curvature = a - 2.0 * b + c;
    let shift = 0.5 * (a - c) / curvature;
    if shift.abs() <= 1.0 {
        Extreme { at: i as f64 + shift, value: b - 0.25 * (a - c) * shift }
    } else {
        Extreme { at: i as f64, value: b }
    }
}

/// Slope of the least-squares line through values at 0, 1, 2, ...
fn slope(values: impl Iterator<Item = f64> + Clone) -> Option<f64> {
    let n = values.clone().count() as f64;
    let middle = 0.5 * (n - 1.0);
    let (product, square) =
        values.zip(0..).fold((0.0, 0.0), |(product, square), (value, i): (f64, u32)| {
            let x = f64::from(i) - middle;
            (product + x * value, square + x * x)
        });
    (square > 0.0).then(|| product / square)
}
