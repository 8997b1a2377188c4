//! Decoding without moving: everything there is to say about a program.

use super::executor::Executor;
use crate::diag::{Condition, Diagnostic};
use crate::exec::options::Options;
use crate::exec::step::{Feedback, Step};
use crate::machine::Machine;
use crate::source::Sources;
use std::sync::Arc;

/// ID of syntax errors in parts of a program that do not run; only [`check`] finds them.
pub const UNREACHED: Condition = Condition::Unreached;

/// Executes a program as if every axis were always where it is told to be, goes on after errors where it can, and
/// returns all diagnostics; it stops after 20 errors. What did not run is looked at for its syntax (K-0118).
pub fn check(
    sources: Box<dyn Sources>,
    program: &str,
    machine: Arc<Machine>,
    options: Options,
) -> Vec<Diagnostic> {
    let mut executor = Executor::with_mode(sources, program, machine, options, true);
    loop {
        let feedback = Feedback { actual_mm: executor.target().clone(), time_s: 0.0 };
        if let Step::End { .. } = executor.next(feedback) {
            executor.check_unreached();
            return executor.take_diagnostics();
        }
    }
}
