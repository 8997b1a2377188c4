//! Tolerance monitoring (`AX_DEV`): checks the filtered setpoints of a plan before the plan becomes final.
//!
//! TF5250 states the requirement: every axis keeps within `AX_DEV` of the contour. [`crate::deviation`] shows in a
//! drawing what this means; the formulas here are derived.
//!
//! # The deviation as a functional of the speed
//!
//! The path is `q(s)`, a plan is `s(t)`. A filter with the weights `h_k` (sum 1) and the delays `t_k` turns them into
//! the set point `y(t) = sum h_k q(s(t - t_k))`, which depends only on the path lengths within the last kernel length.
//! Let `E` be the mean over the weights, and `m = E[s]` the mean path length. Around `m` the path is a straight line
//! plus its kinks `du_b` at `s_b` and its bends `q''`. The line does not contribute to the deviation:
//!
//! ```text
//! y - q(m) = sum over kinks of du_b E[beyond(s, s_b)] + integral of q''(r) E[beyond(s, r)] dr
//! beyond(s, r) = (s - r)+ where r lies after m, (r - s)+ where it lies before
//! ```
//!
//! - A straight line is never left, whatever the speed: starts and stops on it cost nothing.
//! - One corner at the speed `v`: at most `du v M1`, where `M1` is half the mean absolute deviation of the kernel from
//!   its delay. An acceleration `a` next to it adds `du a M2 / 2`, so a stop without dwell leaves a deviation. A dwell
//!   as long as the kernel removes it, because all of `s` then lies on one side of the corner.
//! - A bend at constant speed: `v^2 kappa / 2` times the variance of the kernel.
//! - Along a stretch at constant speed the deviation falls with the speed, at kinks with `v`, on bends with `v^2`. With
//!   positive weights there is therefore always a plan that keeps the tolerance, unless the cause is already final.
//! - The deviation is not monotone: at a higher speed, contributions of several bends can cancel that add up at a lower
//!   one. The search is for the lowest speed that is too high.
//! - Kernels that differ between the axes have different mean path lengths. A line is then left by the speed times the
//!   difference of the delays: dwells do not help, a constant speed does. On an arc this speed depends on the
//!   direction, so an arc is planned in parts. Straight blocks contribute to the deviation, too: those faster than the
//!   even speed are slowed down before those that keep it.
//! - With negative weights (windowed sinc) the sum is not a mean: the set point overshoots at starts and stops, and a
//!   dwell does not help. The blocks on both sides start and stop with a lower acceleration, see [`crate::overshoot`].
//!
//! # How it is kept
//!
//! By trial: every plan is sampled on the cycle grid, filtered with the taps of the axes and measured in both
//! directions, as the trace will be. First by how far the set path leaves the contour ([`leaves`]); then, if it does
//! not, by how far it misses points of the contour ([`measure`]). Each time only the changes are measured
//! ([`examine`]). An excess is attributed to kinks and bends by their parts in the sum above ([`blame`]): an isolated
//! corner is passed more slowly, then with a stop, then with a dwell. Similar parts within one kernel length share the
//! even speed that keeps the tolerance. Then the window is planned again ([`tighten`]).
//!
//! Exact except for [`MARGIN_MM`]: set points; kinks of the contour; the places where the nearest point passes from one
//! block, or one part of the set path, to another (bisection). Where two vectors are candidates for the shortest one,
//! the larger component counts. Between the kinks, up to four points of the contour per cycle are examined, and on bent
//! blocks also set points halfway between two cycles.
//!
//! Bounded instead of measured: where the set point is certainly closer than the tolerance to its companion point on
//! the contour ([`bound`]), or closer than another one of the same half kernel is measured to be, because only the worst
//! is answered; stretches of constant speed on one line, where one set point represents all.
//!
//! Neither exact nor bounded: the choice of the blocks that are slowed down. It keeps the tolerance but is not an
//! optimum; `motion/tests/promise.rs` compares it with the best even speed (`EVEN=1`).
//!
//! The kernels are set in the planner at standstill; tolerances that could not be kept are returned by
//! [`crate::planner::Planner::take_unkept`].
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

