//! The part of a recording in which vibrations decay freely, and the fit of it.

use super::detect;
use super::fit::{Fit, Piece, Vibration};
use std::ops::Range;

/// Largest number of vibrations that are searched, including hum and its harmonics.
pub(super) const MOST_MODES: usize = 10;

/// Largest number of them while the end of an excitation is sought: a fit of many to coloured noise takes long.
const FEW_MODES: usize = 3;

/// Largest number of samples that are fitted; longer pieces are averaged.
const MOST_SAMPLES: usize = 16_384;

/// A vibration that loses less than this over the whole piece counts as lasting.
const LASTING: f64 = 0.3;

/// A fit that leaves more than this multiple of the white noise of the piece is incomplete.
pub(super) const MISFIT: f64 = 1.25;

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

/// A piece of a recording, averaged if it is too long.
pub(super) fn piece(
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
pub(super) fn complete(mut fit: Fit, piece: &Piece, range_hz: (f64, f64), most: usize) -> Fit {
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
pub(super) struct Part {
    pub(super) range: Range<usize>,
    pub(super) piece: Piece,
    pub(super) stride: usize,
    pub(super) fit: Fit,
}

impl Part {
    pub(super) fn of(
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
    pub(super) fn is_free(&self) -> bool {
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
pub(super) fn free_part(
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

/// Whether it is damped by more than the accuracy.
pub(super) fn is_damped(v: &Vibration) -> bool {
    v.decay.value > 1.5 * v.decay.half_width
}

/// Whether it is damped, and loses enough within this time to be distinguished from a motor.
pub(super) fn decays(v: &Vibration, seconds: f64) -> bool {
    is_damped(v) && v.decay.value * seconds > LASTING
}
