//! Range checks after all lists and overrides are applied, with the documented IDs and corrections.
//!
//! Rows with a range that depends on other words of a function (filters, Improved Position Control) are checked where
//! that function is set up.

pub(super) mod channel;
mod together;

use super::gears;
use super::kind::{AxisKind, kind_of};
use super::parameters::Parameters;
use super::table::param::Place;
use super::table::{
    self, Bound, Correction, Default, Indices, ListKind, OutOfRange, Raw, Row, with_indices,
};
use super::table::{axis_drive, own};
use super::value::Value;
use crate::diag::{AxisRef, Condition, Diagnostic, Named, Severity, ValueKind};
use kontur_filters::time::CycleTime;

/// An end of a numeric range: the value, and whether the value itself is permitted.
#[derive(Clone, Copy, Debug)]
struct End {
    value: f64,
    allowed: bool,
}

/// Checks one set of parameters and applies corrections to it.
pub(super) fn check(
    parameters: &mut Parameters,
    cycle: CycleTime,
    axis: Option<&AxisRef>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    // numeric ranges first, so that ranges that refer to other parameters use corrected values
    let rows = || table::rows().filter(|r| !r.key.is_empty() && !r.at_setup);
    let named = |b: Bound| {
        !matches!(b, Bound::None | Bound::At(_) | Bound::Beyond(_) | Bound::BeyondCycles(_))
    };
    let kind = parameters.kind();
    let first = diagnostics.len();
    for second in [false, true] {
        for row in rows().filter(|r| r.list == kind && (named(r.low) || named(r.high)) == second) {
            let mut places: Vec<Indices> = parameters
                .settings()
                .filter(|(_, s)| s.row.key == row.key)
                .map(|(i, _)| i)
                .collect();
            let is_of_gear = gears::is_of_gear(row);
            let stages = if is_of_gear { gears::stages(parameters) } else { vec![0] };
            for indices in stages.iter().map(|stage| [*stage, 0]) {
                if second && !places.contains(&indices) {
                    places.push(indices);
                }
            }
            // stages without a number cannot be selected
            let used = |i: &Indices| !is_of_gear || stages.contains(&i[0]);
            for indices in places.into_iter().filter(used) {
                check_value(parameters, row, indices, cycle, axis, diagnostics);
            }
        }
    }
    if kind == ListKind::Axis {
        together::check(parameters, axis, diagnostics);
        // P-AXIS-00515: if one of the two velocity weights is 0, both are set to 1
        let weights = [axis_drive::FF_SPEED_NUM, axis_drive::FF_SPEED_DENOM];
        let wrong = |d: &Diagnostic| weights.iter().any(|weight| d.parameter == weight.id());
        if diagnostics.iter().skip(first).any(wrong) {
            for d in diagnostics.iter_mut().skip(first).filter(|d| wrong(d)) {
                d.text.push_str(" for both weights (P-AXIS-00514, P-AXIS-00515)");
            }
            for param in weights {
                parameters.set(param.place().row, [0; 2], Value::Number(1.0), None);
            }
        }
    }
}

fn check_value(
    parameters: &mut Parameters,
    row: &'static Row,
    indices: Indices,
    cycle: CycleTime,
    axis: Option<&AxisRef>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let Some(Value::Number(value)) = parameters.of(row, indices) else { return };
    if row.special.is_some_and(|special| special.total_cmp(&value).is_eq()) {
        return;
    }
    let low = end(parameters, row.low, indices, cycle);
    let high = end(parameters, row.high, indices, cycle);
    let below = low.is_some_and(|e| value < e.value || (!e.allowed && value <= e.value));
    let above = high.is_some_and(|e| value > e.value || (!e.allowed && value >= e.value));
    let (reaction, bound) = match (low, high) {
        (Some(e), _) if below => (row.below, e),
        (_, Some(e)) if above => (row.above, e),
        _ => return,
    };
    let key = with_indices(row.key, indices);
    let at = parameters.set_by(Place { row, indices }).and_then(|s| s.at.clone());
    let corrected = correction(row, reaction, bound, below);
    let range = range_of(low, high);
    let default = if at.is_none() { "default " } else { "" };
    let unit = unit_of(parameters, row);
    let of = if unit == "-" { String::new() } else { format!(" {unit}") };
    let mut text = format!("{key}: {default}{value}{of} is outside its range ({range})");
    match corrected {
        Some(c) => text = format!("{text}, {c} is used"),
        None if reaction.correction == Correction::Refuse => {}
        None => text.push_str(", the function is off"),
    }
    let severity = match reaction.correction {
        Correction::Refuse => Severity::Error,
        // the value is not from a list: a limit set elsewhere applies
        _ if at.is_none() => Severity::Note,
        _ => Severity::Warning,
    };
    let mut diagnostic = Diagnostic::new(reaction.condition, text)
        .severity(severity)
        .value(ValueKind::Wrong, value, unit)
        .value(
            if below { ValueKind::LowerLimit } else { ValueKind::UpperLimit },
            bound.value,
            unit,
        );
    if let Some(c) = corrected {
        diagnostic = diagnostic.value(ValueKind::Corrected, c, unit).corrected(c);
        parameters.set(row, indices, Value::Number(c), at.clone());
    }
    diagnostics.push(finish(diagnostic, row, at, axis));
}

