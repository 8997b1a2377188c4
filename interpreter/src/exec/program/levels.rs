//! Program levels: start and end of programs, subroutines and cycles.

use super::executor::Executor;
use super::level::Level;
use super::state::{Closing, Passed, Target};
use crate::diag::{Condition, Diagnostic, Severity, ValueKind};
use crate::exec::fault::Fault;
use crate::exec::step::EndReason;
use crate::machine::table::channel as of;
use crate::syntax::ast::Span;
use std::sync::Arc;

impl Executor {
    /// Enters a program.
    pub(in crate::exec) fn push_level(&mut self, target: Target, cycle: Option<Passed>) {
        let Target { file, section } = target;
        let index = Arc::clone(&self.files.file(file).index);
        let part = &index.sections[section];
        let info = &mut self.decoder.calls.info;
        info.file = Arc::clone(&self.files.file(file).name);
        info.program = part.name.clone().unwrap_or_else(|| Arc::clone(&info.file));
        let saved = cycle.map(|passed| {
            self.decoder.values.variables.enter_cycle(passed);
            Box::new(self.decoder.enter_cycle())
        });
        let caller = (!self.levels.is_empty()).then_some(self.decoder.report.source);
        if caller.is_some() {
            self.decoder.values.variables.enter_level();
        }
        self.levels.enter(Level::new(target, index, saved, caller));
        self.decoder.calls.info.level = u32::try_from(self.levels.len()).unwrap_or(u32::MAX);
    }

    /// Leaves a subroutine.
    fn pop_level(&mut self) {
        let Some(level) = self.levels.leave() else { return };
        self.decoder.values.variables.leave_level();
        if let Some(before) = level.cycle {
            self.decoder.values.variables.leave_cycle();
            self.decoder.leave_cycle(*before);
        }
        if let Some(level) = self.levels.last() {
            let info = &mut self.decoder.calls.info;
            info.file = Arc::clone(&self.files.file(level.file).name);
            let name = level.index.sections[level.section].name.clone();
            info.program = name.unwrap_or_else(|| Arc::clone(&info.file));
        }
        self.decoder.calls.info.level = u32::try_from(self.levels.len()).unwrap_or(u32::MAX);
    }

    /// Leaves a subroutine, and then the levels that the calling block leaves.
    fn leave_level(&mut self) {
        let then = self.levels.last().and_then(|level| level.then);
        self.pop_level();
        if let Some(closing) = then {
            self.close(closing);
        }
    }

    /// Leaves `count` subroutines at once; returns how the block that called the last of them leaves its level, which
    /// is still to be done.
    pub(super) fn leave_levels(&mut self, count: usize) -> Option<Closing> {
        let mut then = None;
        for _ in 0..count {
            if self.levels.len() == 1 {
                return Some(Closing::Return);
            }
            self.open_blocks();
            then = self.levels.last().and_then(|level| level.then);
            self.pop_level();
        }
        then
    }

    /// Leaves a level or ends the program, as M17 and M30 do.
    pub(super) fn close(&mut self, closing: Closing) {
        match closing {
            Closing::Return => self.return_from_level(),
            Closing::End => self.program_end(),
        }
    }

    /// Called at the end of the text of a level.
    pub(in crate::exec) fn level_ends(&mut self) {
        self.open_blocks();
        if self.levels.current_mut().is_some_and(Level::begin_again) {
            return;
        }
        if self.levels.len() > 1 {
            self.leave_level();
            return;
        }
        let cut = self.levels.last().is_some_and(Level::is_open_ended);
        if !cut && !self.end_program_called {
            let text = "the main program ends without M30 or M02";
            let mut diagnostic = Diagnostic::new(Condition::NoEnd, text);
            diagnostic.source = self.here(Span::default());
            self.report(diagnostic);
        }
        self.decoder.moved = false;
        self.finish();
        self.settle(false);
    }

