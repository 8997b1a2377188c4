//! Executes one block after the other: fetching, conditions, loops and the effects of a block.

mod commands;

use super::budget::Verdict;
use super::{Executor, State, file_number};
use crate::diag::{Condition, Diagnostic, Severity};
use crate::exec::block::din::{After, CallAfter, Then};
use crate::exec::decoder::Decoder;
use crate::exec::fault::Fault;
use crate::exec::motion::straight::StraightWords;
use crate::exec::program::files::Reading;
use crate::exec::program::index::{EntryId, Keyword};
use crate::exec::program::parsed::{Fetched, Parsed, Tree};
use crate::exec::program::reads::Reads;
use crate::exec::program::state::Closing;
use crate::exec::step::{EndReason, SourceRef, Sync};
use crate::exec::values::number::whole;
use crate::source::Position;
use crate::syntax::Parser;
use crate::syntax::ast::{Block, BlockNumber, Body, Span, Word};
use std::sync::Arc;

/// Number of messages and functions between two motions up to which the path does not stop.
///
/// Assumption: the buffer of a channel is finite, too; a million messages in a loop must not exhaust memory.
const EVENTS_MAX: usize = 1000;

/// What is said of a block without certain words.
const OF_MISSING_WORDS: [Condition; 4] =
    [Condition::FeedZero, Condition::AxisMissing, Condition::ArcRadiusZero, Condition::Syntax];

impl Executor {
    /// Executes one block.
    pub(super) fn advance(&mut self, actual_known: bool) {
        // any other block between two plain motions invalidates their shared state
        let straight = self.decoder.straight.take();
        if straight.is_some_and(|shared| self.straight_on(shared)) {
            return;
        }
        if self.names_or_macros_changed() {
            self.files.forget();
        }
        let Some(level) = self.levels.last() else {
            self.end(EndReason::Finished);
            return;
        };
        if level.at.offset >= level.end {
            self.level_ends();
            return;
        }
        let (file, at) = (level.file, level.at);
        let entry = level.index.at(at);
        if let Some(id) = entry
            && self.jump_over(id)
        {
            return;
        }
        let Some((fetched, next)) = self.read(file, at) else { return };
        let (reads, faulty) = match &fetched {
            Fetched::Plain => (Reads::default(), false),
            Fetched::Tree(tree) if self.files.skips(&tree.block) => (Reads::default(), tree.faulty),
            Fetched::Tree(tree) => (tree.reads.clone(), tree.faulty),
        };
        if let Some(wait) = reads.actual
            && !actual_known
        {
            self.wait_for_actual(wait, at);
            return;
        }
        if !self.count_block() {
            return;
        }
        self.enter(file, at, next);
        match fetched {
            Fetched::Plain => self.execute_plain(file, at, entry),
            Fetched::Tree(tree) => {
                let number = self.block_number(&tree.block);
                self.source_of(file, at, number);
                if self.rests_before(reads.external) {
                    self.execute(&tree.block, entry);
                    self.behind_real_time_cycle(entry);
                    self.search_file();
                }
            }
        }
        if self.decoder.contour.waiting() >= EVENTS_MAX {
            self.decoder.sync(Sync::Halt);
        }
        self.settle(faulty);
    }

    /// Executes a block that was read without a tree.
    fn execute_plain(&mut self, file: usize, at: Position, entry: Option<EntryId>) {
        let plain = self.files.plain();
        let number = plain.frame.number;
        let words = match plain.frame.skip {
            None => StraightWords::read(&self.decoder, plain),
            Some(_) => None,
        };
        self.source_of(file, at, number);
        match words {
            Some(words) => self.decoder.straight_motion(&words, None, None),
            None => self.execute(&self.files.plain().tree(), entry),
        }
    }

    /// Makes the block between `at` and `next` the current one.
    pub(super) fn enter(&mut self, file: usize, at: Position, next: Position) {
        self.position = at;
        if self.decoder.checking {
            self.reached.add(file, at, next);
        }
        self.levels.jump_to(next);
        self.decoder.moved = false;
    }

    fn names_or_macros_changed(&mut self) -> bool {
        let names = self.decoder.names.take_changed();
        if names {
            let Decoder { names, motion, machine, .. } = &self.decoder;
            let names = names.long_names(motion.spindle_names(&machine.channel));
            self.parser = Parser::new(names.iter().map(String::as_str));
        }
        std::mem::take(&mut self.decoder.calls.macros_changed) || names
    }

    /// The contents of `#RT CYCLE` are not executed.
    fn behind_real_time_cycle(&mut self, entry: Option<EntryId>) {
        let (Some(id), Some(level)) = (entry, self.levels.last()) else { return };
        if level.index.entry(id).keyword == Keyword::RealTimeBegin {
            self.jump_behind_end(level.end_of(id));
        }
    }

