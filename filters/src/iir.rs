//! Standard axis filters (IIR): design from the parameters of an axis list, and execution.
//!
//! Up to three of them act in series on the absolute set position of an axis. At rest the output equals the input bit
//! for bit, because every section is a state-variable filter with the position itself as its state.
//!
//! Source: TF5200 axis filters; P-AXIS-00067, 00080, 00140, 00153, 00164, 00204, 00357.
//!
//! Order of calls: [`AxisFilter::design`], which returns the filter and its issues, then one filter per axis, settled
//! at its position and stepped once per cycle.
//!
//! ```
//! use kontur_filters::iir::prototype::Prototype;
//! use kontur_filters::iir::{AxisFilter, FilterConfig, FilterKind};
//! use kontur_filters::response::Angle;
//! use kontur_filters::time::CycleTime;
//!
//! let (kind, prototype) = (FilterKind::LowPass, Prototype::Butterworth);
//! let config = FilterConfig { kind, prototype, order: 4, f_hz: 15.0, ..FilterConfig::default() };
//! let (filter, issues) = AxisFilter::design(&config, CycleTime::DEFAULT);
//! let response = filter.unwrap().response(Angle::of(15.0, CycleTime::DEFAULT));
//! assert!(issues.is_empty() && (response.magnitude_db() + 3.0103).abs() < 1e-4);
//! ```

pub mod prototype;
pub mod section;
mod thiran;
pub mod transform;

use crate::issue::{Effect, FilterIssue};
use crate::response::{Angle, Response};
use crate::stage::Stage;
use crate::time::CycleTime;
use prototype::Prototype;
use section::{Section, SectionState};
use std::f64::consts::PI;
use thiran::{Thiran, ThiranState};

/// What a standard filter does. Source: TF5200 axis filters, P-AXIS-00204.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilterKind {
    /// Type 1: passes below the characteristic frequency.
    LowPass,
    /// Type 2: passes above the characteristic frequency.
    HighPass,
    /// Type 3: passes around the centre frequency.
    BandPass,
    /// Type 4: blocks around the centre frequency.
    BandStop,
    /// Type 5: changes the phase only.
    AllPass,
    /// Type 6: first-order lag with a time constant.
    Pt1,
    /// Type 10: two equal first-order lags with a time constant.
    Pt2,
    /// Type 11: delay by a time below 6 cycles.
    TimeDelay,
}

impl FilterKind {
    /// Every kind, by its number.
    pub const ALL: [Self; 8] = [
        Self::LowPass,
        Self::HighPass,
        Self::BandPass,
        Self::BandStop,
        Self::AllPass,
        Self::Pt1,
        Self::Pt2,
        Self::TimeDelay,
    ];

    /// Highest order of the range, or the only effective one. Source: P-AXIS-00140.
    pub(crate) const fn max_order(self) -> u32 {
        match self {
            Self::LowPass | Self::HighPass | Self::AllPass => 6,
            Self::BandPass | Self::BandStop => 3,
            Self::Pt1 => 1,
            Self::Pt2 => 2,
            Self::TimeDelay => u32::MAX,
        }
    }

    /// Whether the output does not follow the constant part of the input.
    pub const fn removes_constant_part(self) -> bool {
        matches!(self, Self::HighPass | Self::BandPass)
    }
}

/// Parameters of one standard filter; which of them matter depends on the kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterConfig {
    /// What the filter does, default low-pass (P-AXIS-00204).
    pub kind: FilterKind,
    /// Prototype, default critical damping (P-AXIS-00153); not for PT1, PT2, time delay.
    pub prototype: Prototype,
    /// Order of the prototype, default 0 = off (P-AXIS-00140). For PT1, PT2 and time delay any order above 0 switches
    /// the filter on; orders other than 1 for PT1 and 2 for PT2 are reported.
    pub order: u32,
    /// Characteristic frequency in Hz, default 30 (P-AXIS-00067): -3 dB point of low-pass and high-pass, centre of
    /// band-pass and band-stop; for the all-pass the frequency at which the group delay has fallen to 0.707. Below half
    /// the sampling frequency. Not used by PT1, PT2, time delay.
    pub f_hz: f64,
    /// Quality `f0 / bandwidth` of band-pass and band-stop, 1 to 10, default 1 (P-AXIS-00080).
    pub q: f64,
    /// Share of the signal that passes through the filter, 0 to 1, default 1 (P-AXIS-00164).
    pub share_ratio: f64,
    /// Time constant in us, default 10 000 (P-AXIS-00357): at least one cycle for PT1 and PT2, below 6 cycles for the
    /// time delay.
    pub time_constant_us: u32,
}

