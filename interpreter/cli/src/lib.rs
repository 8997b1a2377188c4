//! The `kontur` command line: arguments, files, terminal and pictures.
//!
//! One file per subcommand. Each subcommand is a function of its arguments and a [`console::Console`] (its output), so
//! that tests can call it without a process or a terminal. The computation is done by a
//! [`Job`](kontur_interpreter::job::Job) of the library, which [`request`] makes from files and options.
//!
//! Order of calls: [`main_with`] is the whole program; [`run_with`] does the same on a console of the caller. Both
//! parse [`args`] and call the function of the subcommand.
//!
//! ```
//! use kontur::console::Console;
//! use kontur::{Exit, run_with};
//!
//! let mut console = Console::new(std::io::sink(), std::io::sink());
//! let words = ["kontur", "check", "../../programs/square_corner.nc"].map(Into::into);
//! assert_eq!(run_with(words, &mut console), Exit::Finished);
//! assert_eq!(run_with(["kontur", "measure"].map(Into::into), &mut console), Exit::Usage);
//! ```

pub mod args;
pub mod chart;
mod check;
mod clock;
mod combinations;
pub mod console;
mod diff;
mod error;
pub mod explain;
mod files;
mod interrupt;
mod lists;
mod project;
mod recorded;
mod report;
pub mod request;
pub mod response;
mod run;
mod spectrum;
pub mod sweep;
pub mod table;
mod target;
mod times;
mod trace;
pub mod tune;
pub mod words;
mod workflow;

use clap::Parser as _;
use console::Console;
pub use error::{Error, Exit};
use std::ffi::OsString;
use std::process::ExitCode;

/// Runs one command on the stdout and stderr of the process.
pub fn main_with(args: impl IntoIterator<Item = OsString>) -> ExitCode {
    interrupt::listen();
    let mut console = Console::of_process();
    ExitCode::from(run_with(args, &mut console) as u8)
}

/// Runs one command on the given console.
pub fn run_with(args: impl IntoIterator<Item = OsString>, console: &mut Console) -> Exit {
    let args = match args::Args::try_parse_from(args) {
        Ok(args) => args,
        Err(e) if e.use_stderr() => {
            console.error_text(&e.to_string());
            return Exit::Usage;
        }
        Err(help) => {
            let printed = console.print(&help.to_string()).map(|()| Exit::Finished);
            return console.finish(printed);
        }
    };
    console.speak(args.command.message_form());
    let done = match &args.command {
        args::Command::Run(a) => run::run(a, console),
        args::Command::Check(a) => check::check(a, console),
        args::Command::Diff(a) => diff::diff(a, console),
        args::Command::Report(a) => report::report(a, console),
        args::Command::Response(a) => response::response(a, console),
        args::Command::Sweep(a) => sweep::sweep(a, console),
        args::Command::Tune(a) => tune::tune(a, console),
        args::Command::Explain(a) => explain::explain(a, console),
    };
    console.finish(done)
}
