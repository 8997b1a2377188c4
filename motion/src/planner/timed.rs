//! The time that a path would take, without moving along it.

use super::Planner;
use crate::block::{Block, Tolerance};
use crate::cap::{Cap, SpeedLimit};
use crate::tolerance::Kernels;
use kontur_filters::time::CycleTime;

/// What the corners between blocks do to the speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Corners {
    Limit,
    /// Nothing: a bound of the time.
    Free,
}

impl Planner {
    /// Time in s over some blocks from rest to rest, without `AX_DEV`; `None` if they cannot be planned.
    pub(crate) fn time_s<'b>(
        blocks: impl Iterator<Item = &'b Block>,
        kernels: &Kernels,
        cycle: CycleTime,
        corners: Corners,
    ) -> Option<f64> {
        let mut planner = Self::new(cycle, 1, &[]);
        planner.kernels = kernels.clone();
        for block in blocks {
            planner.push(Block { tolerance: without_ax_dev(block.tolerance), ..block.clone() });
        }
        if corners == Corners::Free {
            for segment in planner.plan.segments.iter_mut().skip(1) {
                segment.cap = Cap::new(f64::INFINITY, SpeedLimit::Curve);
            }
        }
        planner.finish();
        while !planner.plan.segments.is_empty() {
            if planner.plan.is_barred() {
                return None;
            }
            planner.extend().ok()?;
        }
        let end = planner.timeline.entries().next_back()?.end;
        Some(end.cycles(cycle) * cycle.seconds())
    }
}

fn without_ax_dev(tolerance: Tolerance) -> Tolerance {
    Tolerance { ax_dev_mm: None, ..tolerance }
}
