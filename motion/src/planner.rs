//! Blocks in, one setpoint per cycle out.
//!
//! Up to two windows of blocks are collected (P-STUP-00071 gives the size of one); then [`crate::lookahead`] plans all
//! of them with a stop at the end of what is known, and all but the last window becomes final. So every block that is
//! executed had at least one window of look-ahead behind it, and planning costs a constant number of closed forms per
//! block. What is final lies on a [`crate::timeline`] that is sampled cycle by cycle.
//!
//! Override and feedhold take back what is final from the next cycle on, bring the speed to its new value and have the
//! rest planned again, see `replan`.

mod replan;

use crate::axis::AxisVec;
use crate::block::Block;
use crate::brake::Brake;
use crate::contour::Contour;
use crate::corner::transition;
use crate::limit::SpeedLimit;
use crate::lookahead::{Cap, plan};
use crate::profile::Infeasible;
use crate::queue::Queued;
use crate::realtime::{FeedholdBraking, Override, OverrideMode, OverrideRatios};
use crate::short::lower_caps;
use crate::timeline::{Entry, Moment, PathState, Timeline};
use crate::tolerance::{Demands, Kernels, Monitor, Trial, Unkept, Verdict};
use kontur_filters::time::CycleTime;
use smallvec::SmallVec;
use std::collections::VecDeque;
use std::sync::Arc;

/// One cycle of the path.
#[derive(Clone, Debug, Default)]
pub struct Setpoint {
    /// Cycle count since the start of the program.
    pub k: u64,
    /// Position of every axis.
    pub position: AxisVec,
    /// Path length since the start of the program in mm.
    pub s_mm: f64,
    /// Path velocity in mm/s.
    pub v_mm_s: f64,
    /// Path acceleration in mm/s2.
    pub a_mm_s2: f64,
    /// Path jerk in mm/s3.
    pub j_mm_s3: f64,
    /// What holds the speed down.
    pub limit: SpeedLimit,
    /// Number of the block in which the setpoint lies.
    pub seq: u64,
}

/// What the planner can do next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// A setpoint was produced, see [`Planner::setpoint`].
    Setpoint,
    /// More blocks, or [`Planner::finish`], are needed first.
    Input,
    /// At rest at the end of everything that was pushed before [`Planner::finish`].
    Rest,
}

/// Look-ahead and interpolation of one channel.
#[derive(Clone, Debug)]
pub struct Planner {
    cycle: CycleTime,
    window: usize,
    queue: VecDeque<Arc<Queued>>,
    /// Caps between the queued blocks; entry `i` stands before block `i`.
    caps: VecDeque<Cap>,
    last: Option<Arc<Queued>>,
    finishing: bool,
    timeline: Timeline,
    /// Where the next span begins.
    cursor: Moment,
    /// Speed there, and what holds it down.
    speed: Cap,
    /// Path length there.
    travelled: f64,
    setpoint: Setpoint,
    state: PathState,
    kernels: Kernels,
    monitor: Monitor,
    contour: Contour,
    reach_cycles: u32,
    unkept: Vec<Unkept>,
    brake: Option<Brake>,
    /// Rest of the last plan, from the cursor to rest.
    reserve: VecDeque<Entry>,
    /// Override and feedhold in effect, and those asked for.
    active: Realtime,
    wanted: Realtime,
}

/// What acts on the path from outside.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
struct Realtime {
    ratios: Override,
    hold: Option<FeedholdBraking>,
}

impl Planner {
    /// A planner at rest at `start`, with a look-ahead of `window` blocks (P-STUP-00071, 10..=10000).
    pub fn new(cycle: CycleTime, window: usize, start: &[f64]) -> Self {
        let position = AxisVec::from_slice(start);
        Self {
            cycle,
            window: window.max(1),
            queue: VecDeque::new(),
            caps: VecDeque::new(),
            last: None,
            finishing: false,
            timeline: Timeline::default(),
            cursor: Moment::default(),
            speed: (0.0, SpeedLimit::Stop),
            travelled: 0.0,
            state: PathState::at_rest(&position),
            setpoint: Setpoint { position, ..Setpoint::default() },
            kernels: Kernels::default(),
            monitor: Monitor::default(),
            contour: Contour::default(),
            reach_cycles: 0,
            unkept: Vec::new(),
            brake: None,
            reserve: VecDeque::new(),
            active: Realtime::default(),
            wanted: Realtime::default(),
        }
    }

    /// The current setpoint.
    pub fn setpoint(&self) -> &Setpoint {
        &self.setpoint
    }

