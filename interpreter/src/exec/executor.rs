//! Runs a program: blocks one after the other, through levels, loops and branches.

use super::contour::Contour;
use super::decoder::Decoder;
use super::dialect;
use super::din::After;
use super::fault::{Fault, own};
use super::files::{Fetched, FileError, Files, Parsed, Reading};
use super::flow::Frame;
use super::index::{EntryId, Index, Keyword};
use super::modal::Modal;
use super::options::{Options, SkipLevels};
use super::step::{EndReason, Feedback, ShapingSetup, SourceRef, Step, Sync};
use super::unreached::Reached;
use crate::diag::{Diagnostic, Id, Location, Severity};
use crate::machine::Machine;
use crate::source::{Position, Sources};
use crate::syntax::Parser;
use crate::syntax::ast::{BlockNumber, Body, Command, Span};
use kontur_motion::axis::AxisVec;
use std::collections::BTreeSet;
use std::fmt;
use std::sync::Arc;

/// Errors after which a check stops. Source: P-CHAN-00019 is the vendor's counterpart.
const ERRORS_MAX: usize = 20;

/// Diagnostics of one run; further ones are reported only if they are errors.
const DIAGNOSTICS_MAX: usize = 1000;

/// One program level.
#[derive(Debug)]
pub(super) struct Level {
    pub(super) file: usize,
    pub(super) section: usize,
    pub(super) index: Arc<Index>,
    /// Next block.
    pub(super) at: Position,
    pub(super) end: u64,
    pub(super) frames: Vec<Frame>,
    /// Modal state to return to: the level is a cycle.
    pub(super) cycle: Option<Box<Modal>>,
    /// Between `#VAR` and `#ENDVAR`.
    pub(super) declarations: bool,
    /// A control block without its end took the rest of the text.
    pub(super) cut: bool,
}

/// Where the execution stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Running,
    /// The block at the place of the level waits for actual positions.
    WaitsForActual,
    Ended,
}

/// Runs one program and hands out its steps.
pub struct Executor {
    pub(super) decoder: Decoder,
    pub(super) sources: Box<dyn Sources>,
    pub(super) parser: Parser,
    pub(super) files: Files,
    pub(super) levels: Vec<Level>,
    pub(super) skip: SkipLevels,
    state: State,
    start: AxisVec,
    diagnostics: Vec<Diagnostic>,
    reported: BTreeSet<(Id, Arc<str>, u32, u64)>,
    errors: usize,
    blocks: u64,
    blocks_at_rest: u64,
    max_blocks: u64,
    max_blocks_at_rest: u64,
    /// Place of the block in work.
    pub(super) position: Position,
    /// What was executed, while checking.
    pub(super) reached: Reached,
    /// The program of P-CHAN-00252 has been called.
    pub(super) end_program_called: bool,
    reason: EndReason,
}

impl fmt::Debug for Executor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Executor")
            .field("state", &self.state)
            .field("levels", &self.levels)
            .field("blocks", &self.blocks)
            .finish_non_exhaustive()
    }
}

impl Executor {
    /// A program before its first block. If it cannot be opened, the first step is [`Step::End`] and the diagnostics
    /// tell why.
    pub fn new(
        sources: Box<dyn Sources>,
        program: &str,
        machine: Arc<Machine>,
        options: Options,
    ) -> Self {
        Self::with_mode(sources, program, machine, options, false)
    }

    pub(super) fn with_mode(
        sources: Box<dyn Sources>,
        program: &str,
        machine: Arc<Machine>,
        options: Options,
        checking: bool,
    ) -> Self {
        let mut diagnostics = Vec::new();
        let start = start_position(&machine, &options.start, &mut diagnostics);
        let (skip, max_blocks) = (options.skip, options.max_blocks);
        let max_blocks_at_rest = options.max_blocks_at_rest;
        let mut decoder = Decoder::new(machine, options, &start);
        decoder.checking = checking;
        let names = decoder.long_names();
        let mut executor = Self {
            parser: Parser::new(names.iter().map(String::as_str)),
            decoder,
            sources,
            files: Files::new(),
            levels: Vec::new(),
            skip,
            state: State::Running,
            start,
            diagnostics: Vec::new(),
            reported: BTreeSet::new(),
            errors: 0,
            blocks: 0,
            blocks_at_rest: 0,
            max_blocks,
            max_blocks_at_rest,
            position: Position::START,
            reached: Reached::default(),
            end_program_called: false,
            reason: EndReason::Finished,
        };
        diagnostics.append(&mut executor.decoder.unplaced);
        for diagnostic in diagnostics {
            executor.report(diagnostic);
        }
        executor.begin(program);
        executor
    }