    /// The main program is over: runs the program of P-CHAN-00252, once, before the end.
    fn finish(&mut self) {
        if let (Some(name), false) =
            (self.decoder.machine.channel.programs.end.clone(), self.end_program_called)
        {
            self.end_program_called = true;
            while self.levels.len() > 1 {
                self.pop_level();
            }
            self.levels.close_all();
            self.levels.skip_to_end();
            self.call_of_list(&name, of::END_PROGRAM, Span::default());
            return;
        }
        self.contouring_at_end();
        self.area_at_end();
        self.decoder.motion.measuring.banding_ends(&mut self.decoder.report);
        self.decoder.motion.contour_line.end(&mut self.decoder.report);
        self.external_at_end();
        self.end(EndReason::Finished);
    }

    /// Reports external variables whose values the program does not use: a name may be mistyped.
    fn external_at_end(&mut self) {
        for (name, similar) in self.decoder.values.variables.unused_external() {
            let text =
                format!("V.E.{name} has a value from --external, but the program does not use it");
            let diagnostic = Diagnostic::new(Condition::Odd, text);
            self.report(match similar {
                Some(hint) => diagnostic.hint(hint),
                None => diagnostic,
            });
        }
    }

    /// 21719: `#OPTIONAL EXECUTION ON` is not ended on its level (255789707).
    fn optional_at_end(&mut self) {
        let Some(level) = self.levels.current_mut() else { return };
        let Some((at, span)) = level.optional.take() else { return };
        let text = "#OPTIONAL EXECUTION ON without OFF before the end of its program";
        let diagnostic = Diagnostic::new(Condition::OptionalOpen, text);
        let location = self.place(at, span);
        self.report(match location {
            Some(location) => diagnostic.at(location),
            None => diagnostic,
        });
    }

    /// 20375: control blocks were entered and have no end.
    fn open_blocks(&mut self) {
        self.optional_at_end();
        let endless = self.levels.last().and_then(Level::endless);
        let Some((entry, count)) = endless else { return };
        let keyword = entry.keyword;
        let closer = keyword.closer().map_or("", super::index::Keyword::text);
        let text = format!("{} is not closed by {closer}", keyword.text());
        let diagnostic = Diagnostic::new(Condition::OpenControlAtEnd, text)
            .value(ValueKind::Current, count as f64, "-")
            .value(ValueKind::State, keyword.text(), "-")
            .value(ValueKind::Expected, closer, "-");
        let location = self.place(entry.position, entry.span);
        self.report(match location {
            Some(location) => diagnostic.at(location),
            None => diagnostic,
        });
    }

    /// 120206: contouring at the end of the program.
    fn contouring_at_end(&mut self) {
        if self.decoder.modal.contouring {
            let text = "the program ends with contouring active";
            let mut diagnostic =
                Diagnostic::new(Condition::ContouringAtEnd, text).severity(Severity::Warning);
            diagnostic.source = self.here(Span::default());
            self.report(diagnostic);
        }
    }

    /// K-0148 for a definition that would hide the rest of the program.
    fn area_at_end(&mut self) {
        if let Some(span) = self.decoder.motion.areas.open() {
            let text = "a control area is not closed by #CONTROL AREA END";
            self.decoder.report.note(Fault::new(Condition::AreaWrong, text, span));
        }
    }

    /// M02, M30.
    pub(in crate::exec) fn program_end(&mut self) {
        self.open_blocks();
        if self.levels.len() > 1 {
            let text = "M02 or M30 inside a subroutine ends the whole program";
            let fault = Fault::new(Condition::Odd, text, Span::default()).warning();
            self.decoder.report.note(fault);
        }
        self.finish();
    }

    /// M17, M29; on the main level they end the program.
    pub(in crate::exec) fn return_from_level(&mut self) {
        self.open_blocks();
        if self.levels.len() > 1 {
            self.leave_level();
        } else {
            self.finish();
        }
    }
}
