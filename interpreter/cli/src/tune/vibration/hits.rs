//! Free decays of a recording: drift and hum are removed first, then blows are found by their energy.
//!
//! A blow is a point after which the energy is higher than before. The windows are longer than the beats of
//! neighbouring vibrations, so that a beat does not count as a blow.

use super::detect;
use std::f64::consts::TAU;
use std::ops::Range;

/// Nominal frequencies of the mains in Hz.
pub(super) const MAINS_HZ: [f64; 2] = [50.0, 60.0];
/// Relative distance from a multiple of the mains frequency that counts as equal: the accuracy of grids.
pub(super) const MAINS_RATIO: f64 = 0.006;
/// Number of multiples of the mains frequency that are examined.
const HARMONICS: u32 = 20;
/// Number of parts of a recording in which a hum must be equally strong.
const PARTS: usize = 8;
/// Shortest window of the energies in s.
const WINDOW_S: f64 = 0.4;
/// Length in s of the pieces that are searched for a short vibration.
const PART_S: f64 = 0.5;
/// Rise of the energy at a blow, as a ratio.
const RISE: f64 = 1.8;
/// Shorter pieces cannot contain a decay.
const LEAST_SAMPLES: usize = 64;
/// Blows with less than this share of the strongest one's energy are ignored.
const LEAST_ENERGY: f64 = 0.1;

/// Removes offset, linear and quadratic drift from a recording.
fn without_drift(samples: &[f64]) -> Vec<f64> {
    let n = samples.len() as f64;
    // Legendre polynomials over -1 .. 1: nearly orthogonal on a fine grid
    let basis = |i: usize| {
        let u = 2.0 * (i as f64 + 0.5) / n - 1.0;
        [1.0, u, 1.5 * u * u - 0.5]
    };
    let weights: Vec<f64> = (0..3)
        .map(|k| {
            let (mut sum, mut norm) = (0.0, 0.0);
            for (i, x) in samples.iter().enumerate() {
                let b = basis(i)[k];
                sum += b * x;
                norm += b * b;
            }
            sum / norm
        })
        .collect();
    let drift = |i: usize| basis(i).iter().zip(&weights).map(|(b, w)| b * w).sum::<f64>();
    samples.iter().enumerate().map(|(i, x)| x - drift(i)).collect()
}

/// Complex amplitude of a frequency in a part of a recording, under a Hann window; phases refer to its first sample.
fn amplitude(
    samples: &[f64],
    from: usize,
    rate_hz: f64,
    freq_hz: f64,
    part: &Range<usize>,
) -> [f64; 2] {
    let n = part.len() as f64;
    let mut sum = [0.0, 0.0];
    for (j, i) in part.clone().enumerate() {
        let window = 1.0 - libm::cos(TAU * (j as f64 + 0.5) / n);
        let (sin, cos) = libm::sincos(TAU * freq_hz * (i - from) as f64 / rate_hz);
        sum[0] += window * samples[i] * cos;
        sum[1] -= window * samples[i] * sin;
    }
    sum.map(|x| 2.0 * x / n)
}

/// Removes multiples of the mains frequency that are equally strong in all parts of a recording.
fn without_hum(samples: &mut [f64], rate_hz: f64) {
    let n = samples.len();
    let parts: Vec<Range<usize>> = (0..PARTS).map(|p| p * n / PARTS..(p + 1) * n / PARTS).collect();
    for base in MAINS_HZ {
        for k in 1..=HARMONICS {
            let freq_hz = base * f64::from(k);
            let periods = freq_hz * (n / PARTS) as f64 / rate_hz;
            if freq_hz > 0.45 * rate_hz || periods < 4.0 {
                continue;
            }
            let parts_of: Vec<[f64; 2]> =
                parts.iter().map(|p| amplitude(samples, 0, rate_hz, freq_hz, p)).collect();
            let mut sizes: Vec<f64> = parts_of.iter().map(|a| libm::hypot(a[0], a[1])).collect();
            sizes.sort_by(f64::total_cmp);
            let median = sizes[PARTS / 2];
            if median <= 0.0 || sizes[0] < 0.6 * median || sizes[PARTS - 1] > 1.6 * median {
                continue;
            }
            // the mean phase step from part to part gives the deviation of the grid frequency
            let mut turn = [0.0, 0.0];
            for pair in parts_of.windows(2) {
                turn[0] += pair[1][0] * pair[0][0] + pair[1][1] * pair[0][1];
                turn[1] += pair[1][1] * pair[0][0] - pair[1][0] * pair[0][1];
            }
            let part_s = n as f64 / PARTS as f64 / rate_hz;
            let real_hz = freq_hz + libm::atan2(turn[1], turn[0]) / (TAU * part_s);
            if (real_hz / freq_hz - 1.0).abs() > MAINS_RATIO {
                continue;
            }
            let [re, im] = amplitude(samples, 0, rate_hz, real_hz, &(0..n));
            for (i, x) in samples.iter_mut().enumerate() {
                let (sin, cos) = libm::sincos(TAU * real_hz * i as f64 / rate_hz);
                *x -= re * cos - im * sin;
            }
        }
    }
}

