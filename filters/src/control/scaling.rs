//! Values in the drive's format: speed counts, torque counts, encoder resolution.
//!
//! Source: TF5200 feedforward control 4 and 5; Improved Position Control 4.2.
//!
//! Order of calls: make the formats from the list once, then convert each value.
//!
//! ```
//! use kontur_filters::control::scaling::{Motor, SpeedFormat, TorqueFormat, encoder_resolution};
//!
//! // 2000 counts for 1 m/min: 6 m/min are 12000
//! let counts = SpeedFormat::default().counts_per_mm_s(1e-3) * 100.0;
//! assert!((counts - 12000.0).abs() < 1e-9);
//! // 0.01 kg m2 at 10 mm per revolution: 1 m/s2 are 200 pi rad/s2
//! let motor = Motor::Rotary { feed_mm: 10.0, gear_ratio: 1.0 };
//! let torque = TorqueFormat { motor, load: 0.01, ..TorqueFormat::default() }.torque(1000.0);
//! assert!((torque - 2.0 * std::f64::consts::PI).abs() < 1e-9);
//! // 100,000 increments for 10 mm: one for each 0.1 um
//! assert_eq!(encoder_resolution(100_000.0, 10.0, 1.0), 1.0);
//! ```

use super::fault::Issue;
use std::f64::consts::TAU;

/// Time base of a speed value (P-AXIS-00207).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TimeBase {
    /// 0: per minute (default).
    #[default]
    Minute,
    /// 1: per second.
    Second,
    /// 2: per sampling interval.
    Cycle,
}

/// Format of speed values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpeedFormat {
    /// Digital value for 1 m/min or 1000 deg/min (P-AXIS-00129/00128, default 2000): conventional and simulated drives.
    Gain(f64),
    /// Increments per path (P-AXIS-00206/00205, default 1/36): `increments` are output for `path_um` um (or 0.001
    /// degrees) per time base.
    Resolution {
        /// Increments output (P-AXIS-00206).
        increments: f64,
        /// Path in um or 0.001 degrees (P-AXIS-00205).
        path_um: f64,
        /// Time base (P-AXIS-00207).
        time_base: TimeBase,
    },
}

impl Default for SpeedFormat {
    fn default() -> Self {
        Self::Gain(2000.0)
    }
}

impl SpeedFormat {
    /// The speed in mm/s that a drive derives from the value sent to it: bus drives receive whole counts, analogue and
    /// simulated drives any value.
    #[inline]
    pub fn sent(&self, speed_mm_s: f64, cycle_s: f64) -> f64 {
        match self {
            Self::Gain(_) => speed_mm_s,
            Self::Resolution { .. } => {
                let scale = self.counts_per_mm_s(cycle_s);
                if scale.abs() > 0.0 { libm::round(speed_mm_s * scale) / scale } else { 0.0 }
            }
        }
    }

    /// Counts for 1 mm/s (1 deg/s).
    pub fn counts_per_mm_s(&self, cycle_s: f64) -> f64 {
        match *self {
            // 1 m/min = 1000/60 mm/s
            Self::Gain(value) => value * 60.0 / 1000.0,
            Self::Resolution { increments, path_um, time_base } => {
                let base_s = match time_base {
                    TimeBase::Minute => 60.0,
                    TimeBase::Second => 1.0,
                    TimeBase::Cycle => cycle_s,
                };
                1000.0 * base_s * increments / path_um
            }
        }
    }
}

/// Rotary or linear motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motor {
    /// Torque in N m at the motor shaft (P-AXIS-00362/00363 or 00511/00512 given).
    Rotary {
        /// Travel per revolution of the gear output in mm (P-AXIS-00362/00363 x 1e-4).
        feed_mm: f64,
        /// Gear input revolutions per output revolution (P-AXIS-00511/00512).
        gear_ratio: f64,
    },
    /// Force in N.
    Linear,
}

/// Torque values: `M = J alpha`, `F = m a` and their scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueFormat {
    /// Kind of motor.
    pub motor: Motor,
    /// Total inertia at the motor shaft in kg m2, or moved mass in kg, as configured in the control (P-AXIS-00391),
    /// default 1e-6.
    pub load: f64,
    /// Actual inertia or mass in the same unit; `None`: as configured.
    pub real_load: Option<f64>,
    /// Stall torque in N m or force in N (P-AXIS-00392), default 1.
    pub reference: f64,
    /// Value that is output for the stall torque: numerator (P-AXIS-00325), default 1.
    pub scale_num: f64,
    /// Its denominator (P-AXIS-00326), default 1; 0 switches the output off with 110465.
    pub scale_denom: f64,
}