    /// Comment blocks, inactive branches and remarks; true if the entry needs no parsing.
    fn jump_over(&mut self, id: EntryId) -> bool {
        let Some(level) = self.levels.last() else { return true };
        let entry = level.index.entry(id);
        match entry.keyword {
            // before `#ELSE` a branch was taken
            Keyword::CommentBegin | Keyword::ConditionalElse => {
                self.jump_behind_end(level.end_of(id));
                true
            }
            Keyword::Remark => {
                let at = entry.position;
                if let Some(location) = self.place(at, entry.span) {
                    let text = "a % block inside a program: treated as a remark here, refused by the control";
                    let condition = match self.levels.len() {
                        1 => Condition::PercentInProgram,
                        _ => Condition::PercentInSubroutine,
                    };
                    let d = Diagnostic::new(condition, text).severity(Severity::Warning);
                    self.report(d.at(location));
                }
                self.jump_behind(at);
                true
            }
            _ => false,
        }
    }

    /// The block at a position with its tree; reading errors end the program.
    pub(in crate::exec) fn fetch(&mut self, file: usize, at: Position) -> Option<(Tree, Position)> {
        let (fetched, next) = self.read(file, at)?;
        let tree = match fetched {
            Fetched::Tree(tree) => tree,
            Fetched::Plain => {
                let block = self.files.plain().tree();
                Tree::Once(Parsed { block, reads: Reads::default(), faulty: false })
            }
        };
        Some((tree, next))
    }

    fn read(&mut self, file: usize, at: Position) -> Option<(Fetched, Position)> {
        let level = self.levels.last()?;
        let keep = self.levels.len() > 1 || level.runs_again(at);
        let reading =
            Reading { keep: keep && !level.is_declaring(), declaration: level.is_declaring() };
        let mut found = Vec::new();
        let block = self.files.block(
            file,
            at,
            reading,
            &self.parser,
            &self.decoder.calls.macros,
            &mut found,
        );
        if let Some(level) = self.levels.current_mut() {
            level.once_undeclared(&mut found);
        }
        for diagnostic in found {
            self.report(diagnostic);
        }
        match block {
            Ok(Some(block)) => Some(block),
            Ok(None) => {
                self.levels.skip_to_end();
                None
            }
            Err(e) => {
                let name = Arc::clone(&self.files.file(file).name);
                let hint = "the program was executed up to this point";
                self.report(Diagnostic::new(Condition::NoFile, format!("{name}: {e}")).hint(hint));
                self.end(EndReason::Aborted);
                None
            }
        }
    }

    /// Empties the channel before an external variable is read; false if an error ends the program.
    pub(in crate::exec::program) fn rests_before(&mut self, external: Option<Span>) -> bool {
        let Some(read) = external else { return true };
        let outcome = self.decoder.flush_for_external(read);
        self.decoder.report.keep(outcome);
        self.decoder.checking || !self.decoder.report.failed()
    }

    fn wait_for_actual(&mut self, wait: Sync, at: Position) {
        self.state = State::WaitsForActual;
        let file = self
            .levels
            .last()
            .map_or(self.decoder.report.source.file, |level| file_number(level.file));
        let source = SourceRef { file, line: at.line, offset: at.offset, block: None };
        self.decoder.report.source = source;
        self.position = at;
        self.decoder.contour.stop(wait, &mut self.decoder.report);
        self.settle(false);
    }

    /// Counts a block; false if a limit has been reached.
    pub(super) fn count_block(&mut self) -> bool {
        match self.budget.count() {
            Verdict::Continue => return true,
            Verdict::Stopped => self.end(EndReason::Aborted),
            Verdict::Endless(text) => {
                self.end_by_limit(Diagnostic::new(Condition::Endless, text));
            }
        }
        false
    }

    /// Ends a check whose program time ends within the motion or dwell of a block.
    pub(in crate::exec) fn end_by_time(&mut self, max_time_s: f64, at: SourceRef) {
        let more = if self.has_ended() { "" } else { ": the check ends here" };
        let text = format!("the program takes more than {max_time_s} s{more}");
        let mut diagnostic = Diagnostic::new(Condition::Endless, text)
            .severity(Severity::Warning)
            .hint("raise the limit with --max-time");
        diagnostic.source = self.locate(at);
        self.report(diagnostic);
        if !self.has_ended() {
            self.budget.use_up();
            self.end(EndReason::Aborted);
        }
    }

    /// Current block.
    pub(in crate::exec) fn current(&self) -> SourceRef {
        self.decoder.report.source
    }

    /// Ends the program at the next block.
    fn end_by_limit(&mut self, diagnostic: Diagnostic) {
        self.budget.use_up();
        let location =
            self.levels.last().map(|l| l.at).and_then(|at| self.place(at, Span::default()));
        self.report(match location {
            Some(location) => diagnostic.at(location),
            None => diagnostic,
        });
        self.end(EndReason::Aborted);
    }

    /// Whether a limit ended the program early.
    pub(in crate::exec) fn is_limited(&self) -> bool {
        self.budget.is_used_up()
    }