impl Default for FilterConfig {
    fn default() -> Self {
        Self {
            kind: FilterKind::LowPass,
            prototype: Prototype::CritDamping,
            order: 0,
            f_hz: 30.0,
            q: 1.0,
            share_ratio: 1.0,
            time_constant_us: 10_000,
        }
    }
}

/// Lowest characteristic frequency as a share of the sampling frequency: 0.01 Hz at 1 ms.
///
/// Assumption: the vendor corrects lower values (110361) to a lowest frequency that no document states. Down to this
/// one the sections were checked against arithmetic with 40 digits.
pub(crate) const LOWEST_FREQUENCY_RATIO: f64 = 1e-5;

/// A standard filter of one axis: its design and its state.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisFilter {
    network: Network,
    share: Share,
    /// Position at switch-on, for filters that act on the deviation from it.
    start: Option<f64>,
}

#[derive(Clone, Debug, PartialEq)]
enum Network {
    Sections(Vec<(Section, SectionState)>),
    Delay(Thiran, ThiranState),
}

/// `q` of `y = x + q (F(x) - x)`; the ends 0 and 1 are separate variants, which makes them exact to the bit.
///
/// Assumption: the formula; the vendor says "share of the signal that passes the filter".
#[derive(Clone, Copy, Debug, PartialEq)]
enum Share {
    None,
    Part(f64),
    All,
}

impl Share {
    fn of(ratio: f64) -> Self {
        if ratio <= 0.0 {
            Self::None
        } else if ratio < 1.0 {
            Self::Part(ratio)
        } else {
            Self::All
        }
    }

    fn mix(self, x: f64, filtered: f64) -> f64 {
        match self {
            Self::None => x,
            Self::Part(q) => x + q * (filtered - x),
            Self::All => filtered,
        }
    }
}

impl AxisFilter {
    /// The filter of a configuration, at rest at 0, and the issues found.
    ///
    /// `None` with order 0 (off, no issue), or if one of the issues requires it: 50663, a frequency at or above half
    /// the sampling frequency, a quality or share out of range.
    pub fn design(config: &FilterConfig, cycle: CycleTime) -> (Option<Self>, Vec<FilterIssue>) {
        if config.order == 0 {
            return (None, Vec::new());
        }
        let (checked, issues) = check(config, cycle);
        if issues.iter().any(|issue| issue.effect() == Effect::Off) {
            return (None, issues);
        }
        let filter = Self {
            network: Network::of(&checked, cycle),
            share: Share::of(checked.share_ratio),
            start: checked.kind.removes_constant_part().then_some(0.0),
        };
        (Some(filter), issues)
    }

    /// Frequency response at one frequency; for a high-pass or band-pass that of the deviation it acts on.
    pub fn response(&self, at: Angle) -> Response {
        let filtered = match &self.network {
            Network::Sections(sections) => sections
                .iter()
                .fold(Response::ONE, |chain, (section, _)| chain * section.response(at)),
            Network::Delay(delay, _) => delay.response(at),
        };
        match self.share {
            Share::None => Response::ONE,
            Share::Part(q) => Response::ONE + (filtered - Response::ONE).scaled(q),
            Share::All => filtered,
        }
    }

    /// False for a high-pass and a band-pass, which act on the deviation from the position at switch-on.
    pub(crate) fn lets_rest_through(&self) -> bool {
        self.start.is_none()
    }

    /// Settles at `x` in place of another filter. One that acts on the deviation from the position at switch-on keeps
    /// that position, so that it continues to block what it has blocked.
    pub(crate) fn settle_as(&mut self, before: &Self, x: f64) {
        self.settle_from(x, before.start.unwrap_or(x));
    }

    /// Settles at `x` after a shift of the coordinate by `by_mm`, which moves the position at switch-on, too.
    pub(crate) fn shift(&mut self, by_mm: f64, x: f64) {
        self.settle_from(x, self.start.map_or(x, |start| start + by_mm));
    }

    /// Settles at `x`, switched on at `start`.
    fn settle_from(&mut self, x: f64, start: f64) {
        self.start = self.start.map(|_| start);
        let input = self.start.map_or(x, |start| x - start);
        match &mut self.network {
            Network::Sections(sections) => {
                // a constant deviation does not get past the first section
                let later = if self.start.is_some() { 0.0 } else { x };
                for (i, (_, state)) in sections.iter_mut().enumerate() {
                    *state = SectionState::at_rest(if i == 0 { input } else { later });
                }
            }
            Network::Delay(_, state) => *state = ThiranState::at_rest(input),
        }
    }

    /// The output that a constant input `x` finally leads to: `x`, except for a high-pass or band-pass.
    pub(crate) fn final_value(&self, x: f64) -> f64 {
        self.start.map_or(x, |start| self.share.mix(x, start))
    }
}

