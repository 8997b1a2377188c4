//! The probe of measuring runs: it signals at a time or where an axis passes a position, and the path stops.
//!
//! Assumption: the signal of `probe` latches the actual positions of the cycle in which it acts, that of `X_probe_mm`
//! those at which the actual position of the axis passes it, interpolated linearly between two cycles. The path brakes
//! as under feedhold, with P-CHAN-00214 = 1 as in rapid blocks. Measuring type 7 has no probe: its signal is the lag of an axis at a
//! fixed stop (206202891, P-AXIS-00331); the torque limit of the drive is not simulated.

use super::inputs::Inputs;
use super::{Phase, Simulation};
use crate::diag::{Condition, Diagnostic};
use crate::exec::{Feedback, Probed};
use crate::record::AxisRecord;
use kontur_motion::axis::AxisVec;

/// A measuring run.
#[derive(Clone, Debug)]
pub(super) struct Probing {
    /// Whether the path continues through the signal.
    through: bool,
    /// Axes whose lag is the signal, with that lag in mm (deg); if empty, the signal is that of the probe.
    stops: Vec<(usize, f64)>,
    /// Actual positions in the previous cycle.
    before_mm: AxisVec,
    /// Actual positions at the signal.
    signal_mm: Option<AxisVec>,
}

impl Probing {
    /// Whether the path is to stop, or has stopped.
    pub(super) fn holds(&self) -> bool {
        self.signal_mm.is_some() && !self.through
    }

    /// Actual positions at the signal of this cycle, if there is one.
    fn latched(&self, inputs: &Inputs, now_mm: &[f64], lag_mm: &[f64]) -> Option<AxisVec> {
        if !self.stops.is_empty() {
            let at_rest = |(axis, most): &(usize, f64)| {
                lag_mm.get(*axis).is_some_and(|lag| lag.abs() > *most)
            };
            return self.stops.iter().any(at_rest).then(|| AxisVec::from_slice(now_mm));
        }
        signal(inputs, &self.before_mm, now_mm)
    }
}

/// Actual positions where the probe signals between two cycles, if it does.
pub(super) fn signal(inputs: &Inputs, before_mm: &[f64], now_mm: &[f64]) -> Option<AxisVec> {
    if inputs.probe {
        return Some(AxisVec::from_slice(now_mm));
    }
    let passed = |(axis, surface): (usize, Option<f64>)| {
        let (before, now) = (*before_mm.get(axis)?, *now_mm.get(axis)?);
        let surface = surface?;
        let passes = (before < surface && surface <= now) || (now <= surface && surface < before);
        passes.then(|| (surface - before) / (now - before))
    };
    let surfaces = inputs.surfaces_mm.iter().copied().enumerate();
    let share = surfaces.filter_map(passed).min_by(f64::total_cmp)?;
    let between = |(before, now): (&f64, &f64)| before + (now - before) * share;
    Some(before_mm.iter().zip(now_mm).map(between).collect())
}

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
            d.source = self.pending.front().and_then(|p| self.program.locate(p.source));
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
