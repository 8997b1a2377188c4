//! Calls of subroutines and cycles.
//!
//! Source: TF5200 programming manual, subroutine techniques. Plain subroutines share all state with their caller.

use super::executor::Executor;
use super::state::{ModalCycle, Passed, Target};
use crate::diag::{Condition, ValueKind};
use crate::exec::block::collected::CycleCall;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::machine::table::channel as of;
use crate::machine::table::param::{Param, Text};
use crate::suggest;
use crate::syntax::ast::{Call, CallKind, Group, Ident, Item, ItemKind, ItemValue, Span};
use std::sync::Arc;

/// Maximum number of program levels. Assumption: the vendor prints no number.
pub(super) const LEVELS_MAX: usize = 32;

/// Text for a call beyond [`LEVELS_MAX`].
pub(super) fn too_deep() -> String {
    let subroutines = LEVELS_MAX - 1;
    format!(
        "subroutines nested more than {subroutines} deep: {LEVELS_MAX} levels including the main program"
    )
}

/// The bracket of `L CYCLE`.
#[derive(Default)]
struct CycleKeys {
    name: Option<Ident>,
    passed: Passed,
    /// For a modal cycle: whether every block calls it, and not only those that move.
    modal: Option<bool>,
}

/// Maximum number of local subroutines named in a hint.
const NAMED_MAX: usize = 12;

impl Executor {
    /// `L`, `LL`.
    pub(in crate::exec) fn call(&mut self, call: &Call, span: Span) {
        match &call.kind {
            CallKind::Program(name) => self.call_named(name, call.local, None),
            CallKind::Variable(place) => match self.decoder.read(place) {
                Ok(Value::Text(text)) => {
                    let name = Ident { text, span: place.span };
                    self.call_named(&name, call.local, None);
                }
                Ok(Value::Number(_)) => {
                    let text = "the variable holds a number, not the name of a program";
                    let fault = Fault::new(Condition::Syntax, text, place.span);
                    let hint = "assign the name as a text: V.E.NAME = \"sub.nc\"";
                    self.decoder.report.note(fault.hint(hint));
                }
                Err(fault) => self.decoder.report.note(fault),
            },
            CallKind::Cycle(group) => self.call_cycle(group, call.local, span),
            CallKind::Sequence(group) => self.call_sequence(group),
        }
    }

    fn call_named(&mut self, name: &Ident, local: bool, cycle: Option<Passed>) {
        if self.has_room(local, name.span)
            && let Some(target) = self.named(name, local)
        {
            self.push_level(target, cycle);
        }
    }

    fn named(&mut self, name: &Ident, local: bool) -> Option<Target> {
        if local { self.local(name) } else { self.global(name) }
    }

    /// Whether one more level may be entered; if not, reports an error.
    fn has_room(&mut self, local: bool, span: Span) -> bool {
        let room = self.levels.has_room();
        if !room {
            let condition = if local { Condition::Nesting } else { Condition::SubroutineNesting };
            let fault = Fault::new(condition, too_deep(), span);
            let fault = fault.with(|d| d.value(ValueKind::Limit, LEVELS_MAX as f64, "-"));
            self.decoder.report.note(fault);
        }
        room
    }

    fn local(&mut self, name: &Ident) -> Option<Target> {
        let level = self.levels.last()?;
        if let Some(section) = level.index.local(&name.text) {
            return Some(Target { file: level.file, section });
        }
        let subs = level.index.sections.iter().filter(|s| s.local);
        let known: Vec<&str> = subs.filter_map(|s| s.name.as_deref()).collect();
        let text = format!("this file has no local subroutine {}", name.text);
        let fault = Fault::new(Condition::NoSubroutine, text, name.span);
        let hint = match suggest::hint(&name.text, known.iter().copied()) {
            Some(hint) => hint,
            None if known.is_empty() => "begin a local subroutine with %L NAME".to_owned(),
            None if known.len() > NAMED_MAX => {
                format!("local subroutines: {} and others", known[..NAMED_MAX].join(", "))
            }
            None => format!("local subroutines: {}", known.join(", ")),
        };
        self.decoder.report.note(fault.hint(hint));
        None
    }

    pub(super) fn global(&mut self, name: &Ident) -> Option<Target> {
        let caller = self.levels.last().map(|l| l.file);
        let path = name.text.replace('\\', "/");
        let file = self.open_called(&path, caller, name.span)?;
        let index = Arc::clone(&self.files.file(file).index);
        let Some(section) = index.main() else {
            let text = format!("{} does not contain a program to call", name.text);
            self.decoder.report.note(Fault::new(Condition::NoSubroutine, text, name.span));
            return None;
        };
        Some(Target { file, section })
    }

