//! Control statements and jumps.
//!
//! Source: TF5200 programming manual, control blocks. Assumptions: `$CASE` falls through; bounds of `$FOR` are taken
//! once; a jump may leave control blocks, which closes them. It may enter branches of `$IF` (chapter `$GOTO`), which are
//! then as if their condition had been true (assumption), but neither loops (21480) nor `$SWITCH`.

use super::executor::Executor;
use super::index::{EntryId, Keyword};
use crate::diag::{Condition, Diagnostic, ValueKind};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::values::expr::is_true;
use crate::source::Position;
use crate::syntax::ast::{
    Body, Control, ControlKind, Expr, Label, LabelKind, Place, PlaceKind, Span,
};
use std::sync::Arc;

/// Values closer than this are equal in `$SWITCH`. Source: TF5200 programming manual.
const SWITCH_TOLERANCE: f64 = crate::exec::values::expr::NEARLY;

/// An open control block.
#[derive(Clone, Debug)]
pub(in crate::exec) struct Frame {
    pub(in crate::exec) open: EntryId,
    pub(in crate::exec) keyword: Keyword,
    /// Counter, last value and step of `$FOR`.
    counter: Option<Arc<Counter>>,
}

#[derive(Debug)]
struct Counter {
    place: Place,
    end: f64,
    step: f64,
}

