//! The program levels: where each of them is, and which of its control blocks are open.
//!
//! They read the structure of the texts alone. The text of a block, and the value of a condition, are looked up by the
//! executor, which then opens, closes or continues here.

use super::calls::LEVELS_MAX;
use super::files::Files;
use super::index::{Entry, EntryId, Index, Keyword, LabelPlace};
use super::state::{BeforeCycle, Closing, Target};
use crate::diag::{Condition, Diagnostic, ValueKind};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::step::SourceRef;
use crate::source::Position;
use crate::syntax::END_OF_DECLARATIONS;
use crate::syntax::ast::{Place, Span};
use std::ops::Deref;
use std::sync::Arc;

/// One program level.
#[derive(Debug)]
pub(in crate::exec) struct Level {
    pub(in crate::exec::program) file: usize,
    pub(in crate::exec::program) section: usize,
    pub(in crate::exec::program) index: Arc<Index>,
    /// Next block.
    pub(in crate::exec::program) at: Position,
    pub(in crate::exec::program) end: u64,
    /// Position at which it begins again, and the number of passes left (REPEAT of `L SEQUENCE`).
    begin: Position,
    passes: u32,
    frames: Vec<Frame>,
    /// Modal state to be restored; present if the level is a cycle.
    pub(in crate::exec::program) cycle: Option<Box<BeforeCycle>>,
    /// Whether it is between `#VAR` and `#ENDVAR`.
    declarations: bool,
    /// Whether a line in it was no declaration: a missing `#ENDVAR` is reported once.
    undeclared: bool,
    /// Start of the present section between `#OPTIONAL EXECUTION ON` and `OFF`.
    pub(in crate::exec::program) optional: Option<(Position, Span)>,
    /// Whether a control block without an end covers the rest of the text.
    cut: bool,
    /// Offsets of the first and last block that jumps back may execute again.
    again: Option<(u64, u64)>,
    /// The block that called it; `None` for a program that no block called.
    pub(in crate::exec::program) caller: Option<SourceRef>,
    /// How the block that called it leaves its own level afterwards.
    pub(in crate::exec::program) then: Option<Closing>,
}

/// An open control block.
#[derive(Debug)]
struct Frame {
    open: EntryId,
    keyword: Keyword,
    /// Counter, last value and step of `$FOR`.
    counter: Option<Arc<Counter>>,
}

/// Counter, last value and step of `$FOR`.
#[derive(Debug)]
pub(super) struct Counter {
    pub(super) place: Place,
    pub(super) end: f64,
    pub(super) step: f64,
}

/// The checked target of a jump.
#[derive(Debug)]
pub(super) struct Landing {
    place: LabelPlace,
    /// Open control blocks that stay open.
    depth: usize,
    /// Branches entered, the innermost first.
    entered: Vec<EntryId>,
}

impl Level {
    /// A program before its first block.
    pub(super) fn new(
        Target { file, section }: Target,
        index: Arc<Index>,
        cycle: Option<Box<BeforeCycle>>,
        caller: Option<SourceRef>,
    ) -> Self {
        let part = &index.sections[section];
        Self {
            file,
            section,
            at: part.start,
            end: part.end,
            index,
            frames: Vec::new(),
            cycle,
            declarations: false,
            undeclared: false,
            optional: None,
            cut: false,
            again: None,
            caller,
            begin: Position::START,
            passes: 0,
            then: None,
        }
    }

    /// Whether the block at a position may run more than once: it is in a loop or its head, or jumps lead back before
    /// it.
    pub(super) fn runs_again(&self, at: Position) -> bool {
        self.is_repeated(at)
            || self.index.at(at).is_some_and(|id| self.index.entry(id).keyword.is_loop())
    }

    /// The same for a block that is no control statement.
    pub(super) fn is_repeated(&self, at: Position) -> bool {
        self.frames.iter().any(|f| f.keyword.is_loop())
            || self.again.is_some_and(|(first, last)| (first..=last).contains(&at.offset))
    }

    /// Whether it is between `#VAR` and `#ENDVAR`.
    pub(super) fn is_declaring(&self) -> bool {
        self.declarations
    }

    /// Begins or ends the declarations.
    pub(super) fn declare(&mut self, begins: bool) {
        (self.declarations, self.undeclared) = (begins, false);
    }

    /// Drops repetitions of the message that `#ENDVAR` is missing.
    pub(super) fn once_undeclared(&mut self, found: &mut Vec<Diagnostic>) {
        if self.declarations {
            let known = self.undeclared;
            let of_end = |d: &Diagnostic| d.hint.as_deref() == Some(END_OF_DECLARATIONS);
            found.retain(|d| !known || !of_end(d));
            self.undeclared |= found.iter().any(of_end);
        }
    }

