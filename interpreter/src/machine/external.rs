//! The external variables of a channel (P-STUP-00146): what programs read and write as `V.E.`.
//!
//! Source: TF5200 external variables. They have no addresses here, so that variables do not overlap.

use super::parameters::{Parameters, Setting};
use super::table::external as of;
use super::table::param::Place;
use crate::diag::{Condition, Diagnostic, Location, Severity, ValueKind};
use std::collections::BTreeSet;

/// Types without a length, as the list names them.
const TYPES: [&str; 8] =
    ["BOOLEAN", "SGN08", "UNS08", "SGN16", "UNS16", "SGN32", "UNS32", "REAL64"];

/// Type of an external variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ExternalKind {
    /// BOOLEAN, SGN08 to REAL64.
    Number(&'static str),
    /// STRING, VSTRING with the largest number of characters.
    Text(usize),
}

/// An external variable of the list.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ExternalVariable {
    /// Name after `V.E.`.
    pub(crate) name: String,
    /// Type.
    pub(crate) kind: ExternalKind,
    /// Number of elements of an array; 0: no array.
    pub(crate) elements: u32,
    /// Reading it empties the channel.
    pub(crate) synchronous: bool,
    /// Programs may read it.
    pub(crate) readable: bool,
    /// Programs may write it.
    pub(crate) writable: bool,
}

/// The list of external variables.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ExternalVariables {
    /// In the order of their indices.
    pub(crate) variables: Vec<ExternalVariable>,
    /// Assignments at start-up in their order, as in a program (P-EXTV-00013).
    pub(crate) init: Vec<(String, Option<Location>)>,
}

/// The first variable beyond P-EXTV-00010.
fn more_than_counted(list: &Parameters, count: u32) -> Option<Diagnostic> {
    let name = of::NAME.place().row;
    let mut settings = list.settings();
    let (_, first) = settings.find(|([i, _], setting)| setting.row == name && *i >= count)?;
    let text = format!(
        "{}: more external variables than number_used_variables = {count}, ignored",
        first.value.text().unwrap_or_default()
    );
    let about = Diagnostic::new(Condition::ListCount, text).parameter(of::COUNT);
    Some(at(about, first))
}

impl ExternalVariables {
    /// The variables of a list: up to P-EXTV-00010, and up to the first one with an unknown type (20088).
    pub(super) fn new(list: &Parameters, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let entries =
            |param: Place| list.settings().filter(move |(_, setting)| setting.row == param.row);
        let mut variables: Vec<ExternalVariable> = Vec::new();
        let count = list.get(of::COUNT);
        diagnostics.extend(more_than_counted(list, count));
        for ([i, _], setting) in entries(of::NAME.place()).filter(|([i, _], _)| *i < count) {
            let Some(name) = list.get(of::NAME.at(i)).filter(|name| !name.is_empty()) else {
                continue;
            };
            let type_name = list.get(of::KIND.at(i)).unwrap_or_default();
            let kind = match kind(list, i, &type_name) {
                Ok(Some(kind)) => kind,
                Ok(None) => {
                    let text = format!(
                        "external variable {name}: structures are not simulated, it does not exist"
                    );
                    let about = Diagnostic::new(Condition::Unsupported, text);
                    diagnostics.push(at(about.severity(Severity::Warning), setting));
                    continue;
                }
                Err(()) => {
                    let text = format!(
                        "external variable {name}: unknown type {type_name}; this one and those after it do not exist"
                    );
                    let about = Diagnostic::new(Condition::ExternalType, text)
                        .value(ValueKind::Current, i, "-")
                        .parameter(of::KIND);
                    diagnostics.push(at(about, list.set_by(of::KIND.at(i)).unwrap_or(setting)));
                    break;
                }
            };
            if variables.iter().any(|v| v.name == name) {
                let text = format!(
                    "external variable {name} is defined before, the second definition has no effect"
                );
                diagnostics.push(at(Diagnostic::new(Condition::ListNoEffect, text), setting));
                continue;
            }
            let access = list.get(of::ACCESS.at(i)).unwrap_or_default();
            variables.push(ExternalVariable {
                kind,
                elements: list.get(of::ELEMENTS.at(i)),
                synchronous: list.get(of::SYNCHRONOUS.at(i)),
                readable: access != "WRITE_ONLY",
                writable: access != "READ_ONLY",
                name,
            });
        }
        let init = entries(of::INIT.place())
            .filter_map(|(_, s)| Some((s.value.text()?.to_owned(), s.at.clone())));
        Self { variables, init: init.collect() }
    }

    /// The names of those that are read while the program is decoded.
    pub(crate) fn asynchronous(&self) -> BTreeSet<String> {
        let read = self.variables.iter().filter(|v| !v.synchronous);
        read.map(|v| v.name.clone()).collect()
    }
}

/// A diagnostic at the entry of a list.
fn at(mut diagnostic: Diagnostic, setting: &Setting) -> Diagnostic {
    diagnostic.source.clone_from(&setting.at);
    diagnostic
}

/// The type of variable `i`; `None`: a structure.
fn kind(list: &Parameters, i: u32, name: &str) -> Result<Option<ExternalKind>, ()> {
    if let Some(number) = TYPES.iter().find(|t| t.eq_ignore_ascii_case(name)) {
        return Ok(Some(ExternalKind::Number(number)));
    }
    let characters = match name.to_ascii_uppercase().as_str() {
        "STRING" if list.get(of::LONG_TEXTS) => 127,
        "STRING" => 20,
        "VSTRING" => (list.get(of::SIZE.at(i)) as usize).saturating_sub(1),
        _ => {
            let mut structures = list.array(of::STRUCTURE);
            return structures.any(|(_, structure)| structure == name).then_some(None).ok_or(());
        }
    };
    Ok(Some(ExternalKind::Text(characters)))
}
