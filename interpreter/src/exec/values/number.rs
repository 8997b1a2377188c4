//! Conversions of a number of a program: truth value, integer, bit pattern.
//!
//! Source: TF5200 programming manual, arithmetic expressions. Assumption: a condition is true from 0.5 on (absolute).

use crate::diag::Condition;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::syntax::ast::Span;

/// Truth of a number.
pub(in crate::exec) fn is_true(x: f64) -> bool {
    x.abs() >= 0.5
}

/// The number of a value.
pub(in crate::exec) fn as_number(value: &Value, span: Span) -> Outcome<f64> {
    match value {
        Value::Number(x) => Ok(*x),
        Value::Text(_) => {
            Err(Fault::new(Condition::NumberExpected, "a number is expected, not a text", span))
        }
    }
}

/// How far a number may lie from a whole one and still count as it, so that calculated numbers work. It is what `$SWITCH` takes
/// for equal.
pub(in crate::exec) const NEARLY: f64 = 0.001;

/// True for a whole number.
pub(in crate::exec) fn is_whole(x: f64) -> bool {
    (x - x.round()).abs() < NEARLY
}

/// Largest coordinate of a centre in mm: 2^31 - 1 tenths of a micrometre.
///
/// Assumption: 20020 and 21147 speak of the data format and print no limit; this is the range of positions in the lists (SGN32).
pub(in crate::exec) const LARGEST_MM: f64 = 214_748.364_7;

/// The whole number that `x` is, if it is within the range; no number with a fraction is rounded silently.
pub(in crate::exec) fn whole(x: f64, low: u32, high: u32) -> Option<u32> {
    let rounded = x.round();
    let within = rounded >= f64::from(low) && rounded <= f64::from(high);
    (within && is_whole(x)).then_some(rounded as u32)
}

/// Passes finite numbers.
pub(in crate::exec) fn finite(x: f64, span: Span) -> Outcome<f64> {
    if x.is_finite() {
        return Ok(x);
    }
    Err(Fault::new(Condition::Range, "the result is not a number within the range of REAL64", span))
}

/// Bit pattern of a number: fractions are cut, negative numbers count as signed 32 bits.
pub(in crate::exec) fn bits(x: f64, span: Span) -> Outcome<u32> {
    let cut = x.trunc();
    if cut >= 0.0 && cut <= f64::from(u32::MAX) {
        Ok(cut as u32)
    } else if cut < 0.0 && cut >= f64::from(i32::MIN) {
        Ok(cut as i32 as u32)
    } else {
        Err(Fault::new(Condition::Range, format!("{x} does not fit into 32 bits"), span))
    }
}
