//! Feedforward of velocity, acceleration and jerk.
//!
//! Conventional variant (flags without output bit): a speed that is added at the output of the position controller,
//!
//! ```text
//! u_ff = g W (wv v + Ta a + wj j)         wj = factor Ta / Kv
//! ```
//!
//! Additive variant (flags with output bit): velocity and torque for the inner loops of the drive, each with its own
//! delay. `g` is the switch and the weight of G135, G136, G137; `W` the global weight.
//!
//! `v`, `a`, `j` are forward differences of the setpoint, its velocity and its acceleration: means over the coming
//! cycle, for which the drive holds its command. Instantaneous derivatives would leave a lag of `a T / (2 Kv)`. The
//! velocity at a sample follows from the setpoints around it by the rule of fourth order, which is exact while the jerk
//! is constant and leaves no net error where it changes.
//!
//! The manual prints the lag under constant jerk as `j+T/K2`. The plus must be a misprint, as the units differ; the lag
//! is the product `j Ta / Kv2`.
//!
//! Source: TF5200 feedforward control 2, figures 1 and 2.
//!
//! Order of calls: [`FeedforwardConfig::checked`], [`Feedforward::start`] at rest, then one [`Feedforward::step`] per
//! cycle with the window of the [buffer](super::buffer):
//!
//! ```
//! use kontur_filters::control::buffer::{Setpoint, SetpointBuffer};
//! use kontur_filters::control::feedforward::{
//!     AdditiveInputs, Feedforward, FeedforwardConfig, FeedforwardMode,
//! };
//! use kontur_filters::time::CycleTime;
//!
//! let config = FeedforwardConfig { mode: FeedforwardMode::VEL, ..FeedforwardConfig::default() };
//! let inputs = AdditiveInputs { velocity: false, torque: false };
//! let (config, issues) = config.checked(CycleTime::DEFAULT, inputs);
//! let mut feedforward = Feedforward::new(config, CycleTime::DEFAULT);
//! let mut buffer = SetpointBuffer::new(config.delay_cycles(), 0);
//! let gain = config.gain(true, 1.0);
//! // 0.1 mm in each cycle are 100 mm/s
//! for k in 0..20 {
//!     buffer.push(Setpoint { position_mm: 0.1 * f64::from(k), gain, jerk_limited: true });
//! }
//! let speed = feedforward.step(&buffer.window(), 50.0).speed_mm_s;
//! assert!(issues.is_empty() && (speed - 100.0).abs() < 1e-6);
//! ```

use super::{buffer::Window, fault::Issue};
use crate::time::CycleTime;

bitflags::bitflags! {
    /// What is fed forward and where it enters (P-AXIS-00223 `vorsteuer.vorsteuerung`, default NONE).
    ///
    /// Source: TF5200 feedforward control 5.2.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub struct FeedforwardMode: u16 {
        /// Velocity at the controller output.
        const VEL = 0x001;
        /// Acceleration at the controller output.
        const ACC = 0x002;
        /// Jerk at the controller output.
        const JERK = 0x004;
        /// Velocity as additive velocity of the drive.
        const ADD_VEL = 0x101;
        /// Acceleration as additive torque of the drive.
        const ADD_ACC = 0x202;
        /// Jerk as additive torque of the drive.
        const ADD_JERK = 0x804;
    }
}

impl FeedforwardMode {
    /// Whether the part `activation` is on and goes to the controller output.
    fn conventional(self, activation: Self, additive: Self) -> bool {
        self.contains(activation) && !self.contains(additive)
    }

    /// Whether every output is 0 in a window of gain 0. This holds without delays, which would still output earlier
    /// values. (All three parts at the controller output could sum up to -0.)
    fn needs_gain(self) -> bool {
        let delayed = [Self::ADD_VEL, Self::ADD_ACC, Self::ADD_JERK];
        !delayed.into_iter().any(|part| self.contains(part))
            && !self.contains(Self::VEL | Self::ACC | Self::JERK)
    }
}

/// Additive inputs of a drive (process data).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AdditiveInputs {
    /// Additive velocity (SERCOS S-0-0037).
    pub velocity: bool,
    /// Additive torque or current (SERCOS S-0-0080).
    pub torque: bool,
}

