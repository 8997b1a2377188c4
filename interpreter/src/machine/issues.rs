//! Issues of the configuration of filters and controller, as diagnostics with axis, parameter and position.
//!
//! The text has the order quantity, value, limit, axis, parameter; then the effect.

mod control;

pub(crate) use control::control;

use super::Axis;
use super::kind::AxisKind;
use super::table::axis_filters::FilterParameters;
use super::table::axis_guard;
use super::table::param::Place;
use crate::diag::{Condition, Diagnostic, Named, Severity, ValueKind};
use kontur_filters::{
    issue::{Effect, FilterIssue},
    time::CycleTime,
    vib_guard::{VibGuardError, VibGuardSettings},
};

/// A diagnostic about one parameter of an axis: what was found, and its effect.
pub(super) fn about(
    axis: &Axis,
    condition: Condition,
    param: impl Into<Place>,
    what: &str,
    effect: &str,
) -> Diagnostic {
    let place = axis.place(param);
    let named = place.id().map_or_else(|| place.to_string(), |id| format!("{place} ({id})"));
    let text = format!("{what}, axis {}, {named}: {effect}", axis.name());
    let mut diagnostic =
        Diagnostic::new(condition, text).axis(axis.number(), axis.name()).parameter(place);
    diagnostic.source = axis.set_by(place).and_then(|setting| setting.at.clone());
    diagnostic
}

/// [`about`] a parameter of the list; `None` for the words of a program, whose position is added by the executor.
fn listed_or_programmed(
    axis: &Axis,
    condition: Condition,
    place: Option<Place>,
    what: &str,
    effect: &str,
) -> Diagnostic {
    if let Some(place) = place {
        return about(axis, condition, place, what, effect);
    }
    let text = format!("{what}, axis {}: {effect}", axis.name());
    Diagnostic::new(condition, text).axis(axis.number(), axis.name())
}

/// The condition of a filter's settings.
pub const fn filter_condition(issue: &FilterIssue) -> Condition {
    match issue {
        FilterIssue::TypeNotPermitted { .. } => Condition::FilterType,
        FilterIssue::SecondHsc => Condition::SecondHsc,
        FilterIssue::HscNotFirst => Condition::HscNotFirst,
        FilterIssue::HscPrototype => Condition::FilterHscPrototype,
        FilterIssue::HscOnSpindle => Condition::FilterHscSpindle,
        FilterIssue::HscOnInterface => Condition::FilterHscInterface,
        FilterIssue::TimeConstant { .. } => Condition::FilterTime,
        FilterIssue::OrderTimeBelowCycle { .. } => Condition::FilterTimeBelowCycle,
        FilterIssue::OrderTooHigh { .. } => Condition::FilterOrderTooHigh,
        FilterIssue::OrderCorrected { .. } => Condition::FilterOrderFixed,
        FilterIssue::NoOrder => Condition::FilterWithoutOrder,
        FilterIssue::FrequencyTooLow { .. } => Condition::FilterFrequencyTooLow,
        FilterIssue::Frequency { .. } | FilterIssue::Quality { .. } | FilterIssue::Share { .. } => {
            Condition::FilterRange
        }
        FilterIssue::ShareOfDelay => Condition::ListNoEffect,
        FilterIssue::AllPassNotBessel => Condition::FilterAllPass,
        FilterIssue::RemovesConstantPart => Condition::FilterConstantPart,
    }
}

/// The condition of settings without a Vibration Guard kernel.
const fn guard_condition(error: &VibGuardError) -> Condition {
    match error {
        VibGuardError::Mode { .. } => Condition::GuardMode,
        VibGuardError::Frequency { .. } | VibGuardError::Damping { .. } => Condition::GuardRange,
        VibGuardError::NotRealisable { .. } => Condition::GuardNotRealisable,
    }
}

/// What becomes of a filter.
const fn outcome(effect: Effect) -> &'static str {
    match effect {
        Effect::Note => "the filter runs as configured",
        Effect::Corrected => "the filter runs with the corrected value",
        Effect::Off => "the filter is off",
    }
}

