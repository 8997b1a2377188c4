//! The program of a simulation: its steps, decoded on demand or ahead of the machine on another thread.

use super::fault;
use super::thread::{Work, give};
use crate::diag::{Diagnostic, Location};
use crate::exec::{
    Ahead, Decoded, EndReason, Executor, Feedback, Options, Places, ShapingSetup, SourceRef, Step,
    Structures, TimerCall, Told, connection,
};
use crate::machine::Machine;
use crate::source::Sources;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::SpareBlocks;
use std::sync::Arc;

/// See the module.
#[derive(Debug)]
pub(crate) struct Program {
    decoding: Decoding,
    /// News of the machine that the decoding has not requested yet.
    told: Told,
    /// State after the step taken last.
    machine: Arc<Machine>,
    shaping: ShapingSetup,
    blocks: u64,
    places: Places,
}

#[derive(Debug)]
enum Decoding {
    OnDemand(Box<Executor>),
    Ahead(Ahead),
    /// The thread has ended too early.
    Lost,
}

impl Program {
    /// A program before its first block, the rest positions of its axes, and its first messages.
    pub(super) fn new(
        sources: Arc<dyn Sources>,
        name: &str,
        machine: Arc<Machine>,
        options: Options,
        structures: Structures,
    ) -> (Self, AxisVec, Vec<Diagnostic>) {
        let mut places = Places::new(Arc::clone(&sources));
        let mut executor = Executor::new(sources, name, Arc::clone(&machine), options, structures);
        places.add(executor.take_opened());
        let (start, found) = (executor.start_position().clone(), executor.take_diagnostics());
        let shaping = executor.shaping().clone();
        let decoding = Decoding::OnDemand(Box::new(executor));
        let program = Self { decoding, told: Told::default(), machine, shaping, blocks: 0, places };
        (program, start, found)
    }

    /// Decodes the program on another thread from here on, if `start` can start one.
    pub(super) fn decode_ahead(&mut self, start: impl FnOnce(Work) -> bool) {
        if !matches!(self.decoding, Decoding::OnDemand(_)) {
            return;
        }
        let (ahead, work) = connection();
        let before = std::mem::replace(&mut self.decoding, Decoding::Ahead(ahead));
        if let Decoding::OnDemand(executor) = before
            && let Err(executor) = give(executor, work, start)
        {
            self.decoding = Decoding::OnDemand(executor);
        }
    }

    /// News of the machine for the next step.
    pub(super) fn tell(&mut self, feedback: Feedback) {
        self.told.feedback = Some(feedback);
    }

    /// `#TIMER .. SYN`: an operation that has been executed.
    pub(super) fn timer(&mut self, call: TimerCall) {
        self.told.timers.push(call);
    }

    /// The next step; messages of its decoding are added to `found`. The memory of blocks that were left is reused.
    pub(super) fn next(&mut self, found: &mut Vec<Diagnostic>, left: &mut SpareBlocks) -> Step {
        let decoded = match &mut self.decoding {
            Decoding::OnDemand(executor) => {
                executor.tell(std::mem::take(&mut self.told));
                executor.reuse(left);
                Some(executor.decode())
            }
            Decoding::Ahead(ahead) => ahead.next(&mut self.told, left),
            Decoding::Lost => None,
        };
        let Some(Decoded { step, blocks, rare }) = decoded else {
            self.decoding = Decoding::Lost;
            found.push(fault::internal("the program is no longer decoded"));
            let source = SourceRef::default();
            return Step::End { reason: EndReason::Aborted, source, events: Vec::new() };
        };
        self.blocks = blocks;
        if let Some(mut rare) = rare {
            found.append(&mut rare.diagnostics);
            self.places.add(rare.files);
            if let Some(changed) = rare.changed {
                (self.machine, self.shaping) = changed;
            }
        }
        step
    }

    /// Blocks executed up to the last step.
    pub(super) const fn blocks(&self) -> u64 {
        self.blocks
    }

    /// The machine as changed by `#MACHINE DATA`, up to the last step that changes it.
    pub(super) const fn machine(&self) -> &Arc<Machine> {
        &self.machine
    }

    /// The kernels that belong to it; before the first step those of the axis lists.
    pub(super) const fn shaping(&self) -> &ShapingSetup {
        &self.shaping
    }

    /// Names of the files opened so far; [`SourceRef::file`] is an index into them.
    pub(super) fn files(&self) -> &[Arc<str>] {
        self.places.names()
    }

    /// Position of a block whose step was taken; its text is read again.
    pub(super) fn locate(&mut self, source: SourceRef) -> Option<Location> {
        self.places.locate(source)
    }
}
