//! Control statements; loops are in `loops`, jumps in [`super::jumps`].
//!
//! Source: TF5200 programming manual, control blocks. Assumptions: `$CASE` falls through; the bounds of `$FOR` are
//! evaluated once.

mod loops;

use super::executor::Executor;
use super::index::{EntryId, Index, Keyword};
use super::reads::Reads;
use crate::diag::Condition;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::report::Subject;
use crate::source::Position;
use crate::syntax::ast::{Body, Control, ControlKind, Expr, Place, Span};
use std::sync::Arc;

/// Values closer than this are equal in `$SWITCH`. Source: TF5200 programming manual.
const SWITCH_TOLERANCE: f64 = crate::exec::values::number::NEARLY;

/// The clause at which `$SWITCH` continues.
enum Clause {
    /// The first equal case, with the position after it.
    Case(Position),
    /// The position of `$DEFAULT`.
    Default(Position),
    Missing,
    /// An error ended the program before it was found.
    Unknown,
}

impl Executor {
    /// Executes a control statement listed in the index as `id`.
    pub(in crate::exec) fn control(&mut self, control: &Control, id: EntryId) {
        let span = control.span;
        let outcome = match &control.kind {
            ControlKind::If { condition, goto: Some(label) } => {
                if self.test(condition) {
                    let reads = Reads::of_jump(label, self.files.asynchronous());
                    if self.rests_before(reads.external) {
                        self.goto(label);
                    }
                }
                Ok(())
            }
            ControlKind::If { condition, goto: None } => self.if_block(condition, id, span),
            ControlKind::ElseIf(_) | ControlKind::Else => self.skip_clauses(id, span),
            ControlKind::EndIf | ControlKind::EndSwitch => {
                self.levels.close(id);
                Ok(())
            }
            ControlKind::Switch { target, value } => self.switch(target.as_ref(), value, id, span),
            // the case before it falls through
            ControlKind::Case(_) | ControlKind::Default => Ok(()),
            ControlKind::For { counter, start, end, step } => {
                self.for_loop(counter, start, end, step.as_ref(), id, span)
            }
            ControlKind::EndFor => self.end_for(id),
            ControlKind::While(condition) => self.while_loop(condition, id, span),
            ControlKind::EndWhile => {
                self.repeat(id, true);
                Ok(())
            }
            ControlKind::Do | ControlKind::Repeat => self.open_loop(id, span),
            ControlKind::EndDo(condition) => {
                self.end_do(condition.as_ref(), id);
                Ok(())
            }
            ControlKind::Until(condition) => self.until(condition, id),
            ControlKind::Break => self.break_out(span),
            ControlKind::Continue => self.go_on(span),
        };
        self.decoder.report.keep(outcome);
    }

    /// Evaluates a condition; a fault in it is reported and counts as false.
    fn test(&mut self, condition: &Expr) -> bool {
        let outcome = self.decoder.condition(condition);
        self.decoder.report.keep(outcome).unwrap_or(false)
    }

    /// Continues after the block at a position.
    pub(in crate::exec) fn jump_behind(&mut self, position: Position) {
        let Some(level) = self.levels.last() else { return };
        let file = level.file;
        if let Some((_, next)) = self.fetch(file, position) {
            self.levels.jump_to(next);
        }
    }

    /// Continues after the closing statement of a structure; without one, the structure covers the rest of the text.
    pub(in crate::exec::program) fn jump_behind_end(&mut self, end: Option<Position>) {
        match end {
            Some(end) => self.jump_behind(end),
            None => self.levels.skip_unclosed(),
        }
    }

    fn if_block(&mut self, condition: &Expr, id: EntryId, span: Span) -> Outcome<()> {
        if self.test(condition) {
            self.levels.open(id, None, &mut self.files);
            return Ok(());
        }
        self.next_clause(id, span)
    }

    /// Evaluates `$ELSEIF` and `$ELSE` until one is taken.
    fn next_clause(&mut self, id: EntryId, span: Span) -> Outcome<()> {
        let mut at = id;
        loop {
            let Some(level) = self.levels.last() else { return Ok(()) };
            let Some(next) = level.index.entry(at).next else {
                return Err(self.levels.unclosed(id, span));
            };
            let (keyword, position) =
                (level.index.entry(next).keyword, level.index.entry(next).position);
            let file = level.file;
            let Some((parsed, behind)) = self.fetch(file, position) else { return Ok(()) };
            at = next;
            let taken = match (&parsed.block.body, keyword) {
                (Body::Control(control), Keyword::ElseIf) => match &control.kind {
                    ControlKind::ElseIf(condition) => {
                        if !self.rests_before(parsed.reads.external) {
                            return Ok(());
                        }
                        let here = std::mem::replace(&mut self.position, position);
                        let outcome = self.decoder.condition(condition);
                        match outcome {
                            Ok(taken) => {
                                self.position = here;
                                taken
                            }
                            Err(fault) => return Err(fault),
                        }
                    }
                    _ => false,
                },
                (_, Keyword::Else) => true,
                (_, Keyword::EndIf) => {
                    self.levels.jump_to(behind);
                    return Ok(());
                }
                _ => false,
            };
            if taken {
                self.levels.open(id, None, &mut self.files);
                self.levels.jump_to(behind);
                return Ok(());
            }
        }
    }

