//! Decoding without moving: everything there is to say about a program.

use super::executor::Executor;
use super::options::Options;
use super::step::{Feedback, Step};
use crate::diag::Diagnostic;
use crate::machine::Machine;
use crate::source::Sources;
use std::sync::Arc;

/// Executes a program as if every axis were always where it is told to be, goes on after errors where it can, and
/// returns all diagnostics; it stops after 20 errors.
pub fn check(
    sources: Box<dyn Sources>,
    program: &str,
    machine: Arc<Machine>,
    options: Options,
) -> Vec<Diagnostic> {
    let mut executor = Executor::with_mode(sources, program, machine, options, true);
    let mut feedback = Feedback::default();
    loop {
        feedback.actual_mm.clone_from(executor.target());
        if let Step::End { .. } = executor.next(&feedback) {
            return executor.take_diagnostics();
        }
    }
}
