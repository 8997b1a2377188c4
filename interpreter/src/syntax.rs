//! Turns the text of a block into a syntax tree; checks the form, not the meaning.
//!
//! [`Parser`] reads one block at a time: plain blocks go through a byte loop (`plain`). All others are masked (`scan`),
//! parsed in one call of the grammar `nc.pest` and built into the tree of [`ast`] (`build`). Errors become diagnostics
//! that point to the offending text (`problem`); the usable parts of the block are built all the same.
//!
//! The decoder decides which G functions, commands, keys and axes exist. The parser is given only the names of axes and
//! spindles with more than one character: without them `AP10` is A with the value of P10.
//!
//! Order of calls: create a parser with the names of the axes, then call [`Parser::block`] for each block of a
//! [`BlockReader`](crate::source::BlockReader).
//!
//! ```
//! use kontur_interpreter::source::RawBlock;
//! use kontur_interpreter::syntax::Parser;
//!
//! let (file, mut said) = ("part.nc".into(), Vec::new());
//! let parser = Parser::new([]);
//! let block = parser.block(&RawBlock::from_line("N10 G01 X[2*5] F1000"), &file, &mut said);
//! assert!(said.is_empty());
//! assert_eq!(block.to_string(), "N10 G1 X=2 * 5 F=1000");
//! ```

pub mod ast;
mod build;
mod everyday;
mod expr;
mod foreign;
mod grammar;
pub(crate) mod macros;
mod number;
mod plain;
mod print;
mod problem;
pub(crate) mod scan;

pub(crate) use plain::{Plain, PlainFrame, PlainValue, PlainWord};
pub(crate) use scan::NESTING_MAX;

use crate::diag::{Condition, Diagnostic, Severity};
use crate::source::{BLOCK_LENGTH, BLOCK_LENGTH_MAX, RawBlock};
use ast::{Block, BlockNumber, Body, Span};
use build::{Builder, PROBLEMS_MAX, words_behind};
use grammar::{Grammar, Rule};
use pest::Parser as _;
use pest::error::Error;
use pest::iterators::Pairs;
use problem::Problem;
pub(crate) use problem::statement_meant;
use std::sync::Arc;

#[cfg(test)]
mod tests;

/// Binary operators per block. Bounds the depth of the tree together with [`NESTING_MAX`]; above it K-0006.
pub(crate) const OPERATORS_MAX: usize = 500;

/// Parses blocks.
#[derive(Clone, Debug, Default)]
pub struct Parser {
    /// Names of several characters in upper case, longest first.
    names: Vec<Box<str>>,
}

/// The form in which a block is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mode {
    Block,
    Declaration,
    Inactive,
}

