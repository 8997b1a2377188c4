//! The row of a G function, a word or a statement in the tables of [`super::commands`] and [`super::language`].

/// One command.
pub(super) struct Command {
    /// Names by which it is found; the first one is printed.
    pub(super) names: &'static [&'static str],
    pub(super) syntax: &'static str,
    pub(super) meaning: &'static str,
    /// Keys with range and default.
    pub(super) keys: &'static str,
    pub(super) note: &'static str,
    pub(super) example: &'static str,
    pub(super) related: &'static [&'static str],
}

/// Defines a row in the form of a table line.
pub(super) const fn row(
    names: &'static [&'static str],
    syntax: &'static str,
    meaning: &'static str,
    keys: &'static str,
    note: &'static str,
    example: &'static str,
    related: &'static [&'static str],
) -> Command {
    Command { names, syntax, meaning, keys, note, example, related }
}
