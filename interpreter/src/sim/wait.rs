//! Waits of the machine while the path is at rest, and what follows them.

use super::chain::{AxisChain, Remaining};
use super::chains::Chains;
use super::driver::Driver;
use super::independent::IndependentAxes;
use super::patience::Patience;
use super::spindle::Spindle;
use crate::exec::{EndReason, ShapingSetup, SpindleState, Sync};
use crate::record::Rest;
use kontur_filters::time::CycleTime;

/// Action at the end of a wait.
#[derive(Debug)]
pub(super) enum Action {
    None,
    Shaping(Box<ShapingSetup>),
    MachineData,
    /// A path axis gets another position.
    SetPosition {
        axis: usize,
        offset_mm: f64,
        moves: bool,
    },
    /// The axes are in their windows where the path has halted.
    Halted,
    /// The path continues after its halt.
    Resume,
    /// The axes no longer follow a spindle.
    ThreadEnd,
    End(EndReason),
}

/// Condition that ends the wait.
#[derive(Clone, Debug, PartialEq)]
enum Until {
    Now,
    /// Cycles left of a dwell or of technology functions.
    Cycles(u64, Rest),
    /// Independent axes at their targets, kernels and filters flushed.
    Flushed,
    /// These independent axes at their targets, flushed.
    Arrived(Vec<usize>),
    /// A spindle is at rest, or passes its mark.
    Spindle(usize, SpindleState),
    /// Flushed, and the actual positions in their windows (P-AXIS-00236).
    InPosition {
        /// Whether it also waits for independent axes to reach their targets; oscillating axes never do.
        alone: bool,
    },
    /// The same for everything that moves, including independent axes and spindles on their way to a position, and as
    /// seen by the monitors: the last row of the trace shows the axes inside their windows.
    AllInPosition,
}

/// The moving parts that a wait depends on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts<'a> {
    /// Path axes, spindles, gantry slaves.
    pub(super) chains: &'a Chains,
    /// Spindles of the machine.
    pub(super) spindles: &'a [Spindle],
    /// Independent axes.
    pub(super) independent: &'a IndependentAxes,
    /// Cycle time.
    pub(super) cycle: CycleTime,
}

impl Parts<'_> {
    /// Actual speed of a spindle in deg/s.
    fn speed_of(&self, spindle: usize) -> f64 {
        let chain = self.chains.of_spindle(spindle);
        chain.map_or(0.0, |i| self.chains.all[i].actual_speed())
    }
}

/// A wait with its action.
#[derive(Debug)]
pub(super) struct Wait {
    until: Until,
    action: Action,
    patience: Patience,
    /// The reason why the path rests in the cycle that has been begun.
    rest: Rest,
}

/// The mark of a spindle at which a thread begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct AwaitedMark {
    /// Index of the spindle.
    pub(super) spindle: usize,
    /// Angle of the mark in deg.
    pub(super) deg: f64,
    /// The override does not act on the thread.
    pub(super) full_override: bool,
}

impl Wait {
    pub(super) fn for_sync(sync: Sync, cycle: CycleTime) -> Self {
        let cycles =
            |seconds: f64, rest| Until::Cycles((seconds / cycle.seconds()).round() as u64, rest);
        let (until, action) = match sync {
            Sync::ExactStop { alone } => (Until::InPosition { alone }, Action::None),
            Sync::Spindle { spindle, state } => (Until::Spindle(spindle, state), Action::None),
            Sync::ThreadEnd => (Until::Now, Action::ThreadEnd),
            Sync::Stop | Sync::Halt | Sync::ProgramStop { .. } => (Until::Now, Action::None),
            Sync::Dwell { seconds } => (cycles(seconds, Rest::Dwell), Action::None),
            Sync::Technology { seconds } => (cycles(seconds, Rest::Technology), Action::None),
            Sync::Independent { axes } => (Until::Arrived(axes), Action::None),
            Sync::FlushWait | Sync::ReadActual | Sync::Measured { .. } => {
                (Until::Flushed, Action::None)
            }
            Sync::TakeActual => (Until::AllInPosition, Action::None),
            Sync::Shaping(setup) => (Until::Flushed, Action::Shaping(setup)),
            Sync::SetPosition { axis, offset_mm, moves } => {
                let action = Action::SetPosition { axis, offset_mm, moves };
                (Until::InPosition { alone: false }, action)
            }
            Sync::MachineData { .. } => (Until::Flushed, Action::MachineData),
        };
        Self::new(until, action)
    }

