//! What a cycle shows: its positions, which most traces consist of, and on request everything else.

use super::{AxisControl, ControlOutput, DriveValues, Encoder};
use crate::control::{feedforward::FeedforwardOutput, ipc::IpcOutput, plant::Measured};

/// A cycle of a row, see [`AxisControl::run`].
#[derive(Debug)]
pub struct Shown<'a> {
    /// As in [`ControlOutput`].
    pub reference_mm: f64,
    /// As in [`ControlOutput`].
    pub act_mm: f64,
    /// As in [`ControlOutput`].
    pub load_mm: f64,
    /// As in [`ControlOutput`].
    pub lag_mm: f64,
    /// As in [`ControlOutput`].
    pub faulty: bool,
    axis: &'a AxisControl,
    tcp_mm: f64,
    tcp_mm_s: f64,
    tcp_before_mm_s: f64,
    feedforward: FeedforwardOutput,
    command_mm_s: f64,
    additive: IpcOutput,
}

/// The values of a cycle.
pub(super) struct Seen {
    pub(super) reference_mm: f64,
    pub(super) actual_mm: f64,
    pub(super) measured: Measured,
    /// Speed of the tool point in the cycle before.
    pub(super) tcp_before_mm_s: f64,
    pub(super) feedforward: FeedforwardOutput,
    pub(super) command_mm_s: f64,
    pub(super) additive: IpcOutput,
    pub(super) faulty: bool,
}

impl<'a> Shown<'a> {
    #[inline]
    pub(super) fn of(axis: &'a AxisControl, seen: Seen) -> Self {
        let Seen { reference_mm, actual_mm, measured, .. } = seen;
        let (act_mm, load_mm) = match axis.config.encoder {
            Encoder::Motor => (actual_mm, measured.load_mm),
            Encoder::Direct => (measured.motor_mm, actual_mm),
        };
        Self {
            reference_mm,
            act_mm,
            load_mm,
            lag_mm: reference_mm - actual_mm,
            faulty: seen.faulty,
            axis,
            tcp_mm: measured.tcp_mm,
            tcp_mm_s: measured.tcp_mm_s,
            tcp_before_mm_s: seen.tcp_before_mm_s,
            feedforward: seen.feedforward,
            command_mm_s: seen.command_mm_s,
            additive: seen.additive,
        }
    }

    /// As in [`ControlOutput`].
    #[inline]
    pub fn settling_s(&self) -> f64 {
        self.axis.exact_stop.settling_s()
    }

    /// Everything.
    #[inline] // large: used where it is made
    pub fn output(&self) -> ControlOutput {
        let additive_mm_s = self.additive.speed_mm_s;
        ControlOutput {
            reference_mm: self.reference_mm,
            act_mm: self.act_mm,
            load_mm: self.load_mm,
            lag_mm: self.lag_mm,
            lag_limit_mm: self.axis.lag.limit_mm(),
            settling_s: self.settling_s(),
            feedforward: self.feedforward,
            command_mm_s: self.command_mm_s,
            additive_speed_mm_s: additive_mm_s,
            additive_speed_limited: self.additive.limited,
            tcp_mm: self.tcp_mm,
            tcp_acc_mm_s2: (self.tcp_mm_s - self.tcp_before_mm_s) / self.axis.cycle_s,
            drive: self.drive_values(),
            faulty: self.faulty,
        }
    }

    fn drive_values(&self) -> DriveValues {
        let (command_scale, feedforward_scale) = self.axis.counts_per_mm_s;
        let ff = &self.feedforward;
        let mut values = DriveValues {
            command: self.command_mm_s * command_scale,
            feedforward: (ff.speed_mm_s + ff.additive_speed_mm_s) * feedforward_scale,
            additive_speed: self.additive.speed_mm_s * command_scale,
            ..DriveValues::default()
        };
        if ff.additive_acc_mm_s2.abs() > 0.0 {
            let torque = &self.axis.config.torque;
            values.torque_n_m = torque.torque(ff.additive_acc_mm_s2);
            values.torque = torque.counts(values.torque_n_m);
        }
        values
    }
}
