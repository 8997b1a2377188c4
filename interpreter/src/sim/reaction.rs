//! Faults of the running machine: reactions.
//!
//! Reaction classes (TF5200 diagnosis manual): 1 is a message; 4, 6, 7, 8 and 5 end the program. The axis concerned
//! stops where it is (5, 6, 8; 8 with its position loop open) or with the others (4, 7); the others brake along the
//! path with P-AXIS-00003. The run continues until the axes are at rest.

use super::chain::Remaining;
use super::fault::internal;
use super::fault::text::{condition, order, per_s, text, thresholds};
use super::state::{Phase, Simulation, Stopping};
use crate::diag::{Condition, Diagnostic, Reaction, Severity, ValueKind, rounded};
use crate::exec::{SourceRef, SpindleMotion};
use crate::machine::table::{axis_control, axis_filters};
use crate::machine::{Axis, AxisKind};
use kontur_filters::control::fault::Fault;
use kontur_motion::contouring::NoContour;
use kontur_motion::deviation::Unkept;

impl Simulation {
    /// Handles a fault of one axis: reports it and, from class 4 on, ends the run.
    pub(super) fn fault(&mut self, chain: usize, fault: &Fault) {
        // the abrupt end of a set position is the effect of a reaction
        let of_set_position =
            matches!(fault, Fault::SetpointWarning { .. } | Fault::SetpointError { .. });
        if self.chains.frozen(chain).is_some() && of_set_position {
            return;
        }
        let condition = condition(fault, self.is_spindle(chain));
        if let Phase::Stopping(stopping) = &mut self.phase
            && !stopping.is_new(chain, condition)
        {
            return;
        }
        let diagnostic = self.describe(chain, condition, fault);
        let reaction = condition.row().reaction;
        let only_warns = diagnostic.severity == Severity::Warning;
        self.messages.own.push(diagnostic);
        if reaction == Reaction::None || only_warns {
            return;
        }
        self.react(chain, reaction);
        if matches!(fault, Fault::Swings { .. }) {
            // with its loop closed the axis never comes to rest
            self.chains.all[chain].open_loop();
        }
        self.stop(vec![(chain, condition)]);
    }

    /// Brakes everything and ends the run.
    pub(super) fn stop(&mut self, told: Vec<(usize, Condition)>) {
        self.totals.aborted = true;
        if !matches!(self.phase, Phase::Stopping(_)) {
            for spindle in &mut self.spindles {
                spindle.command(SpindleMotion::Stop);
            }
            self.planner.brake();
            if let Err(e) = self.independent.stop(self.record.k) {
                self.messages.own.push(internal(&format!("look-ahead: {e}")));
            }
            let waited_at = matches!(self.phase, Phase::Waiting(_)).then_some(self.blocks.shown);
            self.phase = Phase::Stopping(Stopping { waited_at, told, ..Stopping::default() });
        }
    }

    /// Immediate reaction of the axis concerned.
    ///
    /// Both sides of a gantry bridge stop alike: held where they are once their set position is at rest, braked with
    /// the limits of the path while it moves. Stopping only one of them would rack the bridge.
    fn react(&mut self, chain: usize, reaction: Reaction) {
        let concerned = self.chains.stopped_with(chain, reaction);
        let bridge = reaction != Reaction::AllStop && concerned.len() > 1;
        if bridge && self.record.path.v_mm_s > 0.0 {
            return;
        }
        for i in concerned {
            let here = self.record.axes[i].ipo;
            self.chains.freeze(i, here, reaction);
        }
    }

    /// Ends the run because an axis can never reach the position for which the program waits.
    pub(super) fn never_arrives(&mut self, chain: usize, lacks: Remaining) {
        let axis = self.machine.all_axes().nth(chain);
        let (name, number) = axis.map_or(("?", 0), |a| (a.name(), a.number()));
        let unit = axis.map_or("mm", Axis::unit);
        let Remaining { distance_mm, window_mm, filters } = lacks;
        let (window, parameter, help) = if filters {
            (
                "the window of its filters",
                axis_filters::SETTLED_WINDOW,
                "raise filter_position_window",
            )
        } else {
            (
                "the exact-stop window",
                axis_control::WINDOW,
                "raise the window or the gain kv, or remove the force",
            )
        };
        let text = format!(
            "axis {name} is {} {unit} from its target, {window} is {} {unit}, and no remaining input moves it",
            rounded(distance_mm),
            rounded(window_mm)
        );
        let mut d = Diagnostic::new(Condition::Standstill, text)
            .value(ValueKind::Current, distance_mm, unit)
            .value(ValueKind::Limit, window_mm, unit)
            .axis(number, name)
            .parameter(parameter)
            .hint(help);
        let k = self.planner.setpoint().k;
        (d.cycle, d.time_s) = (Some(k), Some(self.cycle.time_of(k)));
        let at = self.blocks.stops_at[chain];
        d.source = self.program.locate(if at.line > 0 { at } else { self.blocks.waits_at });
        self.messages.own.push(d);
        self.totals.aborted = true;
        self.phase = Phase::Done;
    }