impl Default for TorqueFormat {
    fn default() -> Self {
        Self {
            motor: Motor::Linear,
            load: 1e-6,
            real_load: None,
            reference: 1.0,
            scale_num: 1.0,
            scale_denom: 1.0,
        }
    }
}

impl TorqueFormat {
    /// Torque in N m (force in N) for an axis acceleration.
    pub fn torque(&self, acc_mm_s2: f64) -> f64 {
        self.load * (acc_mm_s2 * self.motor_side())
    }

    /// Acceleration of the motor in rad/s2 (m/s2) for 1 mm/s2 of the axis.
    fn motor_side(&self) -> f64 {
        match self.motor {
            // revolutions per mm of travel, one revolution is 2 pi
            Motor::Rotary { feed_mm, gear_ratio } => gear_ratio * TAU / feed_mm,
            Motor::Linear => 1e-3,
        }
    }

    /// Acceleration in mm/s2 that a torque gives the axis: the drive receives whole counts, converts them by the scale
    /// of the list, and its torque acts on the actual inertia.
    pub fn acceleration(&self, torque: f64) -> f64 {
        let load = self.real_load.unwrap_or(self.load);
        let counts = libm::round(self.counts(torque));
        if counts.abs() > 0.0 && load > 0.0 {
            counts * self.reference * self.scale_denom / self.scale_num / load / self.motor_side()
        } else {
            0.0
        }
    }

    /// Counts for a torque; 0 if the scale is not defined.
    pub fn counts(&self, torque: f64) -> f64 {
        if self.defined() {
            torque / self.reference * self.scale_num / self.scale_denom
        } else {
            0.0
        }
    }

    fn defined(&self) -> bool {
        self.scale_denom > 0.0 && self.reference > 0.0 && self.scale_num > 0.0
    }

    /// 110465 or K-0062 (no torque output), K-0024 (torque at the largest acceleration above ten times the reference).
    pub fn check(&self, a_max_mm_s2: f64) -> Vec<Issue> {
        let torque = self.torque(a_max_mm_s2).abs();
        let mut issues = Vec::new();
        let denominator = self.scale_denom > 0.0;
        if !denominator {
            issues.push(Issue::TorqueScaleDenominatorZero);
        } else if !self.defined() {
            issues.push(Issue::NoTorqueScale);
        } else if torque > 10.0 * self.reference {
            issues.push(Issue::ImplausibleLoad { torque, reference: self.reference });
        }
        issues
    }
}

/// Smallest step in mm of a measuring system with `resolution` increments per 0.1 um (0.0001 deg) whose lowest
/// `dropped_bits` (P-AXIS-00405) are dropped; 0 for a resolution that is not above 0.
pub fn increment_mm(resolution: f64, dropped_bits: u32) -> f64 {
    if resolution > 0.0 {
        1e-4 / resolution * f64::from(1_u32 << dropped_bits.min(20))
    } else {
        0.0
    }
}

/// Encoder resolution in increments per 0.1 um: `R = increments i / f`.
///
/// `increments_per_rev` per motor revolution (P-AXIS-00092), `feed_mm` per revolution of the gear output, `gear_ratio`
/// input over output revolutions. Source: P-AXIS-00362.
pub fn encoder_resolution(increments_per_rev: f64, feed_mm: f64, gear_ratio: f64) -> f64 {
    increments_per_rev * gear_ratio / (feed_mm * 1e4)
}

#[cfg(test)]
mod tests {
    use super::*;

    const T: f64 = 1e-3;

    fn counts(format: SpeedFormat, speed_mm_s: f64) -> f64 {
        format.counts_per_mm_s(T) * speed_mm_s
    }

    fn per_minute(increments: f64, path_um: f64) -> SpeedFormat {
        SpeedFormat::Resolution { increments, path_um, time_base: TimeBase::Minute }
    }

    /// Pitch 10 mm, drive unit 1e-4 rpm, without and with a gear of 3.
    /// Conformance: F052, F053, I048, I049.
    #[test]
    fn speed_examples_of_the_manual() {
        assert!((counts(SpeedFormat::default(), 100.0) - 12_000.0).abs() < 1e-9, "6 m/min");
        assert!((counts(per_minute(10_000.0, 10_000.0), 100.0) - 6_000_000.0).abs() < 1e-6);
        let rounded = counts(per_minute(10_000.0, 3_333.0), 100.0);
        assert!((rounded - 18_001_800.0).abs() < 0.5, "{rounded}");
        assert!(
            (counts(per_minute(30_000.0, 10_000.0), 100.0) - 18_000_000.0).abs() < 1e-6,
            "exact"
        );
    }

