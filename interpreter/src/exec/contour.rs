//! From programmed motions to steps: holds a motion back until the next one is known, where something may come between.

use super::compensation::{Compensator, Item};
use super::fault::Fault;
use super::insertion::{self, Insertion};
use super::step::{EndReason, Event, SourceRef, Step, Sync};
use crate::syntax::ast::Span;
use kontur_motion::block::Block;
use std::collections::VecDeque;

/// A programmed motion; the number of its block is given when it becomes a step.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    pub(super) block: Block,
    pub(super) source: SourceRef,
    pub(super) events: Vec<Event>,
    /// Axes of the plane that was active.
    pub(super) plane: [usize; 2],
    /// Distance of the tool's centre to the left of the contour, `None` without compensation.
    pub(super) compensation: Option<f64>,
    /// The block, for conditions.
    pub(super) span: Span,
}

/// Motions and events on their way to the simulation.
#[derive(Debug, Default)]
pub(super) struct Contour {
    queue: VecDeque<Step>,
    events: Vec<Event>,
    held: Option<Box<Motion>>,
    insertion: Option<Insertion>,
    compensator: Compensator,
    blocks: u64,
}

impl Contour {
    /// The next step.
    pub(super) fn pop(&mut self) -> Option<Step> {
        self.queue.pop_front()
    }

    pub(super) fn event(&mut self, event: Event) {
        self.events.push(event);
    }

    /// Events that wait for the next step.
    pub(super) fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    /// Drops the last motion: its block has an error.
    pub(super) fn drop_held(&mut self) {
        self.held = None;
        self.insertion = None;
    }

    /// G301, G302 and relatives: between the motion before and the next one.
    pub(super) fn insert(&mut self, insertion: Insertion) -> Option<Box<Fault>> {
        let span = insertion.span;
        if self.held.is_none() {
            let text = "no motion before to which a chamfer or rounding could be joined";
            return Some(Fault::vendor(20351, text, span).warning());
        }
        let before = self.insertion.replace(insertion);
        before.map(|_| {
            let text = "two insertions without a motion between them, the last one acts";
            Fault::vendor(20701, text, span).warning()
        })
    }

    /// A motion.
    pub(super) fn motion(&mut self, mut motion: Box<Motion>) -> Vec<Fault> {
        let mut faults = Vec::new();
        if let Some(mut before) = self.held.take() {
            let inserted = match self.insertion.take() {
                Some(insertion) => insertion::between(&mut before, &mut motion, &insertion)
                    .map_err(|fault| fault.in_block(insertion.source)),
                None => Ok(None),
            };
            faults.extend(self.compensate(before).map(|f| *f));
            match inserted {
                Ok(Some(inserted)) => faults.extend(self.compensate(inserted).map(|f| *f)),
                Ok(None) => {}
                Err(fault) => faults.push(*fault),
            }
        }
        self.held = Some(motion);
        faults
    }

    /// A step at rest.
    pub(super) fn sync(&mut self, what: Sync, source: SourceRef) -> Vec<Fault> {
        let mut faults = self.flush();
        let events = self.take_events();
        let mut done = Vec::new();
        faults.extend(
            self.compensator.sync(Item::Sync { what, source, events }, &mut done).err().map(|f| *f),
        );
        self.emit(done);
        faults
    }

    /// End of the program.
    pub(super) fn end(&mut self, reason: EndReason, source: SourceRef) -> Vec<Fault> {
        let mut faults = self.flush();
        let mut done = Vec::new();
        faults.extend(self.compensator.end(&mut done).err().map(|f| *f));
        self.emit(done);
        let events = self.take_events();
        self.queue.push_back(Step::End { reason, source, events });
        faults
    }

    /// The path rests behind the held motion: nothing can be inserted any more.
    fn flush(&mut self) -> Vec<Fault> {
        let mut faults = Vec::new();
        if let Some(motion) = self.held.take() {
            faults.extend(self.compensate(motion).map(|f| *f));
        }
        if let Some(insertion) = self.insertion.take() {
            let text = "the path stops here: no chamfer or rounding is inserted";
            let fault = Fault::vendor(20352, text, insertion.span);
            faults.push(*fault.in_block(insertion.source));
        }
        faults
    }

    fn compensate(&mut self, motion: Box<Motion>) -> Option<Box<Fault>> {
        let mut done = Vec::new();
        let fault = self.compensator.motion(motion, &mut done).err();
        self.emit(done);
        fault
    }

    fn emit(&mut self, items: Vec<Item>) {
        for item in items {
            self.queue.push_back(match item {
                Item::Motion(motion) => {
                    let Motion { mut block, source, events, .. } = *motion;
                    block.seq = self.blocks;
                    self.blocks += 1;
                    Step::Motion { block, source, events }
                }
                Item::Sync { what, source, events } => Step::Sync { what, source, events },
            });
        }
    }
}
