//! One block of DIN words: collects them with their values, left to right.
//!
//! Assignments take effect while the words are collected, so that a value uses the assignments written before it. Everything
//! else takes effect afterwards, in the order of [`super::din`].

mod g;

use super::collected::{Code, Words};
use super::groups::{self};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::report::Report;
use crate::exec::values::{every_axis, system};
use crate::machine::Channel;
use crate::suggest;
use crate::syntax::ast::{
    Assign, Binary, BinaryOp, CodeNumber, Expr, ExprKind, PlaceKind, Span, Word, WordKind,
};

impl Code {
    /// An M or H function and its value; `letter`: which of the two.
    pub(super) fn read(
        decoder: &Decoder,
        number: &CodeNumber,
        value: Option<&Expr>,
        letter: &str,
        span: Span,
    ) -> Outcome<Self> {
        // the diagnosis manual prints the limit of M (20160, 250945931), but not that of H
        let (highest, condition) = match letter {
            "M" => (1000, Condition::MNumberTooLarge),
            _ => (65535, Condition::Range),
        };
        let number = match number {
            CodeNumber::Literal(n) => *n,
            CodeNumber::Computed(expr) => {
                decoder.whole(expr, "the number of a function", 0, u32::MAX)?
            }
        };
        if number > highest {
            let text = format!("the number of the {letter} function exceeds {highest}");
            return Err(Fault::new(condition, text, span).with(|d| {
                d.value(ValueKind::Wrong, number, "-").value(ValueKind::UpperLimit, highest, "-")
            }));
        }
        let value = match value {
            Some(expr) => Some(decoder.number(expr)?),
            None => None,
        };
        if let (Some(fraction), "M") = (value.filter(|x| x.fract() != 0.0), letter) {
            let text =
                format!("M{number:02}={fraction}: the value of an M function must be an integer");
            return Err(Fault::new(Condition::Range, text, span));
        }
        if let (Some(value), "M", 3..=5 | 40..=45) = (value, letter, number) {
            let text = format!("M{number:02} takes no value, not {value}");
            return Err(Fault::new(Condition::Syntax, text, span));
        }
        Ok(Self { number, value, span })
    }
}

