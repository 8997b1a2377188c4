//! Loops: `$FOR`, `$WHILE`, `$DO`, `$REPEAT`, with `$BREAK` and `$CONTINUE`.

use crate::diag::{Condition, Diagnostic};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::program::executor::Executor;
use crate::exec::program::index::EntryId;
use crate::exec::program::index::Keyword;
use crate::exec::program::level::Counter;
use crate::exec::program::reads::Reads;
use crate::syntax::ast::{Expr, Place, PlaceKind, Span};

impl Executor {
    pub(super) fn for_loop(
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
            return Err(self.levels.unclosed(id, span));
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
            // reported when the block was read
            self.leave_structure(id);
            return Ok(());
        }
        let is_counter =
            matches!(counter.kind, PlaceKind::Parameter { .. } | PlaceKind::Variable(_));
        if !is_counter {
            self.leave_structure(id);
            let text = "the counter of $FOR must be a P parameter or a variable";
            return Err(Fault::new(Condition::ForCounter, text, counter.span));
        }
        if by == 0.0 {
            let at = step.map_or(span, |s| s.span);
            let text = "$FOR with step 0 never ends";
            self.decoder.report.note(Fault::new(Condition::Odd, text, at).warning());
        }
        if let Err(fault) = self.decoder.write(counter, Value::Number(first), start.span) {
            self.leave_structure(id);
            return Err(fault.with(|d| Diagnostic { id: Condition::ForCounter.id(), ..d }));
        }
        if passed(first, end, by) {
            self.leave_structure(id);
            return Ok(());
        }
        self.levels.open(
            id,
            Some(Counter { place: counter.clone(), end, step: by }),
            &mut self.files,
        );
        Ok(())
    }

    pub(super) fn end_for(&mut self, id: EntryId) -> Outcome<()> {
        let Some(counter) = self.levels.counter_of(id) else { return Ok(()) };
        let reads = Reads::of_place(&counter.place, self.files.asynchronous());
        if !self.rests_before(reads.external) {
            return Ok(());
        }
        let value = match self.decoder.read(&counter.place) {
            Ok(Value::Number(x)) => x + counter.step,
            Ok(Value::Text(_)) => f64::NAN,
            Err(fault) => {
                self.levels.close(id);
                return Err(fault);
            }
        };
        self.decoder.write(&counter.place, Value::Number(value), counter.place.span)?;
        if passed(value, counter.end, counter.step) || value.is_nan() {
            self.levels.close(id);
        } else {
            self.repeat(id, false);
        }
        Ok(())
    }

    /// Returns to the opening statement if `test` is set, which evaluates its condition again, otherwise to the block
    /// after it.
    pub(super) fn repeat(&mut self, id: EntryId, test: bool) {
        // an unmatched closing statement does not repeat anything
        if !self.levels.close_inside(id) {
            return;
        }
        let Some(position) = self.levels.last().and_then(|level| level.start_of(id)) else {
            return;
        };
        if test {
            self.levels.close(id);
            self.levels.jump_to(position);
        } else {
            self.jump_behind(position);
        }
    }

    pub(super) fn while_loop(&mut self, condition: &Expr, id: EntryId, span: Span) -> Outcome<()> {
        let end = self.levels.last().and_then(|l| l.index.entry(id).end);
        if end.is_none() {
            return Err(self.levels.unclosed(id, span));
        }
        if self.test(condition) {
            self.levels.open(id, None, &mut self.files);
        } else {
            self.leave_structure(id);
        }
        Ok(())
    }

    pub(super) fn open_loop(&mut self, id: EntryId, span: Span) -> Outcome<()> {
        let end = self.levels.last().and_then(|l| l.index.entry(id).end);
        if end.is_none() {
            return Err(self.levels.unclosed(id, span));
        }
        self.levels.open(id, None, &mut self.files);
        Ok(())
    }

    /// Repeats while the condition is true; without a condition forever.
    ///
    /// Here all values below 0.5 are FALSE, including negative ones; for `$WHILE` and `$IF` it is the range -0.5 to 0.5
    /// (206946827, 206940939).
    pub(super) fn end_do(&mut self, condition: Option<&Expr>, id: EntryId) {
        let goes_on = condition.is_none_or(|condition| {
            let value = self.decoder.number(condition);
            self.decoder.report.keep(value).is_some_and(|x| x >= 0.5)
        });
        if goes_on {
            self.repeat(id, false);
        } else {
            self.levels.close(id);
        }
    }

    /// Repeats until the condition is true, which here means above 0.5 (206946827, in its German text and 15556885643).
    pub(super) fn until(&mut self, condition: &Expr, id: EntryId) -> Outcome<()> {
        match self.decoder.number(condition) {
            Ok(x) if x <= 0.5 => self.repeat(id, false),
            Ok(_) => self.levels.close(id),
            Err(fault) => {
                self.levels.close(id);
                return Err(fault);
            }
        }
        Ok(())
    }

    pub(super) fn break_out(&mut self, span: Span) -> Outcome<()> {
        if let Some(open) = self.levels.innermost(|k| k.is_loop() || k == Keyword::Switch) {
            self.leave_structure(open);
            Ok(())
        } else {
            let text = "$BREAK outside loops and $SWITCH";
            Err(Fault::new(Condition::BreakOutside, text, span))
        }
    }

    pub(super) fn go_on(&mut self, span: Span) -> Outcome<()> {
        let Some(open) = self.levels.innermost(Keyword::is_loop) else {
            return Err(Fault::new(Condition::ContinueOutside, "$CONTINUE outside loops", span));
        };
        if let Some(end) = self.levels.last().and_then(|level| level.end_of(open)) {
            self.levels.close_inside(open);
            self.levels.jump_to(end);
        }
        Ok(())
    }
}

/// Whether a counter has passed its last value, which itself is included.
fn passed(value: f64, end: f64, step: f64) -> bool {
    if step > 0.0 { value > end } else { step < 0.0 && value < end }
}
