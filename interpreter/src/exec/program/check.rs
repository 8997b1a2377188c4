//! Decoding without moving: everything there is to say about a program.

use super::executor::Executor;
use crate::diag::{Condition, Diagnostic};
use crate::exec::options::Options;
use crate::exec::step::{Feedback, Step, Sync};
use crate::machine::Machine;
use crate::source::Sources;
use kontur_motion::block::{Block, Feed};
use std::sync::Arc;

/// ID of the message that a limit ended the program.
pub const LIMIT: Condition = Condition::Endless;

/// ID of syntax errors in parts of a program that do not run; only [`check`] finds them.
pub const UNREACHED: Condition = Condition::Unreached;

/// Executes a program as if every axis were always where it is told to be, goes on after errors where it can, and
/// returns all diagnostics; it stops after 20 errors, and where the limits of the options stop a run (K-0017). What did
/// not run is looked at for its syntax (K-0118).
pub fn check(
    sources: Box<dyn Sources>,
    program: &str,
    machine: Arc<Machine>,
    options: Options,
) -> Vec<Diagnostic> {
    let max_time_s = options.max_time_s;
    let mut executor = Executor::with_mode(sources, program, machine, options, true);
    let mut time_s = 0.0;
    loop {
        let feedback = Feedback { actual_mm: executor.target().clone(), time_s: 0.0 };
        match executor.next(feedback) {
            Step::End { .. } => {
                executor.check_unreached();
                return executor.take_diagnostics();
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