/// Feedforward of one axis. Weights are quotients of the vendor's numerator and denominator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeedforwardConfig {
    /// What is fed forward (P-AXIS-00223), default none.
    pub mode: FeedforwardMode,
    /// Global weight `W` (P-AXIS-00228/00229), default 1; recommended 0.7 to 1; above 1 the axis leads the setpoint.
    ///
    /// Assumption: it weights the sum including jerk, as figure 1 draws it (the parameter text names velocity and
    /// acceleration only).
    pub global_ratio: f64,
    /// Weight of the velocity part `wv` (P-AXIS-00514/00515), default 1.
    pub velocity_ratio: f64,
    /// Weight of the acceleration part (P-AXIS-00225/00226), default 1. Conventional: the drive's time constant `Ta`
    /// in microseconds. Additive: a plain ratio.
    pub acceleration_quotient: f64,
    /// Weight of the jerk part (P-AXIS-00337/00338), default 1/100.
    pub jerk_ratio: f64,
    /// Delay of the additive velocity in s (P-AXIS-00389), below 6 cycles, default 0.
    pub velocity_delay_s: f64,
    /// Delay of the additive torque in s (P-AXIS-00390), below 6 cycles, default 0.
    pub acceleration_delay_s: f64,
    /// Delay of the additive torque of the jerk part in s (P-AXIS-00547), below 6 cycles, default 0.
    pub jerk_delay_s: f64,
    /// On under G137 as well (P-AXIS-00255), default false.
    pub default_active: bool,
    /// Never on (P-AXIS-00256), default false; wins over `default_active`.
    pub global_disable: bool,
    /// One cycle of buffer instead of five (P-AXIS-00566), velocity only, default false.
    pub without_delay: bool,
    /// PROFIdrive: output this many cycles before the setpoint (P-AXIS-00165), 0..=4. The vendor's default of 3 holds
    /// for PROFIdrive drives only, so 0 here.
    pub shift_cycles: usize,
}

impl Default for FeedforwardConfig {
    fn default() -> Self {
        Self {
            mode: FeedforwardMode::empty(),
            global_ratio: 1.0,
            velocity_ratio: 1.0,
            acceleration_quotient: 1.0,
            jerk_ratio: 0.01,
            velocity_delay_s: 0.0,
            acceleration_delay_s: 0.0,
            jerk_delay_s: 0.0,
            default_active: false,
            global_disable: false,
            without_delay: false,
            shift_cycles: 0,
        }
    }
}

/// Delay in cycles of every axis of a channel.
///
/// The PROFIdrive time offset (P-AXIS-00165) delays the position path further.
/// Assumption: the largest offset of the channel delays all its axes, because they have to stay synchronous
/// ([`buffer`](super::buffer)).
pub fn channel_delay_cycles<'a>(axes: impl IntoIterator<Item = &'a FeedforwardConfig>) -> usize {
    axes.into_iter().map(FeedforwardConfig::delay_cycles).max().unwrap_or(0)
}

impl FeedforwardConfig {
    /// Delay limit of the additive values in cycles.
    ///
    /// Source: TF5200 parameter tables (six interpolator cycles); the example text and older builds say one.
    pub const MAX_DELAY_CYCLES: usize = 6;

    /// Gain of this axis in a cycle, for a checked configuration: the weight of G136 (1 = 100 %, limited to 1) while
    /// feedforward is on, otherwise 0.
    pub fn gain(&self, g135: bool, g136_ratio: f64) -> f64 {
        let on = !self.global_disable && (self.default_active || g135) && !self.mode.is_empty();
        if on { g136_ratio.clamp(0.0, 1.0) } else { 0.0 }
    }

    /// Share of the speed that is fed forward, with the same arguments as [`Self::gain`].
    pub fn velocity_share(&self, g135: bool, g136_ratio: f64) -> f64 {
        let is_fed = self.mode.contains(FeedforwardMode::VEL);
        let share = self.gain(g135, g136_ratio) * self.global_ratio * self.velocity_ratio;
        if is_fed { share } else { 0.0 }
    }

