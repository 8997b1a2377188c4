//! Tolerance monitoring (`AX_DEV`): the filtered setpoints of a plan, before it becomes final.
//!
//! TF5250 gives the task: every axis keeps within `AX_DEV` of the contour. What that means is drawn in
//! [`crate::deviation`]; the formulas here are derived.
//!
//! # The deviation as a functional of the speed
//!
//! The path is `q(s)`, a plan is `s(t)`. A filter with the weights `h_k` (sum 1) and the delays `t_k` makes of them the set
//! point `y(t) = sum h_k q(s(t - t_k))`: it depends on the path lengths of the last kernel length, and on nothing else. Call
//! the mean over the weights `E`, and `m = E[s]` the mean path length. Around `m` the path is a straight line plus its kinks
//! `du_b` at `s_b` and its bends `q''`, and the line has no part in the deviation:
//!
//! ```text
//! y - q(m) = sum over kinks of du_b E[beyond(s, s_b)] + integral of q''(r) E[beyond(s, r)] dr
//! beyond(s, r) = (s - r)+ where r lies behind m, (r - s)+ where it lies before
//! ```
//!
//! - A straight line is never left, however the speed changes: starts and stops cost nothing there.
//! - One corner at the speed `v`: `du v M1` at worst, `M1` half the mean absolute deviation of the kernel from its delay. An
//!   acceleration `a` beside it adds `du a M2 / 2`, so a rest alone leaves something; a rest as long as the kernel leaves
//!   nothing, because all of `s` then lies on one side of the corner.
//! - A bend at even speed: `v^2 kappa / 2` times the variance of the kernel.
//! - Along one stretch run through evenly the deviation falls with the speed, at kinks with `v`, on bends with `v^2`. So with
//!   positive weights there is always a plan that keeps the tolerance, unless its cause is final already.
//! - The deviation is not monotone: a faster run over several bends can cancel what a slower one adds up. What is asked for
//!   is the lowest speed that is too fast.
//! - Kernels that differ between the axes have a mean path length each. A line is then left by the speed times the
//!   difference of the delays: rests do not help, an even speed does.
//! - Negative weights (windowed sinc) make no mean: the set point swings beyond ends, and no dwell helps; the blocks on both
//!   sides start and stop with a lower acceleration, see [`crate::overshoot`].
//!
//! # How it is kept
//!
//! By trying: every plan is sampled on the cycle grid, filtered with the taps of the axes and measured both ways, as the
//! trace will be ([`search`]). What exceeds the tolerance is put down to kinks and bends by their parts in the sum above
//! ([`blame`]): an isolated corner is passed more slowly, then rests, then waits; likes within one kernel length share the
//! even speed that keeps the tolerance. Then the window is planned again ([`tighten`]).
//!
//! Exact, but for [`MARGIN_MM`]: set points; kinks of the contour; the places where the nearest point passes from one block,
//! or one part of the set path, to another (halvings). Where two vectors could be taken for the shortest, the larger
//! component counts. Between the kinks points of the contour are looked at up to four times in a cycle, and set points
//! half way on bent blocks.
//!
//! Bounded instead of measured: where the set point is certainly closer than the tolerance to the point of the contour that
//! goes with it ([`bound`]); stretches of constant speed on one line, where one set point stands for all.
//!
//! Neither: the choice of who slows down. It keeps the tolerance, but is no optimum; `motion/tests/promise.rs` compares it
//! with the best even speed (`EVEN=1`).
//!
//! Set at the planner at rest; what could not be kept is told by [`crate::planner::Planner::take_unkept`].
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! # use kontur_filters::time::CycleTime;
//! use kontur_filters::vib_guard::VibGuardSettings;
//! use kontur_motion::block::Tolerance;
//! use kontur_motion::planner::{Next, Planner};
//! use kontur_motion::tolerance::Kernels;
//!
//! let cycle = CycleTime::from_us(1000).unwrap();
//! let guard = VibGuardSettings { mode: 1, freq_hz: 40.0, damping: 0.1 };
//! let kernel = Arc::new(guard.kernel(cycle).unwrap());
//! let seconds = |ax_dev_mm: Option<f64>| {
//!     let mut planner = Planner::new(cycle, 10, &[0.0, 0.0]);
//!     let kernels = Kernels::new(vec![Some(Arc::clone(&kernel)); 2]);
//!     let reach = kernels.length();
//!     planner.set_kernels(kernels, reach);
//!     for (seq, from, to) in [(1, [0.0, 0.0], [10.0, 0.0]), (2, [10.0, 0.0], [10.0, 10.0])] {
//!         let mut block = block(seq, from, to, 100.0);
//!         block.tolerance = Tolerance { ax_dev_mm, ..Tolerance::default() };
//!         planner.push(block);
//!     }
//!     planner.finish();
//!     while planner.advance().unwrap() == Next::Setpoint {}
//!     assert!(planner.take_unkept().is_empty());
//!     cycle.time_of(planner.setpoint().k)
//! };
//! // the promise costs time
//! assert!(seconds(Some(0.001)) > seconds(None));
//! ```

