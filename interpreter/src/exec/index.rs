//! Structure of a program file: heads, control statements and labels with their places; nothing else is kept.
//!
//! One pass over the text, without parsing: only the beginning of a block is looked at. So a jump needs no search, and
//! memory does not depend on the blocks in between.

mod build;
mod head;
mod keyword;
#[cfg(test)]
mod tests;

use crate::source::Position;
use crate::syntax::ast::{LabelKind, Span};
pub(super) use build::build;
pub(super) use keyword::Keyword;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Index of an entry.
pub(super) type EntryId = u32;

/// One statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) position: Position,
    /// The keyword in its block.
    pub(super) span: Span,
    pub(super) keyword: Keyword,
    /// Statement that opened the structure; itself for an opening one.
    pub(super) open: Option<EntryId>,
    /// Next clause of the structure, at last its closing statement.
    pub(super) next: Option<EntryId>,
    /// Closing statement.
    pub(super) end: Option<EntryId>,
    /// Innermost structure around it.
    pub(super) parent: Option<EntryId>,
}

/// Target of a jump.
#[derive(Clone, Copy, Debug)]
pub(super) struct LabelPlace {
    pub(super) position: Position,
    /// Innermost structure around it.
    pub(super) parent: Option<EntryId>,
}

/// A main program or local subroutine.
#[derive(Clone, Debug)]
pub(super) struct Section {
    pub(super) name: Option<Arc<str>>,
    pub(super) local: bool,
    /// First block.
    pub(super) start: Position,
    /// Where the next section or nothing begins.
    pub(super) end: u64,
}

/// Structure of a file.
#[derive(Clone, Debug, Default)]
pub(super) struct Index {
    pub(super) entries: Vec<Entry>,
    pub(super) sections: Vec<Section>,
    labels: BTreeMap<(usize, LabelKind), LabelPlace>,
    /// First local subroutine of each name.
    locals: BTreeMap<Arc<str>, usize>,
    /// The same without regard to case: names in upper case.
    locals_upper: BTreeMap<String, usize>,
}

impl Index {
    /// The entry at a place.
    pub(super) fn at(&self, position: Position) -> Option<EntryId> {
        let i = self.entries.binary_search_by_key(&position.offset, |e| e.position.offset).ok()?;
        EntryId::try_from(i).ok()
    }

    pub(super) fn entry(&self, id: EntryId) -> &Entry {
        &self.entries[id as usize]
    }

    /// Label of a section.
    pub(super) fn label(&self, section: usize, label: &LabelKind) -> Option<&LabelPlace> {
        // a range of one key would need an owned label: labels are short
        self.labels.get(&(section, label.clone()))
    }

    /// The local subroutine of a name: as written, or else without regard to case.
    pub(super) fn local(&self, name: &str) -> Option<usize> {
        let exact = self.locals.get(name);
        exact.or_else(|| self.locals_upper.get(&name.to_ascii_uppercase())).copied()
    }

    /// The section that is not local.
    pub(super) fn main(&self) -> Option<usize> {
        self.sections.iter().position(|s| !s.local)
    }
}
