//! Independent axes: motions of single axes independent of the path, each with its own timeline.
//!
//! They are not part of the path (see [`IndependentMotion`]): the setpoint of an axis is that of the path plus its way.
//! Feed override (P-AXIS-00491) and feedhold (P-AXIS-00540) of the channel act on them, unless the list assigns these
//! to the interface of the axis, which has no inputs here. Assumption: the weights of G130 to G133 do not apply to
//! them; an error stops them, and a feedhold holds them, with their normal deceleration, whatever P-CHAN-00097 says: the default
//! of P-AXIS-00556 is that deceleration, and its page (358850187) does not say how P-CHAN-00097 changes it. Rests of
//! oscillations continue.

use crate::exec::{IndependentMotion, OscillatingMotion, SourceRef};
use kontur_filters::time::CycleTime;
use kontur_motion::axis::AxisDynamics;
use kontur_motion::independent::{IndependentMove, Steering};
use kontur_motion::profile::Infeasible;

/// A motion under way.
#[derive(Clone, Debug)]
struct Underway {
    motion: IndependentMove,
    from_mm: f64,
    /// Cycle in which it began.
    k: u64,
}

/// An axis that oscillates.
#[derive(Clone, Debug)]
struct Oscillation {
    /// Motions from the first to the second reversal position, and back.
    ways: [IndependentMove; 2],
    reversal_mm: [f64; 2],
    /// Rest at each reversal position in cycles.
    rest_cycles: [u64; 2],
    /// Target of the present motion: index of a reversal position.
    to: usize,
    /// Remaining oscillations; `None`: unlimited.
    left: Option<u32>,
}

impl Oscillation {
    /// The motion after one that ends in cycle `k`; `None` if the oscillation ends.
    fn next(&mut self, k: u64, steering: Steering) -> Option<Underway> {
        let at = self.to;
        if at == 1 {
            self.left = self.left.map(|left| left.saturating_sub(1));
        }
        if at == 1 && self.left == Some(0) {
            return None;
        }
        self.to = 1 - at;
        let k = k + self.rest_cycles[at];
        let mut motion = self.ways[at].clone();
        motion.steer(0, steering);
        Some(Underway { motion, from_mm: self.reversal_mm[at], k })
    }
}

/// Coupling of an axis to another one.
#[derive(Clone, Copy, Debug)]
struct Coupling {
    master: usize,
    ratio: f64,
    /// Position of the master at the beginning in mm (deg).
    master_mm: f64,
    /// Way that the axis has followed it in mm (deg).
    way_mm: f64,
}

/// One path axis.
#[derive(Clone, Debug, Default)]
struct Lane {
    /// Way of all completed motions.
    done_mm: f64,
    /// Coupling to the axis that it follows.
    coupling: Option<Coupling>,
    /// Block of its motion.
    source: SourceRef,
    /// Whether its motion ended in the last cycle.
    ended: bool,
    /// Whether its way is not yet at rest after the filters.
    settles: bool,
    /// External influences on it.
    steering: Steering,
    underway: Option<Underway>,
    oscillation: Option<Box<Oscillation>>,
}

/// The independent motions of the path axes.
#[derive(Clone, Debug)]
pub(super) struct IndependentAxes {
    lanes: Vec<Lane>,
    /// Whether any axis has moved or was coupled.
    used: bool,
}

impl IndependentAxes {
    pub(super) fn new(axes: usize) -> Self {
        Self { lanes: vec![Lane::default(); axes], used: false }
    }

    /// Whether no axis has ever moved independently of the path: all ways are 0.
    pub(super) fn is_unused(&self) -> bool {
        !self.used
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
        let IndependentMotion { from_mm, to_mm, speed, slope, source } = motion;
        let mut motion = IndependentMove::new(from_mm, to_mm, speed, slope, dynamics, cycle)?;
        if let Some(lane) = self.lanes.get_mut(axis) {
            motion.steer(0, lane.steering);
            lane.underway = Some(Underway { motion, from_mm, k });
            lane.source = source;
            self.used = true;
        }
        Ok(())
    }

