//! The `kontur` command line: arguments, files, terminal and pictures.

use std::ffi::OsString;
use std::process::ExitCode;

/// Runs one command; exit codes 0 finished, 1 refused or aborted, 2 wrong usage or lists, 3 input or output failed.
pub fn main_with(args: impl IntoIterator<Item = OsString>) -> ExitCode {
    let _ = args;
    ExitCode::from(2)
}
