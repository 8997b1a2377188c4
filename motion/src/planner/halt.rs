//! A halt at a place that becomes known only while the path is on its way there.
//!
//! What lies after the place is set aside, so that the path ends there: exactly there, with the limits of its blocks, and
//! without a stop at their end. [`Planner::resume`] puts it back, and the look-ahead continues as if there had been a rest
//! of the program.

use super::Planner;
use super::replan::{GENTLER, SAME_END_MM};
use crate::deviation::What;
use crate::plan::Segment;
use crate::timeline::Entry;
use std::sync::Arc;

impl Planner {
    /// The path halts at the end of everything that was pushed, and asks for nothing more until [`Self::resume`].
    pub fn halt_behind(&mut self) {
        self.halted.get_or_insert_default();
    }

    /// The path halts `distance_mm` after the place of block `seq` that is nearest to `point`; nothing is pushed until
    /// [`Self::resume`].
    ///
    /// False if the block ends before, or if the path is too near or too fast to come to rest there: then it follows its
    /// plan as if nothing had been asked.
    pub fn halt_in(&mut self, seq: u64, point: &[f64], distance_mm: f64) -> bool {
        let before = (self.plan.clone(), self.timeline.clone(), self.contour.clone());
        while self.fall_back().is_some() {}
        let (k, cycle) = (self.setpoint.k, self.cycle);
        let old: Vec<Entry> = self.timeline.take().into();
        let over = old.iter().take_while(|e| e.is_over(k, cycle)).count();
        let ahead = self.ahead(&old[over..]);
        let place = place_in(&ahead, seq, point).map(|s| s + distance_mm);
        let end = ahead.iter().rev().find(|(_, segment)| segment.queued.block.seq == seq);
        let end = end.map_or(f64::NEG_INFINITY, |(s, segment)| s + segment.queued.length);
        let inside = place.filter(|s| *s >= self.setpoint.s_mm && *s <= end + SAME_END_MM);
        if let Some(s) = inside {
            let (front, behind) = divided(&ahead, s);
            if GENTLER.iter().any(|gentle| self.change_speed(&old, over, &front, *gentle)) {
                self.halted.get_or_insert_default().splice(..0, behind);
                return true;
            }
        }
        (self.plan, self.timeline, self.contour) = before;
        self.report(|planner| What::Contour(planner.contour.clone()));
        false
    }

    /// A [`Next::Rest`](super::Next::Rest) is that of a halt.
    pub fn halts(&self) -> bool {
        self.halted.is_some()
    }

    /// A path that has come to rest where it halts may continue.
    pub fn resume(&mut self) {
        if let Some(behind) = self.halted.take() {
            let ratios = &self.active.ratios;
            let rated = behind.into_iter().map(|s| Segment { queued: s.queued.rated(ratios), ..s });
            self.plan.replace(rated.collect());
        }
    }
}

/// Path length of the program at the place of a block that is nearest to a point.
fn place_in(ahead: &[(f64, Segment)], seq: u64, point: &[f64]) -> Option<f64> {
    let mut vector = vec![0.0; point.len()];
    let of_block = ahead.iter().filter(|(_, segment)| segment.queued.block.seq == seq);
    let places = of_block.map(|(s, Segment { queued, .. })| {
        let path = &queued.block.path;
        (path.vector_to(point, &mut vector), s - queued.offset + path.nearest(point))
    });
    places.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, s)| s)
}

/// What lies before path length `s` of the program, and what lies after it.
fn divided(ahead: &[(f64, Segment)], s: f64) -> (Vec<(f64, Segment)>, Vec<Segment>) {
    let (mut front, mut behind) = (Vec::new(), Vec::new());
    for (start, segment) in ahead {
        let into = s - start;
        let queued = &segment.queued;
        if into >= queued.length - SAME_END_MM {
            front.push((*start, segment.clone()));
        } else if into <= SAME_END_MM {
            behind.push(segment.clone());
        } else {
            let part = |queued| Segment { queued, ..segment.clone() };
            front.push((*start, part(Arc::new(queued.up_to(into)))));
            behind.push(part(queued.remainder(into)));
        }
    }
    (front, behind)
}
