//! The `kontur` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    kontur::main_with(std::env::args_os())
}
