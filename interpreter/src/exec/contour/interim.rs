//! Corners of `#CONTOUR MODE [POS ..]`: their curves pass through an interim point, and so leave the range between the ends of
//! the motions. The curves of the other modes lie between the corner and its sides.
//!
//! A copy of the output passes through the stage that generates the curves; the output itself does so again before the planner.

use super::motion::{Driven, Motion};
use crate::exec::step::SourceRef;
use crate::syntax::ast::Span;
use kontur_filters::time::CycleTime;
use kontur_motion::block::{Block, ContourMode};
use kontur_motion::contouring::Contouring;
use kontur_motion::path::Path;
use kontur_motion::tolerance::Kernels;
use std::collections::VecDeque;

/// The generated curves.
#[derive(Debug)]
pub(super) struct Interim {
    stage: Contouring,
    /// Number of the next motion.
    next: u64,
    /// Motions that may have a curve at their end, with their numbers.
    before: VecDeque<(u64, SourceRef, Span)>,
}

/// A curve through an interim point is always generated: neither cycle nor filters matter.
fn stage() -> Contouring {
    Contouring::new(CycleTime::DEFAULT)
}

impl Default for Interim {
    fn default() -> Self {
        Self { stage: stage(), next: 0, before: VecDeque::new() }
    }
}

/// Whether a curve at its end may pass through a point.
fn leads_on(block: &Block) -> bool {
    block.contour.is_some_and(|settings| matches!(settings.mode, ContourMode::Pos { .. }))
}

impl Interim {
    /// Whether neither this motion nor one before it has a curve.
    pub(super) fn lets_by(&self, motion: &Motion) -> bool {
        self.before.is_empty() && !leads_on(&motion.block)
    }

    /// Called for each motion that is output: the range that its curve with the previous motion covers.
    pub(super) fn motion(&mut self, motion: &Motion) -> Option<Driven> {
        if self.lets_by(motion) {
            return None;
        }
        let mut block = Block { seq: self.next, ..Block::clone(&motion.block) };
        let is_curve = matches!(block.path, Path::Curve(_));
        if leads_on(&block) {
            self.before.push_back((self.next, motion.source, motion.span));
        } else {
            block.contour = None;
        }
        self.next += 1;
        let mut driven: Option<Driven> = None;
        for made in self.stage.push(block, &Kernels::default()) {
            while self.before.front().is_some_and(|(seq, ..)| *seq < made.seq) {
                self.before.pop_front();
            }
            let Path::Curve(curve) = &made.path else { continue };
            // the second half of a curve may belong to this motion, whose own path was checked before
            let (source, span) = match self.before.front() {
                _ if made.seq + 1 == self.next && is_curve => continue,
                Some((seq, source, span)) if *seq == made.seq => (source, span),
                Some(_) => continue,
                None => (&motion.source, &motion.span),
            };
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

    /// The path stops: no curve.
    pub(super) fn rest(&mut self) {
        self.stage = stage();
        self.before.clear();
    }
}
