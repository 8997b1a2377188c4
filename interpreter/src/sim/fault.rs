//! What goes wrong while the machine runs: messages and reactions.
//!
//! Reaction classes (TF5200 diagnosis manual): 1 a message; 4, 6, 7, 8 and 5 end the program - the axis concerned stops
//! where it is (5, 6, 8; 8 with its position loop open) or with the others (4, 7), the others brake along the path with
//! P-AXIS-00003. The run goes on until the axes themselves stand.

use super::axes::Driver;
use super::chain::Remaining;
use super::{Phase, Simulation};
use crate::diag::{Diagnostic, ValueKind, rounded};
use crate::exec::SpindleMotion;
use crate::machine::{Axis, AxisKind, Machine};
use kontur_filters::control::fault::{Derivative, ErrorId, Fault, Reaction};
use kontur_filters::control::plant::PlantError;
use kontur_filters::time::CycleTime;
use kontur_motion::contouring::NoContour;
use kontur_motion::profile::Infeasible;
use kontur_motion::tolerance::Unkept;

/// Cycles of standstill shown behind the stop of a fault.
pub(super) const CYCLES_AT_REST: u32 = 5;
/// Longest time behind the stop of the set positions that is waited for axes that do not come to rest.
const LONGEST_COASTING_S: f64 = 2.0;

/// How far the stop of a fault has come.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Stopping {
    settled_cycles: u32,
    coasting_cycles: u32,
    /// What was told already: an axis that swings meets its limits again and again.
    told: Vec<(usize, ErrorId)>,
}

impl Stopping {
    /// The axis has not said this since the stop began.
    fn is_new(&mut self, chain: usize, id: ErrorId) -> bool {
        let new = !self.told.contains(&(chain, id));
        if new {
            self.told.push((chain, id));
        }
        new
    }

    /// One cycle: the set positions rest, the axes stand. True at the end of the run.
    pub(super) fn is_over(&mut self, set_rests: bool, axes_stand: bool, cycle: CycleTime) -> bool {
        self.coasting_cycles = if set_rests { self.coasting_cycles + 1 } else { 0 };
        let longest = LONGEST_COASTING_S / cycle.seconds();
        let rests = set_rests && (axes_stand || f64::from(self.coasting_cycles) > longest);
        self.settled_cycles = if rests { self.settled_cycles + 1 } else { 0 };
        self.settled_cycles > CYCLES_AT_REST
    }
}

impl Simulation {
    /// A fault of one axis: message, and from class 4 on the end of the run.
    pub(super) fn fault(&mut self, chain: usize, fault: &Fault) {
        // the abrupt end of a set position is what a reaction asked for
        let of_set_position =
            matches!(fault, Fault::SetpointWarning { .. } | Fault::SetpointError { .. });
        if self.frozen[chain].is_some() && of_set_position {
            return;
        }
        if let Phase::Stopping(stopping) = &mut self.phase
            && !stopping.is_new(chain, fault.id())
        {
            return;
        }
        let diagnostic = self.describe(chain, fault);
        self.diagnostics.push(diagnostic);
        let reaction = fault.reaction();
        if reaction == Reaction::None {
            return;
        }
        self.totals.aborted = true;
        self.react(chain, reaction);
        if !matches!(self.phase, Phase::Stopping(_)) {
            for spindle in &mut self.spindles {
                spindle.command(SpindleMotion::Stop);
            }
            self.planner.brake();
            if let Err(e) = self.independent.stop(self.record.k) {
                self.diagnostics.push(internal(&e));
            }
            let told = vec![(chain, fault.id())];
            self.phase = Phase::Stopping(Stopping { told, ..Stopping::default() });
        }
    }

