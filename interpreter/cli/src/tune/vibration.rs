//! Vibrations in a recorded signal: frequency and damping with their 95 % intervals, hum, blows, noise.
//!
//! A recording is divided into its free decays. In each of them vibrations are found one by one ([`detect`]) and fitted
//! together with offset and drift ([`fit`]) until only noise remains. A signal that does not decay is not a vibration
//! of the machine's structure: mains hum and motors are listed and left out.
//!
//! Order of calls: [`analyse`] with a recording, its rate and the focus, then the vibrations sorted by strength.
//!
//! ```
//! use kontur::tune::vibration::{Focus, analyse};
//! use std::f64::consts::TAU;
//!
//! // 12 Hz with damping 0.03, recorded at 500 Hz
//! let (w, rate_hz) = (TAU * 12.0, 500.0);
//! let swing = |k: i32| (-0.03 * w * f64::from(k) / rate_hz).exp() * (w * f64::from(k) / rate_hz).cos();
//! let found = analyse(&(0..1500).map(swing).collect::<Vec<_>>(), &[], rate_hz, &Focus::default());
//! assert!((found.modes[0].freq.value - 12.0).abs() < 0.05);
//! ```

mod analysis;
mod detect;
mod fit;
mod hits;
mod jumps;
mod part;

pub use analysis::{Analysis, Decay, Lasting, Mode};
pub use fit::Estimate;
use fit::Vibration;
use part::{MISFIT, MOST_MODES, Part, complete, decays, free_part, is_damped, piece};
use std::ops::Range;

/// Largest number of decays that are fitted.
const MOST_DECAYS: usize = 4;
/// Vibrations weaker than this share of the strongest one are not reported.
const LEAST_PEAK_RATIO: f64 = 0.15;
/// Lasting signals below this share of the vibration swing are not reported: rounding, and residuals of their fit.
const LEAST_LASTING_RATIO: f64 = 1e-3;
/// With a higher damping it counts as a transient rather than as a vibration to be shaped away.
const MOST_DAMPING: f64 = 0.3;
/// Number of successive samples at the limit that count as clipped.
const CLIPPED: usize = 3;
/// Swing in steps of the recorder below which rounding without noise distorts a vibration too much.
const LEAST_STEPS: f64 = 1.5;
/// More steps within the swing make the intervals hardly wrong.
const FINE: f64 = 30.0;
/// Number of samples of a recording for each of its values, from which on the recorder has steps.
const SAMPLES_PER_VALUE: usize = 8;
/// Difference of equal values, as a share of the range: their decimals.
const SAME_VALUE: f64 = 1e-5;

/// The part to examine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Focus {
    /// Frequencies in Hz.
    pub range_hz: (f64, f64),
    /// Times in s from the first sample.
    pub window_s: (f64, f64),
}

impl Default for Focus {
    fn default() -> Self {
        Self { range_hz: (0.0, f64::INFINITY), window_s: (0.0, f64::INFINITY) }
    }
}

/// Searches a recording for vibrations. Samples in `missing` were not recorded; their values, interpolated between
/// neighbours, are used to locate decays but are not fitted.
pub fn analyse(samples: &[f64], missing: &[Range<usize>], rate_hz: f64, focus: &Focus) -> Analysis {
    let place = |s: f64| ((s * rate_hz).round().max(0.0) as usize).min(samples.len());
    let (first, last) = (place(focus.window_s.0), place(focus.window_s.1));
    let samples = &samples[first..last.max(first)];
    if samples.len() < 64 || !(samples.iter().any(|x| (x - samples[0]).abs() > 0.0)) {
        return Analysis::default();
    }
    let mut valid = unclipped(samples);
    let mut clipped = valid.iter().filter(|v| !**v).count();
    for gap in missing {
        let inside = |i: usize| i.clamp(first, last) - first;
        let part = &mut valid[inside(gap.start)..inside(gap.end)];
        clipped -= part.iter().filter(|v| !**v).count();
        part.fill(false);
    }
    let mut all: Vec<(Analysis, f64)> = Vec::new();
    let step = resolution(samples);
    let parts = jumps::between(samples, rate_hz, step);
    let decays = hits::decays(samples, &parts, rate_hz, focus.range_hz);
    for decay in decays.into_iter().take(MOST_DECAYS) {
        let mut found = of_decay(samples, &valid, rate_hz, focus.range_hz, decay, step);
        for decay in &mut found.decays {
            decay.samples = decay.samples.start + first..decay.samples.end + first;
        }
        let energy = found.swing;
        all.push((found, energy));
    }
    let mut all = all.into_iter().map(|(found, _)| found);
    let mut result = all.next().unwrap_or_default();
    result.clipped = clipped;
    let edge = |parts: &[Range<usize>]| parts[0].end.midpoint(parts[1].start) + first;
    result.jumps = parts.windows(2).map(edge).collect();
    for other in all {
        result.merge(other);
    }
    result
}

