//! Runs a program block by block, through levels, loops and branches.

mod budget;
mod found;
mod report;
mod row;
mod run;

use self::budget::Budget;
use self::found::Found;
use super::files::{Files, Structures};
use super::level::Levels;
use super::places::position;
use super::reached::Reached;
use super::state::{Sequences, Target};
use crate::diag::{Condition, Diagnostic, Location, Severity};
use crate::exec::decoder::Decoder;
use crate::exec::options::{GuardCommands, Options};
use crate::exec::step::{
    Decoded, EndReason, Opened, Rare, ShapingSetup, SourceRef, Step, Sync, Told,
};
use crate::machine::Machine;
use crate::machine::table::channel as of;
use crate::source::{Position, Sources};
use crate::syntax::Parser;
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::SpareBlocks;
use std::fmt;
use std::sync::Arc;

/// Progress of the execution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Running,
    /// The next block of the level waits for actual positions.
    WaitsForActual,
    Ended,
}

/// Purpose of an execution.
pub(in crate::exec) enum Mode {
    Check,
    /// With what a check of the same program has found.
    Run(Structures),
}

/// Runs one program and returns its steps.
pub(crate) struct Executor {
    pub(in crate::exec::program) decoder: Decoder,
    pub(in crate::exec::program) parser: Parser,
    pub(in crate::exec::program) files: Files,
    pub(in crate::exec::program) levels: Levels,
    /// Block numbers for `L SEQUENCE`.
    pub(in crate::exec::program) sequences: Sequences,
    state: State,
    start: AxisVec,
    pub(super) found: Found,
    budget: Budget,
    /// Position of the current block.
    pub(in crate::exec::program) position: Position,
    /// Blocks executed so far, during a check.
    pub(in crate::exec::program) reached: Reached,
    /// Whether blocks that a check did not execute call further files.
    pub(in crate::exec::program) calls_more: bool,
    /// Whether the program of P-CHAN-00252 has been called.
    pub(in crate::exec::program) end_program_called: bool,
    reason: EndReason,
}

impl fmt::Debug for Executor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Executor")
            .field("state", &self.state)
            .field("levels", &self.levels)
            .field("budget", &self.budget)
            .finish_non_exhaustive()
    }
}

impl Executor {
    /// A program before its first block. If it cannot be opened, the first step is [`Step::End`], and the diagnostics
    /// give the reason. `structures`: what a check has found.
    pub(crate) fn new(
        sources: Arc<dyn Sources>,
        program: &str,
        machine: Arc<Machine>,
        options: Options,
        structures: Structures,
    ) -> Self {
        Self::with_mode(sources, program, machine, options, Mode::Run(structures))
    }

