//! Faults of a running axis and issues of its configuration: quantity, value and limit.
//!
//! The module does not number conditions and does not define reactions; the numbers in the texts below are those of the
//! vendor's documents.
//!
//! Checking a configuration gives issues, each step may give faults:
//!
//! ```
//! use kontur_filters::control::fault::{Fault, Issue};
//! use kontur_filters::control::monitor::{ExactStopConfig, ExactStopMonitor};
//! use kontur_filters::control::plant::PlantConfig;
//! use kontur_filters::time::CycleTime;
//!
//! let (_, issues) = PlantConfig { dead_time_cycles: 9, ..PlantConfig::default() }.checked();
//! assert_eq!(issues, [Issue::DeadTime { cycles: 9 }]);
//! // an axis that stays 1 mm away from its stop: once, not in every cycle
//! let mut monitor = ExactStopMonitor::new(ExactStopConfig::default(), CycleTime::DEFAULT);
//! monitor.start(0.0);
//! monitor.expect(5.0);
//! let faults: Vec<Fault> = (0..5000).filter_map(|_| monitor.step(5.0, 4.0)).collect();
//! assert!(matches!(faults[..], [Fault::SettlingTimeout { .. }]));
//! ```

/// The derivative of the setpoint that a monitor checks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Derivative {
    /// Velocity in mm/s.
    Velocity,
    /// Acceleration in mm/s2.
    Acceleration,
    /// Jerk in mm/s3.
    Jerk,
}

impl Derivative {
    /// Name in messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
            Self::Jerk => "jerk",
        }
    }
}

/// A condition found while the axis runs. It is raised once when it begins, not in every cycle it lasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// 70020: the following error exceeds the permitted lag.
    FollowingError {
        /// Following error in mm, signed.
        lag_mm: f64,
        /// Permitted magnitude in mm.
        limit_mm: f64,
    },
    /// 70021, 70022: the actual position is beyond a software limit (P-AXIS-00177, P-AXIS-00178) by more than the
    /// tolerance (P-AXIS-00179).
    BeyondLimit {
        /// Actual position in mm.
        actual_mm: f64,
        /// Limit in mm, tolerance included.
        limit_mm: f64,
    },
    /// 70082: the axis did not reach the exact-stop window in time (P-AXIS-00236, P-AXIS-00532).
    SettlingTimeout {
        /// Distance to the target in mm, signed.
        lag_mm: f64,
        /// Half width of the window in mm.
        window_mm: f64,
        /// Permitted time in s.
        time_s: f64,
    },
    /// 70382: speed command of the position controller above the limit (P-AXIS-00407); the limit is output.
    ControllerSpeed {
        /// Speed before limiting in mm/s.
        speed_mm_s: f64,
        /// Limit in mm/s.
        limit_mm_s: f64,
    },
    /// Setpoint above its warning threshold: 50119 for velocity, for acceleration and jerk K-0060.
    SetpointWarning {
        /// Derivative that is monitored.
        what: Derivative,
        /// Magnitude, unit of `what`.
        value: f64,
        /// Threshold, unit of `what`.
        limit: f64,
    },
    /// Setpoint above its error threshold: 50118 for velocity, for acceleration and jerk K-0061.
    SetpointError {
        /// Derivative that is monitored.
        what: Derivative,
        /// Magnitude, unit of `what`.
        value: f64,
        /// Threshold, unit of `what`.
        limit: f64,
    },
    /// 70601: parameters of Improved Position Control changed while the axis moves; the old ones stay.
    IpcChangedMoving,
    /// K-0035: the simulated plant diverged; it is held at its last finite position.
    Unstable {
        /// Following error in mm, the last finite one.
        lag_mm: f64,
        /// Largest following error of a loop that counts as stable, in mm.
        limit_mm: f64,
    },
    /// K-0035: Improved Position Control swings between the limits of its additive speed although nothing drives the axis.
    Swings {
        /// Limit of the additive speed (P-AXIS-00757) in mm/s.
        limit_mm_s: f64,
    },
}

/// The faults one axis raised in one cycle; no allocation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Faults {
    items: [Option<Fault>; Self::CAPACITY],
}

impl Faults {
    /// One slot per source: three setpoint derivatives, controller speed, lag, range, exact stop, Improved Position Control,
    /// divergence.
    const CAPACITY: usize = 9;

    /// Adds a fault. A full list stays as it is; it cannot overflow, since every source raises at most one fault per
    /// cycle.
    #[inline]
    pub(crate) fn push(&mut self, fault: Option<Fault>) {
        if fault.is_some()
            && let Some(free) = self.items.iter_mut().find(|i| i.is_none())
        {
            *free = fault;
        }
    }

