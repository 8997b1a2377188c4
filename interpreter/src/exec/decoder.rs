//! State of a program and the execution of one block.
//!
//! The decoder handles single blocks, not files: the executor determines the next block.

use super::block::dialect::Seen;
use super::block::modal::Modal;
use super::contour::Contour;
use super::fault::Fault;
use super::geometry::Geometry;
use super::live::Live;
use super::motion::state::{MotionState, Straight};
use super::names::AxisNames;
use super::options::Options;
use super::program::state::Calls;
use super::report::Report;
use super::shaping::{ShapingState, Worked};
use super::step::Sync;
use super::values::Values;
use crate::diag::{Condition, Diagnostic};
use crate::machine::{Axis, Machine};
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::SpareBlocks;
use std::sync::Arc;

/// A signal that was sent.
#[derive(Debug)]
pub(super) struct Signal {
    pub(super) id: u32,
    /// Whether it was sent to all channels; otherwise to this channel.
    pub(super) broadcast: bool,
    /// Number of waits that it can still satisfy, `None`: unlimited.
    pub(super) count: Option<u32>,
    pub(super) parameters: Vec<(u32, f64)>,
}

/// State of a running program: the state owned by each module, and the state that all of them read.
#[derive(Debug)]
pub(super) struct Decoder {
    pub(super) machine: Arc<Machine>,
    pub(super) identity_trafo: bool,
    pub(super) live: Live,
    pub(super) names: AxisNames,
    pub(super) report: Report,
    pub(super) modal: Modal,
    pub(super) dialect: Seen,
    pub(super) values: Values,
    pub(super) geometry: Geometry,
    pub(super) contour: Contour,
    pub(super) motion: MotionState,
    pub(super) shaping: ShapingState,
    pub(super) calls: Calls,
    /// Signals that have not been consumed.
    pub(super) signals: Vec<Signal>,
    /// Syntax check: blocks with errors are executed as far as possible.
    pub(super) checking: bool,
    /// Whether a motion of the current block was output.
    pub(super) moved: bool,
    /// State shared by consecutive plain motions.
    pub(super) straight: Option<Box<Straight>>,
    /// Memory of blocks that have been run.
    pub(super) spare: SpareBlocks,
}

impl Decoder {
    /// The state at the start of a program.
    pub(super) fn new(machine: Arc<Machine>, options: Options, start: &AxisVec) -> Self {
        let forced = options.guard.is_some();
        let mut decoder = Self {
            identity_trafo: options.identity_trafo,
            live: Live::default(),
            spare: SpareBlocks::default(),
            names: AxisNames::new(&machine.axes),
            report: Report::default(),
            modal: Modal::start(
                machine.channel.dynamics.slope,
                machine.channel.dynamics.constant_ramp_time,
            ),
            dialect: Seen::default(),
            values: Values::new(&machine.external),
            geometry: Geometry::new(&machine, start),
            contour: Contour::start(machine.channel.spline),
            motion: MotionState::new(&machine, options.techno_times),
            shaping: ShapingState::new(options.guard),
            calls: Calls::new(&machine.channel),
            signals: Vec::new(),
            checking: false,
            moved: false,
            straight: None,
            machine,
        };
        let unknown = decoder.modal.presets(&decoder.machine.channel);
        decoder.report.unplaced.extend(unknown);
        let diagnostics = decoder.shaping.start(&decoder.machine);
        // errors of single filters in the lists are reported, with their position, when the chains are set up
        let of_several =
            [Condition::ListFirAndGuard, Condition::UnequalKernels, Condition::FollowerNotCovered];
        let of_forced =
            [Condition::GuardMode, Condition::GuardRange, Condition::GuardNotRealisable];
        let told = |d: &Diagnostic| {
            let known = |conditions: &[Condition]| conditions.iter().any(|c| d.id == *c);
            known(&of_several) || (forced && known(&of_forced))
        };
        decoder.report.unplaced.extend(diagnostics.into_iter().filter(told));
        decoder.start_external(options.external);
        decoder
    }

    /// A step at standstill; omitted if the block has an error, unless only the syntax is checked.
    pub(super) fn sync(&mut self, what: Sync) {
        if self.report.failed() && !self.checking {
            return;
        }
        if what != Sync::ThreadEnd {
            self.end_thread();
        }
        if matches!(what, Sync::FlushWait) {
            self.motion.independent.all_arrived();
        }
        self.contour.stop(what, &mut self.report);
        let limits = self.geometry.limits(&self.motion, &self.names, &self.machine);
        self.report.extend(self.contour.take_outside(&limits));
    }