/// A condition of a filter's settings, with its values; `keys` of the list, `None` for the words of a program.
pub(crate) fn filter(
    axis: &Axis,
    keys: Option<&FilterParameters>,
    issue: &FilterIssue,
) -> Diagnostic {
    let condition = match filter_condition(issue) {
        // spindles have a separate number for this condition
        Condition::FilterTime if axis.kind() == AxisKind::Spindle => Condition::SpindleFilterTime,
        condition => condition,
    };
    let effect = issue.effect();
    let what = issue.to_string();
    let about = |place: fn(&FilterParameters) -> Place| {
        listed_or_programmed(axis, condition, keys.map(place), &what, outcome(effect))
    };
    let diagnostic = match *issue {
        FilterIssue::TypeNotPermitted { number } => {
            about(|k| k.kind.place()).value(ValueKind::Wrong, number, "-")
        }
        FilterIssue::SecondHsc
        | FilterIssue::HscNotFirst
        | FilterIssue::HscPrototype
        | FilterIssue::HscOnSpindle
        | FilterIssue::AllPassNotBessel => about(|k| k.prototype.place()),
        FilterIssue::HscOnInterface | FilterIssue::RemovesConstantPart => about(|k| k.kind.place()),
        FilterIssue::TimeConstant { time_constant_us, min_us, max_us } => about(|k| k.time.place())
            .value(ValueKind::Wrong, time_constant_us, "us")
            .value(ValueKind::LowerLimit, min_us, "us")
            .value(ValueKind::UpperLimit, max_us, "us"),
        FilterIssue::OrderTimeBelowCycle { order_time_us, cycle_us } => about(|k| k.time.place())
            .value(ValueKind::Wrong, order_time_us, "us")
            .value(ValueKind::LowerLimit, cycle_us, "us"),
        FilterIssue::OrderTooHigh { order, used } | FilterIssue::OrderCorrected { order, used } => {
            about(|k| k.order.place())
                .value(ValueKind::Wrong, order, "-")
                .value(ValueKind::Corrected, used, "-")
                .corrected(used)
        }
        FilterIssue::NoOrder => about(|k| k.order.place()).value(ValueKind::Wrong, 0.0, "-"),
        FilterIssue::FrequencyTooLow { f_hz, used_hz } => about(|k| k.frequency.place())
            .value(ValueKind::Wrong, f_hz, "Hz")
            .value(ValueKind::Corrected, used_hz, "Hz")
            .corrected(used_hz),
        FilterIssue::Frequency { f_hz, min_hz, max_hz } => about(|k| k.frequency.place())
            .value(ValueKind::Wrong, f_hz, "Hz")
            .value(ValueKind::LowerLimit, min_hz, "Hz")
            .value(ValueKind::UpperLimit, max_hz, "Hz"),
        FilterIssue::Quality { quality, .. } => {
            about(|k| k.quality.place()).value(ValueKind::Wrong, quality, "-")
        }
        FilterIssue::ShareOfDelay => about(|k| k.share.place()),
        FilterIssue::Share { share_ratio } => {
            about(|k| k.share.place()).value(ValueKind::Wrong, 100.0 * share_ratio, "%")
        }
    };
    match other_severity(keys.is_some(), effect) {
        Some(severity) => diagnostic.severity(severity),
        None => diagnostic,
    }
}

/// The severity of a condition in a list or in a program where it is not that of its row.
const fn other_severity(in_list: bool, effect: Effect) -> Option<Severity> {
    match (in_list, effect) {
        (false, Effect::Note) => Some(Severity::Note),
        // in a list, as documented: that part is off, and the run continues
        (false, Effect::Corrected) | (true, Effect::Off) => Some(Severity::Warning),
        (false, Effect::Off) | (true, _) => None,
    }
}

/// Whether a filter, or Improved Position Control, is off although a list describes it, because it cannot be built.
pub(crate) fn leaves_out(diagnostic: &Diagnostic) -> bool {
    [
        Condition::FilterType,
        Condition::SecondHsc,
        Condition::HscNotFirst,
        Condition::FilterHscPrototype,
        Condition::FilterHscSpindle,
        Condition::FilterHscInterface,
        Condition::FilterTime,
        Condition::SpindleFilterTime,
        Condition::FilterTimeBelowCycle,
        Condition::FilterWithoutOrder,
        Condition::FilterRange,
        Condition::GuardNotRealisable,
        Condition::IpcRange,
        Condition::IpcNumerator,
        Condition::IpcDenominator,
        Condition::IpcNoInput,
    ]
    .iter()
    .any(|condition| diagnostic.id == *condition)
}

/// Why an axis has no Vibration Guard, with the values; `listed`: configured by the axis list, otherwise by words of a
/// program.
pub(crate) fn vib_guard(
    axis: &Axis,
    listed: bool,
    error: &VibGuardError,
    cycle: CycleTime,
) -> Diagnostic {
    let condition = guard_condition(error);
    let becomes = "the Vibration Guard is off";
    let what = error.to_string();
    let about = |place: Place| {
        listed_or_programmed(axis, condition, listed.then_some(place), &what, becomes)
    };
    let [mode, frequency, damping] =
        [axis_guard::MODE.place(), axis_guard::FREQUENCY.place(), axis_guard::DAMPING.place()];
    match *error {
        VibGuardError::Mode { mode: wrong } => {
            about(mode).value(ValueKind::Wrong, u32::from(wrong), "-")
        }
        VibGuardError::Frequency { freq_hz } => {
            about(frequency).value(ValueKind::Wrong, freq_hz, "Hz")
        }
        VibGuardError::Damping { damping: wrong } => {
            about(damping).value(ValueKind::Wrong, wrong, "-")
        }
        VibGuardError::NotRealisable { freq_hz, damping: given } => {
            let place = if given > VibGuardSettings::MAX_DAMPING { damping } else { frequency };
            let about = about(place);
            // an entry of a list that cannot be built is left out and the machine runs without it; a command is refused
            let about = if listed { about.severity(Severity::Warning) } else { about };
            about.value(ValueKind::Wrong, freq_hz, "Hz").value(ValueKind::Wrong, given, "-").value(
                ValueKind::Limit,
                cycle.us(),
                "us",
            )
        }
    }
}