impl Decoder {
    /// Collects the words of a block and executes its assignments. Invalid words are reported and skipped.
    pub(in crate::exec) fn collect<'b>(&mut self, words: &'b [Word], block: &mut Words<'b>) {
        for (i, word) in words.iter().enumerate() {
            if let Err(fault) = self.collect_word(word, block) {
                if i == 0 && fault.diagnostic.id == Condition::ONotImplemented.id() {
                    self.dialect.program_number();
                }
                self.report.note(fault);
                let foreign_call = match word.kind {
                    WordKind::G { number, .. } => super::dialect::is_call(number),
                    _ => false,
                };
                if block.call.is_some() || block.addition.is_some() || foreign_call {
                    break;
                }
            }
        }
        // several words of an axis are possible in motions (P-CHAN-00148)
        if self.machine.channel.several_words
            && block.g.iter().any(|g| groups::takes_axes(g.row))
            && let Some(i) = (1..block.axes.len())
                .find(|i| block.axes[..*i].iter().any(|(a, _, _)| *a == block.axes[*i].0))
        {
            let (axis, _, span) = block.axes.remove(i);
            self.report.note(self.names.twice(axis, span));
        }
        if let (Some(_), Some((_, span)), true) =
            (block.tool, block.tool_data, self.machine.channel.tool_data_with_tool)
        {
            let text = "D beside T, which also selects the tool data (P-CHAN-00014)";
            self.report.note(Fault::new(Condition::ToolDataTwice, text, span));
        }
        if let (Some(_), Some((condition, span))) = (block.tool_data, block.tool_written) {
            let text = "D and a write to V.G.WZ_AKT in one block: both set the tool data in use";
            self.report.note(Fault::new(condition, text, span));
        }
    }

    fn collect_word<'b>(&mut self, word: &'b Word, block: &mut Words<'b>) -> Outcome<()> {
        let span = word.span;
        if block.call.is_some() && !matches!(word.kind, WordKind::Call(_)) {
            let text = "nothing may follow a subroutine or cycle call in its block";
            return Err(Fault::new(Condition::BehindCall, text, span));
        }
        if block.addition.is_some() {
            let text = "a word after #ADD, which must be last in its block";
            return Err(Fault::new(Condition::BehindAddition, text, span));
        }
        match &word.kind {
            WordKind::Address { name, sign, value } => {
                if block.assigned_to == Some(span.start) && name.letter() == Some(b'E') {
                    let text = "numbers cannot have an exponent in this dialect";
                    return Err(Fault::new(Condition::Syntax, text, span)
                        .hint("write 1000 for 1e3, 0.00001 for 1e-05"));
                }
                self.address(name, *sign, value, span, block)
            }
            WordKind::G { number, value } => self.g_word(*number, value.as_deref(), span, block),
            WordKind::ComputedG(number) => {
                let number = self.whole(number, "the number of a G function", 0, u32::MAX)?;
                self.g_word(number, None, span, block)
            }
            WordKind::M(number, value) => {
                let code = Code::read(self, number, value.as_deref(), "M", span)?;
                once(&block.m, &code, "M", Condition::MTwice)?;
                block.m.push(code);
                Ok(())
            }
            WordKind::Return(back) => {
                let code = Code { number: back.number, value: None, span };
                once(&block.m, &code, "M", Condition::MTwice)?;
                block.m.push(code);
                block.back = Some((back, span));
                Ok(())
            }
            WordKind::H(number, value) => {
                let code = Code::read(self, number, value.as_deref(), "H", span)?;
                once(&block.h, &code, "H", Condition::HTwice)?;
                block.h.push(code);
                Ok(())
            }
            WordKind::Bracket(bracket) => {
                block.brackets.push(bracket);
                Ok(())
            }
            WordKind::Assign(assign) => {
                if let PlaceKind::Cycle(name) = &assign.target.kind
                    && !name.starts_with('P')
                {
                    if let Some(operator) = assign.operator {
                        let text = format!(
                            "@{name} takes a value with `=`, not with `{}=`",
                            operator.symbol()
                        );
                        return Err(Fault::new(Condition::Syntax, text, span));
                    }
                    return self.cycle_address(name, assign, span, block);
                }
                block.assigned_to = Some(span.end());
                if let PlaceKind::Variable(segments) = &assign.target.kind
                    && system::is_active_tool(segments)
                {
                    let condition = match &segments[..] {
                        [_, _, offset, ..] if offset.name.eq_ignore_ascii_case("V") => {
                            Condition::ToolOffsetTwice
                        }
                        [_, _, radius, ..] if radius.name.eq_ignore_ascii_case("R") => {
                            Condition::ToolRadiusTwice
                        }
                        _ => Condition::ToolTwice,
                    };
                    let radius = Condition::ToolRadiusTwice;
                    let before = block.tool_written.replace((condition, span));
                    if condition == radius && before.is_some_and(|(before, _)| before == radius) {
                        let text = "V.G.WZ_AKT.R is written twice in one block";
                        return Err(Fault::new(Condition::ToolRadiusWrittenTwice, text, span));
                    }
                }
                let outcome = self.assign(assign);
                // a check continues, and words that read the parameter have no error themselves
                if outcome.is_err()
                    && let PlaceKind::Parameter { indirections: 0, subscripts, .. } =
                        &assign.target.kind
                    && subscripts.is_empty()
                    && self.read(&assign.target).is_err()
                {
                    let _ = self.write(&assign.target, Value::Number(0.0), span);
                }
                outcome
            }
            WordKind::MacroDefinition(definition) => {
                let name = definition.name.trim_ascii();
                macro_fits(&self.machine.channel, name, &definition.text, span, &mut self.report)?;
                let before = self.calls.macros.insert(name.into(), definition.text.clone());
                // blocks that contain the earlier text must be parsed again
                self.calls.macros_changed |= before.as_ref() != Some(&definition.text);
                Ok(())
            }
            WordKind::MacroUse(name) => {
                let text = format!("macro \"{name}\" is not defined");
                let known = self.calls.macros.keys().map(|k| &**k);
                let fault = Fault::new(Condition::Undefined, text, span);
                Err(match suggest::hint(name, known) {
                    _ if self.calls.macros.contains_key(name.trim_ascii()) => {
                        fault.hint("it is defined in this block and valid from the next block on")
                    }
                    Some(hint) => fault.hint(hint),
                    None => fault.hint(
                        "define it before its use: \"NAME\" = \"NC code\", or in the channel list (makro_def)",
                    ),
                })
            }
            WordKind::Hash(hash) if hash.name.split(' ').next() == Some("ADD") => {
                block.addition = Some((hash, span));
                Ok(())
            }
            WordKind::Hash(hash) => {
                let keys = ["ANG", "CANG", "FRC", "CHR", "CHF", "RND"];
                if keys.contains(&&*hash.name)
                    && block.hashes.iter().any(|(other, _, _)| other.name == hash.name)
                {
                    let text = format!("#{} twice in one block", hash.name);
                    return Err(Fault::new(Condition::BlockKeyTwice, text, span));
                }
                let value = match &hash.value {
                    Some(expr) => Some(self.number(expr)?),
                    None => None,
                };
                block.hashes.push((hash, value, span));
                Ok(())
            }
            WordKind::Call(call) => {
                if block.call.replace((call, span)).is_some() {
                    let text = "two subroutine calls in one block";
                    return Err(Fault::new(Condition::SeveralCalls, text, span));
                }
                Ok(())
            }
            WordKind::Goto(label) => {
                if block.goto.replace(label).is_some() {
                    let text = "two jumps in one block";
                    return Err(Fault::new(Condition::DuplicateGroup, text, span));
                }
                Ok(())
            }
        }
    }

    fn assign(&mut self, assign: &Assign) -> Outcome<()> {
        if every_axis::is_all(&assign.target) {
            return (0..self.machine.axes.len())
                .try_for_each(|axis| self.assign_one(&every_axis::of_axis(assign, axis)));
        }
        self.assign_one(assign)
    }

    fn assign_one(&mut self, assign: &Assign) -> Outcome<()> {
        let Assign { target, operator, value } = assign;
        let span = value.span;
        let result = match operator {
            None => self.value(value)?,
            Some(BinaryOp::Divide) if self.number(value)? == 0.0 => {
                let text = "division by zero with /=";
                return Err(Fault::new(Condition::DividedByZero, text, span));
            }
            Some(op) => {
                let left = Expr { kind: target.clone().into(), span: target.span };
                let both = Binary { op: *op, left, right: value.clone() };
                let whole = Expr { kind: ExprKind::Binary(Box::new(both)), span };
                self.value(&whole)?
            }
        };
        self.write(target, result, span)
    }
}