    /// Sets the axes to their real positions; all of them if none is named. The setpoint moves back by the following error,
    /// which is within the window, and the axis follows it: repeated in a loop, it drifts (206709515). The following error is
    /// used instead of the actual position, because the latter includes additional values of the position loop, which would
    /// then act twice.
    ///
    /// Assumption: coupled axes keep their setpoints, so that slaves stay at the positions given by their masters.
    pub(super) fn take_actual_positions(&mut self, axes: &[usize]) {
        self.motion.independent.all_arrived();
        let lags_mm = self.live.feedback().lag_mm.clone();
        for axis in 0..self.geometry.coordinates.target().len() {
            let lag_mm = lags_mm.get(axis).copied().unwrap_or(0.0);
            let named = axes.is_empty() || axes.contains(&axis);
            if named && lag_mm.abs() > 0.0 && self.motion.couplings.group_of(axis).is_none() {
                self.shift_position(axis, -lag_mm, true);
            }
        }
    }

    /// `#MACHINE DATA`: one value of an axis list.
    pub(super) fn set_machine_data(
        &mut self,
        axis: usize,
        key: &str,
        value: &str,
        span: Span,
    ) -> Result<(), Box<Fault>> {
        let machine = Arc::make_mut(&mut self.machine);
        if Axis::is_read_at_start(key) {
            let text =
                format!("{key} is only read at start-up of the control: no effect in a program");
            let fault = Fault::new(Condition::ListNoEffect, text, span).warning();
            self.report.note(fault.hint("write it into the axis list"));
            return Ok(());
        }
        if Axis::is_unknown(key) {
            let text = format!("{key} is no parameter of an axis that is known here: no effect");
            let fault = Fault::new(Condition::ListNoEffect, text, span).warning();
            self.report.note(fault.hint("the trace may differ from that of the control"));
            return Ok(());
        }
        let cycle = machine.cycle;
        let known = machine.chain_issues(axis);
        let changed = &mut machine.axes[axis];
        let listed = changed.kernel_preset(cycle);
        let corrected =
            changed.change(key, value, self.report.location.clone(), cycle).map_err(|reason| {
                let text = format!("axis {}: {reason}", changed.name());
                Fault::new(Condition::TokenUnknown, text, span)
            })?;
        for diagnostic in corrected {
            // also checks list values that the new value makes invalid
            self.report.note(Fault::of(Diagnostic { source: None, ..diagnostic }, span));
        }
        let limits_mm = changed.software_limits_mm();
        let overrides = self.shaping.overrides(&listed, &changed.kernel_preset(cycle));
        // the whole list counts again, also instead of limits set by G98 or G99 (207492747)
        self.geometry.limit_axis(axis, limits_mm, &mut self.contour);
        report_consequences(&self.machine, axis, &known, &mut self.report, span);
        self.axis_changes(self.machine.axes[axis].number(), span);
        if let Some(command) = overrides {
            let text = format!("{key}: no effect, {command} of the program takes precedence");
            let fault = Fault::new(Condition::ListNoEffect, text, span).warning();
            self.report.note(fault.hint(format!("write the value into {command}")));
        }
        Ok(())
    }

    /// The parameters of an axis or spindle, given by its logical number, have changed: the path stops, and its chain is replaced.
    pub(super) fn axis_changes(&mut self, number: u32, span: Span) {
        self.motion.limits.changed();
        // first: a kernel is replaced only after the axes have been at standstill for its whole length
        self.update_shaping(span);
        self.sync(Sync::MachineData { axis: number });
        // the list determines the effect of G135
        self.contour.event(self.motion.feedforward.event());
    }

    /// Recomputes the shaping; a changed kernel requires the path at standstill.
    pub(super) fn update_shaping(&mut self, span: Span) {
        let Worked { setup, diagnostics } = self.shaping.work_out(&self.machine);
        for diagnostic in diagnostics {
            self.report.note(Fault::of(diagnostic, span));
        }
        if setup != self.shaping.setup {
            self.shaping.setup = setup.clone();
            self.sync(Sync::Shaping(Box::new(setup)));
        }
        self.note_followers(span);
    }

    /// K-0156 for the slaves of active couplings.
    pub(super) fn note_followers(&mut self, span: Span) {
        for pair in self.motion.couplings.pairs() {
            let found = self.shaping.follower_not_covered(pair, &self.machine);
            if let Some(found) = found {
                self.report.note(Fault::of(found, span));
            }
        }
    }
}

/// Consequences of changed parameters of a path axis: a filter that cannot be designed with the new value, an input that the
/// drive does not have. Those that were `known` before the change are not repeated.
pub(super) fn report_consequences(
    machine: &Machine,
    axis: usize,
    known: &[Diagnostic],
    report: &mut Report,
    span: Span,
) {
    for diagnostic in machine.chain_issues(axis).into_iter().filter(|issue| !known.contains(issue))
    {
        report.note(Fault::of(Diagnostic { source: None, ..diagnostic }, span));
    }
}
