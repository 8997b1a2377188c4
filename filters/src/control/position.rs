//! The position controller: proportional, with a gain that may depend on speed, a dead band and a speed limit.
//!
//! Source: TF5200 axis parameters, P-AXIS-00099, 00245 to 00248, 00320, 00395, 00407.
//!
//! Order of calls, once per cycle: the gain at the present speed, the command from the following error, then the
//! limiter.
//!
//! ```
//! use kontur_filters::control::position::{DynamicKv, PositionConfig, SpeedLimiter};
//!
//! let dynamic_kv = Some(DynamicKv { v1_mm_s: 10.0, kv1_per_s: 20.0, v2_mm_s: 30.0, kv2_per_s: 40.0 });
//! let config = PositionConfig { dynamic_kv, v_max_mm_s: 100.0, ..PositionConfig::default() };
//! // gain, then the command of the following error, then its limit: v_max and its excess
//! let kv_per_s = config.gain_at(20.0);
//! let command_mm_s = kv_per_s * config.error_mm(10.0, false);
//! let (limited_mm_s, fault) = SpeedLimiter::new(&config).step(command_mm_s);
//! assert_eq!((kv_per_s, command_mm_s, limited_mm_s), (30.0, 300.0, 200.0));
//! assert!(fault.is_some());
//! ```

use super::fault::Fault;

/// Gain that depends on the axis speed (P-AXIS-00245 to 00248): linear between two points, constant outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DynamicKv {
    /// Lower speed in mm/s (P-AXIS-00246).
    pub v1_mm_s: f64,
    /// Gain in 1/s at and below it (P-AXIS-00245).
    pub kv1_per_s: f64,
    /// Upper speed in mm/s, above the lower one (P-AXIS-00248).
    pub v2_mm_s: f64,
    /// Gain in 1/s at and above it (P-AXIS-00247).
    pub kv2_per_s: f64,
}

/// Where the position loop is closed (P-AXIS-00320).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PositionLoop {
    /// In the control (default).
    #[default]
    Cnc,
    /// In the drive, which receives set positions.
    ///
    /// Assumption: the drive applies the same proportional law with the gain of the list (a SERCOS drive with
    /// feedforward from the control needs that gain in S-0-0104 anyway). Functions that act on the output of the
    /// control's own controller have no effect: dead band, speed limit.
    Drive,
}

/// Position controller of one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionConfig {
    /// Gain in 1/s (P-AXIS-00099 x 0.01), default 10.
    pub kv_per_s: f64,
    /// Speed-dependent gain instead of the constant one.
    pub dynamic_kv: Option<DynamicKv>,
    /// Largest speed of the axis in mm/s (P-AXIS-00212), default 200.
    pub v_max_mm_s: f64,
    /// Excess over `v_max_mm_s` that the command may reach, 1 = 100 % (P-AXIS-00407 / 1000), default 1; 0 switches the
    /// limit off.
    pub v_excess_ratio: f64,
    /// Following error in mm below which an axis at rest gets no command (P-AXIS-00395), default 0: always a command.
    /// At most the exact-stop window (110528, corrected by the list reader).
    pub dead_band_mm: f64,
    /// Where the loop is closed (P-AXIS-00320), by default in the control.
    pub closed_in: PositionLoop,
}

impl Default for PositionConfig {
    fn default() -> Self {
        Self {
            kv_per_s: 10.0,
            dynamic_kv: None,
            v_max_mm_s: 200.0,
            v_excess_ratio: 1.0,
            dead_band_mm: 0.0,
            closed_in: PositionLoop::Cnc,
        }
    }
}

impl PositionConfig {
    /// Gain in 1/s at an axis speed in mm/s.
    ///
    /// Assumption: the gain follows the commanded speed, so that a vibrating actual value does not modulate it.
    #[inline]
    pub fn gain_at(&self, speed_mm_s: f64) -> f64 {
        let Some(d) = self.dynamic_kv else { return self.kv_per_s };
        let share = (speed_mm_s.abs() - d.v1_mm_s) / (d.v2_mm_s - d.v1_mm_s);
        // points of equal speed give no quotient: use the upper gain
        let share = if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) };
        d.kv1_per_s + share * (d.kv2_per_s - d.kv1_per_s)
    }

    /// Smallest gain in 1/s at any speed.
    pub(crate) fn lowest_gain(&self) -> f64 {
        self.dynamic_kv.map_or(self.kv_per_s, |d| d.kv1_per_s.min(d.kv2_per_s))
    }

    /// The following error that the controller acts on: 0 inside the dead band while the reference rests.
    ///
    /// Source: P-AXIS-00395 suppresses small commands at standstill; effective only with position control in the CNC.
    #[inline]
    pub fn error_mm(&self, lag_mm: f64, reference_rests: bool) -> f64 {
        let quiet = lag_mm.abs() < self.suppressed_mm() && reference_rests;
        if quiet { 0.0 } else { lag_mm }
    }

    /// Following error in mm below which an axis whose reference rests gets no command; 0 if it always gets one.
    pub(crate) fn suppressed_mm(&self) -> f64 {
        if self.closed_in == PositionLoop::Cnc { self.dead_band_mm } else { 0.0 }
    }

    /// Limit of the speed command in mm/s; `None` without one, as with a drive that closes the loop and limits its own
    /// command.
    pub(crate) fn speed_limit_mm_s(&self) -> Option<f64> {
        let limited = self.v_excess_ratio > 0.0 && self.closed_in == PositionLoop::Cnc;
        limited.then_some(self.v_max_mm_s * (1.0 + self.v_excess_ratio))
    }
}

