//! Tables of rules, the shapes of real files, and properties over random input.

mod random;
mod tables;
mod whole;

use super::ast::Block;
use super::{Mode, Parser};
use crate::diag::{Diagnostic, Severity};
use crate::source::RawBlock;
use std::sync::Arc;

/// Parses a line with the names `X1` and `AP` configured.
fn parse(line: &str) -> (Block, Vec<Diagnostic>) {
    parse_as(line, Mode::Block)
}

fn parse_as(line: &str, mode: Mode) -> (Block, Vec<Diagnostic>) {
    let parser = Parser::new(["X1", "AP"]);
    let mut diagnostics = Vec::new();
    let raw = RawBlock::from_line(line);
    let file = Arc::from("test.nc");
    let block = match mode {
        Mode::Block => parser.block(&raw, &file, &mut diagnostics),
        Mode::Declaration => parser.declaration(&raw, &file, &mut diagnostics),
        Mode::Inactive => parser.inactive(&raw, &file, &mut diagnostics),
    };
    (block, diagnostics)
}

/// The tree by the grammar, even if the line is plain.
fn by_grammar(line: &str) -> (Block, usize) {
    let mut problems = Vec::new();
    let parser = Parser::new(["X1", "AP", "X1A"]);
    let block = parser.tree(line, Mode::Block, &mut problems);
    (block, problems.len())
}

/// The tree of a line that must be accepted.
fn accepted(line: &str) -> Block {
    let (block, diagnostics) = parse(line);
    let notes = diagnostics.iter().all(|d| d.severity == Severity::Note);
    assert!(notes, "{line}: {diagnostics:#?}");
    block
}

/// IDs and columns of the errors of a line that is refused.
fn refused(line: &str) -> Vec<(String, u32)> {
    let (_, diagnostics) = parse(line);
    diagnostics
        .iter()
        .map(|d| (d.id.to_string(), d.source.as_ref().map_or(0, |place| place.column)))
        .collect()
}

/// A tree without its spans, as text.
fn shape(block: &Block) -> String {
    let debug = format!("{block:?}");
    let mut parts = debug.split("Span {");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        out.push_str(part.split_once('}').map_or(part, |(_, rest)| rest));
    }
    out
}
