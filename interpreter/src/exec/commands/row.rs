//! A row of the table of commands, and the call passed to its function.

use super::keys::Key;
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::{Command, Ident, Span};

/// Effect of a command.
pub(super) enum Act {
    /// It is executed.
    Run(fn(&mut Decoder, &Call<'_>) -> Outcome<()>),
    /// It affects neither path nor position, speed or spindle; with a note.
    Ignored(&'static str),
    /// Switching it off has no effect; on it would change the path, and is not simulated.
    OffOnly,
    /// It would change the path and is not simulated.
    Unsupported,
}

/// One row: the function of a command and its description.
pub(crate) struct Row {
    /// Words of the name without `#`.
    pub(crate) name: &'static str,
    pub(super) act: Act,
    /// Syntax; empty if there is nothing to explain.
    pub(crate) form: &'static str,
    /// Effect, in one sentence.
    pub(crate) meaning: &'static str,
    /// Its keys.
    pub(crate) keys: &'static [Key],
    /// Further notes.
    pub(crate) note: &'static str,
    /// An example for a program.
    pub(crate) example: &'static str,
    /// Related topics.
    pub(crate) related: &'static [&'static str],
    /// Maximum number of brackets after the name; brackets that its function does not read must not be written.
    brackets: usize,
    /// Whether values may follow the name without a bracket.
    values: bool,
}

impl Row {
    pub(super) const fn of(name: &'static str, act: Act) -> Self {
        Self {
            name,
            act,
            form: "",
            meaning: "",
            keys: &[],
            note: "",
            example: "",
            related: &[],
            brackets: 1,
            values: false,
        }
    }

    /// A command that is executed.
    pub(super) const fn run(
        name: &'static str,
        f: fn(&mut Decoder, &Call<'_>) -> Outcome<()>,
    ) -> Self {
        Self::of(name, Act::Run(f))
    }

    /// It accepts no bracket.
    pub(super) const fn bare(self) -> Self {
        Self { brackets: 0, ..self }
    }

    /// It accepts several brackets, or checks their number itself.
    pub(super) const fn several(self) -> Self {
        Self { brackets: usize::MAX, ..self }
    }

    /// It accepts values without a bracket, or checks them itself.
    pub(super) const fn values(self) -> Self {
        Self { values: true, ..self }
    }

    /// 21220 for a bracket or a value that the command would not read.
    pub(super) fn takes(&self, command: &Command) -> Outcome<()> {
        let name = self.name;
        let (text, span) = if let Some(group) = command.groups.get(self.brackets) {
            let text = match self.brackets {
                0 => format!("#{name} does not take a bracket"),
                _ => format!("#{name}: all its keys belong in one bracket"),
            };
            (text, group.span)
        } else if let (Some(value), false) = (command.arguments.first(), self.values) {
            (format!("#{name}: a value without a bracket"), value.span)
        } else {
            return Ok(());
        };
        let fault = Fault::new(Condition::TokenUnknown, text, span);
        Err(if self.form.is_empty() { fault } else { fault.hint(format!("write {}", self.form)) })
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

    /// 21220 for an unexpected word.
    pub(in crate::exec) fn unexpected(&self, word: &Ident) -> Box<Fault> {
        let text = format!("{}: unexpected `{}`", self.title(), word.text);
        Fault::new(Condition::TokenUnknown, text, word.span)
    }

    /// 21220 for a bracket beside a word with which the command reads none.
    pub(in crate::exec) fn no_bracket_beside(&self, word: &str) -> Outcome<()> {
        let Some(group) = self.command.groups.first() else { return Ok(()) };
        let text = format!("{} {word} does not take a bracket", self.title());
        Err(Fault::new(Condition::TokenUnknown, text, group.span))
    }

    /// Checks that there are no further words, neither after the name nor after ON and OFF.
    pub(in crate::exec) fn no_more_words(&self) -> Outcome<()> {
        match self.rest.first().or(self.command.tail.first()) {
            Some(word) => Err(self.unexpected(word)),
            None => Ok(()),
        }
    }
}