/// A function may appear only once in a block.
fn once(written: &[Code], code: &Code, letter: &str, condition: Condition) -> Outcome<()> {
    if !written.iter().any(|other| other.number == code.number) {
        return Ok(());
    }
    let text = format!("{letter}{} twice in one block", code.number);
    Err(Fault::new(condition, text, code.span)
        .with(|d| d.value(ValueKind::Current, code.number, "-")))
}

/// Checks the length of the name and the text of a macro (P-CHAN-00511, 00512).
///
/// Assumption: the pages print an ID for the name only; a text beyond its limit is used, with the warning K-RANGE.
fn macro_fits(
    channel: &Channel,
    name: &str,
    text: &str,
    span: Span,
    report: &mut Report,
) -> Outcome<()> {
    for (what, written, most, condition, parameter) in [
        ("name", name, channel.macro_name_length, Condition::MacroNameLength, "P-CHAN-00511"),
        ("text", text, channel.macro_text_length, Condition::Range, "P-CHAN-00512"),
    ] {
        let length = written.chars().count();
        if length > most as usize {
            let text = format!("the {what} of the macro has {length} characters, maximum: {most}");
            let fault = Fault::new(condition, text, span)
                .with(|d| d.value(ValueKind::UpperLimit, most, "-").parameter(parameter));
            if condition != Condition::Range {
                return Err(fault);
            }
            report.note(fault.warning());
        }
    }
    Ok(())
}
