//! Conditions that kontur raises, one row each; the rows are in the files below, by number.

#[macro_use]
mod words;
#[macro_use]
mod commands;
#[macro_use]
mod motion;
#[macro_use]
mod lists;
#[macro_use]
mod own;

use super::row::{Reaction, Row};
use crate::diag::id::{
    Id::{Kontur, Vendor},
    Severity::{Error, Note, Warning},
};

/// Makes the conditions from their rows. A row has the form
///
/// ```text
/// Condition = Vendor 20008: SEVERITY REACTION REMEDY ROOT, "meaning", cause "..", hint "..", parameter "..", note "..";
/// Condition = Kontur 9 "K-RANGE": ...
/// ```
macro_rules! conditions {
    ([] $(
        $condition:ident = $space:ident $number:literal $($name:literal)?:
        $severity:ident $reaction:ident $remedy:literal $root:literal,
        $meaning:literal $(, cause $cause:literal)? $(, hint $hint:literal)? $(, parameter $parameter:literal)?
        $(, note $note:literal)?;
    )*) => {
        /// A condition that is raised; its row contains all its constant properties.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Condition {
            $(
                // as a text block, because brackets in a meaning would become links
                #[doc = concat!(stringify!($space), " ", stringify!($number), "\n\n```text\n", $meaning, "\n```")]
                $condition,
            )*
        }

        /// The rows in the order of the conditions.
        pub(super) const ROWS: &[Row] = &[
            $(Row {
                id: $space($number),
                name: first([$($name)?]),
                severity: $severity,
                reaction: Reaction::$reaction,
                remedy: $remedy,
                root: $root,
                meaning: $meaning,
                cause: first([$($cause)?]),
                hint: optional([$($hint)?]),
                parameter: optional([$($parameter)?]),
                note: first([$($note)?]),
            },)*
        ];
    };
}

impl Condition {
    /// Its constant properties.
    pub const fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }
}

/// The text of a column that may be left out; empty if it is.
const fn first<const N: usize>(texts: [&'static str; N]) -> &'static str {
    if N == 0 { "" } else { texts[0] }
}

/// The text of a column that may be left out; `None` if it is.
const fn optional<const N: usize>(texts: [&'static str; N]) -> Option<&'static str> {
    if N == 0 { None } else { Some(texts[0]) }
}

words! { [commands motion lists own conditions] }