    /// Whether a part goes to the additive torque.
    pub fn uses_torque(&self) -> bool {
        [FeedforwardMode::ADD_ACC, FeedforwardMode::ADD_JERK].iter().any(|m| self.mode.contains(*m))
    }

    /// Delay of the position path in cycles that this axis needs.
    pub fn delay_cycles(&self) -> usize {
        match (self.mode.is_empty(), self.without_delay) {
            (true, _) => 0,
            (false, true) => 1 + self.shift_cycles,
            (false, false) => 5 + self.shift_cycles,
        }
    }

    /// The configuration with every documented correction made, and what was corrected.
    ///
    /// 70348, 70349 (delay to 0), 70350, 70351 (that part off), 110624 (velocity only), K-0023.
    pub fn checked(mut self, cycle: CycleTime, inputs: AdditiveInputs) -> (Self, Vec<Issue>) {
        let mut issues = Vec::new();
        let too_long =
            |s: f64| !(0.0..Self::MAX_DELAY_CYCLES as f64 * cycle.seconds()).contains(&s);
        if too_long(self.velocity_delay_s) {
            issues.push(Issue::VelocityDelay { delay_s: self.velocity_delay_s });
            self.velocity_delay_s = 0.0;
        }
        for (delay, jerk) in
            [(&mut self.acceleration_delay_s, false), (&mut self.jerk_delay_s, true)]
        {
            if too_long(*delay) {
                issues.push(Issue::AccelerationDelay { delay_s: *delay, jerk });
                *delay = 0.0;
            }
        }
        let parts = [
            (FeedforwardMode::VEL, FeedforwardMode::ADD_VEL),
            (FeedforwardMode::ACC, FeedforwardMode::ADD_ACC),
            (FeedforwardMode::JERK, FeedforwardMode::ADD_JERK),
        ];
        let mut stray = false;
        for (activation, additive) in parts {
            if !self.mode.contains(activation) {
                stray |= self.mode.intersects(additive - activation);
                self.mode.remove(additive);
            }
        }
        if stray {
            issues.push(Issue::OutputWithoutActivation);
        }
        if self.mode.contains(FeedforwardMode::ADD_VEL) && !inputs.velocity {
            issues.push(Issue::NoAdditiveVelocity);
            self.mode.remove(FeedforwardMode::ADD_VEL);
        }
        if !inputs.torque {
            let before = self.mode;
            for part in [FeedforwardMode::ADD_ACC, FeedforwardMode::ADD_JERK] {
                if self.mode.contains(part) {
                    self.mode.remove(part);
                }
            }
            if self.mode != before {
                issues.push(Issue::NoAdditiveTorque);
            }
        }
        if self.without_delay && self.mode.intersects(FeedforwardMode::ACC | FeedforwardMode::JERK)
        {
            issues.push(Issue::WithoutDelayNeedsVelocityOnly);
            self.mode.remove(FeedforwardMode::ADD_ACC | FeedforwardMode::ADD_JERK);
        }
        if self.default_active && self.global_disable {
            issues.push(Issue::ActiveAndDisabled);
        }
        (self, issues)
    }
}

/// Output of feedforward in one cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FeedforwardOutput {
    /// Speed to add at the controller output in mm/s (conventional variant).
    pub speed_mm_s: f64,
    /// Additive velocity of the drive in mm/s.
    pub additive_speed_mm_s: f64,
    /// Additive torque of the drive, as the acceleration it gives the axis, mm/s2.
    pub additive_acc_mm_s2: f64,
}

/// Feedforward of one axis with the state of its delays.
#[derive(Clone, Debug)]
pub struct Feedforward {
    config: FeedforwardConfig,
    cycle_s: f64,
    velocity: Delay,
    acceleration: Delay,
    jerk: Delay,
    needs_gain: bool,
}

impl Feedforward {
    /// Time in s that converts the jerk factor of the additive variant into a weight.
    ///
    /// Assumption: no document gives the unit of that factor; 1 ms is the time constant that the default factor of the
    /// conventional variant corresponds to at the default Kv.
    const JERK_TIME_S: f64 = 1e-3;

