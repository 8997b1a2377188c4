//! The messages of one run: each only once, and a limited number.

use crate::diag::{Diagnostic, Id};
use crate::exec::block::dialect;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Number of errors after which a check stops. Source: P-CHAN-00019 is the vendor's counterpart.
pub(super) const ERRORS_MAX: usize = 20;
/// Blocks that a check executes after the first error: a faulty program may also be an endless one.
pub(super) const BLOCKS_BEHIND_ERROR: u64 = 1_000_000;

/// Number of repeated errors after which a check stops: errors that a loop repeats without end contain nothing new, and
/// the search for the intended word takes the same time at every repetition.
const REPEATED_MAX: u64 = 10_000;

/// Maximum number of diagnostics of one run; beyond it only errors are reported.
const DIAGNOSTICS_MAX: usize = 1000;

/// Diagnostics found by a run.
#[derive(Debug, Default)]
pub(in crate::exec::program) struct Found {
    diagnostics: Vec<Diagnostic>,
    known: BTreeSet<(Id, Arc<str>, u32, u64)>,
    errors: usize,
    /// Number of repeated errors.
    repeated: u64,
    /// Number of blocks executed up to the first error.
    first_error: Option<u64>,
}

impl Found {
    /// Whether a diagnostic is new: one per position; words of other dialects once per program.
    pub(super) fn is_new(&mut self, diagnostic: &Diagnostic) -> bool {
        let key = match &diagnostic.source {
            Some(l) if !dialect::is_foreign_word(diagnostic.id) => {
                (diagnostic.id, Arc::clone(&l.file), l.column, l.offset)
            }
            _ => (diagnostic.id, Arc::from(diagnostic.text.as_str()), 0, 0),
        };
        // a program with a remark in every line must not exhaust memory
        let is_new = if self.has_room() {
            self.known.insert(key)
        } else {
            !self.known.contains(&key) && diagnostic.is_error()
        };
        self.repeated += u64::from(!is_new && diagnostic.is_error());
        is_new
    }

    /// Whether warnings and notes are still reported.
    pub(super) fn has_room(&self) -> bool {
        self.known.len() < DIAGNOSTICS_MAX
    }

    /// Adds a diagnostic found after this number of blocks.
    pub(super) fn add(&mut self, diagnostic: Diagnostic, blocks: u64) {
        if diagnostic.is_error() {
            self.errors += 1;
            self.first_error.get_or_insert(blocks);
        }
        self.diagnostics.push(diagnostic);
    }

    /// Whether anything has been reported since the last call of [`Self::take`].
    pub(super) fn any(&self) -> bool {
        !self.diagnostics.is_empty()
    }

    /// Diagnostics since the last call.
    pub(super) fn take(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.diagnostics)
    }

    /// Errors so far.
    pub(in crate::exec::program) fn errors(&self) -> usize {
        self.errors
    }

    /// The reason for which a check stops after this number of blocks, if there is one.
    pub(super) fn is_enough(&self, blocks: u64) -> Option<String> {
        let behind = blocks - self.first_error.unwrap_or(blocks);
        if self.errors >= ERRORS_MAX {
            Some(format!("{} errors: the check stops here", self.errors))
        } else if self.repeated >= REPEATED_MAX {
            Some(format!("errors repeated {REPEATED_MAX} times: the check stops here"))
        } else if behind > BLOCKS_BEHIND_ERROR {
            Some(format!(
                "more than {BLOCKS_BEHIND_ERROR} blocks after the first error: the check stops here"
            ))
        } else {
            None
        }
    }
}
