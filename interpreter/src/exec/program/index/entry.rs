//! A statement of the structure with its partners.

use super::keyword::Keyword;
use crate::source::Position;
use crate::syntax::ast::Span;

/// Index of an entry.
pub(in crate::exec) type EntryId = u32;

/// One statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) struct Entry {
    pub(in crate::exec::program) position: Position,
    /// The keyword in its block.
    pub(in crate::exec::program) span: Span,
    pub(in crate::exec::program) keyword: Keyword,
    /// Statement that opened the structure; an opening statement refers to itself.
    pub(in crate::exec::program) open: Option<EntryId>,
    /// Next clause of the structure, finally its closing statement.
    pub(in crate::exec::program) next: Option<EntryId>,
    /// Closing statement.
    pub(in crate::exec::program) end: Option<EntryId>,
    /// Innermost structure around it.
    pub(in crate::exec::program) parent: Option<EntryId>,
}

impl Entry {
    /// A statement without partners; `start` is the position of the keyword in its block.
    pub(super) fn alone(position: Position, start: usize, keyword: Keyword) -> Self {
        let span = Span::new(start, start + keyword.text().len());
        Self { position, span, keyword, open: None, next: None, end: None, parent: None }
    }
}