    /// Conformance: I049.
    #[test]
    fn time_bases() {
        let with = |time_base| SpeedFormat::Resolution { increments: 5.0, path_um: 1.0, time_base };
        assert!((counts(with(TimeBase::Second), 1.0) - 5_000.0).abs() < 1e-9);
        assert!((counts(with(TimeBase::Cycle), 1.0) - 5.0).abs() < 1e-12);
        assert!((counts(with(TimeBase::Minute), 1.0) - 300_000.0).abs() < 1e-9);
    }

    fn example() -> TorqueFormat {
        TorqueFormat {
            motor: Motor::Rotary { feed_mm: 5.0, gear_ratio: 3.0 },
            load: 0.48e-4,
            real_load: None,
            reference: 0.45,
            scale_num: 500.0,
            scale_denom: 1.0,
        }
    }

    /// Conformance: F059, F060, F064, F066.
    #[test]
    fn torque_example_of_the_manual() {
        let format = example();
        let torque = format.torque(1000.0);
        assert!((torque - 0.18096).abs() < 5e-6, "{torque}");
        assert!((format.counts(torque) - 201.06).abs() < 5e-3);
        assert!((format.counts(torque) * 1.2 - 241.27).abs() < 5e-3, "weight 12/10");
        assert!((encoder_resolution(1_048_576.0, 5.0, 3.0) - 62.91).abs() < 5e-3);
        let linear = TorqueFormat { motor: Motor::Linear, load: 200.0, ..example() };
        assert!((linear.torque(1000.0) - 200.0).abs() < 1e-12, "F = m a");
    }

    /// 10 increments per 0.1 um: 10 nm; four bits less: 160 nm.
    #[test]
    fn increments() {
        for (resolution, bits, want_mm) in [(10.0, 0, 1e-5), (10.0, 4, 1.6e-4), (0.5, 0, 2e-4)] {
            assert!(
                (increment_mm(resolution, bits) - want_mm).abs() < 1e-18,
                "{resolution} {bits}"
            );
        }
        assert_eq!(increment_mm(0.0, 0).to_bits(), 0);
    }

    /// 201.06 counts are sent as 201; the axis gets the acceleration of that torque on its real inertia.
    #[test]
    fn the_drive_gives_what_it_was_sent() {
        let sent = |f: TorqueFormat| f.acceleration(f.torque(1000.0));
        assert!((sent(example()) - 1000.0 * 201.0 / 201.0619).abs() < 1e-2);
        let heavy = TorqueFormat { real_load: Some(0.96e-4), ..example() };
        assert!((sent(heavy) - 0.5 * sent(example())).abs() < 1e-9);
        for none in [
            TorqueFormat { load: 0.0, ..example() },
            TorqueFormat { real_load: Some(0.0), ..example() },
            TorqueFormat { scale_denom: 0.0, ..example() },
            TorqueFormat { load: 1e-8, ..example() },
        ] {
            assert_eq!(sent(none).to_bits(), 0.0_f64.to_bits(), "{none:?}");
        }
        // 5 counts for 1 mm/s: whole counts; an analogue value is not rounded
        let format =
            SpeedFormat::Resolution { increments: 5.0, path_um: 1.0, time_base: TimeBase::Cycle };
        assert!((format.sent(1.13, T) - 1.2).abs() < 1e-12);
        assert!((SpeedFormat::default().sent(1.13, T) - 1.13).abs() < 1e-15);
    }

    /// Conformance: F063, F080, F086.
    #[test]
    fn undefined_scales_give_no_output() {
        let found = |f: TorqueFormat| f.check(1000.0);
        assert!(found(example()).is_empty());
        let zero = TorqueFormat { scale_denom: 0.0, ..example() };
        assert_eq!((found(zero), zero.counts(1.0)), (vec![Issue::TorqueScaleDenominatorZero], 0.0));
        let zero = TorqueFormat { reference: 0.0, ..example() };
        assert_eq!((found(zero), zero.counts(1.0)), (vec![Issue::NoTorqueScale], 0.0));
        // the printed load of 0.48 kg m2 must mean kg cm2
        let heavy = found(TorqueFormat { load: 0.48, ..example() });
        assert!(matches!(heavy[..], [Issue::ImplausibleLoad { .. }]));
    }
}
