//! Range checks after all lists and overrides are applied, with the documented IDs and corrections.
//!
//! Rows with a range that depends on other words of a function (filters, Improved Position Control) are checked where
//! that function is set up.

pub(super) mod channel;

use super::gears;
use super::kind::{AxisKind, kind_of, mode as bits};
use super::parameters::Parameters;
use super::table::param::{Number, Param, Place};
use super::table::{
    self, Bound, Correction, Default, Indices, ListKind, OutOfRange, Raw, Row, with_indices,
};
use super::table::{axis_drive, axis_functions, axis_general, kontur};
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
        check_together(parameters, axis, diagnostics);
        // P-AXIS-00515: if one of the two velocity weights is 0, both are set to 1
        let weights = [axis_drive::FF_SPEED_NUM, axis_drive::FF_SPEED_DENOM];
        let wrong = |d: &Diagnostic| weights.iter().any(|weight| d.parameter == weight.id());
        if diagnostics.iter().skip(first).any(wrong) {
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
    let range = match (low, high) {
        (Some(l), Some(h)) => {
            format!("{} {}", describe(l, "from", "above"), describe(h, "to", "below"))
        }
        (Some(l), None) => describe(l, "at least", "above"),
        (None, Some(h)) => describe(h, "at most", "below"),
        (None, None) => String::new(),
    };
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

/// Largest modulo range in 0.0001 deg (TF5200 diagnosis 262874763).
const MODULO_RANGE_MAX: f64 = 2_147_483_647.0;

/// Rules over several parameters of one axis.
fn check_together(
    parameters: &mut Parameters,
    axis: Option<&AxisRef>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    check_gear_stage(parameters, axis, diagnostics);
    let mut together = Together { parameters, axis, diagnostics };
    together.axis_type();
    together.software_limits();
    together.modulo_range();
    together.speed_band();
    together.mode();
    select_modulo_calculation(together.parameters);
    together.feedforward();
    together.simulated_damping();
}

/// The parameters of one axis, and the corrections of them.
struct Together<'a> {
    parameters: &'a mut Parameters,
    axis: Option<&'a AxisRef>,
    diagnostics: &'a mut Vec<Diagnostic>,
}

impl Together<'_> {
    /// Replaces a value, and reports it.
    fn put(&mut self, condition: Condition, place: Place, text: impl Into<String>, value: f64) {
        let row = place.row;
        let wrong = self.parameters.listed(place).unwrap_or_default();
        let at = self.parameters.set_by(place).and_then(|s| s.at.clone());
        let unit = unit_of(self.parameters, row);
        let diagnostic = Diagnostic::new(condition, text)
            .value(ValueKind::Wrong, wrong, unit)
            .value(ValueKind::Corrected, value, unit)
            .corrected(value);
        self.parameters.set(row, [0; 2], Value::Number(value), at.clone());
        self.diagnostics.push(finish(diagnostic, row, at, self.axis));
    }

    fn number(&self, param: Param<Number>) -> f64 {
        self.parameters.listed(param).unwrap_or_default()
    }

    /// P-AXIS-00018: a number without a type.
    fn axis_type(&mut self) {
        let kind = self.parameters.get(axis_general::KIND);
        if !matches!(kind, 1 | 2 | 4) {
            let text = format!(
                "kenngr.achs_typ: {kind} is no axis type, ACHSTYP_TRANSLATOR (a linear axis) is used"
            );
            self.put(Condition::ListRange, axis_general::KIND.place(), text, 1.0);
        }
    }

    /// P-AXIS-00177, P-AXIS-00178: an empty range.
    fn software_limits(&mut self) {
        let (lower, upper) = (axis_general::LOWER_LIMIT, axis_general::UPPER_LIMIT);
        let (low, high) = (self.number(lower), self.number(upper));
        if low >= high {
            let text = format!(
                "kenngr.swe_neg: software limits {low} and {high} leave no travel, the defaults are used"
            );
            self.put(Condition::SoftwareLimitRange, lower.place(), text.clone(), -1e8);
            self.put(Condition::SoftwareLimitRange, upper.place(), text, 1e8);
        }
    }

    /// P-AXIS-00126, P-AXIS-00127: a modulo range without or beyond its format.
    fn modulo_range(&mut self) {
        let (upper, lower) = (axis_general::MODULO_UPPER, axis_general::MODULO_LOWER);
        let (high, low) = (self.number(upper), self.number(lower));
        let (condition, what) = match high - low {
            range if range <= 0.0 => (Condition::ModuloRangeEmpty, "not above 0"),
            range if range > MODULO_RANGE_MAX => (Condition::ModuloRangeTooLarge, "too large"),
            _ => return,
        };
        if kind_of(self.parameters) == AxisKind::Linear {
            return;
        }
        let text = format!(
            "getriebe[0].moduloo: the modulo range {high} - {low} is {what}, the defaults are used"
        );
        self.put(condition, upper.place(), text.clone(), 3_600_000.0);
        if self.parameters.set_by(lower).is_some() {
            self.put(condition, lower.place(), text, 0.0);
        }
    }

    /// P-AXIS-00217: no tolerance would let a spindle reach its speed.
    fn speed_band(&mut self) {
        let band = axis_functions::SPEED_BAND;
        if self.number(band) == 0.0 {
            let text = "kenngr.vb_prozent: a deviation of 0 lets no speed be reached, 100 is used";
            self.put(Condition::SpeedBandZero, band.place(), text, 100.0);
        }
    }

    /// P-AXIS-00015: modes of spindles, and undefined modes.
    fn mode(&mut self) {
        if let Some((condition, what, used)) = wrong_mode(self.parameters) {
            let mode = self.parameters.get(axis_general::MODE);
            let text = format!("kenngr.achs_mode: {mode} {what}, {used} is used");
            self.put(condition, axis_general::MODE.place(), text, f64::from(used));
        }
    }

    /// P-AXIS-00566 permits velocity feedforward only.
    fn feedforward(&mut self) {
        let flags = self.parameters.get(axis_drive::FEEDFORWARD);
        if self.parameters.get(axis_drive::FF_WITHOUT_DELAY) && flags & 0x6 != 0 {
            let text = "vorsteuer.vorsteuerung: without the delay of 5 cycles only velocity feedforward is possible, \
                        acceleration and jerk feedforward are off";
            self.put(
                Condition::WithoutDelayNeedsVelocityOnly,
                axis_drive::FEEDFORWARD.place(),
                text,
                f64::from(flags & 0x101),
            );
        }
    }

    /// P-AXIS-00051 / P-AXIS-00050 is the damping of the simulated drive.
    fn simulated_damping(&mut self) {
        let numerator = axis_drive::SIMU_DAMPING_NUM;
        let (z, n) = (self.number(numerator), self.number(axis_drive::SIMU_DAMPING_DENOM));
        if z >= n {
            let text = format!(
                "antr.simu.daempfung_z: damping {z}/{n} of the simulated drive is not below 1, 0.999 is used"
            );
            self.put(Condition::SimulationDamping, numerator.place(), text, 0.999 * n);
        }
    }
}

