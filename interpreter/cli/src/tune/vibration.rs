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

mod detect;
mod fit;
mod hits;

pub use fit::Estimate;
use fit::{Fit, Piece, Vibration};
use std::ops::Range;

/// Largest number of vibrations that are searched, including hum and its harmonics.
const MOST_MODES: usize = 10;
/// Largest number of them while the end of an excitation is sought: a fit of many to coloured noise takes long.
const FEW_MODES: usize = 3;
/// Largest number of decays that are fitted.
const MOST_DECAYS: usize = 4;
/// Largest number of samples that are fitted; longer pieces are averaged.
const MOST_SAMPLES: usize = 16_384;
/// Vibrations weaker than this share of the strongest one are not reported.
const LEAST_PEAK_RATIO: f64 = 0.15;
/// Lasting signals below this share of the vibration swing are not reported: rounding, and residuals of their fit.
const LEAST_LASTING_RATIO: f64 = 1e-3;
/// A vibration that loses less than this over the whole piece counts as lasting.
const LASTING: f64 = 0.3;
/// With a higher damping it counts as a transient rather than as a vibration to be shaped away.
const MOST_DAMPING: f64 = 0.3;
/// A fit that leaves more than this multiple of the white noise of the piece is incomplete.
const MISFIT: f64 = 1.25;
/// Number of first samples of a part that are examined on their own, and the multiple of the white noise that they may leave.
const FRONT: usize = 64;
const MISFIT_OF_FRONT: f64 = 1.5;
/// Number of times that an incompletely fitted piece is halved.
const HALVINGS: usize = 3;
/// Shorter parts of a piece are not fitted.
const LEAST_PART: usize = 256;
/// First time in s after the start of a piece at which an excitation may have ended, and the ratio from one to the next.
const EXCITATION_S: (f64, f64) = (0.02, 1.5);
/// Number of bisections between an excitation and the free decay after it.
const BISECTIONS: usize = 5;
/// Number of successive samples at the limit that count as clipped.
const CLIPPED: usize = 3;

/// A decaying vibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Undamped natural frequency in Hz.
    pub freq: Estimate,
    /// Damping ratio.
    pub damping: Estimate,
    /// Height of its peak in a spectrum (amplitude / decay), 1 for the highest one.
    pub peak_ratio: f64,
}

/// A signal that does not decay, or by too little within the recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lasting {
    /// Frequency in Hz.
    pub freq_hz: f64,
    /// Amplitude.
    pub amplitude: f64,
    /// The mains (50 or 60 Hz) or one of its harmonics.
    pub hum: bool,
    /// Share of the amplitude that is lost within the evaluated part, 0 if that is less than the accuracy.
    pub loss: f64,
}

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

/// One free decay: its samples, and the fitted curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Decay {
    /// First sample and the one after the last.
    pub samples: Range<usize>,
    /// The fit at intervals of `stride` samples.
    pub curve: Vec<f64>,
    /// Samples from one value of the curve to the next.
    pub stride: usize,
}

/// The result for a record.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Analysis {
    /// Decaying vibrations, strongest first; possibly none.
    pub modes: Vec<Mode>,
    /// Signals that do not decay.
    pub lasting: Vec<Lasting>,
    /// The decays that were fitted, the most energetic first.
    pub decays: Vec<Decay>,
    /// Root mean square of the residual.
    pub noise: f64,
    /// Largest swing of the fitted vibrations in the first decay.
    pub swing: f64,
    /// Samples at the limit of the recorder.
    pub clipped: usize,
    /// Lowest and highest frequency in Hz if the decays disagree.
    pub disagree: Option<(f64, f64)>,
    /// Residual of the fit as a multiple of the white noise of the recording, if it is more than noise: a drive that
    /// still moves the machine, coloured noise, a frequency that depends on the amplitude.
    pub misfit: Option<f64>,
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
    for decay in hits::decays(samples, rate_hz, focus.range_hz).into_iter().take(MOST_DECAYS) {
        let mut found = of_decay(samples, &valid, rate_hz, focus.range_hz, decay);
        for decay in &mut found.decays {
            decay.samples = decay.samples.start + first..decay.samples.end + first;
        }
        let energy = found.swing;
        all.push((found, energy));
    }
    let mut all = all.into_iter().map(|(found, _)| found);
    let mut result = all.next().unwrap_or_default();
    result.clipped = clipped;
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