    fn is_spindle(&self, chain: usize) -> bool {
        self.machine.all_axes().nth(chain).is_some_and(|axis| axis.kind() == AxisKind::Spindle)
    }

    fn describe(&mut self, chain: usize, condition: Condition, fault: &Fault) -> Diagnostic {
        let axis = self.machine.all_axes().nth(chain);
        let (name, number) = axis.map_or(("?", 0), |a| (a.name(), a.number()));
        let unit = axis.map_or("mm", Axis::unit);
        let base = Diagnostic::new(condition, format!("{}, axis {name}", text(fault, unit)));
        let diagnostic = match *fault {
            Fault::FollowingError { lag_mm, limit_mm } | Fault::Unstable { lag_mm, limit_mm } => {
                base.value(ValueKind::Current, lag_mm, unit).value(ValueKind::Limit, limit_mm, unit)
            }
            Fault::BeyondLimit { actual_mm, limit_mm } => {
                let base = base.value(ValueKind::Current, actual_mm, unit).value(
                    ValueKind::Limit,
                    limit_mm,
                    unit,
                );
                // Assumption: the same ID; no page names one for this warning
                let only_warns = axis.is_some_and(Axis::software_limits_only_warn);
                if only_warns { base.severity(Severity::Warning) } else { base }
            }
            Fault::SettlingTimeout { lag_mm, window_mm, time_s } => base
                .value(ValueKind::Current, lag_mm, unit)
                .value(ValueKind::Limit, window_mm, unit)
                .value(ValueKind::Limit, time_s, "s"),
            Fault::ControllerSpeed { speed_mm_s, limit_mm_s } => base
                .value(ValueKind::Current, speed_mm_s, per_s(unit, 1))
                .value(ValueKind::Limit, limit_mm_s, per_s(unit, 1)),
            Fault::SetpointWarning { what, value, limit } => base
                .value(ValueKind::Current, value, per_s(unit, order(what)))
                .value(ValueKind::Limit, limit, per_s(unit, order(what)))
                .parameter(thresholds(what).0),
            Fault::SetpointError { what, value, limit } => base
                .value(ValueKind::Current, value, per_s(unit, order(what)))
                .value(ValueKind::Limit, limit, per_s(unit, order(what)))
                .parameter(thresholds(what).1),
            Fault::Swings { limit_mm_s } => {
                base.value(ValueKind::Limit, limit_mm_s, per_s(unit, 1))
            }
            Fault::IpcChangedMoving => base,
        };
        let mut diagnostic = diagnostic.axis(number, name);
        diagnostic.cycle = Some(self.record.k);
        diagnostic.time_s = Some(self.cycle.time_of(self.record.k));
        // the next blocks may already be running when a stop turns out to be late
        let late = matches!(fault, Fault::SettlingTimeout { .. });
        let at = if late { self.blocks.stops_at[chain] } else { self.blocks.current };
        diagnostic.source = self.program.locate(at);
        diagnostic
    }
}

impl Simulation {
    /// K-0022, once for each place: the set position of a chain moves while its gain changes by `step`.
    pub(super) fn switched_while_moving(&mut self, chain: usize, step: f64) {
        let v = self.record.axes[chain].vel;
        let (name, unit) = self.axis_of(chain);
        let text = format!(
            "feedforward is switched or weighted while {name} moves at {v:.3} {unit}/s: its speed command jumps by {:.3} {unit}/s",
            (step * v).abs()
        );
        self.command_jumps(chain, self.blocks.current, text, (v, per_s(unit, 1)));
    }

    /// K-0022, once for each place: `#MACHINE DATA` changes the control of a chain that has not arrived.
    pub(super) fn changed_while_lagging(&mut self, chain: usize) {
        let lag = self.record.axes[chain].lag;
        let (name, unit) = self.axis_of(chain);
        let text = format!(
            "machine data change the control of {name} while it lags by {lag:.4} {unit}: its speed command jumps"
        );
        self.command_jumps(chain, self.blocks.waits_at, text, (lag, unit));
    }