    /// Opens the main program.
    fn begin(&mut self, program: &str) {
        let Some(file) = self.open(program, None) else {
            self.end(EndReason::Aborted);
            return;
        };
        let name = Arc::clone(&self.files.file(file).name);
        let index = Arc::clone(&self.files.file(file).index);
        let Some(section) = index.main() else {
            let text = format!("{name} holds no main program");
            let severity =
                if index.sections.is_empty() { Severity::Warning } else { Severity::Error };
            self.report(Diagnostic::kontur(own::NO_END, text).severity(severity));
            let refused = severity == Severity::Error;
            self.end(if refused { EndReason::Aborted } else { EndReason::Finished });
            return;
        };
        let info = &mut self.decoder.info;
        info.main_program = index.sections[section].name.clone().unwrap_or_else(|| Arc::from(""));
        info.main_file = name;
        self.push_level(file, section, None);
        self.position = index.sections[section].start;
        self.decoder.source.file = file_number(file);
        if let Some(name) = self.decoder.machine.channel.start_program.clone() {
            self.call_of_list(&name, "P-CHAN-00119", Span::default());
            self.settle(false);
        }
        if self.errors > 0 && !self.decoder.checking {
            self.end(EndReason::Aborted);
        }
    }

    /// Opens a file; what is wrong is reported.
    pub(super) fn open(&mut self, name: &str, caller: Option<usize>) -> Option<usize> {
        match self.files.open(&*self.sources, name, caller, self.skip) {
            Ok((file, diagnostics)) => {
                for diagnostic in diagnostics {
                    self.report(diagnostic);
                }
                Some(file)
            }
            Err(error) => {
                let diagnostic = match error {
                    FileError::Open(e) => {
                        let searched = e.searched.join(", ");
                        Diagnostic::kontur(own::NO_FILE, format!("{}: {}", e.name, e.reason))
                            .hint(format!("searched: {searched}"))
                    }
                    FileError::Read(e) => Diagnostic::kontur(own::NO_FILE, format!("{name}: {e}")),
                };
                let diagnostic = match (self.levels.is_empty(), self.here(Span::default())) {
                    (false, Some(location)) => diagnostic.at(location),
                    _ => diagnostic,
                };
                self.report(diagnostic);
                None
            }
        }
    }

    /// The next step of the program; after [`Step::End`] always that again.
    pub fn next(&mut self, feedback: &Feedback) -> Step {
        self.decoder.feedback = feedback.clone();
        loop {
            if let Some(step) = self.decoder.contour.pop() {
                self.blocks_at_rest = 0;
                return step;
            }
            match self.state {
                State::Ended => {
                    let (reason, source) = (self.reason, self.decoder.source);
                    return Step::End { reason, source, events: Vec::new() };
                }
                State::Running => self.advance(false),
                State::WaitsForActual => {
                    self.state = State::Running;
                    self.advance(true);
                }
            }
        }
    }

