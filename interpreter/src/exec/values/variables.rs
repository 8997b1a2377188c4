//! P parameters, self-defined variables (`V.P`, `V.L`, `V.S`, `V.CYC`), external variables and cycle parameters.
//!
//! Source: TF5200 programming manual, parameters and variables. Assumptions: array indices begin at 0; a number written
//! to an integer variable is rounded; an index of a P parameter is at most [`INDEX_MAX`], and all arrays together have
//! at most [`storage::ELEMENTS_MAX`] elements, so that a program cannot exhaust memory.

mod declare;
pub(super) mod scopes;
mod storage;

use super::number::{as_number, whole};
use super::system;
use crate::diag::{Condition, Diagnostic, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::{Access, External, Value};
use crate::suggest;
use crate::syntax::ast::{Expr, ParameterIndex, Place, PlaceKind, Segment, Span};
use scopes::{Class, Variables, class};
use smallvec::SmallVec;
use storage::{Owner, Variable};

/// Highest index of a P parameter.
const INDEX_MAX: u32 = 1_000_000;

/// A resolved place.
enum Target<'a> {
    Parameter(u32, Subscripts),
    Own(Class, Name<'a>, Subscripts),
    External(String),
    Cycle(&'a str),
    System(&'a [Segment]),
}

type Subscripts = SmallVec<[f64; 2]>;
type Name<'a> = std::borrow::Cow<'a, str>;

fn undefined(what: &str, span: Span) -> Box<Fault> {
    Fault::new(Condition::Undefined, format!("{what} has no value"), span)
}

/// 21382.
fn outside_cycle(name: &str, span: Span) -> Box<Fault> {
    let text = format!("@{name} exists only inside a cycle");
    Fault::new(Condition::CycleParameterOutside, text, span)
}

/// `G04 P500` of other controls is read as the value of P500 here.
fn undefined_parameter(index: u32, span: Span) -> Box<Fault> {
    Fault::new(Condition::ParameterUnknown, format!("P{index} has no value"), span).hint(format!(
        "P is a parameter in this dialect, not an address: P{index}=5 assigns a value"
    ))
}

/// Number of a parameter `@P`.
fn number_of(name: &str) -> Option<u32> {
    name.strip_prefix(['P', 'p']).and_then(|rest| rest.parse().ok())
}

/// Advice for a parameter that was not passed to a cycle.
fn pass_it(name: &str) -> String {
    match number_of(name) {
        Some(number) => format!("pass it, or test V.G.@P[{number}].VALID first"),
        None => format!("pass it in the call: L CYCLE [NAME=.. @{name}=..]"),
    }
}

impl Variables {
    /// Value of `@name`; `creates`: reading a `@P` that was not passed creates it (P-CHAN-00463).
    ///
    /// Assumption: its initial value is 0, and `V.G.@P[i].VALID` remains FALSE.
    fn cycle_parameter(&self, name: &str, creates: bool, span: Span) -> Outcome<Value> {
        let Some(scope) = self.cycles.last() else {
            return Err(outside_cycle(name, span));
        };
        if let Some(value) = scope.passed.get(name) {
            return Ok(value.clone());
        }
        let numbered = number_of(name);
        match numbered {
            Some(_) if creates => {
                self.created.borrow_mut().push((name.into(), span));
                Ok(Value::Number(0.0))
            }
            Some(number) => {
                let text = format!("@{name} was not passed to the cycle");
                Err(Fault::new(Condition::CycleParameterMissing, text, span)
                    .hint(pass_it(name))
                    .with(|d| d.value(ValueKind::Wrong, number, "-")))
            }
            None => Err(undefined(&format!("@{name}"), span).hint(pass_it(name))),
        }
    }

    /// The parameters created by reading in this block.
    pub(in crate::exec) fn take_created(&self) -> Vec<(Box<str>, Span)> {
        self.created.take()
    }

    fn unknown(&self, class: Class, name: &str, what: &str, span: Span) -> Box<Fault> {
        let letter = match class {
            Class::Program => "P",
            Class::Local => "L",
            Class::Shared => "S",
            Class::Cycle => "CYC",
        };
        let text = format!("V.{letter}.{name} {what}");
        let fault = Fault::new(Condition::Undefined, text, span);
        match suggest::nearest(name, self.names(class)) {
            Some(near) => fault.hint(format!("did you mean `V.{letter}.{near}`?")),
            None => fault,
        }
    }
}

impl Decoder {
    /// Reports each `@P` created by reading, once.
    pub(in crate::exec) fn report_created(&mut self) {
        for (name, span) in self.values.variables.take_created() {
            let text = format!(
                "@{name} was not passed to the cycle: reading it creates it with the value 0"
            );
            let fault = Fault::new(Condition::Odd, text, span)
                .warning()
                .hint(pass_it(&name))
                .with(|d| d.parameter("P-CHAN-00463"));
            self.report.note_once(&format!("@{name}"), fault);
        }
    }

    fn subscripts(&self, exprs: &[Expr]) -> Outcome<Subscripts> {
        exprs.iter().map(|e| self.number(e)).collect()
    }

    fn resolve<'a>(&self, place: &'a Place) -> Outcome<Target<'a>> {
        match &place.kind {
            PlaceKind::Parameter { indirections, index, subscripts } => {
                let index = self.parameter_index(index, *indirections, place.span)?;
                Ok(Target::Parameter(index, self.subscripts(subscripts)?))
            }
            PlaceKind::Cycle(name) => Ok(Target::Cycle(name)),
            PlaceKind::Variable(segments) => self.resolve_variable(segments),
        }
    }

    fn resolve_variable<'a>(&self, segments: &'a [Segment]) -> Outcome<Target<'a>> {
        let first = segments.first().map_or("", |s| &*s.name);
        let rest = segments.get(1..).unwrap_or_default();
        if first.eq_ignore_ascii_case("E") {
            let name = self.external_name(rest)?;
            self.values.variables.uses_external(&name);
            return Ok(Target::External(name));
        }
        let Some((class, _)) = class(first) else { return Ok(Target::System(segments)) };
        if let [only] = rest {
            let subscripts = self.subscripts(&only.subscripts)?;
            return Ok(Target::Own(class, Name::Borrowed(&only.name), subscripts));
        }
        let mut subscripts = Subscripts::new();
        let mut name = String::new();
        for segment in rest {
            if !name.is_empty() {
                name.push('.');
            }
            name.push_str(&segment.name);
            subscripts.extend(self.subscripts(&segment.subscripts)?);
        }
        Ok(Target::Own(class, Name::Owned(name), subscripts))
    }

    fn external_name(&self, segments: &[Segment]) -> Outcome<String> {
        use std::fmt::Write as _;
        let mut name = String::new();
        for segment in segments {
            if !name.is_empty() {
                name.push('.');
            }
            name.push_str(&segment.name);
            for expr in &segment.subscripts {
                let x = self.number(expr)?;
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

    fn parameter_index(
        &self,
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
            ParameterIndex::Computed(expr) => checked(self.number(expr)?)?,
        };
        for _ in 0..indirections {
            let value = match self.values.variables.parameters().get(&index) {
                Some(variable) => variable.get(&[], Owner::Parameter, span)?,
                None => return Err(undefined_parameter(index, span)),
            };
            index = checked(as_number(&value, span)?)?;
        }
        Ok(index)
    }

    /// Value of a place.
    pub(in crate::exec) fn read(&self, place: &Place) -> Outcome<Value> {
        let span = place.span;
        match self.resolve(place)? {
            Target::Parameter(index, subscripts) => {
                match self.values.variables.parameters().get(&index) {
                    Some(variable) => variable.get(&subscripts, Owner::Parameter, span),
                    None if !subscripts.is_empty() => Err(undeclared_array(index, span)),
                    None if self.machine.channel.keep_p_parameters => {
                        let hint = "P-CHAN-00067 keeps parameters of earlier programs; here no earlier program has run";
                        Err(undefined_parameter(index, span).hint(hint))
                    }
                    None => Err(undefined_parameter(index, span)),
                }
            }
            Target::Own(class, name, subscripts) => {
                match self.values.variables.find(class, &name) {
                    Some(variable) => variable.get(&subscripts, Owner::Variable, span),
                    None => Err(self.values.variables.unknown(class, &name, "has no value", span)),
                }
            }
            Target::External(name) => match self.values.variables.external.get(&name) {
                Some(External { access: Access::WriteOnly, .. }) => Err(Fault::new(
                    Condition::VariableNotReadable,
                    format!("V.E.{name} may not be read"),
                    span,
                )),
                Some(external) => Ok(external.value.clone()),
                None => {
                    let known = self.values.variables.external.keys().map(String::as_str);
                    let hint = suggest::hint(&name, known);
                    let fault = undefined(&format!("V.E.{name}"), span);
                    Err(match hint {
                        Some(hint) => fault.hint(hint),
                        None => fault.hint("set the values of external variables with --external"),
                    })
                }
            },
            Target::Cycle(name) => {
                let creates = self.machine.channel.creates_cycle_parameters;
                self.values.variables.cycle_parameter(name, creates, span)
            }
            Target::System(segments) => system::read(self, segments, span),
        }
    }

    /// Writes a place; texts may be written to variables, not to P parameters.
    pub(in crate::exec) fn write(
        &mut self,
        place: &Place,
        value: Value,
        value_span: Span,
    ) -> Outcome<()> {
        let span = place.span;
        match self.resolve(place)? {
            Target::Parameter(index, subscripts) => {
                let number = Value::Number(as_number(&value, value_span)?);
                let table = self.values.variables.parameters_mut();
                match table.get_mut(&index) {
                    Some(variable) => variable.set(&subscripts, number, Owner::Parameter, span),
                    None if !subscripts.is_empty() => Err(undeclared_array(index, span)),
                    None => {
                        table.insert(index, Variable::created(number));
                        Ok(())
                    }
                }
            }
            Target::Own(class, name, subscripts) => {
                if let Some(variable) = self.values.variables.find_mut(class, &name) {
                    let rounded = variable.kind.and_then(|kind| kind.rounds(&value));
                    variable.set(&subscripts, value, Owner::Variable, value_span)?;
                    if let Some(x) = rounded {
                        self.note_rounded(&place.to_string(), x, value_span);
                    }
                    return Ok(());
                }
                let by_write = matches!(class, Class::Program | Class::Shared);
                if !by_write || !subscripts.is_empty() {
                    let what = "is not declared";
                    let fault = self.values.variables.unknown(class, &name, what, span);
                    return Err(fault.hint("declare it between #VAR and #ENDVAR"));
                }
                if let Some(table) = self.values.variables.table(class) {
                    table.insert((&*name).into(), Variable::created(value));
                }
                Ok(())
            }
            Target::External(name) => self.write_external(name, value, span),
            Target::Cycle(name) => match self.values.variables.cycles.last_mut() {
                Some(scope) => {
                    scope.passed.insert(name.into(), value);
                    Ok(())
                }
                None => Err(outside_cycle(name, span)),
            },
            Target::System(segments) => system::write(self, segments, &value, span),
        }
    }

    fn write_external(&mut self, name: String, value: Value, span: Span) -> Outcome<()> {
        match self.values.variables.external.get_mut(&name) {
            Some(External { access: Access::ReadOnly, .. }) => Err(Fault::new(
                Condition::VariableNotWritable,
                format!("V.E.{name} may not be written"),
                span,
            )),
            Some(external) => {
                external.value = match (&external.value, &value) {
                    (Value::Number(_), Value::Text(_)) => Value::Number(as_number(&value, span)?),
                    (Value::Text(_), Value::Number(_)) => {
                        let text = format!("V.E.{name} holds a text");
                        return Err(Fault::new(Condition::TextExpected, text, span));
                    }
                    _ => value,
                };
                Ok(())
            }
            None => {
                let text = format!("V.E.{name} is not configured and was created by the program");
                self.report.note(Fault::new(Condition::ExternalCreated, text, span));
                let access = Access::ReadWrite;
                self.values.variables.external.insert(name, External { value, access });
                Ok(())
            }
        }
    }

    /// Whether a variable or parameter exists.
    pub(in crate::exec) fn exists(&self, place: &Place) -> Outcome<bool> {
        Ok(match self.resolve(place)? {
            // an element outside the array does not exist
            Target::Parameter(index, subscripts) => {
                self.values.variables.parameters().contains_key(&index)
                    && (subscripts.is_empty() || self.read(place).is_ok())
            }
            Target::Own(class, name, subscripts) => {
                self.values.variables.find(class, &name).is_some()
                    && (subscripts.is_empty() || self.read(place).is_ok())
            }
            Target::External(name) => self.values.variables.external.contains_key(&name),
            Target::Cycle(name) => self.values.variables.passed(name).unwrap_or(false),
            Target::System(segments) => system::read(self, segments, place.span).is_ok(),
        })
    }

    /// Sizes of the dimensions of an array; none for a scalar.
    pub(in crate::exec) fn dimensions(&self, place: &Place) -> Outcome<Vec<usize>> {
        let found = match self.resolve(place)? {
            Target::Parameter(index, _) => self.values.variables.parameters().get(&index),
            Target::Own(class, name, _) => self.values.variables.find(class, &name),
            Target::System(_) => {
                let text = "SIZEOF takes arrays of the program, not variables of the control";
                return Err(Fault::new(Condition::SizeOfSystemVariable, text, place.span));
            }
            _ => None,
        };
        Ok(found.map(|v| v.sizes.to_vec()).unwrap_or_default())
    }

    /// `#DELETE`.
    pub(in crate::exec) fn delete(&mut self, place: &Place) -> Outcome<()> {
        let span = place.span;
        let removed = match self.resolve(place)? {
            Target::Parameter(index, _) => self.values.variables.parameters_mut().remove(&index),
            Target::Own(class, name, _) => {
                let gone =
                    self.values.variables.table(class).and_then(|table| table.remove(&*name));
                if gone.is_none() && class == Class::Cycle {
                    return self.absent_cycle_variable(&name, span);
                }
                if gone.is_none() && class == Class::Shared {
                    // on the control they outlive programs, so a program may delete those of another one
                    let text = format!(
                        "V.S.{name} does not exist: a run starts without variables of earlier programs"
                    );
                    let hint = "on the control, a missing variable is error 20932";
                    let fault = Fault::new(Condition::Ignored, text, span).hint(hint);
                    self.report.note_once("deleted shared variable", fault);
                    return Ok(());
                }
                if gone.is_none() {
                    let what = "does not exist";
                    let unknown = self.values.variables.unknown(class, &name, what, span);
                    return Err(
                        unknown.with(|d| Diagnostic { id: Condition::DeletedUnknown.id(), ..d })
                    );
                }
                gone
            }
            Target::External(_) | Target::Cycle(_) | Target::System(_) => {
                let text = "only variables defined by the program can be deleted";
                return Err(Fault::new(Condition::DeletedNotOwn, text, span));
            }
        };
        self.values.variables.elements -= removed.map_or(0, |v| v.elements());
        Ok(())
    }
}

impl Decoder {
    /// A V.CYC variable that this level has not created: if there is none, nothing is done; 20933 if it belongs to a
    /// level above.
    ///
    /// Source: TF5200 programming manual, 486167307.
    fn absent_cycle_variable(&self, name: &str, span: Span) -> Outcome<()> {
        if self.values.variables.find(Class::Cycle, name).is_none() {
            return Ok(());
        }
        let text = format!("V.CYC.{name} was created on a higher level");
        Err(Fault::new(Condition::DeletedAbove, text, span))
    }
}

fn undeclared_array(index: u32, span: Span) -> Box<Fault> {
    Fault::new(Condition::ArrayNotDeclared, format!("P{index} is not declared as an array"), span)
        .hint(format!("declare it between #VAR and #ENDVAR: P{index}[size]"))
}
