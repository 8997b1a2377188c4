//! Messages of a run, until they are taken.

use crate::diag::{Condition, Diagnostic, Severity};

/// Largest number of messages of the program that are kept until they are taken: a loop without motion raises millions
/// at once.
pub(super) const MESSAGES_MAX: usize = 10_000;

/// Messages of a run that have not been taken yet.
#[derive(Debug, Default)]
pub(crate) struct Messages {
    /// Messages of the simulation, in the order they were raised.
    pub(super) own: Vec<Diagnostic>,
    /// Number of messages of the program (`#MSG`) that were dropped.
    pub(super) unshown: u64,
    /// Messages of the executor, in the order they were raised.
    pub(super) program: Vec<Diagnostic>,
}

impl Messages {
    pub(super) const fn is_empty(&self) -> bool {
        self.own.is_empty() && self.program.is_empty() && self.unshown == 0
    }

    /// Adds a message of the simulation.
    pub(crate) fn push(&mut self, message: Diagnostic) {
        if message.id == Condition::Message && self.own.len() >= MESSAGES_MAX {
            self.unshown += 1;
        } else {
            self.own.push(message);
        }
    }

    /// Adds a message, if there is one.
    pub(crate) fn extend(&mut self, message: Option<Diagnostic>) {
        if let Some(message) = message {
            self.push(message);
        }
    }

    /// Adds later messages, if there are any.
    pub(crate) fn absorb(&mut self, later: Option<Self>) {
        let Some(Self { own, unshown, program }) = later else { return };
        for message in own {
            self.push(message);
        }
        self.unshown += unshown;
        self.program.extend(program);
    }

    /// Takes all messages as a list.
    pub(crate) fn take(&mut self) -> Vec<Diagnostic> {
        let Self { mut own, unshown, program } = std::mem::take(self);
        if unshown > 0 {
            let text =
                format!("{unshown} more messages of the program at the same time, not shown");
            own.push(Diagnostic::new(Condition::Message, text).severity(Severity::Note));
        }
        own.extend(program);
        own
    }
}
