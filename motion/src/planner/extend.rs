//! From the queue to the timeline: planning, examination, and making a part of the plan final.

use super::Planner;
use crate::cap::{Cap, SpeedLimit};
use crate::deviation::Unkept;
use crate::deviation::{Change, What};
use crate::plan::{Later, Reserve, Segment, Start, last_blocks};
use crate::profile::{Infeasible, SlopeLimits};
use crate::queue::Queued;
use crate::timeline::{Entry, Moment, Seen, is_at};
use crate::tolerance::{Demands, Marks, Trial, Verdict};
use kontur_filters::time::CycleTime;
use std::collections::VecDeque;
use std::sync::Arc;

/// Number of parts in which a span of the last plan becomes final where there is no new plan.
const FALL_BACK_PARTS: usize = 8;

/// Result of the search for a plan.
pub(super) enum Searched {
    /// A plan that keeps the tolerance.
    Kept(Vec<Entry>),
    /// Blocks to be planned in parts, see [`Verdict::Divided`].
    Divided(Vec<(usize, Vec<Arc<Queued>>)>),
    /// A plan that does not keep the tolerance after too many rounds, and the largest excess.
    GivenUp(Vec<Entry>, Unkept),
    /// No speed profile leads from the start to rest.
    Infeasible(Infeasible),
    /// Every plan ends too late.
    TooLate,
    /// The host stops the planner.
    Stopped,
}

impl Planner {
    /// Plans the queue and makes all but the last window final, or divides queued blocks first.
    pub(super) fn extend(&mut self) -> Result<(), Infeasible> {
        let window = self.plan.window();
        // a block with zero speed ends the path before it
        let barred = window.len() < self.plan.segments.len();
        let ends = (self.start(), self.end(barred));
        let rests = ends.1 != SpeedLimit::Lookahead;
        self.plan.demands.reach_over(&window, &self.kernels, self.cycle);
        let mut forced = vec![false; window.len() + 1];
        let last_window = last_blocks(&window, self.window);
        let mut last = None;
        // without a tolerance nothing changes the demands
        let asked = (!self.is_free()).then(|| self.plan.demands.clone());
        let (mut round, mut given_up) = (0, false);
        loop {
            let (searched, later) = if last.is_none() && !rests && self.is_free() {
                round += 1;
                self.plan_freely(&window, &forced, ends, last_window)
            } else {
                let most = f64::INFINITY;
                let searched = self.search(&window, &forced, ends, last, &mut round, most);
                (searched, Later::default())
            };
            let mut entries = match searched {
                Searched::Kept(entries) if round > 1 && !given_up => {
                    let front = if rests { window.len() } else { last_window };
                    self.hasten(asked.as_ref(), &window, &forced, ends, entries, front)
                }
                Searched::Kept(entries) => entries,
                Searched::Divided(parts) => {
                    self.plan.divide(parts, &self.kernels, self.cycle);
                    return Ok(());
                }
                Searched::Infeasible(e) => return self.fall_back().ok_or(e),
                // the previous plan keeps the tolerance
                Searched::GivenUp(..) | Searched::TooLate if self.fall_back().is_some() => {
                    return Ok(());
                }
                Searched::GivenUp(entries, unkept) => {
                    self.give_up(unkept);
                    given_up = true;
                    entries
                }
                Searched::TooLate | Searched::Stopped => return Ok(()),
            };
            if !rests {
                self.part(&mut entries, last_window);
            }
            let count =
                if rests { Some(entries.len()) } else { entries_before(&entries, last_window) };
            let Some(count) = count else {
                // one span covers more than a window: cut it where the last window begins
                forced[last_window] = true;
                last = Some(entries);
                continue;
            };
            self.commit(entries, later, count);
            if given_up {
                // demands that did not help are not tried again
                self.plan.demands = Demands::default();
            }
            return Ok(());
        }
    }

    /// When the plan begins.
    fn start(&self) -> Moment {
        let start = self.plan.start.moment;
        let now = self.setpoint.k;
        if self.plan.is_at_rest() && start.origin < now { Moment::tick(now) } else { start }
    }

    /// How the plan ends; `barred`: before a block with zero speed.
    fn end(&self, barred: bool) -> SpeedLimit {
        if barred {
            SpeedLimit::Feed
        } else if self.ends() {
            SpeedLimit::Stop
        } else {
            SpeedLimit::Lookahead
        }
    }

