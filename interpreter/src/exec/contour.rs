//! From programmed motions to steps: holds a motion back until the next one is known, where something may come between.

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
    /// Main axes of the plane that was active, as axis indices.
    pub(super) plane: [usize; 2],
}

/// Motions and events on their way to the simulation.
#[derive(Debug, Default)]
pub(super) struct Contour {
    queue: VecDeque<Step>,
    events: Vec<Event>,
    held: Option<Box<Motion>>,
    insertion: Option<Insertion>,
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
    pub(super) fn motion(&mut self, mut motion: Box<Motion>) -> Option<Box<Fault>> {
        let mut fault = None;
        if let Some(mut before) = self.held.take() {
            let inserted = match self.insertion.take() {
                Some(insertion) => {
                    match insertion::between(&mut before, &mut motion, &insertion) {
                        Ok(inserted) => inserted,
                        Err(f) => {
                            fault = Some(f);
                            None
                        }
                    }
                }
                None => None,
            };
            self.emit(before);
            if let Some(inserted) = inserted {
                self.emit(inserted);
            }
        }
        self.held = Some(motion);
        fault
    }

    /// A step at rest.
    pub(super) fn sync(&mut self, what: Sync, source: SourceRef) -> Option<Box<Fault>> {
        let fault = self.flush();
        let events = self.take_events();
        self.queue.push_back(Step::Sync { what, source, events });
        fault
    }

    /// End of the program.
    pub(super) fn end(&mut self, reason: EndReason, source: SourceRef) -> Option<Box<Fault>> {
        let fault = self.flush();
        let events = self.take_events();
        self.queue.push_back(Step::End { reason, source, events });
        fault
    }

    /// The path rests behind the held motion: nothing can be inserted any more.
    fn flush(&mut self) -> Option<Box<Fault>> {
        if let Some(motion) = self.held.take() {
            self.emit(motion);
        }
        self.insertion.take().map(|insertion: Insertion| {
            let text = "the path stops here: no chamfer or rounding is inserted";
            let span: Span = insertion.span;
            Fault::vendor(20352, text, span)
        })
    }

    fn emit(&mut self, motion: Box<Motion>) {
        let Motion { mut block, source, events, .. } = *motion;
        block.seq = self.blocks;
        self.blocks += 1;
        self.queue.push_back(Step::Motion { block, source, events });
    }
}
