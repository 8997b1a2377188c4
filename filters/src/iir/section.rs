//! First- and second-order sections as state-variable filters with the trapezoidal rule (TPT form).
//!
//! Direct forms lose digits with the square of the ratio of sampling to corner frequency, and drift on a large constant
//! position. These sections have the low-passed position itself as a state. At rest all their differences are exactly
//! zero: the output equals the input bit for bit, and the DC gain is 1 by construction, not by the digits of
//! coefficients.
//!
//! A section only consists of coefficients; each axis has its own state:
//!
//! ```
//! use kontur_filters::iir::section::{FirstOutput, Section, SectionState};
//!
//! let section = Section::first(0.1, FirstOutput::Low);
//! let mut state = SectionState::at_rest(123456.789);
//! // at rest bit for bit, then towards the new input
//! assert_eq!(section.step(&mut state, 123456.789), 123456.789);
//! let reached = (0..500).map(|_| section.step(&mut state, 123457.789)).last().unwrap();
//! assert!((reached - 123457.789).abs() < 1e-6);
//! ```

use crate::response::{Angle, Response};

/// Below this magnitude the state that decays to zero at rest is set to zero, before it becomes denormal and slow.
const VANISHED: f64 = 1e-300;

/// One section: coefficients only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Section {
    /// One real pole.
    First(First),
    /// Two poles.
    Second(Second),
}

/// First-order section `1 / (1 + P')`, with `P'` the frequency relative to that of the pole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct First {
    /// Prewarped frequency of the pole, `tan(pi f T)`.
    g: f64,
    /// `g / (1 + g)`.
    gain: f64,
    output: FirstOutput,
}

/// Second-order section `1 / (1 + k P' + P'^2)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Second {
    /// Prewarped natural frequency.
    g: f64,
    /// Twice the damping ratio.
    k: f64,
    a1: f64,
    a2: f64,
    a3: f64,
    output: SecondOutput,
}

/// Output of a first-order section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FirstOutput {
    /// `1 / (1 + P')`.
    Low,
    /// `P' / (1 + P')`.
    High,
    /// `(1 - P') / (1 + P')`.
    All,
}

/// Output of a second-order section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SecondOutput {
    /// `1 / D`, `D = 1 + k P' + P'^2`.
    Low,
    /// `P'^2 / D`.
    High,
    /// `(1 - k P' + P'^2) / D`.
    All,
    /// `gain P' / D`.
    Band {
        /// Factor of the numerator.
        gain: f64,
    },
    /// `(1 + high P'^2) / D`: a zero at `P' = j / sqrt(high)`.
    Stop {
        /// Gain far above the section's frequency.
        high: f64,
    },
}

/// Memory of one section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionState {
    /// Vanishes at rest; unused by a first-order section.
    s1: f64,
    /// The constant input at rest.
    s2: f64,
}

impl SectionState {
    /// Settled at the constant input `x`.
    pub const fn at_rest(x: f64) -> Self {
        Self { s1: 0.0, s2: x }
    }
}

impl Section {
    /// First-order section with the prewarped pole frequency `g`.
    pub fn first(g: f64, output: FirstOutput) -> Self {
        Self::First(First { g, gain: g / (1.0 + g), output })
    }

    /// Second-order section with the prewarped natural frequency `g` and twice the damping ratio `k`.
    pub fn second(g: f64, k: f64, output: SecondOutput) -> Self {
        let a1 = 1.0 / (1.0 + g * (g + k));
        let a2 = g * a1;
        Self::Second(Second { g, k, a1, a2, a3: g * a2, output })
    }

    /// Next output for the next input.
    #[inline]
    pub fn step(&self, state: &mut SectionState, x: f64) -> f64 {
        match self {
            Self::First(section) => section.step(state, x),
            Self::Second(section) => section.step(state, x),
        }
    }

    /// Frequency response at one frequency.
    pub fn response(&self, at: Angle) -> Response {
        match self {
            Self::First(First { g, output, .. }) => {
                let (c, d) = Response::bilinear(*g, at);
                let numerator = match output {
                    FirstOutput::Low => c,
                    FirstOutput::High => d,
                    FirstOutput::All => c - d,
                };
                numerator / (c + d)
            }
            Self::Second(Second { g, k, output, .. }) => {
                let (c, d) = Response::bilinear(*g, at);
                let (low, band, high) = (c * c, c * d, d * d);
                let numerator = match *output {
                    SecondOutput::Low => low,
                    SecondOutput::High => high,
                    SecondOutput::All => low - band.scaled(*k) + high,
                    SecondOutput::Band { gain } => band.scaled(gain),
                    SecondOutput::Stop { high: gain } => low + high.scaled(gain),
                };
                numerator / (low + band.scaled(*k) + high)
            }
        }
    }
}

impl First {
    fn step(&self, state: &mut SectionState, x: f64) -> f64 {
        let v = (x - state.s2) * self.gain;
        let low = v + state.s2;
        state.s2 = low + v;
        match self.output {
            FirstOutput::Low => low,
            FirstOutput::High => x - low,
            FirstOutput::All => low + (low - x),
        }
    }
}

impl Second {
    fn step(&self, state: &mut SectionState, x: f64) -> f64 {
        let v3 = x - state.s2;
        let v1 = self.a1 * state.s1 + self.a2 * v3;
        let v2 = state.s2 + (self.a2 * state.s1 + self.a3 * v3);
        state.s1 = 2.0 * v1 - state.s1;
        state.s2 = 2.0 * v2 - state.s2;
        if state.s1.abs() < VANISHED {
            state.s1 = 0.0;
        }
        match self.output {
            SecondOutput::Low => v2,
            SecondOutput::High => x - self.k * v1 - v2,
            SecondOutput::All => x - 2.0 * self.k * v1,
            SecondOutput::Band { gain } => gain * v1,
            SecondOutput::Stop { high } => v2 + high * (x - self.k * v1 - v2),
        }
    }
}
