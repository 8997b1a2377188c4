//! Improved Position Control: active damping of up to three vibrations.
//!
//! Every stage filters a speed and adds a counter-movement to the command of the position controller:
//!
//! ```text
//! y_i   = source -> [oscillator] -> band-pass / all-pass
//! v_add = clamp(-sum w_i y_i, +-limit)
//! ```
//!
//! The source is the measured speed of the direct measuring system (DIRECT), of the motor (INDIRECT) or the speed
//! command (`SET_POINT`). The last two go through a simulated oscillator and so damp a vibration that the encoders do
//! not show.
//!
//! Assumption: the manual speaks of a counter-movement and prints no sign. Minus adds damping wherever the motor moves
//! in phase with the encoder that is fed back; plus removes it.
//!
//! Source: ISG Improved Position Control (available from V3.1.3077.08).
//!
//! Order of calls: [`IpcConfig::check`], then [`Ipc::step`] once per cycle with the measured speeds:
//!
//! ```
//! use kontur_filters::control::ipc::{
//!     Ipc, IpcConfig, IpcFilterConfig, IpcFilterType, IpcInput, IpcMode, IpcStageConfig,
//! };
//! use kontur_filters::time::CycleTime;
//!
//! let cycle = CycleTime::DEFAULT;
//! let band = IpcFilterConfig {
//!     kind: IpcFilterType::BandPass,
//!     order: 2,
//!     frequency_hz: 20.0,
//!     quality: 2.0,
//! };
//! let stage =
//!     IpcStageConfig { mode: IpcMode::Direct, filters: vec![band], ..IpcStageConfig::default() };
//! let config =
//!     IpcConfig { enable: true, limit_ratio: 0.1, stages: vec![stage], ..IpcConfig::default() };
//! assert!(config.check(cycle).is_empty() && config.active(cycle));
//! let mut ipc = Ipc::new(&config, 1000.0, cycle);
//! ipc.start();
//! // it moves against a vibration of its frequency
//! let swing = |k: i32| (std::f64::consts::TAU * 20e-3 * f64::from(k)).sin();
//! let against: f64 = (0..1000)
//!     .map(|k| {
//!         let input = IpcInput { direct_mm_s: Some(swing(k)), ..IpcInput::default() };
//!         swing(k) * ipc.step(&input).speed_mm_s
//!     })
//!     .sum();
//! assert!(against < 0.0);
//! ```

mod filter;

use super::fault::{Fault, IpcParameter, Issue};
use crate::time::CycleTime;
use filter::{Cascade, all_pass, band_pass, oscillator};

/// The signal from which a stage derives its damping (P-AXIS-00753).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum IpcMode {
    /// 0: the stage is off (default).
    #[default]
    NotActive,
    /// 1: measured speed of the direct measuring system, of the motor if there is none.
    Direct,
    /// 2: simulated oscillation driven by the measured motor speed.
    Indirect,
    /// 3: simulated oscillation driven by the speed command of the position controller.
    SetPoint,
}

/// Type of a filter of a stage (P-AXIS-00849).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IpcFilterType {
    /// Band-pass around the damped frequency.
    BandPass,
    /// All-pass that shifts the phase of the additive speed.
    AllPass,
}

/// One filter of a stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IpcFilterConfig {
    /// Type (P-AXIS-00849).
    pub kind: IpcFilterType,
    /// Order (P-AXIS-00750), 1..=3. A band-pass falls by 20 dB per decade and order on either side; an all-pass shifts
    /// the phase by 90 degrees per order at its frequency.
    pub order: u32,
    /// Damped frequency in Hz (P-AXIS-00751), above 0, at most 500 and below half the sampling rate.
    pub frequency_hz: f64,
    /// Quality (P-AXIS-00752), 1..=10: frequency / bandwidth. Ignored by an all-pass.
    pub quality: f64,
}

