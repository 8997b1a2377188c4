//! Declarations: `#VAR`, types, sizes and initial values of variables and arrays.

use super::resolve::parameter_index;
use super::scopes::{Class, Variables, class};
use super::storage::{DIMENSIONS_MAX, ELEMENTS_MAX, Type, Values, Variable, note_rounded};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::values::number::whole;
use crate::syntax::ast::{Declaration, Expr, ItemKind, ItemValue, Place, PlaceKind, Span};
use smallvec::SmallVec;

/// What is declared.
enum Declared {
    Parameter(u32),
    Own(Class, String),
}

impl Decoder {
    /// One line between `#VAR` and `#ENDVAR`.
    pub(in crate::exec) fn declare(&mut self, declaration: &Declaration) -> Outcome<()> {
        let kind = declared_type(self, declaration)?;
        let declared = declared(self, &declaration.place)?;
        let sizes = sizes(self, &declaration.place)?;
        let count = self.values.variables.room_for(&sizes, declaration.place.span)?;
        let values = start_values(self, declaration, kind, &sizes, count)?;
        for (x, span) in fractions(self, declaration, kind) {
            note_rounded(&mut self.report, &declaration.place.to_string(), x, span);
        }
        let variable = Variable { kind: Some(kind), sizes, values };
        self.values.variables.declare(&declared, variable, &declaration.place)
    }
}

impl Variables {
    /// Number of elements of an array; refused if it has too many dimensions, or if all arrays together would have too many
    /// elements.
    fn room_for(&self, sizes: &[usize], span: Span) -> Outcome<usize> {
        let count = sizes.iter().fold(1, |n: usize, size| n.saturating_mul(*size));
        if sizes.len() > DIMENSIONS_MAX {
            let text = format!("arrays have at most {DIMENSIONS_MAX} dimensions");
            return Err(Fault::new(Condition::TooManyDimensions, text, span));
        }
        if !sizes.is_empty() && self.elements.saturating_add(count) > ELEMENTS_MAX {
            let text = format!("all arrays together hold at most {ELEMENTS_MAX} elements");
            return Err(Fault::new(Condition::DimensionTooLarge, text, span));
        }
        Ok(count)
    }

    fn declare(&mut self, declared: &Declared, variable: Variable, place: &Place) -> Outcome<()> {
        let exists = match declared {
            Declared::Parameter(index) => {
                // a parameter created by a write may become an array
                let known = self
                    .parameters()
                    .get(index)
                    .is_some_and(|v| !v.sizes.is_empty() || v.sizes == variable.sizes);
                if !known {
                    self.insert_parameter(*index, variable);
                }
                known
            }
            Declared::Own(class, name) => self.insert(*class, name, variable, place.span)?,
        };
        if exists {
            let text = format!("{place} exists already");
            let condition = match declared {
                Declared::Parameter(_) => Condition::ParameterExists,
                Declared::Own(..) => Condition::VariableExists,
            };
            return Err(Fault::new(condition, text, place.span));
        }
        Ok(())
    }
}

fn declared(decoder: &Decoder, place: &Place) -> Outcome<Declared> {
    let span = place.span;
    match &place.kind {
        PlaceKind::Parameter { indirections, index, .. } => {
            parameter_index(decoder, index, *indirections, span).map(Declared::Parameter)
        }
        PlaceKind::Variable(segments) => {
            let first = segments.first().map_or("", |s| &*s.name);
            let Some((class, _)) = class(first) else {
                let text = format!("variables of class V.{first} cannot be declared");
                let fault = Fault::new(Condition::VariableType, text, span);
                return Err(fault.hint("declare V.P, V.L, V.S or V.CYC variables"));
            };
            let names: Vec<&str> = segments[1..].iter().map(|s| &*s.name).collect();
            Ok(Declared::Own(class, names.join(".")))
        }
        PlaceKind::Cycle(_) => Err(Fault::new(Condition::Syntax, "a variable is expected", span)),
    }
}

