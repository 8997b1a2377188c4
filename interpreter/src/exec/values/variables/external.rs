//! External variables `V.E.`: those of the machine's list with their types, and others as the user or the program sets
//! them.
//!
//! Source: TF5200 programming manual 207988747; external variables 1091998347 (synchronisation), 112462731 (access),
//! 112479371 (start-up); diagnosis 252112267. Assumptions: all words of a block read before its motion; a variable that
//! is not in the list is synchronous; `EXIST` and `SIZEOF` do not read a value.

mod in_program;

use super::storage::{Type, note_rounded, undefined};
use crate::diag::{Condition, ValueKind};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::{Access, External, Value};
use crate::exec::report::Report;
use crate::exec::values::number::as_number;
use crate::machine::{ExternalKind, ExternalVariables};
use crate::suggest;
use crate::syntax::ast::{Segment, Span};
use std::collections::{BTreeMap, BTreeSet};

/// Names of external variables, without indices.
pub(in crate::exec) type Names = BTreeSet<String>;

/// Whether it is an external variable whose reading empties the channel.
pub(in crate::exec) fn is_synchronous(segments: &[Segment], asynchronous: &Names) -> bool {
    let [first, name, ..] = segments else { return false };
    first.name.eq_ignore_ascii_case("E") && !asynchronous.contains(&*name.name)
}

/// A variable of the machine's list.
#[derive(Clone, Debug)]
struct Declared {
    kind: Type,
    /// Number of elements of an array; 0: no array.
    elements: u32,
    access: Access,
}

/// All external variables.
#[derive(Clone, Debug, Default)]
pub(in crate::exec) struct Externals {
    /// Those of the list by their names; elements without an entry in `values` are 0 or an empty text.
    declared: BTreeMap<String, Declared>,
    /// By their names with indices.
    values: BTreeMap<String, External>,
    /// Names given by the user.
    given: BTreeSet<String>,
}

impl Externals {
    pub(super) fn new(list: &ExternalVariables) -> Self {
        let declared = list.variables.iter().map(|variable| {
            let kind = match variable.kind {
                ExternalKind::Number(name) => Type::from_name(name).unwrap_or(Type::Real),
                ExternalKind::Text(characters) => Type::Text(characters),
            };
            let access = match (variable.readable, variable.writable) {
                (true, false) => Access::ReadOnly,
                (false, _) => Access::WriteOnly,
                (true, true) => Access::ReadWrite,
            };
            (variable.name.clone(), Declared { kind, elements: variable.elements, access })
        });
        Self { declared: declared.collect(), ..Self::default() }
    }

    /// The variable of the list with a name that may end with an index; `None` if the list has none.
    fn declared(&self, name: &str, span: Span) -> Outcome<Option<&Declared>> {
        let (base, index) = match name.split_once('[') {
            Some((base, index)) => (base, Some(index.trim_end_matches(']'))),
            None => (name, None),
        };
        let Some(found) = self.declared.get(base) else { return Ok(None) };
        match index {
            None if found.elements == 0 => Ok(Some(found)),
            None => {
                let text = format!("V.E.{base} is an array of {} elements", found.elements);
                Err(Fault::new(Condition::ArrayWithoutIndex, text, span))
            }
            Some(_) if found.elements == 0 => {
                let text = format!("V.E.{base} is no array");
                Err(Fault::new(Condition::NoArray, text, span))
            }
            Some(index) => match index.parse::<u32>() {
                Ok(i) if i < found.elements => Ok(Some(found)),
                _ => {
                    let text = format!("index {index} is not in 0 to {}", found.elements - 1);
                    Err(Fault::new(Condition::VariableIndex, text, span)
                        .with(|d| d.value(ValueKind::Wrong, index, "-")))
                }
            },
        }
    }

    pub(super) fn read(&self, name: &str, span: Span) -> Outcome<Value> {
        let declared = self.declared(name, span)?;
        let known = self.values.get(name);
        if declared.map(|d| d.access).or(known.map(|v| v.access)) == Some(Access::WriteOnly) {
            let text = format!("V.E.{name} may not be read");
            return Err(Fault::new(Condition::VariableNotReadable, text, span));
        }
        if let Some(known) = known {
            return Ok(known.value.clone());
        }
        if let Some(declared) = declared {
            return Ok(declared.kind.zero());
        }
        let names = self.values.keys().chain(self.declared.keys()).map(String::as_str);
        let fault = undefined(&format!("V.E.{name}"), span);
        Err(match suggest::hint(name, names) {
            Some(hint) => fault.hint(hint),
            None => fault.hint("set the values of external variables with --external, or declare them in the list ve_var[0] of the machine"),
        })
    }

    pub(super) fn write(
        &mut self,
        name: String,
        value: Value,
        span: Span,
        report: &mut Report,
    ) -> Outcome<()> {
        let access = match self.declared(&name, span)? {
            Some(declared) => Some(declared.access),
            None => self.values.get(&name).map(|known| known.access),
        };
        match access {
            Some(Access::ReadOnly) => {
                let text = format!("V.E.{name} may not be written");
                return Err(Fault::new(Condition::VariableNotWritable, text, span));
            }
            Some(_) => {}
            None => {
                let text = format!("V.E.{name} is not configured and was created by the program");
                report.note(Fault::new(Condition::ExternalCreated, text, span));
            }
        }
        self.store(name, value, span, report)
    }

    /// Writes a variable whatever its access, as the control does at start-up and the PLC at any time.
    fn store(
        &mut self,
        name: String,
        value: Value,
        span: Span,
        report: &mut Report,
    ) -> Outcome<()> {
        let value = match (self.declared(&name, span)?, self.values.get(&name), value) {
            (Some(declared), _, value) => {
                if let Some(x) = declared.kind.rounds(&value) {
                    note_rounded(report, &format!("V.E.{name}"), x, span);
                }
                declared.kind.converted(value, span)?
            }
            (None, Some(External { value: Value::Number(_), .. }), value) => {
                Value::Number(as_number(&value, span)?)
            }
            (None, Some(External { value: Value::Text(_), .. }), Value::Number(_)) => {
                let text = format!("V.E.{name} holds a text");
                return Err(Fault::new(Condition::TextExpected, text, span));
            }
            (None, _, value) => value,
        };
        match self.values.get_mut(&name) {
            Some(known) => known.value = value,
            None => {
                self.values.insert(name, External { value, access: Access::ReadWrite });
            }
        }
        Ok(())
    }

    pub(super) fn exists(&self, name: &str, span: Span) -> bool {
        let declared = self.declared(name, span);
        declared.is_ok_and(|d| d.is_some()) || self.values.contains_key(name)
    }

    /// Size of an array of the list; none for other variables.
    pub(super) fn dimensions(&self, name: &str) -> Vec<usize> {
        let found = self.declared.get(name).filter(|declared| declared.elements > 0);
        found.map(|declared| declared.elements as usize).into_iter().collect()
    }

    /// Variables given by the user that are not among `named`, each with a similar one of these.
    pub(super) fn unused(&self, named: &BTreeSet<String>) -> Vec<(String, Option<String>)> {
        let unused = self.given.iter().filter(|name| !named.contains(*name));
        unused
            .map(|name| (name.clone(), suggest::hint(name, named.iter().map(String::as_str))))
            .collect()
    }
}
