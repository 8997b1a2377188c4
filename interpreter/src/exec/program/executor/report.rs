//! Positions and number of messages, and the end of a program.

use super::{Executor, State};
use crate::diag::{Condition, Diagnostic, Location};
use crate::exec::decoder::Decoder;
use crate::exec::fault::Fault;
use crate::exec::step::{EndReason, SourceRef};
use crate::source::Position;
use crate::syntax::ast::Span;

/// Number of calls that a message names: the depth of nesting is not limited by it.
const CALLS_SHOWN: usize = 8;

impl Executor {
    /// The diagnostic of a fault with its position.
    pub(super) fn placed(&mut self, fault: Fault) -> Diagnostic {
        let Fault { mut diagnostic, span, origin } = fault;
        if diagnostic.source.is_none() {
            diagnostic.source = match origin {
                Some(block) => self.place_in(block, span),
                None => self.here(span),
            };
        }
        diagnostic
    }

    /// Position of a span of the current block, even if the block has left its level or entered another.
    pub(in crate::exec) fn here(&mut self, span: Span) -> Option<Location> {
        let Position { offset, line } = self.position;
        self.place_in(SourceRef { line, offset, ..self.decoder.report.source }, span)
    }

    fn place_in(&mut self, block: SourceRef, span: Span) -> Option<Location> {
        let file = block.file as usize;
        if file >= self.files.names().len() {
            return None;
        }
        let position = Position { offset: block.offset, line: block.line };
        let mut location = self.files.locate(file, position, span, &self.decoder.calls.macros)?;
        location.block = block.block;
        Some(location)
    }

    /// Position of a span of a block of the current level.
    pub(in crate::exec) fn place(&mut self, position: Position, span: Span) -> Option<Location> {
        let file = self.levels.last()?.file;
        self.files.locate(file, position, span, &self.decoder.calls.macros)
    }

    /// Adds a diagnostic, once per position; words of other dialects once per program.
    pub(in crate::exec) fn report(&mut self, mut diagnostic: Diagnostic) {
        if !self.found.is_new(&diagnostic) {
            return;
        }
        if let Some(location) = &mut diagnostic.source {
            location.block = location.block.or(self.decoder.report.source.block);
        }
        if let Some(location) = &diagnostic.source {
            diagnostic.calls = self.calls_of(location);
        }
        let foreign = diagnostic.id == Condition::ForeignProgram.id();
        self.found.add(diagnostic, self.budget.blocks());
        if foreign {
            // the rest of such a program would repeat the same messages with other words
            self.end(EndReason::Aborted);
        }
    }

    /// The calls that led to a block of the present level, the last one first.
    ///
    /// A call that has itself a message is already on the level that it enters.
    fn calls_of(&mut self, place: &Location) -> Vec<Location> {
        let callers = self.levels.iter().rev().filter_map(|level| level.caller);
        let callers: Vec<SourceRef> = callers.take(CALLS_SHOWN).collect();
        let calls = callers.into_iter().filter_map(|call| self.place_in(call, Span::default()));
        let calls: Vec<Location> = calls.collect();
        let own = calls.iter().position(|c| (&c.file, c.line) == (&place.file, place.line));
        calls.into_iter().skip(own.map_or(0, |own| own + 1)).collect()
    }

    /// Ends the program: motion already prepared is still executed.
    pub(in crate::exec) fn end(&mut self, reason: EndReason) {
        if self.state == State::Ended {
            return;
        }
        self.state = State::Ended;
        let aborted =
            reason == EndReason::Aborted || (self.found.errors() > 0 && !self.decoder.checking);
        self.reason = if aborted { EndReason::Aborted } else { EndReason::Finished };
        let Decoder { contour, report, geometry, motion, names, machine, .. } = &mut self.decoder;
        let mut faults = contour.end(self.reason, report.source);
        let limits = geometry.limits(motion, names, machine);
        faults.extend(contour.take_outside(&limits));
        for fault in faults {
            let diagnostic = self.placed(fault);
            self.report(diagnostic);
        }
    }

    /// Errors so far.
    pub(in crate::exec) fn has_ended(&self) -> bool {
        self.state == State::Ended
    }
}
