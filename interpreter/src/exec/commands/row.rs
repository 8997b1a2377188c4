//! What a row of the table of commands says, and the call of a command as its function gets it.

use super::keys::Key;
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::{Command, Ident, Span};

/// What a command does.
pub(super) enum Act {
    /// It does something.
    Run(fn(&mut Decoder, &Call<'_>) -> Outcome<()>),
    /// It changes neither path nor position, speed or spindle; what else there is to say about it.
    Ignored(&'static str),
    /// Switching it off does nothing; on it changes the path and is not simulated.
    OffOnly,
    /// It would change the path and is not simulated.
    Unsupported,
}

/// One row: what a command does and what there is to say about it.
pub(crate) struct Row {
    /// Words of the name without `#`.
    pub(crate) name: &'static str,
    pub(super) act: Act,
    /// How it is written; empty if there is nothing to explain.
    pub(crate) form: &'static str,
    /// What it does, in one sentence.
    pub(crate) meaning: &'static str,
    /// Its keys.
    pub(crate) keys: &'static [Key],
    /// What else to know.
    pub(crate) note: &'static str,
    /// A line for a program.
    pub(crate) example: &'static str,
    /// Things to look up next.
    pub(crate) related: &'static [&'static str],
}

impl Row {
    pub(super) const fn of(name: &'static str, act: Act) -> Self {
        Self { name, act, form: "", meaning: "", keys: &[], note: "", example: "", related: &[] }
    }

    /// A command that does something.
    pub(super) const fn run(
        name: &'static str,
        f: fn(&mut Decoder, &Call<'_>) -> Outcome<()>,
    ) -> Self {
        Self::of(name, Act::Run(f))
    }

    pub(super) const fn form(self, form: &'static str) -> Self {
        Self { form, ..self }
    }

    pub(super) const fn meaning(self, meaning: &'static str) -> Self {
        Self { meaning, ..self }
    }

    pub(super) const fn keys(self, keys: &'static [Key]) -> Self {
        Self { keys, ..self }
    }

    pub(super) const fn note(self, note: &'static str) -> Self {
        Self { note, ..self }
    }

    pub(super) const fn example(self, example: &'static str) -> Self {
        Self { example, ..self }
    }

    pub(super) const fn related(self, related: &'static [&'static str]) -> Self {
        Self { related, ..self }
    }
}

/// A command with the words that are not part of its name.
pub(in crate::exec) struct Call<'c> {
    pub(in crate::exec) command: &'c Command,
    /// Name of the row.
    pub(in crate::exec) name: &'static str,
    /// Words after the name.
    pub(in crate::exec) rest: &'c [Ident],
}

impl Call<'_> {
    /// `#NAME`, for messages.
    pub(in crate::exec) fn title(&self) -> String {
        format!("#{}", self.name)
    }

    pub(in crate::exec) fn span(&self) -> Span {
        self.command.span
    }

    /// 21220 for a word that does not belong here.
    pub(in crate::exec) fn unexpected(&self, word: &Ident) -> Box<Fault> {
        let text = format!("{}: unexpected `{}`", self.title(), word.text);
        Fault::new(Condition::TokenUnknown, text, word.span)
    }

    /// No further words, neither after the name nor after ON and OFF.
    pub(in crate::exec) fn no_more_words(&self) -> Outcome<()> {
        match self.rest.first().or(self.command.tail.first()) {
            Some(word) => Err(self.unexpected(word)),
            None => Ok(()),
        }
    }
}
