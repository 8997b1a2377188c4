//! What goes wrong while the machine runs: messages and reactions.
//!
//! Reaction classes (TF5200 diagnosis manual): 1 a message; 4, 6, 7, 8 and 5 end the program - the axis concerned stops
//! where it is (5, 6, 8) or with the others (4, 7), the others brake along the path with P-AXIS-00003.

use super::{Phase, Simulation};
use crate::diag::{Diagnostic, ValueKind};
use crate::machine::{AxisKind, Machine};
use kontur_filters::control::fault::{Derivative, ErrorId, Fault, Reaction};
use kontur_filters::control::plant::PlantError;
use kontur_filters::time::CycleTime;
use kontur_motion::contouring::NoContour;
use kontur_motion::profile::Infeasible;
use kontur_motion::tolerance::Unkept;

/// Cycles of standstill shown behind the stop of a fault.
pub(super) const CYCLES_AT_REST: u32 = 5;

impl Simulation {
    /// A fault of one axis: message, and from class 4 on the end of the run.
    pub(super) fn fault(&mut self, chain: usize, fault: &Fault) {
        let diagnostic = self.describe(chain, fault);
        self.diagnostics.push(diagnostic);
        let reaction = fault.reaction();
        if reaction == Reaction::None {
            return;
        }
        self.totals.aborted = true;
        let frozen = match reaction {
            Reaction::AbruptStop | Reaction::OpenLoopStop => chain..chain + 1,
            Reaction::AllStop => 0..self.chains.len(),
            _ => 0..0,
        };
        for i in frozen {
            let here = self.record.axes[i].ipo;
            self.frozen[i].get_or_insert(here);
        }
        if !matches!(self.phase, Phase::Stopping { .. }) {
            self.planner.brake();
            self.phase = Phase::Stopping { settled_cycles: 0 };
        }
    }

    fn describe(&mut self, chain: usize, fault: &Fault) -> Diagnostic {
        let axis = self.machine.all_axes().nth(chain);
        let (name, number) = axis.map_or(("?", 0), |a| (a.name(), a.number()));
        let spindle = axis.is_some_and(|a| a.kind() == AxisKind::Spindle);
        let base = |text: String| match fault.id() {
            // spindles have numbers of their own for the same
            ErrorId::Vendor(50118) if spindle => Diagnostic::vendor(60101, text),
            ErrorId::Vendor(50119) if spindle => Diagnostic::vendor(60102, text),
            ErrorId::Vendor(n) => Diagnostic::vendor(n, text),
            ErrorId::Kontur(n) => Diagnostic::kontur(n, text),
        };
        let diagnostic = match *fault {
            Fault::FollowingError { lag_mm, limit_mm } => {
                base(format!("following error {lag_mm:.4} mm exceeds {limit_mm:.4} mm, axis {name}"))
                    .value(ValueKind::Current, lag_mm, "mm")
                    .value(ValueKind::Limit, limit_mm, "mm")
                    .parameter("P-AXIS-00172")
                    .hint("raise slep_max, use feedforward (G135), or lower the feed")
            }
            Fault::SettlingTimeout { lag_mm, window_mm, time_s } => base(format!(
                "distance {lag_mm:.4} mm to the target after {time_s:.6} s is outside the exact-stop window of {window_mm:.4} mm, axis {name}"
            ))
            .value(ValueKind::Current, lag_mm, "mm")
            .value(ValueKind::Limit, window_mm, "mm")
            .value(ValueKind::Limit, time_s, "s")
            .parameter("P-AXIS-00236")
            .hint("raise position_settling_time (P-AXIS-00532) or window, or the gain kv"),
            Fault::ControllerSpeed { speed_mm_s, limit_mm_s } => base(format!(
                "speed command {speed_mm_s:.3} mm/s exceeds {limit_mm_s:.3} mm/s, axis {name}"
            ))
            .value(ValueKind::Current, speed_mm_s, "mm/s")
            .value(ValueKind::Limit, limit_mm_s, "mm/s")
            .parameter("P-AXIS-00407"),
            Fault::SetpointWarning { what, value, limit } => {
                let (quantity, unit, parameter, _) = watched(what);
                base(format!("{quantity} of the set position {value:.3} {unit} exceeds {limit:.3} {unit}, axis {name}"))
                    .value(ValueKind::Current, value, unit)
                    .value(ValueKind::Limit, limit, unit)
                    .parameter(parameter)
            }
            Fault::SetpointError { what, value, limit } => {
                let (quantity, unit, _, parameter) = watched(what);
                base(format!("{quantity} of the set position {value:.3} {unit} exceeds {limit:.3} {unit}, axis {name}"))
                    .value(ValueKind::Current, value, unit)
                    .value(ValueKind::Limit, limit, unit)
                    .parameter(parameter)
                    .hint("lower the dynamics, or raise the threshold if a filter overshoots")
            }
            Fault::Unstable { lag_mm, limit_mm } => base(format!(
                "following error {lag_mm:.3} mm beyond {limit_mm:.3} mm: the simulated axis {name} is unstable"
            ))
            .value(ValueKind::Current, lag_mm, "mm")
            .value(ValueKind::Limit, limit_mm, "mm")
            .parameter("P-AXIS-00099")
            .hint("lower the gain kv or the weights of Improved Position Control"),
            _ => base(format!("parameters of Improved Position Control changed while axis {name} moves")),
        };
        let mut diagnostic = diagnostic.axis(number, name);
        diagnostic.cycle = Some(self.record.k);
        diagnostic.time_s = Some(self.cycle.time_of(self.record.k));
        diagnostic.source = self.executor.locate(self.current);
        diagnostic
    }
}

/// Quantity, unit and the parameters of warning and error.
const fn watched(what: Derivative) -> (&'static str, &'static str, &'static str, &'static str) {
    match what {
        Derivative::Velocity => ("velocity", "mm/s", "P-AXIS-00439", "P-AXIS-00440"),
        Derivative::Acceleration => ("acceleration", "mm/s2", "P-AXIS-00441", "P-AXIS-00442"),
        Derivative::Jerk => ("jerk", "mm/s3", "P-AXIS-00443", "P-AXIS-00444"),
    }
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
