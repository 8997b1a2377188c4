//! Messages about the running machine.

pub(super) mod text;

use super::inputs::SpeedChange;
use crate::diag::{Condition, Diagnostic, Severity, ValueKind, rounded};
use crate::machine::Machine;
use kontur_filters::control::plant::PlantError;
use kontur_filters::time::CycleTime;
use kontur_motion::deviation::Unkept;

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
