//! Turns the parse result of the grammar into the tree of a block.

mod commands;
mod words;

use super::ast::{
    Assign, Block, BlockNumber, Body, Expr, Ident, Jump, JumpKind, Label, LabelKind, Place,
    PlaceKind, ProgramHead, Span, Word, WordKind,
};
use super::grammar::{Grammar, Rule};
use super::problem::{self, Context, Problem};
use super::scan;
use crate::diag::Condition;
use pest::Parser as _;
use pest::iterators::{Pair, Pairs};

/// Maximum number of diagnostics per block; further ones are most likely noise.
pub(super) const PROBLEMS_MAX: usize = 10;

/// Builds the tree of one block.
pub(super) struct Builder<'a> {
    /// Text as written.
    text: &'a str,
    /// Text as masked for the grammar, of the same length.
    masked: &'a str,
    problems: &'a mut Vec<Problem>,
    /// Binary operators so far.
    pub(super) operators: usize,
    /// Place of the last error of the grammar.
    reported: u32,
}

impl<'a> Builder<'a> {
    pub(super) fn new(text: &'a str, masked: &'a str, problems: &'a mut Vec<Problem>) -> Self {
        Self { text, masked, problems, operators: 0, reported: 0 }
    }

    pub(super) fn report(&mut self, problem: Problem) {
        if self.problems.len() < PROBLEMS_MAX {
            self.problems.push(problem);
        }
    }

    /// Reports an error of the grammar.
    pub(super) fn report_error(&mut self, problem: Problem) {
        let rest = self.masked.get(problem.span.start as usize..).unwrap_or_default();
        // after a misplaced command or control statement a second message is of no use
        let last = rest.starts_with(['#', '$']);
        self.reported = if last { u32::MAX } else { problem.span.start };
        let problem = self.remark_for_value(&problem).unwrap_or(problem);
        self.report(problem);
    }

    /// `X(P1*2)`: a remark after an address that lacks its value.
    fn remark_for_value(&self, problem: &Problem) -> Option<Problem> {
        let before = self.masked.get(..problem.span.start as usize)?.trim_ascii_end();
        let address = before.rsplit([' ', '\t']).next()?;
        let is_letter = matches!(address.as_bytes(), [letter] if letter.is_ascii_alphabetic());
        let behind = &self.text[before.len()..];
        let remark = behind.trim_ascii_start().strip_prefix('(')?;
        let content = remark.split(')').next()?;
        let at = self.text.len() - remark.len() - 1;
        is_letter.then(|| {
            Problem::syntax(
                Span::new(at, at + 1),
                format!("a remark in place of the value of {address}"),
            )
            .hint(format!("expressions are written in [ ]: {address}[{content}]"))
        })
    }

    /// Reports a problem instead of all others that the grammar has with the block.
    pub(super) fn report_only(&mut self, problem: Problem) {
        self.problems.clear();
        self.reported = u32::MAX;
        self.problems.push(problem);
    }

    /// Reports a list in place of a number.
    pub(super) fn report_list(&mut self, span: Span) {
        self.report(problem::list_among_values(self.masked, span));
    }

    /// Place of a rule; the grammar's own spans may end in blanks.
    pub(super) fn span(&self, pair: &Pair<'_, Rule>) -> Span {
        let span = pair.as_span();
        let text = &self.masked[span.start()..span.end()];
        Span::new(span.start(), span.start() + text.trim_ascii_end().len())
    }

