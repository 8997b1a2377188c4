//! What an analysis finds, and how results of several decays are combined.

use super::fit::Estimate;
use std::ops::Range;

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
    /// Samples at which the level jumps.
    pub jumps: Vec<usize>,
    /// Steps of the recorder within the amplitude, if they are few and coarser than the noise: then the rounding of the
    /// samples is no white noise, and the intervals are too small.
    pub steps: Option<f64>,
    /// Lowest and highest frequency in Hz if the decays disagree.
    pub disagree: Option<(f64, f64)>,
    /// Residual of the fit as a multiple of the white noise of the recording, if it is more than noise: a drive that
    /// still moves the machine, coloured noise, a frequency that depends on the amplitude.
    pub misfit: Option<f64>,
}

impl Analysis {
    /// Merges the result of another decay of the same recording.
    pub(super) fn merge(&mut self, other: Self) {
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
