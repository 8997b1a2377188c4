//! `kontur check`: every diagnostic of every program, without motion.

mod programs;
mod sarif;

use crate::args::{CheckArgs, CheckForm, Deny};
use crate::console::Console;
use crate::error::{Error, Exit};
use crate::request::OpenError;
use crate::run::announce_lists;
use crate::workflow;
use kontur_interpreter::diag::{Diagnostic, Severity};
use serde::Serialize;
use std::collections::HashSet;

/// The findings in all programs.
#[derive(Debug, Default, Serialize)]
struct Findings {
    programs: usize,
    errors: usize,
    warnings: usize,
    /// Programs that could not be read, with the system's reason.
    unreadable: Vec<String>,
    diagnostics: Vec<Diagnostic>,
    /// Diagnostics reported so far, as JSON: one in a subroutine or list that several programs share is reported once.
    #[serde(skip)]
    known: HashSet<String>,
}

impl Findings {
    /// Takes a diagnostic; false if it has been reported before.
    fn take(&mut self, found: &Diagnostic) -> bool {
        // a subroutine that several programs call has its messages once
        let alone = Diagnostic { calls: Vec::new(), ..found.clone() };
        let is_new = self.known.insert(serde_json::to_string(&alone).unwrap_or_default());
        if is_new {
            self.errors += usize::from(found.severity == Severity::Error);
            self.warnings += usize::from(found.severity == Severity::Warning);
        }
        is_new
    }

    fn exit(&self, deny: Option<Deny>) -> Exit {
        let denied = deny == Some(Deny::Warnings) && self.warnings > 0;
        if !self.unreadable.is_empty() {
            Exit::Io
        } else if self.errors > 0 || denied {
            Exit::Aborted
        } else {
            Exit::Finished
        }
    }

    fn counts(&self) -> String {
        let number = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
        format!(
            "{}: {}, {}",
            number(self.programs, "program"),
            number(self.errors, "error"),
            number(self.warnings, "warning")
        )
    }
}

/// Checks the programs; the worst result determines the exit code.
///
/// # Errors
/// [`Error`] if options, lists or files are wrong.
pub(crate) fn check(args: &CheckArgs, console: &mut Console) -> Result<Exit, Error> {
    let programs = programs::find(&args.programs)?;
    let mut all = Vec::with_capacity(programs.len());
    for program in &programs {
        all.push(match args.simulation.request(&program.path).check() {
            Ok(checked) => Ok(checked),
            // other files may be readable all the same
            Err(e @ OpenError::Io(..)) => Err(Error::from(e).to_string()),
            Err(e) => return Err(announce_lists(e, console)),
        });
    }
    let files = all.iter().map(|checked| checked.as_ref().map_or(&[][..], |c| &c.files));
    let subroutines = programs::subroutines(&programs, files);
    let mut findings = Findings::default();
    for (checked, is_subroutine) in all.into_iter().zip(subroutines) {
        let checked = match checked {
            Ok(_) if is_subroutine => continue,
            Ok(checked) => checked,
            Err(reason) => {
                match args.format {
                    CheckForm::Github => {
                        let title = "unreadable";
                        let said = workflow::raise(Severity::Error, None, title, &reason);
                        console.print(&said)?;
                    }
                    _ => console.say(Severity::Error, &reason),
                }
                findings.unreadable.push(reason);
                continue;
            }
        };
        findings.programs += 1;
        for diagnostic in checked.diagnostics {
            if !findings.take(&diagnostic) {
                continue;
            }
            match args.format {
                CheckForm::Text => console.announce(&diagnostic),
                CheckForm::Github => console.print(&workflow::command(&diagnostic))?,
                CheckForm::Json | CheckForm::Sarif => findings.diagnostics.push(diagnostic),
            }
        }
    }
    match args.format {
        CheckForm::Text if programs.len() > 1 => console.print(&findings.counts())?,
        CheckForm::Text | CheckForm::Github => {}
        CheckForm::Json => {
            console.print(&serde_json::to_string(&findings).unwrap_or_default())?;
        }
        CheckForm::Sarif => console.print(&sarif::log(&findings.diagnostics).to_string())?,
    }
    Ok(findings.exit(args.deny))
}
