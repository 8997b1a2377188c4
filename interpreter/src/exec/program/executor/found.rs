//! The messages of one run: each once, and not more than can be read.

use crate::diag::{Diagnostic, Id};
use crate::exec::block::dialect;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Errors after which a check stops. Source: P-CHAN-00019 is the vendor's counterpart.
pub(super) const ERRORS_MAX: usize = 20;
/// Blocks that a check executes after the first error: a wrong program may also be an endless one.
pub(super) const BLOCKS_BEHIND_ERROR: u64 = 1_000_000;

/// Diagnostics of one run; further ones are reported only if they are errors.
const DIAGNOSTICS_MAX: usize = 1000;

/// Diagnostics that a run has found.
#[derive(Debug, Default)]
pub(in crate::exec::program) struct Found {
    diagnostics: Vec<Diagnostic>,
    known: BTreeSet<(Id, Arc<str>, u32, u64)>,
    errors: usize,
    /// Blocks executed up to the first error.
    first_error: Option<u64>,
}

impl Found {
    /// True if a diagnostic is new: one at each place, words of other dialects once in a program.
    pub(super) fn is_new(&mut self, diagnostic: &Diagnostic) -> bool {
        let key = match &diagnostic.source {
            Some(l) if !dialect::is_foreign_word(diagnostic.id) => {
                (diagnostic.id, Arc::clone(&l.file), l.column, l.offset)
            }
            _ => (diagnostic.id, Arc::from(diagnostic.text.as_str()), 0, 0),
        };
        // a program with a remark in every line must not fill the memory
        if self.known.len() >= DIAGNOSTICS_MAX {
            return !self.known.contains(&key) && diagnostic.is_error();
        }
        self.known.insert(key)
    }

    /// Adds a diagnostic, met after so many blocks.
    pub(super) fn add(&mut self, diagnostic: Diagnostic, blocks: u64) {
        if diagnostic.is_error() {
            self.errors += 1;
            self.first_error.get_or_insert(blocks);
        }
        self.diagnostics.push(diagnostic);
    }

    /// Diagnostics since the last call.
    pub(super) fn take(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.diagnostics)
    }

    /// Errors so far.
    pub(in crate::exec::program) fn errors(&self) -> usize {
        self.errors
    }

    /// Why a check stops after so many blocks, if it does.
    pub(super) fn is_enough(&self, blocks: u64) -> Option<String> {
        let behind = blocks - self.first_error.unwrap_or(blocks);
        if self.errors >= ERRORS_MAX {
            Some(format!("{} errors: the check stops here", self.errors))
        } else if behind > BLOCKS_BEHIND_ERROR {
            Some(format!(
                "more than {BLOCKS_BEHIND_ERROR} blocks after the first error: the check stops here"
            ))
        } else {
            None
        }
    }
}