    fn new(until: Until, action: Action) -> Self {
        Self { until, action, patience: Patience::default(), rest: Rest::Flush }
    }

    /// One cycle of rest, so that the trace shows the change even where the program ends.
    pub(super) fn for_a_cycle() -> Self {
        Self::new(Until::Cycles(1, Rest::Flush), Action::None)
    }

    /// Wait at a halt of the path until the axes are in their windows.
    pub(super) fn for_halt() -> Self {
        Self::new(Until::InPosition { alone: false }, Action::Halted)
    }

    /// Wait for the duration in s of the function called at a halt.
    pub(super) fn before_resuming(seconds: f64, cycle: CycleTime) -> Self {
        let until = Until::Cycles((seconds / cycle.seconds()).round() as u64, Rest::Technology);
        Self::new(until, Action::Resume)
    }

    /// Wait at the end of the program until every axis has arrived.
    pub(super) fn for_end(reason: EndReason) -> Self {
        Self::new(Until::AllInPosition, Action::End(reason))
    }

    /// Ends the oscillations of the axes it waits for; returns those for which neither the program nor its end requires
    /// that.
    pub(super) fn end_oscillations(&self, independent: &mut IndependentAxes) -> Vec<usize> {
        match &self.until {
            Until::Arrived(axes) => {
                independent.end_oscillations(Some(axes));
                Vec::new()
            }
            Until::Flushed | Until::AllInPosition => {
                let ended = independent.end_oscillations(None);
                if matches!(self.action, Action::End(_)) { Vec::new() } else { ended }
            }
            Until::Now | Until::Cycles(..) | Until::Spindle(..) | Until::InPosition { .. } => {
                Vec::new()
            }
        }
    }

