//! One block of DIN words: collects them with their values, left to right.
//!
//! Assignments take effect while the words are collected, so that a value uses the assignments written before it. Everything
//! else takes effect afterwards, in the order of [`super::din`].

mod assignment;
mod g;
mod macros;

use super::collected::{Code, Words};
use super::groups::{self};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::{CodeNumber, Expr, HashWord, Span, Word, WordKind};
use smallvec::SmallVec;

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
            return Err(Fault::new(Condition::Syntax, text, span)
                .hint(format!("write M{number:02} alone, the speed with S")));
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
        if self.machine.channel.language.several_words
            && block.g.iter().any(|g| groups::takes_axes(g.row))
            && let Some(i) = (1..block.axes.len())
                .find(|i| block.axes[..*i].iter().any(|(a, _, _)| *a == block.axes[*i].0))
        {
            let (axis, _, span) = block.axes.remove(i);
            self.report.note(self.names.twice(axis, span));
        }
        if let (Some(_), Some((_, span)), true) =
            (block.tool, block.tool_data, self.machine.channel.offsets.tool_data_with_tool)
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
        may_stand_here(word, block)?;
        match &word.kind {
            WordKind::Address { name, sign, value } => {
                self.address(name, *sign, value, span, block)
            }
            WordKind::G { number, value } => self.g_word(*number, value.as_deref(), span, block),
            WordKind::ComputedG(number) => {
                let number = self.whole(number, "the number of a G function", 0, u32::MAX)?;
                self.g_word(number, None, span, block)
            }
            WordKind::M(number, value) => {
                let code = Code::read(self, number, value.as_deref(), "M", span)?;
                once(&mut block.m, code, "M", Condition::MTwice)
            }
            WordKind::Return(back) => {
                let code = Code { number: back.number, value: None, span };
                once(&mut block.m, code, "M", Condition::MTwice)?;
                block.back = Some((back, span));
                Ok(())
            }
            WordKind::H(number, value) => {
                let code = Code::read(self, number, value.as_deref(), "H", span)?;
                once(&mut block.h, code, "H", Condition::HTwice)
            }
            WordKind::Bracket(bracket) => {
                block.brackets.push(bracket);
                Ok(())
            }
            WordKind::Assign(assign) => self.assignment(assign, span, block),
            WordKind::MacroDefinition(definition) => {
                self.calls.define_macro(definition, &self.machine.channel, &mut self.report, span)
            }
            WordKind::MacroUse(name) => Err(self.calls.undefined_macro(name, span)),
            WordKind::Hash(hash) if hash.name.split(' ').next() == Some("ADD") => {
                block.addition = Some((hash, span));
                Ok(())
            }
            WordKind::Hash(hash) => self.block_key(hash, span, block),
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

    /// A key of the block such as `#ANG` or `#RND`, with its value.
    fn block_key<'b>(
        &mut self,
        hash: &'b HashWord,
        span: Span,
        block: &mut Words<'b>,
    ) -> Outcome<()> {
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
}

/// A function may appear only once in a block.
fn once<A: smallvec::Array<Item = Code>>(
    written: &mut SmallVec<A>,
    code: Code,
    letter: &str,
    condition: Condition,
) -> Outcome<()> {
    if written.iter().any(|other| other.number == code.number) {
        let text = format!("{letter}{} twice in one block", code.number);
        return Err(Fault::new(condition, text, code.span)
            .with(|d| d.value(ValueKind::Current, code.number, "-")));
    }
    written.push(code);
    Ok(())
}

/// Refuses a word after one that must be the last, and an exponent.
fn may_stand_here(word: &Word, block: &Words<'_>) -> Outcome<()> {
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
        WordKind::Address { name, .. }
            if block.assigned_to == Some(span.start) && name.letter() == Some(b'E') =>
        {
            let text = "numbers cannot have an exponent in this dialect";
            Err(Fault::new(Condition::Syntax, text, span)
                .hint("write 1000 for 1e3, 0.00001 for 1e-05"))
        }
        _ => Ok(()),
    }
}