/// A piece of a recording, averaged if it is too long.
fn piece(
    samples: &[f64],
    valid: &[bool],
    rate_hz: f64,
    range: &Range<usize>,
    top_hz: f64,
) -> (Piece, usize) {
    // twelve samples per period of the highest frequency of interest are kept
    let most = (rate_hz / (12.0 * top_hz.max(1.0))) as usize;
    let stride = range.len().div_ceil(MOST_SAMPLES).min(most.max(1));
    let starts = range.clone().step_by(stride).filter(|i| i + stride <= range.end);
    let (mut averaged, mut good) = (Vec::new(), Vec::new());
    for i in starts {
        averaged.push(samples[i..i + stride].iter().sum::<f64>() / stride as f64);
        good.push(valid[i..i + stride].iter().all(|v| *v));
    }
    (Piece { samples: averaged, valid: good, rate_hz: rate_hz / stride as f64 }, stride)
}

/// Adds vibrations to a fit, up to a number of them, until only noise remains.
fn complete(mut fit: Fit, piece: &Piece, range_hz: (f64, f64), most: usize) -> Fit {
    let largest = piece.samples.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    while fit.modes() < most {
        let residual = fit.residual(piece);
        let Some(next) = detect::strongest(&residual, &piece.valid, piece.rate_hz, range_hz) else {
            break;
        };
        let wider = fit.with(piece, next.freq_hz, next.decay);
        let sound = wider.vibrations(piece, |_| 1.0).iter().all(|v| {
            v.amplitude < 20.0 * largest
                && v.freq.value.is_finite()
                && [v.freq, v.damping, v.decay].iter().all(|e| e.half_width.is_finite())
                && v.freq.value < 0.5 * piece.rate_hz
        });
        // a vibration that hardly reduces the residual is the misfit of another one
        if !sound || wider.noise(piece) > 0.999 * fit.noise(piece) {
            break;
        }
        fit = wider;
    }
    fit
}

/// A part of a recording with its fit.
struct Part {
    range: Range<usize>,
    piece: Piece,
    stride: usize,
    fit: Fit,
}

impl Part {
    fn of(
        range: Range<usize>,
        cut: impl Fn(&Range<usize>) -> (Piece, usize),
        range_hz: (f64, f64),
        most_modes: usize,
    ) -> Self {
        let (piece, stride) = cut(&range);
        let fit = complete(Fit::new(&piece), &piece, range_hz, most_modes);
        Self { range, piece, stride, fit }
    }

    /// Whether it consists of decaying vibrations and noise, from its first samples on: the end of an excitation is short, and
    /// hardly changes the residual of a long part.
    fn is_free(&self) -> bool {
        let seconds = self.piece.seconds();
        let residual = self.fit.residual(&self.piece);
        let front = &residual[..FRONT.min(residual.len())];
        let front = (front.iter().map(|e| e * e).sum::<f64>() / front.len() as f64).sqrt();
        self.fit.misfit(&self.piece) < MISFIT
            && front < MISFIT_OF_FRONT * self.fit.white(&self.piece)
            && self.fit.vibrations(&self.piece, |_| 1.0).iter().any(|v| decays(v, seconds))
    }
}

/// The part of an incompletely fitted one that is a free decay: its longest such beginning, otherwise its longest such end. A later blow spoils the fit of the whole, but not
/// that of its beginning; an excitation that lasts, such as the braking of a move, not that of its end.
fn free_part(
    whole: &Part,
    rate_hz: f64,
    part: impl Fn(Range<usize>, usize) -> Part,
) -> Option<Part> {
    let Range { start, end } = whole.range;
    let beginning = (1..=HALVINGS)
        .map(|halvings| start..start + (whole.range.len() >> halvings))
        .take_while(|shorter| shorter.len() >= LEAST_PART)
        .map(|shorter| part(shorter, MOST_MODES))
        .find(Part::is_free);
    if beginning.is_some() {
        return beginning;
    }
    let (first_s, ratio) = EXCITATION_S;
    let (mut excited, mut free) = (start, None);
    for after_s in std::iter::successors(Some(first_s), |s| Some(s * ratio)) {
        let from = start + (after_s * rate_hz) as usize;
        if from > start + whole.range.len() / 2 || end - from < LEAST_PART {
            break;
        }
        let rest = part(from..end, FEW_MODES);
        if rest.is_free() {
            free = Some(rest);
            break;
        }
        excited = from;
    }
    let mut free = free?;
    for _ in 0..BISECTIONS {
        let rest = part(excited.midpoint(free.range.start)..end, FEW_MODES);
        if rest.is_free() {
            free = rest;
        } else {
            excited = rest.range.start;
        }
    }
    Some(part(free.range, MOST_MODES))
}

