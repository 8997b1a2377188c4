//! Messages about the program, collected block by block.

use super::fault::{Fault, Outcome};
use super::step::SourceRef;
use crate::diag::{Diagnostic, Location};
use std::collections::BTreeSet;

/// Messages about the program, each with its block.
#[derive(Debug, Default)]
pub(super) struct Report {
    /// Position of the current block.
    pub(super) source: SourceRef,
    /// Its first line, for conditions that name an earlier place.
    pub(super) location: Option<Location>,
    /// Conditions of the current block.
    faults: Vec<Fault>,
    /// Conditions without a place in a block.
    pub(super) unplaced: Vec<Diagnostic>,
    /// Keys of the conditions that are reported only once per program.
    said: BTreeSet<String>,
}

/// Key of the report that a block has no feed; an F word allows the next one.
pub(super) const NO_FEED: &str = "no feed";

impl Report {
    /// Adds a condition of the current block.
    pub(super) fn note(&mut self, fault: Box<Fault>) {
        self.faults.push(*fault);
    }

    /// Adds a condition unless one with this key was added before in this program.
    pub(super) fn note_once(&mut self, key: &str, fault: Box<Fault>) {
        if self.said.insert(key.to_owned()) {
            self.faults.push(*fault);
        }
    }

    /// Adds several conditions of the current block.
    pub(super) fn extend(&mut self, faults: Vec<Fault>) {
        self.faults.extend(faults);
    }

    /// Allows a condition with this key to be reported again.
    pub(super) fn unsay(&mut self, key: &str) {
        self.said.remove(key);
    }

    /// Takes the conditions of the current block.
    pub(super) fn take_faults(&mut self) -> Vec<Fault> {
        std::mem::take(&mut self.faults)
    }

    /// Extends the condition added last.
    pub(super) fn amend(&mut self, f: impl FnOnce(Diagnostic) -> Diagnostic) {
        if let Some(fault) = self.faults.pop() {
            let diagnostic = f(fault.diagnostic);
            self.faults.push(Fault { diagnostic, ..fault });
        }
    }

    /// Whether the current block has conditions.
    pub(super) fn has_faults(&self) -> bool {
        !self.faults.is_empty()
    }

    /// Whether the current block has an error.
    pub(super) fn failed(&self) -> bool {
        self.faults.iter().any(Fault::is_error)
    }

    /// The value of an outcome; a fault becomes a condition of the block.
    pub(super) fn keep<T>(&mut self, outcome: Outcome<T>) -> Option<T> {
        match outcome {
            Ok(value) => Some(value),
            Err(fault) => {
                self.faults.push(*fault);
                None
            }
        }
    }
}
