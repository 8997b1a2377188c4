//! Messages about the program, collected block by block.

use super::fault::{Fault, Outcome};
use super::step::SourceRef;
use crate::diag::{Condition, Diagnostic, Id, Location};
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
    /// The conditions that are reported only once per program and subject.
    said: BTreeSet<(Id, Subject)>,
}

/// What a condition that is reported once is about: the same condition about something else is reported again.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Subject {
    /// The condition has only one.
    Only,
    /// A word, key, command or variable as programs and lists write it.
    Word(Box<str>),
    /// A G function.
    G(u32),
    /// An M function.
    M(u32),
    /// The integer variable that a number is rounded for.
    Rounded(Box<str>),
    /// The cycle parameter that reading has created.
    Created(Box<str>),
    /// The blocks with this number.
    Block(u64),
    /// The `$SWITCH` at this offset of its program.
    Switch(u64),
    /// The number of blocks read ahead.
    BlocksAhead,
    /// Gantry couplings.
    Gantry,
    /// A machine without spindles.
    Spindle,
}

impl From<&str> for Subject {
    fn from(word: &str) -> Self {
        Self::Word(word.into())
    }
}

impl Report {
    /// Adds a condition of the current block.
    pub(super) fn note(&mut self, fault: Box<Fault>) {
        self.faults.push(*fault);
    }

    /// Adds a condition unless it was added before in this program about the same subject.
    pub(super) fn note_once(&mut self, subject: impl Into<Subject>, fault: Box<Fault>) {
        if self.said.insert((fault.diagnostic.id, subject.into())) {
            self.faults.push(*fault);
        }
    }

    /// Adds several conditions of the current block.
    #[inline]
    pub(super) fn extend(&mut self, faults: Vec<Fault>) {
        // most blocks have none
        if !faults.is_empty() {
            self.faults.extend(faults);
        }
    }

    /// Allows a condition to be reported again about this subject.
    pub(super) fn unsay(&mut self, condition: Condition, subject: Subject) {
        self.said.remove(&(condition.id(), subject));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::syntax::ast::Span;

    #[test]
    fn a_condition_is_reported_once_about_each_subject() {
        let mut report = Report::default();
        let mut said = |condition: Condition, subject: Subject| {
            report.note_once(subject, Fault::new(condition, "", Span::default()));
            report.take_faults().len()
        };
        assert_eq!(said(Condition::Ignored, Subject::G(13)), 1);
        assert_eq!(said(Condition::Ignored, Subject::G(13)), 0);
        // the same subject with another condition, and the other way round
        assert_eq!(said(Condition::Fallback, Subject::G(13)), 1);
        assert_eq!(said(Condition::Ignored, Subject::M(13)), 1);
        report.unsay(Condition::Ignored, Subject::G(13));
        let again = Fault::new(Condition::Ignored, "", Span::default());
        report.note_once(Subject::G(13), again);
        assert_eq!(report.take_faults().len(), 1);
    }
}
