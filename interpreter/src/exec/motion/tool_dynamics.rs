//! Limits that a tool imposes on its spindle: minimum and maximum speed, maximum acceleration (P-TOOL-00012 to 00015).
//!
//! D passes them on. They take effect when the spindle next starts from standstill, or at once with `S[GET_DYNAMIC_DATA]`,
//! until they are replaced. `S[DEFAULT_DYNAMIC_DATA]` restores the limits of the list.
//!
//! Source: TF5200 spindle 287608459, 287679371; programming manual 208242699; axis parameters 117225611; diagnosis 60296
//! (259750027), 60312 (259806603), 60332 (520247691).
//!
//! Assumptions: a spindle is at standstill after M5, after M19 and after tapping, whether or not its ramp has ended; the
//! default data take effect on a rotating spindle at its next start from standstill; a spindle with speed 0 is not raised to
//! the minimum speed.

use crate::diag::{Condition, rounded};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::tools::Tools;
use crate::exec::motion::spindles::{Passed, Spindle, Turning};
use crate::exec::motion::state::MotionState;
use crate::exec::output::Output;
use crate::exec::report::Report;
use crate::exec::step::Event;
use crate::machine::table::tool;
use crate::machine::{Machine, SpindleLimits};
use crate::syntax::ast::Span;

/// rev/min for a speed in deg/s.
fn rpm(deg_s: f64) -> f64 {
    deg_s / 6.0
}

impl Spindle {
    /// K-0131 if the tool limits the speed of a rotating spindle, 60312 with P-AXIS-00474 = 1.
    pub(super) fn check_tool_speed(
        &self,
        machine: &Machine,
        report: &mut Report,
        span: Span,
    ) -> Outcome<()> {
        let Some((limits, used)) = self.limits.zip(tool_speed(self.overridden_rpm(), self.limits))
        else {
            return Ok(());
        };
        if !self.is_turning() {
            return Ok(());
        }
        let text = format!(
            "spindle speed {} rev/min of {} is outside {} to {} rev/min of the tool",
            rounded(self.overridden_rpm()),
            self.name,
            rounded(rpm(limits.min_deg_s)),
            rounded(rpm(limits.max_deg_s)),
        );
        if self.listed(machine).is_some_and(crate::machine::Axis::checks_tool_speed) {
            return Err(Fault::new(Condition::ToolSpeed, text, span));
        }
        let text = format!("{text}: {} rev/min is used", rounded(used));
        let parameter = |d: crate::diag::Diagnostic| d.parameter(tool::SPINDLE_MAX);
        report.note(Fault::new(Condition::SpindleLimit, text, span).with(parameter));
        Ok(())
    }
}

impl MotionState {
    /// D, `#TOOL DATA`: records the limits of the tool for its spindle. 60296 if they are invalid, 60332 if the minimum speed
    /// is corrected.
    pub(in crate::exec) fn pass_tool_limits(
        &mut self,
        tools: &Tools,
        machine: &Machine,
        report: &mut Report,
        span: Span,
    ) -> Outcome<()> {
        let tool = &tools.active;
        let (number, mut limits) = (tool.spindle, tool.limits);
        if number == 0 {
            return Ok(());
        }
        let data = tools.data;
        let of_number =
            |s: &Spindle| s.index.is_some_and(|i| machine.spindles[i].number() == number);
        let Some(index) = self.spindles.iter().position(of_number) else {
            let text = format!("D{data}: no spindle has the logical number {number}");
            let hint = "write the kopf.achs_nr of a spindle in P-TOOL-00012 of the tool";
            return Err(Fault::new(Condition::ToolSpindleUnknown, text, span).hint(hint));
        };
        let name = self.spindles[index].name.clone();
        if limits.max_deg_s <= 0.0 || limits.acc_deg_s2 <= 0.0 {
            let text = format!(
                "D{data}: {} deg/s and {} deg/s2 are invalid as limits of {name}",
                limits.max_deg_s, limits.acc_deg_s2
            );
            return Err(Fault::new(Condition::ToolLimitsInvalid, text, span));
        }
        let least = limits.min_deg_s.clamp(0.0, limits.max_deg_s);
        if least.to_bits() != limits.min_deg_s.to_bits() {
            let text = format!(
                "D{data}: the minimum speed {} deg/s of {name} is outside 0 to {}: {least} deg/s",
                limits.min_deg_s, limits.max_deg_s
            );
            report.note(Fault::new(Condition::ToolLeastSpeed, text, span));
            limits.min_deg_s = least;
        }
        self.spindles[index].passed = Passed::Tool(limits);
        Ok(())
    }

    /// Refuses functions that depend on the speed of a spindle while its tool limits it: the pages do not state which of the
    /// two speeds applies.
    pub(in crate::exec) fn no_tool_limit(
        &self,
        what: &str,
        spindle: usize,
        span: Span,
    ) -> Outcome<()> {
        let state = &self.spindles[spindle];
        let changing = spindle == 0 && self.cutting.is_on() && state.limits.is_some();
        if changing || tool_speed(state.overridden_rpm(), state.limits).is_some() {
            let what = format!("{what} at a speed that the tool limits (P-TOOL-00014)");
            return Err(Fault::unsupported(what, span));
        }
        Ok(())
    }

    /// `S[GET_DYNAMIC_DATA]`: the limits passed on by D take effect at once.
    pub(in crate::exec) fn take_tool_limits(
        &mut self,
        spindle: usize,
        output: &mut Output<'_>,
        span: Span,
    ) -> Outcome<()> {
        let state = &mut self.spindles[spindle];
        let limits = match std::mem::take(&mut state.passed) {
            Passed::Nothing => return Ok(()),
            Passed::Tool(limits) => Some(limits),
            Passed::List => None,
        };
        state.limits = limits;
        if let Some(index) = state.index {
            output.contour.event(Event::SpindleLimits { spindle: index, limits });
        }
        self.spindles[spindle].check_tool_speed(output.machine, output.report, span)
    }

    /// `S[DEFAULT_DYNAMIC_DATA]`.
    pub(in crate::exec) fn default_limits(
        &mut self,
        spindle: usize,
        output: &mut Output<'_>,
        span: Span,
    ) -> Outcome<()> {
        self.spindles[spindle].passed = Passed::List;
        if self.spindles[spindle].runs {
            return Ok(());
        }
        self.take_tool_limits(spindle, output, span)
    }

    /// The spindle changes to its commanded state; a start from standstill activates the limits of the tool first.
    pub(in crate::exec) fn move_spindle(
        &mut self,
        spindle: usize,
        output: &mut Output<'_>,
        span: Span,
    ) -> Outcome<()> {
        let state = &mut self.spindles[spindle];
        let starts = !state.runs && state.turning != Turning::Stopped;
        state.runs = state.is_turning();
        if starts && state.passed != Passed::Nothing {
            self.take_tool_limits(spindle, output, span)?;
        } else {
            self.spindles[spindle].check_tool_speed(output.machine, output.report, span)?;
        }
        if let Some(event) = self.spindles[spindle].motion_event() {
            output.contour.event(event);
        }
        Ok(())
    }
}

/// The speed in rev/min after limiting by the tool; `None` if it does not change.
fn tool_speed(wanted: f64, limits: Option<SpindleLimits>) -> Option<f64> {
    let limits = limits?;
    let used = wanted.clamp(rpm(limits.min_deg_s), rpm(limits.max_deg_s));
    (wanted > 0.0 && used.to_bits() != wanted.to_bits()).then_some(used)
}
