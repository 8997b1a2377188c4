//! Faults of the running machine: messages and reactions.
//!
//! Reaction classes (TF5200 diagnosis manual): 1 is a message; 4, 6, 7, 8 and 5 end the program. The axis concerned
//! stops where it is (5, 6, 8; 8 with its position loop open) or with the others (4, 7); the others brake along the
//! path with P-AXIS-00003. The run continues until the axes are at rest.

mod text;

use super::axes::Driver;
use super::chain::Remaining;
use super::inputs::SpeedChange;
use super::{Phase, Simulation};
use crate::diag::{Condition, Diagnostic, Reaction, Severity, ValueKind, rounded};
use crate::exec::{SourceRef, SpindleMotion};
use crate::machine::table::{axis_control, axis_filters};
use crate::machine::{Axis, AxisKind, Machine};
use kontur_filters::control::fault::Fault;
use kontur_filters::control::plant::PlantError;
use kontur_filters::time::CycleTime;
use kontur_motion::contouring::NoContour;
use kontur_motion::deviation::Unkept;
use text::{condition, order, per_s, text, thresholds};

/// Number of cycles of standstill shown after the stop of a fault.
pub(super) const CYCLES_AT_REST: u32 = 5;
/// Longest wait in s, after the set positions have stopped, for axes that do not come to rest.
const LONGEST_COASTING_S: f64 = 2.0;

/// Progress of the stop after a fault.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Stopping {
    settled_cycles: u32,
    /// Block of the wait that was interrupted.
    pub(super) waited_at: Option<SourceRef>,
    coasting_cycles: u32,
    /// Conditions already reported: an oscillating axis reaches its limits again and again.
    told: Vec<(usize, Condition)>,
}

impl Stopping {
    /// Whether the axis has not reported this condition since the stop began.
    fn is_new(&mut self, chain: usize, condition: Condition) -> bool {
        let new = !self.told.contains(&(chain, condition));
        if new {
            self.told.push((chain, condition));
        }
        new
    }

    /// One cycle with the set positions and the axes at rest or not; true at the end of the run.
    pub(super) fn is_over(&mut self, set_rests: bool, axes_stand: bool, cycle: CycleTime) -> bool {
        self.coasting_cycles = if set_rests { self.coasting_cycles + 1 } else { 0 };
        let longest = LONGEST_COASTING_S / cycle.seconds();
        let rests = set_rests && (axes_stand || f64::from(self.coasting_cycles) > longest);
        self.settled_cycles = if rests { self.settled_cycles + 1 } else { 0 };
        self.settled_cycles > CYCLES_AT_REST
    }
}

impl Simulation {
    /// Handles a fault of one axis: reports it and, from class 4 on, ends the run.
    pub(super) fn fault(&mut self, chain: usize, fault: &Fault) {
        // the abrupt end of a set position is the effect of a reaction
        let of_set_position =
            matches!(fault, Fault::SetpointWarning { .. } | Fault::SetpointError { .. });
        if self.frozen[chain].is_some() && of_set_position {
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
            let waited_at = matches!(self.phase, Phase::Waiting(_)).then_some(self.shown);
            self.phase = Phase::Stopping(Stopping { waited_at, told, ..Stopping::default() });
        }
    }

    /// Immediate reaction of the axis concerned.
    ///
    /// Both sides of a gantry bridge stop alike: held where they are once their set position is at rest, braked with
    /// the limits of the path while it moves. Stopping only one of them would rack the bridge.
    fn react(&mut self, chain: usize, reaction: Reaction) {
        let driver = self.drivers[chain];
        let together =
            |i: usize| i == chain || matches!(driver, Driver::Path(_)) && self.drivers[i] == driver;
        let concerned: Vec<usize> = match reaction {
            Reaction::AbruptStop | Reaction::OpenLoopStop => {
                (0..self.chains.len()).filter(|i| together(*i)).collect()
            }
            Reaction::AllStop => (0..self.chains.len()).collect(),
            // the path brakes; there is no other reaction of the axis
            Reaction::None
            | Reaction::ProgramAbort
            | Reaction::JobAbort
            | Reaction::FeedHold
            | Reaction::ControlledStop => return,
        };
        let bridge = reaction != Reaction::AllStop && concerned.len() > 1;
        if bridge && self.record.path.v_mm_s > 0.0 {
            return;
        }
        for i in concerned {
            let here = self.record.axes[i].ipo;
            self.frozen[i].get_or_insert(here);
            match reaction {
                Reaction::OpenLoopStop => self.chains[i].open_loop(),
                Reaction::AbruptStop => self.chains[i].halt(),
                Reaction::None
                | Reaction::ProgramAbort
                | Reaction::JobAbort
                | Reaction::FeedHold
                | Reaction::ControlledStop
                | Reaction::AllStop => {}
            }
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
        let at = self.stops_at[chain];
        d.source = self.program.locate(if at.line > 0 { at } else { self.waits_at });
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
            Fault::IpcChangedMoving => base,
        };
        let mut diagnostic = diagnostic.axis(number, name);
        diagnostic.cycle = Some(self.record.k);
        diagnostic.time_s = Some(self.cycle.time_of(self.record.k));
        // the next blocks may already be running when a stop turns out to be late
        let late = matches!(fault, Fault::SettlingTimeout { .. });
        let at = if late { self.stops_at[chain] } else { self.current };
        diagnostic.source = self.program.locate(at);
        diagnostic
    }
}