    /// Whether its end is unknown, because a control block or declarations are not closed.
    pub(super) fn is_open_ended(&self) -> bool {
        self.cut || self.undeclared
    }

    /// Whether all its control blocks are closed.
    pub(super) fn is_outside_structures(&self) -> bool {
        self.frames.is_empty()
    }

    /// Reduces it to the blocks between two positions, `passes` times (`L SEQUENCE`).
    pub(super) fn restrict(&mut self, start: Position, end: u64, passes: u32) {
        (self.at, self.begin, self.end) = (start, start, end);
        self.passes = passes.saturating_sub(1);
    }

    /// Begins its next pass; false after the last one.
    pub(super) fn begin_again(&mut self) -> bool {
        let again = self.passes > 0;
        if again {
            self.passes -= 1;
            self.at = self.begin;
        }
        again
    }

    /// Position of the closing statement of the structure to which a statement belongs.
    pub(super) fn end_of(&self, id: EntryId) -> Option<Position> {
        self.index.entry(id).end.map(|end| self.index.entry(end).position)
    }

    /// Position of the statement that opened the structure to which a statement belongs.
    pub(super) fn start_of(&self, id: EntryId) -> Option<Position> {
        self.index.entry(id).open.map(|open| self.index.entry(open).position)
    }

    /// Number of open control blocks up to the one that a statement opens.
    fn depth_of(&self, open: Option<EntryId>) -> Option<usize> {
        self.frames.iter().rposition(|f| Some(f.open) == open)
    }

    /// Open control blocks whose closing statement is missing: the outermost, and their number.
    pub(super) fn endless(&self) -> Option<(Entry, usize)> {
        let entries = self.frames.iter().map(|f| self.index.entry(f.open));
        let mut open = entries.filter(|entry| entry.end.is_none());
        open.next().map(|first| (first, 1 + open.count()))
    }

    /// Checks a position as the target of a jump from the block at offset `from`.
    ///
    /// # Errors
    /// 21480 and others for a position inside a structure that cannot be entered.
    pub(super) fn landing(
        &self,
        from: u64,
        place: LabelPlace,
        name: &str,
        span: Span,
    ) -> Outcome<Landing> {
        // structures around the position that are not open, the innermost first
        let mut entered = Vec::new();
        let mut around = place.parent;
        let depth = loop {
            let Some(id) = around else { break 0 };
            if let Some(depth) = self.depth_of(Some(id)) {
                break depth + 1;
            }
            entered.push(id);
            around = self.index.entry(id).parent;
        };
        let keyword = |id: &EntryId| self.index.entry(*id).keyword;
        let closed = entered.iter().map(keyword).find(|k| *k != Keyword::If);
        let conditional = || {
            let into = self.index.enters_conditional(from, place.position.offset);
            into.then_some(Keyword::ConditionalIf)
        };
        let Some(closed) = closed.or_else(conditional) else {
            return Ok(Landing { place, depth, entered });
        };
        let text = format!("{name} is inside {}", closed.text());
        let condition =
            if closed.is_loop() { Condition::JumpIntoLoop } else { Condition::LabelInto };
        Err(Fault::new(condition, text, span))
    }
}

/// All levels, the main program first. The last one is the present one; before the first and after the last block there
/// may be none, which changes nothing.
#[derive(Debug, Default)]
pub(in crate::exec) struct Levels {
    open: Vec<Level>,
}

impl Deref for Levels {
    type Target = [Level];

    #[inline]
    fn deref(&self) -> &[Level] {
        &self.open
    }
}

impl Levels {
    /// Enters a level.
    pub(super) fn enter(&mut self, level: Level) {
        self.open.push(level);
    }

    /// Leaves the present level.
    pub(super) fn leave(&mut self) -> Option<Level> {
        self.open.pop()
    }

    /// Whether one more level may be entered.
    pub(super) fn has_room(&self) -> bool {
        self.open.len() < LEVELS_MAX
    }

    /// The present level.
    #[inline]
    pub(super) fn current_mut(&mut self) -> Option<&mut Level> {
        self.open.last_mut()
    }

    /// Sets how the block leaves its level after the first of the levels that it has entered above `depth`; false if it
    /// has not entered any.
    pub(super) fn close_after(&mut self, depth: usize, closing: Closing) -> bool {
        let called = self.open.get_mut(depth);
        called.map(|level| level.then = Some(closing)).is_some()
    }

