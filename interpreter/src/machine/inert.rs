//! Parameters that change the behaviour of a control but are not simulated: if a list sets one to a value other than
//! its default, a message says so, lest the trace be mistaken for that of the control.

use super::kind::{AxisKind, kind_of, mode};
use super::parameters::{Parameters, Setting};
use super::plausible::finish;
use super::table::param::{Place, whole};
use super::table::{ListKind, axis_functions, axis_general, channel, start_up, with_indices};
use super::value::Value;
use crate::diag::{AxisRef, Condition, Diagnostic};

/// What such a message warns of.
const HINT: &str = "the trace may differ from that of the control";

/// ID, and what is done instead.
///
/// Source: TF5200 axis, channel, start-up and tool parameters, axis compensation, friction compensation.
const INERT: &[(&str, &str)] = &[
    ("P-AXIS-00021", "the backlash (P-AXIS-00103) is not compensated at reversal"),
    ("P-AXIS-00043", "the axes of a collision pair are not stopped before they meet"),
    ("P-AXIS-00047", "cross compensation is not added to the set position"),
    ("P-AXIS-00071", "differences between gantry axes are not monitored"),
    ("P-AXIS-00072", "differences between gantry axes are not monitored"),
    ("P-AXIS-00073", "a gantry slave has the set position of its master"),
    ("P-AXIS-00113", "the probe signals at its rising edge"),
    ("P-AXIS-00114", "a measuring run without a signal ends at its target"),
    ("P-AXIS-00120", "the modulo circle has no error to be compensated"),
    ("P-AXIS-00174", "plane compensation is not added to the set position"),
    ("P-AXIS-00175", "leadscrew error compensation is not added to the set position"),
    ("P-AXIS-00202", "the acceleration of a spindle does not depend on its speed"),
    ("P-AXIS-00220", "the spindle is in position control at every speed"),
    ("P-AXIS-00224", "the spindle turns in both directions"),
    ("P-AXIS-00231", "the sign of the drive command is not changed"),
    ("P-AXIS-00265", "the spindle is in position control at every speed"),
    ("P-AXIS-00271", "temperature compensation is not added to the set position"),
    ("P-AXIS-00431", "the limits of the axis do not depend on the length of a motion"),
    ("P-AXIS-00438", "lr_param.add_interface.filter[0] filters the additional interface"),
    ("P-AXIS-00513", "the feedforward is computed from the filtered setpoint"),
    (
        "P-AXIS-00520",
        "set positions are checked against the software limits only during preparation",
    ),
    ("P-AXIS-00522", "friction is not compensated"),
    ("P-AXIS-00556", "a feedhold brakes independent axes with their normal deceleration"),
    ("P-AXIS-00767", "the spindle is in position control at every speed"),
    ("P-AXIS-00789", "crosstalk between axes is not compensated"),
    ("P-AXIS-00833", "the drive does not weight the velocity feedforward"),
    ("P-AXIS-00838", "the spindle has reached its speed within P-AXIS-00217 at every speed"),
    (
        "P-STUP-00018",
        "programs and subroutines are searched for next to the main program and in the folders of --path",
    ),
    ("P-STUP-00075", "the whole look-ahead is computed in every cycle"),
    ("P-CHAN-00004", "S words do not change the gear"),
    ("P-CHAN-00016", "D uses the data of the tool list"),
    (
        "P-CHAN-00052",
        "M40 to M45 do not change the gear, the spindle keeps the limits of the first gear",
    ),
    ("P-CHAN-00069", "the spindle turns like a spindle of the control"),
    ("P-CHAN-00079", "words of rotary axes are in degrees"),
    ("P-CHAN-00120", "an axis beyond a software limit is an error at program start"),
    ("P-CHAN-00131", "#HSC [BSPLINE] keeps distances of its own from corners"),
    ("P-CHAN-00132", "lines are not divided before a spline is fitted"),
    ("P-CHAN-00137", "arcs are not divided under #HSC"),
    ("P-CHAN-00138", "arcs are not divided under #HSC"),
    ("P-CHAN-00141", "the jerk on curves is checked as with 1"),
    ("P-CHAN-00190", "the limits do not depend on the length of a motion"),
    ("P-CHAN-00217", "the first motion after #HSC ON is part of the spline"),
    ("P-CHAN-00219", "contour violations are found without contour masking"),
    ("P-CHAN-00220", "the path does not slow down around sharp corners"),
    ("P-CHAN-00230", "the limits do not depend on the radius of an arc"),
    ("P-CHAN-00259", "contouring treats arcs as with 0"),
    ("P-CHAN-00261", "there is only one path"),
    ("P-CHAN-00321", "short blocks are not merged"),
    ("P-CHAN-00405", "a spline does not end where the ways of other axes are long"),
    ("P-CHAN-00654", "the whole look-ahead is computed in every cycle"),
    ("P-CHAN-00761", "the spindle follows the set positions of the axes of G63"),
    ("P-CHAN-00834", "the axes of G33 follow the set position of the spindle"),
    ("P-EXTV-00002", "every variable has a memory of its own, also where addresses overlap"),
];

