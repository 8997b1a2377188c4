//! Checks of single entries of a channel list in addition to their ranges.

use super::finish;
use crate::diag::{Condition, Diagnostic, ValueKind};
use crate::machine::parameters::{Parameters, Setting};
use crate::machine::table::param::{Optional, Param, whole};
use crate::machine::table::{Indices, channel, with_indices};
use crate::machine::value::Value;

/// Runs all of them.
pub(in crate::machine) fn check(parameters: &mut Parameters, diagnostics: &mut Vec<Diagnostic>) {
    check_feed_unit(parameters, diagnostics);
    check_presets(parameters, diagnostics);
    check_rapid_override(parameters, diagnostics);
    check_several_words(parameters, diagnostics);
    check_durations(parameters, diagnostics);
    check_synchronisation(parameters, diagnostics);
    check_unexecuted(parameters, diagnostics);
}

/// The synchronisation of functions, and their durations.
const DURATIONS: [(Param<Optional>, Param<Optional>); 7] = [
    (channel::M_SYNCHRONISATION, channel::M_DURATION),
    (channel::H_SYNCHRONISATION, channel::H_DURATION),
    (channel::SPINDLE_M3_SYNCHRONISATION, channel::SPINDLE_M3_DURATION),
    (channel::SPINDLE_M4_SYNCHRONISATION, channel::SPINDLE_M4_DURATION),
    (channel::SPINDLE_M5_SYNCHRONISATION, channel::SPINDLE_M5_DURATION),
    (channel::SPINDLE_M19_SYNCHRONISATION, channel::SPINDLE_M19_DURATION),
    (channel::SPINDLE_SPEED_SYNCHRONISATION, channel::SPINDLE_SPEED_DURATION),
];

/// 20760: functions with MOS have no duration. Source: TF5200 diagnosis 252456075.
fn check_durations(parameters: &mut Parameters, diagnostics: &mut Vec<Diagnostic>) {
    let without_acknowledgement = parameters.settings().filter_map(|(i, setting)| {
        let mut rows = DURATIONS.iter();
        let (_, duration) =
            rows.find(|(synchronisation, _)| synchronisation.place().row.key == setting.row.key)?;
        let bits = setting.value.number().and_then(whole)?;
        let place = duration.at(i[0]).place();
        let us = parameters.listed(duration.at(i[0])).filter(|us| *us > 0.0)?;
        (bits == channel::WITHOUT_ACKNOWLEDGEMENT).then_some((place, us))
    });
    for (place, us) in without_acknowledgement.collect::<Vec<_>>() {
        let text = format!("{place}: nothing waits for a function with MOS, 0 is used");
        let at = parameters.set_by(place).and_then(|setting| setting.at.clone());
        let diagnostic = Diagnostic::new(Condition::DurationWithoutSync, text)
            .value(ValueKind::Wrong, us, "us")
            .value(ValueKind::Corrected, 0.0, "us")
            .corrected(0.0);
        parameters.set(place.row, place.indices, Value::Number(0.0), at.clone());
        diagnostics.push(finish(diagnostic, place.row, at, None));
    }
}

/// Group of G135, G136 and G137 (P-CHAN-00063).
const FEEDFORWARD_GROUP: u32 = 21;

/// K-0075: every program starts with G137, whatever P-CHAN-00063 presets for the group of the feedforward.
fn check_presets(parameters: &Parameters, diagnostics: &mut Vec<Diagnostic>) {
    let preset = channel::G_GROUP.at(FEEDFORWARD_GROUP);
    let Some(setting) = parameters.set_by(preset) else { return };
    if setting.value.number().and_then(whole) != Some(135) {
        return;
    }
    let text = format!(
        "{}: a preset of G135 has no effect, programs start with feedforward off",
        preset.place()
    );
    let hint =
        "use vorsteuer.default_active (P-AXIS-00255) in the axis list to keep feedforward on";
    let diagnostic = Diagnostic::new(Condition::ListNoEffect, text).hint(hint);
    diagnostics.push(finish(diagnostic, setting.row, setting.at.clone(), None));
}

/// K-0070: P-CHAN-00108 has two units.
///
/// Assumption: any other value becomes 100, as the page says for 0; it gives no unit for values in between.
fn check_feed_unit(parameters: &mut Parameters, diagnostics: &mut Vec<Diagnostic>) {
    let place = channel::FEED_UNIT.place();
    let Some(setting) = parameters.set_by(place).cloned() else { return };
    let Some(value) = setting.value.number() else { return };
    if [0.1_f64, 100.0, -1.0].iter().any(|unit| unit.total_cmp(&value).is_eq()) {
        return;
    }
    let text = format!("{place}: {value} is neither 100 (mm/min) nor 0.1 (m/min), 100 is used");
    let diagnostic = Diagnostic::new(Condition::ListRange, text)
        .value(ValueKind::Wrong, value, "-")
        .value(ValueKind::Corrected, 100.0, "-")
        .corrected(100.0);
    parameters.set(place.row, place.indices, Value::Number(100.0), setting.at.clone());
    diagnostics.push(finish(diagnostic, place.row, setting.at, None));
}

