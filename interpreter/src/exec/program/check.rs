//! Decodes a program without moving, and collects all its diagnostics.

use super::executor::{Executor, Mode};
use super::files::Structures;
use crate::diag::{Condition, Diagnostic};
use crate::exec::contour::programmed_time_s;
use crate::exec::options::{GuardCommands, Options};
use crate::exec::step::{Feedback, SourceRef, Step, Sync, Told};
use crate::machine::Machine;
use crate::source::Sources;
use std::sync::Arc;

/// Result of a check.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checked {
    /// All diagnostics of the program.
    pub diagnostics: Vec<Diagnostic>,
    /// Names of its files, the main program first; empty if that cannot be opened.
    pub files: Vec<Arc<str>>,
    /// Whether a run may open more files, called from a part of the program that the check did not reach.
    pub calls_more: bool,
    /// The settings of its commands for the Vibration Guard.
    pub guard: GuardCommands,
}

impl Checked {
    /// Whether the program is refused: a run would stop at an error. A limit (K-0017) ends a run where it is reached,
    /// but does not refuse the program.
    pub fn refuses(&self) -> bool {
        self.diagnostics.iter().any(|d| d.is_error() && d.id != Condition::Endless)
    }
}

/// Executes a program as if every axis were always at its command position, continues after errors where possible, and
/// returns all diagnostics. It stops after 20 errors, and where the limits in the options stop a run (K-0017). Parts
/// that were not executed are checked for their syntax (K-0118). The structure of its files serves a run that follows.
pub(crate) fn check(
    sources: Arc<dyn Sources>,
    program: &str,
    machine: Arc<Machine>,
    options: Options,
) -> (Checked, Structures) {
    let max_time_s = options.max_time_s;
    let mut executor = Executor::with_mode(sources, program, machine, options, Mode::Check);
    let mut time_s = 0.0;
    let mut pass = |executor: &mut Executor, seconds: f64, at: SourceRef| {
        let was_over = time_s > max_time_s;
        time_s += seconds;
        if time_s > max_time_s && !was_over {
            executor.end_by_time(max_time_s, at);
        }
    };
    loop {
        let before = executor.current();
        if let Some(seconds) = executor.straight_by() {
            pass(&mut executor, seconds, before);
            continue;
        }
        let feedback = Feedback { actual_mm: executor.target().clone(), ..Feedback::default() };
        match executor.next(Told::from(feedback)) {
            Step::End { .. } => {
                executor.check_unreached();
                let checked = Checked {
                    diagnostics: executor.take_diagnostics(),
                    files: executor.files().to_vec(),
                    calls_more: executor.calls_more,
                    guard: executor.guard_commands().clone(),
                };
                return (checked, executor.into_structures());
            }
            Step::Motion { block, source, .. } => {
                pass(&mut executor, programmed_time_s(&block), source);
            }
            Step::Sync {
                what: Sync::Dwell { seconds } | Sync::Technology { seconds },
                source,
                ..
            } => pass(&mut executor, seconds, source),
            Step::Sync { .. } => {}
        }
    }
}
