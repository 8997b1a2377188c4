//! From the queue to the timeline: plans, their examination, and what of them becomes final.

use super::Planner;
use crate::cap::{Cap, SpeedLimit};
use crate::deviation::{Change, What};
use crate::plan::{Start, last_blocks};
use crate::profile::{Infeasible, SlopeLimits};
use crate::queue::Queued;
use crate::timeline::{Entry, Moment, Seen, is_at};
use crate::tolerance::{Demands, Trial, Unkept, Verdict};
use kontur_filters::time::CycleTime;
use std::collections::VecDeque;
use std::sync::Arc;

/// Parts in which a span of the last plan becomes final where there is no new one.
const FALL_BACK_PARTS: usize = 8;

/// What a search for a plan ends in.
pub(super) enum Searched {
    /// A plan that keeps the tolerance.
    Kept(Vec<Entry>),
    /// Blocks to be planned in parts, see [`Verdict::Divided`].
    Divided(Vec<(usize, Vec<Arc<Queued>>)>),
    /// A plan that does not keep it after too many rounds, and the largest excess.
    GivenUp(Vec<Entry>, Unkept),
    /// No speed leads from the start to rest.
    Infeasible(Infeasible),
    /// No plan ends early enough.
    TooLate,
}

impl Planner {
    /// Plans what is queued and makes all but the last window final, or divides queued blocks first.
    pub(super) fn extend(&mut self) -> Result<(), Infeasible> {
        let window = self.plan.window();
        // a block without speed ends the path before it
        let barred = window.len() < self.plan.segments.len();
        let mut start = self.plan.start.moment;
        if self.plan.is_at_rest() {
            start = Moment::tick(start.origin.max(self.setpoint.k));
        }
        let end = if barred {
            SpeedLimit::Feed
        } else if self.ends() {
            SpeedLimit::Stop
        } else {
            SpeedLimit::Lookahead
        };
        self.plan.demands.reach_over(&window, &self.kernels, self.cycle);
        let mut forced = vec![false; window.len() + 1];
        let last_window = last_blocks(&window, self.window);
        let rests = end != SpeedLimit::Lookahead;
        let mut last = None;
        let (mut round, mut given_up) = (0, false);
        loop {
            let ends = (start, end);
            let searched = self.search(&window, &forced, ends, last, &mut round, f64::INFINITY);
            let mut entries = match searched {
                Searched::Kept(entries) if round > 1 && !given_up => {
                    let front = if rests { window.len() } else { last_window };
                    self.rest_instead(&window, &forced, ends, entries, front)
                }
                Searched::Kept(entries) => entries,
                Searched::Divided(parts) => {
                    self.plan.divide(parts, &self.kernels, self.cycle);
                    return Ok(());
                }
                Searched::Infeasible(e) => return self.fall_back().ok_or(e),
                // the plan before this one keeps the tolerance
                Searched::GivenUp(..) | Searched::TooLate if self.fall_back().is_some() => {
                    return Ok(());
                }
                Searched::GivenUp(entries, unkept) => {
                    self.give_up(unkept);
                    given_up = true;
                    entries
                }
                Searched::TooLate => return Ok(()),
            };
            if !rests {
                self.part(&mut entries, last_window);
            }
            let count =
                if rests { Some(entries.len()) } else { entries_before(&entries, last_window) };
            let Some(count) = count else {
                // one span over more than a window: it is cut where the last window begins
                forced[last_window] = true;
                last = Some(entries);
                continue;
            };
            self.commit(entries, count);
            if given_up {
                // what did not help is not tried again
                self.plan.demands = Demands::default();
            }
            return Ok(());
        }
    }

