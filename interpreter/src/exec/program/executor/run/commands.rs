//! Commands of control flow and of the program structure, inside the loop over blocks.

use crate::diag::Condition;
use crate::exec::commands;
use crate::exec::fault::Fault;
use crate::exec::program::executor::Executor;
use crate::exec::program::index::EntryId;
use crate::exec::program::level::Level;
use crate::syntax::ast::Command;

impl Executor {
    pub(super) fn command(&mut self, command: &Command, entry: Option<EntryId>) {
        let declarations = self.levels.last().is_some_and(Level::is_declaring);
        if command.is("VAR") || command.is("ENDVAR") {
            let begins = command.is("VAR");
            if begins == declarations {
                let text = if begins { "#VAR inside #VAR" } else { "#ENDVAR without #VAR" };
                let fault = Fault::new(Condition::Syntax, text, command.span);
                let hint = "#VAR begins declarations, the next #ENDVAR ends them";
                self.decoder.report.note(fault.hint(hint));
            }
            if let Some(level) = self.levels.current_mut() {
                level.declare(begins);
            }
            return;
        }
        let is_comment = command.is("COMMENT BEGIN") || command.is("COMMENT END");
        if command.is_conditional() || is_comment {
            let is_if = command.words.first().is_some_and(|word| &*word.text == "IF");
            if let Some(entry) = entry.filter(|_| is_if) {
                self.conditional(command, entry);
            }
            return;
        }
        if command.is("OPTIONAL EXECUTION") {
            self.optional_execution(command);
        }
        self.decoder.report.location = self.here(command.span);
        let skips = self.levels.iter().any(|level| level.optional.is_some());
        if skips && command.is("FLUSH WAIT") {
            let text = "#FLUSH WAIT between #OPTIONAL EXECUTION ON and OFF";
            let fault = Fault::new(Condition::FlushInOptional, text, command.span);
            self.decoder.report.note(fault);
            return;
        }
        let outcome = commands::execute(&mut self.decoder, command);
        self.decoder.report.keep(outcome);
    }

    /// `#OPTIONAL EXECUTION ON` and `OFF` must be on the same level; otherwise 21720 (255794059).
    fn optional_execution(&mut self, command: &Command) {
        let (on, here) = (command.on, (self.position, command.span));
        let Some(level) = self.levels.current_mut() else { return };
        match on {
            Some(true) => level.optional = Some(here),
            Some(false) if level.optional.take().is_none() => {
                let text = "#OPTIONAL EXECUTION OFF without ON on the same program level";
                let fault = Fault::new(Condition::OptionalNotOpen, text, command.span);
                self.decoder.report.note(fault);
            }
            _ => {}
        }
    }

    /// `#IF`: the branch that is not taken is ignored.
    fn conditional(&mut self, command: &Command, id: EntryId) {
        if self.levels.last().is_some_and(|level| level.index.entry(id).end.is_none()) {
            let text = "#IF without #ENDIF";
            self.decoder.report.note(Fault::new(Condition::ConditionalOpen, text, command.span));
        }
        let condition = if let [condition] = &command.arguments[..] {
            let outcome = self.decoder.condition(condition);
            self.decoder.report.keep(outcome).unwrap_or(false)
        } else {
            let text = "#IF needs one condition";
            let fault = Fault::new(Condition::Syntax, text, command.span);
            self.decoder.report.note(fault.hint("write an expression after it: #IF V.E.ROUGHING"));
            false
        };
        if condition {
            return;
        }
        let Some(level) = self.levels.last() else { return };
        let next = level.index.entry(id).next.map(|next| level.index.entry(next).position);
        self.jump_behind_end(next);
    }
}
