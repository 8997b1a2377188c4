//! A halt at a point that becomes known only while the path is approaching it.
//!
//! The path after that point is set aside, so that the path ends exactly there, within the limits of its blocks and
//! without a stop at their ends. [`Planner::resume`] puts it back, and the look-ahead continues as after a rest of the
//! program.

use super::Planner;
use super::replan::GENTLER;
use crate::deviation::What;
use crate::plan::Segment;
use crate::timeline::{Entry, SAME_END_MM};
use std::sync::Arc;

impl Planner {
    /// Halts the path at the end of everything that was pushed; no more input is requested until [`Self::resume`].
    pub fn halt_behind(&mut self) {
        self.halted.get_or_insert_default();
    }

    /// Halts the path `distance_mm` after the point of block `seq` nearest to `point`; nothing may be pushed until
    /// [`Self::resume`].
    ///
    /// False if the block ends before that point, or if the path is too close or too fast to come to rest there; the
    /// path then follows its plan unchanged.
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

    /// Whether [`Next::Rest`](super::Next::Rest) means a halt.
    pub fn halts(&self) -> bool {
        self.halted.is_some()
    }

    /// Continues a path that has come to rest at a halt.
    pub fn resume(&mut self) {
        if let Some(behind) = self.halted.take() {
            let ratios = &self.active.ratios;
            let rated = behind.into_iter().map(|s| Segment { queued: s.queued.rated(ratios), ..s });
            self.plan.replace(rated.collect());
        }
    }
}

/// Path length of the program at the point of a block nearest to `point`.
fn place_in(ahead: &[(f64, Segment)], seq: u64, point: &[f64]) -> Option<f64> {
    let mut vector = vec![0.0; point.len()];
    let of_block = ahead.iter().filter(|(_, segment)| segment.queued.block.seq == seq);
    let places = of_block.map(|(s, Segment { queued, .. })| {
        let path = &queued.block.path;
        (path.vector_to(point, &mut vector), s - queued.offset + path.nearest(point))
    });
    places.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, s)| s)
}

/// The segments before path length `s` of the program, and those after it.
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