    /// Plans and examines, and again with what the examination asks for, until the tolerance is kept. `last` is the plan before, of
    /// the same blocks (the reserve if there is none), and `round` counts the plans. Gives up where a plan ends at `too_late` (cycles) or later: what is asked for
    /// makes it only slower.
    pub(super) fn search(
        &mut self,
        window: &[Arc<Queued>],
        forced: &[bool],
        ends: (Moment, SpeedLimit),
        mut last: Option<Vec<Entry>>,
        round: &mut usize,
        too_late: f64,
    ) -> Searched {
        loop {
            let mut entries = match self.plan.place(window, forced, ends, self.cycle) {
                Ok(entries) => entries,
                Err(e) => return Searched::Infeasible(e),
            };
            if entries.last().is_some_and(|e| e.end.cycles(self.cycle) >= too_late) {
                return Searched::TooLate;
            }
            let before = last.as_deref().unwrap_or_else(|| self.plan.reserve.make_contiguous());
            recall(&mut entries, before, self.cycle);
            let verdict = self.verdict(&mut entries, *round);
            *round += 1;
            match verdict {
                Verdict::Kept => return Searched::Kept(entries),
                Verdict::Divided(parts) => return Searched::Divided(parts),
                Verdict::Tightened => last = Some(entries),
                Verdict::GivenUp(unkept) => return Searched::GivenUp(entries, unkept),
            }
        }
    }

    /// A tolerance is not kept, and this is reported; the output will show it, too.
    fn give_up(&mut self, unkept: Unkept) {
        self.unkept.push(unkept);
        self.report(|_| What::Told);
    }

    /// Examines a plan of the window after everything that is final, see [`Monitor::examine`].
    ///
    /// [`Monitor::examine`]: crate::tolerance::Monitor::examine
    fn verdict(&mut self, entries: &mut [Entry], round: usize) -> Verdict {
        let mut blocks = entries.iter().flat_map(|e| &e.blocks);
        if !blocks.any(|(q, _)| q.block.tolerance.ax_dev_mm.is_some()) || !self.kernels.any() {
            return Verdict::Kept;
        }
        let mut demands = std::mem::take(&mut self.plan.demands);
        let (verdict, seen) = self.monitor.examine(&self.trial(entries), round, &mut demands);
        self.plan.demands = demands;
        for (entry, seen) in entries.iter_mut().zip(seen) {
            entry.seen = seen;
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
            at_rest: self.plan.is_at_rest(),
        }
    }

    /// The way to rest from the cursor on with the tolerance kept; `None` if there is none.
    pub(super) fn way_out(&mut self) -> Option<Vec<Entry>> {
        loop {
            let window = self.plan.window();
            self.plan.demands.reach_over(&window, &self.kernels, self.cycle);
            let forced = vec![false; window.len() + 1];
            let ends = (self.plan.start.moment, SpeedLimit::Stop);
            match self.search(&window, &forced, ends, Some(Vec::new()), &mut 0, f64::INFINITY) {
                Searched::Kept(entries) => return Some(entries),
                Searched::Divided(parts) => self.plan.divide(parts, &self.kernels, self.cycle),
                Searched::GivenUp(..) | Searched::Infeasible(_) | Searched::TooLate => return None,
            }
        }
    }

    /// Puts the entry that reaches over the start of block `limit` in two, where its blocks may be left with an acceleration.
    fn part(&self, entries: &mut Vec<Entry>, limit: usize) {
        let mut first = 0;
        let over = entries.iter().position(|entry| {
            first += entry.blocks.len();
            first > limit
        });
        let Some(over) = over else { return };
        let entry = &entries[over];
        let before = limit - (first - entry.blocks.len());
        if before > 0
            && self.may_part(entry)
            && let Some([now, later]) = entry.split(before)
        {
            entries[over] = later;
            entries.insert(over, now);
        }
    }

    /// True if a plan may start inside an entry: braking under G901 and what keeps a tolerance are planned as a whole, and
    /// with STEP there is no ramp to continue.
    fn may_part(&self, entry: &Entry) -> bool {
        let whole = |q: &Queued| {
            q.block.late_braking || self.kernels.any() && q.block.tolerance.ax_dev_mm.is_some()
        };
        let ahead = self.plan.segments.iter().map(|s| &s.queued);
        let jumps = |q: &Queued| matches!(q.slope, SlopeLimits::Step(_));
        !entry.blocks.iter().any(|b| jumps(&b.0))
            && !entry.blocks.iter().map(|b| &b.0).chain(ahead).any(|q| whole(q))
    }