/// A gear stage at start-up (P-AXIS-00079) that the list does not have.
fn check_gear_stage(
    parameters: &Parameters,
    axis: Option<&AxisRef>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    // Assumption: the page of 3210 names gear changes of programs only
    let stage = parameters.get(axis_general::GEAR_STAGE);
    if gears::of_number(parameters, stage).is_some() {
        return;
    }
    let place = axis_general::GEAR_STAGE.place();
    let text = format!("kenngr.getriebe_stufe: no gear stage has the number {stage}");
    let diagnostic = Diagnostic::new(Condition::GearUnknown, text).value(
        ValueKind::Wrong,
        f64::from(stage),
        "-",
    );
    let at = parameters.set_by(place).and_then(|s| s.at.clone());
    diagnostics.push(finish(diagnostic, place.row, at, axis));
}

/// What is wrong with the axis mode of the list (P-AXIS-00015), and the mode that is used instead.
fn wrong_mode(parameters: &Parameters) -> Option<(Condition, &'static str, u32)> {
    parameters.set_by(axis_general::MODE)?;
    let (mode, kind) = (parameters.get(axis_general::MODE), kind_of(parameters));
    let has = |flags: u32| mode & flags != 0;
    if kind == AxisKind::Spindle && !has(bits::MODULO) {
        Some((Condition::SpindleMode, "is not valid for a spindle", mode & !0x3 | bits::MODULO))
    } else if has(bits::C_AXIS) && !has(bits::MODULO) {
        let what = "is that of a C axis but not of a modulo axis";
        Some((Condition::CAxisWithoutModulo, what, mode | bits::MODULO))
    } else if mode < 0x40 && !has(0x1 | 0x2 | 0x4) {
        let used = if kind == AxisKind::Linear { 0x1 } else { 0x4 };
        Some((Condition::AxisMode, "is unknown", used))
    } else {
        None
    }
}

/// P-AXIS-00557 has precedence over the axis mode; K-0075 where it cannot, see `inert`.
fn select_modulo_calculation(parameters: &mut Parameters) {
    let calculation = parameters.listed(axis_functions::MODULO_CALCULATION).unwrap_or_default();
    if kind_of(parameters) != AxisKind::Rotary || calculation < 0.0 {
        return;
    }
    let mode = parameters.get(axis_general::MODE);
    let used =
        if calculation > 0.0 { mode | bits::MODULO } else { mode & !bits::MODULO | bits::LINEAR };
    let Place { row, indices } = axis_general::MODE.place();
    let at = parameters.set_by(axis_functions::MODULO_CALCULATION).and_then(|s| s.at.clone());
    parameters.set(row, indices, Value::Number(f64::from(used)), at);
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
    let model = own.get(kontur::PLANT_MODEL.at(axis.number));
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
