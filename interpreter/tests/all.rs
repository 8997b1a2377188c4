//! Tests of this crate from outside, one module per subject, linked into a single target. The tables of `language` and `syntax` belong to
//! the unit tests; `linear` sets a limit of the whole process and is a separate target.

#![expect(clippy::unwrap_used, reason = "a test that fails here has failed")]

mod control_lists;
mod explain;
mod filter_lists;
mod lists;
mod machines;