impl Stage for AxisFilter {
    fn step(&mut self, x: f64) -> f64 {
        let input = self.start.map_or(x, |start| x - start);
        let filtered = match &mut self.network {
            Network::Sections(sections) => {
                sections.iter_mut().fold(input, |x, (section, state)| section.step(state, x))
            }
            Network::Delay(delay, state) => delay.step(state, input),
        };
        self.share.mix(x, self.start.map_or(filtered, |start| start + filtered))
    }

    fn settle(&mut self, x: f64) {
        self.settle_from(x, x);
    }

    /// Delay for slow signals; 0 for a high-pass or band-pass, which pass none.
    fn delay_cycles(&self) -> f64 {
        if self.start.is_some() {
            return 0.0;
        }
        self.response(Angle::of(0.0, CycleTime::DEFAULT)).group_delay_cycles()
    }
}

impl Network {
    /// The network of a checked configuration.
    fn of(config: &FilterConfig, cycle: CycleTime) -> Self {
        let period_s = cycle.seconds();
        let tau_s = f64::from(config.time_constant_us) / 1e6;
        // Prewarped at the characteristic frequency, which is 1/(2 pi tau) for the lags.
        let g = match config.kind {
            FilterKind::Pt1 | FilterKind::Pt2 => libm::tan(0.5 * period_s / tau_s),
            _ => libm::tan(PI * config.f_hz * period_s),
        };
        let quality = || transform::warped_quality(config.f_hz, config.q, period_s);
        let sections = match config.kind {
            FilterKind::LowPass => transform::low_pass(&config.prototype.terms(config.order), g),
            FilterKind::HighPass => transform::high_pass(&config.prototype.terms(config.order), g),
            FilterKind::AllPass => {
                transform::all_pass(&config.prototype.all_pass_terms(config.order), g)
            }
            FilterKind::BandPass => {
                transform::band_pass(&config.prototype.terms(config.order), g, quality())
            }
            FilterKind::BandStop => {
                transform::band_stop(&config.prototype.terms(config.order), g, quality())
            }
            FilterKind::Pt1 => transform::lags(1, g),
            FilterKind::Pt2 => transform::lags(2, g),
            FilterKind::TimeDelay => {
                let cycles = f64::from(config.time_constant_us) / f64::from(cycle.us());
                return Self::Delay(Thiran::new(cycles), ThiranState::at_rest(0.0));
            }
        };
        let at_rest = |section| (section, SectionState::at_rest(0.0));
        Self::Sections(sections.into_iter().map(at_rest).collect())
    }
}

/// The configuration with its corrections, and all issues.
fn check(config: &FilterConfig, cycle: CycleTime) -> (FilterConfig, Vec<FilterIssue>) {
    use FilterKind::{AllPass, BandPass, BandStop, Pt1, Pt2, TimeDelay};
    let mut config = *config;
    let mut issues = Vec::new();
    let (kind, order) = (config.kind, config.order);
    if order > kind.max_order() {
        config.order = kind.max_order();
        issues.push(FilterIssue::OrderTooHigh { order, used: config.order });
    } else if kind == Pt2 && order < 2 {
        config.order = 2;
        issues.push(FilterIssue::OrderCorrected { order, used: config.order });
    }
    if matches!(kind, Pt1 | Pt2 | TimeDelay) {
        let (min_us, max_us) =
            if kind == TimeDelay { (0, 6 * cycle.us() - 1) } else { (cycle.us(), u32::MAX) };
        let time_constant_us = config.time_constant_us;
        if !(min_us..=max_us).contains(&time_constant_us) {
            issues.push(FilterIssue::TimeConstant { time_constant_us, min_us, max_us });
        }
    } else {
        let sampling_hz = 1.0 / cycle.seconds();
        let (min_hz, max_hz) = (LOWEST_FREQUENCY_RATIO * sampling_hz, 0.5 * sampling_hz);
        let f_hz = config.f_hz;
        if f_hz.is_nan() || f_hz >= max_hz {
            issues.push(FilterIssue::Frequency { f_hz, min_hz, max_hz });
        } else if f_hz < min_hz {
            config.f_hz = min_hz;
            issues.push(FilterIssue::FrequencyTooLow { f_hz, used_hz: min_hz });
        }
    }
    if matches!(kind, BandPass | BandStop) && !(1.0..=10.0).contains(&config.q) {
        issues.push(FilterIssue::Quality { quality: config.q, range: "1 to 10" });
    }
    if !(0.0..=1.0).contains(&config.share_ratio) {
        issues.push(FilterIssue::Share { share_ratio: config.share_ratio });
    }
    if kind == AllPass && config.prototype != Prototype::Bessel {
        issues.push(FilterIssue::AllPassNotBessel);
    }
    if kind.removes_constant_part() {
        issues.push(FilterIssue::RemovesConstantPart);
    }
    (config, issues)
}