    /// The fastest plan out of one that a search has found and what can be made of it; `asked`: the demands before the search,
    /// `front`: the number of blocks that may become final.
    fn hasten(
        &mut self,
        asked: Option<&Demands>,
        window: &[Arc<Queued>],
        forced: &[bool],
        ends: (Moment, SpeedLimit),
        mut entries: Vec<Entry>,
        front: usize,
    ) -> Vec<Entry> {
        if let Some(asked) = asked {
            entries = self.answer_only(asked, window, forced, ends, entries);
        }
        entries = self.rest_instead(window, forced, ends, entries, front);
        self.shorten(window, forced, ends, entries)
    }

    /// Whether no block so far has a tolerance.
    fn is_free(&self) -> bool {
        self.least_tolerance_mm.is_infinite()
    }

    /// A plan of blocks without tolerance, for which nothing has to be searched; with entries for its first `enough` blocks,
    /// because nobody needs those of the others unless the path has to continue along this plan.
    fn plan_freely(
        &mut self,
        window: &[Arc<Queued>],
        forced: &[bool],
        ends: (Moment, SpeedLimit),
        enough: usize,
    ) -> (Searched, Later) {
        match self.plan.place(window, forced, ends, enough, self.cycle) {
            Ok((entries, later)) => (Searched::Kept(entries), later),
            Err(e) => (Searched::Infeasible(e), Later::default()),
        }
    }

    /// Plans and examines repeatedly, with the demands of each examination, until the tolerance is kept. `last` is the
    /// previous plan of the same blocks (the reserve if there is none), `round` counts the plans. Gives up if a plan
    /// ends at `too_late` (cycles) or later, since further demands only make it slower.
    pub(super) fn search(
        &mut self,
        window: &[Arc<Queued>],
        forced: &[bool],
        ends: (Moment, SpeedLimit),
        mut last: Option<Vec<Entry>>,
        round: &mut usize,
        too_late: f64,
    ) -> Searched {
        let mut marks = Marks::default();
        loop {
            if self.is_stopped() {
                return Searched::Stopped;
            }
            let placed = self.plan.place(window, forced, ends, usize::MAX, self.cycle);
            let mut entries = match placed {
                Ok((entries, _)) => entries,
                Err(e) => return Searched::Infeasible(e),
            };
            if entries.last().is_some_and(|e| e.end.cycles(self.cycle) >= too_late) {
                return Searched::TooLate;
            }
            let verdict = if self.monitors() {
                let before = last.as_deref().unwrap_or(self.plan.reserve.entries.make_contiguous());
                recall(&mut entries, before, self.cycle);
                self.verdict(&mut entries, *round, &mut marks)
            } else {
                Verdict::Kept
            };
            // a plan that is measured in a few places only is not a round
            *round += usize::from(!matches!(verdict, Verdict::Again));
            match verdict {
                Verdict::Kept => return Searched::Kept(entries),
                Verdict::Divided(parts) => return Searched::Divided(parts),
                Verdict::Tightened | Verdict::Again => last = Some(entries),
                Verdict::GivenUp(unkept) => return Searched::GivenUp(entries, unkept),
            }
        }
    }

    /// Whether there may be blocks whose tolerance has to be kept.
    fn monitors(&self) -> bool {
        !self.is_free() && self.kernels.any()
    }

    /// Reports a tolerance that is not kept; the output will exceed it as well.
    fn give_up(&mut self, unkept: Unkept) {
        self.unkept.push(unkept);
        self.report(|_| What::Told);
    }

    /// Examines a plan of the window that follows the final part, see [`Monitor::examine`].
    ///
    /// [`Monitor::examine`]: crate::tolerance::Monitor::examine
    fn verdict(&mut self, entries: &mut [Entry], round: usize, marks: &mut Marks) -> Verdict {
        let mut blocks = entries.iter().flat_map(|e| &e.blocks);
        if !blocks.any(|(q, _)| q.block.tolerance.ax_dev_mm.is_some()) {
            return Verdict::Kept;
        }
        let mut demands = std::mem::take(&mut self.plan.demands);
        let (verdict, seen) =
            self.monitor.examine(&self.trial(entries), round, &mut demands, marks);
        self.plan.demands = demands;
        for (entry, seen) in entries.iter_mut().zip(seen) {
            entry.seen = seen;
        }
        verdict
    }

    /// The excess over the tolerance on the timeline, which ends at rest.
    pub(super) fn excess(&self) -> Option<Unkept> {
        if !self.kernels.any() {
            return None;
        }
        self.monitor.excess(&self.trial(&[]))
    }

    pub(super) fn trial<'a>(&'a self, plan: &'a [Entry]) -> Trial<'a> {
        Trial {
            timeline: &self.timeline,
            plan,
            past: &self.contour,
            kernels: &self.kernels,
            cycle: self.cycle,
            now: self.setpoint.k,
            at_rest: self.plan.is_at_rest(),
            stop: self.stop.as_deref(),
        }
    }

