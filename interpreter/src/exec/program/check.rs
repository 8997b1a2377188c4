//! Decoding without moving: everything there is to say about a program.

use super::executor::Executor;
use crate::diag::{Condition, Diagnostic};
use crate::exec::options::{GuardCommands, Options};
use crate::exec::step::{Feedback, Step, Sync};
use crate::machine::Machine;
use crate::source::Sources;
use kontur_motion::block::{Block, Feed};
use std::sync::Arc;

/// What a check found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checked {
    /// Everything there is to say about the program.
    pub diagnostics: Vec<Diagnostic>,
    /// Names of its files, the main program first; none if it cannot be opened.
    pub files: Vec<Arc<str>>,
    /// A run may come to more files: a part of the program that the check did not reach calls them.
    pub calls_more: bool,
    /// What its commands say about the Vibration Guard.
    pub guard: GuardCommands,
}

impl Checked {
    /// True if the program is refused: a run would stop where an error is. A limit (K-0017) stops a run where it is met and
    /// refuses nothing.
    pub fn refuses(&self) -> bool {
        self.diagnostics.iter().any(|d| d.is_error() && d.id != Condition::Endless)
    }
}

/// Executes a program as if every axis were always where it is told to be, continues after errors where it can, and
/// returns all diagnostics; it stops after 20 errors, and where the limits of the options stop a run (K-0017). What did
/// not run is looked at for its syntax (K-0118).
pub(crate) fn check(
    sources: Arc<dyn Sources>,
    program: &str,
    machine: Arc<Machine>,
    options: Options,
) -> Checked {
    let max_time_s = options.max_time_s;
    let mut executor = Executor::with_mode(sources, program, machine, options, true);
    let mut time_s = 0.0;
    loop {
        let feedback = Feedback { actual_mm: executor.target().clone(), ..Feedback::default() };
        match executor.next(feedback) {
            Step::End { .. } => {
                executor.check_unreached();
                return Checked {
                    diagnostics: executor.take_diagnostics(),
                    files: executor.files().to_vec(),
                    calls_more: executor.calls_more,
                    guard: executor.guard_commands().clone(),
                };
            }
            Step::Motion { block, .. } => time_s += programmed_time(&block),
            Step::Sync { what: Sync::Dwell { seconds } | Sync::Technology { seconds }, .. } => {
                time_s += seconds;
            }
            Step::Sync { .. } => {}
        }
        if time_s > max_time_s && !executor.has_ended() {
            executor.end_by_time(max_time_s);
        }
    }
}

/// Time in s that a motion takes at its programmed speed, without ramps.
fn programmed_time(block: &Block) -> f64 {
    let path = &block.path;
    let of_axes = path.start().iter().zip(path.end().iter()).zip(&block.dynamics.axes);
    let of_axes = of_axes.map(|((from, to), axis)| (to - from).abs() / axis.v_max_mm_s);
    let of_axes = of_axes.filter(|t| t.is_finite()).fold(0.0, f64::max);
    match block.feed {
        Feed::PathVelocity(v) => of_axes.max(path.length() / (v * block.feed_ratio.max(1.0))),
        Feed::Duration(t) => of_axes.max(t),
        Feed::Rapid | Feed::ShareOfMaximum(_) => of_axes,
    }
}