/// What is done instead of the function of a parameter that is not simulated.
pub(crate) fn instead_of(id: &str) -> Option<&'static str> {
    INERT.iter().find(|(inert, _)| *inert == id).map(|(_, instead)| *instead)
}

/// K-0075 for every such parameter that a list changes, once for all indices of an array.
pub(super) fn check(
    parameters: &Parameters,
    axis: Option<&AxisRef>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    // ordered by key: the entries of an array are adjacent
    let mut last = None;
    for (indices, setting) in parameters.settings() {
        let row = setting.row;
        let Some(instead) = instead_of(row.id) else { continue };
        // a refused value has already been reported
        let is_refused =
            |d: &Diagnostic| d.is_error() && d.parameter == Some(row.id) && d.source == setting.at;
        if !setting.is_changed() || last == Some(row.id) || diagnostics.iter().any(is_refused) {
            continue;
        }
        last = Some(row.id);
        let key = with_indices(row.key, indices);
        let text = format!("{key} is not simulated: {instead}");
        diagnostics.push(without_effect(setting, &text, axis).hint(HINT));
    }
    let mut values = |place: Place, acts: bool, instead: &str, hint: &str| {
        if let (Some(setting), true) = (parameters.set_by(place), acts) {
            let text = format!("{place}: {instead}");
            diagnostics.push(without_effect(setting, &text, axis).hint(hint));
        }
    };
    match parameters.kind() {
        ListKind::Axis => axis_functions_of(parameters, &mut values),
        ListKind::Channel => {
            let places = [channel::LOOK_AHEAD.place(), channel::LOOK_AHEAD_BLOCKS.place()];
            interpolator(places, parameters, &mut values);
        }
        ListKind::StartUp => {
            let places = [start_up::LOOK_AHEAD.place(), start_up::LOOK_AHEAD_BLOCKS.place()];
            interpolator(places, parameters, &mut values);
        }
        _ => {}
    }
}

/// Values of the list of an axis that act like others.
fn axis_functions_of(parameters: &Parameters, values: &mut impl FnMut(Place, bool, &str, &str)) {
    let number = |place: Place| parameters.listed(place).unwrap_or_default();
    let place = axis_general::LIMIT_BEHAVIOUR.place();
    let behaviour = parameters.of(place.row, place.indices);
    values(
        place,
        behaviour == Some(Value::Text("ERROR_LR".to_owned())),
        "ERROR_LR acts as ERROR, a position outside the software limits ends the program",
        "WARNING lets the program run and the axis cross the limit",
    );
    let place = axis_functions::PROBE_EDGE.place();
    let edge = parameters.of(place.row, place.indices);
    values(
        place,
        edge == Some(Value::Text("NEG".to_owned())),
        "the probe signals at its rising edge",
        HINT,
    );
    let kind = kind_of(parameters);
    let place = axis_functions::MODULO_CALCULATION.place();
    let acts = match kind {
        AxisKind::Linear => number(place) > 0.0,
        AxisKind::Rotary => false,
        AxisKind::Spindle => number(place).total_cmp(&0.0).is_eq(),
    };
    let of = if kind == AxisKind::Linear {
        "a linear axis is not counted modulo"
    } else {
        "a spindle is counted modulo"
    };
    values(place, acts, of, HINT);
    let place = axis_functions::LIMIT_CHECK.place();
    let is_modulo = parameters.get(axis_general::MODE) & mode::MODULO != 0;
    let acts = number(place) > 0.0 && is_modulo && kind != AxisKind::Linear;
    values(place, acts, "a modulo axis has no software limits", HINT);
}

/// Blocks of look-ahead that the control uses with other slopes than STEP (829047947).
const BLOCKS_WITHOUT_STEP: f64 = 500.0;

/// FCT_LOOK_AHEAD_OPT, the one function of the interpolator that changes speeds, and more blocks than it uses with every slope.
fn interpolator(
    [place, blocks]: [Place; 2],
    parameters: &Parameters,
    values: &mut impl FnMut(Place, bool, &str, &str),
) {
    let functions = parameters.listed(place).and_then(whole).unwrap_or_default();
    let acts = functions & start_up::OPTIMISED != 0;
    values(place, acts, "FCT_LOOK_AHEAD_OPT does not raise speeds further", HINT);
    let more = parameters.listed(blocks).is_some_and(|blocks| blocks > BLOCKS_WITHOUT_STEP);
    let custom = functions & start_up::CUSTOM != 0;
    let instead = "all of these blocks count, on the control 500 with other slopes than STEP";
    values(blocks, more && custom, instead, "write 500 unless the programs use #SLOPE [TYPE=STEP]");
}

fn without_effect(setting: &Setting, text: &str, axis: Option<&AxisRef>) -> Diagnostic {
    let diagnostic = Diagnostic::new(Condition::ListNoEffect, text);
    finish(diagnostic, setting.row, setting.at.clone(), axis)
}