    /// Makes the next span of the last plan, or the first blocks of it, final, because there is no new plan from where it
    /// starts.
    ///
    /// New blocks can make the window infeasible: with ramps, braking to the crawl that they ask for may be longer than
    /// braking to the rest that was planned, and runs of blocks are joined anew from the cursor on.
    pub(super) fn fall_back(&mut self) -> Option<()> {
        let mut entry = self.plan.reserve.pop_front()?;
        let few = entry.blocks.len().div_ceil(FALL_BACK_PARTS);
        if few < entry.blocks.len()
            && self.may_part(&entry)
            && let Some([now, later]) = entry.split(few)
        {
            self.plan.reserve.push_front(later);
            entry = now;
        }
        entry.stops |= self.plan.reserve.is_empty();
        entry.hold_to(self.plan.pass(entry.blocks.len()));
        self.append(entry, 0);
        if let Some(next) = self.plan.reserve.front() {
            // a dwell in between
            self.plan.start.moment = next.start;
        }
        Some(())
    }

    fn commit(&mut self, entries: Vec<Entry>, count: usize) {
        let mut entries = VecDeque::from(entries);
        let mut dwells: Vec<u32> = Vec::with_capacity(count);
        let mut blocks = 0;
        for entry in entries.range(..count) {
            blocks += entry.blocks.len();
            dwells.push(self.plan.demands.stop[blocks].unwrap_or(0));
        }
        let mut segments = self.plan.pass(blocks).into_iter();
        for (entry, dwell) in entries.range_mut(..count).zip(dwells) {
            let own = segments.by_ref().take(entry.blocks.len());
            entry.hold_to(own);
            self.enter(entry, dwell);
        }
        self.timeline.extend(entries.drain(..count));
        self.plan.reserve = entries;
        // what ends at a limit rises from there because of it
        if let Some(next) = self.plan.segments.front() {
            let limit = next.cap.lower(next.queued.velocity);
            let speed = &mut self.plan.start.speed;
            if speed.v_mm_s > 0.0 && is_at(speed.v_mm_s, limit) {
                speed.why = limit.why;
            }
        }
    }

    /// Puts an entry after the others on the timeline; what follows a stop starts after `dwell` cycles.
    pub(super) fn append(&mut self, entry: Entry, dwell: u32) {
        self.enter(&entry, dwell);
        self.timeline.push(entry);
    }

    /// Continues after an entry that becomes final.
    fn enter(&mut self, entry: &Entry, dwell: u32) {
        for (cycles, s, queued) in entry.entries(self.cycle) {
            self.contour.enter(cycles, s, Arc::clone(queued));
            if let (Some(changes), Some(passed)) = (&mut self.changes, self.contour.last()) {
                changes.push(Change(What::Enters(passed.clone())));
            }
        }
        let end = entry.profile.end();
        // a rise that is left on its way continues for the reason it began with
        let why = if end.a_mm_s2 > 0.0 { entry.last_rise() } else { entry.why_down };
        let mut start = Start {
            moment: entry.end,
            s_mm: entry.s0 + entry.profile.length(),
            speed: Cap::new(end.v_mm_s, why),
            a_mm_s2: end.a_mm_s2,
        };
        if entry.stops {
            start.moment = Moment::tick(entry.end.next_tick(self.cycle) + u64::from(dwell));
            (start.speed.v_mm_s, start.a_mm_s2) = (0.0, 0.0);
        }
        self.plan.start = start;
    }
}

/// How many entries end before block `limit` of the window or at it; `None` if the first one continues.
fn entries_before(entries: &[Entry], limit: usize) -> Option<usize> {
    let mut blocks = 0;
    let before = entries.iter().take_while(|e| {
        blocks += e.blocks.len();
        blocks <= limit
    });
    Some(before.count()).filter(|count| *count > 0)
}

/// Notes in a plan what has been seen of the plan before it, over the same blocks: of entries with the same profile, and with
/// the same wait in front.
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
        if let Some(same) = before.get(old).filter(|e| behind == at && e.seen != Seen::Nothing)
            && same.blocks.len() == plan[i].blocks.len()
            && same.profile == plan[i].profile
            && (waited(before, old) - waited(plan, i)).abs() < 1.0
        {
            plan[i].seen = same.seen;
        }
        at += plan[i].blocks.len();
    }
}
