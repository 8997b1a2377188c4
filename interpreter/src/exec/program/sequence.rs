//! Block sequences: `L SEQUENCE [NAME=.. N10 N50]` runs the blocks from one number to another as a subroutine.
//!
//! `REPEAT=n` runs them n times. With `ENDTAG` the call itself ends the sequence, if it comes after its first block.
//!
//! Assumptions: if several blocks in the program have the same number, the first one counts; computed numbers do not
//! count. A single number without ENDTAG is a sequence of one block. REPEAT is the total number of passes, because the
//! manual requires a value greater than 1.
//!
//! Source: TF5200 programming manual, calling block sequences; 21696.

use super::calls::too_deep;
use super::executor::Executor;
use super::files::Files;
use super::index::LabelPlace;
use super::state::{Sequences, Target};
use crate::diag::Condition;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::report::{Report, Subject};
use crate::exec::values::number::whole;
use crate::syntax::ast::{Group, Ident, Item, ItemKind, ItemValue, LabelKind, Span};

/// Contents of the bracket.
#[derive(Default)]
struct Words {
    name: Option<Ident>,
    numbers: Vec<(u64, Span)>,
    /// Number of passes, at least 1.
    repeat: Option<u32>,
    /// Whether the call ends the sequence, too.
    end_tag: Option<Span>,
}

impl Executor {
    /// `L SEQUENCE [..]`.
    pub(super) fn call_sequence(&mut self, group: &Group) {
        let outcome = self.sequence(group);
        self.decoder.report.keep(outcome);
    }

    fn sequence(&mut self, group: &Group) -> Outcome<()> {
        let words = self.sequence_words(group)?;
        if !self.levels.has_room() {
            let text = too_deep();
            return Err(Fault::new(Condition::SubroutineNesting, text, group.span));
        }
        let Some(Target { file, section }) = (match &words.name {
            Some(name) => self.global(name),
            None => self.levels.last().map(|l| Target { file: l.file, section: l.section }),
        }) else {
            return Ok(());
        };
        let (Some((first, at)), Some((last, to))) =
            (words.numbers.first().copied(), words.numbers.last().copied())
        else {
            let text = "L SEQUENCE needs the number of its first block";
            return Err(Fault::new(Condition::TokenUnknown, text, group.span));
        };
        self.sequences.learn(&mut self.files, (file, section), group.span)?;
        let mut place = |number: u64, span: Span| {
            let report = &mut self.decoder.report;
            self.sequences.find((file, section), number, span, report).ok_or_else(|| {
                let text = format!("the program has no block N{number}");
                Fault::new(Condition::Label, text, span)
            })
        };
        let (start, end) = (place(first, at)?.position, place(last, to)?.position);
        let behind = self.files.behind(file, end);
        if end.offset < start.offset {
            let text = format!("the block N{last} comes before N{first}");
            return Err(Fault::new(Condition::Label, text, to));
        }
        let call = self.position.offset;
        let here = self.levels.last().is_some_and(|l| (l.file, l.section) == (file, section));
        let one_number = words.numbers.len() == 1;
        let end = match words.end_tag {
            Some(_) if here && start.offset < call && (one_number || call < behind.offset) => call,
            Some(tag) if one_number => {
                let text = "ENDTAG: the call is not after the first block of the sequence";
                return Err(Fault::new(Condition::Label, text, tag));
            }
            _ => behind.offset,
        };
        self.push_level(Target { file, section }, None);
        if let Some(level) = self.levels.current_mut() {
            level.restrict(start, end, words.repeat.unwrap_or(1));
        }
        Ok(())
    }

    fn sequence_words(&mut self, group: &Group) -> Outcome<Words> {
        let mut words = Words::default();
        for item in &group.items {
            let Some(number) = self.sequence_word(item, &mut words)? else { continue };
            let number = whole(number, 0, u32::MAX).ok_or_else(|| unexpected(item.span))?;
            words.numbers.push((u64::from(number), item.span));
            if words.numbers.len() > 2 {
                let text = "more than two block numbers";
                return Err(Fault::new(Condition::SequenceTwice, text, item.span));
            }
        }
        Ok(words)
    }