mod answered;
mod blame;
mod bound;
mod causes;
mod demands;
mod dwell;
mod even;
mod examine;
mod findings;
mod foot;
mod foresee;
mod glance;
mod harvest;
mod kernels;
mod leaves;
mod marks;
mod measure;
mod places;
mod ranges;
mod search;
mod set_points;
mod tighten;
mod view;
mod violation;

use crate::axis::AxisVec;
use crate::contour::Contour;
use crate::deviation::Unkept;
use crate::queue::Queued;
use crate::timeline::{Entry, Timeline};
pub(crate) use answered::entered;
pub(crate) use demands::Demands;
pub use kernels::Kernels;
use kontur_filters::time::CycleTime;
pub(crate) use marks::Marks;
use set_points::SetPoints;
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use view::View;

/// Margin kept below the tolerance, in mm: two digits below the last one of a trace.
const MARGIN_MM: f64 = 2e-7;
/// Cycles added to the kernel length within which a block that has been left still counts as within reach: a trace does
/// not show on which side of a sample a boundary lies.
const BORDER_CYCLES: f64 = 5.0;
/// Raw setpoints kept, in kernel lengths: the set points of one length, and another length before a stretch.
const HELD: usize = 3;

/// Result of the examination of a plan.
#[derive(Debug)]
pub(crate) enum Verdict {
    /// The plan keeps the tolerance.
    Kept,
    /// Blocks of the window, by index, to be planned in parts: they bend too much in one place only.
    Divided(Vec<(usize, Vec<Arc<Queued>>)>),
    /// The plan does not keep the tolerance; the demands have been tightened.
    Tightened,
    /// The same where the last plan exceeded the tolerance; the rest of the plan has not been measured.
    Again,
    /// The plan does not keep the tolerance after the last round. Contains the largest excess.
    GivenUp(Unkept),
}

/// Raw setpoints of the last cycles, with their path lengths.
#[derive(Clone, Debug, Default)]
pub(crate) struct Monitor {
    history: VecDeque<(AxisVec, f64)>,
    length: usize,
}

/// A plan under examination.
pub(crate) struct Trial<'a> {
    /// Final part of the motion.
    pub(crate) timeline: &'a Timeline,
    /// The plan that follows it.
    pub(crate) plan: &'a [Entry],
    pub(crate) past: &'a Contour,
    pub(crate) kernels: &'a Kernels,
    pub(crate) cycle: CycleTime,
    /// Last cycle output.
    pub(crate) now: u64,
    /// Whether the path is at rest where the plan starts; the start can then be delayed.
    pub(crate) at_rest: bool,
    /// Set by the host to end the examination: its result is then void.
    pub(crate) stop: Option<&'a AtomicBool>,
}

impl Monitor {
    /// Starts at rest at `position`; the kernels reach `length` cycles back.
    pub(crate) fn rest(&mut self, position: &AxisVec, s_mm: f64, length: u32) {
        self.length = if length > 0 { HELD * length as usize + 8 } else { 0 };
        self.history = std::iter::repeat_n((position.clone(), s_mm), self.length).collect();
    }

    /// Number of setpoints kept.
    pub(crate) const fn remembers(&self) -> usize {
        self.length
    }

    /// Records the setpoint of one cycle.
    pub(crate) fn record(&mut self, position: &AxisVec, s_mm: f64) {
        if self.length > 0 {
            // reuses the oldest entry for the newest one
            self.history.rotate_left(1);
            if let Some((point, s)) = self.history.back_mut() {
                point.copy_from_slice(position);
                *s = s_mm;
            }
        }
    }

    /// The worst excess in the final part of a trial.
    pub(crate) fn excess(&self, trial: &Trial<'_>) -> Option<Unkept> {
        let view = View::new(trial, self, Marks::default());
        view.search(&[(trial.now + 1, u64::MAX)], &mut SetPoints::new(&view), |_, _| ())
    }
}