pub(super) fn finish(
    mut diagnostic: Diagnostic,
    row: &Row,
    at: Option<crate::diag::Location>,
    axis: Option<&AxisRef>,
) -> Diagnostic {
    if let Some(axis) = axis {
        diagnostic = diagnostic.axis(axis.number, axis.name.clone());
    }
    diagnostic.source = at;
    diagnostic.parameter(row)
}

fn unit_of(parameters: &Parameters, row: &Row) -> &'static str {
    let linear = parameters.kind() != ListKind::Axis || kind_of(parameters) == AxisKind::Linear;
    if linear { row.unit } else { row.unit_rotary }
}

/// A range in words.
fn range_of(low: Option<End>, high: Option<End>) -> String {
    match (low, high) {
        (Some(l), Some(h)) => {
            format!("{} {}", describe(l, "from", "above"), describe(h, "to", "below"))
        }
        (Some(l), None) => describe(l, "at least", "above"),
        (None, Some(h)) => describe(h, "at most", "below"),
        (None, None) => String::new(),
    }
}

fn describe(end: End, allowed: &str, excluded: &str) -> String {
    format!("{} {}", if end.allowed { allowed } else { excluded }, end.value)
}

fn end(parameters: &Parameters, bound: Bound, indices: Indices, cycle: CycleTime) -> Option<End> {
    let of = |id: &str| parameters.of(table::by_id(id)?, indices)?.number();
    let allowed = |value| Some(End { value, allowed: true });
    match bound {
        Bound::None | Bound::Text(_) => None,
        Bound::At(value) => allowed(value),
        Bound::Beyond(value) => Some(End { value, allowed: false }),
        Bound::Of(id) => allowed(of(id)?),
        Bound::BeyondOf(id) => Some(End { value: of(id)?, allowed: false }),
        Bound::Times(factor, id) => allowed(factor * of(id)?),
        Bound::LeastOf(ids) => {
            ids.iter().filter_map(|id| of(id)).reduce(f64::min).and_then(allowed)
        }
        Bound::GreatestOf(ids) => {
            ids.iter().filter_map(|id| of(id)).reduce(f64::max).and_then(allowed)
        }
        Bound::BeyondCycles(n) => Some(End { value: n * f64::from(cycle.us()), allowed: false }),
    }
}

fn correction(row: &Row, reaction: OutOfRange, bound: End, below: bool) -> Option<f64> {
    if reaction.correction == Correction::Refuse {
        return None;
    }
    let limit = match (bound.allowed, row.raw) {
        (true, _) => bound.value,
        (false, Raw::Real64) => return default_of(row),
        // the nearest whole number inside the range
        (false, _) if below => bound.value + 1.0,
        (false, _) => bound.value - 1.0,
    };
    match reaction.correction {
        Correction::Default => Some(default_of(row).unwrap_or(limit)),
        Correction::Limit => Some(limit),
        Correction::Value(value) => Some(value),
        Correction::Keep | Correction::Refuse => None,
    }
}

fn default_of(row: &Row) -> Option<f64> {
    match row.default {
        Default::Number(value) => Some(value),
        _ => None,
    }
}

/// K-0032: the sampling time in the list for the simulated drive (P-AXIS-00239 / P-AXIS-00238) differs from the cycle,
/// which is used instead; K-0075 for a plant that has no such drive.
pub(super) fn check_sampling(
    parameters: &Parameters,
    own: &Parameters,
    cycle: CycleTime,
    axis: &AxisRef,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let sampling = [axis_drive::SIMU_SAMPLING_NUM, axis_drive::SIMU_SAMPLING_DENOM];
    let [z, n] = sampling.map(|param| parameters.listed(param).unwrap_or_default());
    let Some(setting) = sampling.iter().find_map(|param| parameters.set_by(*param)) else { return };
    let model = own.get(own::PLANT_MODEL.at(axis.number));
    if model.as_deref() != Some("SIMU") {
        if setting.is_changed() {
            let text = format!(
                "{}: only the plant SIMU has this sampling time (kontur.axis[{}].plant.model)",
                setting.row.key, axis.number
            );
            let diagnostic = Diagnostic::new(Condition::ListNoEffect, text);
            diagnostics.push(finish(diagnostic, setting.row, setting.at.clone(), Some(axis)));
        }
        return;
    }
    if (z / n - cycle.seconds()).abs() <= 1e-9 {
        return;
    }
    let text = format!(
        "antr.simu.zeitkonstante_z: sampling time {z}/{n} s of the simulated drive differs from the cycle time of {} s, the cycle time is used",
        cycle.seconds()
    );
    let diagnostic = Diagnostic::new(Condition::SimulationSampling, text)
        .value(ValueKind::Wrong, z / n, "s")
        .value(ValueKind::Corrected, cycle.seconds(), "s");
    diagnostics.push(finish(diagnostic, setting.row, setting.at.clone(), Some(axis)));
}
