//! Control statements and their nesting, in the pass over the text.

use super::Builder;
use crate::diag::{Condition, Diagnostic};
use crate::exec::program::index::EntryId;
use crate::exec::program::index::head::{Head, contains_goto, word};
use crate::exec::program::index::keyword::Keyword;
use crate::source::RawBlock;

/// Maximum nesting of control statements. Assumption: the vendor prints no number for 20211.
const STATEMENTS_MAX: usize = 64;

/// Nesting at which reading of the file stops; up to this depth, each fault is reported.
const NESTING_READ: usize = 4 * STATEMENTS_MAX;

impl Builder<'_> {
    pub(super) fn control(&mut self, raw: &RawBlock<'_>, head: &Head<'_>) {
        let name = word(head.rest.trim_start_matches('$').trim_start());
        let found = Keyword::of_control(&name).or_else(|| Keyword::meant_by(&name));
        let Some(mut keyword) = found else { return };
        if keyword == Keyword::If && contains_goto(head.rest) {
            keyword = Keyword::IfGoto;
        }
        let id = self.push(raw.position, head.at, keyword);
        if keyword.closer().is_some() {
            self.index.entries.change(id, |e| e.open = Some(id));
            self.stack.push(id);
            self.nested(raw, head, self.stack.len(), Condition::ControlNesting);
            return;
        }
        let Some(opener) = keyword.opener() else { return };
        let found = self.stack.iter().rposition(|open| self.index.entry(*open).keyword == opener);
        let Some(depth) = found else {
            let text = format!("{} without {}", keyword.text(), opener.text());
            let d = Diagnostic::new(keyword.unexpected(), text);
            self.report(raw, head.at, name.len() + 1, d);
            return;
        };
        if let Some(inner) = self.stack.get(depth + 1).copied() {
            let inner = self.index.entry(inner);
            let closer = inner.keyword.closer().map_or("", Keyword::text);
            let text = format!(
                "{} inside {}: its {closer} is missing (line {})",
                keyword.text(),
                inner.keyword.text(),
                inner.position.line
            );
            let d = Diagnostic::new(keyword.unexpected(), text);
            let d = d.hint(format!("write {closer} before it"));
            self.report(raw, head.at, name.len() + 1, d);
            self.stack.truncate(depth + 1);
        }
        let open = self.stack[depth];
        if self.comes_too_late(open, keyword) {
            let text = match keyword {
                Keyword::Default => "a second $DEFAULT of one $SWITCH".to_owned(),
                _ => format!("{} after the $ELSE of the same $IF", keyword.text()),
            };
            let d = Diagnostic::new(keyword.unexpected(), text);
            let hint =
                format!("check whether {} of an inner structure is missing", closer_of(keyword));
            self.report(raw, head.at, name.len() + 1, d.hint(hint));
        }
        let parent = self.index.entry(open).parent;
        self.index.entries.change(id, |e| (e.open, e.parent) = (Some(open), parent));
        self.chain(open, id);
        if keyword.opener().and_then(Keyword::closer) == Some(keyword) {
            self.finish(open, id);
            self.stack.truncate(depth);
        }
    }

    /// Whether the structure has had its last clause, or its only one of this kind.
    fn comes_too_late(&mut self, open: EntryId, keyword: Keyword) -> bool {
        match keyword {
            Keyword::Default => !self.defaults.insert(open),
            Keyword::Else | Keyword::ElseIf => self
                .last_clause
                .get(&open)
                .is_some_and(|last| self.index.entry(*last).keyword == Keyword::Else),
            _ => false,
        }
    }

    /// 20211 for a control statement nested too deeply, 20590 for `#IF`. Assumption: both have the same limit; the
    /// documents print neither.
    pub(super) fn nested(
        &mut self,
        raw: &RawBlock<'_>,
        head: &Head<'_>,
        depth: usize,
        condition: Condition,
    ) {
        if depth > STATEMENTS_MAX {
            let text = format!("control statements nested more than {STATEMENTS_MAX} deep");
            let d = Diagnostic::new(condition, text);
            self.report(raw, head.at, word(&head.rest[1..]).len() + 1, d);
            self.gives_up |= depth > NESTING_READ;
        }
    }

    /// Appends a clause to its structure.
    pub(super) fn chain(&mut self, open: EntryId, id: EntryId) {
        let last = self.last_clause.insert(open, id).unwrap_or(open);
        self.index.entries.change(last, |e| e.next = Some(id));
    }

    /// Closes the structure, and sets its end in every clause.
    pub(super) fn finish(&mut self, open: EntryId, end: EntryId) {
        self.last_clause.remove(&open);
        self.defaults.remove(&open);
        let mut at = Some(open);
        while let Some(id) = at {
            self.index.entries.change(id, |e| e.end = Some(end));
            at = self.index.entry(id).next;
        }
    }
}

/// Closing statement of the structure to which a clause belongs.
fn closer_of(clause: Keyword) -> &'static str {
    clause.opener().and_then(Keyword::closer).map_or("", Keyword::text)
}