    /// Sets the kernel of every axis, for corners (`ACC_FACT`) and tolerance monitoring; only at rest.
    ///
    /// `reach_cycles` is how far back the contour is kept for [`Planner::deviation`].
    pub fn set_kernels(&mut self, kernels: Kernels, reach_cycles: u32) {
        self.reach_cycles = reach_cycles.max(kernels.length());
        self.monitor.rest(&self.setpoint.position, self.setpoint.s_mm, kernels.length());
        self.kernels = kernels;
    }

    /// Sets what the override is a percentage of (P-CHAN-00066), from the next cycle on.
    pub fn set_override_mode(&mut self, mode: OverrideMode) {
        self.wanted.ratios.mode = mode;
    }

    /// Sets the real-time override, from the next cycle on; setpoints already output stay.
    ///
    /// Feed and rapid blocks that are ahead, known or not, run at the new ratio; acceleration stays continuous with
    /// jerk-limited slopes. 0 brings the path to a standstill in front of, or in, the next block of that kind; time goes
    /// on, [`Self::advance`] produces setpoints at rest. Overrides of the program are in [`Block::feed_ratio`].
    pub fn set_override(&mut self, ratios: OverrideRatios) {
        self.wanted.ratios.ratios = ratios.clamped();
    }

    /// Feedhold on or off, from the next cycle on.
    ///
    /// On: the path brakes on its contour to a standstill and stays there; time goes on, [`Self::advance`] produces
    /// setpoints at rest. Off: it goes on, also out of the braking. `braking` is P-CHAN-00097. Dwells and waits of the
    /// program are the caller's.
    pub fn feedhold(&mut self, on: bool, braking: FeedholdBraking) {
        self.wanted.hold = on.then_some(braking);
    }

    /// At rest although there is something to do: by feedhold or override 0.
    pub fn is_held(&self) -> bool {
        let barred = self.queue.front().is_some_and(|q| q.velocity.0 <= 0.0);
        self.speed.0 <= 0.0 && (self.active.hold.is_some() || barred)
    }

    /// Adds a block behind the ones pushed so far. Its path starts where the one before ends.
    pub fn push(&mut self, block: Block) {
        self.finishing = false;
        let queued = Arc::new(Queued::new(block, self.cycle)).rated(&self.active.ratios);
        let cap = match &self.last {
            Some(last) => transition(
                &last.block,
                &queued.block,
                &last.ends,
                &queued.ends,
                self.cycle,
                self.kernels.any(),
            ),
            None => (0.0, SpeedLimit::Stop),
        };
        self.caps.push_back(cap);
        self.queue.push_back(Arc::clone(&queued));
        lower_caps(&self.queue, &mut self.caps, self.cycle, self.kernels.any());
        self.last = Some(queued);
    }

    /// The path comes to rest behind the last block pushed.
    pub fn finish(&mut self) {
        self.finishing = true;
    }

    /// Produces the next setpoint if it can.
    ///
    /// # Errors
    /// [`Infeasible`] is an internal error: the passes exclude it, and where they do not the last plan goes on.
    pub fn advance(&mut self) -> Result<Next, Infeasible> {
        if self.wanted != self.active {
            self.replan();
        }
        loop {
            let k = self.setpoint.k + 1;
            if self.timeline.advance(k, self.cycle, &mut self.state) {
                self.output(k);
                return Ok(Next::Setpoint);
            }
            if self.queue.is_empty() && self.speed.0 <= 0.0 {
                return Ok(if self.finishing { Next::Rest } else { Next::Input });
            }
            if !self.finishing && self.queue.len() < 2 * self.window {
                return Ok(Next::Input);
            }
            if self.is_held() {
                let hold = self.active.hold.is_some();
                self.hold(if hold { SpeedLimit::Stop } else { SpeedLimit::Feed });
                return Ok(Next::Setpoint);
            }
            self.extend()?;
        }
    }

    /// One more cycle at the current position; only at rest.
    pub fn hold(&mut self, limit: SpeedLimit) {
        self.setpoint.k += 1;
        self.cursor = Moment::tick(self.cursor.origin.max(self.setpoint.k));
        (self.setpoint.v_mm_s, self.setpoint.a_mm_s2, self.setpoint.j_mm_s3) = (0.0, 0.0, 0.0);
        self.setpoint.limit = limit;
        self.monitor.record(&self.setpoint.position, self.setpoint.s_mm);
    }

