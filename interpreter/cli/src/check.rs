//! `kontur check`: every diagnostic of every program, nothing moves.

use crate::args::CheckArgs;
use crate::console::Console;
use crate::engine::{Engine, OpenError};
use crate::run::announce;
use crate::{Error, Exit};

/// Checks the programs; the worst of them decides the exit code.
///
/// # Errors
/// [`Error`] if options, lists or files are wrong.
pub fn check(
    args: &CheckArgs,
    engine: &mut dyn Engine,
    console: &mut Console,
) -> Result<Exit, Error> {
    let mut exit = Exit::Finished;
    for program in &args.programs {
        let form = args.simulation.diagnostics;
        let mut failed = false;
        let mut report = |d: kontur_interpreter::diag::Diagnostic| {
            failed |= d.is_error();
            announce(&d, form, console);
        };
        let done = engine.check(&args.simulation.request(program), &mut report);
        match done {
            Ok(()) if failed && exit == Exit::Finished => exit = Exit::Aborted,
            Ok(()) => {}
            // one file that cannot be read says nothing about the others
            Err(e @ OpenError::Io(..)) => {
                console.error_text(&format!("error: {}", Error::from(e)));
                exit = Exit::Io;
            }
            Err(e) => return Err(crate::run::announce_lists(e, form, console)),
        }
    }
    Ok(exit)
}
