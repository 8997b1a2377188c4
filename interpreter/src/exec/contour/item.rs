//! What passes through the stages of the contour.

use super::motion::Motion;
use crate::exec::step::{Event, SourceRef, Sync};

/// Items that pass through the stages of the contour.
#[derive(Debug)]
pub(in crate::exec) enum Item {
    Motion(Box<Motion>),
    Rest(Box<Rest>),
    /// Events of a motion that the compensation has removed; they occur with the next step.
    Events(Vec<Event>),
}

/// A step at standstill.
#[derive(Debug)]
pub(in crate::exec) struct Rest {
    pub(in crate::exec::contour) what: Sync,
    pub(in crate::exec::contour) source: SourceRef,
    pub(in crate::exec::contour) events: Vec<Event>,
}

/// The events of a removed motion.
pub(in crate::exec) fn vanished(events: Vec<Event>, out: &mut Vec<Item>) {
    if !events.is_empty() {
        out.push(Item::Events(events));
    }
}