/// False where a recorder was at its limit: several successive samples that are exactly the largest or smallest value.
fn unclipped(samples: &[f64]) -> Vec<bool> {
    let high = samples.iter().copied().fold(f64::MIN, f64::max);
    let low = samples.iter().copied().fold(f64::MAX, f64::min);
    let mut valid = vec![true; samples.len()];
    for limit in [low, high] {
        let at = |i: usize| (samples[i] - limit).abs() <= 0.0;
        let mut i = 0;
        while i < samples.len() {
            let run = (i..samples.len()).take_while(|j| at(*j)).count();
            if run >= CLIPPED {
                valid[i..i + run].fill(false);
            }
            i += run.max(1);
        }
    }
    valid
}

/// The step between the values of a recorder, 0 if there are nearly as many values as samples.
fn resolution(samples: &[f64]) -> f64 {
    let mut sorted = samples.to_vec();
    sorted.sort_by(f64::total_cmp);
    let range = sorted[sorted.len() - 1] - sorted[0];
    let steps = || sorted.windows(2).map(|w| w[1] - w[0]).filter(|step| *step > SAME_VALUE * range);
    let is_stepped = steps().count() < samples.len() / SAMPLES_PER_VALUE;
    if is_stepped { steps().fold(range, f64::min) } else { 0.0 }
}

/// Half the difference between the largest and the smallest sample.
fn height(samples: &[f64]) -> f64 {
    let ends = |(low, high): (f64, f64), x: &f64| (low.min(*x), high.max(*x));
    let (low, high) = samples.iter().fold((f64::MAX, f64::MIN), ends);
    0.5 * (high - low)
}

/// The beginning of a decay that a recorder resolves, if its noise does not make the rounding random: most samples equal
/// the ones before.
fn resolved(samples: &[f64], decay: &Range<usize>, step: f64) -> Option<Range<usize>> {
    let of = &samples[decay.clone()];
    let equal = of.windows(2).filter(|w| (w[1] - w[0]).abs() < 0.5 * step).count();
    if step <= 0.0 || 2 * equal < of.len() {
        return None;
    }
    let mut sorted = of.to_vec();
    let middle = sorted.len() / 2;
    let level = *sorted.select_nth_unstable_by(middle, f64::total_cmp).1;
    // of a swing below the steps nothing is left
    let last = of.iter().rposition(|x| (x - level).abs() > LEAST_STEPS * step).unwrap_or(0);
    Some(decay.start..decay.start + (last + 1).max(64).min(of.len()))
}

