//! A variable, its type and its elements.

use crate::diag::{Condition, ValueKind};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::report::{Report, Subject};
use crate::exec::values::number::{as_number, is_true, is_whole, whole};
use crate::syntax::ast::Span;
use smallvec::SmallVec;

/// Maximum number of elements of all arrays together.
pub(super) const ELEMENTS_MAX: usize = 4_000_000;

/// Maximum number of dimensions of an array.
pub(super) const DIMENSIONS_MAX: usize = 4;

/// Type of a declared variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    Boolean,
    /// Integers within a range.
    Integer {
        low: i64,
        high: i64,
    },
    Real,
    /// Text with a maximum number of characters.
    Text(usize),
}

impl Type {
    pub(super) fn from_name(name: &str) -> Option<Self> {
        let signed =
            |bits: u32| Self::Integer { low: -(1 << (bits - 1)), high: (1 << (bits - 1)) - 1 };
        let unsigned = |bits: u32| Self::Integer { low: 0, high: (1 << bits) - 1 };
        Some(match name {
            "BOOLEAN" | "BOOL" => Self::Boolean,
            "SGN08" => signed(8),
            "SGN16" => signed(16),
            "SGN32" => signed(32),
            "UNS08" => unsigned(8),
            "UNS16" => unsigned(16),
            "UNS32" => unsigned(32),
            "REAL64" | "REAL" => Self::Real,
            "STRING" => Self::Text(126),
            _ => return None,
        })
    }

    pub(super) fn zero(self) -> Value {
        match self {
            Self::Text(_) => Value::Text("".into()),
            _ => Value::Number(0.0),
        }
    }

    /// The number with a fraction, if a variable of this type would round it.
    pub(super) fn rounds(self, value: &Value) -> Option<f64> {
        match (self, value) {
            (Self::Integer { .. }, Value::Number(x)) if !is_whole(*x) => Some(*x),
            _ => None,
        }
    }

    /// The value converted to this type.
    pub(super) fn converted(self, value: Value, span: Span) -> Outcome<Value> {
        Ok(match self {
            Self::Boolean => Value::truth(is_true(as_number(&value, span)?)),
            Self::Real => Value::Number(as_number(&value, span)?),
            Self::Integer { low, high } => {
                let x = as_number(&value, span)?.round();
                if x < low as f64 || x > high as f64 {
                    let text = format!("{x} is outside {low} to {high}");
                    return Err(Fault::new(Condition::ValueOutOfType, text, span).with(|d| {
                        d.value(ValueKind::Wrong, x, "-")
                            .value(ValueKind::LowerLimit, low as f64, "-")
                            .value(ValueKind::UpperLimit, high as f64, "-")
                    }));
                }
                Value::Number(x + 0.0)
            }
            Self::Text(length) => match value {
                Value::Text(text) if text.chars().count() > length => {
                    let written = text.chars().count();
                    let text =
                        format!("a text of {written} characters, the variable can hold {length}");
                    return Err(Fault::new(Condition::TextTooLong, text, span).with(|d| {
                        d.value(ValueKind::Wrong, written as f64, "-").value(
                            ValueKind::UpperLimit,
                            length as f64,
                            "-",
                        )
                    }));
                }
                Value::Text(text) => Value::Text(text),
                Value::Number(_) => {
                    return Err(Fault::new(Condition::TextExpected, "text expected", span));
                }
            },
        })
    }
}

/// Kind of an array: the vendor's message numbers differ between P parameters and variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    Parameter,
    Variable,
}

/// A variable.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    pub(super) kind: Option<Type>,
    pub(super) sizes: SmallVec<[usize; 2]>,
    pub(super) values: Values,
}

impl Variable {
    /// A variable created by its first write: it takes the type of the value.
    pub(super) fn created(value: Value) -> Self {
        let kind = match value {
            Value::Number(_) => Some(Type::Real),
            Value::Text(_) => None,
        };
        Self { kind, sizes: SmallVec::new(), values: Values::One(value) }
    }

    pub(super) fn get(&self, subscripts: &[f64], owner: Owner, span: Span) -> Outcome<Value> {
        match (&self.values, self.index(subscripts, owner, span)?) {
            (Values::One(value), _) => Ok(value.clone()),
            (Values::Many(values), i) => Ok(values[i].clone()),
        }
    }

    pub(super) fn set(
        &mut self,
        subscripts: &[f64],
        value: Value,
        owner: Owner,
        span: Span,
    ) -> Outcome<()> {
        let i = self.index(subscripts, owner, span)?;
        let value = match self.kind {
            Some(kind) => kind.converted(value, span)?,
            None => value,
        };
        match &mut self.values {
            Values::One(slot) => *slot = value,
            Values::Many(values) => values[i] = value,
        }
        Ok(())
    }

    fn index(&self, subscripts: &[f64], owner: Owner, span: Span) -> Outcome<usize> {
        let (wrong_count, wrong_index) = match owner {
            Owner::Parameter => (Condition::ParameterUnknown, Condition::Range),
            Owner::Variable if subscripts.is_empty() => {
                (Condition::ArrayWithoutIndex, Condition::VariableIndex)
            }
            Owner::Variable if self.sizes.is_empty() => {
                (Condition::NoArray, Condition::VariableIndex)
            }
            Owner::Variable => (Condition::Range, Condition::VariableIndex),
        };
        if subscripts.len() != self.sizes.len() {
            let text = format!(
                "{} index(es) given, the variable has {} dimension(s)",
                subscripts.len(),
                self.sizes.len()
            );
            return Err(Fault::new(wrong_count, text, span));
        }
        let mut index = 0;
        for (x, size) in subscripts.iter().zip(&self.sizes) {
            let high = u32::try_from(size - 1).unwrap_or(u32::MAX);
            let Some(i) = whole(*x, 0, high) else {
                let text = format!("index {x} is not in 0 to {high}");
                return Err(Fault::new(wrong_index, text, span)
                    .with(|d| d.value(ValueKind::Wrong, *x, "-")));
            };
            index = index * size + i as usize;
        }
        Ok(index)
    }

    pub(super) fn elements(&self) -> usize {
        match &self.values {
            Values::One(_) => 0,
            Values::Many(values) => values.len(),
        }
    }
}

/// Its value or values.
#[derive(Clone, Debug)]
pub(super) enum Values {
    One(Value),
    Many(Vec<Value>),
}

/// A variable or parameter without a value.
pub(super) fn undefined(what: &str, span: Span) -> Box<Fault> {
    Fault::new(Condition::Undefined, format!("{what} has no value"), span)
}

/// Reports a number with a fraction that is written to a variable of an integer type.
///
/// Assumption: it is rounded; the documents do not specify whether the control rounds or truncates.
pub(super) fn note_rounded(report: &mut Report, name: &str, x: f64, span: Span) {
    let text = format!("{name} only holds whole numbers: {x} is rounded to {}", x.round());
    let fault = Fault::new(Condition::Odd, text, span).warning();
    let hint = "use ROUND, INT, FLOOR or CEIL to select the whole number";
    report.note_once(Subject::Rounded(name.into()), fault.hint(hint));
}
