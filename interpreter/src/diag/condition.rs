//! The one table of conditions: all messages to a user, and the reaction of the control to each.
//!
//! A row of [`raised`] defines a [`Condition`]: its ID, severity, reaction, meaning, cause, hint and parameter are
//! stated there and nowhere else, and a condition without a row cannot be raised. IDs that the documents print but that
//! are not raised here are data only ([`documented`]), for `explain` and for readers of the messages of a real control.
//!
//! Source: TF5200 diagnosis manual and the function manuals; the texts are kontur's own. Rows are ordered by number;
//! K numbers are appended and never reused.
//!
//! Order of calls: none; code raises a condition by its name, and [`row`] returns its row of the table.
//!
//! ```
//! use kontur_interpreter::diag::condition::{Condition, row, rows};
//!
//! // conditions that are raised have a row, and so have those that are only documented
//! let feed = row(Condition::FeedZero.id());
//! assert!(feed.hint.is_some_and(|hint| hint.contains('F')));
//! assert!(rows().any(|row| row.id == feed.id));
//! ```

mod documented;
mod raised;
mod row;

pub use raised::Condition;
pub use row::{Reaction, Row};

use super::id::{Id, Severity};

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

/// The properties of every number that a program raises itself with `#ERROR` (1 to 1000).
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
    note: "",
};

/// The row of an ID; numbers without a row are those of `#ERROR`.
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

    /// Documented conditions may concern parameters without a row.
    #[test]
    fn raised_conditions_name_parameters_of_the_table() {
        for row in raised::ROWS {
            for id in row.parameter.into_iter().flat_map(|ids| ids.split(", ")) {
                assert!(crate::machine::table::by_id(id).is_some(), "{} names {id}", row.id);
            }
        }
    }
}