    /// Continues at a position.
    #[inline]
    pub(super) fn jump_to(&mut self, position: Position) {
        if let Some(level) = self.open.last_mut() {
            level.at = position;
        }
    }

    /// Continues at the end of the text.
    pub(super) fn skip_to_end(&mut self) {
        if let Some(level) = self.open.last_mut() {
            level.at = Position { offset: level.end.max(level.at.offset), line: level.at.line };
            level.end = level.end.min(level.at.offset);
        }
    }

    /// A structure without an end covers the rest of the text; a missing M30 is not reported in addition.
    pub(super) fn skip_unclosed(&mut self) {
        self.skip_to_end();
        if let Some(level) = self.open.last_mut() {
            level.cut = true;
        }
    }

    /// Opens the control block of a statement.
    pub(super) fn open(&mut self, id: EntryId, counter: Option<Counter>, files: &mut Files) {
        let Some(level) = self.open.last_mut() else { return };
        let keyword = level.index.entry(id).keyword;
        let first_loop = keyword.is_loop() && !level.frames.iter().any(|f| f.keyword.is_loop());
        level.frames.push(Frame { open: id, keyword, counter: counter.map(Arc::new) });
        if first_loop {
            files.make_room();
        }
    }

    /// Closes the structure to which a clause or closing statement belongs, and everything inside it.
    pub(super) fn close(&mut self, id: EntryId) {
        let Some(level) = self.open.last_mut() else { return };
        if let Some(depth) = level.depth_of(level.index.entry(id).open) {
            level.frames.truncate(depth);
        }
    }

    /// Closes all of the present level.
    pub(super) fn close_all(&mut self) {
        if let Some(level) = self.open.last_mut() {
            level.frames.clear();
        }
    }

    /// Closes everything inside the structure to which a statement belongs; false if that is not open.
    pub(super) fn close_inside(&mut self, id: EntryId) -> bool {
        let Some(level) = self.open.last_mut() else { return false };
        let depth = level.depth_of(level.index.entry(id).open);
        if let Some(depth) = depth {
            level.frames.truncate(depth + 1);
        }
        depth.is_some()
    }

    /// The counter of the loop to which a statement belongs.
    pub(super) fn counter_of(&self, id: EntryId) -> Option<Arc<Counter>> {
        let level = self.open.last()?;
        level.frames[level.depth_of(level.index.entry(id).open)?].counter.clone()
    }

    /// The statement that opened the innermost open structure of a kind.
    pub(super) fn innermost(&self, wanted: impl Fn(Keyword) -> bool) -> Option<EntryId> {
        let level = self.open.last()?;
        level.frames.iter().rfind(|f| wanted(f.keyword)).map(|f| f.open)
    }

    /// 21500, 21501, 21502: the closing statement is missing; the rest of the level is ignored.
    pub(super) fn unclosed(&mut self, id: EntryId, span: Span) -> Box<Fault> {
        self.skip_unclosed();
        let Some(level) = self.open.last() else {
            return Fault::new(Condition::OpenIfMain, "open control block", span);
        };
        let keyword = level.index.entry(id).keyword;
        let closer = keyword.closer().map_or("", Keyword::text);
        let condition = match (level.index.sections[level.section].local, self.open.len()) {
            (true, _) => Condition::OpenIfLocal,
            (false, 1) => Condition::OpenIfMain,
            (false, _) => Condition::OpenIfGlobal,
        };
        let text = format!("{} without {closer}", keyword.text());
        let hint = format!("write {closer} before the end of its program or subroutine");
        Fault::new(condition, text, span).hint(hint).with(|d| {
            d.value(ValueKind::Current, 1.0, "-")
                .value(ValueKind::State, keyword.text(), "-")
                .value(ValueKind::Expected, closer, "-")
        })
    }

    /// Continues the present level at the target; `from` is the offset of the block that contains the jump.
    pub(super) fn land(&mut self, landing: Landing, from: u64, files: &mut Files) {
        let Some(level) = self.open.last_mut() else { return };
        let Landing { place, depth, entered } = landing;
        level.frames.truncate(depth);
        // a branch of $IF is entered as if its condition had been true
        level.frames.extend(entered.iter().rev().map(|id| Frame {
            open: *id,
            keyword: Keyword::If,
            counter: None,
        }));
        level.at = place.position;
        // a jump back forms a loop: its blocks are parsed once
        let to = place.position.offset;
        if to <= from {
            let known = level.again.unwrap_or((to, from));
            let again = (known.0.min(to), known.1.max(from));
            if level.again.replace(again) != Some(again) {
                files.make_room();
            }
        }
    }
}

#[cfg(test)]
mod tests;
