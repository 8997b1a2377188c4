//! Configuration of one axis downstream of its set position, with the vendor's defaults and documented corrections.

use crate::control::{
    fault::Issue,
    feedforward::{AdditiveInputs, FeedforwardConfig},
    ipc::IpcConfig,
    monitor::{ExactStopConfig, LagMonitorConfig, SetpointMonitorConfig},
    plant::PlantConfig,
    position::{PositionConfig, PositionLoop},
    scaling::{SpeedFormat, TorqueFormat},
};
use crate::time::CycleTime;

/// Measuring system that closes the position loop.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoder {
    /// Motor encoder (default).
    #[default]
    Motor,
    /// Direct measuring system at the load (`lr_hw[1]`).
    ///
    /// Assumption: an axis that has a direct measuring system is controlled by it.
    Direct,
}

/// Configuration of everything downstream of the set position of one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisControlConfig {
    /// Feedforward.
    pub feedforward: FeedforwardConfig,
    /// Additive inputs of the drive.
    pub additive_inputs: AdditiveInputs,
    /// Delay of the position path in cycles, the same for every axis of a channel
    /// ([`channel_delay_cycles`](crate::control::feedforward::channel_delay_cycles)), never less than the feedforward
    /// of this axis needs.
    pub delay_cycles: usize,
    /// Position controller.
    pub position: PositionConfig,
    /// Measuring system of the position loop.
    pub encoder: Encoder,
    /// Smallest step of that measuring system in mm ([`increment_mm`](crate::control::scaling::increment_mm)); 0:
    /// continuous.
    pub increment_mm: f64,
    /// Improved Position Control.
    pub ipc: IpcConfig,
    /// Drive and mechanics.
    pub plant: PlantConfig,
    /// Following-error monitoring.
    pub lag: LagMonitorConfig,
    /// Exact stop.
    pub exact_stop: ExactStopConfig,
    /// Monitoring of the set positions.
    pub setpoint: SetpointMonitorConfig,
    /// Permitted range of the actual positions in mm, tolerance included; `None`: not monitored.
    pub range_mm: Option<(f64, f64)>,
    /// Format of the speed command, and of the additive speed of Improved Position Control.
    pub command_format: SpeedFormat,
    /// Format of the velocity feedforward.
    pub feedforward_format: SpeedFormat,
    /// Format of the additive torque.
    pub torque: TorqueFormat,
}

impl AxisControlConfig {
    /// The vendor's defaults for an axis with the given limits of velocity, acceleration and jerk.
    pub fn new(v_max_mm_s: f64, a_max_mm_s2: f64, j_max_mm_s3: f64) -> Self {
        Self {
            feedforward: FeedforwardConfig::default(),
            additive_inputs: AdditiveInputs { velocity: false, torque: false },
            delay_cycles: 0,
            position: PositionConfig { v_max_mm_s, ..PositionConfig::default() },
            encoder: Encoder::Motor,
            increment_mm: 0.0,
            ipc: IpcConfig::default(),
            plant: PlantConfig::default(),
            lag: LagMonitorConfig::default(),
            exact_stop: ExactStopConfig::default(),
            setpoint: SetpointMonitorConfig::new(v_max_mm_s, a_max_mm_s2, j_max_mm_s3),
            range_mm: None,
            command_format: SpeedFormat::default(),
            feedforward_format: SpeedFormat::default(),
            torque: TorqueFormat::default(),
        }
    }

    /// The configuration with every documented correction made, and the issues found.
    pub fn checked(mut self, cycle: CycleTime) -> (Self, Vec<Issue>) {
        let (feedforward, mut issues) = self.feedforward.checked(cycle, self.additive_inputs);
        self.feedforward = feedforward;
        let (plant, found) = self.plant.checked();
        self.plant = plant;
        issues.extend(found);
        self.exact_stop.window_mm = self
            .exact_stop
            .window_mm
            .max(ExactStopConfig::HALF_INCREMENT_MM)
            .max(0.5 * self.increment_mm);
        issues.extend(self.ipc.check(cycle));
        let in_drive = self.position.closed_in == PositionLoop::Drive;
        if self.ipc.enable && in_drive && !self.additive_inputs.velocity {
            issues.push(Issue::IpcNoInput);
            self.ipc.enable = false;
        }
        if self.feedforward.uses_torque() {
            issues.extend(self.torque.check(self.setpoint.a_max_mm_s2));
        }
        (self, issues)
    }
}
