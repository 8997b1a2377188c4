//! G words: functions of the control, and subroutines configured for a number.

use crate::diag::{Condition, ValueKind};
use crate::exec::block::choice::Selection;
use crate::exec::block::collected::{CycleCall, GWord, Words};
use crate::exec::block::dialect::{self, Seen};
use crate::exec::block::groups::{self, Act, Group, Row, ValueRule};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::{GValue, Span};

impl Words<'_> {
    /// A group has one function in a block; G90 and G91 may follow each other if the list permits it, beginning with
    /// `dimension`, whether the block starts with absolute positions.
    fn occupy(&mut self, row: &'static Row, dimension: Option<bool>, span: Span) -> Outcome<()> {
        if let Some(at_start) = dimension
            && let Act::Absolute(absolute) = row.act
        {
            if self.dimensions.is_empty() {
                self.dimensions.push((0, at_start));
            }
            self.dimensions.push((self.axes.len(), absolute));
        } else if row.group != Group::None
            && let Some(first) = self.group(row.group)
        {
            return Err(duplicate(first.row, row, span));
        }
        Ok(())
    }
}

impl Decoder {
    pub(super) fn g_word(
        &mut self,
        number: u32,
        value: Option<&GValue>,
        span: Span,
        block: &mut Words<'_>,
    ) -> Outcome<()> {
        if groups::is_cycle_call(number) {
            return self.cycle_word(number, value, span, block);
        }
        if number > groups::NUMBER_MAX {
            let text = format!("the number of the G function exceeds {}", groups::NUMBER_MAX);
            return Err(Fault::new(Condition::GNumberTooLarge, text, span).with(|d| {
                // more digits than a number in the syntax tree can have
                let known = number < u32::MAX;
                let d = if known { d.value(ValueKind::Wrong, number, "-") } else { d };
                d.value(ValueKind::UpperLimit, groups::NUMBER_MAX, "-")
            }));
        }
        let Some(row) = groups::row(number) else {
            return Err(unknown(number, self.dialect, span));
        };
        let several = self.machine.channel.language.several_dimensions;
        block.occupy(row, several.then_some(self.modal.absolute), span)?;
        for other in &block.g {
            if let Some(why) = groups::exclude(other.row, row) {
                let text = format!("G{:02} and G{number:02} in one block: {why}", other.row.number);
                return Err(Fault::new(Condition::DuplicateGroup, text, span)
                    .with(|d| d.value(ValueKind::Wrong, number, "-")));
            }
        }
        if number == 5 && self.modal.selection == Selection::InsideCorner {
            let text = "G05 cannot be used with the inside corner selection G238 and is ignored";
            self.report.note(Fault::new(Condition::TangentialInsideCorner, text, span));
            return Ok(());
        }
        if let Act::Unsupported(what) = row.act {
            // it still uses its axis words and occupies its group
            block.g.push(GWord { row, value: None, span });
            return Err(Fault::unsupported(format!("G{number:02} ({what})"), span));
        }
        if let Some(fault) = value.and_then(|value| dialect::high_speed(number, value, span)) {
            return Err(fault);
        }
        let value = self.g_value(row, value, span)?;
        block.g.push(GWord { row, value, span });
        Ok(())
    }

    /// The value after `=`, if the function takes one.
    fn g_value(&self, row: &Row, value: Option<&GValue>, span: Span) -> Outcome<Option<f64>> {
        let number = row.number;
        match (value, row.value) {
            (None, ValueRule::Required) => {
                let text = format!("G{number} needs a value");
                Err(Fault::new(Condition::ValueMissing, text, span))
            }
            (Some(GValue::Scalar(expr)), ValueRule::Required | ValueRule::Optional) => {
                let value = self.number(expr).map_err(|fault| match row.act {
                    Act::Dwell if fault.diagnostic.id == Condition::ParameterUnknown.id() => {
                        fault.hint("write the time in seconds without an address: G04 0.5")
                    }
                    _ => fault,
                })?;
                Ok(Some(value))
            }
            (Some(GValue::Scalar(expr)), ValueRule::Never) => {
                let text = format!("G{number:02} takes no value");
                Err(Fault::new(Condition::Syntax, text, expr.span).hint(form(number)))
            }
            (Some(GValue::List(_)), _) => {
                let text = format!("G{number:02} takes no list");
                Err(Fault::new(Condition::Syntax, text, span).hint(form(number)))
            }
            (None, _) => Ok(None),
        }
    }

    fn cycle_word(
        &mut self,
        number: u32,
        value: Option<&GValue>,
        span: Span,
        block: &mut Words<'_>,
    ) -> Outcome<()> {
        if !self.calls.cycle_files.contains_key(&number) {
            let text = format!("G{number}: no subroutine is configured");
            let hint = "configure one with P-CHAN-00160 to 00169 or #FILE NAME [G80=\"file\"]";
            let fault = Fault::new(Condition::GUnknown, text, span)
                .with(|d| d.value(ValueKind::Current, number, "-"));
            return Err(fault.hint(hint));
        }
        let written = value.is_some();
        let mut values = Vec::new();
        match value {
            None => {}
            Some(GValue::Scalar(expr)) => values.push(Some(self.value(expr)?)),
            Some(GValue::List(list)) => {
                for entry in list {
                    values.push(match entry {
                        Some(expr) => Some(self.value(expr)?),
                        None => None,
                    });
                }
            }
        }
        if values.len() > 50 {
            let text = format!("{} values, a call takes at most 50", values.len());
            return Err(Fault::new(Condition::Range, text, span));
        }
        let values = written.then_some(values);
        if block.cycle.replace(CycleCall { number, values, span }).is_some() {
            return Err(Fault::new(
                Condition::SeveralCalls,
                "two implicit calls in one block",
                span,
            ));
        }
        Ok(())
    }
}

/// Hint for a G function that is written in another form than its own.
fn form(number: u32) -> String {
    format!("kontur explain G{number:02} shows its form")
}

fn duplicate(first: &Row, second: &Row, span: Span) -> Box<Fault> {
    let text = format!(
        "G{:02} and G{:02} in one block: both set {}",
        first.number,
        second.number,
        second.group.name()
    );
    let dwells = first.act == Act::Dwell && second.act == Act::Dwell;
    let condition = match (dwells, first.number, second.number) {
        (true, _, _) => Condition::DwellTwice,
        (false, 310, 310) => Condition::InterruptibleTwice,
        _ => second.group.duplicate(),
    };
    Fault::new(condition, text, span).with(|d| d.value(ValueKind::Wrong, second.number, "-"))
}

/// A G function that the control does not have, with what other dialects mean by it.
fn unknown(number: u32, dialect: Seen, span: Span) -> Box<Fault> {
    if let Some(fault) = dialect.homing(number, span) {
        return fault;
    }
    let fault = Fault::new(Condition::GUnknown, format!("unknown G function G{number:02}"), span)
        .with(|d| d.value(ValueKind::Current, number, "-"));
    match dialect::unknown_g(number) {
        Some(hint) => fault.hint(hint),
        None => fault,
    }
}