/// Free decays of the parts of a recording, the most energetic first. In each part its level does not jump.
pub(super) fn decays(
    samples: &[f64],
    parts: &[Range<usize>],
    rate_hz: f64,
    range_hz: (f64, f64),
) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    for part in parts {
        if part.len() >= LEAST_SAMPLES {
            let of_part = decays_of_part(&samples[part.clone()], rate_hz, range_hz);
            let place = |r: Range<usize>| part.start + r.start..part.start + r.end;
            found.extend(of_part.into_iter().map(|(energy, range)| (energy, place(range))));
        }
    }
    let most = found.iter().map(|p| p.0).fold(0.0, f64::max);
    found.retain(|p| p.0 >= LEAST_ENERGY * most);
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found.into_iter().map(|p| p.1).collect()
}

/// Energies of ranges of samples.
struct Energy {
    /// Of all samples before each one.
    sums: Vec<f64>,
}

impl Energy {
    fn of(samples: &[f64]) -> Self {
        let mut sums = vec![0.0; samples.len() + 1];
        for (i, x) in samples.iter().enumerate() {
            sums[i + 1] = sums[i] + x * x;
        }
        Self { sums }
    }

    fn between(&self, from: usize, to: usize) -> f64 {
        self.sums[to] - self.sums[from]
    }

    /// Mean over the samples of a range.
    fn power(&self, from: usize, to: usize) -> f64 {
        self.between(from, to) / (to - from).max(1) as f64
    }
}

/// Samples at which blows begin, at least one: the energy of the window after them is higher than before, and the period of `one`
/// samples that begins there has more than any other nearby.
fn blows(energy: &Energy, window: usize, one: usize) -> Vec<usize> {
    let n = energy.sums.len() - 1;
    let after = |i: usize| energy.power(i, (i + window).min(n));
    let quiet = (0..n - window).step_by((window / 2).max(1)).map(after).fold(f64::MAX, f64::min);
    // a recording that begins with its vibration has nothing before it
    let before = |i: usize| {
        let seen = i.min(window);
        let unseen = (window - seen) as f64 * quiet;
        (unseen + seen as f64 * energy.power(i - seen, i)) / window as f64
    };
    let rise = |i: usize| after(i) / (before(i) + f64::MIN_POSITIVE);
    let loud = (0..n - window).map(after).fold(0.0, f64::max);
    let front = |i: usize| energy.power(i, (i + one).min(n));
    let last = n - LEAST_SAMPLES.min(n);
    let mut starts: Vec<usize> = Vec::new();
    let mut i = 0;
    while i < last {
        if rise(i) > RISE && after(i) - before(i) > LEAST_ENERGY * loud {
            let end = (i + window).min(last);
            let top = (i..end).reduce(|a, b| if front(b) > front(a) { b } else { a });
            starts.push(top.unwrap_or(i));
            i = end;
        }
        i += 1;
    }
    if starts.is_empty() {
        let top = (0..last).reduce(|a, b| if front(b) > front(a) { b } else { a });
        starts.push(top.unwrap_or(0));
    }
    starts
}

/// Free decays of one part, with their energies: from a blow to the next one.
fn decays_of_part(samples: &[f64], rate_hz: f64, range_hz: (f64, f64)) -> Vec<(f64, Range<usize>)> {
    let mut clean = without_drift(samples);
    without_hum(&mut clean, rate_hz);
    let n = clean.len();
    // a short vibration disappears in the noise of a long recording, which is then searched piece by piece
    let part = ((PART_S * rate_hz) as usize).clamp(LEAST_SAMPLES, n);
    let parts = || (0..=n - part).step_by((part / 2).max(1)).map(|i| &clean[i..i + part]);
    let loudest =
        |samples: &[f64]| detect::strongest(samples, &vec![true; samples.len()], rate_hz, range_hz);
    let loudest = loudest(&clean).or_else(|| parts().find_map(loudest));
    let Some(loudest) = loudest else { return vec![(clean.iter().map(|x| x * x).sum(), 0..n)] };
    let period = (rate_hz / loudest.freq_hz).max(1.0);
    let window = ((4.0 * period).max(WINDOW_S * rate_hz) as usize).clamp(1, (n / 4).max(1));
    let energy = Energy::of(&clean);
    let one = (period as usize).max(1);
    let starts = blows(&energy, window, one);
    let ends: Vec<usize> = starts.iter().skip(1).copied().chain([n]).collect();
    starts
        .iter()
        .zip(ends)
        .filter_map(|(start, end)| {
            // the blow is over after the largest swing
            let near = *start..(start + one + 1).min(end);
            let top = near.reduce(|a, b| if clean[b].abs() > clean[a].abs() { b } else { a })?;
            // the steep front of the next blow begins slightly before its energy rises
            let end =
                if end < n { end.saturating_sub((0.05 * window as f64) as usize) } else { end };
            (end > top + LEAST_SAMPLES).then(|| (energy.between(top, end), top + 1..end))
        })
        .collect()
}
