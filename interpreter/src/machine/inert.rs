//! Parameters that change what a control does and are not simulated: a list that sets one to something else than its default gets
//! a message, so that nobody takes the trace for that of the control.

use super::parameters::Parameters;
use super::plausible::finish;
use super::table::param::Param;
use super::table::{Default, axis_general};
use super::value::Value;
use crate::diag::{AxisRef, Condition, Diagnostic};

/// ID, and what happens in its place.
///
/// Source: TF5200 axis and channel parameters.
const INERT: &[(&str, &str)] = &[
    ("P-AXIS-00202", "the acceleration of a spindle does not depend on its speed"),
    (
        "P-AXIS-00520",
        "set positions are checked against the software limits in the preparation alone",
    ),
    ("P-AXIS-00833", "the drive weights no velocity feedforward of its own"),
    ("P-CHAN-00141", "the jerk on curves is checked as with 1"),
    ("P-CHAN-00259", "contouring rounds arcs as with 0"),
];

/// K-0075 for every such parameter that a list changes.
pub(super) fn check(
    parameters: &Parameters,
    axis: Option<&AxisRef>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for (indices, setting) in parameters.settings() {
        let row = setting.row;
        let Some((_, instead)) = INERT.iter().find(|(id, _)| *id == row.id) else { continue };
        if matches!((&setting.value, row.default), (Value::Number(x), Default::Number(d)) if x.to_bits() == d.to_bits())
        {
            continue;
        }
        let key = super::table::with_indices(row.key, indices);
        let text = format!("{key} is not simulated: {instead}");
        let diagnostic = Diagnostic::new(Condition::ListNoEffect, text)
            .hint("the trace may differ from that of the control");
        diagnostics.push(finish(diagnostic, row, setting.at.clone(), axis));
    }
    let behaviour = axis_general::LIMIT_BEHAVIOUR;
    if let Some(setting) = limit_in_controller(parameters, behaviour) {
        let text = format!(
            "{}: ERROR_LR acts as ERROR, a position outside the software limits ends the program",
            behaviour.place()
        );
        let diagnostic = Diagnostic::new(Condition::ListNoEffect, text)
            .hint("WARNING lets the program run and the axis cross the limit");
        diagnostics.push(finish(diagnostic, setting.row, setting.at.clone(), axis));
    }
}

/// What sets P-AXIS-00554 to the reaction of the position controller.
fn limit_in_controller<'a>(
    parameters: &'a Parameters,
    behaviour: Param<super::table::param::Text>,
) -> Option<&'a super::parameters::Setting> {
    let setting = parameters.set_by(behaviour)?;
    matches!(&setting.value, Value::Text(word) if word == "ERROR_LR").then_some(setting)
}