impl Executor {
    /// Carries out a control statement that stands in the index as `id`.
    pub(in crate::exec) fn control(&mut self, control: &Control, id: EntryId) {
        let span = control.span;
        let outcome = match &control.kind {
            ControlKind::If { condition, goto: Some(label) } => {
                if self.test(condition) {
                    self.goto(label);
                }
                Ok(())
            }
            ControlKind::If { condition, goto: None } => self.if_block(condition, id, span),
            ControlKind::ElseIf(_) | ControlKind::Else => {
                // a stray one has been reported
                if self.levels.last().is_some_and(|l| l.index.entry(id).open.is_some()) {
                    self.leave_structure(id);
                }
                Ok(())
            }
            ControlKind::EndIf | ControlKind::EndSwitch => {
                self.pop_frame_of(id);
                Ok(())
            }
            ControlKind::Switch { target, value } => self.switch(target.as_ref(), value, id, span),
            // the case before falls through
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
        self.decoder.keep(outcome);
    }

    /// A condition; a fault in it is reported and counts as false.
    fn test(&mut self, condition: &Expr) -> bool {
        let outcome = self.decoder.condition(condition);
        self.decoder.keep(outcome).unwrap_or(false)
    }

    /// Execution goes on at a place.
    fn jump_to(&mut self, position: Position) {
        if let Some(level) = self.levels.last_mut() {
            level.at = position;
        }
    }

    /// Execution goes on behind the block at a place.
    pub(in crate::exec) fn jump_behind(&mut self, position: Position) {
        let Some(level) = self.levels.last() else { return };
        let file = level.file;
        if let Some((_, next)) = self.fetch(file, position) {
            self.jump_to(next);
        }
    }

    pub(in crate::exec) fn skip_to_level_end(&mut self) {
        if let Some(level) = self.levels.last_mut() {
            level.at = Position { offset: level.end.max(level.at.offset), line: level.at.line };
            level.end = level.end.min(level.at.offset);
        }
    }

    fn position_of(&self, id: Option<EntryId>) -> Option<Position> {
        let level = self.levels.last()?;
        id.map(|id| level.index.entry(id).position)
    }

    fn push_frame(&mut self, id: EntryId, counter: Option<Counter>) {
        let Some(level) = self.levels.last_mut() else { return };
        let keyword = level.index.entry(id).keyword;
        let first_loop = keyword.is_loop() && !level.frames.iter().any(|f| f.keyword.is_loop());
        level.frames.push(Frame { open: id, keyword, counter: counter.map(Arc::new) });
        if first_loop {
            self.files.make_room();
        }
    }

    /// Closes the structure that a clause or closing statement belongs to, and everything inside.
    fn pop_frame_of(&mut self, id: EntryId) {
        let Some(level) = self.levels.last_mut() else { return };
        let open = level.index.entry(id).open;
        if let Some(depth) = level.frames.iter().rposition(|f| Some(f.open) == open) {
            level.frames.truncate(depth);
        }
    }

    /// 21500, 21501, 21502: the closing statement is missing; the rest of the level is not looked at.
    fn unclosed(&mut self, id: EntryId, span: Span) -> Box<Fault> {
        self.skip_to_level_end();
        if let Some(level) = self.levels.last_mut() {
            level.cut = true;
        }
        let Some(level) = self.levels.last() else {
            return Fault::new(Condition::OpenIfMain, "open control block", span);
        };
        let keyword = level.index.entry(id).keyword;
        let closer = keyword.closer().map_or("", Keyword::text);
        let condition = match (level.index.sections[level.section].local, self.levels.len()) {
            (true, _) => Condition::OpenIfLocal,
            (false, 1) => Condition::OpenIfMain,
            (false, _) => Condition::OpenIfGlobal,
        };
        let text = format!("{} without {closer}", keyword.text());
        Fault::new(condition, text, span).with(|d| {
            d.value(ValueKind::Current, 1.0, "-")
                .value(ValueKind::State, keyword.text(), "-")
                .value(ValueKind::Expected, closer, "-")
        })
    }

    fn if_block(&mut self, condition: &Expr, id: EntryId, span: Span) -> Outcome<()> {
        if self.test(condition) {
            self.push_frame(id, None);
            return Ok(());
        }
        self.next_clause(id, span)
    }

    /// Goes through `$ELSEIF` and `$ELSE` until one is taken.
    fn next_clause(&mut self, id: EntryId, span: Span) -> Outcome<()> {
        let mut at = id;
        loop {
            let Some(level) = self.levels.last() else { return Ok(()) };
            let Some(next) = level.index.entry(at).next else {
                return Err(self.unclosed(id, span));
            };
            let (keyword, position) =
                (level.index.entry(next).keyword, level.index.entry(next).position);
            let file = level.file;
            let Some((parsed, behind)) = self.fetch(file, position) else { return Ok(()) };
            at = next;
            let taken = match (&parsed.block.body, keyword) {
                (Body::Control(control), Keyword::ElseIf) => match &control.kind {
                    ControlKind::ElseIf(condition) => {
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
                    self.jump_to(behind);
                    return Ok(());
                }
                _ => false,
            };
            if taken {
                self.push_frame(id, None);
                self.jump_to(behind);
                return Ok(());
            }
        }
    }

    /// The taken branch ends: execution goes on behind the structure.
    fn leave_structure(&mut self, id: EntryId) {
        let Some(level) = self.levels.last() else { return };
        let end = level.index.entry(id).end;
        self.pop_frame_of(id);
        match self.position_of(end) {
            Some(end) => self.jump_behind(end),
            None => self.skip_to_level_end(),
        }
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
            return Err(self.unclosed(id, span));
        }
        let mut default = None;
        let mut at = index.entry(id).next;
        while let Some(clause) = at {
            let entry = index.entry(clause);
            at = entry.next;
            match entry.keyword {
                Keyword::Default => default = Some(entry.position),
                Keyword::Case => {
                    let Some((parsed, behind)) = self.fetch(file, entry.position) else {
                        return Ok(());
                    };
                    let Body::Control(control) = &parsed.block.body else { continue };
                    let ControlKind::Case(case) = &control.kind else { continue };
                    let here = std::mem::replace(&mut self.position, entry.position);
                    let equal = matches(&value, &self.decoder.value(case)?);
                    self.position = here;
                    if equal {
                        self.push_frame(id, None);
                        self.jump_to(behind);
                        return Ok(());
                    }
                }
                _ => {}
            }
        }
        match default {
            Some(default) => {
                self.push_frame(id, None);
                self.jump_behind(default);
            }
            None => self.leave_structure(id),
        }
        Ok(())
    }

    fn for_loop(
        &mut self,
        counter: &Place,
        start: &Expr,
        end: &Expr,
        step: Option<&Expr>,
        id: EntryId,
        span: Span,
    ) -> Outcome<()> {
        let closed = self.levels.last().is_some_and(|l| l.index.entry(id).end.is_some());
        if !closed {
            return Err(self.unclosed(id, span));
        }
        let bounds = (|| {
            let step = match step {
                Some(step) => self.decoder.number(step)?,
                None => 1.0,
            };
            Ok((self.decoder.number(start)?, self.decoder.number(end)?, step))
        })();
        let (first, end, by) = match bounds {
            Ok(bounds) => bounds,
            Err(fault) => {
                self.leave_structure(id);
                return Err(fault);
            }
        };
        if matches!(&counter.kind, PlaceKind::Variable(name) if name.is_empty()) {
            // told while the block was read
            self.leave_structure(id);
            return Ok(());
        }
        let is_counter =
            matches!(counter.kind, PlaceKind::Parameter { .. } | PlaceKind::Variable(_));
        if !is_counter {
            self.leave_structure(id);
            let text = "the counter of $FOR is a P parameter or a variable";
            return Err(Fault::new(Condition::ForCounter, text, counter.span));
        }
        if by == 0.0 {
            let at = step.map_or(span, |s| s.span);
            let text = "$FOR with step 0 does not end";
            self.decoder.note(Fault::new(Condition::Odd, text, at).warning());
        }
        if let Err(fault) = self.decoder.write(counter, Value::Number(first), start.span) {
            self.leave_structure(id);
            return Err(fault.with(|d| Diagnostic { id: Condition::ForCounter.id(), ..d }));
        }
        if passed(first, end, by) {
            self.leave_structure(id);
            return Ok(());
        }
        self.push_frame(id, Some(Counter { place: counter.clone(), end, step: by }));
        Ok(())
    }

    fn end_for(&mut self, id: EntryId) -> Outcome<()> {
        let Some(level) = self.levels.last() else { return Ok(()) };
        let open = level.index.entry(id).open;
        let frame = level.frames.iter().rfind(|f| Some(f.open) == open);
        let Some(counter) = frame.and_then(|f| f.counter.clone()) else { return Ok(()) };
        let value = match self.decoder.read(&counter.place) {
            Ok(Value::Number(x)) => x + counter.step,
            Ok(Value::Text(_)) => f64::NAN,
            Err(fault) => {
                self.pop_frame_of(id);
                return Err(fault);
            }
        };
        self.decoder.write(&counter.place, Value::Number(value), counter.place.span)?;
        if passed(value, counter.end, counter.step) || value.is_nan() {
            self.pop_frame_of(id);
        } else {
            self.repeat(id, false);
        }
        Ok(())
    }

    /// Back to the opening statement (`test`: which tests again) or behind it.
    fn repeat(&mut self, id: EntryId, test: bool) {
        let Some(level) = self.levels.last() else { return };
        let open = level.index.entry(id).open;
        // a stray closing statement repeats nothing
        if !level.frames.iter().any(|f| Some(f.open) == open) {
            return;
        }
        let Some(position) = self.position_of(open) else { return };
        if test {
            self.pop_frame_of(id);
            self.jump_to(position);
        } else {
            if let (Some(level), Some(open)) = (self.levels.last_mut(), open)
                && let Some(depth) = level.frames.iter().rposition(|f| f.open == open)
            {
                level.frames.truncate(depth + 1);
            }
            self.jump_behind(position);
        }
    }

    fn while_loop(&mut self, condition: &Expr, id: EntryId, span: Span) -> Outcome<()> {
        let end = self.levels.last().and_then(|l| l.index.entry(id).end);
        if end.is_none() {
            return Err(self.unclosed(id, span));
        }
        if self.test(condition) {
            self.push_frame(id, None);
        } else {
            self.leave_structure(id);
        }
        Ok(())
    }

    fn open_loop(&mut self, id: EntryId, span: Span) -> Outcome<()> {
        let end = self.levels.last().and_then(|l| l.index.entry(id).end);
        if end.is_none() {
            return Err(self.unclosed(id, span));
        }
        self.push_frame(id, None);
        Ok(())
    }

    /// Repeats while the condition is true, without one for ever.
    fn end_do(&mut self, condition: Option<&Expr>, id: EntryId) {
        if condition.is_none_or(|c| self.test(c)) {
            self.repeat(id, false);
        } else {
            self.pop_frame_of(id);
        }
    }

    /// Repeats until the condition is true.
    fn until(&mut self, condition: &Expr, id: EntryId) -> Outcome<()> {
        match self.decoder.number(condition) {
            Ok(x) if !is_true(x) => self.repeat(id, false),
            Ok(_) => self.pop_frame_of(id),
            Err(fault) => {
                self.pop_frame_of(id);
                return Err(fault);
            }
        }
        Ok(())
    }

    fn innermost(&self, wanted: impl Fn(Keyword) -> bool) -> Option<EntryId> {
        let level = self.levels.last()?;
        level.frames.iter().rfind(|f| wanted(f.keyword)).map(|f| f.open)
    }

    fn break_out(&mut self, span: Span) -> Outcome<()> {
        if let Some(open) = self.innermost(|k| k.is_loop() || k == Keyword::Switch) {
            self.leave_structure(open);
            Ok(())
        } else {
            let text = "$BREAK outside loops and $SWITCH";
            Err(Fault::new(Condition::BreakOutside, text, span))
        }
    }

    fn go_on(&mut self, span: Span) -> Outcome<()> {
        let Some(open) = self.innermost(Keyword::is_loop) else {
            return Err(Fault::new(Condition::ContinueOutside, "$CONTINUE outside loops", span));
        };
        let end = self.levels.last().and_then(|l| l.index.entry(open).end);
        if let (Some(level), Some(end)) = (self.levels.last_mut(), end) {
            if let Some(depth) = level.frames.iter().rposition(|f| f.open == open) {
                level.frames.truncate(depth + 1);
            }
            level.at = level.index.entry(end).position;
        }
        Ok(())
    }

    /// `$GOTO`.
    pub(in crate::exec) fn goto(&mut self, label: &Label) {
        let Some(level) = self.levels.last_mut() else { return };
        let shown = match &label.kind {
            LabelKind::Number(n) => format!("N{n}:"),
            LabelKind::Name(name) => format!("[{name}]"),
        };
        let Some(place) = level.index.label(level.section, &label.kind).copied() else {
            let text = format!("label {shown} does not exist in this program");
            let hint = "a label stands at the beginning of a block: N20: or [NAME]";
            self.decoder.note(Fault::new(Condition::Label, text, label.span).hint(hint));
            return;
        };
        // structures around the label that are not open, the innermost first
        let mut entered = Vec::new();
        let mut around = place.parent;
        let depth = loop {
            let Some(id) = around else { break 0 };
            if let Some(depth) = level.frames.iter().rposition(|f| f.open == id) {
                break depth + 1;
            }
            entered.push(id);
            around = level.index.entry(id).parent;
        };
        let keyword = |id: &EntryId| level.index.entry(*id).keyword;
        let closed = entered.iter().map(keyword).find(|k| *k != Keyword::If);
        if closed.is_none() {
            level.frames.truncate(depth);
            // a branch of $IF is entered as if its condition had been true
            level.frames.extend(entered.iter().rev().map(|id| Frame {
                open: *id,
                keyword: Keyword::If,
                counter: None,
            }));
            level.at = place.position;
            // a jump back is a loop: its blocks are parsed once
            let (to, from) = (place.position.offset, self.position.offset);
            if to <= from {
                let known = level.again.unwrap_or((to, from));
                let again = (known.0.min(to), known.1.max(from));
                if level.again.replace(again) != Some(again) {
                    self.files.make_room();
                }
            }
        } else {
            let keyword = closed.map_or("", Keyword::text);
            let text = format!("label {shown} stands inside {keyword}");
            let condition = match closed {
                Some(keyword) if keyword.is_loop() => Condition::JumpIntoLoop,
                _ => Condition::LabelInto,
            };
            self.decoder.note(Fault::new(condition, text, label.span));
        }
    }
}

/// True if a counter has passed its last value, which is included.
fn passed(value: f64, end: f64, step: f64) -> bool {
    if step > 0.0 { value > end } else { step < 0.0 && value < end }
}

fn matches(value: &Value, case: &Value) -> bool {
    match (value, case) {
        (Value::Number(a), Value::Number(b)) => (a - b).abs() < SWITCH_TOLERANCE,
        (Value::Text(a), Value::Text(b)) => a == b,
        _ => false,
    }
}