/// Speed limit of the controller: limits the command and raises 70382 when an excess begins.
#[derive(Clone, Copy, Debug)]
pub struct SpeedLimiter {
    limit_mm_s: Option<f64>,
    active: bool,
}

impl SpeedLimiter {
    /// A limiter with the given configuration.
    pub fn new(config: &PositionConfig) -> Self {
        Self { limit_mm_s: config.speed_limit_mm_s(), active: false }
    }

    /// Whether the command is at the limit.
    pub(crate) const fn is_active(&self) -> bool {
        self.active
    }

    /// Speed in mm/s up to which a command is passed on as it is.
    pub(crate) fn lets_by_mm_s(&self) -> f64 {
        self.limit_mm_s.unwrap_or(f64::INFINITY)
    }

    /// The limited command in mm/s, and a fault if an excess begins.
    #[inline]
    pub fn step(&mut self, speed_mm_s: f64) -> (f64, Option<Fault>) {
        let Some(limit_mm_s) = self.limit_mm_s.filter(|l| speed_mm_s.abs() > *l) else {
            self.active = false;
            return (speed_mm_s, None);
        };
        let begins = !std::mem::replace(&mut self.active, true);
        let fault = begins.then_some(Fault::ControllerSpeed { speed_mm_s, limit_mm_s });
        (limit_mm_s.copysign(speed_mm_s), fault)
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::float_cmp, reason = "exact values are what is tested")]

    use super::*;

    #[test]
    fn dynamic_gain_is_linear_between_its_points() {
        let d = DynamicKv { v1_mm_s: 10.0, kv1_per_s: 20.0, v2_mm_s: 110.0, kv2_per_s: 70.0 };
        let config = PositionConfig { dynamic_kv: Some(d), ..PositionConfig::default() };
        for (speed, kv) in
            [(0.0, 20.0), (10.0, 20.0), (60.0, 45.0), (-60.0, 45.0), (110.0, 70.0), (1e6, 70.0)]
        {
            assert_eq!(config.gain_at(speed), kv, "at {speed} mm/s");
        }
        assert_eq!(PositionConfig::default().gain_at(1e3), 10.0);
    }

    #[test]
    fn speed_above_twice_the_maximum_is_limited_and_reported_once() {
        let mut limiter = SpeedLimiter::new(&PositionConfig::default());
        assert_eq!(limiter.step(400.0), (400.0, None));
        let (out, fault) = limiter.step(-500.0);
        let fault = fault.unwrap();
        assert_eq!(out, -400.0);
        assert!(matches!(fault, Fault::ControllerSpeed { .. }));
        assert_eq!(limiter.step(-600.0), (-400.0, None));
        assert_eq!(limiter.step(0.0), (0.0, None));
        assert!(limiter.step(401.0).1.is_some());
        let off = PositionConfig { v_excess_ratio: 0.0, ..PositionConfig::default() };
        assert_eq!(SpeedLimiter::new(&off).step(1e9), (1e9, None));
        let in_drive =
            PositionConfig { closed_in: PositionLoop::Drive, ..PositionConfig::default() };
        assert_eq!(SpeedLimiter::new(&in_drive).step(1e9), (1e9, None));
    }

    #[test]
    fn dead_band_acts_at_rest_and_in_the_cnc_only() {
        let config = PositionConfig { dead_band_mm: 0.01, ..PositionConfig::default() };
        for (lag, rests, error) in [
            (0.0099, true, 0.0),
            (-0.0099, true, 0.0),
            (0.01, true, 0.01),
            (-0.02, true, -0.02),
            (0.0099, false, 0.0099),
        ] {
            assert_eq!(config.error_mm(lag, rests), error, "{lag} {rests}");
        }
        let drive = PositionConfig { closed_in: PositionLoop::Drive, ..config };
        assert_eq!(drive.error_mm(0.005, true), 0.005);
        assert_eq!(PositionConfig::default().error_mm(1e-12, true), 1e-12, "off by default");
    }
}