/// One stage.
#[derive(Clone, Debug, PartialEq)]
pub struct IpcStageConfig {
    /// Mode (P-AXIS-00753).
    pub mode: IpcMode,
    /// Numerator of the weight (P-AXIS-00754), above 0, default 1. The weight is at most 7.0.
    pub weight_num: f64,
    /// Denominator of the weight (P-AXIS-00755), above 0, default 1.
    pub weight_denom: f64,
    /// The filters, at least one of them a band-pass, in any order. The first band-pass sets the frequency of the
    /// oscillator.
    pub filters: Vec<IpcFilterConfig>,
    /// Damping of the simulated oscillation (P-AXIS-00756, newer builds P-AXIS-00850), between 0 and 1, exclusive; the
    /// smaller, the larger the additive speed. Ignored by DIRECT. Default -1: outside the range on purpose.
    pub oscillator_damping: f64,
}

/// Improved Position Control of one axis. Gantry slaves use the configuration of the master with their own signals.
#[derive(Clone, Debug, PartialEq)]
pub struct IpcConfig {
    /// On (P-AXIS-00758), default false.
    pub enable: bool,
    /// Limit of the additive speed as a share of the largest axis speed (P-AXIS-00757 / 1000), 0..=2, default 0: no
    /// output.
    pub limit_ratio: f64,
    /// Cycles from the computation of the additive speed to its effect, 0..=5, default 1.
    ///
    /// Assumption: 1, as for any value that a drive receives in the next telegram; the documents do not say.
    pub delay_cycles: usize,
    /// Up to three stages.
    pub stages: Vec<IpcStageConfig>,
    /// The axis is a gantry slave: it may not enable the function itself (70600).
    pub gantry_slave: bool,
}

impl Default for IpcConfig {
    fn default() -> Self {
        Self {
            enable: false,
            limit_ratio: 0.0,
            delay_cycles: 1,
            stages: Vec::new(),
            gantry_slave: false,
        }
    }
}

impl Default for IpcStageConfig {
    fn default() -> Self {
        Self {
            mode: IpcMode::NotActive,
            weight_num: 1.0,
            weight_denom: 1.0,
            filters: Vec::new(),
            oscillator_damping: -1.0,
        }
    }
}

impl IpcStageConfig {
    /// Largest weight.
    pub const MAX_WEIGHT: f64 = 7.0;

    /// Weight of the stage, limited to 7.0.
    pub fn weight(&self) -> f64 {
        (self.weight_num / self.weight_denom).min(Self::MAX_WEIGHT)
    }

    fn band(&self) -> Option<&IpcFilterConfig> {
        self.filters.iter().find(|f| f.kind == IpcFilterType::BandPass)
    }

    /// Adds the errors that switch the function off, then the warnings.
    fn check(&self, stage: usize, cycle: CycleTime, issues: &mut Vec<Issue>) {
        let positive = |v: f64| v > 0.0;
        if !positive(self.weight_num) {
            issues.push(Issue::IpcNumerator { stage, value: self.weight_num });
        }
        if !positive(self.weight_denom) {
            issues.push(Issue::IpcDenominator { stage, value: self.weight_denom });
        }
        let mut range = |good: bool, what, value| {
            if !good {
                issues.push(Issue::IpcRange { stage, what, value });
            }
        };
        let nyquist_hz = 0.5 / cycle.seconds();
        for f in &self.filters {
            let frequency = f.frequency_hz;
            range((1..=3).contains(&f.order), IpcParameter::Order, f64::from(f.order));
            let below = frequency <= 500.0 && frequency < nyquist_hz;
            range(frequency > 0.0 && below, IpcParameter::Frequency, frequency);
            if f.kind == IpcFilterType::BandPass {
                range((1.0..=10.0).contains(&f.quality), IpcParameter::Quality, f.quality);
            }
        }
        range(self.band().is_some(), IpcParameter::BandPass, self.filters.len() as f64);
        if self.mode != IpcMode::Direct {
            let d = self.oscillator_damping;
            range(d > 0.0 && d < 1.0, IpcParameter::Damping, d);
        }
        let weight = self.weight_num / self.weight_denom;
        if self.weight_denom > 0.0 && weight > Self::MAX_WEIGHT {
            issues.push(Issue::IpcWeight { stage, weight });
        }
    }
}

