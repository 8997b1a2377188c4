//! The one table of conditions: what can be said to a user, and what the control does about it.
//!
//! A row of [`raised`] makes a [`Condition`]: its ID, severity, reaction, meaning, cause, hint and parameter stand there and
//! nowhere else, and a condition without a row cannot be raised. IDs that the documents print and nothing here raises
//! are data only ([`documented`]), for `explain` and for who reads a real control's messages.
//!
//! Source: TF5200 diagnosis manual and the function manuals; the texts are kontur's own. Rows are ordered by number;
//! K numbers are appended and never reused.

mod documented;
mod raised;

pub use raised::Condition;

use super::{Id, Severity};

/// What the control does at once.
///
/// Source: TF5200 diagnosis manual, reaction classes; the discriminant is the class as printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Reaction {
    /// Class 1: none, the run continues.
    None = 1,
    /// Class 2: the program is aborted, prepared blocks are still driven.
    ProgramAbort = 2,
    /// Class 3: the job (loading a list) is aborted.
    JobAbort = 3,
    /// Class 4: feed hold for the whole axis group.
    FeedHold = 4,
    /// Class 5: the axis stops abruptly, the others of the group feed hold.
    AbruptStop = 5,
    /// Class 6: all axes stop abruptly.
    AllStop = 6,
    /// Class 7: the axis stops under control, the others feed hold.
    ControlledStop = 7,
    /// Class 8: the axis stops with the position loop opened, the others feed hold.
    OpenLoopStop = 8,
}

impl Reaction {
    /// Class as the manual prints it, 1 to 8.
    pub const fn class(self) -> u8 {
        self as u8
    }

    /// What happens, in words.
    pub const fn text(self) -> &'static str {
        match self {
            Self::None => "none, the run continues",
            Self::ProgramAbort => "the program is aborted, prepared blocks are still driven",
            Self::JobAbort => "the job (loading a list) is aborted",
            Self::FeedHold => "feed hold for the whole axis group",
            Self::AbruptStop => "the faulty axis stops abruptly, the others feed hold",
            Self::AllStop => "all axes stop abruptly",
            Self::ControlledStop => "the faulty axis stops under control, the others feed hold",
            Self::OpenLoopStop => {
                "the faulty axis stops with its position loop opened, the others feed hold"
            }
        }
    }
}

/// What is known about an ID.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The ID.
    pub id: Id,
    /// Short name of kontur's own conditions (`K-CHAR`), empty for vendor numbers.
    pub name: &'static str,
    /// Severity unless a diagnostic says otherwise.
    pub severity: Severity,
    /// What the control does at once.
    pub reaction: Reaction,
    /// Remedy class as the vendor's pages print it.
    pub remedy: u8,
    /// Root type: 1 NC program, 2 parameter lists, 11 position controller, 0 none.
    pub root: u8,
    /// Meaning in a few words.
    pub meaning: &'static str,
    /// Cause or rule broken; empty if the meaning says it.
    pub cause: &'static str,
    /// What to do about it, where the place that raises it knows nothing better.
    pub hint: Option<&'static str>,
    /// Parameter that decides it, where it is always the same one.
    pub parameter: Option<&'static str>,
}

impl Row {
    /// What brings the control back. Source: TF5200 diagnosis manual, interface description.
    pub(crate) const fn remedy_text(&self) -> &'static str {
        match self.remedy {
            1 => "nothing to do, remedied internally",
            2 | 3 => "reset of the channel",
            4..=6 => "complete reset of the channel",
            7 => "restart of the control",
            8 => "restart after power-off",
            _ => "not documented",
        }
    }
}

impl Condition {
    /// The ID.
    pub fn id(self) -> Id {
        self.row().id
    }
}

impl PartialEq<Condition> for Id {
    fn eq(&self, other: &Condition) -> bool {
        *self == other.id()
    }
}

/// What is true of every number that a program raises itself with `#ERROR` (1 to 1000).
const PROGRAMMED: Row = Row {
    id: Id::Vendor(0),
    name: "",
    severity: Severity::Error,
    reaction: Reaction::ProgramAbort,
    remedy: 3,
    root: 1,
    meaning: "",
    cause: "",
    hint: Some("the program raises it itself, with #ERROR"),
    parameter: None,
};

/// The row of an ID; numbers that no row knows are those of `#ERROR`.
pub fn row(id: Id) -> &'static Row {
    rows().find(|row| row.id == id).unwrap_or(&PROGRAMMED)
}

/// Every row: conditions that are raised, then those that are only documented.
pub fn rows() -> impl Iterator<Item = &'static Row> {
    raised::ROWS.iter().chain(documented::ROWS)
}

#[cfg(test)]
mod tests {
    use super::{documented, raised};

    #[test]
    fn ids_are_unique_and_ordered() {
        assert!(raised::ROWS.windows(2).all(|w| w[0].id < w[1].id));
        assert!(documented::ROWS.windows(2).all(|w| w[0].id < w[1].id));
        assert!(documented::ROWS.iter().all(|d| raised::ROWS.iter().all(|r| r.id != d.id)));
    }

    #[test]
    fn kontur_conditions_have_names_and_the_vendors_have_none() {
        for row in super::rows() {
            assert_eq!(
                row.name.starts_with("K-"),
                matches!(row.id, super::Id::Kontur(_)),
                "{}",
                row.id
            );
        }
    }
}