mod blame;
mod bound;
mod even;
mod measure;
mod search;
mod tighten;
mod view;

use crate::asked::Asked;
use crate::axis::AxisVec;
use crate::contour::Contour;
use crate::queue::Queued;
use crate::timeline::{Entry, Moment, Timeline};
use blame::Findings;
use even::{foresee, foresees};
use kontur_filters::kernel::Kernel;
use kontur_filters::time::CycleTime;
use measure::{Record, Violation};
use search::joined;
use std::borrow::Cow;
use std::collections::VecDeque;
use std::sync::Arc;
use view::View;

/// Part of the tolerance kept in hand, in mm: two digits below the last one of a trace.
const MARGIN_MM: f64 = 2e-7;
/// How far behind the kernel a block may have been left and still count as within reach, in cycles: nobody can tell
/// from a trace on which side of a sample a border lies.
const BORDER_CYCLES: f64 = 5.0;
/// Taps of a kernel in the search for an even speed.
const COARSE: usize = 24;
/// Raw setpoints kept, in lengths of the kernel: set points of one length, and one more in front of a stretch.
const HELD: usize = 3;
/// Rounds of planning after which the causes of an excess stop and dwell for the whole kernel.
const ROUNDS_OF_SPEED: usize = 64;
/// Rounds more for every block.
const ROUNDS_PER_BLOCK: usize = 2;
/// Rounds of planning after which the tolerance is given up with a message.
const ROUNDS: usize = 96;

/// The filter kernels of the axes of a channel.
#[derive(Clone, Debug, Default)]
pub struct Kernels {
    axes: Vec<Option<Arc<Kernel>>>,
    /// A kernel with negative weights overshoots where the path starts and stops, straight blocks included.
    overshoot: bool,
    /// Not all axes have the same kernel.
    unequal: bool,
    /// Delay of the longest kernel in cycles.
    delay: f64,
    /// Every axis' kernel in few taps: weights, and mean delays in cycles.
    coarse: Vec<Vec<(f64, f64)>>,
}

impl Kernels {
    /// One kernel per axis, `None` without one.
    pub fn new(axes: Vec<Option<Arc<Kernel>>>) -> Self {
        let mut taps = axes.iter().flatten().flat_map(|k| k.taps());
        let overshoot = taps.any(|tap| tap.weight < 0.0);
        let unequal = axes.windows(2).any(|pair| pair[0] != pair[1]);
        let delay = longest(&axes).map_or(0.0, Kernel::delay_cycles);
        let coarse = axes.iter().map(|k| k.as_ref().map_or_else(|| vec![(1.0, 0.0)], coarse));
        let coarse = coarse.collect();
        Self { axes, overshoot, unequal, delay, coarse }
    }

    /// True if any axis has a kernel.
    pub fn any(&self) -> bool {
        self.axes.iter().any(Option::is_some)
    }

    /// Cycles until every axis is constant after the path has come to rest.
    pub fn length(&self) -> u32 {
        self.axes.iter().flatten().map(|k| k.length()).max().unwrap_or(0)
    }

    /// True if not all axes have the same kernel.
    pub(crate) fn differ(&self) -> bool {
        self.unequal
    }

    fn longest(&self) -> Option<&Kernel> {
        longest(&self.axes)
    }

    fn get(&self, i: usize) -> Option<&Kernel> {
        self.axes.get(i).and_then(|k| k.as_deref())
    }
}

fn longest(axes: &[Option<Arc<Kernel>>]) -> Option<&Kernel> {
    axes.iter().flatten().max_by_key(|k| k.length()).map(|k| &**k)
}