    /// Name and unit of the axis of a chain.
    fn axis_of(&self, chain: usize) -> (&str, &'static str) {
        self.machine.all_axes().nth(chain).map_or(("?", "mm"), |a| (a.name(), a.unit()))
    }

    fn command_jumps(
        &mut self,
        chain: usize,
        at: SourceRef,
        text: String,
        (value, unit): (f64, &'static str),
    ) {
        if !self.smoothing.is_new(Condition::FeedforwardSwitchedMoving, at) {
            return;
        }
        let axis = self.machine.all_axes().nth(chain);
        let (name, number) = axis.map_or(("?", 0), |a| (a.name(), a.number()));
        let mut d = Diagnostic::new(Condition::FeedforwardSwitchedMoving, text)
            .axis(number, name)
            .value(ValueKind::Current, value, unit);
        d.cycle = Some(self.record.k + 1);
        d.time_s = Some(self.cycle.time_of(self.record.k + 1));
        d.source = self.program.locate(at);
        self.messages.own.push(d);
    }

    /// K-0143, once for each place: a block that waits for every axis ends an oscillation.
    pub(super) fn oscillation_ends(&mut self, axis: usize) {
        let at = self.blocks.waits_at;
        if self.smoothing.is_new(Condition::OscillationEnded, at) {
            let name = self.machine.axes[axis].name();
            let text = format!(
                "this block waits until all axes are at rest: the oscillation of {name} is ended"
            );
            let mut d = Diagnostic::new(Condition::OscillationEnded, text)
                .axis(self.machine.axes[axis].number(), name);
            d.source = self.program.locate(at);
            self.messages.own.push(d);
        }
    }

    /// The tolerance of a block could not be kept: always an error, so that a violation never goes unnoticed.
    pub(super) fn unkept(&mut self, unkept: &Unkept) {
        let mut d = Diagnostic::new(
            Condition::AxDevNotKept,
            format!(
                "deviation {:.6} mm exceeds AX_DEV {:.6} mm and could not be lowered further",
                unkept.deviation_mm, unkept.tolerance_mm
            ),
        )
        .value(ValueKind::Current, unkept.deviation_mm, "mm")
        .value(ValueKind::Limit, unkept.tolerance_mm, "mm");
        let source = self
            .queue
            .underway
            .iter()
            .find(|u| u.seq == unkept.seq)
            .map_or(self.blocks.current, |u| u.source);
        d.source = self.program.locate(source);
        self.messages.own.push(d);
        self.stop(Vec::new());
    }

    /// Reports the corners that were not contoured as programmed, each place once.
    pub(super) fn not_contoured(&mut self) {
        for notice in self.smoothing.take_notices() {
            let (condition, text) = match notice.reason {
                NoContour::BlockTooShort => {
                    (Condition::BlockTooShort, "a block is too short for contouring")
                }
                NoContour::DeviationTooSmall { .. } => {
                    (Condition::PathDevTooSmall, "PATH_DEV is below the minimum")
                }
                NoContour::DistanceTooSmall { .. } => {
                    (Condition::CornerDistanceTooSmall, "a corner distance is below the minimum")
                }
                NoContour::NotPossible => (
                    Condition::ContouringNotPossible,
                    "contouring is not possible at the end of this block",
                ),
                NoContour::FeedGroup => {
                    (Condition::ContouringGroupChanged, "the feed group changes after this block")
                }
                // at a stop there is no corner to round; MAX_ANGLE is programmed; the executor reports the mode
                NoContour::NothingFollows
                | NoContour::AngleAboveMaximum { .. }
                | NoContour::ModeReplaced => continue,
                NoContour::Slower => (
                    Condition::CornerFaster,
                    "the curve would take longer than the corner, here and perhaps at other corners",
                ),
            };
            let source = self
                .queue
                .underway
                .iter()
                .find(|u| u.seq == notice.seq)
                .map_or(self.blocks.current, |u| u.source);
            // the result of a choice, of which one example is enough
            let chosen = condition == Condition::CornerFaster;
            let place = if chosen { SourceRef { line: 0, ..source } } else { source };
            if self.smoothing.is_new(condition, place) {
                // Assumption: the run continues with the corner as programmed, where the control would abort
                let severity = if chosen { Severity::Note } else { Severity::Warning };
                let mut d =
                    Diagnostic::new(condition, format!("{text}: the corner stays as programmed"))
                        .severity(severity);
                d.source = self.program.locate(source);
                self.messages.own.push(d);
            }
        }
    }
}
