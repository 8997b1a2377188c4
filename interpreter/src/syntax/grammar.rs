//! The grammar, and the words that it shares with the readers beside it.

#![allow(missing_docs, reason = "the generated items are documented in nc.pest")]
#![allow(clippy::pedantic, reason = "generated code")]

/// Parser generated from `nc.pest`.
#[derive(Debug, pest_derive::Parser)]
#[grammar = "nc.pest"]
pub(super) struct Grammar;

/// `#` words permitted among DIN words, besides `#SUPPRESS OFFSETS`.
///
/// Source: TF5200 programming manual (chamfers, #ANG, #CANG, #PSET, #SCALE, #ACHSE) and diagnosis, 20207.
pub(super) const HASH_WORDS: &[&str] = &[
    "FRC", "CHR", "CHF", "RND", "ANG", "CANG", "ACHSE", "AKIMA", "PSET", "PRESET", "SCALE", "ADD",
];