    /// Text of a rule as written.
    fn written(&self, span: Span) -> &'a str {
        self.text.get(span.start as usize..span.end() as usize).unwrap_or_default()
    }

    /// A block from one of the rules `block`, `var_line`, `inactive`, `tolerant`, `head_only`.
    pub(super) fn block(&mut self, pairs: Pairs<'_, Rule>) -> Block {
        let mut block = Block::default();
        let mut words = Vec::new();
        let mut declarations = Vec::new();
        let mut junk: Vec<(Span, bool)> = Vec::new();
        for pair in pairs.flat_map(Pair::into_inner) {
            let span = self.span(&pair);
            match pair.as_rule() {
                Rule::skip => block.skip = self.skip(&pair),
                Rule::number | Rule::number_label => self.number(pair, &mut block),
                Rule::label_name => block.label = Some(self.label(pair)),
                Rule::program_head => block.body = Self::program_head(pair),
                Rule::command => {
                    let command = self.command(pair);
                    self.check_command(&command, &block);
                    block.body = Body::Command(Box::new(command));
                }
                Rule::control => block.body = self.control(pair, span),
                Rule::declaration => declarations.push(self.declaration(pair)),
                Rule::junk => {
                    let after_word = words.last().is_some_and(|word: &Word| {
                        junk.last().is_some_and(|(last, _)| last.start < word.span.start)
                    });
                    junk.push((span, after_word));
                }
                Rule::lost => words.extend(self.lost(pair, span)),
                Rule::EOI | Rule::comma | Rule::rest => {}
                _ => words.push(self.word(pair, span)),
            }
        }
        // the first piece is the error that the grammar itself has reported
        for (span, after_word) in junk.into_iter().skip(1) {
            if self.problems.len() == PROBLEMS_MAX {
                break;
            }
            if span.start >= self.reported && (after_word || self.begins_word(span)) {
                self.explain_junk(span);
            }
        }
        // it is refused by its name, and no bracket of an axis
        words.retain(|word| {
            !matches!(&word.kind, WordKind::Bracket(bracket)
                if bracket.name == super::ast::Name::new(problem::FORMATTED_TEXT))
        });
        if !words.is_empty() {
            block.body = Body::Words(words);
        }
        if !declarations.is_empty() {
            block.body = Body::Declarations(declarations);
        }
        let start = self.masked.len() - self.masked.trim_ascii_start().len();
        let end = self.masked.trim_ascii_end().len();
        block.span = Span::new(start.min(end), end);
        block
    }

    /// A parameter whose value could not be read gets the value 0, so that the blocks that read it are not reported as
    /// well: this block is faulty, and only a check continues after it.
    fn lost(&mut self, pair: Pair<'_, Rule>, span: Span) -> Option<Word> {
        let target = pair.into_inner().next().map(|place| self.place(place))?;
        let PlaceKind::Parameter { subscripts, .. } = &target.kind else { return None };
        let assign = || Assign { target: target.clone(), operator: None, value: Self::zero() };
        subscripts.is_empty().then(|| Word { kind: WordKind::Assign(Box::new(assign())), span })
    }

    /// Whether a piece of junk that the last error does not cover looks like the beginning of a word.
    fn begins_word(&self, span: Span) -> bool {
        let at = span.start as usize;
        let bytes = self.masked.as_bytes();
        let blank_before = at > 0 && matches!(bytes[at - 1], b' ' | b'\t');
        // the last error already names a longer word at its place
        bytes[at].is_ascii_alphabetic()
            && blank_before
            && (span.start > self.reported || span.len == 1)
    }

    /// The problem of a later piece of a block with several errors.
    fn explain_junk(&mut self, span: Span) {
        let start = span.start as usize;
        if let Err(error) = Grammar::parse(Rule::words_only, &self.masked[start..]) {
            self.report_error(problem::from_error(&error, self.masked, Context::Words, start));
        }
    }

    fn skip(&mut self, pair: &Pair<'_, Rule>) -> Option<u8> {
        let digits = &pair.as_str()[1..];
        if digits.is_empty() {
            return Some(1);
        }
        let level = digits.parse().ok().filter(|level| (1..=10).contains(level));
        if level.is_none() {
            let span = self.span(pair);
            let text = format!("skip level {digits}, expected 1 to 10");
            self.report(Problem::new(Condition::SkipLevelRange, span, text));
        }
        level
    }

    fn number(&mut self, pair: Pair<'_, Rule>, block: &mut Block) {
        let span = self.span(&pair);
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::index => {
                    block.number = Some(BlockNumber::Computed(Box::new(self.index(part))));
                }
                Rule::parameter => {
                    let place = Place { kind: self.place_kind(part), span };
                    let value = Expr { kind: place.into(), span };
                    block.number = Some(BlockNumber::Computed(Box::new(value)));
                }
                rule => {
                    let digits = part.as_str().trim_end_matches(':');
                    let value = digits.parse().unwrap_or_else(|_| {
                        self.report(Problem::syntax(span, "block number with too many digits"));
                        u64::MAX
                    });
                    block.number = Some(BlockNumber::Literal(value));
                    if rule == Rule::label_number {
                        block.label = Some(Label { kind: LabelKind::Number(value), span });
                    }
                }
            }
        }
    }

    /// `label_name`, or the content of `target`.
    fn label(&mut self, pair: Pair<'_, Rule>) -> Label {
        let span = self.span(&pair);
        let kind = if pair.as_rule() == Rule::label_name {
            let text = pair.into_inner().as_str().trim_ascii().to_ascii_uppercase();
            LabelKind::Name(text.into())
        } else {
            let digits = pair.as_str().trim_end_matches(':');
            LabelKind::Number(digits.parse().unwrap_or(u64::MAX))
        };
        Label { kind, span }
    }

    fn target(&mut self, pair: Pair<'_, Rule>) -> Jump {
        let span = self.span(&pair);
        let by_number = pair.as_str().starts_with(['N', 'n']);
        let kind = match pair.into_inner().next() {
            Some(inner) => match inner.as_rule() {
                Rule::index => JumpKind::Number(Box::new(self.index(inner))),
                Rule::place => {
                    let place = self.place(inner);
                    if by_number {
                        let span = place.span;
                        JumpKind::Number(Box::new(Expr { kind: place.into(), span }))
                    } else {
                        JumpKind::Name(Box::new(place))
                    }
                }
                _ => JumpKind::Label(self.label(inner).kind),
            },
            None => JumpKind::Label(LabelKind::Number(0)),
        };
        Jump { kind, span }
    }

    fn program_head(pair: Pair<'_, Rule>) -> Body {
        let mut head = ProgramHead { local: false, name: None, text: "".into() };
        for part in pair.into_inner() {
            if part.as_rule() == Rule::local_mark {
                head.local = true;
                continue;
            }
            let span = part.as_span();
            let text = &*part.as_str().replace(scan::UNCLOSED, "\"");
            head.text = text.trim_ascii().into();
            if let Some(name) = text.split_ascii_whitespace().next() {
                let start = span.start() + text.len() - text.trim_ascii_start().len();
                head.name =
                    Some(Ident { text: name.into(), span: Span::new(start, start + name.len()) });
            }
        }
        Body::ProgramHead(Box::new(head))
    }

    /// `string`: text between the quotes.
    pub(super) fn string(&mut self, pair: &Pair<'_, Rule>) -> Box<str> {
        let written = self.written(self.span(pair));
        let inner = written.get(1..written.len().saturating_sub(1)).unwrap_or_default();
        inner.replace("\\\"", "\"").into()
    }

    fn ident(&self, pair: &Pair<'_, Rule>) -> Ident {
        let span = self.span(pair);
        Ident { text: self.written(span).into(), span }
    }

    fn upper(&self, pair: &Pair<'_, Rule>) -> Ident {
        let ident = self.ident(pair);
        Ident { text: ident.text.to_ascii_uppercase().into(), ..ident }
    }
}

/// The words of a block from this byte on, behind its command.
pub(super) fn words_behind(builder: &mut Builder<'_>, start: usize) -> Vec<Word> {
    let read = [&" ".repeat(start), &builder.masked[start..]].concat();
    let block = Grammar::parse(Rule::tolerant, &read).map(|pairs| builder.block(pairs));
    match block.unwrap_or_default().body {
        Body::Words(words) => words,
        _ => Vec::new(),
    }
}

impl From<Place> for super::ast::ExprKind {
    fn from(place: Place) -> Self {
        Self::Place(Box::new(place))
    }
}
