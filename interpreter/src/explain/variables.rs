//! System variables, from their table in the interpreter.

use super::explanation::{Explanation, Kind};
use crate::exec::{meaning_of, meanings};

/// All of them in the order of the table.
pub(super) fn all() -> impl Iterator<Item = Explanation> {
    meanings().map(explained)
}

/// The variable in a text, with any axis, spindle or index.
pub(super) fn find(thing: &str) -> Option<Explanation> {
    meaning_of(thing).map(explained)
}

fn explained((title, meaning): (String, &'static str)) -> Explanation {
    Explanation {
        kind: Kind::Variable,
        title,
        meaning: format!("system variable: {meaning}"),
        facts: Vec::new(),
        notes: Vec::new(),
        example: None,
        related: Vec::new(),
    }
}