    /// The way to rest from the end of the final part that keeps the tolerance; `None` if there is none.
    pub(super) fn way_out(&mut self) -> Option<Vec<Entry>> {
        loop {
            let window = self.plan.window();
            self.plan.demands.reach_over(&window, &self.kernels, self.cycle);
            let forced = vec![false; window.len() + 1];
            let ends = (self.plan.start.moment, SpeedLimit::Stop);
            match self.search(&window, &forced, ends, Some(Vec::new()), &mut 0, f64::INFINITY) {
                Searched::Kept(entries) => return Some(entries),
                Searched::Divided(parts) => self.plan.divide(parts, &self.kernels, self.cycle),
                Searched::GivenUp(..)
                | Searched::Infeasible(_)
                | Searched::TooLate
                | Searched::Stopped => return None,
            }
        }
    }

    /// Splits the entry across the start of block `limit` where its blocks may be left with a non-zero acceleration.
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

    /// Whether a plan may start inside an entry. Braking under G901 and blocks with a tolerance are planned as a whole,
    /// and with STEP there is no ramp to continue.
    fn may_part(&self, entry: &Entry) -> bool {
        let whole = |q: &Queued| {
            q.block.late_braking || self.kernels.any() && q.block.tolerance.ax_dev_mm.is_some()
        };
        let ahead = self.plan.segments.iter().map(|s| &s.queued);
        let jumps = |q: &Queued| matches!(q.slope, SlopeLimits::Step(_));
        !entry.blocks.iter().any(|b| jumps(&b.0))
            && !entry.blocks.iter().map(|b| &b.0).chain(ahead).any(|q| whole(q))
    }

    /// Makes the next span of the last plan, or its first blocks, final, because no new plan can start at its start.
    ///
    /// New blocks can make the window infeasible: with ramps, braking to the low speed that they require may take
    /// longer than the planned braking to rest, and runs of blocks are formed anew from the present start.
    pub(super) fn fall_back(&mut self) -> Option<()> {
        let reserve = self.plan.placed_reserve();
        let mut entry = reserve.pop_front()?;
        let few = entry.blocks.len().div_ceil(FALL_BACK_PARTS);
        if few < entry.blocks.len()
            && self.may_part(&entry)
            && let Some([now, later]) = entry.split(few)
        {
            self.plan.reserve.entries.push_front(later);
            entry = now;
        }
        entry.stops |= self.plan.reserve.entries.is_empty();
        entry.hold_to(self.plan.pass(entry.blocks.len()).iter().map(Segment::limits));
        self.append(entry, 0);
        if let Some(next) = self.plan.reserve.entries.front() {
            // there may be a dwell in between
            self.plan.start.moment = next.start;
        }
        Some(())
    }

    /// Makes the first `count` entries of a plan final; `later` are its spans behind the entries.
    fn commit(&mut self, entries: Vec<Entry>, later: Later, count: usize) {
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
            entry.hold_to(own.map(|segment| segment.limits()));
            self.enter(entry, dwell);
        }
        self.plan.reserve = Reserve::new(entries.split_off(count), later, blocks);
        self.timeline.append(entries);
        // a speed that ends at a limit rises again from there because of that limit
        if let Some(next) = self.plan.segments.front() {
            let limit = next.cap.lower(next.queued.velocity);
            let speed = &mut self.plan.start.speed;
            if speed.v_mm_s > 0.0 && is_at(speed.v_mm_s, limit) {
                speed.why = limit.why;
            }
        }
    }

    /// Appends an entry to the timeline; the entry after a stop starts `dwell` cycles later.
    pub(super) fn append(&mut self, entry: Entry, dwell: u32) {
        self.enter(&entry, dwell);
        self.timeline.push(entry);
    }

    /// Moves the start of the plan to the end of an entry that becomes final.
    fn enter(&mut self, entry: &Entry, dwell: u32) {
        for (cycles, s, queued) in entry.entries(self.cycle) {
            self.contour.enter(cycles, s, Arc::clone(queued));
            if let (Some(changes), Some(passed)) = (&mut self.changes, self.contour.last()) {
                changes.push(Change(What::Enters(passed.clone())));
            }
        }
        let end = entry.profile.end();
        // a rise that is left halfway continues with the reason it began with
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

/// Number of entries that end before or at block `limit` of the window; `None` if the first one extends beyond it.
fn entries_before(entries: &[Entry], limit: usize) -> Option<usize> {
    let mut blocks = 0;
    let before = entries.iter().take_while(|e| {
        blocks += e.blocks.len();
        blocks <= limit
    });
    Some(before.count()).filter(|count| *count > 0)
}

/// Copies the findings about a previous plan of the same blocks to a new plan, for entries with the same profile and
/// the same wait before them.
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
