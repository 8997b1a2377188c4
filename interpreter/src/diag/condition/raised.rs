//! Conditions that kontur raises, one row each; the rows are in the files below, by their numbers.

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

/// Makes the conditions out of their rows. A row reads
///
/// ```text
/// Condition = Vendor 20008: SEVERITY REACTION REMEDY ROOT, "meaning", cause "..", hint "..", parameter "..";
/// Condition = Kontur 9 "K-RANGE": ...
/// ```
macro_rules! conditions {
    ([] $(
        $condition:ident = $space:ident $number:literal $($name:literal)?:
        $severity:ident $reaction:ident $remedy:literal $root:literal,
        $meaning:literal $(, cause $cause:literal)? $(, hint $hint:literal)? $(, parameter $parameter:literal)?;
    )*) => {
        /// A condition that is raised; its row says everything that is always true of it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Condition {
            $(
                // a block of text, since meanings hold brackets that would be links
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
            },)*
        ];
    };
}

impl Condition {
    /// Everything that is always true of it.
    pub const fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }
}

/// The text of a column that may be left out.
const fn first<const N: usize>(texts: [&'static str; N]) -> &'static str {
    if N == 0 { "" } else { texts[0] }
}

/// The same for columns whose absence means something.
const fn optional<const N: usize>(texts: [&'static str; N]) -> Option<&'static str> {
    if N == 0 { None } else { Some(texts[0]) }
}

words! { [commands motion lists own conditions] }
