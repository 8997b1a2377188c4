//! What a cycle shows: its positions, which most traces consist of, and on request everything else. Calm cycles show them together.

use super::{AxisControl, ControlOutput, DriveValues, Encoder};
use crate::control::{feedforward::FeedforwardOutput, ipc::IpcOutput, plant::Measured};

/// A cycle of a row.
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

/// What receives the cycles of a row, see [`AxisControl::run`]; a closure receives one after the other.
pub trait Show {
    /// Cycle number `i` of the row.
    fn cycle(&mut self, i: usize, cycle: &Shown<'_>);

    /// Consecutive cycles, from number `first` on.
    fn calm(&mut self, first: usize, cycles: &CalmCycles<'_>) {
        for i in 0..cycles.len() {
            self.cycle(first + i, &cycles.get(i));
        }
    }
}

impl<F: FnMut(usize, &Shown<'_>)> Show for F {
    fn cycle(&mut self, i: usize, cycle: &Shown<'_>) {
        self(i, cycle);
    }
}

/// Consecutive cycles of a rigid drive without feedforward and additive speed.
#[derive(Debug)]
pub struct CalmCycles<'a> {
    pub(super) axis: &'a AxisControl,
    pub(super) cycles: &'a [CalmCycle],
    /// Speed of the motor in the cycle before the first one.
    pub(super) before_mm_s: f64,
}

/// What differs from one of these cycles to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct CalmCycle {
    pub(super) reference_mm: f64,
    pub(super) actual_mm: f64,
    pub(super) motor_mm: f64,
    pub(super) motor_mm_s: f64,
    pub(super) command_mm_s: f64,
}

impl CalmCycles<'_> {
    /// Number of cycles.
    pub fn len(&self) -> usize {
        self.cycles.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.cycles.is_empty()
    }

    /// Reference, actual position, position of the load and following error of each cycle in mm, as in [`ControlOutput`].
    pub fn positions_mm(&self) -> impl ExactSizeIterator<Item = [f64; 4]> {
        self.cycles.iter().map(|cycle| {
            let [act_mm, load_mm] =
                self.axis.shown_mm(cycle.actual_mm, cycle.motor_mm, cycle.motor_mm);
            [cycle.reference_mm, act_mm, load_mm, cycle.reference_mm - cycle.actual_mm]
        })
    }

    /// As in [`ControlOutput`], the same in all of them.
    #[inline]
    pub fn settling_s(&self) -> f64 {
        self.axis.exact_stop.settling_s()
    }

    /// One of the cycles.
    pub fn get(&self, i: usize) -> Shown<'_> {
        let cycle = self.cycles[i];
        let before = i.checked_sub(1).map(|i| self.cycles[i].motor_mm_s);
        let seen = Seen {
            reference_mm: cycle.reference_mm,
            actual_mm: cycle.actual_mm,
            measured: Measured::rigid(cycle.motor_mm, cycle.motor_mm_s),
            tcp_before_mm_s: before.unwrap_or(self.before_mm_s),
            feedforward: FeedforwardOutput::default(),
            command_mm_s: cycle.command_mm_s,
            additive: IpcOutput::default(),
            faulty: false,
        };
        Shown::of(self.axis, &seen)
    }
}

impl AxisControl {
    /// Position of the motor encoder and of the load, where the position loop sees one of them as `actual_mm`.
    #[inline]
    fn shown_mm(&self, actual_mm: f64, motor_mm: f64, load_mm: f64) -> [f64; 2] {
        match self.config.encoder {
            Encoder::Motor => [actual_mm, load_mm],
            Encoder::Direct => [motor_mm, actual_mm],
        }
    }
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
    pub(super) fn of(axis: &'a AxisControl, seen: &Seen) -> Self {
        let Seen { reference_mm, actual_mm, measured, .. } = *seen;
        let [act_mm, load_mm] = axis.shown_mm(actual_mm, measured.motor_mm, measured.load_mm);
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
