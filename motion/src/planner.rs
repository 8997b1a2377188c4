//! Blocks in, one setpoint per cycle out.
//!
//! Up to two windows of blocks are collected (P-STUP-00071 is the size of one). Then [`crate::lookahead`] plans all of
//! them with a stop at the end of the known path, and all but the last window becomes final. Every executed block
//! therefore had at least one window of look-ahead after it, and planning costs a constant number of closed forms per
//! block. A plan with constant jerk is left at the end of a block inside a span, with the acceleration it has there; if
//! no new plan can start from such a state, the old one continues for a few blocks. The final part is a
//! [`crate::timeline`] that is sampled cycle by cycle.
//!
//! Override and feedhold revoke the final part from the next cycle on, bring the speed to its new value and plan the
//! remainder again, see `replan`. The part that is not final is a single plan, see `plan`.
//!
//! Order of calls: set kernels and modes at rest, call [`Planner::push`] until [`Planner::advance`] no longer returns
//! [`Next::Input`], [`Planner::finish`] after the last block, then [`Planner::advance`] until [`Next::Rest`].
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! # use kontur_filters::time::CycleTime;
//! use kontur_motion::planner::{Next, Planner};
//!
//! let mut planner = Planner::new(CycleTime::from_us(1000).unwrap(), 10, &[0.0, 0.0]);
//! planner.push(block(7, [0.0, 0.0], [5.0, 0.0], 50.0));
//! // a window of look-ahead is missing
//! assert_eq!(planner.advance().unwrap(), Next::Input);
//! planner.finish();
//! assert_eq!(planner.advance().unwrap(), Next::Setpoint);
//! assert_eq!(planner.setpoint().seq, 7);
//! while planner.advance().unwrap() == Next::Setpoint {}
//! assert_eq!(planner.setpoint().s_mm, 5.0);
//! ```

mod extend;
mod feedhold;
mod halt;
mod replan;
mod rests;
mod sharp;
mod spent;
mod stopped;
mod timed;

use crate::ahead::Ahead;
use crate::axis::AxisVec;
use crate::block::{Block, Feed, SpareBlocks};
use crate::cap::{Cap, SpeedLimit};
use crate::contour::Contour;
use crate::deviation::Unkept;
use crate::deviation::{Change, What};
use crate::emergency::EmergencyBraking;
use crate::junction::transition;
use crate::limits::SlopeTable;
use crate::plan::{Plan, Segment, Start};
use crate::profile::Infeasible;
use crate::queue::Queued;
use crate::realtime::{FeedholdBraking, Override, OverrideMode, OverrideRatios};
use crate::timeline::{Moment, PathState, Timeline};
use crate::tolerance::{Kernels, Monitor};
use kontur_filters::time::CycleTime;
use spent::Spent;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
pub(crate) use timed::Corners;

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
    /// Reason for the present speed.
    pub limit: SpeedLimit,
    /// Number of the block that contains the setpoint.
    pub seq: u64,
}

/// What the planner can do next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// A setpoint was produced, see [`Planner::setpoint`].
    Setpoint,
    /// More blocks, or [`Planner::finish`], are needed first.
    Input,
    /// At rest at the end of everything that was pushed before [`Planner::finish`], or where the path halts
    /// ([`Planner::halts`]).
    Rest,
    /// Stopped by its host ([`Planner::stop_with`]): there are no more setpoints.
    Stopped,
}