    fn block_number(&mut self, block: &Block) -> Option<u64> {
        match &block.number {
            None => None,
            Some(BlockNumber::Literal(n)) => Some(*n),
            Some(BlockNumber::Computed(expr)) => {
                // the only number that the control itself rounds
                let outcome = self.decoder.number(expr).and_then(|x| {
                    whole(x.round(), 0, u32::MAX).ok_or_else(|| {
                        let text = format!("a block number is {x}, allowed: 0 to {}", u32::MAX);
                        Fault::new(Condition::Range, text, expr.span)
                    })
                });
                self.decoder.report.keep(outcome).map(u64::from)
            }
        }
    }

    pub(super) fn source_of(&mut self, file: usize, at: Position, block: Option<u64>) {
        let file = file_number(file);
        self.decoder.report.source = SourceRef { file, line: at.line, offset: at.offset, block };
        self.decoder.report.location = None;
        self.decoder.calls.info.offset = at.offset;
        if let Some(block) = block {
            self.decoder.calls.info.block_number = block;
        }
    }

    /// Executes the content of a block.
    fn execute(&mut self, block: &Block, entry: Option<EntryId>) {
        if self.files.skips(block) {
            return;
        }
        match &block.body {
            Body::Empty | Body::ProgramHead(_) => {}
            Body::Declarations(list) => {
                for declaration in list {
                    let outcome = self.decoder.declare(declaration);
                    self.decoder.report.keep(outcome);
                }
            }
            Body::Command(command) => {
                let levels = self.levels.len();
                self.command(command, entry);
                self.modal_cycle(levels);
                if !command.behind.is_empty() && self.decoder.checking {
                    self.words_behind(&command.behind, block.span);
                }
            }
            Body::Control(control) => {
                self.decoder.dialect.own_statement();
                if let Some(entry) = entry {
                    self.control(control, entry);
                }
            }
            Body::Words(words) => {
                let after = self.decoder.execute_words(words, block.span);
                if self.decoder.report.failed() && !self.decoder.checking {
                    return;
                }
                self.after(after);
            }
        }
    }

    /// Words behind a command are an error: only a check goes on with what they say, and of them it reports errors only.
    fn words_behind(&mut self, words: &[Word], block: Span) {
        let before = self.decoder.report.take_faults();
        let after = self.decoder.execute_words(words, block);
        let mut found = self.decoder.report.take_faults();
        found.retain(Fault::is_error);
        self.decoder.report.extend(before);
        self.decoder.report.extend(found);
        self.after(after);
    }

    /// Programs called at the end of a block run before the block leaves its level or ends the program.
    fn after(&mut self, after: After<'_>) {
        let levels = self.levels.len();
        match after.call {
            None => {}
            Some(CallAfter::Written(call, span)) => self.call(call, span),
            Some(CallAfter::Cycle(call)) => self.implicit_call(&call),
            Some(CallAfter::ToolChange(span)) => self.tool_change(span),
            Some(CallAfter::ToolData(span)) => self.tool_data(span),
        }
        let closing = match after.then {
            Then::Return(None) => Some(Closing::Return),
            Then::End => Some(Closing::End),
            _ => None,
        };
        match after.then {
            Then::Goto(label) => self.goto(label),
            Then::Return(Some((back, span))) => {
                if self.levels.len() > levels {
                    let text = format!("M{} with a target in a block with a call", back.number);
                    self.decoder.report.note(Fault::new(Condition::BehindCall, text, span));
                }
                self.return_to(back, span);
            }
            Then::Next | Then::Return(None) | Then::End => {}
        }
        if closing.is_none() || self.decoder.moved {
            self.modal_cycle(levels);
        }
        let Some(closing) = closing else { return };
        // the level that runs last is the one called first
        if !self.levels.close_after(levels, closing) {
            self.close(closing);
        }
    }

    /// Reports the conditions of the block; an error ends the program.
    pub(in crate::exec) fn settle(&mut self, faulty: bool) {
        self.decoder.values.variables.report_created(&mut self.decoder.report);
        let faults = self.decoder.report.take_faults();
        let mut failed = faulty;
        for fault in faults {
            failed |= fault.is_error();
            let diagnostic = self.placed(fault);
            // the part of the block that could not be read may contain what it lacks
            if faulty && OF_MISSING_WORDS.iter().any(|missing| missing.id() == diagnostic.id) {
                continue;
            }
            let foreign = diagnostic.id == Condition::ForeignProgram.id();
            self.report(diagnostic);
            if foreign {
                break;
            }
        }
        if self.decoder.dialect.ends_check() {
            self.end(EndReason::Aborted);
        }
        if self.decoder.checking {
            let enough = self.found.is_enough(self.budget.blocks());
            if let (Some(text), true) = (enough, self.state != State::Ended) {
                let mut d = Diagnostic::new(Condition::TooMany, text).severity(Severity::Note);
                d.source = self.here(Span::default());
                self.report(d);
                self.end(EndReason::Aborted);
            }
        } else if failed {
            if self.decoder.moved {
                self.decoder.contour.drop_held();
            }
            self.end(EndReason::Aborted);
        }
    }
}
