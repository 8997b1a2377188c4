//! The messages of one run: each once, and not more than can be read.

use crate::diag::{Diagnostic, Id};
use crate::exec::block::dialect;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Errors after which a check stops. Source: P-CHAN-00019 is the vendor's counterpart.
pub(super) const ERRORS_MAX: usize = 20;
/// Blocks that a check executes after the first error: a wrong program may also be an endless one.
pub(super) const BLOCKS_BEHIND_ERROR: u64 = 1_000_000;

/// Errors in places that have had one after which a check stops: one that a loop repeats without end says nothing new, and
/// looking for what may have been meant takes as long each time.
const REPEATED_MAX: u64 = 10_000;

/// Diagnostics of one run; further ones are reported only if they are errors.
const DIAGNOSTICS_MAX: usize = 1000;

/// Diagnostics that a run has found.
#[derive(Debug, Default)]
pub(in crate::exec::program) struct Found {
    diagnostics: Vec<Diagnostic>,
    known: BTreeSet<(Id, Arc<str>, u32, u64)>,
    errors: usize,
    /// Errors that were not new.
    repeated: u64,
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
        let is_new = if self.known.len() >= DIAGNOSTICS_MAX {
            !self.known.contains(&key) && diagnostic.is_error()
        } else {
            self.known.insert(key)
        };
        self.repeated += u64::from(!is_new && diagnostic.is_error());
        is_new
    }

    /// Adds a diagnostic, met after so many blocks.
    pub(super) fn add(&mut self, diagnostic: Diagnostic, blocks: u64) {
        if diagnostic.is_error() {
            self.errors += 1;
            self.first_error.get_or_insert(blocks);
        }
        self.diagnostics.push(diagnostic);
    }

    /// Something has been reported since the last call of [`Self::take`].
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

    /// Why a check stops after so many blocks, if it does.
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
