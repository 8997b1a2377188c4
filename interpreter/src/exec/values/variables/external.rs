//! External variables `V.E.`: those of the machine's list with their types, and others as the user or the program sets
//! them.
//!
//! Source: TF5200 programming manual 207988747; external variables 1091998347 (synchronisation), 112462731 (access),
//! 112479371 (start-up); diagnosis 252112267. Assumptions: all words of a block read before its motion; a variable that
//! is not in the list is synchronous; `EXIST` and `SIZEOF` do not read a value.

use super::note_rounded;
use super::resolve::undefined;
use super::storage::Type;
use crate::diag::{Condition, Diagnostic, ValueKind};
use crate::exec::block::choice::Compensation;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::{Access, External, Value};
use crate::exec::report::Report;
use crate::exec::step::Sync;
use crate::exec::values::number::as_number;
use crate::machine::{ExternalKind, ExternalVariables};
use crate::source::RawBlock;
use crate::suggest;
use crate::syntax::Parser;
use crate::syntax::ast::{
    Assign, Body, Expr, ExprKind, Place, PlaceKind, Segment, Span, Word, WordKind,
};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

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

impl Decoder {
    /// The values of external variables at program start: the assignments of the list, then those given by the user.
    /// Messages: 21840, 21841; an error of the user's value.
    pub(in crate::exec) fn start_external(&mut self, given: BTreeMap<String, External>) {
        let machine = Arc::clone(&self.machine);
        for (text, at) in &machine.external.init {
            if let Err(mut diagnostic) = self.initialise(text) {
                diagnostic.source.clone_from(at);
                self.report.unplaced.push(*diagnostic);
            }
        }
        let externals = &mut self.values.variables.external;
        for (name, External { value, access }) in given {
            externals.given.insert(name.clone());
            let set = externals.store(name.clone(), value, Span::default(), &mut self.report);
            match (set, externals.values.get_mut(&name)) {
                (Ok(()), Some(known)) => known.access = access,
                (Err(fault), _) => {
                    let mut diagnostic = fault.diagnostic;
                    diagnostic.text = format!("--external {name}: {}", diagnostic.text);
                    self.report.unplaced.push(diagnostic);
                }
                (Ok(()), None) => {}
            }
        }
        let rounded = self.report.take_faults().into_iter().map(|fault| fault.diagnostic);
        self.report.unplaced.extend(rounded);
    }

    /// Executes an assignment of the list (P-EXTV-00013); one that fails leaves its variable at 0.
    fn initialise(&mut self, text: &str) -> Result<(), Box<Diagnostic>> {
        let refused = |condition, why: &str| {
            Box::new(Diagnostic::new(condition, format!("init {text}: {why}")))
        };
        let no_assignment = "no assignment to a variable of the list, no effect";
        let mut found = Vec::new();
        let raw = RawBlock::from_line(text);
        let block = Parser::new([]).block(&raw, &Arc::from("init"), &mut found);
        if let Some(error) = found.iter().find(|d| d.is_error()) {
            return Err(refused(Condition::ExternalNotInitialised, &error.text));
        }
        let words = match &block.body {
            Body::Words(words) => &words[..],
            _ => &[],
        };
        let assign = match words {
            [Word { kind: WordKind::Assign(assign), .. }]
                if assign.operator.is_none() && is_external(&assign.target) =>
            {
                assign
            }
            _ => return Err(refused(Condition::ExternalNotInitialised, no_assignment)),
        };
        let span = assign.target.span;
        let name = self.external_name_of(&assign.target).ok().filter(|name| {
            let externals = &self.values.variables.external;
            externals.declared(name, span).is_ok_and(|declared| declared.is_some())
        });
        let Some(name) = name else {
            return Err(refused(Condition::ExternalNotInitialised, no_assignment));
        };
        let failed = if let Some(other) = other_variable(assign) {
            let why = format!("{other} is no external variable, the variable is 0");
            refused(Condition::ExternalInitVariable, &why)
        } else {
            let outcome = self.value(&assign.value).and_then(|value| {
                let externals = &mut self.values.variables.external;
                externals.store(name.clone(), value, assign.value.span, &mut self.report)
            });
            let Err(fault) = outcome else { return Ok(()) };
            let why = format!("{}, the variable is 0", fault.diagnostic.text);
            refused(Condition::ExternalNotInitialised, &why)
        };
        self.values.variables.external.values.remove(&name);
        Err(failed)
    }

    /// Empties the channel before a block reads a synchronous external variable: an implicit `#FLUSH WAIT`.
    ///
    /// # Errors
    /// 20651 where that is not permitted: under tool radius compensation, contouring, `#HSC` and Akima splines; 90050 between
    /// G40 and the motion that ends the compensation; 21909 between two contour lines. K-0111 if G260 has ended contouring
    /// and the corner before it would still be rounded.
    pub(in crate::exec) fn flush_for_external(&mut self, read: Span) -> Outcome<()> {
        let active = if self.modal.compensation != Compensation::Off {
            Some(("tool radius compensation is", "G40"))
        } else if self.is_contouring() {
            Some(("contouring is", "G260"))
        } else if self.contour.hsc.on {
            Some(("#HSC is", "#HSC OFF"))
        } else if self.contour.akima.selected {
            Some(("an Akima spline is", "G150"))
        } else {
            None
        };
        if let Some((active, end)) = active {
            let text = format!(
                "reading an external variable empties the channel, which is not permitted while {active} active"
            );
            let hint = format!(
                "read it into a P parameter before, or write {end} first; variables that the list of the machine declares with synchronisation FALSE are read without a stop"
            );
            return Err(Fault::new(Condition::FlushWithCompensation, text, read).hint(hint));
        }
        if self.contour.awaits_departure() {
            let text =
                "external variable read before the motion that ends tool radius compensation";
            return Err(Fault::new(Condition::FlushAfterCompensation, text, read));
        }
        self.motion.contour_line.may_flush("external variable read", read)?;
        if self.contour.has_contoured_corner() {
            self.note_lost_corner();
        }
        self.sync(Sync::FlushWait);
        Ok(())
    }
}

fn is_external(place: &Place) -> bool {
    match &place.kind {
        PlaceKind::Variable(segments) => {
            segments.first().is_some_and(|first| first.name.eq_ignore_ascii_case("E"))
        }
        PlaceKind::Parameter { .. } | PlaceKind::Cycle(_) => false,
    }
}

/// The first variable of another class on the right side of an assignment.
fn other_variable(assign: &Assign) -> Option<&Place> {
    let mut open: Vec<&Expr> = vec![&assign.value];
    while let Some(expr) = open.pop() {
        match &expr.kind {
            ExprKind::Place(place) if !is_external(place) => return Some(place),
            ExprKind::Negate(inner) => open.push(inner),
            ExprKind::Binary(binary) => open.extend([&binary.right, &binary.left]),
            ExprKind::Call(call) => open.extend(&call.arguments),
            _ => {}
        }
    }
    None
}
