//! The command line from outside, one module per subject: a single test target, linked once.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test that fails here has failed")]

mod answers;
mod book;
mod commands;
mod kit;
mod machine_readable;
mod outputs;
mod outside;
mod process;
mod project;
