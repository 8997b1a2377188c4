//! What the machine waits for while the path is at rest, and what happens then.

use super::chain::AxisChain;
use super::independent::IndependentAxes;
use crate::exec::{EndReason, ShapingSetup, Sync};
use kontur_filters::time::CycleTime;

/// What happens when the wait is over.
#[derive(Debug)]
pub(super) enum Action {
    None,
    Shaping(Box<ShapingSetup>),
    MachineData { axis: u32 },
    End(EndReason),
}

/// When the wait is over.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Until {
    Now,
    /// Cycles left.
    Cycles(u64),
    /// Independent axes at their targets, kernels and filters flushed.
    Flushed,
    /// These independent axes at their targets, flushed.
    Arrived(Vec<usize>),
    /// Flushed, and the actual positions in their windows (P-AXIS-00236).
    InPosition,
}

/// A wait with what follows it.
#[derive(Debug)]
pub(super) struct Wait {
    until: Until,
    action: Action,
}

impl Wait {
    pub(super) fn for_sync(sync: Sync, cycle: CycleTime) -> Self {
        let (until, action) = match sync {
            Sync::ExactStop => (Until::InPosition, Action::None),
            Sync::Stop | Sync::ProgramStop { .. } => (Until::Now, Action::None),
            Sync::Dwell { seconds } => {
                (Until::Cycles((seconds / cycle.seconds()).round() as u64), Action::None)
            }
            Sync::Independent { axes } => (Until::Arrived(axes), Action::None),
            Sync::FlushWait | Sync::ReadActual => (Until::Flushed, Action::None),
            Sync::Shaping(setup) => (Until::Flushed, Action::Shaping(setup)),
            Sync::MachineData { axis } => (Until::Flushed, Action::MachineData { axis }),
        };
        Self { until, action }
    }

    pub(super) fn for_end(reason: EndReason) -> Self {
        Self { until: Until::Flushed, action: Action::End(reason) }
    }

    /// `chains`: those of the path axes.
    pub(super) fn is_over(&self, chains: &[AxisChain], independent: &IndependentAxes) -> bool {
        let ready = |i: usize, chain: &AxisChain| match &self.action {
            Action::Shaping(setup) => {
                setup.axes.get(i).is_none_or(|a| chain.ready_for(a.kernel.as_deref()))
            }
            _ => true,
        };
        let flushed = |(i, c): (usize, &AxisChain)| c.settled() && ready(i, c);
        match &self.until {
            Until::Now | Until::Cycles(0) => true,
            Until::Cycles(_) => false,
            Until::Flushed => !independent.any_moving() && chains.iter().enumerate().all(flushed),
            Until::Arrived(axes) => axes.iter().all(|axis| {
                !independent.is_moving(*axis) && chains.get(*axis).is_none_or(AxisChain::settled)
            }),
            // axes on their way alone have no exact stop here
            Until::InPosition => chains
                .iter()
                .enumerate()
                .filter(|(i, _)| !independent.is_moving(*i))
                .all(|(i, c)| flushed((i, c)) && c.in_position()),
        }
    }

    /// A dwell: its cycles belong to its own block, not to the motion before.
    pub(super) fn is_dwell(&self) -> bool {
        matches!(self.until, Until::Cycles(_))
    }

    /// One cycle goes by.
    pub(super) fn count(&mut self) {
        if let Until::Cycles(n) = &mut self.until {
            *n = n.saturating_sub(1);
        }
    }

    pub(super) fn into_action(self) -> Action {
        self.action
    }
}