    /// The faults in the order they were raised.
    pub fn iter(&self) -> impl Iterator<Item = &Fault> {
        self.items.iter().flatten()
    }

    /// Clears the list.
    #[inline]
    pub(crate) fn clear(&mut self) {
        if !self.is_empty() {
            *self = Self::default();
        }
    }

    /// Whether no fault was raised.
    pub fn is_empty(&self) -> bool {
        self.items[0].is_none()
    }
}

/// An issue found (and corrected) in a configuration before the first cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Issue {
    /// 70349: delay of the velocity feedforward (P-AXIS-00389) of 6 cycles or more; set to 0.
    VelocityDelay {
        /// Value found in s.
        delay_s: f64,
    },
    /// 70348: delay of the acceleration (P-AXIS-00390) or jerk feedforward (P-AXIS-00547) of 6 cycles or more; set
    /// to 0.
    AccelerationDelay {
        /// Value found in s.
        delay_s: f64,
        /// True for the jerk part.
        jerk: bool,
    },
    /// 70350: the drive has no additive velocity input; that part of the feedforward is off.
    NoAdditiveVelocity,
    /// 70351: the drive has no additive torque input; that part of the feedforward is off.
    NoAdditiveTorque,
    /// 110624: feedforward without delay (P-AXIS-00566) together with acceleration or jerk; only velocity is kept.
    WithoutDelayNeedsVelocityOnly,
    /// K-0023: output bits of P-AXIS-00223 without their activation bits; no effect.
    OutputWithoutActivation,
    /// K-0023: `default_active` (P-AXIS-00255) and `global_disable` (P-AXIS-00256) both set; disabled.
    ActiveAndDisabled,
    /// K-0024: torque at the largest acceleration above ten times the reference torque, which suggests a wrong unit of
    /// P-AXIS-00391.
    ImplausibleLoad {
        /// Torque (N m) or force (N) at the largest acceleration.
        torque: f64,
        /// Reference value P-AXIS-00392 in the same unit.
        reference: f64,
    },
    /// 110465: torque scale denominator (P-AXIS-00326) 0: no torque output.
    TorqueScaleDenominatorZero,
    /// K-0062: reference torque (P-AXIS-00392) or torque scale numerator (P-AXIS-00325) not positive: no torque
    /// output.
    NoTorqueScale,
    /// 80044: damping of the simulated drive (P-AXIS-00051/00050) of 1 or more; limited to 0.999.
    SimulationDamping {
        /// Value found.
        damping_ratio: f64,
    },
    /// 110040: dead time of the simulated drive (P-AXIS-00194) above 5 cycles; limited.
    DeadTime {
        /// Value found.
        cycles: u32,
    },
    /// 70600: Improved Position Control enabled in a gantry slave; off there.
    IpcGantrySlave,
    /// 70603: weight numerator (P-AXIS-00754) not positive; off for the axis.
    IpcNumerator {
        /// Stage, from 0.
        stage: usize,
        /// Value found.
        value: f64,
    },
    /// 70604: weight denominator (P-AXIS-00755) not positive; off for the axis.
    IpcDenominator {
        /// Stage, from 0.
        stage: usize,
        /// Value found.
        value: f64,
    },
    /// K-0025: a parameter of a stage is out of range; off for the axis.
    IpcRange {
        /// Stage, from 0.
        stage: usize,
        /// The parameter.
        what: IpcParameter,
        /// Value found.
        value: f64,
    },
    /// K-0066: enabled with the position loop in a drive that takes no additive velocity (P-AXIS-00320); off for the
    /// axis.
    IpcNoInput,
    /// K-0026: enabled, but P-AXIS-00757 limits the output to 0.
    IpcNoLimit,
    /// K-0027: weight above 7.0; limited.
    IpcWeight {
        /// Stage, from 0.
        stage: usize,
        /// Value found.
        weight: f64,
    },
    /// K-0063: the pass bands of two stages overlap; they influence each other.
    IpcOverlap {
        /// Stages, from 0.
        stages: (usize, usize),
    },
}

/// A parameter of a stage of Improved Position Control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IpcParameter {
    /// P-AXIS-00753, 0..=3.
    Mode,
    /// P-AXIS-00750, 1..=3.
    Order,
    /// P-AXIS-00751, above 0, at most 500 Hz and below half the sampling rate.
    Frequency,
    /// P-AXIS-00752, 1..=10.
    Quality,
    /// P-AXIS-00756 or P-AXIS-00850, between 0 and 1, exclusive.
    Damping,
    /// At least one band-pass per stage (P-AXIS-00849).
    BandPass,
}
