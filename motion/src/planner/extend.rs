//! From the queue to the timeline: plans, their examination, and what of them becomes final.

use super::{Planner, programmed};
use crate::limit::{Cap, SpeedLimit};
use crate::lookahead::plan;
use crate::profile::Infeasible;
use crate::queue::Queued;
use crate::timeline::{Entry, Moment};
use crate::tolerance::{Demands, Trial, Unkept, Verdict};
use kontur_filters::time::CycleTime;
use smallvec::SmallVec;
use std::sync::Arc;

/// Parts in which a span of the last plan becomes final where there is no new one.
const FALL_BACK_PARTS: usize = 8;

impl Planner {
    /// Plans what is queued and makes all but the last window final, or divides queued blocks first.
    pub(super) fn extend(&mut self) -> Result<(), Infeasible> {
        let free = |q: &&Arc<Queued>| q.velocity.v_mm_s > 0.0;
        let window: Vec<Arc<Queued>> = self.queue.iter().take_while(free).cloned().collect();
        let n = window.len();
        // a block without speed ends the path in front of it
        let barred = n < self.queue.len();
        let start = if self.speed.v_mm_s > 0.0 {
            self.cursor
        } else {
            Moment::tick(self.cursor.origin.max(self.setpoint.k))
        };
        let end = if barred {
            SpeedLimit::Feed
        } else if self.finishing {
            SpeedLimit::Stop
        } else {
            SpeedLimit::Lookahead
        };
        self.demands.reach_over(&window, &self.kernels, self.cycle);
        let mut forced = vec![false; n + 1];
        let mut last: Option<Vec<Entry>> = None;
        let (mut round, mut given_up) = (0, false);
        loop {
            let mut entries = match self.place(&window, &forced, start, end) {
                Ok(entries) => entries,
                Err(e) => return self.fall_back().ok_or(e),
            };
            let before = last.as_deref().unwrap_or_else(|| self.reserve.make_contiguous());
            recall(&mut entries, before, self.cycle);
            let verdict = self.verdict(&mut entries, round);
            round += 1;
            match verdict {
                Verdict::Kept => {}
                Verdict::Divided(parts) => {
                    self.divide(parts);
                    return Ok(());
                }
                Verdict::Tightened => {
                    last = Some(entries);
                    continue;
                }
                // the plan before this one keeps the tolerance
                Verdict::GivenUp(_) if self.fall_back().is_some() => return Ok(()),
                Verdict::GivenUp(unkept) => {
                    self.unkept.push(unkept);
                    given_up = true;
                }
            }
            let rests = end != SpeedLimit::Lookahead;
            let entries =
                if rests { entries } else { self.part(entries, self.last_window(&window)) };
            let Some(count) = self.final_entries(&entries, &window, rests) else {
                // one span over more than a window: it is cut where the last window begins
                forced[self.last_window(&window)] = true;
                last = Some(entries);
                continue;
            };
            self.commit(entries, count);
            if given_up {
                // what was of no help is asked no longer
                self.demands = Demands::default();
            }
            return Ok(());
        }
    }

    /// Examines a plan of the window behind everything that is final, see [`Monitor::examine`].
    ///
    /// [`Monitor::examine`]: crate::tolerance::Monitor::examine
    fn verdict(&mut self, entries: &mut [Entry], round: usize) -> Verdict {
        let mut blocks = entries.iter().flat_map(|e| &e.blocks);
        if !blocks.any(|(q, _)| q.block.tolerance.ax_dev_mm.is_some()) || !self.kernels.any() {
            return Verdict::Kept;
        }
        let mut demands = std::mem::take(&mut self.demands);
        let (verdict, kept) = self.monitor.examine(&self.trial(entries), round, &mut demands);
        self.demands = demands;
        for (entry, kept) in entries.iter_mut().zip(kept) {
            entry.kept = kept;
        }
        verdict
    }

    /// What of the timeline, which ends at rest, does not keep the tolerance.
    pub(super) fn excess(&self) -> Option<Unkept> {
        if !self.kernels.any() {
            return None;
        }
        self.monitor.excess(&self.trial(&[]))
    }

    fn trial<'a>(&'a self, plan: &'a [Entry]) -> Trial<'a> {
        Trial {
            timeline: &self.timeline,
            plan,
            past: &self.contour,
            kernels: &self.kernels,
            cycle: self.cycle,
            now: self.setpoint.k,
            at_rest: self.speed.v_mm_s <= 0.0,
        }
    }