impl IpcConfig {
    /// Stages of an axis.
    pub const MAX_STAGES: usize = 3;
    /// Largest configurable delay.
    pub(crate) const MAX_DELAY: usize = 5;

    /// Issues of the configuration; empty while it is off.
    ///
    /// 70600, 70603, 70604, K-0025 switch the function off for the axis ([`IpcConfig::active`]); K-0026, K-0027,
    /// K-0063 warn.
    pub fn check(&self, cycle: CycleTime) -> Vec<Issue> {
        let mut issues = Vec::new();
        if !self.enable {
            return issues;
        }
        if self.gantry_slave {
            issues.push(Issue::IpcGantrySlave);
            return issues;
        }
        for (stage, config) in self.working_stages() {
            config.check(stage, cycle, &mut issues);
        }
        if self.limit_ratio <= 0.0 {
            issues.push(Issue::IpcNoLimit);
        }
        let bands: Vec<_> =
            self.working_stages().filter_map(|(i, s)| Some((i, s.band()?))).collect();
        for (n, (i, a)) in bands.iter().enumerate() {
            for (j, b) in &bands[n + 1..] {
                let half = |f: &IpcFilterConfig| 0.5 * f.frequency_hz / f.quality;
                if (a.frequency_hz - b.frequency_hz).abs() < half(a) + half(b) {
                    issues.push(Issue::IpcOverlap { stages: (*i, *j) });
                }
            }
        }
        issues
    }

    /// Whether the function is enabled and free of errors.
    pub fn active(&self, cycle: CycleTime) -> bool {
        let warning = |i: &Issue| {
            matches!(i, Issue::IpcNoLimit | Issue::IpcWeight { .. } | Issue::IpcOverlap { .. })
        };
        self.enable && self.check(cycle).iter().all(warning)
    }

    fn working_stages(&self) -> impl Iterator<Item = (usize, &IpcStageConfig)> {
        let stages = self.stages.iter().take(Self::MAX_STAGES).enumerate();
        stages.filter(|(_, s)| s.mode != IpcMode::NotActive)
    }
}

/// Speeds that the stages may use, mm/s.
///
/// Assumption: the true speeds at the start of the cycle; the resolution of the encoders is not modelled.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct IpcInput {
    /// Measured motor speed.
    pub motor_mm_s: f64,
    /// Speed of the direct measuring system, if the axis has one.
    pub direct_mm_s: Option<f64>,
    /// Command of the position controller, with feedforward, without the additive speed.
    pub command_mm_s: f64,
}

/// Additive speed of one cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct IpcOutput {
    /// Additive speed that acts in this cycle, mm/s.
    pub speed_mm_s: f64,
    /// Whether the limit (P-AXIS-00757) is reached; the control reports nothing in this case.
    pub limited: bool,
}

#[derive(Clone, Debug)]
struct Stage {
    mode: IpcMode,
    weight: f64,
    oscillator: Option<Cascade>,
    filters: Vec<Cascade>,
}

impl Stage {
    fn new(config: &IpcStageConfig, cycle_s: f64) -> Self {
        let oscillator = match config.mode {
            IpcMode::Indirect | IpcMode::SetPoint => config
                .band()
                .map(|b| oscillator(b.frequency_hz, config.oscillator_damping, cycle_s)),
            IpcMode::Direct | IpcMode::NotActive => None,
        };
        let filter = |f: &IpcFilterConfig| match f.kind {
            IpcFilterType::BandPass => band_pass(f.order, f.frequency_hz, f.quality, cycle_s),
            IpcFilterType::AllPass => all_pass(f.order, f.frequency_hz, cycle_s),
        };
        let filters = config.filters.iter().map(filter).collect();
        Self { mode: config.mode, weight: config.weight(), oscillator, filters }
    }

    fn step(&mut self, input: &IpcInput) -> f64 {
        let source = match self.mode {
            IpcMode::NotActive => return 0.0,
            IpcMode::Direct => input.direct_mm_s.unwrap_or(input.motor_mm_s),
            IpcMode::Indirect => input.motor_mm_s,
            IpcMode::SetPoint => input.command_mm_s,
        };
        let simulated = self.oscillator.as_mut().map_or(source, |o| o.step(source));
        self.weight * self.filters.iter_mut().fold(simulated, |y, f| f.step(y))
    }