    /// What the axis concerned does at once.
    ///
    /// Both sides of a gantry bridge stop alike: kept where they are once their set position stands, with the limits of the
    /// path while it moves. Stopping one of them alone would rack the bridge.
    fn react(&mut self, chain: usize, reaction: Reaction) {
        let driver = self.drivers[chain];
        let together =
            |i: usize| i == chain || matches!(driver, Driver::Path(_)) && self.drivers[i] == driver;
        let concerned: Vec<usize> = match reaction {
            Reaction::AbruptStop | Reaction::OpenLoopStop => {
                (0..self.chains.len()).filter(|i| together(*i)).collect()
            }
            Reaction::AllStop => (0..self.chains.len()).collect(),
            _ => return,
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
                _ => {}
            }
        }
    }

    /// Nothing will ever bring an axis to where the program waits for it: the end of the run.
    pub(super) fn never_arrives(&mut self, chain: usize, lacks: Remaining) {
        let axis = self.machine.all_axes().nth(chain);
        let (name, number) = axis.map_or(("?", 0), |a| (a.name(), a.number()));
        let unit = axis.map_or("mm", Axis::unit);
        let Remaining { distance_mm, window_mm, filters } = lacks;
        let (window, parameter, help) = if filters {
            ("the window of its filters", "P-AXIS-00351", "raise filter_position_window")
        } else {
            (
                "the exact-stop window",
                "P-AXIS-00236",
                "raise window or the gain kv, or take the force away",
            )
        };
        let text = format!(
            "axis {name} stands {} {unit} from its target, {window} is {} {unit}, and nothing moves it any more",
            rounded(distance_mm),
            rounded(window_mm)
        );
        let mut d = Diagnostic::kontur(130, text)
            .value(ValueKind::Current, distance_mm, unit)
            .value(ValueKind::Limit, window_mm, unit)
            .axis(number, name)
            .parameter(parameter)
            .hint(help);
        let k = self.planner.setpoint().k;
        (d.cycle, d.time_s) = (Some(k), Some(self.cycle.time_of(k)));
        let at = self.stops_at[chain];
        d.source = self.executor.locate(if at.line > 0 { at } else { self.waits_at });
        self.diagnostics.push(d);
        self.totals.aborted = true;
        self.phase = Phase::Done;
    }

    fn describe(&mut self, chain: usize, fault: &Fault) -> Diagnostic {
        let axis = self.machine.all_axes().nth(chain);
        let (name, number) = axis.map_or(("?", 0), |a| (a.name(), a.number()));
        let spindle = axis.is_some_and(|a| a.kind() == AxisKind::Spindle);
        let unit = axis.map_or("mm", Axis::unit);
        let (speed_unit, r) = (per_s(unit, 1), rounded);
        let base = |text: String| match fault.id() {
            // spindles have numbers of their own for the same
            ErrorId::Vendor(50118) if spindle => Diagnostic::vendor(60101, text),
            ErrorId::Vendor(50119) if spindle => Diagnostic::vendor(60102, text),
            ErrorId::Vendor(n) => Diagnostic::vendor(n, text),
            ErrorId::Kontur(n) => Diagnostic::kontur(n, text),
        };
        // the monitors watch magnitudes, the vendor's values too
        let (diagnostic, at) = match *fault {
            Fault::FollowingError { lag_mm, limit_mm } => (
                base(format!(
                    "following error {} {unit} exceeds {} {unit}, axis {name}",
                    r(lag_mm),
                    r(limit_mm)
                ))
                .value(ValueKind::Current, lag_mm, unit)
                .value(ValueKind::Limit, limit_mm, unit)
                .parameter("P-AXIS-00172")
                .hint("raise slep_max, use feedforward (G135), or lower the feed"),
                self.current,
            ),
            Fault::SettlingTimeout { lag_mm, window_mm, time_s } => (
                base(format!(
                    "distance {} {unit} to the target after {} s is outside the exact-stop window of {} {unit}, axis {name}",
                    r(lag_mm),
                    r(time_s),
                    r(window_mm)
                ))
                .value(ValueKind::Current, lag_mm, unit)
                .value(ValueKind::Limit, window_mm, unit)
                .value(ValueKind::Limit, time_s, "s")
                .parameter("P-AXIS-00236")
                .hint("raise position_settling_time (P-AXIS-00532) or window, or the gain kv"),
                // the next blocks may be running already
                self.stops_at[chain],
            ),
            Fault::ControllerSpeed { speed_mm_s, limit_mm_s } => (
                base(format!(
                    "speed command {} {speed_unit} exceeds {} {speed_unit}, axis {name}",
                    r(speed_mm_s),
                    r(limit_mm_s)
                ))
                .value(ValueKind::Current, speed_mm_s, speed_unit)
                .value(ValueKind::Limit, limit_mm_s, speed_unit)
                .parameter("P-AXIS-00407")
                .hint("an axis that swings up: lower the gain kv or the weights of Improved Position Control"),
                self.current,
            ),
            Fault::SetpointWarning { what, value, limit } | Fault::SetpointError { what, value, limit } => {
                let (quantity, order, warning, error) = watched(what);
                let unit = per_s(unit, order);
                let text = format!(
                    "{quantity} of the set position {} {unit} exceeds {} {unit}, axis {name}",
                    r(value),
                    r(limit)
                );
                let d = base(text)
                    .value(ValueKind::Current, value, unit)
                    .value(ValueKind::Limit, limit, unit);
                let d = if matches!(fault, Fault::SetpointWarning { .. }) {
                    d.parameter(warning)
                } else {
                    d.parameter(error)
                        .hint("lower the dynamics, or raise the threshold if a filter overshoots")
                };
                (d, self.current)
            }
            Fault::Unstable { lag_mm, limit_mm } => (
                base(format!(
                    "following error {} {unit} beyond {} {unit}: the simulated axis {name} is unstable",
                    r(lag_mm),
                    r(limit_mm)
                ))
                .value(ValueKind::Current, lag_mm, unit)
                .value(ValueKind::Limit, limit_mm, unit)
                .parameter("P-AXIS-00099")
                .hint("lower the gain kv or the weights of Improved Position Control"),
                self.current,
            ),
            _ => (
                base(format!("parameters of Improved Position Control changed while axis {name} moves")),
                self.current,
            ),
        };
        let mut diagnostic = diagnostic.axis(number, name);
        diagnostic.cycle = Some(self.record.k);
        diagnostic.time_s = Some(self.cycle.time_of(self.record.k));
        diagnostic.source = self.executor.locate(at);
        diagnostic
    }
}

