//! The variable that a place denotes: its indices evaluated, its name joined.

use super::scopes::{Class, class};
use super::storage::Owner;
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::values::number::{as_number, whole};
use crate::syntax::ast::{Expr, ParameterIndex, Place, PlaceKind, Segment, Span};
use smallvec::SmallVec;
use std::borrow::Cow;

/// Highest index of a P parameter.
pub(super) const INDEX_MAX: u32 = 1_000_000;

/// A variable of the program.
pub(super) enum Target<'a> {
    Parameter(u32, Subscripts),
    Own(Class, Cow<'a, str>, Subscripts),
    External(String),
    Cycle(&'a str),
}

/// A variable of the program or of the control.
pub(super) enum Resolved<'a> {
    Variable(Target<'a>),
    System(&'a [Segment]),
}

type Subscripts = SmallVec<[f64; 2]>;

/// The variable that a place denotes.
pub(super) fn resolve<'a>(decoder: &Decoder, place: &'a Place) -> Outcome<Resolved<'a>> {
    Ok(Resolved::Variable(match &place.kind {
        PlaceKind::Parameter { indirections, index, subscripts } => {
            let index = parameter_index(decoder, index, *indirections, place.span)?;
            Target::Parameter(index, values_of(decoder, subscripts)?)
        }
        PlaceKind::Cycle(name) => Target::Cycle(name),
        PlaceKind::Variable(segments) => return variable(decoder, segments),
    }))
}

fn values_of(decoder: &Decoder, exprs: &[Expr]) -> Outcome<Subscripts> {
    exprs.iter().map(|e| decoder.number(e)).collect()
}

fn variable<'a>(decoder: &Decoder, segments: &'a [Segment]) -> Outcome<Resolved<'a>> {
    let first = segments.first().map_or("", |s| &*s.name);
    let rest = segments.get(1..).unwrap_or_default();
    if first.eq_ignore_ascii_case("E") {
        let name = external_name(decoder, rest)?;
        decoder.values.variables.uses_external(&name);
        return Ok(Resolved::Variable(Target::External(name)));
    }
    let Some((class, _)) = class(first) else { return Ok(Resolved::System(segments)) };
    if let [only] = rest {
        let subscripts = values_of(decoder, &only.subscripts)?;
        return Ok(Resolved::Variable(Target::Own(class, Cow::Borrowed(&only.name), subscripts)));
    }
    let mut subscripts = Subscripts::new();
    let mut name = String::new();
    for segment in rest {
        if !name.is_empty() {
            name.push('.');
        }
        name.push_str(&segment.name);
        subscripts.extend(values_of(decoder, &segment.subscripts)?);
    }
    Ok(Resolved::Variable(Target::Own(class, Cow::Owned(name), subscripts)))
}

/// The name of an external variable with its indices; empty for other places.
pub(super) fn external_name_of(decoder: &Decoder, place: &Place) -> Outcome<String> {
    match &place.kind {
        PlaceKind::Variable(segments) => {
            external_name(decoder, segments.get(1..).unwrap_or_default())
        }
        PlaceKind::Parameter { .. } | PlaceKind::Cycle(_) => Ok(String::new()),
    }
}

fn external_name(decoder: &Decoder, segments: &[Segment]) -> Outcome<String> {
    use std::fmt::Write as _;
    let mut name = String::new();
    for segment in segments {
        if !name.is_empty() {
            name.push('.');
        }
        name.push_str(&segment.name);
        for expr in &segment.subscripts {
            let x = decoder.number(expr)?;
            let index = whole(x, 0, u32::MAX).ok_or_else(|| {
                let text = format!("index {x} is not a whole number from 0");
                Fault::new(Condition::VariableIndex, text, expr.span)
            })?;
            // writing to a String cannot fail
            let _ = write!(name, "[{index}]");
        }
    }
    Ok(name)
}

/// Index of a P parameter after its indirections.
pub(super) fn parameter_index(
    decoder: &Decoder,
    index: &ParameterIndex,
    indirections: u32,
    span: Span,
) -> Outcome<u32> {
    let checked = |x: f64| {
        whole(x, 1, INDEX_MAX).ok_or_else(|| {
            let text = format!("P{x} does not exist, allowed: indices 1 to {INDEX_MAX}");
            Fault::new(Condition::ParameterNumber, text, span).with(|d| {
                d.value(ValueKind::Wrong, x, "-").value(ValueKind::UpperLimit, INDEX_MAX, "-")
            })
        })
    };
    let mut index = match index {
        ParameterIndex::Literal(n) => checked(f64::from(*n))?,
        ParameterIndex::Computed(expr) => checked(decoder.number(expr)?)?,
    };
    for _ in 0..indirections {
        let value = match decoder.values.variables.parameters().get(&index) {
            Some(variable) => variable.get(&[], Owner::Parameter, span)?,
            None => return Err(undefined_parameter(index, span)),
        };
        index = checked(as_number(&value, span)?)?;
    }
    Ok(index)
}

/// `G04 P500` of other controls is read as the value of P500 here.
pub(super) fn undefined_parameter(index: u32, span: Span) -> Box<Fault> {
    Fault::new(Condition::ParameterUnknown, format!("P{index} has no value"), span).hint(format!(
        "P is a parameter in this dialect, not an address: P{index}=5 assigns a value"
    ))
}