    fn open_called(&mut self, path: &str, caller: Option<usize>, span: Span) -> Option<usize> {
        match self.files.open(path, caller, &self.parser) {
            Ok((file, diagnostics)) => {
                for diagnostic in diagnostics {
                    self.report(diagnostic);
                }
                self.other_case(path, file, span);
                Some(file)
            }
            Err(error) => {
                let index = self.levels.last().map(|level| &level.index);
                // LLAB is L with the name LAB
                let names = [Some(path), path.strip_prefix(['L', 'l'])];
                let mut names = names.into_iter().flatten();
                let local = index.and_then(|index| names.find(|name| index.local(name).is_some()));
                let (text, hint) = error.text(path, local);
                let fault = Fault::new(Condition::NoFile, format!("subroutine {text}"), span);
                self.decoder.report.note(fault.hint(hint));
                None
            }
        }
    }

    /// Searches for the file of `#FILE EXIST`, in the same way as for a subroutine of this name.
    ///
    /// Assumption: the page prints paths with a backslash after the folder, and does not give their value without a
    /// file.
    pub(super) fn search_file(&mut self) {
        let Some((name, span)) = self.decoder.calls.searched.wanted.take() else { return };
        let caller = self.levels.last().map(|level| level.file);
        let found = self.files.search(&name.replace('\\', "/"), caller);
        self.decoder.calls.searched.found = match found {
            Ok(path) => Some(path.replace('/', "\\").into()),
            Err(error) => {
                let text = format!("#FILE EXIST: {name} does not exist ({})", error.reason);
                let note = Fault::new(Condition::Odd, text, span);
                self.decoder
                    .report
                    .note(note.hint(format!("searched: {}", error.searched.join(", "))));
                None
            }
        };
    }

    /// A note if the name of the file differs from the call in upper and lower case: not every file system finds it.
    fn other_case(&mut self, path: &str, file: usize, span: Span) {
        let parts = path.trim_start_matches("./").split('/').count();
        let last = |name: &str| {
            let mut names: Vec<&str> = name.rsplit('/').take(parts).collect();
            names.reverse();
            names.join("/")
        };
        let (wanted, found) = (last(path), last(&self.files.file(file).name.replace('\\', "/")));
        if wanted != found && wanted.to_lowercase() == found.to_lowercase() {
            let text =
                format!("{wanted} is {found}: upper and lower case differ from the file name");
            let note = Fault::new(Condition::Odd, text, span);
            self.decoder.report.note(note.hint("write the name as it is on disk: case-sensitive file systems do not find it under this name"));
        }
    }

    /// `L CYCLE [NAME=.. @P1=..]`.
    fn call_cycle(&mut self, group: &Group, local: bool, span: Span) {
        let mut keys = CycleKeys::default();
        let mut faulty = false;
        for item in &group.items {
            if let Err(fault) = self.cycle_key(item, &mut keys) {
                // the rest of a word that is not understood would be another error
                let ends = fault.diagnostic.id == Condition::TokenUnknown.id();
                faulty = true;
                self.decoder.report.note(fault);
                if ends {
                    break;
                }
            }
        }
        if faulty {
            return;
        }
        let CycleKeys { name, passed, modal } = keys;
        let Some(name) = name else {
            let fault = Fault::new(Condition::TokenUnknown, "L CYCLE needs NAME", span);
            self.decoder.report.note(fault);
            return;
        };
        if self.decoder.modal.path.is_thread() {
            let text = "a thread is being cut: a cycle cannot be called";
            self.decoder.report.note(Fault::new(Condition::CycleInThread, text, span));
            return;
        }
        if self.decoder.calls.modal_cycle.is_some() {
            let text = "a modal cycle is active: another cycle cannot be called";
            self.decoder.report.note(Fault::new(Condition::CycleWhileModal, text, span));
            return;
        }
        if !self.has_room(local, name.span) {
            return;
        }
        let Some(target) = self.named(&name, local) else { return };
        if let Some(every_block) = modal {
            let (named, passed) = (name.span, passed.clone());
            let modal = ModalCycle { target, named, passed, every_block };
            self.decoder.calls.modal_cycle = Some(modal);
        }
        self.push_level(target, Some(passed));
    }

    /// Reads one entry of the bracket of `L CYCLE`.
    fn cycle_key(&self, item: &Item, keys: &mut CycleKeys) -> Outcome<()> {
        match &item.kind {
            ItemKind::Missing => {}
            ItemKind::Flag(word) if word.is("MODAL_MOVE") || word.is("MODAL") => {
                keys.modal = Some(false);
            }
            ItemKind::Flag(word) if word.is("MODAL_BLOCK") => keys.modal = Some(true),
            ItemKind::Pair { key, value } if key.is("NAME") => {
                let name = self.cycle_name(value)?;
                if keys.name.is_some() {
                    return Err(Fault::new(Condition::CycleKeyTwice, "NAME twice", key.span));
                }
                keys.name = Some(name);
            }
            ItemKind::Pair { key, .. } if !is_cycle_parameter(&key.text) => {
                let text = format!("{}: a cycle takes @P1 to @P200", key.text);
                return Err(Fault::new(Condition::Range, text, key.span));
            }
            ItemKind::Pair { key, value } if key.text.starts_with("@P") => {
                let value = self.cycle_value(value)?;
                if keys.passed.insert(key.text[1..].into(), value).is_some() {
                    let text = format!("{} twice", key.text);
                    return Err(Fault::new(Condition::CycleKeyTwice, text, key.span));
                }
            }
            _ => {
                let text = "L CYCLE: NAME= or @P..= is expected";
                let hint =
                    "write L CYCLE [NAME=\"file\" @P1=..]; @X and @S are words inside the cycle";
                return Err(Fault::new(Condition::TokenUnknown, text, item.span).hint(hint));
            }
        }
        Ok(())
    }