    /// Emergency braking from here on (P-AXIS-00003): [`Self::advance_braking`] takes the place of [`Self::advance`].
    pub fn brake(&mut self) {
        let mut path: Vec<(f64, Arc<Queued>)> = Vec::new();
        for entry in self.timeline.entries() {
            for (queued, s_end) in &entry.blocks {
                path.push((entry.s0 + s_end - queued.length - queued.offset, Arc::clone(queued)));
            }
        }
        let mut s = self.travelled;
        for queued in &self.queue {
            path.push((s - queued.offset, Arc::clone(queued)));
            s += queued.length;
        }
        self.brake = Some(Brake::new(path, self.setpoint.s_mm, self.setpoint.v_mm_s));
    }

    /// The braking has come to rest.
    pub fn brake_is_over(&self) -> bool {
        self.brake.as_ref().is_none_or(Brake::is_over)
    }

    /// One cycle of braking, or of standstill behind it.
    pub fn advance_braking(&mut self) {
        let Some(brake) = self.brake.as_mut().filter(|b| !b.is_over()) else {
            self.hold(SpeedLimit::Stop);
            return;
        };
        self.setpoint.k += 1;
        if let Some(seq) = brake.step(self.cycle.seconds(), &mut self.setpoint.position) {
            self.setpoint.seq = seq;
        }
        self.setpoint.s_mm = brake.s;
        self.setpoint.a_mm_s2 = if brake.v > 0.0 { -brake.dec } else { 0.0 };
        (self.setpoint.v_mm_s, self.setpoint.j_mm_s3) = (brake.v, 0.0);
        self.setpoint.limit = SpeedLimit::Stop;
    }

    /// Components of the shortest vector from the contour within reach of the filters to `point`; returns its length.
    pub fn deviation(&self, point: &[f64], out: &mut [f64]) -> f64 {
        let now = self.setpoint.k as f64;
        self.contour.deviation(point, now - f64::from(self.reach_cycles), now, out)
    }

    /// Blocks whose tolerance could not be kept since the last call.
    pub fn take_unkept(&mut self) -> Vec<Unkept> {
        std::mem::take(&mut self.unkept)
    }

    fn output(&mut self, k: u64) {
        self.setpoint.k = k;
        self.setpoint.position.copy_from_slice(&self.state.position);
        self.setpoint.s_mm = self.state.s;
        self.setpoint.v_mm_s = self.state.v;
        self.setpoint.a_mm_s2 = self.state.a;
        self.setpoint.j_mm_s3 = self.state.j;
        self.setpoint.limit = self.state.limit;
        self.setpoint.seq = self.state.seq;
        self.monitor.record(&self.setpoint.position, self.setpoint.s_mm);
        self.contour.forget_before(k as f64 - f64::from(self.reach_cycles) - 8.0);
    }

