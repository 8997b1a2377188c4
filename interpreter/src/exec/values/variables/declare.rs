//! Declarations: `#VAR`, types, sizes and initial values of variables and arrays.

use super::scopes::class;
use super::storage::{DIMENSIONS_MAX, ELEMENTS_MAX, Type, Values, Variable};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::values::number::whole;
use crate::syntax::ast::{Declaration, Expr, ItemKind, ItemValue, Place, PlaceKind, Span};
use smallvec::SmallVec;

impl Decoder {
    /// One line between `#VAR` and `#ENDVAR`.
    pub(in crate::exec) fn declare(&mut self, declaration: &Declaration) -> Outcome<()> {
        let span = declaration.place.span;
        let kind = self.declared_type(declaration)?;
        let (target, class_of) = match &declaration.place.kind {
            PlaceKind::Parameter { indirections, index, .. } => {
                let index = self.parameter_index(index, *indirections, span)?;
                (format!("{index}"), None)
            }
            PlaceKind::Variable(segments) => {
                let first = segments.first().map_or("", |s| &*s.name);
                let Some((class, _)) = class(first) else {
                    let text = format!("variables of class V.{first} cannot be declared");
                    let fault = Fault::new(Condition::VariableType, text, span);
                    return Err(fault.hint("declare V.P, V.L, V.S or V.CYC variables"));
                };
                let names: Vec<&str> = segments[1..].iter().map(|s| &*s.name).collect();
                (names.join("."), Some(class))
            }
            PlaceKind::Cycle(_) => {
                return Err(Fault::new(Condition::Syntax, "a variable is expected", span));
            }
        };
        let sizes = self.sizes(&declaration.place)?;
        let count: usize = sizes.iter().product();
        if sizes.len() > DIMENSIONS_MAX {
            let text = format!("arrays have at most {DIMENSIONS_MAX} dimensions");
            return Err(Fault::new(Condition::TooManyDimensions, text, span));
        }
        if !sizes.is_empty() && self.values.variables.elements.saturating_add(count) > ELEMENTS_MAX
        {
            let text = format!("all arrays together hold at most {ELEMENTS_MAX} elements");
            return Err(Fault::new(Condition::DimensionTooLarge, text, span));
        }
        let values = self.start_values(declaration, kind, &sizes, count)?;
        self.note_fractions(declaration, kind);
        let variable = Variable { kind: Some(kind), sizes, values };
        let exists = match class_of {
            None => {
                let index = target.parse().unwrap_or(0);
                let table = self.values.variables.parameters_mut();
                // a parameter created by a write may become an array
                let known = table
                    .get(&index)
                    .is_some_and(|v| !v.sizes.is_empty() || v.sizes == variable.sizes);
                if !known {
                    self.values.variables.insert_parameter(index, variable);
                }
                known
            }
            Some(class) => self.values.variables.insert(class, &target, variable, span)?,
        };
        if exists {
            let text = format!("{} already exists", declaration.place);
            let condition = match class_of {
                None => Condition::ParameterExists,
                Some(_) => Condition::VariableExists,
            };
            return Err(Fault::new(condition, text, span));
        }
        Ok(())
    }

    fn declared_type(&self, declaration: &Declaration) -> Outcome<Type> {
        let Some(name) = &declaration.type_name else {
            let text = matches!(
                &declaration.value,
                Some(ItemValue::Expr(e)) if matches!(self.value(e), Ok(Value::Text(_)))
            );
            return Ok(if text { Type::Text(126) } else { Type::Real });
        };
        let kind = Type::from_name(&name.text.to_ascii_uppercase()).ok_or_else(|| {
            Fault::new(Condition::VariableType, format!("unknown type {}", name.text), name.span)
                .hint("use BOOLEAN, SGN08 to SGN32, UNS08 to UNS32, REAL64 or STRING[n]")
        })?;
        match (&declaration.length, kind) {
            (Some(length), Type::Text(_)) => {
                Ok(Type::Text(self.whole(length, "the length of a text", 0, 126)? as usize))
            }
            _ => Ok(kind),
        }
    }

    pub(super) fn sizes(&self, place: &Place) -> Outcome<SmallVec<[usize; 2]>> {
        let high = u32::try_from(ELEMENTS_MAX).unwrap_or(u32::MAX);
        let size = |e: &Expr| {
            let x = self.number(e)?;
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

    /// Reports initial values with fractions for a variable of an integer type.
    fn note_fractions(&mut self, declaration: &Declaration, kind: Type) {
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
            Some(ItemValue::Name(_)) | None => return,
        };
        for e in exprs {
            if let Ok(value) = self.value(e)
                && let Some(x) = kind.rounds(&value)
            {
                self.note_rounded(&declaration.place.to_string(), x, e.span);
            }
        }
    }

    /// Reports a number with a fraction that is written to a variable of an integer type.
    ///
    /// Assumption: it is rounded; the documents do not specify whether the control rounds or truncates.
    pub(super) fn note_rounded(&mut self, name: &str, x: f64, span: Span) {
        let text = format!("{name} only holds whole numbers: {x} is rounded to {}", x.round());
        let fault = Fault::new(Condition::Odd, text, span).warning();
        let hint = "use ROUND, INT, FLOOR or CEIL to select the whole number";
        self.report.note_once(&format!("rounded {name}"), fault.hint(hint));
    }

    fn start_values(
        &self,
        declaration: &Declaration,
        kind: Type,
        sizes: &[usize],
        count: usize,
    ) -> Outcome<Values> {
        let one = |e: &Expr| kind.converted(self.value(e)?, e.span);
        if sizes.is_empty() {
            return Ok(Values::One(match &declaration.value {
                None => kind.zero(),
                Some(ItemValue::Expr(e)) => one(e)?,
                Some(ItemValue::Name(n)) => {
                    return Err(Fault::new(Condition::Syntax, "a value is expected", n.span));
                }
                Some(ItemValue::List(g)) => {
                    return Err(Fault::new(
                        Condition::Syntax,
                        "a single value is expected",
                        g.span,
                    ));
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
}
