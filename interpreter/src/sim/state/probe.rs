//! What the probe does in a run: measuring runs and edge banding.

use crate::exec::{BandingRun, SourceRef};
use crate::sim::inputs::Inputs;
use kontur_motion::axis::AxisVec;

/// A measuring run.
#[derive(Clone, Debug)]
pub(in crate::sim) struct Probing {
    /// Whether the path continues through the signal.
    pub(in crate::sim) through: bool,
    /// Axes whose lag is the signal, with that lag in mm (deg); if empty, the signal is that of the probe.
    pub(in crate::sim) stops: Vec<(usize, f64)>,
    /// Actual positions in the previous cycle.
    pub(in crate::sim) before_mm: AxisVec,
    /// Actual positions at the signal.
    pub(in crate::sim) signal_mm: Option<AxisVec>,
}

impl Probing {
    /// Whether the path is to stop, or has stopped.
    pub(in crate::sim) fn holds(&self) -> bool {
        self.signal_mm.is_some() && !self.through
    }

    /// Actual positions at the signal of this cycle, if there is one.
    pub(in crate::sim) fn latched(
        &self,
        inputs: &Inputs,
        now_mm: &[f64],
        lag_mm: &[f64],
    ) -> Option<AxisVec> {
        if !self.stops.is_empty() {
            let at_rest = |(axis, most): &(usize, f64)| {
                lag_mm.get(*axis).is_some_and(|lag| lag.abs() > *most)
            };
            return self.stops.iter().any(at_rest).then(|| AxisVec::from_slice(now_mm));
        }
        signal(inputs, &self.before_mm, now_mm)
    }
}

/// Actual positions where the probe signals between two cycles, if it does.
pub(in crate::sim) fn signal(
    inputs: &Inputs,
    before_mm: &[f64],
    now_mm: &[f64],
) -> Option<AxisVec> {
    if inputs.probe {
        return Some(AxisVec::from_slice(now_mm));
    }
    let passed = |(axis, surface): (usize, Option<f64>)| {
        let (before, now) = (*before_mm.get(axis)?, *now_mm.get(axis)?);
        let surface = surface?;
        let passes = (before < surface && surface <= now) || (now <= surface && surface < before);
        passes.then(|| (surface - before) / (now - before))
    };
    let surfaces = inputs.surfaces_mm.iter().copied().enumerate();
    let share = surfaces.filter_map(passed).min_by(f64::total_cmp)?;
    let between = |(before, now): (&f64, &f64)| before + (now - before) * share;
    Some(before_mm.iter().zip(now_mm).map(between).collect())
}

/// A motion of edge banding.
#[derive(Clone, Debug)]
pub(in crate::sim) struct Banding {
    pub(in crate::sim) run: BandingRun,
    /// Number of the block.
    pub(in crate::sim) seq: u64,
    pub(in crate::sim) source: SourceRef,
    /// Actual positions in the previous cycle.
    pub(in crate::sim) before_mm: AxisVec,
    pub(in crate::sim) signalled: bool,
}

impl Banding {
    /// Actual positions at the signal of this cycle, if there is one.
    pub(in crate::sim) fn latched(&self, inputs: &Inputs, now_mm: &[f64]) -> Option<AxisVec> {
        signal(inputs, &self.before_mm, now_mm)
    }
}
