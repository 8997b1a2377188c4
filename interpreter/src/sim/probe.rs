//! The probe of measuring runs: it signals at a time or where an axis passes a position, and the path stops.
//!
//! Assumption: the signal of `probe` latches the actual positions of the cycle in which it acts, that of `X_probe_mm`
//! those at which the actual position of the axis passes it, interpolated linearly between two cycles. The path brakes
//! as under feedhold, with P-CHAN-00214 = 1 as in rapid blocks. Measuring type 7 has no probe: its signal is the lag of an axis at a
//! fixed stop (206202891, P-AXIS-00331); the torque limit of the drive is not simulated.

use super::state::{Phase, Probing, Simulation};
use crate::diag::{Condition, Diagnostic};
use crate::exec::{Feedback, Probed};
use crate::record::AxisRecord;
use kontur_motion::axis::AxisVec;

impl Simulation {
    /// Makes the next motion a measuring run, before any of it has been executed.
    pub(super) fn begin_probing(&mut self, through: bool, stops: &[usize]) {
        let before_mm = self.actual_mm();
        let limit =
            |axis: &usize| Some((*axis, self.machine.axes.get(*axis)?.fixed_stop_lag_mm()?));
        let stops: Vec<_> = stops.iter().filter_map(limit).collect();
        let probes = stops.is_empty();
        self.probing = Some(Probing { through, stops, before_mm, signal_mm: None });
        if probes && self.inputs.probe {
            let text = "the probe is actuated before the measuring run begins";
            let k = self.planner.setpoint().k;
            let mut d = Diagnostic::new(Condition::ProbeActuated, text);
            (d.cycle, d.time_s) = (Some(k), Some(self.cycle.time_of(k)));
            d.source = self.queue.pending.front().and_then(|p| self.program.locate(p.source));
            self.messages.own.push(d);
            self.totals.aborted = true;
            self.phase = Phase::Done;
        }
    }

    /// The state of the machine that the program needs, once per cycle: many successive steps request it.
    pub(super) fn feedback(&mut self) -> Option<Feedback> {
        let k = self.planner.setpoint().k;
        let measured = self.end_probing();
        if measured.is_none() && self.told == Some(k) {
            return None;
        }
        // a measurement is reported once
        self.told = measured.is_none().then_some(k);
        let (actual_mm, lag_mm) = (self.actual_mm(), self.lag_mm());
        Some(Feedback { actual_mm, lag_mm, time_s: self.cycle.time_of(k), measured })
    }

    /// Actual positions of the path axes.
    pub(super) fn actual_mm(&self) -> AxisVec {
        self.of_path_axes(|axis| axis.act)
    }

    /// Lags of the path axes.
    fn lag_mm(&self) -> AxisVec {
        self.of_path_axes(|axis| axis.lag)
    }

    fn of_path_axes(&self, value: impl Fn(&AxisRecord) -> f64) -> AxisVec {
        let mut values = AxisVec::zeros(self.path_axes());
        for (out, axis) in values.iter_mut().zip(&self.record.axes) {
            *out = value(axis);
        }
        values
    }

    /// Checks for the signal after a cycle; the path brakes from the next one on.
    pub(super) fn watch_probe(&mut self) {
        if self.probing.is_none() || !matches!(self.phase, Phase::Running) {
            return;
        }
        let (now_mm, lag_mm) = (self.actual_mm(), self.lag_mm());
        let Some(probing) = &mut self.probing else { return };
        if probing.signal_mm.is_none() {
            probing.signal_mm = probing.latched(&self.inputs, &now_mm, &lag_mm);
        }
        probing.before_mm = now_mm;
        if probing.holds() {
            self.hold_path();
        }
    }

    /// Drops the rest of the run once the path is where the signal has stopped it.
    pub(super) fn drop_rest_of_run(&mut self) -> bool {
        let stopped = self.probing.as_ref().is_some_and(Probing::holds);
        if stopped {
            self.planner.drop_ahead();
            let s_mm = self.planner.setpoint().s_mm;
            self.progress.cut(s_mm, &self.smoothing.changed);
        }
        stopped
    }

    /// The result of a run when it is over.
    pub(super) fn end_probing(&mut self) -> Option<Box<Probed>> {
        let Probing { signal_mm, .. } = self.probing.take()?;
        self.hold_path();
        let k = self.planner.setpoint().k;
        let position = &self.planner.setpoint().position;
        let rest_mm =
            position.iter().enumerate().map(|(p, x)| x + self.independent.way_mm(p, k)).collect();
        Some(Box::new(Probed { signal_mm, rest_mm }))
    }
}
