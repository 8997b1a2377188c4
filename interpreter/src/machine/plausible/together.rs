//! Rules over several parameters of one axis.

use super::{finish, unit_of};
use crate::diag::{AxisRef, Condition, Diagnostic, ValueKind};
use crate::machine::gears;
use crate::machine::kind::{AxisKind, kind_of, mode as bits};
use crate::machine::parameters::Parameters;
use crate::machine::table::param::{Number, Param, Place};
use crate::machine::table::{axis_drive, axis_functions, axis_general};
use crate::machine::value::Value;

/// Largest modulo range in 0.0001 deg (TF5200 diagnosis 262874763).
const MODULO_RANGE_MAX: f64 = 2_147_483_647.0;

/// Rules over several parameters of one axis.
pub(super) fn check(
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