    /// The way to rest from the cursor on with the tolerance kept; `None` if there is none.
    pub(super) fn way_out(&mut self) -> Option<Vec<Entry>> {
        loop {
            let free = |q: &&Arc<Queued>| q.velocity.v_mm_s > 0.0;
            let window: Vec<_> = self.queue.iter().take_while(free).cloned().collect();
            self.demands.reach_over(&window, &self.kernels, self.cycle);
            let forced = vec![false; window.len() + 1];
            let mut last = Vec::new();
            let mut round = 0;
            let parts = loop {
                let stop = SpeedLimit::Stop;
                let mut entries = self.place(&window, &forced, self.cursor, stop).ok()?;
                recall(&mut entries, &last, self.cycle);
                match self.verdict(&mut entries, round) {
                    Verdict::Kept => return Some(entries),
                    Verdict::Divided(parts) => break parts,
                    Verdict::Tightened => round += 1,
                    Verdict::GivenUp(_) => return None,
                }
                last = entries;
            };
            self.divide(parts);
        }
    }

    /// Plans the window and places the spans on the time axis.
    fn place(
        &self,
        window: &[Arc<Queued>],
        forced: &[bool],
        start: Moment,
        end: SpeedLimit,
    ) -> Result<Vec<Entry>, Infeasible> {
        let lower = |cap: Cap, demand: f64| cap.lower(Cap::new(demand, SpeedLimit::AxDev));
        let (n, demands) = (window.len(), &self.demands);
        let feeds: Vec<Cap> = window
            .iter()
            .enumerate()
            .map(|(i, q)| {
                let floor = if i == 0 { self.speed.v_mm_s } else { 0.0 };
                lower(q.velocity, demands.feed[i].max(floor))
            })
            .collect();
        let caps: Vec<Cap> = (0..=n)
            .map(|i| lower(self.caps.get(i).copied().unwrap_or(Cap::new(0.0, end)), demands.cap[i]))
            .collect();
        let forced: Vec<bool> = (0..=n).map(|i| forced[i] || demands.stop[i].is_some()).collect();
        let gentle = demands.soften(window);
        let from = (self.speed, self.acceleration);
        let plan = plan(&gentle, &feeds, &caps, &forced, from, end)?;
        // behind a rest the start may have to wait until the filters have left the corner in front of it
        let mut at = match demands.stop[0] {
            Some(wait) => Moment::tick(start.next_tick(self.cycle) + u64::from(wait)),
            None => start,
        };
        let mut s = self.travelled;
        let mut entries = Vec::with_capacity(plan.spans.len());
        for span in &plan.spans {
            let stop = demands.stop[span.end];
            let stops = stop.is_some() || (span.end == n && end != SpeedLimit::Lookahead);
            let mut entry = Entry::new(at, s, span, window, stops);
            entry.feeds = SmallVec::from_slice(&feeds[span.first..span.end]);
            at = match stop {
                Some(dwell) => Moment::tick(entry.end.next_tick(self.cycle) + u64::from(dwell)),
                None => entry.end,
            };
            s += span.profile.length();
            entries.push(entry);
        }
        Ok(entries)
    }

    /// Where the last window of programmed blocks begins.
    fn last_window(&self, blocks: &[Arc<Queued>]) -> usize {
        let mut left = self.window;
        let mut at = blocks.len();
        while at > 0 {
            if at == blocks.len() || blocks[at - 1].block.seq != blocks[at].block.seq {
                if left == 0 {
                    break;
                }
                left -= 1;
            }
            at -= 1;
        }
        at
    }

    /// The entries with the one that reaches over the start of block `limit` in two, where its blocks may be left with an
    /// acceleration.
    fn part(&self, entries: Vec<Entry>, limit: usize) -> Vec<Entry> {
        let mut out = Vec::with_capacity(entries.len() + 1);
        let mut first = 0;
        for entry in entries {
            let n = entry.blocks.len();
            let parts = (first < limit && limit < first + n && self.may_part(&entry))
                .then(|| entry.split(limit - first))
                .flatten();
            first += n;
            match parts {
                Some(parts) => out.extend(parts),
                None => out.push(entry),
            }
        }
        out
    }

    /// True if a plan may start inside an entry: braking under G901 and what keeps a tolerance are planned as a whole.
    fn may_part(&self, entry: &Entry) -> bool {
        let whole = |q: &Queued| {
            q.block.late_braking || self.kernels.any() && q.block.tolerance.ax_dev_mm.is_some()
        };
        !entry.blocks.iter().map(|b| &b.0).chain(&self.queue).any(|q| whole(q))
    }

    /// Takes planned blocks out of the queue.
    fn dequeue(&mut self, blocks: usize) {
        self.queue.drain(..blocks);
        self.demands.pass(blocks);
        self.programmed = programmed(&self.queue);
    }