    /// Reads one entry of the bracket; returns the value of a block number.
    fn sequence_word(&mut self, item: &Item, words: &mut Words) -> Outcome<Option<f64>> {
        match &item.kind {
            ItemKind::Missing => {}
            ItemKind::Pair { key, value: ItemValue::Expr(expr) } if key.is("REPEAT") => {
                let passes = self.decoder.whole(expr, "REPEAT", 1, u32::MAX)?;
                if words.repeat.replace(passes).is_some() {
                    let text = "REPEAT twice";
                    return Err(Fault::new(Condition::SequenceTwice, text, item.span));
                }
            }
            ItemKind::Flag(word) if word.is("ENDTAG") => {
                if words.end_tag.replace(item.span).is_some() {
                    let text = "ENDTAG twice";
                    return Err(Fault::new(Condition::SequenceTwice, text, item.span));
                }
            }
            ItemKind::Pair { key, value } if key.is("NAME") => {
                let name = match value {
                    ItemValue::Name(name) => name.clone(),
                    ItemValue::Expr(expr) => match self.decoder.value(expr)? {
                        Value::Text(text) => Ident { text, span: expr.span },
                        Value::Number(_) => return Err(unexpected(expr.span)),
                    },
                    ItemValue::List(list) => return Err(unexpected(list.span)),
                };
                if words.name.replace(name).is_some() {
                    let text = "NAME twice";
                    return Err(Fault::new(Condition::SequenceTwice, text, item.span));
                }
            }
            ItemKind::Flag(word) => match word.split_number() {
                Some((name, number)) if name.eq_ignore_ascii_case("N") => {
                    return Ok(Some(number));
                }
                Some((name, number)) if name.eq_ignore_ascii_case("REPEAT") => {
                    let passes = whole(number, 1, u32::MAX).ok_or_else(|| unexpected(item.span))?;
                    words.repeat = Some(passes);
                }
                _ => return Err(unexpected(item.span)),
            },
            ItemKind::Pair { key, value: ItemValue::Expr(expr) } if key.is("N") => {
                return self.decoder.number(expr).map(Some);
            }
            _ => return Err(unexpected(item.span)),
        }
        Ok(None)
    }
}

fn unexpected(span: Span) -> Box<Fault> {
    let text = "L SEQUENCE: NAME=.., N.., N.., REPEAT=.. and ENDTAG are expected";
    Fault::new(Condition::TokenUnknown, text, span)
}

impl Sequences {
    /// Determines the block numbers of a program once.
    ///
    /// # Errors
    /// The file cannot be read, or has too many numbers in no order.
    pub(super) fn learn(
        &mut self,
        files: &mut Files,
        (file, section): (usize, usize),
        span: Span,
    ) -> Outcome<()> {
        if self.known.contains_key(&(file, section)) {
            return Ok(());
        }
        let name = std::sync::Arc::clone(&files.file(file).name);
        let numbers = files
            .numbers(file, section)
            .map_err(|error| Fault::new(Condition::NoFile, format!("{name}: {error}"), span))?;
        let numbers = numbers.ok_or_else(|| {
            let text = format!("{name}: too many unordered block numbers to search for one");
            Fault::new(Condition::Nesting, text, span)
                .hint("number the blocks of the program in ascending order")
        })?;
        self.known.insert((file, section), numbers);
        Ok(())
    }

    /// The first block with a number, after the numbers of its program have been determined. If several blocks have it,
    /// a note names them.
    ///
    /// Source: TF5200 programming manual 205952267 (the numbers have to be unambiguous).
    pub(super) fn find(
        &self,
        (file, section): (usize, usize),
        number: u64,
        span: Span,
        report: &mut Report,
    ) -> Option<LabelPlace> {
        let numbers = self.known.get(&(file, section))?;
        let place = numbers.first.get(section, &LabelKind::Number(number))?;
        if let Some(second) = numbers.twice.get(&number) {
            let line = place.position.line;
            let text = format!(
                "N{number} is the number of lines {line} and {second}: line {line} is used"
            );
            let fault = Fault::new(Condition::Odd, text, span).warning();
            let hint = "use each block number only once";
            report.note_once(Subject::Block(number), fault.hint(hint));
        }
        Some(place)
    }
}