fn of_decay(
    samples: &[f64],
    valid: &[bool],
    rate_hz: f64,
    range_hz: (f64, f64),
    decay: Range<usize>,
    step: f64,
) -> Analysis {
    let coarse = resolved(samples, &decay, step);
    let steps = coarse.as_ref().map(|range| height(&samples[range.clone()]) / step);
    let range = coarse.unwrap_or(decay);
    let top_hz = range_hz.1.min(400.0).min(0.4 * rate_hz);
    let cut = |range: &Range<usize>| piece(samples, valid, rate_hz, range, top_hz);
    let part = |range: Range<usize>, most| Part::of(range, cut, range_hz, most);
    let mut part_used = part(range, MOST_MODES);
    if part_used.fit.misfit(&part_used.piece) > MISFIT {
        part_used = free_part(&part_used, rate_hz, part).unwrap_or(part_used);
    }
    let Part { mut range, piece: mut used, mut stride, mut fit } = part_used;
    // after the decay there is only noise, and drift that is not a parabola
    let slowest = fit
        .vibrations(&used, |_| 1.0)
        .iter()
        .filter(|v| decays(v, used.seconds()))
        .map(|v| v.decay.value)
        .fold(f64::INFINITY, f64::min);
    let length = (7.0 / slowest * rate_hz) as usize;
    if slowest.is_finite() && length < range.len() / 2 {
        range = range.start..range.start + length.max(64);
        (used, stride) = cut(&range);
        fit = complete(fit.again(&used), &used, range_hz, MOST_MODES);
    }
    let density = detect::density(&fit.residual(&used), used.rate_hz);
    let found = fit.vibrations(&used, density);
    let (modes, swing) = modes(&found, used.seconds(), range_hz);
    Analysis {
        noise: fit.noise(&used),
        swing,
        lasting: lasting(&found, used.seconds(), swing),
        modes,
        decays: vec![Decay { samples: range, curve: fit.curve(&used), stride }],
        clipped: 0,
        jumps: Vec::new(),
        steps: steps.filter(|steps| *steps < FINE),
        disagree: None,
        misfit: Some(fit.misfit(&used)).filter(|misfit| *misfit > MISFIT),
    }
}

/// The decaying vibrations, the highest peak first, and the sum of their amplitudes.
fn modes(found: &[Vibration], seconds: f64, range_hz: (f64, f64)) -> (Vec<Mode>, f64) {
    let peak = |v: &Vibration| v.amplitude / v.decay.value.max(1e-9);
    let inside = |v: &&Vibration| v.freq.value > range_hz.0 && v.freq.value < range_hz.1;
    let decaying = || found.iter().filter(|v| decays(v, seconds)).filter(inside);
    // next to a transient, its residual and the digits of the file are not vibrations
    let highest = decaying().map(peak).fold(f64::MIN_POSITIVE, f64::max);
    let mut modes: Vec<&Vibration> =
        decaying().filter(|v| v.damping.value < MOST_DAMPING).collect();
    modes.sort_by(|a, b| peak(b).total_cmp(&peak(a)));
    let swing = modes.iter().map(|v| v.amplitude).sum();
    let mode =
        |v: &&Vibration| Mode { freq: v.freq, damping: v.damping, peak_ratio: peak(v) / highest };
    let modes = modes.iter().map(mode).filter(|m| m.peak_ratio >= LEAST_PEAK_RATIO);
    (modes.collect(), swing)
}

/// Vibrations that do not decay, beside the `swing` of those that do.
fn lasting(found: &[Vibration], seconds: f64, swing: f64) -> Vec<Lasting> {
    let lasts = |v: &&Vibration| {
        !decays(v, seconds)
            && v.damping.value < MOST_DAMPING
            && v.amplitude >= LEAST_LASTING_RATIO * swing
    };
    let lasting = |v: &Vibration| Lasting {
        freq_hz: v.freq.value,
        amplitude: v.amplitude,
        hum: is_hum(v.freq.value),
        loss: if is_damped(v) { -libm::expm1(-v.decay.value * seconds) } else { 0.0 },
    };
    found.iter().filter(lasts).map(lasting).collect()
}

fn is_hum(freq_hz: f64) -> bool {
    hits::MAINS_HZ.iter().any(|mains| {
        let k = (freq_hz / mains).round().max(1.0);
        (freq_hz / (k * mains) - 1.0).abs() < hits::MAINS_RATIO
    })
}

#[cfg(test)]
mod tests;