/// A kernel of many taps in few.
fn coarse(kernel: &Arc<Kernel>) -> Vec<(f64, f64)> {
    let taps = kernel.taps();
    let parts = taps.chunks(taps.len().div_ceil(COARSE)).filter_map(|part| {
        let weight: f64 = part.iter().map(|t| t.weight).sum();
        let delay: f64 = part.iter().map(|t| t.weight * f64::from(t.delay)).sum();
        (weight.abs() > 0.0).then(|| (weight, delay / weight))
    });
    parts.collect()
}

/// A block whose tolerance could not be kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unkept {
    /// Number of the block.
    pub seq: u64,
    /// Deviation that is left in mm.
    pub deviation_mm: f64,
    /// Tolerance in mm.
    pub tolerance_mm: f64,
}

/// What the examination of a plan ends in.
#[derive(Debug)]
pub(crate) enum Verdict {
    /// It keeps the tolerance.
    Kept,
    /// Blocks of the window, by their index, to be planned in parts: they bend too much in one place only.
    Divided(Vec<(usize, Vec<Arc<Queued>>)>),
    /// It does not; the demands are tightened.
    Tightened,
    /// It does not after too many rounds. The largest excess.
    GivenUp(Unkept),
}

/// What the monitor asks of the blocks ahead, one entry per boundary or block of the window; it stays with them when the
/// window moves on.
#[derive(Clone, Debug)]
pub(crate) struct Demands {
    /// Velocity cap at each boundary.
    pub(crate) cap: Vec<f64>,
    /// Full stop at the boundary with this many cycles of dwell.
    pub(crate) stop: Vec<Option<u32>>,
    /// Velocity cap of each block.
    pub(crate) feed: Vec<f64>,
    /// Part of its acceleration that each block may use.
    acceleration: Vec<f64>,
    /// Speed and excess at each boundary when it was last found too fast.
    tried: Vec<Option<(f64, f64)>>,
    /// First boundary whose even speed is not known yet, see [`foresee`].
    foreseen: usize,
}

impl Default for Demands {
    fn default() -> Self {
        let (cap, stop, tried) = (vec![f64::INFINITY], vec![None], vec![None]);
        Self { cap, stop, feed: Vec::new(), acceleration: Vec::new(), tried, foreseen: 0 }
    }
}

impl Demands {
    /// What was asked of blocks before, when they are planned once more: it depends on the contour and the filters more than
    /// on the rest of the plan, and the search for it takes many rounds. The path gets to the first block in another state.
    pub(crate) fn again(blocks: impl Iterator<Item = Asked>) -> Self {
        let mut demands = Self::default();
        for Asked { cap, stop, feed, acceleration } in blocks {
            // the boundary in front of the block; a new one behind it
            if let (Some(last), Some(rest), false) =
                (demands.cap.last_mut(), demands.stop.last_mut(), demands.feed.is_empty())
            {
                (*last, *rest) = (cap, stop);
            }
            demands.cap.push(f64::INFINITY);
            demands.stop.push(None);
            demands.tried.push(None);
            demands.feed.push(feed);
            demands.acceleration.push(acceleration);
        }
        demands
    }

    /// What is asked of a block and of the boundary in front of it; `None` if it has not been planned yet.
    pub(crate) fn of(&self, block: usize) -> Option<Asked> {
        Some(Asked {
            feed: *self.feed.get(block)?,
            cap: self.cap[block],
            stop: self.stop[block],
            acceleration: self.acceleration[block],
        })
    }

    /// Adds what is known of blocks before they are planned: axes whose filters have different delays leave a straight line
    /// by the speed times the difference, so a line long enough to be run through evenly has a speed of its own.
    pub(crate) fn reach_over(
        &mut self,
        window: &[Arc<Queued>],
        kernels: &Kernels,
        cycle: CycleTime,
    ) {
        let known = self.feed.len();
        self.insert(known, window.len().saturating_sub(known), f64::INFINITY);
        if !kernels.unequal {
            return;
        }
        let delay = |i: usize| kernels.get(i).map_or(0.0, Kernel::delay_cycles) * cycle.seconds();
        for (queued, feed) in window.iter().zip(&mut self.feed).skip(known) {
            let Some(tolerance) = queued.block.tolerance.ax_dev_mm else { continue };
            if !queued.block.path.is_straight() {
                continue;
            }
            let u = &queued.ends.tangent_in;
            let norm: f64 = u.iter().map(|c| c * c).sum();
            let along: f64 =
                u.iter().enumerate().map(|(i, c)| c * c * delay(i)).sum::<f64>() / norm;
            let aside = |(i, c): (usize, &f64)| (c * (delay(i) - along)).abs();
            let speed = tolerance / u.iter().enumerate().map(aside).fold(0.0, f64::max);
            if speed * f64::from(kernels.length()) * cycle.seconds() <= queued.length {
                *feed = speed;
            }
        }
    }

