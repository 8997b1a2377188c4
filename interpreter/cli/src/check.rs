//! `kontur check`: every diagnostic of every program, nothing moves.

use crate::args::CheckArgs;
use crate::console::Console;
use crate::request::OpenError;
use crate::run::announce_lists;
use crate::{Error, Exit};
use kontur_interpreter::diag::{Diagnostic, Severity};

/// Checks the programs; the worst of them decides the exit code.
///
/// # Errors
/// [`Error`] if options, lists or files are wrong.
pub fn check(args: &CheckArgs, console: &mut Console) -> Result<Exit, Error> {
    let mut exit = Exit::Finished;
    for program in &args.programs {
        match args.simulation.request(program).check() {
            Ok(checked) => {
                checked.diagnostics.iter().for_each(|d| console.announce(d));
                let failed = checked.diagnostics.iter().any(Diagnostic::is_error);
                if failed && exit == Exit::Finished {
                    exit = Exit::Aborted;
                }
            }
            // one file that cannot be read says nothing about the others
            Err(e @ OpenError::Io(..)) => {
                console.say(Severity::Error, &Error::from(e).to_string());
                exit = Exit::Io;
            }
            Err(e) => return Err(announce_lists(e, console)),
        }
    }
    Ok(exit)
}
