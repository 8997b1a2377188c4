//! Corners of `#CONTOUR MODE [POS ..]`: their curves lead through an interim point, and so leave the range between the ends
//! of the motions. The curves of the other modes lie between the corner and its sides.
//!
//! A copy of what goes out goes through the stage that makes the curves, as it does again before the planner.

use super::motion::{Driven, Motion};
use crate::exec::step::SourceRef;
use crate::syntax::ast::Span;
use kontur_filters::time::CycleTime;
use kontur_motion::block::{Block, ContourMode};
use kontur_motion::contouring::Contouring;
use kontur_motion::path::Path;
use std::collections::VecDeque;

/// The curves that have been made.
#[derive(Debug)]
pub(super) struct Interim {
    stage: Contouring,
    /// Number of the next motion.
    next: u64,
    /// Motions at whose end a curve may come, with their numbers.
    before: VecDeque<(u64, SourceRef, Span)>,
}

/// A curve through an interim point is made whatever it costs: neither cycle nor filters matter.
fn stage() -> Contouring {
    Contouring::new(CycleTime::DEFAULT)
}

impl Default for Interim {
    fn default() -> Self {
        Self { stage: stage(), next: 0, before: VecDeque::new() }
    }
}

/// At its end a curve may lead through a point.
fn leads_on(block: &Block) -> bool {
    block.contour.is_some_and(|settings| matches!(settings.mode, ContourMode::Pos { .. }))
}

impl Interim {
    /// Neither this motion nor one before it has a curve.
    pub(super) fn lets_by(&self, motion: &Motion) -> bool {
        self.before.is_empty() && !leads_on(&motion.block)
    }

    /// A motion goes out: what its curve with the one before reaches.
    pub(super) fn motion(&mut self, motion: &Motion) -> Option<Driven> {
        if self.lets_by(motion) {
            return None;
        }
        let mut block = Block { seq: self.next, ..Block::clone(&motion.block) };
        if leads_on(&block) {
            self.before.push_back((self.next, motion.source, motion.span));
        } else {
            block.contour = None;
        }
        self.next += 1;
        let mut driven: Option<Driven> = None;
        for made in self.stage.push(block, false) {
            while self.before.front().is_some_and(|(seq, ..)| *seq < made.seq) {
                self.before.pop_front();
            }
            let (Path::Curve(curve), Some((seq, source, span))) = (&made.path, self.before.front())
            else {
                continue;
            };
            // the rest of a motion that is a curve itself has been looked at
            if made.seq != *seq || made.seq + 1 == self.next {
                continue;
            }
            let extents = (0..curve.start().len()).map(|axis| curve.extent(axis));
            match &mut driven {
                None => {
                    let extents_mm = extents.collect();
                    driven = Some(Driven { extents_mm, source: *source, span: *span });
                }
                Some(driven) => {
                    for (all, (low, high)) in driven.extents_mm.iter_mut().zip(extents) {
                        *all = (all.0.min(low), all.1.max(high));
                    }
                }
            }
        }
        // they are reported before the planner
        drop(self.stage.take_notices());
        driven
    }

    /// The path rests: no curve.
    pub(super) fn rest(&mut self) {
        self.stage = stage();
        self.before.clear();
    }
}
