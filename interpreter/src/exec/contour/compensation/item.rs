//! Input, output and errors of the compensation.

use crate::diag::Condition;
use crate::exec::contour::motion::Motion;
use crate::exec::fault::Fault;
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
    pub(in crate::exec) what: Sync,
    pub(in crate::exec) source: SourceRef,
    pub(in crate::exec) events: Vec<Event>,
}

/// The events of a removed motion.
pub(super) fn vanished(events: Vec<Event>, out: &mut Vec<Item>) {
    if !events.is_empty() {
        out.push(Item::Events(events));
    }
}

pub(super) type Fallible<T> = Result<T, Box<Fault>>;

/// The contour is too tight for the tool radius: K-0115, or the ID of the vendor for a tool that would run back along a line
/// (90019) or once round an arc (90038).
///
/// Source: TF5200 diagnosis 261669259, 261704075.
pub(super) fn too_tight(condition: Condition, motion: &Motion) -> Box<Fault> {
    let text = "the contour is too tight for the tool radius";
    Fault::new(condition, text, motion.span).in_block(motion.source)
}
