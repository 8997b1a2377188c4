//! Parameters that change the behaviour of a control but are not simulated: if a list sets one to a value other than
//! its default, a message says so, lest the trace be mistaken for that of the control.

use super::parameters::Parameters;
use super::plausible::finish;
use super::table::{axis_general, with_indices};
use super::value::Value;
use crate::diag::{AxisRef, Condition, Diagnostic};

/// ID, and what is done instead.
///
/// Source: TF5200 axis, channel, start-up and tool parameters, axis compensation, friction compensation.
const INERT: &[(&str, &str)] = &[
    ("P-AXIS-00021", "the backlash (P-AXIS-00103) is not compensated at reversal"),
    ("P-AXIS-00047", "cross compensation is not added to the set position"),
    ("P-AXIS-00174", "plane compensation is not added to the set position"),
    ("P-AXIS-00175", "leadscrew error compensation is not added to the set position"),
    ("P-AXIS-00179", "actual positions are not checked against the software limits"),
    ("P-AXIS-00202", "the acceleration of a spindle does not depend on its speed"),
    ("P-AXIS-00224", "the spindle turns in both directions"),
    ("P-AXIS-00231", "the sign of the drive command is not changed"),
    ("P-AXIS-00271", "temperature compensation is not added to the set position"),
    ("P-AXIS-00431", "the limits of the axis do not depend on the length of a motion"),
    ("P-AXIS-00438", "lr_param.add_interface.filter[0] filters the additional interface"),
    (
        "P-AXIS-00520",
        "set positions are checked against the software limits only during preparation",
    ),
    ("P-AXIS-00522", "friction is not compensated"),
    ("P-AXIS-00789", "crosstalk between axes is not compensated"),
    ("P-AXIS-00833", "the drive does not weight the velocity feedforward"),
    (
        "P-STUP-00018",
        "programs and subroutines are searched for next to the main program and in the folders of --path",
    ),
    ("P-CHAN-00004", "S words do not change the gear"),
    ("P-CHAN-00016", "D uses the data of the tool list"),
    (
        "P-CHAN-00052",
        "M40 to M45 do not change the gear, the spindle keeps the limits of the first gear",
    ),
    ("P-CHAN-00069", "the spindle turns like a spindle of the control"),
    ("P-CHAN-00141", "the jerk on curves is checked as with 1"),
    ("P-CHAN-00190", "the limits do not depend on the length of a motion"),
    ("P-CHAN-00230", "the limits do not depend on the radius of an arc"),
    ("P-CHAN-00259", "contouring treats arcs as with 0"),
    ("P-CHAN-00261", "there is only one path"),
];

/// What is done instead of the function of a parameter that is not simulated.
pub(crate) fn instead_of(id: &str) -> Option<&'static str> {
    INERT.iter().find(|(inert, _)| *inert == id).map(|(_, instead)| *instead)
}

/// K-0075 for every such parameter that a list changes.
pub(super) fn check(
    parameters: &Parameters,
    axis: Option<&AxisRef>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for (indices, setting) in parameters.settings() {
        let row = setting.row;
        let Some(instead) = instead_of(row.id) else { continue };
        // a refused value has already been reported
        let is_refused =
            |d: &Diagnostic| d.is_error() && d.parameter == Some(row.id) && d.source == setting.at;
        if !setting.is_changed() || diagnostics.iter().any(is_refused) {
            continue;
        }
        let key = with_indices(row.key, indices);
        let text = format!("{key} is not simulated: {instead}");
        let diagnostic = Diagnostic::new(Condition::ListNoEffect, text)
            .hint("the trace may differ from that of the control");
        diagnostics.push(finish(diagnostic, row, setting.at.clone(), axis));
    }
    let behaviour = axis_general::LIMIT_BEHAVIOUR;
    let in_controller = Value::Text("ERROR_LR".to_owned());
    if let Some(setting) = parameters.set_by(behaviour).filter(|s| s.value == in_controller) {
        let text = format!(
            "{}: ERROR_LR acts as ERROR, a position outside the software limits ends the program",
            behaviour.place()
        );
        let diagnostic = Diagnostic::new(Condition::ListNoEffect, text)
            .hint("WARNING lets the program run and the axis cross the limit");
        diagnostics.push(finish(diagnostic, setting.row, setting.at.clone(), axis));
    }
}
