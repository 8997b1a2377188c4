//! Structure of a program file: heads, control statements and labels with their positions; other blocks are not kept.
//!
//! It is built in one pass over the text without parsing: only the beginning of a block is read. So a jump needs no
//! search, and memory does not depend on the blocks in between.

mod build;
mod entries;
mod entry;
mod head;
mod keyword;
mod labels;
mod packed;
#[cfg(test)]
mod tests;

use crate::diag::Location;
use crate::source::Position;
use crate::syntax::ast::LabelKind;
pub(super) use build::STRUCTURE_MAX;
pub(in crate::exec) use build::build;
use entries::Entries;
pub(in crate::exec) use entry::{Entry, EntryId};
pub(in crate::exec) use head::{number_of, structure};
pub(in crate::exec) use keyword::Keyword;
pub(super) use labels::Labels;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Highest number of a label. Assumption: that of a block number of 32 bits; 20834 and 20838 print no limit.
pub(in crate::exec::program) const LABEL_MAX: u64 = u32::MAX as u64;

/// Target of a jump.
#[derive(Clone, Copy, Debug)]
pub(in crate::exec) struct LabelPlace {
    pub(in crate::exec::program) position: Position,
    /// Innermost structure around it.
    pub(in crate::exec::program) parent: Option<EntryId>,
}

/// A main program or local subroutine.
#[derive(Clone, Debug)]
pub(in crate::exec) struct Section {
    pub(in crate::exec::program) name: Option<Arc<str>>,
    pub(in crate::exec::program) local: bool,
    /// First block.
    pub(in crate::exec::program) start: Position,
    /// Offset at which the next section begins, or of the end of the file.
    pub(in crate::exec::program) end: u64,
}

/// Structure of a file.
#[derive(Debug, Default)]
pub(in crate::exec) struct Index {
    entries: Entries,
    pub(in crate::exec::program) sections: Vec<Section>,
    labels: Labels,
    /// First local subroutine of each name.
    locals: BTreeMap<Arc<str>, usize>,
    /// The same without regard to case; names in upper case.
    locals_upper: BTreeMap<String, usize>,
    /// Head of a further program with blocks, after the end of the main one.
    pub(super) further: Option<Location>,
}

impl Index {
    /// The entry at a position.
    pub(in crate::exec) fn at(&self, position: Position) -> Option<EntryId> {
        let (id, last) = self.entries.last_up_to(position.offset)?;
        (last.offset == position.offset).then_some(id)
    }

    pub(in crate::exec) fn entry(&self, id: EntryId) -> Entry {
        self.entries.get(id)
    }

    /// Comments and `#IF` statements, in the order of the text.
    pub(super) fn silencing(&self) -> impl Iterator<Item = Entry> {
        self.entries.silencing()
    }

    /// Whether a jump leads from outside into a branch between `#IF` and `#ENDIF`.
    ///
    /// Assumption: such a branch may not be part of the program, and this is known only when its `#IF` is executed; the
    /// documents are silent.
    pub(super) fn enters_conditional(&self, from: u64, to: u64) -> bool {
        let position = |id: EntryId| self.entry(id).position.offset;
        let conditional = |entry: &Entry| entry.keyword == Keyword::ConditionalIf;
        self.silencing().filter(conditional).any(|begin| {
            let Some(end) = begin.end.map(position) else { return false };
            let is_in = |x: u64| (begin.position.offset..=end).contains(&x);
            let other = begin.next.map_or(end, position);
            is_in(to) && !(is_in(from) && (from <= other) == (to <= other))
        })
    }

    /// Label of a section.
    pub(in crate::exec) fn label(&self, section: usize, label: &LabelKind) -> Option<LabelPlace> {
        self.labels.get(section, label)
    }

    /// The position of a block in the structure of its section; `None` inside `#COMMENT` and `#RT CYCLE`.
    pub(super) fn block(&self, position: Position) -> Option<LabelPlace> {
        // the last statement up to the block determines its surroundings
        let Some((id, _)) = self.entries.last_up_to(position.offset) else {
            return Some(LabelPlace { position, parent: None });
        };
        let entry = self.entry(id);
        let itself = entry.position.offset == position.offset;
        let keyword = entry.keyword;
        let closes = keyword.opener().and_then(Keyword::closer) == Some(keyword);
        let parent = match (keyword, entry.open) {
            (keyword, _) if keyword.is_silent() && !itself => return None,
            (_, None) => entry.parent,
            (
                Keyword::ConditionalIf | Keyword::ConditionalElse | Keyword::ConditionalEnd,
                Some(open),
            ) => self.entry(open).parent,
            // a structure begins here, or has ended
            (_, Some(_)) if itself && keyword.closer().is_some() => entry.parent,
            (_, Some(open)) if closes && !itself => self.entry(open).parent,
            (_, open) => open,
        };
        // a structure without its end does not extend into the next section
        let parent = parent.filter(|id| self.entry(*id).end.is_some());
        Some(LabelPlace { position, parent })
    }

    /// Whether a jump can lead to a label between two positions.
    pub(super) fn has_label(&self, from: u64, to: u64) -> bool {
        self.labels.any_between(from, to)
    }

    /// The local subroutine with a name: as written, otherwise without regard to case.
    pub(super) fn local(&self, name: &str) -> Option<usize> {
        let exact = self.locals.get(name);
        exact.or_else(|| self.locals_upper.get(&name.to_ascii_uppercase())).copied()
    }

    /// The section that is not local.
    pub(in crate::exec) fn main(&self) -> Option<usize> {
        self.sections.iter().position(|s| !s.local)
    }
}