    /// The branch taken ends at another clause: execution continues after the structure.
    fn skip_clauses(&mut self, clause: EntryId, span: Span) -> Outcome<()> {
        let Some(level) = self.levels.last() else { return Ok(()) };
        let entry = level.index.entry(clause);
        match (entry.open, entry.end) {
            // an unmatched clause has already been reported
            (None, _) => Ok(()),
            (Some(open), None) => {
                self.levels.close(clause);
                Err(self.levels.unclosed(open, span))
            }
            (Some(_), Some(_)) => {
                self.leave_structure(clause);
                Ok(())
            }
        }
    }

    /// Continues after the structure.
    fn leave_structure(&mut self, id: EntryId) {
        let Some(level) = self.levels.last() else { return };
        let end = level.end_of(id);
        self.levels.close(id);
        self.jump_behind_end(end);
    }

    fn switch(
        &mut self,
        target: Option<&Place>,
        value: &Expr,
        id: EntryId,
        span: Span,
    ) -> Outcome<()> {
        let value_span = value.span;
        let value = self.decoder.value(value);
        let value = match value {
            Ok(value) => value,
            Err(fault) => {
                self.leave_structure(id);
                return Err(fault);
            }
        };
        if let Some(place) = target {
            self.decoder.write(place, value.clone(), value_span)?;
        }
        let Some(level) = self.levels.last() else { return Ok(()) };
        let (file, index) = (level.file, Arc::clone(&level.index));
        if index.entry(id).end.is_none() {
            return Err(self.levels.unclosed(id, span));
        }
        if let Some(first) = index.entry(id).next.map(|clause| index.entry(clause).position) {
            self.before_clauses(file, first, span);
        }
        match self.clause(file, &index, id, &value)? {
            Clause::Case(behind) => {
                self.levels.open(id, None, &mut self.files);
                self.levels.jump_to(behind);
            }
            Clause::Default(at) => {
                self.levels.open(id, None, &mut self.files);
                self.jump_behind(at);
            }
            Clause::Missing => self.leave_structure(id),
            Clause::Unknown => {}
        }
        Ok(())
    }

    /// Evaluates the cases of `$SWITCH` until one is equal to its value.
    fn clause(
        &mut self,
        file: usize,
        index: &Index,
        id: EntryId,
        value: &Value,
    ) -> Outcome<Clause> {
        let mut default = None;
        let mut at = index.entry(id).next;
        while let Some(clause) = at {
            let entry = index.entry(clause);
            at = entry.next;
            match entry.keyword {
                Keyword::Default => default = Some(entry.position),
                Keyword::Case => {
                    let Some((parsed, behind)) = self.fetch(file, entry.position) else {
                        return Ok(Clause::Unknown);
                    };
                    let Body::Control(control) = &parsed.block.body else { continue };
                    let ControlKind::Case(case) = &control.kind else { continue };
                    if !self.rests_before(parsed.reads.external) {
                        return Ok(Clause::Unknown);
                    }
                    let here = std::mem::replace(&mut self.position, entry.position);
                    let equal = matches(value, &self.decoder.value(case)?);
                    self.position = here;
                    if equal {
                        return Ok(Clause::Case(behind));
                    }
                }
                _ => {}
            }
        }
        Ok(default.map_or(Clause::Missing, Clause::Default))
    }

    /// Blocks between `$SWITCH` and its first clause do not belong to any case.
    fn before_clauses(&mut self, file: usize, first: Position, span: Span) {
        let mut at = self.levels.last().map_or(first, |level| level.at);
        let switch = self.position.offset;
        while at.offset < first.offset {
            let Some((parsed, behind)) = self.fetch(file, at) else { return };
            if parsed.block.body != Body::Empty {
                let text = format!(
                    "the block in line {} between $SWITCH and its first clause never runs",
                    at.line
                );
                let fault = Fault::new(Condition::Odd, text, span).warning();
                let hint = "write it before $SWITCH or after a $CASE";
                self.decoder.report.note_once(Subject::Switch(switch), fault.hint(hint));
                return;
            }
            at = behind;
        }
    }
}

fn matches(value: &Value, case: &Value) -> bool {
    match (value, case) {
        (Value::Number(a), Value::Number(b)) => (a - b).abs() < SWITCH_TOLERANCE,
        (Value::Text(a), Value::Text(b)) => a == b,
        _ => false,
    }
}