    /// The chains that the wait depends on, with their indices.
    fn awaited<'a>(
        &'a self,
        parts: Parts<'a>,
    ) -> impl Iterator<Item = (usize, &'a AxisChain)> + 'a {
        let concerns = move |driver: Driver| match (&self.until, driver) {
            (Until::Arrived(axes), Driver::Path(p)) => axes.contains(&p),
            // independently moving axes have no exact stop here
            (Until::InPosition { alone: true }, Driver::Path(p)) => {
                !parts.independent.oscillates(p)
            }
            (Until::InPosition { alone: false }, Driver::Path(p)) => {
                !parts.independent.is_moving(p)
            }
            (Until::Flushed | Until::AllInPosition, Driver::Path(_)) => true,
            (Until::Spindle(_, SpindleState::Mark { settled, .. }), Driver::Path(p)) => {
                *settled && !parts.independent.is_moving(p)
            }
            (Until::AllInPosition, Driver::Spindle(s)) => parts.spindles[s].positions(),
            (Until::Now | Until::Cycles(..) | Until::Spindle(..), Driver::Path(_))
            | (_, Driver::Spindle(_) | Driver::Standing) => false,
        };
        let chains = parts.chains.all.iter().zip(&parts.chains.drivers).enumerate();
        chains.filter(move |(_, (_, driver))| concerns(**driver)).map(|(i, (chain, _))| (i, chain))
    }

    /// Whether something that the wait depends on is still moving.
    fn under_way(&self, parts: Parts<'_>) -> bool {
        match &self.until {
            Until::Now | Until::Cycles(..) | Until::InPosition { alone: false } => false,
            Until::InPosition { alone: true } => parts.independent.any_moving_once(),
            Until::Spindle(spindle, state) => {
                !parts.spindles.get(*spindle).is_none_or(|s| match state {
                    SpindleState::Rest => s.rests(),
                    SpindleState::Reached => s.has_reached(parts.speed_of(*spindle)),
                    SpindleState::Mark { deg, .. } => s.mark_ahead(*deg, parts.cycle).is_some(),
                })
            }
            Until::Arrived(axes) => axes.iter().any(|axis| parts.independent.is_moving(*axis)),
            Until::Flushed => parts.independent.any_moving(),
            Until::AllInPosition => {
                parts.independent.any_moving() || parts.spindles.iter().any(Spindle::approaches)
            }
        }
    }

    /// Whether every independent axis that it waits for is held in cycle `k`.
    pub(super) fn is_held(&self, independent: &IndependentAxes, k: u64) -> bool {
        let awaited = |axis: &usize| match &self.until {
            Until::Arrived(axes) => axes.contains(axis),
            Until::Flushed | Until::AllInPosition => true,
            Until::InPosition { alone } => *alone && !independent.oscillates(*axis),
            Until::Now | Until::Cycles(..) | Until::Spindle(..) => false,
        };
        let mut moving =
            (0..independent.len()).filter(awaited).filter(|a| independent.is_moving(*a));
        let held = |axis: usize| independent.is_held(axis, k);
        moving.next().is_some_and(held) && moving.all(held)
    }

    /// What a chain lacks for the wait to be over.
    fn remaining(&self, chain: &AxisChain) -> Option<Remaining> {
        let position = matches!(self.until, Until::InPosition { .. } | Until::AllInPosition);
        chain.unsettled().or_else(|| position.then(|| chain.out_of_position()).flatten())
    }

    pub(super) fn is_over(&self, parts: Parts<'_>) -> bool {
        let ready = |i: usize, chain: &AxisChain| match &self.action {
            Action::Shaping(setup) => {
                chain.ready_for(parts.chains.drivers[i].kernel(setup).map(AsRef::as_ref))
            }
            Action::None
            | Action::MachineData
            | Action::SetPosition { .. }
            | Action::Halted
            | Action::Resume
            | Action::ThreadEnd
            | Action::End(_) => true,
        };
        !matches!(self.until, Until::Cycles(1.., _))
            && !self.under_way(parts)
            && self.awaited(parts).all(|(i, c)| self.remaining(c).is_none() && ready(i, c))
            && (self.until != Until::AllInPosition
                || self.awaited(parts).all(|(_, c)| !c.settles()))
    }

    /// One cycle in which the wait is not over and no input will change any more; returns the chain that will never
    /// arrive, and what it lacks.
    pub(super) fn hopeless(
        &mut self,
        parts: Parts<'_>,
        cycle: CycleTime,
    ) -> Option<(usize, Remaining)> {
        // the first taps of a long kernel can be so small that nothing seems to move
        if self.under_way(parts) || !self.awaited(parts).all(|(_, chain)| chain.flushed()) {
            self.patience = Patience::default();
            return None;
        }
        let lacks = self.awaited(parts).filter_map(|(i, c)| Some((i, self.remaining(c)?)));
        let (i, worst) = lacks.max_by(|(_, a), (_, b)| a.excess_mm().total_cmp(&b.excess_mm()))?;
        let settling_s = parts.chains.all[i].settling_limit_s();
        self.patience.is_over(worst.distance_mm, settling_s, cycle).then_some((i, worst))
    }

    /// Whether its cycles belong to its own block rather than to the motion before.
    pub(super) fn is_of_its_own_block(&self) -> bool {
        matches!(self.until, Until::Cycles(..) | Until::Spindle(..) | Until::Arrived(_))
    }

    /// The spindle mark that is awaited.
    pub(super) fn mark(&self) -> Option<AwaitedMark> {
        match self.until {
            Until::Spindle(spindle, SpindleState::Mark { deg, full_override, .. }) => {
                Some(AwaitedMark { spindle, deg, full_override })
            }
            _ => None,
        }
    }

    /// The reason why the path rests in the cycle that has been begun.
    pub(super) const fn rest(&self) -> Rest {
        self.rest
    }

    /// Begins the cycle after cycle `k`.
    pub(super) fn begin_cycle(&mut self, parts: Parts<'_>, k: u64) {
        self.rest = self.reason(parts, k);
        if let Until::Cycles(n, _) = &mut self.until {
            *n = n.saturating_sub(1);
        }
    }

    /// While an independent axis or a spindle is still on its way to a position, no position controller is waited for.
    fn reason(&self, parts: Parts<'_>, k: u64) -> Rest {
        if self.is_held(parts.independent, k) {
            return Rest::Held;
        }
        match self.until {
            Until::Cycles(_, rest) => rest,
            Until::Spindle(..) => Rest::Spindle,
            Until::Now | Until::Flushed | Until::Arrived(_) => Rest::Flush,
            Until::InPosition { .. } | Until::AllInPosition if self.under_way(parts) => {
                let axes = parts.independent.any_moving();
                if axes { Rest::Flush } else { Rest::Spindle }
            }
            Until::AllInPosition if matches!(self.action, Action::End(_)) => Rest::Arrival,
            Until::InPosition { .. } | Until::AllInPosition => Rest::ExactStop,
        }
    }

    pub(super) fn into_action(self) -> Action {
        self.action
    }
}