    /// How many entries become final; `None` if the first one already reaches into the last window.
    fn final_entries(
        &self,
        entries: &[Entry],
        window: &[Arc<Queued>],
        rests: bool,
    ) -> Option<usize> {
        if rests {
            return Some(entries.len());
        }
        let limit = self.last_window(window);
        let mut blocks = 0;
        let count = entries
            .iter()
            .take_while(|e| {
                blocks += e.blocks.len();
                blocks <= limit
            })
            .count();
        (count > 0).then_some(count)
    }

    /// Puts parts in the place of queued blocks.
    fn divide(&mut self, blocks: Vec<(usize, Vec<Arc<Queued>>)>) {
        for (b, parts) in blocks.into_iter().rev() {
            let mut first = 0;
            for entry in &mut self.reserve {
                if b < first + entry.blocks.len() {
                    entry.divide(b - first, &parts);
                    break;
                }
                first += entry.blocks.len();
            }
            for part in parts[1..].iter().rev() {
                self.queue.insert(b + 1, Arc::clone(part));
                self.caps.insert(b + 1, Cap::new(f64::INFINITY, SpeedLimit::Curve));
            }
            self.queue[b] = Arc::clone(&parts[0]);
            self.demands.insert(b + 1, parts.len() - 1, self.demands.feed[b]);
        }
    }

    /// Makes the next span of the last plan, or the first blocks of it, final, because there is no new plan from where it
    /// starts.
    ///
    /// New blocks can make the window infeasible: with ramps, braking to the crawl that they ask for may be longer than
    /// braking to the rest that was planned, and runs of blocks are joined anew from the cursor on.
    pub(super) fn fall_back(&mut self) -> Option<()> {
        let mut entry = self.reserve.pop_front()?;
        let few = entry.blocks.len().div_ceil(FALL_BACK_PARTS);
        if few < entry.blocks.len()
            && self.may_part(&entry)
            && let Some([now, later]) = entry.split(few)
        {
            self.reserve.push_front(later);
            entry = now;
        }
        entry.stops |= self.reserve.is_empty();
        let blocks = entry.blocks.len();
        entry.caps = self.caps.drain(..blocks).collect();
        self.dequeue(blocks);
        self.append(entry, 0);
        if let Some(next) = self.reserve.front() {
            // a dwell in between
            self.cursor = next.start;
        }
        Some(())
    }

    fn commit(&mut self, mut entries: Vec<Entry>, count: usize) {
        let mut blocks = 0;
        self.reserve = entries.split_off(count).into();
        for mut entry in entries {
            blocks += entry.blocks.len();
            entry.caps = self.caps.drain(..entry.blocks.len()).collect();
            self.append(entry, self.demands.stop[blocks].unwrap_or(0));
        }
        self.dequeue(blocks);
    }

    /// Puts an entry behind the others on the timeline; what follows a stop starts after `dwell` cycles.
    pub(super) fn append(&mut self, entry: Entry, dwell: u32) {
        for (cycles, s, queued) in entry.entries(self.cycle) {
            self.contour.enter(cycles, s, Arc::clone(queued));
        }
        self.travelled = entry.s0 + entry.profile.length();
        self.speed = Cap::new(entry.profile.end().v_mm_s, entry.why_down);
        self.acceleration = entry.profile.left_with();
        self.cursor = entry.end;
        if entry.stops {
            self.cursor = Moment::tick(entry.end.next_tick(self.cycle) + u64::from(dwell));
            (self.speed, self.acceleration) = (Cap::new(0.0, entry.why_down), 0.0);
        }
        self.timeline.push(entry);
    }
}

/// Notes in a plan which entries have been measured in the plan before it, over the same blocks: those with the same profile,
/// and with the same wait in front.
fn recall(plan: &mut [Entry], before: &[Entry], cycle: CycleTime) {
    let waited = |list: &[Entry], i: usize| {
        let end = |p: usize| list[p].end.cycles(cycle);
        i.checked_sub(1).map_or(0.0, |p| list[i].start.cycles(cycle) - end(p))
    };
    let (mut at, mut old, mut behind) = (0, 0, 0);
    for i in 0..plan.len() {
        while before.get(old).is_some_and(|_| behind < at) {
            behind += before[old].blocks.len();
            old += 1;
        }
        if let Some(same) = before.get(old).filter(|e| behind == at && e.kept.is_some())
            && same.blocks.len() == plan[i].blocks.len()
            && same.profile == plan[i].profile
            && (waited(before, old) - waited(plan, i)).abs() < 1.0
        {
            plan[i].kept = same.kept;
        }
        at += plan[i].blocks.len();
    }
}