    /// Makes room for `count` blocks in front of block `at`, held to nothing but a speed.
    pub(crate) fn insert(&mut self, at: usize, count: usize, feed: f64) {
        fn fill<T: Clone>(list: &mut Vec<T>, at: usize, count: usize, value: T) {
            list.splice(at..at, std::iter::repeat_n(value, count));
        }
        fill(&mut self.cap, at, count, f64::INFINITY);
        fill(&mut self.stop, at, count, None);
        fill(&mut self.tried, at, count, None);
        fill(&mut self.feed, at, count, feed);
        fill(&mut self.acceleration, at, count, 1.0);
        self.foreseen = self.foreseen.min(at);
    }

    /// Forgets the first blocks, which are final. The boundary behind them has only what is asked of it from now on.
    pub(crate) fn pass(&mut self, blocks: usize) {
        self.cap.drain(..blocks);
        self.stop.drain(..blocks);
        self.tried.drain(..blocks);
        self.feed.drain(..blocks);
        self.acceleration.drain(..blocks);
        (self.cap[0], self.stop[0], self.tried[0]) = (f64::INFINITY, None, None);
        self.foreseen = self.foreseen.saturating_sub(blocks);
    }

    /// The blocks with the acceleration that is left to them.
    pub(crate) fn soften<'a>(&self, window: &'a [Arc<Queued>]) -> Cow<'a, [Arc<Queued>]> {
        if self.acceleration.iter().all(|ratio| *ratio >= 1.0) {
            return Cow::Borrowed(window);
        }
        let soften = |(queued, ratio): (&Arc<Queued>, &f64)| {
            if *ratio >= 1.0 {
                return Arc::clone(queued);
            }
            let mut soft = Queued::clone(queued);
            soft.slope = soft.slope.scaled(*ratio);
            Arc::new(soft)
        };
        Cow::Owned(window.iter().zip(&self.acceleration).map(soften).collect())
    }
}

/// Raw setpoints of the last cycles, with the path length.
#[derive(Clone, Debug, Default)]
pub(crate) struct Monitor {
    history: VecDeque<(AxisVec, f64)>,
    length: usize,
}

/// A plan under examination.
pub(crate) struct Trial<'a> {
    /// What is final.
    pub(crate) timeline: &'a Timeline,
    /// The plan behind it.
    pub(crate) plan: &'a [Entry],
    pub(crate) past: &'a Contour,
    pub(crate) kernels: &'a Kernels,
    pub(crate) cycle: CycleTime,
    /// Last cycle that was output.
    pub(crate) now: u64,
    /// The path is at rest where the plan starts: the start can wait.
    pub(crate) at_rest: bool,
}

impl Monitor {
    /// The path rests at `position`; the kernels reach `length` cycles back.
    pub(crate) fn rest(&mut self, position: &AxisVec, s_mm: f64, length: u32) {
        self.length = if length > 0 { HELD * length as usize + 8 } else { 0 };
        self.history = std::iter::repeat_n((position.clone(), s_mm), self.length).collect();
    }

    /// Takes the setpoint of a cycle.
    pub(crate) fn record(&mut self, position: &AxisVec, s_mm: f64) {
        if self.length > 0 {
            self.history.push_back((position.clone(), s_mm));
            if self.history.len() > self.length {
                self.history.pop_front();
            }
        }
    }

    /// What of the final part of a trial does not keep the tolerance.
    pub(crate) fn excess(&self, trial: &Trial<'_>) -> Option<Unkept> {
        View::new(trial, self).search(&[(trial.now + 1, u64::MAX)], |_, _| ())
    }