/// K-0075: ACTIVE_EXTENDED of P-CHAN-00181 acts as ACTIVE.
fn check_rapid_override(parameters: &Parameters, diagnostics: &mut Vec<Diagnostic>) {
    let Some(setting) = parameters.set_by(channel::RAPID_OVERRIDE) else { return };
    if setting.value.number().and_then(whole) != Some(3) {
        return;
    }
    let text = format!(
        "{}: ACTIVE_EXTENDED acts as ACTIVE, measuring runs and homing follow the feed override",
        channel::RAPID_OVERRIDE.place()
    );
    let hint = "rapid_override_percent of --input only acts on G00";
    let diagnostic = Diagnostic::new(Condition::ListNoEffect, text).hint(hint);
    diagnostics.push(finish(diagnostic, setting.row, setting.at.clone(), None));
}

/// 21404: P-CHAN-00148 is effective only with P-CHAN-00116. Source: TF5200 diagnosis 254536331.
fn check_several_words(parameters: &mut Parameters, diagnostics: &mut Vec<Diagnostic>) {
    let place = channel::SEVERAL_WORDS.place();
    if !parameters.get(channel::SEVERAL_WORDS) || parameters.get(channel::SEVERAL_DIMENSIONS) {
        return;
    }
    let Some(setting) = parameters.set_by(place).cloned() else { return };
    let text =
        format!("{place}: no effect without {}, 0 is used", channel::SEVERAL_DIMENSIONS.place());
    let diagnostic = Diagnostic::new(Condition::WordsWithoutDimensions, text)
        .value(ValueKind::Wrong, 1, "-")
        .value(ValueKind::Corrected, 0, "-")
        .corrected(0.0);
    parameters.set(place.row, place.indices, Value::Number(0.0), setting.at.clone());
    diagnostics.push(finish(diagnostic, place.row, setting.at, None));
}

/// K-0075: the simulated PLC acknowledges every function at once, so the path does not wait as in P-CHAN-00041 and
/// 00027.
fn check_synchronisation(parameters: &Parameters, diagnostics: &mut Vec<Diagnostic>) {
    // for spindle functions the path does wait
    let simulated = channel::BEFORE_MOTION | channel::DURING_MOTION | channel::BEHIND_MOTION;
    // edge banding has separate messages
    let elsewhere = channel::ELSEWHERE.iter().map(|(kind, _, _)| kind);
    let elsewhere = elsewhere.filter(|kind| **kind != channel::AT_SIGNAL);
    let waiting = elsewhere.fold(simulated, |bits, kind| bits | kind);
    // a declared duration is waited for, or listed in the summary
    let is_missing = |(i, setting): &(Indices, &Setting)| {
        let mut rows = DURATIONS.iter();
        let row =
            rows.find(|(synchronisation, _)| synchronisation.place().row.key == setting.row.key);
        row.is_some_and(|(_, duration)| {
            let of_spindle = setting.row.key.starts_with("spindel");
            let not_simulated = if of_spindle { waiting & !simulated } else { waiting };
            let bits = setting.value.number().and_then(whole);
            bits.is_some_and(|bits| bits & not_simulated != 0)
                && parameters.listed(duration.at(i[0])).is_none_or(|us| us <= 0.0)
        })
    };
    let Some((i, setting)) = parameters.settings().find(is_missing) else { return };
    let text = format!(
        "{}: the acknowledgement of functions takes no time, the path does not wait for it",
        with_indices(setting.row.key, i)
    );
    let hint = "use m_prozess_zeit and the related times (P-CHAN-00040, 00026, 00044) with --techno-times to make the path wait for functions";
    let diagnostic = Diagnostic::new(Condition::ListNoEffect, text).hint(hint);
    diagnostics.push(finish(diagnostic, setting.row, setting.at.clone(), None));
}

/// K-0075: with NO_SYNCH the control does not execute M3, M4 and M5 of a spindle (208029963).
///
/// Assumption: a list without an entry does not mean that, although NO_SYNCH is printed as its default: no spindle would turn.
fn check_unexecuted(parameters: &Parameters, diagnostics: &mut Vec<Diagnostic>) {
    let turning = [
        channel::SPINDLE_M3_SYNCHRONISATION,
        channel::SPINDLE_M4_SYNCHRONISATION,
        channel::SPINDLE_M5_SYNCHRONISATION,
    ];
    let unexecuted = |(_, setting): &(Indices, &Setting)| {
        turning.iter().any(|synch| synch.place().row.key == setting.row.key)
            && setting.value.number().and_then(whole) == Some(0)
    };
    let Some((i, setting)) = parameters.settings().find(unexecuted) else { return };
    let text = format!(
        "{}: with NO_SYNCH the control does not execute the function, here the spindle obeys it",
        with_indices(setting.row.key, i)
    );
    let hint = "write MOS, or the synchronisation of the machine";
    let diagnostic = Diagnostic::new(Condition::ListNoEffect, text).hint(hint);
    diagnostics.push(finish(diagnostic, setting.row, setting.at.clone(), None));
}
