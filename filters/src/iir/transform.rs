//! From low-pass prototypes to the sections of a filter: frequency transforms and prewarped bilinear transform.
//!
//! `g = tan(pi f T)` is the prewarped characteristic frequency, at which the discrete response equals the analog one
//! exactly. For band filters the centre is prewarped, so that the notch lies exactly at the measured frequency, and the
//! quality is corrected ([`warped_quality`]), so that the edges are exactly `f0 / Q` apart at any `f0 T`.
//!
//! Order of calls: the factors of a [prototype](super::prototype), then the sections:
//!
//! ```
//! use kontur_filters::iir::prototype::Prototype;
//! use kontur_filters::iir::transform::{band_edges_hz, low_pass};
//! use kontur_filters::response::Angle;
//! use kontur_filters::time::CycleTime;
//!
//! let cycle = CycleTime::DEFAULT;
//! let g = (std::f64::consts::PI * 15.0 * cycle.seconds()).tan();
//! let sections = low_pass(&Prototype::Butterworth.terms(4), g);
//! let at = Angle::of(15.0, cycle);
//! let db: f64 = sections.iter().map(|section| section.response(at).magnitude_db()).sum();
//! assert!((db + 3.0103).abs() < 1e-4);
//! // a band of quality 2 around 20 Hz is 10 Hz wide
//! let (low, high) = band_edges_hz(20.0, 2.0, cycle.seconds());
//! assert!((high - low - 10.0).abs() < 1e-9);
//! ```

use super::prototype::Term;
use super::section::{FirstOutput, SecondOutput, Section};
use nalgebra::Complex;
use std::f64::consts::PI;

/// Quality of the analog band filter whose discrete form has the -3 dB edges `f0 / q` apart.
///
/// The edges `fu`, `fo` satisfy `tan(pi fo T) tan(pi fu T) = tan(pi f0 T)^2`; the sum and difference formulas of the
/// tangent give `Q' = sin(2 pi f0 T) / (2 tan(pi f0 T / Q))`. Without the correction Q = 1 at f0 T = 0.1 becomes 1.099.
///
/// Assumption: the vendor's own rule is not documented; the manual defines Q as `f0 / (fo - fu)` and does not mention a
/// dependence on the cycle time.
pub(crate) fn warped_quality(f_hz: f64, q: f64, period_s: f64) -> f64 {
    let centre = PI * f_hz * period_s;
    libm::sin(2.0 * centre) / (2.0 * libm::tan(centre / q))
}

/// The -3 dB edges in Hz of a discrete band filter, the lower one first.
///
/// `cos(pi (fo + fu) T) = cos(pi (fo - fu) T) cos(2 pi f0 T)` with `fo - fu = f0 / q`.
pub fn band_edges_hz(f_hz: f64, q: f64, period_s: f64) -> (f64, f64) {
    let width = PI * f_hz / q * period_s;
    let sum = libm::acos(libm::cos(width) * libm::cos(2.0 * PI * f_hz * period_s));
    let unit = 2.0 * PI * period_s;
    ((sum - width) / unit, (sum + width) / unit)
}

/// Low-pass `1 / (1 + a P + b P^2)`.
pub fn low_pass(terms: &[Term], g: f64) -> Vec<Section> {
    terms.iter().map(|term| pole(term, g, FirstOutput::Low, SecondOutput::Low)).collect()
}

/// High-pass, P replaced by 1/P: `P^2 / (P^2 + a P + b)`.
pub fn high_pass(terms: &[Term], g: f64) -> Vec<Section> {
    let section = |term: &Term| {
        if term.b > 0.0 {
            let wn = term.b.sqrt();
            Section::second(g * wn, term.a / wn, SecondOutput::High)
        } else {
            Section::first(g * term.a, FirstOutput::High)
        }
    };
    terms.iter().map(section).collect()
}

/// All-pass `(1 - a P + b P^2) / (1 + a P + b P^2)`.
pub(crate) fn all_pass(terms: &[Term], g: f64) -> Vec<Section> {
    terms.iter().map(|term| pole(term, g, FirstOutput::All, SecondOutput::All)).collect()
}

/// `count` equal first-order lags.
pub fn lags(count: usize, g: f64) -> Vec<Section> {
    vec![Section::first(g, FirstOutput::Low); count]
}