/// Quantity, order of the derivative, and the parameters of warning and error.
const fn watched(what: Derivative) -> (&'static str, usize, &'static str, &'static str) {
    match what {
        Derivative::Velocity => ("velocity", 1, "P-AXIS-00439", "P-AXIS-00440"),
        Derivative::Acceleration => ("acceleration", 2, "P-AXIS-00441", "P-AXIS-00442"),
        Derivative::Jerk => ("jerk", 3, "P-AXIS-00443", "P-AXIS-00444"),
    }
}

/// Unit of a derivative of a position in `mm` or `deg`.
fn per_s(unit: &str, order: usize) -> &'static str {
    const LINEAR: [&str; 4] = ["mm", "mm/s", "mm/s2", "mm/s3"];
    const ROTARY: [&str; 4] = ["deg", "deg/s", "deg/s2", "deg/s3"];
    if unit == "deg" { ROTARY[order] } else { LINEAR[order] }
}

/// The plant of an axis cannot be simulated.
pub(super) fn plant(error: &PlantError, machine: &Machine, chain: usize) -> Diagnostic {
    let name = machine.all_axes().nth(chain).map_or("?", |a| a.name());
    Diagnostic::kontur(70, format!("plant of axis {name}: {error}"))
        .severity(crate::diag::Severity::Error)
}

/// A condition that the look-ahead excludes.
pub(super) fn internal(error: &Infeasible) -> Diagnostic {
    Diagnostic::kontur(82, format!("look-ahead: {error}")).hint(
        "this is an error of kontur itself; the program and the machine lists help to find it",
    )
}