/// Look-ahead and interpolation of one channel.
#[derive(Clone, Debug)]
pub struct Planner {
    cycle: CycleTime,
    window: usize,
    last: Option<Arc<Queued>>,
    /// Tables of the last feed block and of the last rapid one.
    slopes: [Option<SlopeTable>; 2],
    finishing: bool,
    /// The final part of the path, and its contour.
    timeline: Timeline,
    contour: Contour,
    /// The part after it.
    plan: Plan,
    setpoint: Setpoint,
    state: PathState,
    kernels: Kernels,
    monitor: Monitor,
    reach_cycles: u32,
    unkept: Vec<Unkept>,
    /// Least tolerance of any block so far in mm.
    least_tolerance_mm: f64,
    /// Changes for a meter of the output that have not been taken yet; `None` without a meter.
    changes: Option<Vec<Change>>,
    /// Cycle in which the kernels were set.
    kernels_since: Option<u64>,
    brake: Option<EmergencyBraking>,
    /// Segments after the point where the path halts, if it is to halt.
    halted: Option<Vec<Segment>>,
    /// Override and feedhold in effect, and the requested ones.
    active: Realtime,
    wanted: Realtime,
    spent: Spent,
    /// Set by the host to end the output.
    stop: Option<Arc<AtomicBool>>,
}

