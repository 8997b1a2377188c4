//! Programs and local subroutines of a file, and the `%` blocks between them.

use super::Builder;
use crate::diag::{Condition, Diagnostic, Severity};
use crate::exec::program::index::Section;
use crate::exec::program::index::head::name_of;
use crate::exec::program::index::keyword::Keyword;
use crate::source::{Position, RawBlock};
use crate::syntax::ast::Span;
use std::sync::Arc;

impl Builder<'_> {
    /// Begins a program or a local subroutine.
    pub(super) fn open_section(&mut self, name: Option<&str>, local: bool, start: Position) {
        self.section = Some(self.index.sections.len());
        self.has_main |= !local;
        let name: Option<Arc<str>> = name.map(Arc::from);
        if let (Some(name), true, Some(section)) = (&name, local, self.section) {
            self.index.locals_upper.entry(name.to_ascii_uppercase()).or_insert(section);
            self.index.locals.entry(Arc::clone(name)).or_insert(section);
        }
        self.index.sections.push(Section { name, local, start, end: u64::MAX });
    }

    /// Ends the section; open structures end with it.
    pub(super) fn close(&mut self, offset: u64) {
        if let Some(section) = self.section.take() {
            self.index.sections[section].end = offset;
        }
        self.stack.clear();
        self.conditional.clear();
        self.conditional_open.clear();
    }

    /// A `%` block.
    pub(super) fn program_head(&mut self, raw: &RawBlock<'_>, rest: &str) {
        let behind = &rest[1..];
        let local = behind
            .strip_prefix(['L', 'l'])
            .filter(|name| name.starts_with([' ', '\t']))
            .map(str::trim_start)
            // without a name it is a main program called L
            .filter(|name| name_of(name).is_some());
        let next = Position { offset: raw.position.offset, line: raw.position.line };
        if let Some(text) = local {
            self.behind_end = None;
            let nameless = |main: &usize| self.index.sections[*main].name.is_none();
            self.unfinished =
                self.unfinished.or(self.section.filter(nameless)).filter(|_| !self.end_seen);
            self.close(raw.position.offset);
            let name = name_of(text);
            if self.has_main {
                let text = "a local subroutine after the main program: the control may refuse it";
                let d = Diagnostic::new(Condition::Odd, text).severity(Severity::Note);
                self.report(raw, raw.text.len() - rest.len(), 2, d);
            }
            if name.is_some_and(|name| self.index.locals.contains_key(name)) {
                let text = format!("local subroutine {} twice", name.unwrap_or(""));
                let d = Diagnostic::new(Condition::Odd, text).severity(Severity::Warning);
                self.report(raw, raw.text.len() - rest.len(), rest.trim_end().len(), d);
            }
            self.words_after_name(raw, text);
            self.open_section(name, true, next);
        } else if let (Some(_), Some(name)) = (self.unfinished, name_of(behind.trim_start())) {
            // a reader takes %MAIN for the program
            let text = format!(
                "program {name} never runs: the blocks before the first % are the main program"
            );
            let hint = "do not write blocks before the first %L or %; write M30 after the blocks if they are the program";
            let d = Diagnostic::new(Condition::TextBehindEnd, text);
            let d = d.severity(Severity::Error).hint(hint);
            self.report(raw, raw.text.len() - rest.len(), rest.trim_end().len(), d);
            self.unfinished = None;
        } else if self.has_main {
            // only at the end of the file is it known whether it is a remark
            let id = self.push(raw.position, raw.text.len() - rest.len(), Keyword::Remark);
            if self.end_seen && !self.remarks.iter().any(|(_, ended_before)| *ended_before) {
                let at = raw.text.len() - rest.len();
                let end = at + rest.trim_end().len();
                self.behind_end = Some(raw.locate(self.file, Span::new(at, end)));
            }
            self.remarks.push((id, self.end_seen));
        } else {
            self.close(raw.position.offset);
            self.words_after_name(raw, behind.trim_start());
            self.open_section(name_of(behind.trim_start()), false, next);
        }
    }

    /// The text after the name in a `%` block is not executed, although it may look so, unlike a remark; `head` ends
    /// with the block.
    fn words_after_name(&mut self, raw: &RawBlock<'_>, head: &str) {
        let Some(name) = name_of(head) else { return };
        let words = head[name.len()..].trim_start();
        let is_remark = words.starts_with(['(', ';']) || words.is_empty();
        if !is_remark {
            let words = words.trim_end();
            let text = format!("`{words}` after the name of a program is not executed");
            let d = Diagnostic::new(Condition::Odd, text).severity(Severity::Warning);
            let d = d.hint("write words of the program in a block of their own, remarks in (..)");
            let at = raw.text.len() - head[name.len()..].trim_start().len();
            self.report(raw, at, words.len(), d);
        }
    }

    /// A `%` block ends the main program if a further program follows in the file.
    pub(super) fn decide_remarks(&mut self) {
        let Some(main) = self.index.main() else { return };
        let subroutine_behind =
            self.index.sections[main + 1..].iter().any(|s| s.local).then_some(());
        for (id, ended_before) in &self.remarks {
            let offset = self.index.entry(*id).position.offset;
            if subroutine_behind.is_some() || (*ended_before && self.end_seen) {
                let end = &mut self.index.sections[main].end;
                *end = (*end).min(offset);
            }
        }
    }
}
