//! The state of a run, and what its parts are: below everything that advances it.

mod batch;
mod probe;
mod stopping;
mod times;

use super::chains::Chains;
use super::independent::IndependentAxes;
use super::inputs::Inputs;
use super::messages::Messages;
use super::program::Program;
use super::smoothing::Smoothing;
use super::spindle::Spindle;
use super::totals::{Programmed, Progress, Totals};
use super::wait::Wait;
use super::wear::Wear;
use crate::exec::{EndReason, Event, SourceRef, Step, Sync};
use crate::machine::Machine;
use crate::record::{CycleRecord, Motion};
pub(in crate::sim) use batch::Batch;
use kontur_filters::time::CycleTime;
use kontur_motion::axis::AxisVec;
use kontur_motion::planner::Planner;
pub(in crate::sim) use probe::{Banding, Probing};
use std::collections::VecDeque;
use std::sync::Arc;
pub(in crate::sim) use stopping::Stopping;
pub(in crate::sim) use times::{Timed, Times};

/// Phase of a run.
#[derive(Debug)]
pub(in crate::sim) enum Phase {
    /// The row of time zero has not been output yet.
    Start,
    /// The planner determines the motion.
    Running,
    /// At rest until the condition is met.
    Waiting(Wait),
    /// Braking after a fault, until the axes have come to rest.
    Stopping(Stopping),
    Done,
}

/// A block on its way from the program to the machine.
#[derive(Debug)]
pub(in crate::sim) struct Underway {
    pub(in crate::sim) seq: u64,
    pub(in crate::sim) source: SourceRef,
    pub(in crate::sim) programmed: Programmed,
    pub(in crate::sim) motion: Motion,
    /// Its programmed time in s (G93).
    pub(in crate::sim) time_s: Option<f64>,
    /// Programmed end of the block.
    pub(in crate::sim) target: AxisVec,
    pub(in crate::sim) jerk_limited: bool,
    pub(in crate::sim) events: Vec<Event>,
}

/// A thread of G33 that is being cut.
#[derive(Clone, Copy, Debug)]
pub(in crate::sim) struct Thread {
    /// Whether the override has no effect on it.
    pub(in crate::sim) full_override: bool,
    /// Whether a feedhold has stopped the path in it, and whether an override has scaled its pitch; each is reported once.
    pub(in crate::sim) held: bool,
    pub(in crate::sim) scaled: bool,
}

/// Continuation after the path has come to rest.
#[derive(Debug)]
pub(in crate::sim) enum After {
    Sync(Sync),
    End(EndReason),
}

/// A continuation with its block.
#[derive(Debug)]
pub(in crate::sim) struct Pending {
    pub(in crate::sim) after: After,
    pub(in crate::sim) source: SourceRef,
    /// They occur when the path has stopped.
    pub(in crate::sim) events: Vec<Event>,
    /// Blocks of the program up to it.
    pub(in crate::sim) blocks: u64,
}

/// Blocks and stops on their way from the program to the machine.
#[derive(Debug, Default)]
pub(in crate::sim) struct Queue {
    pub(in crate::sim) underway: VecDeque<Underway>,
    /// What happens when the path has come to rest, in this order.
    pub(in crate::sim) pending: VecDeque<Pending>,
    /// Waits at the end of a block whose corner is rounded, until the block after it is known.
    pub(in crate::sim) at_corner: VecDeque<Pending>,
    /// A step after such waits that is not that block.
    pub(in crate::sim) postponed: Option<Step>,
}

/// The blocks to which cycles, waits and stops belong.
#[derive(Debug)]
pub(in crate::sim) struct BlockRefs {
    pub(in crate::sim) current: SourceRef,
    /// Block of the last cycle, see [`Simulation::block_of_cycle`].
    pub(in crate::sim) shown: SourceRef,
    /// Whether a wait behind the current block has had cycles.
    pub(in crate::sim) left: bool,
    /// Block for which the path waits at rest.
    pub(in crate::sim) waits_at: SourceRef,
    /// Block of the last stop of every chain.
    pub(in crate::sim) stops_at: Vec<SourceRef>,
}

impl BlockRefs {
    /// Before the first block.
    pub(in crate::sim) fn none(chains: usize) -> Self {
        let none = SourceRef::default;
        Self {
            current: none(),
            shown: none(),
            left: false,
            waits_at: none(),
            stops_at: vec![none(); chains],
        }
    }
}

/// The limit of the program time.
#[derive(Clone, Copy, Debug)]
pub(in crate::sim) struct TimeLimit {
    pub(in crate::sim) cycles: u64,
    /// As given, for its message.
    pub(in crate::sim) seconds: f64,
}

impl TimeLimit {
    /// Whole cycles in a time in s: 286 cycles of 1 ms for 0.286 s, although the quotient is slightly lower.
    pub(in crate::sim) fn new(seconds: f64, cycle: CycleTime) -> Self {
        const ROUNDING: f64 = 1e-6;
        Self { cycles: (seconds / cycle.seconds() + ROUNDING) as u64, seconds }
    }
}

/// One channel running one program.
#[derive(Debug)]
pub(crate) struct Simulation {
    pub(in crate::sim) machine: Arc<Machine>,
    pub(in crate::sim) cycle: CycleTime,
    pub(in crate::sim) program: Program,
    pub(in crate::sim) smoothing: Smoothing,
    pub(in crate::sim) planner: Planner,
    pub(in crate::sim) chains: Chains,
    pub(in crate::sim) spindles: Vec<Spindle>,
    /// Setpoint of every spindle in this cycle, in deg.
    pub(in crate::sim) spindle_deg: Vec<f64>,
    pub(in crate::sim) inputs: Inputs,
    pub(in crate::sim) independent: IndependentAxes,
    pub(in crate::sim) queue: Queue,
    pub(in crate::sim) blocks: BlockRefs,
    pub(in crate::sim) motion: Motion,
    /// Whether feedhold or override 0 keeps the path at rest in this cycle.
    pub(in crate::sim) is_held: bool,
    pub(in crate::sim) jerk_limited: bool,
    pub(in crate::sim) phase: Phase,
    /// The cycle computed last; initially the state at time zero.
    pub(in crate::sim) record: CycleRecord,
    /// Programmed end of the block, for every chain.
    pub(in crate::sim) targets: Vec<f64>,
    /// Cycles that are computed in a row.
    pub(in crate::sim) batch: Batch,
    /// Set positions of the path axes in the previous cycle, before their filters.
    pub(in crate::sim) path_position: AxisVec,
    /// The thread of G33 that is being cut.
    pub(in crate::sim) thread: Option<Thread>,
    pub(in crate::sim) times: Times,
    /// The measuring run under way.
    pub(in crate::sim) probing: Option<Probing>,
    /// The cycle last reported to the program.
    pub(in crate::sim) told: Option<u64>,
    /// The motion of edge banding under way.
    pub(in crate::sim) banding: Option<Banding>,
    /// `#OTC`.
    pub(in crate::sim) wear: Wear,
    pub(in crate::sim) limit: TimeLimit,
    pub(in crate::sim) messages: Messages,
    pub(in crate::sim) progress: Progress,
    pub(in crate::sim) totals: Totals,
}