/// External influences on the path.
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
            last: None,
            slopes: [None, None],
            finishing: false,
            timeline: Timeline::default(),
            contour: Contour::default(),
            plan: Plan::default(),
            state: PathState::at_rest(&position),
            setpoint: Setpoint { position, ..Setpoint::default() },
            kernels: Kernels::default(),
            monitor: Monitor::default(),
            reach_cycles: 0,
            unkept: Vec::new(),
            least_tolerance_mm: f64::INFINITY,
            changes: None,
            kernels_since: None,
            brake: None,
            halted: None,
            active: Realtime::default(),
            wanted: Realtime::default(),
            spent: Spent::default(),
            stop: None,
        }
    }

    /// The current setpoint.
    pub fn setpoint(&self) -> &Setpoint {
        &self.setpoint
    }

    /// Sets the kernel of every axis, for corners (`ACC_FACT`) and tolerance monitoring; only at rest.
    ///
    /// `reach_cycles` is how far back the contour is kept for [`Planner::take_changes`].
    pub fn set_kernels(&mut self, kernels: Kernels, reach_cycles: u32) {
        self.reach_cycles = reach_cycles.max(kernels.length());
        self.monitor.rest(&self.setpoint.position, self.setpoint.s_mm, kernels.length());
        self.kernels = kernels;
        self.kernels_since = Some(self.setpoint.k);
        self.report(|planner| {
            let Setpoint { k, position, .. } = &planner.setpoint;
            let (reach_cycles, differ) = (planner.reach_cycles, planner.kernels.differ());
            What::Kernels { reach_cycles, differ, at: Some((*k, position.clone())) }
        });
    }

    /// The kernels, see [`Self::set_kernels`].
    pub fn kernels(&self) -> &Kernels {
        &self.kernels
    }

    /// Sets the value that the override is a percentage of (P-CHAN-00066), from the next cycle on.
    pub fn set_override_mode(&mut self, mode: OverrideMode) {
        self.wanted.ratios.mode = mode;
    }

    /// Sets the real-time override from the next cycle on; setpoints already output stay.
    ///
    /// All feed and rapid blocks ahead, pushed or not, run at the new ratio; with jerk-limited slopes the acceleration
    /// stays continuous. 0 brings the path to a standstill before, or in, the next block of that kind; time continues,
    /// and [`Self::advance`] produces setpoints at rest. The override of the program is in [`Block::feed_ratio`].
    pub fn set_override(&mut self, ratios: OverrideRatios) {
        self.wanted.ratios.ratios = ratios.clamped();
    }

    /// Feedhold on or off, from the next cycle on.
    ///
    /// On: the path brakes on its contour to a standstill and stays there; time continues, and [`Self::advance`]
    /// produces setpoints at rest. Off: it continues, also while still braking. `braking` is P-CHAN-00097. The caller
    /// handles dwells and waits of the program.
    pub fn feedhold(&mut self, on: bool, braking: FeedholdBraking) {
        self.wanted.hold = on.then_some(braking);
    }

    /// Whether the path is at rest with blocks pending, because of feedhold or override 0.
    pub fn is_held(&self) -> bool {
        self.plan.is_at_rest() && (self.active.hold.is_some() || self.plan.is_barred())
    }

    /// Drops the path ahead after feedhold has brought it to rest: the next block starts at the present position.
    pub fn drop_ahead(&mut self) {
        if self.is_held() {
            let start = Start { speed: Cap::STOP, a_mm_s2: 0.0, ..self.plan.start };
            self.plan = Plan::from_state(start);
            (self.last, self.halted) = (None, None);
        }
    }

    /// Appends a block. Its path starts at the end of the previous one.
    pub fn push(&mut self, block: impl Into<Box<Block>>) {
        let block = block.into();
        match sharp::parts(&block) {
            Some(parts) => parts.into_iter().for_each(|part| self.enqueue(part.into())),
            None => self.enqueue(block),
        }
    }

    fn enqueue(&mut self, block: Box<Block>) {
        self.finishing = false;
        let table = &mut self.slopes[usize::from(block.feed == Feed::Rapid)];
        table.take_if(|table| !table.serves(&block));
        let table = table.get_or_insert_with(|| SlopeTable::of(&block, self.cycle));
        let queued = self.spent.place(block, table, &self.active.ratios);
        let cap = match &self.last {
            Some(last) => transition(
                &last.block,
                &queued.block,
                &last.ends,
                &queued.ends,
                self.cycle,
                self.kernels.any(),
            ),
            None => Cap::STOP,
        };
        if let Some(tolerance) = queued.block.tolerance.ax_dev_mm {
            self.report_changes(true);
            if tolerance < self.least_tolerance_mm {
                self.least_tolerance_mm = tolerance;
                self.report(|_| What::Tolerance(tolerance));
            }
        }
        let segment = Segment { queued: Arc::clone(&queued), cap, asked: None };
        self.plan.push(segment, self.cycle, self.kernels.any());
        self.last = Some(queued);
    }

    /// The last block pushed.
    pub fn last_block(&self) -> Option<&Block> {
        self.last.as_ref().map(|queued| &*queued.block)
    }

    /// Blocks that have been left, whose memory the caller may use for the next ones.
    pub fn spent_blocks(&mut self) -> &mut SpareBlocks {
        &mut self.spent.blocks
    }

    /// Lets the path come to rest after the last block pushed.
    pub fn finish(&mut self) {
        self.finishing = true;
    }

    /// Whether the path comes to rest after the planned part.
    fn ends(&self) -> bool {
        self.finishing || self.halted.is_some()
    }

    /// Produces the next setpoint if possible.
    ///
    /// # Errors
    /// [`Infeasible`] is an internal error: the passes exclude it, and where they do not the last plan continues.
    pub fn advance(&mut self) -> Result<Next, Infeasible> {
        if self.wanted != self.active {
            self.replan();
        }
        loop {
            // a plan whose search was cut short is never output
            if self.is_stopped() {
                return Ok(Next::Stopped);
            }
            let k = self.setpoint.k + 1;
            if self.timeline.advance(k, self.cycle, &mut self.state) {
                self.output(k);
                return Ok(Next::Setpoint);
            }
            if self.plan.segments.is_empty() && self.plan.is_at_rest() {
                return Ok(if self.ends() { Next::Rest } else { Next::Input });
            }
            if !self.ends() && self.plan.programmed() < 2 * self.window {
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

    /// Reads up to `most` setpoints of the coming cycles: final ones, which [`Self::advance`] would produce without
    /// planning anything; none of block `before` or of a later one.
    pub fn look_ahead(&self, most: usize, before: u64, out: &mut Ahead) {
        let settled = self.wanted == self.active && self.unkept.is_empty() && !self.is_held();
        let most = if settled { most } else { 0 };
        let k = self.setpoint.k + 1;
        let axes = self.setpoint.position.len();
        out.read((&self.timeline, self.cycle), axes, k, most, before);
    }

    /// Produces the first setpoints of those that were read, up to number `last`, see [`crate::ahead`]: that one is what remains.
    pub fn take(&mut self, ahead: &Ahead, last: usize) {
        self.timeline.drop_first(ahead.entries(last));
        let count = last + 1;
        for i in count.saturating_sub(self.monitor.remembers())..last {
            ahead.state(i, &mut self.state);
            self.monitor.record(&self.state.position, self.state.s);
        }
        ahead.state(last, &mut self.state);
        self.output(self.setpoint.k + count as u64);
    }

    /// Lets the next motion begin a share of a cycle (0 to 1) after the present one; only at rest. Its setpoints are those
    /// of its profile at these moments. A cycle of [`Self::hold`] before it ends the share.
    pub fn begin_within_cycle(&mut self, share: f64) {
        let start = &mut self.plan.start;
        let tick = Moment::tick(start.moment.origin.max(self.setpoint.k));
        start.moment = tick.plus(share * self.cycle.seconds());
    }

    /// Repeats the present position for one more cycle; only at rest.
    pub fn hold(&mut self, limit: SpeedLimit) {
        self.setpoint.k += 1;
        let start = &mut self.plan.start;
        start.moment = Moment::tick(start.moment.origin.max(self.setpoint.k));
        (self.setpoint.v_mm_s, self.setpoint.a_mm_s2, self.setpoint.j_mm_s3) = (0.0, 0.0, 0.0);
        self.setpoint.limit = limit;
        self.monitor.record(&self.setpoint.position, self.setpoint.s_mm);
    }

    /// Starts emergency braking (P-AXIS-00003); [`Self::advance_braking`] replaces [`Self::advance`] from here on.
    pub fn brake(&mut self) {
        let mut path: Vec<(f64, Arc<Queued>)> = Vec::new();
        for entry in self.timeline.entries() {
            for (queued, s_end) in &entry.blocks {
                path.push((entry.s0 + s_end - queued.length - queued.offset, Arc::clone(queued)));
            }
        }
        let mut s = self.plan.start.s_mm;
        for Segment { queued, .. } in &self.plan.segments {
            path.push((s - queued.offset, Arc::clone(queued)));
            s += queued.length;
        }
        self.brake = Some(EmergencyBraking::new(path, self.setpoint.s_mm, self.setpoint.v_mm_s));
    }

    /// Whether the braking has come to rest.
    pub fn brake_is_over(&self) -> bool {
        self.brake.as_ref().is_none_or(EmergencyBraking::is_over)
    }

    /// One cycle of braking, or of standstill after it.
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

    /// Reports the changes that a [`Meter`](crate::deviation::Meter) needs, from here on or (`always` false) from the
    /// first block with a tolerance on: the output is measured from there, even if nobody reads it.
    pub fn report_changes(&mut self, always: bool) {
        if !always && self.least_tolerance_mm.is_infinite() {
            self.changes = None;
        } else if self.changes.is_none() {
            let (reach_cycles, differ) = (self.reach_cycles, self.kernels.differ());
            let Setpoint { k, position, .. } = &self.setpoint;
            let at = (self.kernels_since == Some(*k)).then(|| (*k, position.clone()));
            let kernels = What::Kernels { reach_cycles, differ, at };
            let so_far = [What::Contour(self.contour.clone()), kernels];
            self.changes = Some(so_far.map(Change).into());
        }
    }

    /// Whether [`Self::take_changes`] returns changes, now or later.
    pub fn reports_changes(&self) -> bool {
        self.changes.is_some()
    }

    /// The changes since the last call.
    pub fn take_changes(&mut self) -> impl Iterator<Item = Change> + '_ {
        // there are none in most cycles
        let changes = self.changes.as_mut().filter(|changes| !changes.is_empty());
        changes.into_iter().flat_map(|changes| changes.drain(..))
    }

    fn report(&mut self, what: impl FnOnce(&Self) -> What) {
        if self.changes.is_some() {
            let change = Change(what(self));
            self.changes.get_or_insert_default().push(change);
        }
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
        let before = k as f64 - f64::from(self.reach_cycles) - 8.0;
        let left = self.contour.forget_before(before, |queued| self.spent.keep(queued));
        if left > 0 {
            self.report(|_| What::Leave(left));
        }
    }
}
