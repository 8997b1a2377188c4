//! How long a stop must last for one corner.
//!
//! The path around the stop is sampled once; another dwell only changes the time between the same states. A few set
//! points are enough, because the next plan is measured in any case.

use super::marks::{Mark, Marks};
use super::view::View;
use super::violation::within;
use super::{Demands, Monitor, Trial};
use crate::axis::AxisVec;
use crate::deviation::{Excursion, SetPath};
use crate::timeline::{PathState, Reader};

/// Set points examined per kernel length.
const LOOKS: u32 = 64;

/// A stop of the plan and the states around it.
pub(super) struct Rest<'a> {
    view: &'a View<'a>,
    mark: &'a Mark,
    dwell: u32,
    /// Cycle in which the path comes to rest.
    cycle: u64,
    /// Positions and path lengths over one kernel length up to the rest; `behind`: the same after it.
    before: Vec<AxisVec>,
    behind: Vec<AxisVec>,
}

impl<'a> View<'a> {
    /// The stop before a mark, which lasts `dwell` cycles.
    pub(super) fn rest_at(&'a self, mark: &'a Mark, dwell: u32) -> Rest<'a> {
        let go = mark.cycles.round() as u64;
        let cycle = go.saturating_sub(u64::from(dwell));
        let full = u64::from(self.trial.kernels.length());
        let mut reader = Reader::new(self.trial.timeline, self.trial.plan);
        let mut state = PathState::at_rest(mark.point());
        let mut row = |k: u64| {
            self.state(k, &mut reader, &mut state);
            state.position.iter().copied().chain([state.s]).collect::<AxisVec>()
        };
        let before = (cycle.saturating_sub(full)..=cycle).map(&mut row).collect();
        let behind = (go + 1..=go + full).map(row).collect();
        Rest { view: self, mark, dwell, cycle, before, behind }
    }
}

/// Dwells of a plan that could be shorter.
#[derive(Default)]
pub(crate) struct Shorter {
    /// Boundaries with the shorter dwell in cycles.
    pub(super) dwells: Vec<(usize, u32)>,
    /// Blocks of straight lines from one dwell to the next.
    pub(super) between: Vec<usize>,
    /// Sum of the cycles by which the dwells are shorter.
    pub(crate) saved: u32,
}

impl Monitor {
    /// The dwells of a plan that could be shorter if nothing else changed.
    pub(crate) fn shorter(&self, trial: &Trial<'_>, demands: &Demands) -> Shorter {
        let view = View::new(trial, self, Marks::default());
        let mut out = Shorter::default();
        let mut line: Option<Vec<usize>> = None;
        for mark in &view.marks {
            let (Some(b), Some(block)) = (mark.boundary, mark.block) else { continue };
            let was = demands.stop[b].filter(|dwell| *dwell > 0);
            if let Some(was) = was {
                out.between.extend(line.take().into_iter().flatten());
                let rest = view.rest_at(mark, was);
                let now = if rest.keeps(0) { 0 } else { rest.needed(0, was) };
                if b > 0 && now < was {
                    out.dwells.push((b, now));
                    out.saved += was - now;
                }
                line = Some(Vec::new());
            } else if mark.is_kink() {
                line = None;
            }
            if let Some(line) = &mut line {
                line.push(block);
            }
        }
        out
    }
}

impl Rest<'_> {
    /// Smallest dwell in cycles that keeps the tolerance at this corner, by bisection; longer than `low`, which does
    /// not keep it, and at most `most`, which is returned if none is found.
    pub(super) fn needed(&self, mut low: u32, most: u32) -> u32 {
        let mut high = most;
        while high - low > 1 {
            let mid = low + (high - low) / 2;
            if self.keeps(mid) { high = mid } else { low = mid }
        }
        high
    }

    /// Whether `cycles` of dwell keep the tolerance.
    pub(super) fn keeps(&self, cycles: u32) -> bool {
        let View { trial, contour, .. } = self.view;
        let full = trial.kernels.length();
        let tolerance = self.mark.queued.block.tolerance.ax_dev_mm.unwrap_or(f64::INFINITY);
        let reach = (
            self.cycle as f64 - f64::from(full),
            (self.cycle + u64::from(self.dwell + full)) as f64,
        );
        let n = self.mark.point().len();
        let mut filtered = AxisVec::zeros(n + 1);
        let mut vector = AxisVec::zeros(n);
        let mut set = SetPath::starting(0, n);
        for k in (0..=cycles + full).step_by((full / LOOKS).max(1) as usize) {
            trial.kernels.filter(|delay| self.row(k, delay, cycles), &mut filtered);
            let point = &filtered[..n];
            contour.nearest(point, reach.0, reach.1, &mut vector);
            if vector.iter().any(|c| c.abs() > within(tolerance)) {
                return false;
            }
            set.push(point);
        }
        let mut out = Excursion::none(n);
        set.misses(self.mark.point(), (0, set.end()), None, tolerance, &mut out);
        out.largest() <= within(tolerance)
    }

    /// State `delay` cycles before cycle `k` of a rest that lasts `cycles` cycles.
    fn row(&self, k: u32, delay: u32, cycles: u32) -> &[f64] {
        let last = self.before.len() - 1;
        match (k.checked_sub(delay), delay.saturating_sub(k)) {
            (None, back) => &self.before[last.saturating_sub(back as usize)],
            (Some(at), _) if at > cycles => &self.behind[(at - cycles) as usize - 1],
            _ => &self.before[last],
        }
    }
}