    /// Diagnostics since the last call.
    pub fn take_diagnostics(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.diagnostics)
    }

    /// Names of the files that took part so far; [`SourceRef::file`] is an index.
    pub fn files(&self) -> &[Arc<str>] {
        self.files.names()
    }

    /// Place of a block whose step was handed out; its text is read again.
    pub fn locate(&mut self, source: SourceRef) -> Option<Location> {
        if source.line == 0 {
            return None;
        }
        let position = Position { offset: source.offset, line: source.line };
        let mut location = self.files.locate_block(source.file as usize, position)?;
        location.block = source.block;
        Some(location)
    }

    /// Kernels in force; before the first step those of the axis lists.
    pub fn shaping(&self) -> &ShapingSetup {
        &self.decoder.shaping.setup
    }

    /// Blocks executed so far.
    pub fn blocks(&self) -> u64 {
        self.blocks
    }

    /// Where the axes stand at program start.
    pub fn start_position(&self) -> &AxisVec {
        &self.start
    }

    /// Targets of the axes behind the last block.
    pub fn target(&self) -> &AxisVec {
        self.decoder.coordinates.target()
    }

    /// Executes one block.
    fn advance(&mut self, actual_known: bool) {
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
        let Some((parsed, next)) = self.fetch(file, at) else { return };
        if parsed.needs_actual && !actual_known {
            self.wait_for_actual(at);
            return;
        }
        if !self.count_block() {
            return;
        }
        self.position = at;
        if self.decoder.checking {
            self.reached.add(file, at, next);
        }
        self.source_of(file, at, &parsed);
        if let Some(level) = self.levels.last_mut() {
            level.at = next;
        }
        self.decoder.moved = false;
        self.execute(&parsed, entry);
        self.settle(parsed.faulty);
    }

    fn names_or_macros_changed(&mut self) -> bool {
        let names = std::mem::take(&mut self.decoder.names_changed);
        if names {
            let names = self.decoder.long_names();
            self.parser = Parser::new(names.iter().map(String::as_str));
        }
        std::mem::take(&mut self.decoder.macros_changed) || names
    }

    /// Comment blocks, inactive branches and remarks: true if the entry needs no parsing.
    fn jump_over(&mut self, id: EntryId) -> bool {
        let Some(level) = self.levels.last() else { return true };
        let entry = *level.index.entry(id);
        match entry.keyword {
            Keyword::CommentBegin => {
                match entry.end.map(|end| level.index.entry(end).position) {
                    Some(end) => self.jump_behind(end),
                    None => self.skip_to_level_end(),
                }
                true
            }
            // the branch before it was taken
            Keyword::ConditionalElse => {
                match entry.end.map(|end| level.index.entry(end).position) {
                    Some(end) => self.jump_behind(end),
                    None => self.skip_to_level_end(),
                }
                true
            }
            Keyword::Remark => {
                let at = entry.position;
                if let Some(location) = self.place(at, entry.span) {
                    let text = "a % block inside a program is taken as a remark";
                    let d = Diagnostic::kontur(own::PERCENT, text).severity(Severity::Warning);
                    self.report(d.at(location));
                }
                self.jump_behind(at);
                true
            }
            _ => false,
        }
    }

    /// The block at a place; reading errors end the program.
    pub(super) fn fetch(&mut self, file: usize, at: Position) -> Option<(Fetched, Position)> {
        let level = self.levels.last()?;
        // the head of a loop runs again as well
        let loops = |id: EntryId| level.index.entry(id).keyword.is_loop();
        let keep = self.levels.len() > 1
            || level.frames.iter().any(|f| f.keyword.is_loop())
            || level.index.at(at).is_some_and(loops);
        let reading =
            Reading { keep: keep && !level.declarations, declaration: level.declarations };
        let mut found = Vec::new();
        let block =
            self.files.block(file, at, reading, &self.parser, &self.decoder.macros, &mut found);
        for diagnostic in found {
            self.report(diagnostic);
        }
        match block {
            Ok(Some(block)) => Some(block),
            Ok(None) => {
                self.skip_to_level_end();
                None
            }
            Err(e) => {
                let name = Arc::clone(&self.files.file(file).name);
                self.report(Diagnostic::kontur(own::NO_FILE, format!("{name}: {e}")));
                self.end(EndReason::Aborted);
                None
            }
        }
    }

    fn wait_for_actual(&mut self, at: Position) {
        self.state = State::WaitsForActual;
        let file =
            self.levels.last().map_or(self.decoder.source.file, |level| file_number(level.file));
        let source = SourceRef { file, line: at.line, offset: at.offset, block: None };
        self.decoder.source = source;
        let faults = self.decoder.contour.sync(Sync::ReadActual, source);
        self.position = at;
        for fault in faults {
            self.decoder.note(Box::new(fault));
        }
        self.settle(false);
    }

    /// False if a limit was reached.
    fn count_block(&mut self) -> bool {
        self.blocks += 1;
        self.blocks_at_rest += 1;
        let text = if self.blocks > self.max_blocks {
            format!("more than {} blocks (--max-blocks)", self.max_blocks)
        } else if self.blocks_at_rest > self.max_blocks_at_rest {
            format!("{} blocks without motion: the program does not end", self.max_blocks_at_rest)
        } else {
            return true;
        };
        let diagnostic = Diagnostic::kontur(own::ENDLESS, text);
        let location =
            self.levels.last().map(|l| l.at).and_then(|at| self.place(at, Span::default()));
        self.report(match location {
            Some(location) => diagnostic.at(location),
            None => diagnostic,
        });
        self.end(EndReason::Aborted);
        false
    }

    fn source_of(&mut self, file: usize, at: Position, parsed: &Parsed) {
        let block = match &parsed.block.number {
            None => None,
            Some(BlockNumber::Literal(n)) => Some(*n),
            Some(BlockNumber::Computed(expr)) => {
                let outcome = self.decoder.whole(expr, "a block number", 0, u32::MAX);
                self.decoder.keep(outcome).map(u64::from)
            }
        };
        let file = file_number(file);
        self.decoder.source = SourceRef { file, line: at.line, offset: at.offset, block };
        self.decoder.location = None;
        self.decoder.info.offset = at.offset;
        if let Some(block) = block {
            self.decoder.info.block_number = block;
        }
    }

    /// What the block says.
    fn execute(&mut self, parsed: &Parsed, entry: Option<EntryId>) {
        let block = &parsed.block;
        if block.skip.is_some_and(|level| self.skip.contains(level)) {
            return;
        }
        match &block.body {
            Body::Empty | Body::ProgramHead(_) => {}
            Body::Declarations(list) => {
                for declaration in list {
                    let outcome = self.decoder.declare(declaration);
                    self.decoder.keep(outcome);
                }
            }
            Body::Command(command) => self.command(command, entry),
            Body::Control(control) => {
                self.decoder.dialect.own = true;
                if let Some(entry) = entry {
                    self.control(control, entry);
                }
            }
            Body::Words(words) => {
                let after = self.decoder.execute_words(words, block.span);
                if self.decoder.failed() && !self.decoder.checking {
                    return;
                }
                self.after(after);
                self.modal_cycle();
            }
        }
    }

    fn command(&mut self, command: &Command, entry: Option<EntryId>) {
        let declarations = self.levels.last().is_some_and(|l| l.declarations);
        if command.is("VAR") || command.is("ENDVAR") {
            let begins = command.is("VAR");
            if begins == declarations {
                let text = if begins { "#VAR inside #VAR" } else { "#ENDVAR without #VAR" };
                self.decoder.note(Fault::kontur(own::SYNTAX, text, command.span));
            }
            if let Some(level) = self.levels.last_mut() {
                level.declarations = begins;
            }
            return;
        }
        let conditional = command.is("IF") || command.is("ELSE") || command.is("ENDIF");
        if conditional || command.is("COMMENT BEGIN") || command.is("COMMENT END") {
            if let (Some(entry), true) = (entry, command.is("IF")) {
                self.conditional(command, entry);
            }
            return;
        }
        self.decoder.location = self.here(command.span);
        let outcome = self.decoder.execute_command(command);
        self.decoder.keep(outcome);
    }

    /// `#IF`: the branch that is not taken is not looked at.
    fn conditional(&mut self, command: &Command, id: EntryId) {
        let condition = if let [condition] = &command.arguments[..] {
            let outcome = self.decoder.condition(condition);
            self.decoder.keep(outcome).unwrap_or(false)
        } else {
            let text = "#IF needs one condition";
            self.decoder.note(Fault::kontur(own::SYNTAX, text, command.span));
            false
        };
        if condition {
            return;
        }
        let Some(level) = self.levels.last() else { return };
        let next = level.index.entry(id).next.map(|next| level.index.entry(next).position);
        match next {
            Some(next) => self.jump_behind(next),
            None => self.skip_to_level_end(),
        }
    }

    fn after(&mut self, after: After<'_>) {
        match after {
            After::Next => {}
            After::Call(call, span) => self.call(call, span),
            After::Cycle(call) => self.implicit_call(&call),
            After::ToolChange(span) => self.tool_change(span),
            After::Goto(label) => self.goto(label),
            After::Return => self.return_from_level(),
            After::End => self.program_end(),
        }
    }

    /// Reports the conditions of the block; an error ends the program.
    pub(super) fn settle(&mut self, faulty: bool) {
        let faults = self.decoder.take_faults();
        let mut failed = faulty;
        for fault in faults {
            failed |= fault.is_error();
            let diagnostic = self.placed(fault);
            self.report(diagnostic);
        }
        if self.decoder.checking {
            if self.errors >= ERRORS_MAX && self.state != State::Ended {
                let text = format!("{} errors: the check stops here", self.errors);
                let d = Diagnostic::kontur(own::TOO_MANY, text).severity(Severity::Note);
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

    /// The diagnostic of a fault with its place.
    fn placed(&mut self, fault: Fault) -> Diagnostic {
        let Fault { mut diagnostic, span, origin } = fault;
        if diagnostic.source.is_none() {
            diagnostic.source = match origin {
                Some(block) => self.place_in(block, span),
                None => self.here(span),
            };
        }
        diagnostic
    }

    /// Place of a span of the block in work, also if it has left its level or entered another.
    pub(super) fn here(&mut self, span: Span) -> Option<Location> {
        let Position { offset, line } = self.position;
        self.place_in(SourceRef { line, offset, ..self.decoder.source }, span)
    }

    fn place_in(&mut self, block: SourceRef, span: Span) -> Option<Location> {
        let file = block.file as usize;
        if file >= self.files.names().len() {
            return None;
        }
        let position = Position { offset: block.offset, line: block.line };
        let mut location = self.files.locate(file, position, span, &self.decoder.macros)?;
        location.block = block.block;
        Some(location)
    }

    /// Place of a span of a block of the present level.
    pub(super) fn place(&mut self, position: Position, span: Span) -> Option<Location> {
        let file = self.levels.last()?.file;
        self.files.locate(file, position, span, &self.decoder.macros)
    }

    /// Adds a diagnostic, once per place; words of other dialects once per program.
    pub(super) fn report(&mut self, mut diagnostic: Diagnostic) {
        let key = match &diagnostic.source {
            Some(l) if !dialect::is_foreign_word(diagnostic.id) => {
                (diagnostic.id, Arc::clone(&l.file), l.column, l.offset)
            }
            _ => (diagnostic.id, Arc::from(diagnostic.text.as_str()), 0, 0),
        };
        // a program with a remark in every line must not fill the memory
        let full = self.reported.len() >= DIAGNOSTICS_MAX;
        let known = if full { self.reported.contains(&key) } else { !self.reported.insert(key) };
        if known || (full && !diagnostic.is_error()) {
            return;
        }
        if let Some(location) = &mut diagnostic.source {
            location.block = location.block.or(self.decoder.source.block);
        }
        self.errors += usize::from(diagnostic.is_error());
        self.diagnostics.push(diagnostic);
    }

    /// Ends the program: what was prepared is still driven.
    pub(super) fn end(&mut self, reason: EndReason) {
        if self.state == State::Ended {
            return;
        }
        self.state = State::Ended;
        let aborted = reason == EndReason::Aborted || (self.errors > 0 && !self.decoder.checking);
        self.reason = if aborted { EndReason::Aborted } else { EndReason::Finished };
        let source = self.decoder.source;
        let contour: &mut Contour = &mut self.decoder.contour;
        let mut faults = contour.end(self.reason, source);
        faults.extend(self.decoder.limits_of_compensated());
        for fault in faults {
            let diagnostic = self.placed(fault);
            self.report(diagnostic);
        }
    }

    /// Errors so far.
    pub(super) fn has_ended(&self) -> bool {
        self.state == State::Ended
    }
}

/// A file as [`SourceRef`] names it.
fn file_number(file: usize) -> u32 {
    u32::try_from(file).unwrap_or(u32::MAX)
}

/// Start positions by axis name.
fn start_position(
    machine: &Machine,
    start: &[(String, f64)],
    diagnostics: &mut Vec<Diagnostic>,
) -> AxisVec {
    let mut position = AxisVec::zeros(machine.axes.len());
    for (name, value) in start {
        match machine.axes.iter().position(|a| a.name().eq_ignore_ascii_case(name)) {
            Some(axis) if value.is_finite() => position[axis] = *value,
            _ => {
                let text = format!("start position {name}={value}: no such axis or no number");
                diagnostics.push(Diagnostic::kontur(own::RANGE, text));
            }
        }
    }
    position
}
