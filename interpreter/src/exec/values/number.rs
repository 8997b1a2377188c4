//! Conversions of numbers in a program: truth value, integer, bit pattern.
//!
//! Source: TF5200 programming manual, arithmetic expressions. Assumption: a condition is true if the absolute value is
//! at least 0.5.

use crate::diag::{Condition, ValueKind};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::syntax::ast::Span;

/// Truth value of a number.
pub(in crate::exec) fn is_true(x: f64) -> bool {
    x.abs() >= 0.5
}

/// The number in a value.
pub(in crate::exec) fn as_number(value: &Value, span: Span) -> Outcome<f64> {
    match value {
        Value::Number(x) => Ok(*x),
        Value::Text(_) => {
            Err(Fault::new(Condition::NumberExpected, "number expected, found text", span))
        }
    }
}

/// Largest difference from an integer with which a number still counts as one, so that computed numbers work. `$SWITCH`
/// uses the same difference for equality.
pub(in crate::exec) const NEARLY: f64 = 0.001;

/// Whether a number counts as an integer.
pub(in crate::exec) fn is_whole(x: f64) -> bool {
    (x - x.round()).abs() < NEARLY
}

/// Largest coordinate of a centre in mm: 2^31 - 1 tenths of a micrometre.
///
/// Assumption: 20020 and 21147 refer to the data format and print no limit; this is the range of positions in the lists
/// (SGN32).
pub(in crate::exec) const LARGEST_MM: f64 = 214_748.364_7;

/// The integer equal to `x`, if it is within the range; numbers with a fraction are never rounded silently.
pub(in crate::exec) fn whole(x: f64, low: u32, high: u32) -> Option<u32> {
    let rounded = x.round();
    let within = rounded >= f64::from(low) && rounded <= f64::from(high);
    (within && is_whole(x)).then_some(rounded as u32)
}

/// Returns finite numbers unchanged.
pub(in crate::exec) fn finite(x: f64, span: Span) -> Outcome<f64> {
    if x.is_finite() {
        return Ok(x);
    }
    Err(Fault::new(Condition::Range, "the result is not a number within the range of REAL64", span))
}

/// Bit pattern of a number: fractions are truncated, negative numbers are taken as signed 32-bit integers.
pub(in crate::exec) fn bits(x: f64, span: Span) -> Outcome<u32> {
    let cut = x.trunc();
    if cut >= 0.0 && cut <= f64::from(u32::MAX) {
        Ok(cut as u32)
    } else if cut < 0.0 && cut >= f64::from(i32::MIN) {
        Ok(cut as i32 as u32)
    } else {
        Err(Fault::new(Condition::LogicalTerm, format!("{x} does not fit in 32 bits"), span).with(
            |d| {
                d.value(ValueKind::Wrong, x, "-")
                    .value(ValueKind::LowerLimit, f64::from(i32::MIN), "-")
                    .value(ValueKind::UpperLimit, u32::MAX, "-")
            },
        ))
    }
}