    /// Examines a plan, and tightens the demands if it does not keep the tolerance.
    ///
    /// Of a plan that has been examined before only what has changed is measured, and last of all, if that keeps the
    /// tolerance, what has moved in time: the set points lie elsewhere then. Returns for every entry where it was measured,
    /// see [`Entry::kept`].
    pub(crate) fn examine(
        &self,
        trial: &Trial<'_>,
        round: usize,
        demands: &mut Demands,
    ) -> (Verdict, Vec<Option<Moment>>) {
        let view = View::new(trial, self);
        let blocks = demands.feed.len();
        // even speeds and parts of blocks are asked for first; where there are no bends to divide, nobody is to blame for that
        if round == 0 && !trial.bends() && foresees(trial.kernels) {
            let found = view.examine(|_, _| ());
            if found.worst.is_none() {
                return (Verdict::Kept, found.kept(trial));
            }
            if trial.foresee(demands) {
                return (Verdict::Tightened, found.kept(trial));
            }
        }
        let mut findings = Findings::none(blocks);
        // after many rounds everything in reach counts as a cause
        let all = round >= ROUNDS_OF_SPEED + ROUNDS_PER_BLOCK * blocks;
        let found = view.examine(|v, record| view.blame(v, record, all, demands, &mut findings));
        let kept = found.kept(trial);
        let Some(worst) = found.worst else {
            return (Verdict::Kept, kept);
        };
        let parts = view.parts(&findings);
        if !parts.is_empty() {
            return (Verdict::Divided(parts), kept);
        }
        // an answer at one corner can make another one necessary at the next
        if round >= ROUNDS + ROUNDS_PER_BLOCK * blocks {
            return (Verdict::GivenUp(worst), kept);
        }
        if round > 0 || !trial.foresee(demands) {
            view.tighten(&findings, (round, all), demands);
        }
        (Verdict::Tightened, kept)
    }
}

/// What of a plan exceeds the tolerance.
struct Found {
    worst: Option<Unkept>,
    /// Cycles of the violations.
    exceeded: Vec<u64>,
    /// What has changed keeps the tolerance, and what has moved was measured, too.
    calm: bool,
}

impl Found {
    /// For every entry of the plan where it has been found to keep the tolerance, see [`Entry::kept`].
    fn kept(&self, trial: &Trial<'_>) -> Vec<Option<Moment>> {
        let reach = 2.0 * f64::from(trial.kernels.length()) + 4.0;
        let kept = trial.plan.iter().map(|e| {
            let [from, to] = [e.start, e.end].map(|m| m.cycles(trial.cycle));
            let near = |k: &u64| (from - reach..=to + reach).contains(&(*k as f64));
            if self.exceeded.iter().any(near) {
                None
            } else if self.calm || e.kept.is_none() {
                Some(e.start)
            } else {
                e.kept
            }
        });
        kept.collect()
    }
}

impl View<'_> {
    /// Measures what has changed since the last examination, then, if that keeps the tolerance, what has moved in time.
    fn examine(&self, mut found: impl FnMut(&Violation, &Record)) -> Found {
        let mut exceeded: Vec<u64> = Vec::new();
        let mut found = |v: &Violation, record: &Record| {
            exceeded.push(v.cycle);
            found(v, record);
        };
        let changed = self.trial.reached_by(|e| e.kept.is_none());
        let worst = self.search(&changed, &mut found);
        let calm = worst.is_none();
        let worst = worst.or_else(|| {
            let moved = self.trial.reached_by(|e| e.kept.is_some_and(|at| at != e.start));
            self.search(&moved, &mut found)
        });
        Found { worst, exceeded, calm }
    }
}

impl Trial<'_> {
    /// True if a block of the plan is bent.
    fn bends(&self) -> bool {
        self.plan.iter().flat_map(|e| &e.blocks).any(|(queued, _)| queued.bend > 0.0)
    }

    /// See [`foresee`].
    fn foresee(&self, demands: &mut Demands) -> bool {
        let blocks = self.plan.iter().flat_map(|e| &e.blocks);
        let window: Vec<Arc<Queued>> = blocks.map(|(queued, _)| Arc::clone(queued)).collect();
        let start = self.plan.first().map_or(0.0, |e| e.s0);
        foresee(demands, &window, self.past, start, (self.kernels, self.cycle))
    }

    /// Cycles still to come whose set points, or what they miss, depend on some entries.
    fn reached_by(&self, which: impl Fn(&Entry) -> bool) -> Vec<(u64, u64)> {
        let reach = 2.0 * f64::from(self.kernels.length()) + 5.0;
        let entries = self.timeline.entries().chain(self.plan).filter(|e| which(e));
        let cycles = entries.map(|e| {
            let [from, to] = [e.start, e.end].map(|m| m.cycles(self.cycle));
            ((from - 3.0).max(0.0) as u64, (to + reach).ceil() as u64)
        });
        let ahead = cycles.map(|(from, to)| (from.max(self.now + 1), to));
        joined(ahead.filter(|(from, to)| from <= to).collect(), 0)
    }
}