    /// Starts an oscillation in cycle `k`: to the first reversal position, then back and forth.
    pub(super) fn oscillate(
        &mut self,
        axis: usize,
        k: u64,
        motion: &OscillatingMotion,
        dynamics: &AxisDynamics,
        cycle: CycleTime,
    ) -> Result<(), Infeasible> {
        let OscillatingMotion { from_mm, reversal_mm, rest_s, speed, slope, count, source } =
            *motion;
        let [first, second] = reversal_mm;
        let way = |a: f64, b: f64| IndependentMove::new(a, b, speed, slope, dynamics, cycle);
        let oscillation = Oscillation {
            ways: [way(first, second)?, way(second, first)?],
            reversal_mm,
            rest_cycles: rest_s.map(|s| (s / cycle.seconds()).round() as u64),
            to: 0,
            left: count,
        };
        let mut motion = way(from_mm, first)?;
        if let Some(lane) = self.lanes.get_mut(axis) {
            motion.steer(0, lane.steering);
            lane.underway = Some(Underway { motion, from_mm, k });
            lane.source = source;
            lane.oscillation = Some(Box::new(oscillation));
            self.used = true;
        }
        Ok(())
    }

    /// External influences on an axis, from the next call of [`Self::take_over`] on.
    pub(super) fn steer(&mut self, axis: usize, steering: Steering) {
        if let Some(lane) = self.lanes.get_mut(axis) {
            lane.steering = steering;
        }
    }

    /// Applies external influences to the motions under way from cycle `k` on; called in every cycle, because not every
    /// state permits a change.
    pub(super) fn take_over(&mut self, k: u64) {
        for lane in &mut self.lanes {
            if let Some(underway) = &mut lane.underway {
                underway.motion.steer(k.saturating_sub(underway.k), lane.steering);
            }
        }
    }

    /// Whether feedhold or override 0 keeps the motion of an axis at rest in cycle `k`.
    pub(super) fn is_held(&self, axis: usize, k: u64) -> bool {
        let held = |u: &Underway| u.motion.is_held(k.saturating_sub(u.k));
        self.lanes.get(axis).is_some_and(|lane| lane.underway.as_ref().is_some_and(held))
    }

    /// Ends oscillations when the axes reach their second position; all of them if no axes are given.
    pub(super) fn end_oscillations(&mut self, axes: Option<&[usize]>) -> Vec<usize> {
        let mut ended = Vec::new();
        for (axis, lane) in self.lanes.iter_mut().enumerate() {
            if axes.is_none_or(|axes| axes.contains(&axis))
                && let Some(oscillation) = &mut lane.oscillation
            {
                if oscillation.left.is_none_or(|left| left > 1) {
                    ended.push(axis);
                }
                oscillation.left = Some(oscillation.left.map_or(1, |left| left.min(1)));
            }
        }
        ended
    }

    /// The block of a motion that has ended, returned once.
    pub(super) fn take_ended(&mut self, axis: usize) -> Option<SourceRef> {
        let lane = self.lanes.get_mut(axis)?;
        std::mem::take(&mut lane.ended).then_some(lane.source)
    }

    /// Way of an axis in cycle `k`; cycles must not decrease.
    pub(super) fn way_mm(&mut self, axis: usize, k: u64) -> f64 {
        let Some(lane) = self.lanes.get_mut(axis) else { return 0.0 };
        let Some(underway) = &lane.underway else { return lane.done_mm };
        let cycles = k.saturating_sub(underway.k);
        let way_mm = lane.done_mm + (underway.motion.state(cycles).position_mm - underway.from_mm);
        if cycles >= underway.motion.cycles() && k >= underway.k {
            let end = underway.k + underway.motion.cycles();
            lane.done_mm = way_mm;
            lane.underway = lane.oscillation.as_mut().and_then(|o| o.next(end, lane.steering));
            if lane.underway.is_none() {
                lane.oscillation = None;
                lane.ended = true;
            }
        }
        way_mm
    }