/// Band-pass, P replaced by `Q (P + 1/P)`: the poles are the roots of `s^2 - (p/Q) s + 1` for every low-pass pole p.
pub(crate) fn band_pass(terms: &[Term], g: f64, q: f64) -> Vec<Section> {
    let band = |pole: Pole| {
        let scale = 1.0 / q;
        let gain = pole.magnitude() * scale;
        pole.scaled(scale).resonances().map(move |Resonance { wn, k }| {
            Section::second(g * wn, k, SecondOutput::Band { gain: gain / wn })
        })
    };
    poles(terms).flat_map(band).collect()
}

/// Band-stop, P replaced by `1 / (Q (P + 1/P))`: the poles are the roots of `s^2 - s/(p Q) + 1`.
pub fn band_stop(terms: &[Term], g: f64, q: f64) -> Vec<Section> {
    let stop = |pole: Pole| {
        pole.inverse().scaled(1.0 / q).resonances().map(move |Resonance { wn, k }| {
            Section::second(g * wn, k, SecondOutput::Stop { high: wn * wn })
        })
    };
    poles(terms).flat_map(stop).collect()
}

/// The section of a factor whose poles stay at those of the prototype.
fn pole(term: &Term, g: f64, first: FirstOutput, second: SecondOutput) -> Section {
    if term.b > 0.0 {
        let root = term.b.sqrt();
        Section::second(g / root, term.a / root, second)
    } else {
        Section::first(g / term.a, first)
    }
}

/// A real pole, or the upper one of a conjugate pair.
#[derive(Clone, Copy, Debug)]
enum Pole {
    Real(f64),
    Pair(Complex<f64>),
}

/// Natural frequency and twice the damping ratio of a pole pair.
#[derive(Clone, Copy, Debug)]
struct Resonance {
    wn: f64,
    k: f64,
}

/// The poles of all factors.
fn poles(terms: &[Term]) -> impl Iterator<Item = Pole> + '_ {
    terms.iter().flat_map(|&Term { a, b }| {
        let discriminant = a * a - 4.0 * b;
        let [one, other] = if b <= 0.0 {
            [Some(Pole::Real(-1.0 / a)), None]
        } else if discriminant >= 0.0 {
            // Both roots without cancellation: the larger one first, the other from their product 1/b.
            let sum = a + discriminant.sqrt();
            [Some(Pole::Real(-0.5 * sum / b)), Some(Pole::Real(-2.0 / sum))]
        } else {
            [Some(Pole::Pair(Complex::new(-a, (-discriminant).sqrt()) / (2.0 * b))), None]
        };
        one.into_iter().chain(other)
    })
}

impl Pole {
    fn magnitude(self) -> f64 {
        match self {
            Self::Real(p) => p.abs(),
            Self::Pair(p) => libm::hypot(p.re, p.im),
        }
    }

    fn scaled(self, factor: f64) -> Self {
        match self {
            Self::Real(p) => Self::Real(p * factor),
            Self::Pair(p) => Self::Pair(p * factor),
        }
    }

    fn inverse(self) -> Self {
        match self {
            Self::Real(p) => Self::Real(1.0 / p),
            Self::Pair(p) => Self::Pair(p.inv()),
        }
    }

    /// The pole pairs that `s^2 - r s + 1` has for this pole r and, for a complex pole, for its conjugate. With a
    /// quality of at least 1 and an order of at most 3 all roots are complex.
    fn resonances(self) -> impl Iterator<Item = Resonance> {
        let [one, other] = match self {
            Self::Real(r) => [Some(Resonance { wn: 1.0, k: -r }), None],
            Self::Pair(r) => {
                let root = square_root(r * r - Complex::new(4.0, 0.0));
                [Some(resonance((r + root) * 0.5)), Some(resonance((r - root) * 0.5))]
            }
        };
        one.into_iter().chain(other)
    }
}

fn resonance(s: Complex<f64>) -> Resonance {
    let wn = libm::hypot(s.re, s.im);
    Resonance { wn, k: -2.0 * s.re / wn }
}

/// Square root of a complex number with a negative real part, without cancellation.
fn square_root(z: Complex<f64>) -> Complex<f64> {
    let im = (0.5 * (libm::hypot(z.re, z.im) - z.re)).sqrt();
    Complex::new(0.5 * z.im / im, im)
}
