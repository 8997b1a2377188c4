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
//! beyond(s, r) = (s - r)+ where r lies after m, (r - s)+ where it lies before
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
//!   difference of the delays: rests do not help, an even speed does. On an arc this speed depends on the direction, so an arc
//!   is planned in parts. Straight blocks have a part in the deviation too: those that are faster than the even speed are
//!   slowed down before those that keep it.
//! - Negative weights (windowed sinc) make no mean: the set point swings beyond ends, and no dwell helps; the blocks on both
//!   sides start and stop with a lower acceleration, see [`crate::overshoot`].
//!
//! # How it is kept
//!
//! By trying: every plan is sampled on the cycle grid, filtered with the taps of the axes and measured both ways, as the
//! trace will be: first what leaves the contour ([`leaves`]), then, where nothing does, what of it is missed ([`measure`]); each
//! time only what has changed ([`examine`]). What exceeds the tolerance is put down to kinks and bends by their parts in the sum above
//! ([`blame`]): an isolated corner is passed more slowly, then rests, then waits; likes within one kernel length share the
//! even speed that keeps the tolerance. Then the window is planned again ([`tighten`]).
//!
//! Exact, but for [`MARGIN_MM`]: set points; kinks of the contour; the places where the nearest point passes from one block,
//! or one part of the set path, to another (halvings). Where two vectors could be taken for the shortest, the larger
//! component counts. Between the kinks points of the contour are looked at up to four times in a cycle, and set points
//! half way on bent blocks.
//!
//! Bounded instead of measured: where the set point is certainly closer than the tolerance to the point of the contour that
//! goes with it ([`bound`]); stretches of constant speed on one line, where one set point represents all.
//!
//! Neither: the choice of who slows down. It keeps the tolerance, but is not an optimum; `motion/tests/promise.rs` compares it
//! with the best even speed (`EVEN=1`).
//!
//! Set at the planner at rest; what could not be kept is returned by [`crate::planner::Planner::take_unkept`].
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
mod demands;
mod dwell;
mod even;
mod examine;
mod findings;
mod glance;
mod harvest;
mod kernels;
mod leaves;
mod measure;
mod ranges;
mod search;
mod set_points;
mod tighten;
mod view;
mod violation;

use crate::axis::AxisVec;
use crate::contour::Contour;
use crate::queue::Queued;
use crate::timeline::{Entry, Timeline};
pub(crate) use demands::Demands;
pub use kernels::Kernels;
use kontur_filters::time::CycleTime;
use set_points::SetPoints;
use std::collections::VecDeque;
use std::sync::Arc;
use view::View;

/// Part of the tolerance kept in hand, in mm: two digits below the last one of a trace.
const MARGIN_MM: f64 = 2e-7;
/// How far beyond the kernel a block may have been left and still count as within reach, in cycles: a trace does not show
/// on which side of a sample a border lies.
const BORDER_CYCLES: f64 = 5.0;
/// Raw setpoints kept, in lengths of the kernel: set points of one length, and one more before a stretch.
const HELD: usize = 3;

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
    /// The plan after it.
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

    /// Number of setpoints that it keeps.
    pub(crate) const fn remembers(&self) -> usize {
        self.length
    }

    /// Takes the setpoint of a cycle.
    pub(crate) fn record(&mut self, position: &AxisVec, s_mm: f64) {
        if self.length > 0 {
            // the oldest one becomes the newest one
            self.history.rotate_left(1);
            if let Some((point, s)) = self.history.back_mut() {
                point.copy_from_slice(position);
                *s = s_mm;
            }
        }
    }

    /// What of the final part of a trial does not keep the tolerance.
    pub(crate) fn excess(&self, trial: &Trial<'_>) -> Option<Unkept> {
        let view = View::new(trial, self);
        view.search(&[(trial.now + 1, u64::MAX)], &mut SetPoints::new(&view), |_, _| ())
    }
}