    pub(in crate::exec) fn with_mode(
        sources: Arc<dyn Sources>,
        program: &str,
        machine: Arc<Machine>,
        options: Options,
        mode: Mode,
    ) -> Self {
        let mut diagnostics = Vec::new();
        let start = start_position(&machine, &options.start, &mut diagnostics);
        let (skip, budget) = (options.skip, Budget::new(&options));
        let mut decoder = Decoder::new(machine, options, &start);
        let structures = match mode {
            Mode::Check => {
                decoder.checking = true;
                Structures::default()
            }
            Mode::Run(structures) => structures,
        };
        let of_spindles = decoder.motion.spindle_names(&decoder.machine.channel);
        let names = decoder.names.long_names(of_spindles);
        let asynchronous = decoder.machine.external.asynchronous();
        let mut executor = Self {
            parser: Parser::new(names.iter().map(String::as_str)),
            decoder,
            files: Files::new(sources, skip, asynchronous, structures),
            levels: Levels::default(),
            sequences: Sequences::default(),
            state: State::Running,
            start,
            found: Found::default(),
            budget,
            position: Position::START,
            reached: Reached::default(),
            calls_more: false,
            end_program_called: false,
            reason: EndReason::Finished,
        };
        diagnostics.append(&mut executor.decoder.report.unplaced);
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
            let text = format!("{name} does not contain a main program");
            let severity =
                if index.sections.is_empty() { Severity::Warning } else { Severity::Error };
            let mut diagnostic = Diagnostic::new(Condition::NoEnd, text).severity(severity);
            diagnostic = diagnostic.hint(if severity == Severity::Error {
                "write % and the main program after the subroutines"
            } else {
                "the file contains no block"
            });
            let (file, text) = (name, Arc::from(""));
            let (line, column, offset, length, block) = (1, 1, 0, 1, None);
            let beginning = Location { file, line, column, offset, length, block, text };
            self.report(diagnostic.at(beginning));
            let refused = severity == Severity::Error;
            self.end(if refused { EndReason::Aborted } else { EndReason::Finished });
            return;
        };
        let info = &mut self.decoder.calls.info;
        info.main_program = index.sections[section].name.clone().unwrap_or_else(|| Arc::from(""));
        info.main_file = name;
        self.push_level(Target { file, section }, None);
        self.position = index.sections[section].start;
        self.decoder.report.source.file = file_number(file);
        if let Some(name) = self.decoder.machine.channel.programs.start.clone() {
            self.call_of_list(&name, of::START_PROGRAM, Span::default());
            // a list of the machine may name a program that exists only on its control
            self.decoder.report.amend(|d| {
                if d.id != Condition::NoFile {
                    return d;
                }
                let searched = d.hint.clone().unwrap_or_default();
                d.severity(Severity::Warning).hint(format!(
                    "the program runs without it; name its folder with --path; {searched}"
                ))
            });
            self.settle(false);
        }
        if self.found.errors() > 0 && !self.decoder.checking {
            self.end(EndReason::Aborted);
        }
    }

    /// Opens a file; reports problems.
    pub(in crate::exec) fn open(&mut self, name: &str, caller: Option<usize>) -> Option<usize> {
        match self.files.open(name, caller, &self.parser) {
            Ok((file, diagnostics)) => {
                for diagnostic in diagnostics {
                    self.report(diagnostic);
                }
                Some(file)
            }
            Err(error) => {
                let (text, hint) = error.text(name, None);
                let diagnostic = Diagnostic::new(Condition::NoFile, text).hint(hint);
                let diagnostic = match (self.levels.is_empty(), self.here(Span::default())) {
                    (false, Some(location)) => diagnostic.at(location),
                    _ => diagnostic,
                };
                self.report(diagnostic);
                None
            }
        }
    }

    /// The next step of the program, decoded with this state of the machine; after [`Step::End`] always that again.
    pub(crate) fn next(&mut self, told: Told) -> Step {
        self.tell(told);
        self.step()
    }

    /// The next step, with everything that a simulation has to know about it.
    pub(crate) fn decode(&mut self) -> Decoded {
        let step = self.step();
        let changes = matches!(&step, Step::Sync { what: Sync::MachineData { .. }, .. });
        let rare = self.found.any() || self.files.has_opened() || changes;
        let rare = rare.then(|| {
            let changed = (Arc::clone(&self.decoder.machine), self.decoder.shaping.setup.clone());
            Box::new(Rare {
                diagnostics: self.found.take(),
                files: self.files.take_opened(),
                changed: changes.then_some(changed),
            })
        });
        Decoded { step, blocks: self.budget.blocks(), rare }
    }

    fn step(&mut self) -> Step {
        loop {
            if let Some(step) = self.decoder.contour.pop() {
                if step.takes_time(self.decoder.machine.cycle) {
                    self.budget.moved();
                }
                return step;
            }
            if self.decoder.motion.measuring.is_under_way() {
                if let Some(label) = self.decoder.motion.end_of_measuring(
                    &mut self.decoder.live,
                    &mut self.decoder.geometry.coordinates,
                    &mut self.decoder.report,
                ) {
                    self.goto(&label);
                }
                self.settle(false);
                continue;
            }
            match self.state {
                State::Ended => {
                    let (reason, source) = (self.reason, self.decoder.report.source);
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

    /// Takes news of the machine, before the next step is decoded.
    pub(crate) fn tell(&mut self, told: Told) {
        self.decoder.live.tell(told);
    }

    /// Takes the memory of blocks that have been run.
    pub(crate) fn reuse(&mut self, left: &mut SpareBlocks) {
        self.decoder.spare.append(left);
    }

    /// Files opened since the last call, unless [`Self::decode`] has returned them.
    pub(crate) fn take_opened(&mut self) -> Vec<Opened> {
        self.files.take_opened()
    }

    /// Diagnostics since the last call.
    pub(crate) fn take_diagnostics(&mut self) -> Vec<Diagnostic> {
        self.found.take()
    }

    /// Names of the files opened so far; [`SourceRef::file`] is an index into them.
    pub(crate) fn files(&self) -> &[Arc<str>] {
        self.files.names()
    }

    /// Position of a block whose step was returned; its text is read again.
    pub(crate) fn locate(&mut self, source: SourceRef) -> Option<Location> {
        if source.line == 0 {
            return None;
        }
        let mut location = self.files.locate_block(source.file as usize, position(source))?;
        location.block = source.block;
        Some(location)
    }

    /// The structure of the files opened so far.
    pub(in crate::exec::program) fn into_structures(self) -> Structures {
        self.files.into_structures()
    }

    /// Current kernels; before the first step those of the axis lists.
    pub(crate) fn shaping(&self) -> &ShapingSetup {
        &self.decoder.shaping.setup
    }

    /// The settings of the Vibration Guard by the commands executed so far.
    pub(crate) fn guard_commands(&self) -> &GuardCommands {
        &self.decoder.shaping.commands
    }

    /// Rest position of the axes at program start.
    pub(crate) fn start_position(&self) -> &AxisVec {
        &self.start
    }

    /// Targets of the axes after the last block.
    pub(crate) fn target(&self) -> &AxisVec {
        self.decoder.geometry.coordinates.target()
    }
}

/// The number of a file in [`SourceRef`].
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
                let text = format!("start position {name}={value}: no such axis, or not a number");
                diagnostics.push(Diagnostic::new(Condition::Range, text));
            }
        }
    }
    position
}