    /// Plans what is queued and makes all but the last window final, or divides queued blocks first.
    fn extend(&mut self) -> Result<(), Infeasible> {
        let free = |q: &&Arc<Queued>| q.velocity.0 > 0.0;
        let window: Vec<Arc<Queued>> = self.queue.iter().take_while(free).cloned().collect();
        let n = window.len();
        // a block without speed ends the path in front of it
        let barred = n < self.queue.len();
        let start = if self.speed.0 > 0.0 {
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
        let mut demands = Demands::none(n);
        let mut forced = vec![false; n + 1];
        let mut round = 0;
        loop {
            let entries = match self.place(&window, &demands, &forced, start, end) {
                Ok(entries) => entries,
                Err(e) => return self.fall_back().ok_or(e),
            };
            let verdict = self.verdict(&window, &entries, round, &mut demands);
            round += 1;
            match verdict {
                Verdict::Kept => {}
                Verdict::Divided(parts) => {
                    self.divide(parts);
                    return Ok(());
                }
                Verdict::Tightened => continue,
                Verdict::GivenUp(unkept) => self.unkept.push(unkept),
            }
            let rests = end != SpeedLimit::Lookahead;
            let Some(count) = self.final_entries(&entries, n, rests) else {
                // one span over more than a window: it is cut where the last window begins
                forced[n - self.window] = true;
                continue;
            };
            self.commit(entries, count, &demands);
            return Ok(());
        }
    }

    /// Examines a plan of the window behind everything that is final, see [`Monitor::examine`].
    fn verdict(
        &self,
        window: &[Arc<Queued>],
        entries: &[Entry],
        round: usize,
        demands: &mut Demands,
    ) -> Verdict {
        let bound = window.iter().any(|q| q.block.tolerance.ax_dev_mm.is_some());
        if !bound || !self.kernels.any() {
            return Verdict::Kept;
        }
        let mut timeline = self.timeline.clone();
        let placed = timeline.entries().count();
        entries.iter().cloned().for_each(|e| timeline.push(e));
        let trial = Trial {
            timeline: &timeline,
            placed,
            window,
            past: &self.contour,
            kernels: &self.kernels,
            cycle: self.cycle,
            now: self.setpoint.k,
            at_rest: self.speed.0 <= 0.0,
        };
        self.monitor.examine(&trial, round, demands)
    }

    /// The way to rest from the cursor on with the tolerance kept; `None` if there is none.
    fn way_out(&mut self) -> Option<Vec<Entry>> {
        loop {
            let free = |q: &&Arc<Queued>| q.velocity.0 > 0.0;
            let window: Vec<_> = self.queue.iter().take_while(free).cloned().collect();
            let mut demands = Demands::none(window.len());
            let forced = vec![false; window.len() + 1];
            let mut round = 0;
            let parts = loop {
                let stop = SpeedLimit::Stop;
                let entries = self.place(&window, &demands, &forced, self.cursor, stop).ok()?;
                match self.verdict(&window, &entries, round, &mut demands) {
                    Verdict::Kept => return Some(entries),
                    Verdict::Divided(parts) => break parts,
                    Verdict::Tightened => round += 1,
                    Verdict::GivenUp(_) => return None,
                }
            };
            self.divide(parts);
        }
    }

    /// Plans the window and places the spans on the time axis.
    fn place(
        &self,
        window: &[Arc<Queued>],
        demands: &Demands,
        forced: &[bool],
        start: Moment,
        end: SpeedLimit,
    ) -> Result<Vec<Entry>, Infeasible> {
        let lower = |cap: Cap, demand: f64| {
            if demand < cap.0 { (demand, SpeedLimit::AxDev) } else { cap }
        };
        let n = window.len();
        let feeds: Vec<Cap> = window
            .iter()
            .enumerate()
            .map(|(i, q)| {
                let floor = if i == 0 { self.speed.0 } else { 0.0 };
                lower(q.velocity, demands.feed[i].max(floor))
            })
            .collect();
        let caps: Vec<Cap> = (0..=n)
            .map(|i| lower(self.caps.get(i).copied().unwrap_or((0.0, end)), demands.cap[i]))
            .collect();
        let forced: Vec<bool> = (0..=n).map(|i| forced[i] || demands.stop[i].is_some()).collect();
        let gentle = demands.soften(window);
        let plan = plan(&gentle, &feeds, &caps, &forced, self.speed, end)?;
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

    /// How many entries become final; `None` if the first one already reaches into the last window.
    fn final_entries(&self, entries: &[Entry], n: usize, rests: bool) -> Option<usize> {
        if rests {
            return Some(entries.len());
        }
        let limit = n.saturating_sub(self.window);
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
                self.caps.insert(b + 1, (f64::INFINITY, SpeedLimit::Curve));
            }
            self.queue[b] = Arc::clone(&parts[0]);
        }
    }

    /// Makes the next span of the last plan final, because there is no new plan from where it starts.
    ///
    /// New blocks can make the window infeasible: with ramps, braking to the crawl that they ask for may be longer than
    /// braking to the rest that was planned, and runs of blocks are joined anew from the cursor on.
    fn fall_back(&mut self) -> Option<()> {
        let mut entry = self.reserve.pop_front()?;
        entry.stops |= self.reserve.is_empty();
        let blocks = entry.blocks.len();
        entry.caps = self.caps.drain(..blocks).collect();
        self.queue.drain(..blocks);
        self.append(entry, 0);
        if let Some(next) = self.reserve.front() {
            // a dwell in between
            self.cursor = next.start;
        }
        Some(())
    }

    fn commit(&mut self, mut entries: Vec<Entry>, count: usize, demands: &Demands) {
        let mut blocks = 0;
        self.reserve = entries.split_off(count).into();
        for mut entry in entries {
            blocks += entry.blocks.len();
            entry.caps = self.caps.drain(..entry.blocks.len()).collect();
            self.append(entry, demands.stop[blocks].unwrap_or(0));
        }
        self.queue.drain(..blocks);
    }

    /// Puts an entry behind the others on the timeline; what follows a stop starts after `dwell` cycles.
    fn append(&mut self, entry: Entry, dwell: u32) {
        for (cycles, s, queued) in entry.entries(self.cycle) {
            self.contour.enter(cycles, s, Arc::clone(queued));
        }
        self.travelled = entry.s0 + entry.profile.length();
        self.speed = (entry.profile.end().v_mm_s, entry.why_down);
        self.cursor = entry.end;
        if entry.stops {
            self.cursor = Moment::tick(entry.end.next_tick(self.cycle) + u64::from(dwell));
            self.speed = (0.0, entry.why_down);
        }
        self.timeline.push(entry);
    }
}