    fn cycle_name(&self, value: &ItemValue) -> Result<Ident, Box<Fault>> {
        match value {
            ItemValue::Name(name) => Ok(name.clone()),
            ItemValue::Expr(expr) => match self.decoder.value(expr)? {
                Value::Text(text) => Ok(Ident { text, span: expr.span }),
                Value::Number(_) => {
                    Err(Fault::new(Condition::TokenUnknown, "a file name is expected", expr.span))
                }
            },
            ItemValue::List(group) => {
                Err(Fault::new(Condition::TokenUnknown, "a file name is expected", group.span))
            }
        }
    }

    fn cycle_value(&self, value: &ItemValue) -> Result<Value, Box<Fault>> {
        match value {
            ItemValue::Expr(expr) => self.decoder.value(expr),
            ItemValue::Name(name) => Ok(Value::Text(name.text.clone())),
            ItemValue::List(group) => {
                Err(Fault::new(Condition::TokenUnknown, "a value is expected", group.span))
            }
        }
    }

    /// G80 to G89, G800 to G839: a cycle if it has values, otherwise a subroutine.
    pub(in crate::exec) fn implicit_call(&mut self, call: &CycleCall) {
        let Some(file) = self.decoder.calls.cycle_files.get(&call.number).cloned() else { return };
        let name = Ident { text: file.into(), span: call.span };
        let Some(values) = &call.values else {
            self.call_named(&name, false, None);
            return;
        };
        if self.decoder.calls.modal_cycle.is_some() {
            let text = format!(
                "a modal cycle is active: another cycle cannot be called (G{})",
                call.number
            );
            self.decoder.report.note(Fault::new(Condition::CycleWhileModal, text, call.span));
            return;
        }
        let values = values.iter().zip(1..);
        let passed = values
            .filter_map(|(value, i): (_, u32)| Some((format!("P{i}").into(), value.clone()?)));
        self.call_named(&name, false, Some(passed.collect()));
    }

    /// A global subroutine named by a parameter.
    pub(in crate::exec) fn call_of_list(&mut self, file: &str, parameter: Param<Text>, span: Span) {
        let levels = self.levels.len();
        self.call_named(&Ident { text: file.into(), span }, false, None);
        if self.levels.len() == levels {
            self.decoder.report.amend(|d| d.parameter(parameter));
        }
    }

    /// M06 with its program.
    pub(in crate::exec) fn tool_change(&mut self, span: Span) {
        if let Some(file) = self.decoder.calls.tool_change_file.clone() {
            self.call_of_list(&file, of::TOOL_CHANGE_PROGRAM, span);
        }
    }

    /// D with its program.
    ///
    /// Assumption: `#TOOL DATA` is not a D word and does not call the program; a D word in the program itself calls it
    /// again.
    pub(in crate::exec) fn tool_data(&mut self, span: Span) {
        if let Some(file) = self.decoder.calls.tool_data_file.clone() {
            self.call_of_list(&file, of::TOOL_DATA_PROGRAM, span);
        }
    }

    /// The modal cycle after a block that began at this number of levels. Not inside cycles; after a block without
    /// motion only if the block neither calls nor ends a program. Source: TF5200 programming manual, cycles as
    /// subroutines.
    pub(in crate::exec) fn modal_cycle(&mut self, levels: usize) {
        let Some(cycle) = &self.decoder.calls.modal_cycle else { return };
        let inside = self.levels.iter().any(|l| l.cycle.is_some()) || self.levels.len() < levels;
        let wanted = self.decoder.moved || cycle.every_block && self.levels.len() == levels;
        if inside || self.has_ended() || !wanted {
            return;
        }
        let ModalCycle { target, named, passed, .. } = cycle.clone();
        if self.has_room(false, named) {
            self.push_level(target, Some(passed));
        }
    }
}

/// False for `@P0` and for numbers above `@P200`. Source: TF5200 programming manual 206859019.
fn is_cycle_parameter(key: &str) -> bool {
    let index = key.strip_prefix("@P").filter(|index| index.bytes().all(|b| b.is_ascii_digit()));
    index.is_none_or(|index| matches!(index.parse(), Ok(1..=200_u32)))
}