    fn start(&mut self) {
        self.oscillator.iter_mut().chain(&mut self.filters).for_each(Cascade::clear);
    }
}

/// Improved Position Control of one axis with its state.
#[derive(Clone, Debug)]
pub struct Ipc {
    stages: Vec<Stage>,
    limit_mm_s: f64,
    delay: usize,
    computed: [IpcOutput; IpcConfig::MAX_DELAY + 1],
    /// Number of times that the additive speed has gone from one of its limits to the other since the axis was driven.
    swings: u32,
    /// The limit that it reached last, with its sign.
    reached_mm_s: f64,
}

impl Ipc {
    /// Swings at rest, ten periods, after which the loop counts as unstable: what a motion leaves in a stable one decays, and
    /// soon no longer reaches the limits.
    ///
    /// Assumption: the document says that too large a weight makes the loop unstable, not how it shows.
    const UNSTABLE: u32 = 20;

    /// The configured function; it outputs 0 if it is off or has an error ([`IpcConfig::check`]).
    pub fn new(config: &IpcConfig, v_max_mm_s: f64, cycle: CycleTime) -> Self {
        let stages = if config.active(cycle) {
            config.working_stages().map(|(_, s)| Stage::new(s, cycle.seconds())).collect()
        } else {
            Vec::new()
        };
        Self {
            stages,
            limit_mm_s: config.limit_ratio.clamp(0.0, 2.0) * v_max_mm_s,
            delay: config.delay_cycles.min(IpcConfig::MAX_DELAY),
            computed: [IpcOutput::default(); IpcConfig::MAX_DELAY + 1],
            swings: 0,
            reached_mm_s: 0.0,
        }
    }

    /// Axis at rest.
    pub fn start(&mut self) {
        self.stages.iter_mut().for_each(Stage::start);
        self.computed.fill(IpcOutput::default());
        (self.swings, self.reached_mm_s) = (0, 0.0);
    }

    /// Whether there are no stages, so that the additive speed is always 0.
    pub(crate) const fn is_off(&self) -> bool {
        self.stages.is_empty()
    }

    /// Additive speed of one cycle.
    #[inline]
    pub fn step(&mut self, input: &IpcInput) -> IpcOutput {
        if self.is_off() { IpcOutput::default() } else { self.sum_of_stages(input) }
    }

    fn sum_of_stages(&mut self, input: &IpcInput) -> IpcOutput {
        let wanted = -self.stages.iter_mut().map(|s| s.step(input)).sum::<f64>();
        let speed_mm_s = wanted.clamp(-self.limit_mm_s, self.limit_mm_s);
        self.computed.rotate_right(1);
        self.computed[0] = IpcOutput { speed_mm_s, limited: wanted.abs() > self.limit_mm_s };
        self.computed[self.delay]
    }

    /// Watches the output of a cycle: a fault if it keeps swinging between its limits. `driven`: the reference position moves,
    /// or the external inputs change.
    pub(crate) fn swings(&mut self, output: &IpcOutput, driven: bool) -> Option<Fault> {
        if driven {
            (self.swings, self.reached_mm_s) = (0, 0.0);
        } else if output.limited {
            self.swings += u32::from(self.reached_mm_s * output.speed_mm_s < 0.0);
            self.reached_mm_s = output.speed_mm_s;
        }
        if self.swings < Self::UNSTABLE {
            return None;
        }
        self.swings = 0;
        Some(Fault::Swings { limit_mm_s: self.limit_mm_s })
    }

    /// Takes new parameters if the axis is at rest.
    ///
    /// # Errors
    /// 70601 while the axis is interpolated; the old parameters stay.
    pub fn change(
        &mut self,
        config: &IpcConfig,
        v_max_mm_s: f64,
        cycle: CycleTime,
        moving: bool,
    ) -> Result<(), Fault> {
        if moving {
            return Err(Fault::IpcChangedMoving);
        }
        *self = Self::new(config, v_max_mm_s, cycle);
        Ok(())
    }
}

#[cfg(test)]
mod tests;
