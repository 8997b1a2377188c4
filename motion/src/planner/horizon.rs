//! How far ahead a path with a tolerance is planned at once.
//!
//! Every plan is measured up to its end before any of it becomes final, and most of a plan moves in time, so that it has
//! to be measured again, whenever its start does: after each change of the override, feedhold or excess. A queue of slow
//! or long blocks lasts minutes, of which a change only concerns the next seconds. The path is therefore planned as if
//! the blocks known ended after a time that is long compared with braking and with the filters, as it is planned where
//! the next blocks have not been read yet; the first half becomes final.

use super::Planner;
use crate::queue::Queued;
use std::sync::Arc;

/// Least time in s that stays ahead of the final part.
const LEAST_S: f64 = 2.0;
/// The same in lengths of the kernels, within which places act on each other.
const REACHES: f64 = 8.0;
/// The same in durations of the longest braking: a stop at the end then has no effect on the speeds of the final part.
const BRAKINGS: f64 = 4.0;

/// The blocks that are planned at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Horizon {
    /// Number of these blocks.
    pub(super) count: usize,
    /// How many of them may become final.
    pub(super) front: usize,
}

impl Planner {
    /// The blocks of a window that are planned at once; `None`: all, because the window is short or has no tolerance.
    pub(super) fn horizon(&self, window: &[Arc<Queued>]) -> Option<Horizon> {
        let limited = |q: &Arc<Queued>| q.block.tolerance.ax_dev_mm.is_some();
        if !self.kernels.any() || !window.iter().any(limited) {
            return None;
        }
        let brakes = |q: &Arc<Queued>| q.slope.down_time(q.velocity.v_mm_s, 0.0);
        let brakes = window.iter().map(brakes).fold(0.0, f64::max);
        let reach = f64::from(self.kernels.length()) * self.cycle.seconds();
        let ahead_s = LEAST_S.max(REACHES * reach).max(BRAKINGS * brakes);
        let demands = &self.plan.demands;
        let takes: Vec<f64> = (0..window.len())
            .map(|b| demands.least_time(b, &window[b], &self.kernels, self.cycle))
            .collect();
        let front = passed(&takes, ahead_s)?;
        // what has been planned before stays planned
        let known = self.plan.reserve.iter().map(|e| e.blocks.len()).sum();
        let count = (front + passed(&takes[front..], ahead_s)?).max(known);
        (count < window.len()).then_some(Horizon { count, front })
    }
}

/// Number of blocks that take a time in s together; `None` if all of them take less.
fn passed(takes: &[f64], seconds: f64) -> Option<usize> {
    let mut sum = 0.0;
    let last = takes.iter().position(|s| {
        sum += s;
        sum >= seconds
    });
    last.map(|last| last + 1)
}
