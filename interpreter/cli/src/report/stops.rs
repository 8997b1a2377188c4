//! Stops of the axes as seen by the position monitoring: set position at its target (t1), actual position inside the
//! window (t2), end of the time limit (t3).
//!
//! Source: TF5200 position monitoring, course of an exact stop.

use kontur_interpreter::job::{AxisFacts, Facts};
use kontur_interpreter::record::{CycleRecord, Quantity};

/// Largest number of stops that are kept; a picture does not show more.
const MOST: usize = 2000;
/// The filters have arrived if set and interpolated position are closer than this in mm (deg).
const ARRIVED_MM: f64 = 1e-4;
/// Path speed in mm/s below which the path rests.
const REST_MM_S: f64 = 1e-9;

/// One stop of one axis; times in cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stop {
    /// Index into [`Facts::axes`].
    pub(crate) axis: usize,
    /// Target position in mm (deg).
    pub(crate) target: f64,
    /// Cycle in which the set position reaches the target.
    pub(crate) t1: u64,
    /// Cycle in which the actual position is inside the window; `None` if the axis continued before that.
    pub(crate) t2: Option<u64>,
    /// Cycle in which the time limit ends; `None` without one.
    pub(crate) t3: Option<u64>,
}

/// The data of one axis.
#[derive(Clone, Copy, Debug, Default)]
struct Watch {
    set: Option<f64>,
    moving: bool,
    /// Index of the stop whose window has not been reached.
    open: Option<usize>,
}

/// Finds the stops of a run cycle by cycle.
#[derive(Clone, Debug)]
pub(crate) struct Stops {
    found: Vec<Stop>,
    watched: Vec<Watch>,
    cycle_s: f64,
}

impl Stops {
    pub(crate) fn new(facts: &Facts) -> Self {
        let watched = vec![Watch::default(); facts.axes.len()];
        Self { found: Vec::new(), watched, cycle_s: f64::from(facts.cycle_us) * 1e-6 }
    }

    /// The stops in the order in which they began.
    pub(crate) fn found(&self) -> &[Stop] {
        &self.found
    }

    /// Adds a cycle, with set, interpolated and actual position of an axis.
    pub(crate) fn add(
        &mut self,
        cycle: &CycleRecord,
        axes: &[AxisFacts],
        of: impl Fn(usize, Quantity) -> f64,
    ) {
        let rests = cycle.path.v_mm_s.abs() < REST_MM_S;
        for (i, (facts, watch)) in axes.iter().zip(&mut self.watched).enumerate() {
            let set = of(i, Quantity::Set);
            let at_rest = watch.set.replace(set).is_none_or(|x| x.to_bits() == set.to_bits());
            if at_rest && watch.moving && rests && (set - of(i, Quantity::Ipo)).abs() < ARRIVED_MM {
                watch.moving = false;
                if facts.spindle || self.found.len() >= MOST {
                    continue;
                }
                let t1 = cycle.k.saturating_sub(1);
                let limit = facts.settling_s.map(|s| t1 + (s / self.cycle_s).round() as u64);
                watch.open = Some(self.found.len());
                self.found.push(Stop { axis: i, target: set, t1, t2: None, t3: limit });
            }
            // the cycle in which the window permits the axis to continue still counts
            if let Some(stop) = watch.open.and_then(|s| self.found.get_mut(s))
                && (of(i, Quantity::Act) - stop.target).abs() <= facts.window
            {
                stop.t2 = Some(cycle.k);
                watch.open = None;
            }
            if !at_rest {
                (watch.moving, watch.open) = (true, None);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_interpreter::record::PathRecord;

    /// Set positions 0, 1, 2, 2, ...; the actual position halves its distance each cycle. Conformance: P022.
    #[test]
    fn times_of_a_stop() {
        let axis = AxisFacts { window: 0.1, settling_s: Some(0.02), ..AxisFacts::default() };
        let facts = Facts { cycle_us: 1000, axes: vec![axis], ..Facts::default() };
        let mut stops = Stops::new(&facts);
        let mut act = 0.0;
        for k in 0..20_u32 {
            let set = f64::from(k.min(2));
            act += 0.5 * (set - act);
            let v_mm_s = if k < 2 { 1000.0 } else { 0.0 };
            let record = CycleRecord {
                k: u64::from(k),
                path: PathRecord { v_mm_s, ..PathRecord::default() },
                ..CycleRecord::default()
            };
            let of = |_, quantity| if quantity == Quantity::Act { act } else { set };
            stops.add(&record, &facts.axes, of);
        }
        // distances after cycle 2: 0.75, 0.375, 0.1875, 0.09
        let want = Stop { axis: 0, target: 2.0, t1: 2, t2: Some(5), t3: Some(22) };
        assert_eq!(stops.found(), [want]);
    }
}
