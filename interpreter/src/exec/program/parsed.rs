//! Blocks of program files as they are executed: plain, or with their tree.

use super::index::{number_of, structure};
use super::reads::Reads;
use crate::diag::{Condition, Diagnostic};
use crate::source::RawBlock;
use crate::syntax::Parser;
use crate::syntax::ast::{Block, Span};
use crate::syntax::macros;
use std::collections::BTreeMap;
use std::ops::Deref;
use std::sync::Arc;

/// Texts of macros by their names.
pub(super) type Macros = BTreeMap<Box<str>, Box<str>>;

/// A parsed block.
#[derive(Debug)]
pub(in crate::exec) struct Parsed {
    pub(in crate::exec::program) block: Block,
    /// What it reads of the machine.
    pub(in crate::exec::program) reads: Reads,
    /// Whether its text has an error.
    pub(in crate::exec::program) faulty: bool,
}

/// A block to be executed.
#[derive(Debug)]
pub(in crate::exec) enum Fetched {
    /// A plain block that runs once, in [`Files::plain`](super::files::Files::plain): its tree is made only if needed.
    Plain,
    Tree(Tree),
}

/// A block with its tree.
#[derive(Debug)]
pub(in crate::exec) enum Tree {
    /// It runs again, so its file keeps it as well.
    Kept(Arc<Parsed>),
    /// Parsed for this run only.
    Once(Parsed),
}

impl Deref for Tree {
    type Target = Parsed;

    fn deref(&self) -> &Parsed {
        match self {
            Self::Kept(parsed) => parsed,
            Self::Once(parsed) => parsed,
        }
    }
}

/// The tree of a block, its macros expanded; `declaration`: between `#VAR` and `#ENDVAR`.
pub(super) fn parse(
    raw: &RawBlock<'_>,
    file: &Arc<str>,
    declaration: bool,
    parser: &Parser,
    table: &Macros,
    diagnostics: &mut Vec<Diagnostic>,
) -> Block {
    let read = |raw: &RawBlock<'_>, diagnostics: &mut Vec<Diagnostic>| {
        if declaration {
            parser.declaration(raw, file, diagnostics)
        } else {
            parser.block(raw, file, diagnostics)
        }
    };
    if table.is_empty() {
        return read(raw, diagnostics);
    }
    let lookup = |name: &str| table.get(name).map(|text| &**text);
    match macros::expand(raw, file, &lookup) {
        Ok(Some(expanded)) => {
            let expanded = expanded.raw();
            diagnostics.extend(structure_of_macro(raw, &expanded, file));
            read(&expanded, diagnostics)
        }
        Ok(None) => read(raw, diagnostics),
        Err(mut diagnostic) => {
            if let Some(location) = &mut diagnostic.source {
                location.block = number_of(raw.text);
            }
            diagnostics.push(*diagnostic);
            Block::default()
        }
    }
}

/// K-MACRO-CONTROL if only the macros of a block give it a place in the structure of its program: the structure is
/// determined before the macros are known.
fn structure_of_macro(
    raw: &RawBlock<'_>,
    expanded: &RawBlock<'_>,
    file: &Arc<str>,
) -> Option<Diagnostic> {
    let (name, at) = structure(expanded.text)?;
    if structure(raw.text).is_some_and(|(written, _)| written == name) {
        return None;
    }
    let mut location = expanded.locate(file, Span::new(at, at + 1));
    location.block = number_of(raw.text);
    let text = format!("`{name}` comes from a macro");
    Some(Diagnostic::new(Condition::MacroControl, text).at(location))
}