/// The plant of an axis cannot be simulated.
pub(super) fn plant(error: &PlantError, machine: &Machine, chain: usize) -> Diagnostic {
    let name = machine.all_axes().nth(chain).map_or("?", |a| a.name());
    Diagnostic::new(Condition::ListRange, format!("plant of axis {name}: {error}"))
        .severity(crate::diag::Severity::Error)
}

/// A condition that the look-ahead excludes.
pub(super) fn internal(text: &str) -> Diagnostic {
    Diagnostic::new(Condition::Internal, text)
        .hint("please report this bug in kontur, with the program and the machine lists")
}

/// A kernel was to be replaced while the axis still moves.
pub(super) fn switch_while_moving() -> Diagnostic {
    Diagnostic::new(Condition::Internal, "filter kernel not switched: the axis still moves")
}

/// The program time is used up.
pub(super) fn out_of_time(last: u64, limit_s: f64, cycle: CycleTime) -> Diagnostic {
    let time_s = cycle.time_of(last);
    let text = format!("program time exceeds {limit_s} s: the run was stopped");
    let mut d = Diagnostic::new(Condition::Endless, text).hint("raise the limit with --max-time");
    d.cycle = Some(last);
    d.time_s = Some(time_s);
    d
}

/// The path can never be released.
pub(super) fn held(k: u64, cycle: CycleTime, feedhold: bool) -> Diagnostic {
    let (what, release) =
        if feedhold { ("feedhold", "feedhold 0") } else { ("override 0", "an override") };
    let text = format!(
        "the path is held by {what} and not released by any later input: the run was stopped"
    );
    let mut d =
        Diagnostic::new(Condition::Held, text).hint(format!("give {release} a later time stamp"));
    d.cycle = Some(k);
    d.time_s = Some(cycle.time_of(k));
    d
}

/// The pitch of a thread is not kept.
pub(super) fn thread_broken(why: SpeedChange, k: u64, cycle: CycleTime) -> Diagnostic {
    let text = match why {
        SpeedChange::Feedhold => {
            "a feedhold stops the path in a thread while the spindle keeps turning: the thread is damaged".to_owned()
        }
        SpeedChange::Override(ratio) => format!(
            "the override of {} % acts on G33 and scales the pitch of the thread",
            rounded(ratio * 100.0)
        ),
    };
    let mut d = Diagnostic::new(Condition::ThreadBroken, text);
    d.cycle = Some(k);
    d.time_s = Some(cycle.time_of(k));
    d
}

/// A motion takes longer than its time under G93.
pub(super) fn time_not_kept(time_s: f64, taken_s: f64) -> Diagnostic {
    let text = format!("the motion takes {taken_s:.3} s instead of its time F{time_s} (G93)");
    Diagnostic::new(Condition::TimeNotKept, text)
        .value(ValueKind::Current, taken_s, "s")
        .value(ValueKind::Limit, time_s, "s")
        .hint("this is the first motion that takes a tenth more than its time; v_limit of the trace shows what limits it")
}

/// The set path in the output leaves the contour by more than the plan guarantees.
pub(super) fn exceeded(exceeded: &Unkept) -> Diagnostic {
    let Unkept { deviation_mm, tolerance_mm, .. } = *exceeded;
    let text = format!(
        "deviation {deviation_mm:.6} mm exceeds AX_DEV {tolerance_mm:.6} mm, although the planned path keeps it"
    );
    Diagnostic::new(Condition::AxDevNotKept, text)
        .severity(Severity::Warning)
        .value(ValueKind::Current, deviation_mm, "mm")
        .value(ValueKind::Limit, tolerance_mm, "mm")
        .hint("this is the first place in the run; see |dev| in the summary for the largest deviation")
}

impl Simulation {
    /// K-0022, once for each place: the set position of a chain moves while its gain changes by `step`.
    pub(super) fn switched_while_moving(&mut self, chain: usize, step: f64) {
        let at = self.current;
        if self.smoothing.is_new(Condition::FeedforwardSwitchedMoving, at) {
            let v = self.record.axes[chain].vel;
            let axis = self.machine.all_axes().nth(chain);
            let (name, number) = axis.map_or(("?", 0), |a| (a.name(), a.number()));
            let unit = axis.map_or("mm", Axis::unit);
            let text = format!(
                "feedforward is switched or weighted while {name} moves at {v:.3} {unit}/s: its speed command jumps by {:.3} {unit}/s",
                (step * v).abs()
            );
            let d = Diagnostic::new(Condition::FeedforwardSwitchedMoving, text).axis(number, name);
            let mut d = d.value(ValueKind::Current, v, if unit == "mm" { "mm/s" } else { "deg/s" });
            d.cycle = Some(self.record.k + 1);
            d.time_s = Some(self.cycle.time_of(self.record.k + 1));
            d.source = self.program.locate(at);
            self.messages.own.push(d);
        }
    }

    /// K-0143, once for each place: a block that waits for every axis ends an oscillation.
    pub(super) fn oscillation_ends(&mut self, axis: usize) {
        let at = self.waits_at;
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
        let source =
            self.underway.iter().find(|u| u.seq == unkept.seq).map_or(self.current, |u| u.source);
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
                .underway
                .iter()
                .find(|u| u.seq == notice.seq)
                .map_or(self.current, |u| u.source);
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
