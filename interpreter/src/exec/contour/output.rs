//! The way out of the contour: completed items become steps.

use super::{Contour, feed_course};
use crate::diag::Condition;
use crate::exec::contour::bottleneck::Cut;
use crate::exec::contour::item::{Item, Rest};
use crate::exec::contour::motion::{Driven, Motion, PathOf};
use crate::exec::fault::Fault;
use crate::exec::step::{AtCorner, Event, Step};
use crate::syntax::ast::Span;

impl Contour {
    /// The next step.
    pub(in crate::exec) fn pop(&mut self) -> Option<Step> {
        if self.queue.is_empty() && self.end.is_none() {
            return None;
        }
        let mut before = std::mem::take(&mut self.stray);
        loop {
            let Some(item) = self.queue.pop_front() else {
                let mut end = self.end.take().map(|end| *end);
                if let Some(Step::End { events, .. }) = &mut end {
                    events.splice(0..0, before);
                } else {
                    self.stray = before;
                }
                return end;
            };
            let (mut step, engaged) = match item {
                Item::Events(events) => {
                    before.extend(events);
                    continue;
                }
                Item::Motion(mut motion) => {
                    motion.block.seq = self.blocks;
                    self.blocks += 1;
                    let engaged = motion.engaged.map(|left| (motion.plane, left));
                    let Motion { block, source, events, .. } = *motion;
                    (Step::Motion { block, source, events }, Some(engaged))
                }
                Item::Rest(rest) => {
                    let Rest { what, source, events } = *rest;
                    (Step::Sync { what, source, events }, None)
                }
            };
            let (Step::Motion { events, .. }
            | Step::Sync { events, .. }
            | Step::End { events, .. }) = &mut step;
            if !before.is_empty() {
                events.splice(0..0, before);
            }
            if let Some(engaged) = engaged
                && self.tells_engagement
                && self.engaged != engaged
            {
                self.engaged = engaged;
                events.push(Event::Engaged(engaged));
            }
            return Some(step);
        }
    }

    pub(super) fn compensate(&mut self, mut motion: Box<Motion>) -> Option<Box<Fault>> {
        if motion.compensation.is_some() || self.compensator.is_active() {
            motion.enter_tilt();
        }
        let fault = self.compensator.motion(motion, &mut self.done).err();
        self.emit();
        fault.or_else(|| self.cut().map(Box::new))
    }

    /// K-0119, once per program.
    pub(super) fn cut(&mut self) -> Option<Fault> {
        self.compensator.take_cut().map(|cut| bottleneck(&cut))
    }

    /// Outputs completed items in machine coordinates.
    pub(super) fn emit(&mut self) {
        for item in &mut self.done {
            if let Item::Motion(motion) = item {
                motion.leave_tilt();
                let Motion { block, source, span, .. } = &**motion;
                let axes = 0..block.path.start().len();
                let extents = axes.map(|axis| block.path.extent(axis));
                if motion.path_of == PathOf::Tool
                    && let Some(extents_mm) = extents.collect()
                {
                    self.driven.push(Driven { extents_mm, source: *source, span: *span });
                }
            }
        }
        let mut done = std::mem::take(&mut self.done);
        for item in done.drain(..) {
            match item {
                Item::Motion(motion) if motion.course.is_some() => {
                    for piece in feed_course::pieces(motion) {
                        self.go_out(piece);
                    }
                }
                Item::Motion(_) | Item::Rest(_) | Item::Events(_) => self.go_out(item),
            }
        }
        // its memory is reused
        self.done = done;
    }

    /// The last stage before the simulation.
    pub(super) fn go_out(&mut self, item: Item) {
        match &item {
            Item::Motion(motion) => {
                if let Some(watch) = &motion.watch {
                    let violation = watch.fault(&motion.block.path, motion.source, motion.span);
                    self.violations.extend(violation);
                }
                self.driven.extend(self.interim.motion(motion));
            }
            // the path may wait within a curve
            Item::Rest(rest) if rest.what.at_corner() == AtCorner::Waits => {}
            Item::Rest(_) => self.interim.rest(),
            Item::Events(_) => {}
        }
        self.queue.push_back(item);
    }
}

/// K-0119.
pub(super) fn bottleneck(cut: &Cut) -> Fault {
    let text = format!(
        "the tool cuts the contour of line {}: its centre comes within {:.4} mm, its radius is {:.4} mm there",
        cut.contour.line, cut.distance_mm, cut.radius_mm
    );
    let hint = "use a smaller tool; the control does not detect such bottlenecks";
    *Fault::new(Condition::Bottleneck, text, Span::default()).hint(hint).in_block(cut.tool)
}