fn declared_type(decoder: &Decoder, declaration: &Declaration) -> Outcome<Type> {
    let Some(name) = &declaration.type_name else {
        let text = matches!(
            &declaration.value,
            Some(ItemValue::Expr(e)) if matches!(decoder.value(e), Ok(Value::Text(_)))
        );
        return Ok(if text { Type::Text(126) } else { Type::Real });
    };
    let kind = Type::from_name(&name.text.to_ascii_uppercase()).ok_or_else(|| {
        Fault::new(Condition::VariableType, format!("unknown type {}", name.text), name.span)
            .hint("use BOOLEAN, SGN08 to SGN32, UNS08 to UNS32, REAL64 or STRING[n]")
    })?;
    match (&declaration.length, kind) {
        (Some(length), Type::Text(_)) => {
            Ok(Type::Text(decoder.whole(length, "the length of a text", 0, 126)? as usize))
        }
        _ => Ok(kind),
    }
}

fn sizes(decoder: &Decoder, place: &Place) -> Outcome<SmallVec<[usize; 2]>> {
    let high = u32::try_from(ELEMENTS_MAX).unwrap_or(u32::MAX);
    let size = |e: &Expr| {
        let x = decoder.number(e)?;
        whole(x, 1, high).map(|n| n as usize).ok_or_else(|| {
            let text =
                format!("the size of a dimension is {x}, allowed: whole numbers 1 to {high}");
            let condition = if x < 1.0 {
                Condition::DimensionTooSmall
            } else if x > f64::from(high) {
                Condition::DimensionTooLarge
            } else {
                Condition::Range
            };
            Fault::new(condition, text, e.span)
        })
    };
    match &place.kind {
        PlaceKind::Parameter { subscripts, .. } => subscripts.iter().map(size).collect(),
        PlaceKind::Variable(segments) => {
            segments.iter().flat_map(|s| &s.subscripts).map(size).collect()
        }
        PlaceKind::Cycle(_) => Ok(SmallVec::new()),
    }
}

fn start_values(
    decoder: &Decoder,
    declaration: &Declaration,
    kind: Type,
    sizes: &[usize],
    count: usize,
) -> Outcome<Values> {
    let one = |e: &Expr| kind.converted(decoder.value(e)?, e.span);
    if sizes.is_empty() {
        return Ok(Values::One(match &declaration.value {
            None => kind.zero(),
            Some(ItemValue::Expr(e)) => one(e)?,
            Some(ItemValue::Name(n)) => {
                return Err(Fault::new(Condition::Syntax, "a value is expected", n.span));
            }
            Some(ItemValue::List(g)) => {
                return Err(Fault::new(Condition::Syntax, "a single value is expected", g.span));
            }
        }));
    }
    let mut values = Vec::new();
    match &declaration.value {
        None => {}
        Some(ItemValue::List(group)) => {
            for item in &group.items {
                match &item.kind {
                    ItemKind::Value(ItemValue::Expr(e)) => values.push(one(e)?),
                    ItemKind::Missing => values.push(kind.zero()),
                    _ => {
                        let text = "a value is expected";
                        return Err(Fault::new(Condition::Syntax, text, item.span));
                    }
                }
            }
        }
        Some(ItemValue::Expr(e)) => values.push(one(e)?),
        Some(ItemValue::Name(n)) => {
            return Err(Fault::new(Condition::Syntax, "a value is expected", n.span));
        }
    }
    if values.len() > count {
        let text = format!("{} values for {count} elements", values.len());
        return Err(Fault::new(Condition::Range, text, declaration.span));
    }
    values.resize(count, kind.zero());
    Ok(Values::Many(values))
}

/// Initial values with fractions for a variable of an integer type.
fn fractions(decoder: &Decoder, declaration: &Declaration, kind: Type) -> Vec<(f64, Span)> {
    let exprs: Vec<&Expr> = match &declaration.value {
        Some(ItemValue::Expr(e)) => vec![e],
        Some(ItemValue::List(group)) => group
            .items
            .iter()
            .filter_map(|item| match &item.kind {
                ItemKind::Value(ItemValue::Expr(e)) => Some(e),
                _ => None,
            })
            .collect(),
        Some(ItemValue::Name(_)) | None => Vec::new(),
    };
    let fraction = |e: &Expr| Some((kind.rounds(&decoder.value(e).ok()?)?, e.span));
    exprs.into_iter().filter_map(fraction).collect()
}
