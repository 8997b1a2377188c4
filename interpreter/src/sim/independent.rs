//! Independent axes: motions of single axes beside the path, each on its own timeline.
//!
//! The path does not contain them (see [`IndependentMotion`]): the setpoint of an axis is that of the path plus its way.
//! Assumption: override, feedhold and the weights of G130 to G133 do not act on them; an error stops them with their own
//! deceleration.

use crate::exec::IndependentMotion;
use kontur_filters::time::CycleTime;
use kontur_motion::axis::AxisDynamics;
use kontur_motion::independent::IndependentMove;
use kontur_motion::profile::Infeasible;

/// A motion under way.
#[derive(Clone, Debug)]
struct Underway {
    motion: IndependentMove,
    from_mm: f64,
    /// Cycle in which it began.
    k: u64,
}

/// One path axis.
#[derive(Clone, Debug, Default)]
struct Lane {
    /// Way of all motions that are over.
    done_mm: f64,
    underway: Option<Underway>,
}

/// The path axes as far as they move alone.
#[derive(Clone, Debug)]
pub(super) struct IndependentAxes {
    lanes: Vec<Lane>,
}

impl IndependentAxes {
    pub(super) fn new(axes: usize) -> Self {
        Self { lanes: vec![Lane::default(); axes] }
    }

    /// Starts a motion in cycle `k`.
    pub(super) fn start(
        &mut self,
        axis: usize,
        k: u64,
        motion: IndependentMotion,
        dynamics: &AxisDynamics,
        cycle: CycleTime,
    ) -> Result<(), Infeasible> {
        let IndependentMotion { from_mm, to_mm, speed, slope } = motion;
        let motion = IndependentMove::new(from_mm, to_mm, speed, slope, dynamics, cycle)?;
        if let Some(lane) = self.lanes.get_mut(axis) {
            lane.underway = Some(Underway { motion, from_mm, k });
        }
        Ok(())
    }

    /// Way of an axis in cycle `k`; cycles do not fall.
    pub(super) fn way_mm(&mut self, axis: usize, k: u64) -> f64 {
        let Some(lane) = self.lanes.get_mut(axis) else { return 0.0 };
        let Some(underway) = &lane.underway else { return lane.done_mm };
        let cycles = k.saturating_sub(underway.k);
        let way_mm = lane.done_mm + (underway.motion.state(cycles).position_mm - underway.from_mm);
        if cycles >= underway.motion.cycles() {
            *lane = Lane { done_mm: way_mm, underway: None };
        }
        way_mm
    }

    /// Way of an axis that stands, or its last one.
    pub(super) fn done_mm(&self, axis: usize) -> f64 {
        self.lanes.get(axis).map_or(0.0, |lane| lane.done_mm)
    }

    pub(super) fn is_moving(&self, axis: usize) -> bool {
        self.lanes.get(axis).is_some_and(|lane| lane.underway.is_some())
    }

    pub(super) fn any_moving(&self) -> bool {
        self.lanes.iter().any(|lane| lane.underway.is_some())
    }

    /// Brings all of them to a stop from cycle `k` on.
    pub(super) fn stop(&mut self, k: u64) -> Result<(), Infeasible> {
        for underway in self.lanes.iter_mut().filter_map(|lane| lane.underway.as_mut()) {
            underway.motion.stop(k.saturating_sub(underway.k))?;
        }
        Ok(())
    }
}
