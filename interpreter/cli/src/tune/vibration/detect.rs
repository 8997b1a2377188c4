//! The vibration that explains most of the residual of a fit, and whether it exceeds noise.
//!
//! The residual is correlated with `e^(-s t - i w t)` for every line of the spectrum and several decays `s`. The energy
//! that such a vibration removes, relative to the noise, is the likelihood ratio; white noise alone exceeds a bound
//! with a known probability.

use realfft::RealFftPlanner;

/// Probability that noise alone is taken for a vibration.
const FALSE_ALARM: f64 = 1e-3;
/// Ratio of successive decays that are tried, from lasting to gone after some samples.
const DECAY_FACTOR: f64 = 2.0;
/// Length of the zero padding as a multiple of the recording.
const PADDING: usize = 2;

/// The vibration that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Candidate {
    /// Frequency in Hz.
    pub(super) freq_hz: f64,
    /// Decay in 1/s.
    pub(super) decay: f64,
}

/// Variance of the white part of a recording: the median of its lines, which few vibrations hardly affect.
fn white_variance(power: &[f64]) -> f64 {
    let mut sorted = power.to_vec();
    if sorted.is_empty() {
        return 0.0;
    }
    let middle = sorted.len() / 2;
    let (_, median, _) = sorted.select_nth_unstable_by(middle, f64::total_cmp);
    // the lines of white noise are exponentially distributed
    *median / std::f64::consts::LN_2
}

/// Powers of the lines of a recording, scaled by its energy: 1 on average for white noise of variance 1.
struct Lines {
    power: Vec<f64>,
    step_hz: f64,
}

fn lines(samples: impl Iterator<Item = f64>, count: usize, energy: f64, rate_hz: f64) -> Lines {
    let length = (PADDING * count).next_power_of_two();
    let mut padded: Vec<f64> = samples.collect();
    padded.resize(length, 0.0);
    let transform = RealFftPlanner::new().plan_fft_forward(length);
    let mut values = transform.make_output_vec();
    // both buffers have the lengths required by the plan
    let done = transform.process(&mut padded, &mut values);
    debug_assert!(done.is_ok());
    let power = values.iter().map(|v| v.norm_sqr() / energy).collect();
    Lines { power, step_hz: rate_hz / length as f64 }
}

/// The strongest vibration of a residual in a range of frequencies in Hz; `None` if it may be noise. The residual is 0
/// where samples are not `valid`.
pub(super) fn strongest(
    residual: &[f64],
    valid: &[bool],
    rate_hz: f64,
    range_hz: (f64, f64),
) -> Option<Candidate> {
    let n = residual.len();
    let seconds = n as f64 / rate_hz;
    let low_hz = range_hz.0.max(2.0 / seconds);
    let high_hz = range_hz.1.min(0.45 * rate_hz);
    let mut best: Option<(f64, Candidate)> = None;
    let mut noise = 0.0;
    let mut tried = 0.0;
    let first = std::iter::successors(Some(1.0 / seconds), |s| Some(DECAY_FACTOR * s));
    for decay in std::iter::once(0.0).chain(first.take_while(|s| *s < 0.25 * rate_hz)) {
        let e = |i: usize| libm::exp(-decay * i as f64 / rate_hz);
        let energy: f64 = (0..n).filter(|i| valid[*i]).map(|i| e(i) * e(i)).sum();
        if energy <= 0.0 {
            continue;
        }
        let of = lines(residual.iter().enumerate().map(|(i, x)| x * e(i)), n, energy, rate_hz);
        if decay <= 0.0 {
            noise = white_variance(&of.power[1..]).max(f64::MIN_POSITIVE);
        }
        for (i, power) in of.power.iter().enumerate() {
            let freq_hz = i as f64 * of.step_hz;
            // a signal that decays within a third of its period does not vibrate
            if freq_hz < low_hz || freq_hz > high_hz || decay > 2.5 * freq_hz {
                continue;
            }
            tried += 1.0;
            if best.is_none_or(|(most, _)| *power > most) {
                best = Some((*power, Candidate { freq_hz, decay }));
            }
        }
    }
    let (power, candidate) = best?;
    (power / noise > libm::log(tried / FALSE_ALARM)).then_some(candidate)
}

/// Root mean square of the white part of a residual with `count` valid samples; the others are 0.
pub(super) fn white(residual: &[f64], count: usize, rate_hz: f64) -> f64 {
    let of = lines(residual.iter().copied(), residual.len(), count.max(1) as f64, rate_hz);
    white_variance(&of.power[1..]).sqrt()
}

/// Ratio of the spectral density of a residual around a frequency in Hz to its mean.
pub(super) fn density(residual: &[f64], rate_hz: f64) -> impl Fn(f64) -> f64 + use<> {
    /// Number of lines on either side that are averaged.
    const AROUND: usize = 16;
    let of = lines(residual.iter().copied(), residual.len(), residual.len() as f64, rate_hz);
    let mean = of.power.iter().sum::<f64>() / of.power.len().max(1) as f64;
    move |freq_hz| {
        let at = ((freq_hz / of.step_hz) as usize).min(of.power.len().saturating_sub(1));
        let from = at.saturating_sub(AROUND);
        let near = &of.power[from..(at + AROUND + 1).min(of.power.len())];
        let local = near.iter().sum::<f64>() / near.len().max(1) as f64;
        if mean > 0.0 { local / mean } else { 1.0 }
    }
}