/// A kernel that was to be swapped while the axis still moves.
pub(super) fn switch_while_moving() -> Diagnostic {
    Diagnostic::kontur(82, "filter kernel not switched: the axis still moves")
}

/// The program time is used up.
pub(super) fn out_of_time(k: u64, cycle: CycleTime, max_cycles: u64) -> Diagnostic {
    let mut d = Diagnostic::kontur(
        17,
        format!("program time exceeds {} s: the run was stopped", cycle.time_of(max_cycles)),
    )
    .hint("raise the limit with --max-time");
    d.cycle = Some(k);
    d.time_s = Some(cycle.time_of(k));
    d
}

/// Nothing will ever release the path.
pub(super) fn held(k: u64, cycle: CycleTime, feedhold: bool) -> Diagnostic {
    let (what, release) =
        if feedhold { ("feedhold", "feedhold 0") } else { ("override 0", "an override") };
    let text =
        format!("the path is held by {what} and no later input releases it: the run was stopped");
    let mut d = Diagnostic::kontur(83, text).hint(format!("give {release} a later time stamp"));
    d.cycle = Some(k);
    d.time_s = Some(cycle.time_of(k));
    d
}

impl Simulation {
    /// K-0022, each place once.
    pub(super) fn switched_while_moving(&mut self) {
        let (id, at) = (22, self.current);
        if self.smoothing.is_new(id, at) {
            let v = self.record.path.v_mm_s;
            let text = format!(
                "feedforward is switched or weighted at the path speed {v:.3} mm/s: the speed command jumps"
            );
            let mut d = Diagnostic::kontur(22, text).value(ValueKind::Current, v, "mm/s");
            d.cycle = Some(self.record.k + 1);
            d.time_s = Some(self.cycle.time_of(self.record.k + 1));
            d.source = self.executor.locate(at);
            self.diagnostics.push(d);
        }
    }

    /// The tolerance of a block could not be kept.
    pub(super) fn unkept(&mut self, unkept: &Unkept) -> Diagnostic {
        let mut d = Diagnostic::kontur(
            80,
            format!(
                "deviation {:.6} mm exceeds AX_DEV {:.6} mm and could not be lowered further",
                unkept.deviation_mm, unkept.tolerance_mm
            ),
        )
        .value(ValueKind::Current, unkept.deviation_mm, "mm")
        .value(ValueKind::Limit, unkept.tolerance_mm, "mm")
        .hint("axes with unequal filters cannot keep a tolerance; program MODE, FREQ and DAMPING");
        let source =
            self.underway.iter().find(|u| u.seq == unkept.seq).map_or(self.current, |u| u.source);
        d.source = self.executor.locate(source);
        d
    }

    /// Reports the corners that were not contoured as asked for, each place once.
    pub(super) fn not_contoured(&mut self) {
        for notice in self.smoothing.take_notices() {
            let text = match notice.reason {
                NoContour::BlockTooShort => "a block is too short for contouring",
                NoContour::DeviationTooSmall { .. } => "PATH_DEV is below the minimum",
                NoContour::DistanceTooSmall { .. } => "a corner distance is below the minimum",
                NoContour::NotPossible => "contouring is not possible at the end of this block",
                NoContour::FeedGroup => "the feed group changes behind this block",
                // at a stop there is no corner to round; MAX_ANGLE asks for it; the executor tells about the mode
                NoContour::NothingFollows
                | NoContour::AngleAboveMaximum { .. }
                | NoContour::ModeReplaced => continue,
            };
            let Some(id) = notice.id() else { continue };
            let source = self
                .underway
                .iter()
                .find(|u| u.seq == notice.seq)
                .map_or(self.current, |u| u.source);
            if self.smoothing.is_new(id, source) {
                // Assumption: the run goes on, with the corner as programmed, where the control would abort
                let mut d =
                    Diagnostic::vendor(id, format!("{text}: the corner stays as programmed"))
                        .severity(crate::diag::Severity::Warning);
                d.source = self.executor.locate(source);
                self.diagnostics.push(d);
            }
        }
    }
}