    /// Changes the position of an axis at rest without a motion.
    pub(super) fn shift(&mut self, axis: usize, offset_mm: f64) {
        if let Some(lane) = self.lanes.get_mut(axis) {
            lane.done_mm += offset_mm;
            self.used = true;
        }
    }

    /// Couples an axis to another one from now on.
    pub(super) fn couple(&mut self, slave: usize, master: usize, ratio: f64, master_mm: f64) {
        if let Some(lane) = self.lanes.get_mut(slave) {
            lane.coupling = Some(Coupling { master, ratio, master_mm, way_mm: 0.0 });
            self.used = true;
        }
    }

    /// Uncouples an axis, which stays at its present position.
    pub(super) fn uncouple(&mut self, slave: usize) {
        if let Some(lane) = self.lanes.get_mut(slave)
            && let Some(coupling) = lane.coupling.take()
        {
            lane.done_mm += coupling.way_mm;
        }
    }

    /// Whether the axis follows another one.
    pub(super) fn follows(&self, axis: usize) -> bool {
        self.lanes.get(axis).is_some_and(|lane| lane.coupling.is_some())
    }

    /// Adds the way of the masters to the positions of their slaves; `positions` already contain everything else.
    pub(super) fn follow(&mut self, positions: &mut [f64]) {
        for (axis, lane) in self.lanes.iter_mut().enumerate() {
            let Some(coupling) = &mut lane.coupling else { continue };
            let way_mm = coupling.ratio * (positions[coupling.master] - coupling.master_mm);
            lane.settles |= way_mm.to_bits() != coupling.way_mm.to_bits();
            coupling.way_mm = way_mm;
            positions[axis] += way_mm;
        }
    }

    /// Whether the set position of an axis contains a way that is still changing, before or after its filters;
    /// `settled`: its set position has arrived.
    pub(super) fn is_on_its_way(&mut self, axis: usize, settled: bool) -> bool {
        let Some(lane) = self.lanes.get_mut(axis) else { return false };
        lane.settles = lane.underway.is_some() || lane.settles && !settled;
        lane.settles
    }

    /// Way of an axis at rest, or its last one.
    pub(super) fn done_mm(&self, axis: usize) -> f64 {
        let way_mm = |lane: &Lane| lane.done_mm + lane.coupling.map_or(0.0, |c| c.way_mm);
        self.lanes.get(axis).map_or(0.0, way_mm)
    }

    /// Number of axes.
    pub(super) fn len(&self) -> usize {
        self.lanes.len()
    }

    pub(super) fn is_moving(&self, axis: usize) -> bool {
        self.lanes.get(axis).is_some_and(|lane| lane.underway.is_some())
    }

    /// Whether the axis oscillates.
    pub(super) fn oscillates(&self, axis: usize) -> bool {
        self.lanes.get(axis).is_some_and(|lane| lane.oscillation.is_some())
    }

    /// Whether any axis is moving to a target.
    pub(super) fn any_moving_once(&self) -> bool {
        self.lanes.iter().any(|lane| lane.underway.is_some() && lane.oscillation.is_none())
    }

    pub(super) fn any_moving(&self) -> bool {
        self.lanes.iter().any(|lane| lane.underway.is_some())
    }

    /// Stops all motions from cycle `k` on.
    pub(super) fn stop(&mut self, k: u64) -> Result<(), Infeasible> {
        for lane in &mut self.lanes {
            lane.oscillation = None;
            let Some(underway) = &mut lane.underway else { continue };
            underway.motion.stop(k.saturating_sub(underway.k))?;
        }
        Ok(())
    }
}
