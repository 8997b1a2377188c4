//! Sections that are faster with rests, and shorter rests.
//!
//! With rests as long as the filters at both ends, a block is independent of the others. The search for a plan only
//! attributes each excess to a cause; where causes overlap it can slow down a whole section that would be faster with
//! rests. Where the blocks of a section take longer than they would from rest to rest, a plan with these rests is
//! therefore searched as well, and the one that ends earlier is used. Only the sections that save most are tried, so a plan
//! with rests at all boundaries can still be a little faster (1.7 % in the tests, with filters that differ).
//!
//! A plan whose few excesses are answered one by one is searched beside one with even speeds everywhere, and in the same
//! way a plan with shorter dwells is searched. The search lengthens the dwells of all corners that share an
//! excess at once, so that the order in which it meets them decides which of them become too long.

use super::Planner;
use super::extend::Searched;
use crate::cap::SpeedLimit;
use crate::queue::Queued;
use crate::timeline::{Entry, Moment};
use crate::tolerance::{Demands, entered};
use std::ops::Range;
use std::sync::Arc;

/// Number of sections tried in one plan.
const TRIES: usize = 4;
/// Number of cycles that the rests have to save.
const WORTH: f64 = 2.0;
/// Share of a plan that may exceed the tolerance for its excesses to be answered one by one.
const FEW: f64 = 0.1;
/// Share of the plan that shorter dwells have to save.
const WORTH_SHARE: f64 = 5e-4;

impl Planner {
    /// The faster plan: `kept`, which keeps the tolerance, or one that rests on some section that begins before block
    /// `front`.
    pub(super) fn rest_instead(
        &mut self,
        window: &[Arc<Queued>],
        forced: &[bool],
        ends: (Moment, SpeedLimit),
        mut kept: Vec<Entry>,
        front: usize,
    ) -> Vec<Entry> {
        if !self.kernels.any() {
            return kept;
        }
        let mut gains = self.gains(&kept);
        for _ in 0..TRIES {
            let Some(blocks) = best_stretch(&gains, front) else { break };
            gains[blocks.clone()].fill(f64::NEG_INFINITY);
            if self.plan.demands.rests_over(blocks.clone(), window, &self.kernels) {
                continue;
            }
            let before = self.plan.demands.clone();
            let end = |plan: &[Entry]| plan.last().map_or(0.0, |e| e.end.cycles(self.cycle));
            let in_time = end(&kept) - WORTH;
            self.plan.demands.rest_over(blocks, window, &self.kernels, self.cycle);
            match self.search(window, forced, ends, Some(kept.clone()), &mut 1, in_time) {
                Searched::Kept(rested) => kept = rested,
                _ => self.plan.demands = before,
            }
        }
        kept
    }

    /// The faster plan: `kept`, or, if it has even speeds because of few excesses, one found from the demands `asked`
    /// before: even speeds are demanded for the whole window, and one excess of a micrometre would cost as much as many.
    pub(super) fn answer_only(
        &mut self,
        asked: &Demands,
        window: &[Arc<Queued>],
        forced: &[bool],
        ends: (Moment, SpeedLimit),
        kept: Vec<Entry>,
    ) -> Vec<Entry> {
        let end = kept.last().map_or(0.0, |e| e.end.cycles(self.cycle));
        let brakes = |q: &Arc<Queued>| q.slope.down_time(q.velocity.v_mm_s, 0.0);
        let brakes = window.iter().map(brakes).fold(0.0, f64::max) / self.cycle.seconds();
        let times = entered(&kept, self.cycle);
        let lost = self.plan.demands.answer_few(FEW, &times, brakes, &self.kernels);
        if lost.is_none_or(|cycles| cycles <= WORTH) {
            return kept;
        }
        let before = std::mem::replace(&mut self.plan.demands, asked.clone());
        let found = self.search(window, forced, ends, None, &mut 1, end - WORTH);
        if let Searched::Kept(faster) = found {
            return faster;
        }
        self.plan.demands = before;
        kept
    }

    /// The faster plan: `kept`, or one found from dwells as short as each of them could be alone.
    pub(super) fn shorten(
        &mut self,
        window: &[Arc<Queued>],
        forced: &[bool],
        ends: (Moment, SpeedLimit),
        mut kept: Vec<Entry>,
    ) -> Vec<Entry> {
        let mut tried: Option<Demands> = None;
        // a line from dwell to dwell need not be slow, but at its full speed the dwells may have to be longer
        for at_speed in [true, false, false] {
            let end = kept.last().map_or(0.0, |e| e.end.cycles(self.cycle));
            let takes = end - self.plan.start.moment.cycles(self.cycle);
            let shorter = self.monitor.shorter(&self.trial(&kept), &self.plan.demands);
            let saves = f64::from(shorter.saved) > WORTH.max(WORTH_SHARE * takes);
            if !(saves || at_speed && self.plan.demands.slows(&shorter)) {
                continue;
            }
            let before = self.plan.demands.clone();
            self.plan.demands.shorten(&shorter, at_speed, window, &self.kernels, self.cycle);
            // the same demands lead to the same plan
            if tried.as_ref().is_some_and(|tried| tried.are_those_of(&self.plan.demands)) {
                self.plan.demands = before;
                break;
            }
            tried = Some(self.plan.demands.clone());
            let last = Some(kept.clone());
            let found = self.search(window, forced, ends, last, &mut 1, end - WORTH);
            if let Searched::Kept(shorter) = found {
                kept = shorter;
                continue;
            }
            self.plan.demands = before;
            if !at_speed {
                break;
            }
        }
        kept
    }

    /// Number of cycles that each block of a plan would save if the path rested before it, until the earlier contour
    /// has left the filters, and at its end; negative for a loss.
    fn gains(&self, plan: &[Entry]) -> Vec<f64> {
        let (cycle, wait) = (self.cycle, f64::from(self.kernels.length()));
        let blocks = plan.iter().flat_map(|e| &e.blocks);
        let gain = |((queued, _), at): (&(Arc<Queued>, f64), &[f64])| {
            let takes = at[1] - at[0];
            let speed = queued.velocity.v_mm_s;
            let least = wait + queued.length / speed / cycle.seconds();
            if takes <= least {
                return takes - least;
            }
            let rested = queued.slope.plan(0.0, 0.0, speed, queued.length);
            rested.map_or(0.0, |p| takes - wait - p.duration() / cycle.seconds())
        };
        blocks.zip(entered(plan, cycle).windows(2)).map(gain).collect()
    }
}

/// The consecutive blocks with the largest total saving, the first of them before block `front`.
fn best_stretch(gains: &[f64], front: usize) -> Option<Range<usize>> {
    let (mut best, mut stretch) = (WORTH, None);
    let (mut sum, mut from) = (0.0, 0);
    for (i, gain) in gains.iter().enumerate() {
        if sum <= 0.0 {
            (sum, from) = (0.0, i);
        }
        sum += gain;
        if sum > best && from < front {
            (best, stretch) = (sum, Some(from..i + 1));
        }
    }
    stretch
}