    /// Feedforward with the given configuration; see [`FeedforwardConfig::checked`].
    pub fn new(config: FeedforwardConfig, cycle: CycleTime) -> Self {
        let cycle_s = cycle.seconds();
        Self {
            config,
            cycle_s,
            velocity: Delay::new(config.velocity_delay_s / cycle_s),
            acceleration: Delay::new(config.acceleration_delay_s / cycle_s),
            jerk: Delay::new(config.jerk_delay_s / cycle_s),
            needs_gain: config.mode.needs_gain(),
        }
    }

    /// Axis at rest.
    pub fn start(&mut self) {
        for delay in [&mut self.velocity, &mut self.acceleration, &mut self.jerk] {
            delay.clear();
        }
    }

    /// See [`FeedforwardMode::needs_gain`].
    pub(crate) const fn needs_gain(&self) -> bool {
        self.needs_gain
    }

    /// Output of one cycle; `kv_per_s` is the gain of the position controller in this cycle.
    #[inline] // the window is used where it is made
    pub fn step(&mut self, window: &Window, kv_per_s: f64) -> FeedforwardOutput {
        use FeedforwardMode as M;
        let [pp, p, x, n, nn, nnn] = window.positions_mm;
        let t = self.cycle_s;
        let c = &self.config;
        let mode = c.mode;
        let v_at = |[a, b, d, e]: [f64; 4]| ((a - e) - 8.0 * (b - d)) / (12.0 * t);
        let v = || c.velocity_ratio * ((n - x) / t);
        let a = || c.acceleration_quotient * ((v_at([p, x, nn, nnn]) - v_at([pp, p, n, nn])) / t);
        let j = || {
            if window.jerk_limited {
                c.jerk_ratio * (((nn - n) - 2.0 * (n - x) + (x - p)) / (t * t * t))
            } else {
                0.0
            }
        };
        // a controller without gain has no lag that jerk feedforward could compensate
        let wj = || if kv_per_s > 0.0 { 1e-6 * c.acceleration_quotient / kv_per_s } else { 0.0 };
        let weight = window.gain * c.global_ratio;
        let ta = 1e-6; // the quotient is in microseconds in the conventional variant
        FeedforwardOutput {
            speed_mm_s: part(mode.conventional(M::VEL, M::ADD_VEL), || weight * v())
                + part(mode.conventional(M::ACC, M::ADD_ACC), || weight * (ta * a()))
                + part(mode.conventional(M::JERK, M::ADD_JERK), || weight * (wj() * j())),
            additive_speed_mm_s: self
                .velocity
                .step(part(mode.contains(M::ADD_VEL), || weight * v())),
            additive_acc_mm_s2: self
                .acceleration
                .step(part(mode.contains(M::ADD_ACC), || weight * a()))
                + self
                    .jerk
                    .step(part(mode.contains(M::ADD_JERK), || weight * (Self::JERK_TIME_S * j()))),
        }
    }
}

/// A part of the feedforward, computed only where it is on.
fn part(on: bool, value: impl FnOnce() -> f64) -> f64 {
    if on { value() } else { 0.0 }
}

/// Delay of a signal by less than six cycles; fractions of a cycle are interpolated linearly between neighbours.
#[derive(Clone, Debug)]
struct Delay {
    past: [f64; FeedforwardConfig::MAX_DELAY_CYCLES + 1],
    whole: usize,
    fraction: f64,
}

impl Delay {
    fn new(cycles: f64) -> Self {
        let limit = (FeedforwardConfig::MAX_DELAY_CYCLES - 1) as f64;
        let mut whole = 0;
        while whole < FeedforwardConfig::MAX_DELAY_CYCLES - 1 && (whole + 1) as f64 <= cycles {
            whole += 1;
        }
        let fraction = (cycles.min(limit + 1.0) - whole as f64).max(0.0);
        Self { past: [0.0; FeedforwardConfig::MAX_DELAY_CYCLES + 1], whole, fraction }
    }

    fn clear(&mut self) {
        self.past.fill(0.0);
    }

    fn step(&mut self, x: f64) -> f64 {
        self.past.rotate_right(1);
        self.past[0] = x;
        (1.0 - self.fraction) * self.past[self.whole] + self.fraction * self.past[self.whole + 1]
    }
}

#[cfg(test)]
mod tests;