fn of_decay(
    samples: &[f64],
    valid: &[bool],
    rate_hz: f64,
    range_hz: (f64, f64),
    range: Range<usize>,
) -> Analysis {
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
    let peak = |v: &Vibration| v.amplitude / v.decay.value.max(1e-9);
    let inside = |v: &&Vibration| v.freq.value > range_hz.0 && v.freq.value < range_hz.1;
    let decaying = || found.iter().filter(|v| decays(v, used.seconds())).filter(inside);
    // next to a transient, its residual and the digits of the file are not vibrations
    let highest = decaying().map(peak).fold(f64::MIN_POSITIVE, f64::max);
    let mut modes: Vec<&Vibration> =
        decaying().filter(|v| v.damping.value < MOST_DAMPING).collect();
    modes.sort_by(|a, b| peak(b).total_cmp(&peak(a)));
    let swing = modes.iter().map(|v| v.amplitude).sum();
    let lasting = found.iter().filter(|v| {
        !decays(v, used.seconds())
            && v.damping.value < MOST_DAMPING
            && v.amplitude >= LEAST_LASTING_RATIO * swing
    });
    Analysis {
        noise: fit.noise(&used),
        swing,
        lasting: lasting
            .map(|v| Lasting {
                freq_hz: v.freq.value,
                amplitude: v.amplitude,
                hum: is_hum(v.freq.value),
                loss: if is_damped(v) {
                    -libm::expm1(-v.decay.value * used.seconds())
                } else {
                    0.0
                },
            })
            .collect(),
        modes: modes
            .iter()
            .map(|v| Mode { freq: v.freq, damping: v.damping, peak_ratio: peak(v) / highest })
            .filter(|m| m.peak_ratio >= LEAST_PEAK_RATIO)
            .collect(),
        decays: vec![Decay { samples: range, curve: fit.curve(&used), stride }],
        clipped: 0,
        disagree: None,
        misfit: Some(fit.misfit(&used)).filter(|misfit| *misfit > MISFIT),
    }
}

/// Whether it is damped by more than the accuracy.
fn is_damped(v: &Vibration) -> bool {
    v.decay.value > 1.5 * v.decay.half_width
}

/// Whether it is damped, and loses enough within this time to be distinguished from a motor.
fn decays(v: &Vibration, seconds: f64) -> bool {
    is_damped(v) && v.decay.value * seconds > LASTING
}

fn is_hum(freq_hz: f64) -> bool {
    hits::MAINS_HZ.iter().any(|mains| {
        let k = (freq_hz / mains).round().max(1.0);
        (freq_hz / (k * mains) - 1.0).abs() < hits::MAINS_RATIO
    })
}

/// Combines two estimates of the same quantity, weighted by their accuracy; if they exclude each other the interval
/// covers both.
fn joined(a: Estimate, b: Estimate) -> Estimate {
    let weight = |e: Estimate| 1.0 / (e.half_width * e.half_width).max(f64::MIN_POSITIVE);
    let (wa, wb) = (weight(a), weight(b));
    let value = (wa * a.value + wb * b.value) / (wa + wb);
    let spread = (a.value - b.value).abs();
    let own = 1.0 / (wa + wb).sqrt();
    let excluded = spread > libm::hypot(a.half_width, b.half_width) * 1.3;
    Estimate { value, half_width: if excluded { own.max(spread) } else { own } }
}

impl Analysis {
    /// Merges the result of another decay of the same recording.
    fn merge(&mut self, other: Self) {
        for mode in &mut self.modes {
            let same = other.modes.iter().find(|m| {
                let far = (m.freq.value - mode.freq.value).abs();
                far < 0.03 * mode.freq.value + libm::hypot(m.freq.half_width, mode.freq.half_width)
            });
            let Some(same) = same else { continue };
            let far = (same.freq.value - mode.freq.value).abs();
            if far > 1.5 * libm::hypot(same.freq.half_width, mode.freq.half_width) {
                let (low, high) =
                    (mode.freq.value.min(same.freq.value), mode.freq.value.max(same.freq.value));
                let (l, h) = self.disagree.unwrap_or((low, high));
                self.disagree = Some((l.min(low), h.max(high)));
            }
            mode.freq = joined(mode.freq, same.freq);
            mode.damping = joined(mode.damping, same.damping);
        }
        if self.modes.is_empty() {
            self.modes = other.modes;
            self.swing = other.swing;
        }
        self.decays.extend(other.decays);
    }
}

#[cfg(test)]
mod tests;