impl Parser {
    /// A parser for the names of the channel's axes and spindles; names of one letter need not be passed.
    pub fn new<'a>(names: impl IntoIterator<Item = &'a str>) -> Self {
        let mut names: Vec<Box<str>> = names
            .into_iter()
            .filter(|name| name.len() > 1 && name.is_ascii())
            .map(|name| name.to_ascii_uppercase().into())
            .collect();
        names.sort_by(|a, b| b.len().cmp(&a.len()).then_with(|| a.cmp(b)));
        names.dedup();
        Self { names }
    }

    /// Parses a block of a program.
    ///
    /// `file` is the program name in diagnostics. If there is an error among them, the block is incomplete: the parts
    /// that could not be read are missing.
    ///
    /// Diagnostics: K-0001 (invalid character), K-0002 (syntax), K-0005 (program head), K-0006 (nesting), 20194,
    /// 20207, 20212 to 20245 (control statements), 20301, 20386, 20387, 20450, 20566, 20569, 20593, 20839, 20841, 20904,
    /// 21187, 21220, 22151.
    pub fn block(
        &self,
        raw: &RawBlock<'_>,
        file: &Arc<str>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Block {
        let mut plain = Plain::default();
        if Self::plain(raw, &mut plain) {
            diagnostics.extend(Self::note(raw, &plain, file));
            plain.tree()
        } else {
            self.parse(raw, file, diagnostics, Mode::Block)
        }
    }

    /// Reads a plain block as numbers; false if it requires the grammar. Whether a block is plain does not depend on
    /// the names; a plain block causes no diagnostics other than a [note](Self::note).
    pub(crate) fn plain(raw: &RawBlock<'_>, plain: &mut Plain) -> bool {
        raw.characters <= BLOCK_LENGTH && plain.recognize(raw.text.as_bytes()).is_some()
    }

    /// The note on a plain block with a remark that is not closed.
    pub(crate) fn note(raw: &RawBlock<'_>, plain: &Plain, file: &Arc<str>) -> Option<Diagnostic> {
        let problem = open_remark(plain.frame.open_remark?);
        let mut location = raw.locate(file, problem.span);
        location.block = plain.frame.number;
        Some(problem.diagnostic(location))
    }

    /// Like [`Self::plain`] for a line that may not be a complete block, word by word. A line is not plain here if its
    /// block ends before the line does, if it is continued, or if a remark contains characters other than ASCII. `None`
    /// also if `take` stops the reading; the words passed to it until then are void.
    #[inline]
    pub(crate) fn plain_line(
        line: &[u8],
        take: impl FnMut(PlainWord) -> bool,
    ) -> Option<PlainFrame> {
        let is_text = |b: &u8| matches!(b, b' '..=b'[' | b']'..=b'~' | b'\t');
        let frame = plain::read(line, take)?;
        let fits = line.len() <= BLOCK_LENGTH as usize;
        (fits && (!frame.remarks || line.iter().all(is_text))).then_some(frame)
    }

    /// Parses a line between `#VAR` and `#ENDVAR`: declarations, or the command that ends them.
    ///
    /// Diagnostics: as for [`block`](Self::block).
    pub fn declaration(
        &self,
        raw: &RawBlock<'_>,
        file: &Arc<str>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Block {
        self.parse(raw, file, diagnostics, Mode::Declaration)
    }

    /// Parses a block of a branch that is not taken: number, label and control statement. Other content is ignored and
    /// gives an empty body.
    ///
    /// Diagnostics: as for [`block`](Self::block), for the parts that are read.
    pub fn inactive(
        &self,
        raw: &RawBlock<'_>,
        file: &Arc<str>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Block {
        self.parse(raw, file, diagnostics, Mode::Inactive)
    }

    fn parse(
        &self,
        raw: &RawBlock<'_>,
        file: &Arc<str>,
        diagnostics: &mut Vec<Diagnostic>,
        mode: Mode,
    ) -> Block {
        let mut problems = Vec::new();
        if raw.characters > BLOCK_LENGTH {
            problems.push(too_long(raw));
        }
        let block = if raw.characters > BLOCK_LENGTH_MAX {
            Block::default()
        } else {
            self.tree(raw.text, mode, &mut problems)
        };
        if let Body::Command(command) = &block.body
            && raw.pieces.iter().any(|piece| piece.line != raw.position.line)
            && !command.is("VECTOR LIMIT")
        {
            let text =
                "a # command continued by `\\`: the control promises it for few commands only";
            problems.push(Problem::syntax(command.span, text).severity(Severity::Note));
        }
        if !problems.is_empty() {
            problems.sort_by_key(|p| p.span.start);
            problems.dedup_by_key(|p| (p.condition, p.span));
            problems.truncate(PROBLEMS_MAX);
            let number = match block.number {
                Some(BlockNumber::Literal(n)) => Some(n),
                _ => None,
            };
            diagnostics.extend(problems.into_iter().map(|problem| {
                let mut location = raw.locate(file, problem.span);
                location.block = number;
                problem.diagnostic(location)
            }));
        }
        block
    }

    /// Mask, grammar, tree.
    fn tree(&self, text: &str, mode: Mode, problems: &mut Vec<Problem>) -> Block {
        let masked = scan::mask(text, &self.names);
        if mode != Mode::Inactive {
            problems.extend(characters(text, &masked));
        }
        if let Some(at) = masked.too_deep {
            problems.push(problem::too_deep(text, at));
            return Block::default();
        }
        let rule = match mode {
            Mode::Block => Rule::block,
            Mode::Declaration => Rule::var_line,
            Mode::Inactive => Rule::inactive,
        };
        let mut builder = Builder::new(text, &masked.text, problems);
        let parsed = Grammar::parse(rule, &masked.text);
        // only few blocks that parse need a second check
        let code = match &parsed {
            Ok(_) if memchr::memchr2(b':', b'l', masked.text.as_bytes()).is_none() => String::new(),
            _ => scan::without_texts(&masked.text),
        };
        if parsed.is_err()
            && let Some(problem) = foreign::recognise(&code)
        {
            // the rest of the block is not reported
            builder.report_only(problem);
            return Block::default();
        }
        let context = problem::Context::of(&masked.text);
        let words = mode == Mode::Block && context == problem::Context::Words;
        let typed = match &parsed {
            _ if !words => None,
            Ok(_) => everyday::hidden(&code),
            Err(error) => {
                let brace = masked.invalid.first().copied();
                let brace = brace.filter(|span| text[span.start as usize..].starts_with('{'));
                everyday::recognise(&code, problem::place_of(error), brace)
            }
        };
        if let Some(typed) = typed {
            let rest = typed.rest(&masked.text);
            builder.report_only(typed.problem);
            let rest = Grammar::parse(Rule::tolerant, &rest);
            return rest.map_or_else(|_| Block::default(), |pairs| builder.block(pairs));
        }
        match parsed {
            Ok(pairs) => whole(builder, pairs, &masked.text),
            Err(error) => rest_of(builder, &error, &masked.text, mode),
        }
    }
}

/// A block that parses, with the words behind its command, which are an error.
fn whole(mut builder: Builder<'_>, pairs: Pairs<'_, Rule>, masked: &str) -> Block {
    let mut block = builder.block(pairs);
    if let Body::Command(command) = &mut block.body
        && !command.is_conditional()
        && let Some(word) = command.word_behind()
    {
        let shown = masked.get(word.start as usize..word.end() as usize).unwrap_or_default();
        let text = format!("unexpected `{shown}`, expected the end of the block");
        builder.report_error(Problem::new(Condition::WordsBehindCommand, word, text));
        command.behind = words_behind(&mut builder, word.start as usize);
    }
    block
}

/// Reports the failure of the grammar; the block of what can still be read.
fn rest_of(mut builder: Builder<'_>, error: &Error<Rule>, masked: &str, mode: Mode) -> Block {
    let context = problem::Context::of(masked);
    let mut found = problem::from_error(error, masked, context, 0);
    if mode == Mode::Declaration && found.condition == Condition::Syntax {
        found = problem::of_declaration(found, masked);
    }
    // the text after a function without its bracket is not a word
    let lost = found.condition == Condition::FunctionBracket;
    let jump = found.condition == Condition::GotoTarget;
    let end = jump.then_some(found.span.start as usize);
    let behind = found.condition == Condition::WordsBehindCommand && mode == Mode::Block;
    let start = found.span.start as usize;
    builder.report_error(found);
    if behind && let Ok(pairs) = Grammar::parse(Rule::block, &masked[..start]) {
        let mut block = builder.block(pairs);
        if let Body::Command(command) = &mut block.body {
            command.behind = words_behind(&mut builder, start);
        }
        return block;
    }
    let rule = match (context, mode) {
        (problem::Context::Words, Mode::Block) if !lost => Rule::tolerant,
        _ => Rule::head_only,
    };
    // nor is the text written in place of a label
    let read = &masked[..end.unwrap_or(masked.len())];
    Grammar::parse(rule, read).map_or_else(|_| Block::default(), |pairs| builder.block(pairs))
}
/// Hint of a line between `#VAR` and `#ENDVAR` that does not begin like a declaration.
pub(crate) const END_OF_DECLARATIONS: &str = "check whether #ENDVAR is missing before it";

/// The problems of single characters: invalid ones, and the `(` of a remark that is not closed.
fn characters(text: &str, masked: &scan::Masked) -> Vec<Problem> {
    // lines that begin with `%` are remarks in the programs of some post-processors
    let remark = masked.text.trim_ascii_start().starts_with('%');
    let severity = if remark { Severity::Warning } else { Severity::Error };
    // the end of `{..}` belongs to the mistake at its beginning
    let brace = |s: &Span, brace: char| text[s.start as usize..].starts_with(brace);
    let invalid = masked.invalid.iter().enumerate().filter(|(i, s)| {
        !brace(s, '}') || !masked.invalid[..*i].iter().any(|before| brace(before, '{'))
    });
    let invalid = invalid.map(|(_, s)| problem::invalid(text, *s).severity(severity));
    invalid.chain(masked.open_remark.map(open_remark)).collect()
}

/// The note on the `(` of a remark that is not closed.
fn open_remark(bracket: Span) -> Problem {
    let text = "a remark without `)` extends to the end of the block";
    Problem::new(Condition::Odd, bracket, text).hint("close it with )")
}

/// 20301 for a block that is too long.
fn too_long(raw: &RawBlock<'_>) -> Problem {
    let (severity, limit) = if raw.characters > BLOCK_LENGTH_MAX {
        (Severity::Error, BLOCK_LENGTH_MAX)
    } else {
        (Severity::Warning, BLOCK_LENGTH)
    };
    // the first character beyond the limit; the text is cut after the last one that is decoded
    let at = raw.text.char_indices().nth(limit as usize).map_or(raw.text.len(), |(i, _)| i);
    Problem::new(
        Condition::LineTooLong,
        Span::new(at, at),
        format!("block of {} characters, maximum: {limit}", raw.characters),
    )
    .severity(severity)
}
