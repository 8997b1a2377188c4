//! Path slope of a block: accelerations and ramp times that no axis exceeds.

use super::{PathExtremes, least, longest_ramp};
use crate::axis::{AxisDynamics, AxisVec};
use crate::block::{Block, ChannelDynamics, Feed, Slope, SlopeKind};
use crate::profile::{RampShape, RampedLimits, SlopeLimits, StepAxis, StepLimits};
use kontur_filters::time::CycleTime;
use smallvec::SmallVec;
use std::sync::Arc;

/// Largest number of rows in a table: two accelerations and the jerk of four ramps.
const ROWS: usize = 6;

/// Axis limits used by the slopes of blocks, computed once for all blocks that share a set of dynamics.
#[derive(Clone, Debug)]
pub(crate) struct SlopeTable {
    /// The set, kept alive so that its address stays unique.
    dynamics: Arc<ChannelDynamics>,
    slope: Slope,
    rapid: bool,
    /// Cycle time.
    pub(crate) cycle: CycleTime,
    /// Limits by axis, each different row once.
    rows: Vec<AxisVec>,
    /// Rows of acceleration and deceleration in mm/s2.
    plateaus: [usize; 2],
    /// Rows of the mean jerk in the four ramps in mm/s3.
    jerks: [usize; 4],
}

impl SlopeTable {
    /// The table for a block.
    pub(crate) fn of(block: &Block, cycle: CycleTime) -> Self {
        let rapid = block.feed == Feed::Rapid;
        let mut table = Self {
            dynamics: Arc::clone(&block.dynamics),
            slope: block.slope,
            rapid,
            cycle,
            rows: Vec::new(),
            plateaus: [0; 2],
            jerks: [0; 4],
        };
        if block.slope.kind != SlopeKind::Step {
            let plateau = |k: usize, axis: &AxisDynamics| match (rapid, k) {
                (true, _) => axis.rapid.acc_mm_s2,
                (false, 0) => axis.feed.acc_mm_s2,
                (false, _) => axis.feed.dec_mm_s2,
            };
            let jerk = |k: usize, axis: &AxisDynamics| {
                let t = if rapid {
                    axis.rapid.ramp_s
                } else if block.slope.kind == SlopeKind::Hsc {
                    longest_ramp(axis, false)
                } else {
                    axis.feed.ramps_s[k]
                };
                // a ramp shorter than the cycle time is not a ramp
                if t < cycle.seconds() { f64::INFINITY } else { plateau(k / 2, axis) / t }
            };
            table.plateaus = [0, 1].map(|k| table.row(|axis| plateau(k, axis)));
            table.jerks = [0, 1, 2, 3].map(|k| table.row(|axis| jerk(k, axis)));
        }
        table
    }

    /// Index of a row of limits, which is added if it is new.
    fn row(&mut self, limit: impl Fn(&AxisDynamics) -> f64) -> usize {
        let row: AxisVec = self.dynamics.axes.iter().map(limit).collect();
        let same =
            |known: &AxisVec| known.iter().zip(row.iter()).all(|(a, b)| a.to_bits() == b.to_bits());
        self.rows.iter().position(same).unwrap_or_else(|| {
            self.rows.push(row);
            self.rows.len() - 1
        })
    }

    /// Whether the table is valid for this block as well.
    pub(crate) fn serves(&self, block: &Block) -> bool {
        Arc::ptr_eq(&self.dynamics, &block.dynamics)
            && self.slope == block.slope
            && self.rapid == (block.feed == Feed::Rapid)
    }

    /// Path slope over a path.
    ///
    /// The weakest axis determines the acceleration; ramps are combined through the axis jerk `a_i / t_i` (Assumption:
    /// with this rule no axis exceeds its jerk, and none is slower than necessary). In coordinate systems the ramp time is
    /// the longest one of the main axes that move (P-CHAN-00758 = 1).
    pub(crate) fn path_slope(&self, x: &PathExtremes) -> SlopeLimits {
        let d = &self.dynamics;
        if self.slope.kind == SlopeKind::Step {
            return SlopeLimits::Step(step_slope(d, x, self.rapid));
        }
        let mut weakest = [f64::INFINITY; ROWS];
        for (weakest, row) in weakest.iter_mut().zip(&self.rows) {
            let row = &row[..x.first.len()];
            *weakest = least(&x.first, |i| row[i]);
        }
        let vector = &d.vector;
        let [acc, dec] = self.plateaus.map(|row| weakest[row]);
        let acc = acc.min(vector.acc_mm_s2.unwrap_or(f64::INFINITY));
        let dec = dec.min(vector.dec_mm_s2.unwrap_or(f64::INFINITY));
        let shape =
            if self.slope.kind == SlopeKind::Sin2 { RampShape::Sin2 } else { RampShape::Trapez };
        // a jerk limit bounds the peak jerk, a ramp time gives the mean jerk
        let vector_jerk = vector.jerk_mm_s3.map_or(f64::INFINITY, |jerk| jerk / shape.peak_jerk());
        // only in coordinate systems
        let of_main_axes = d.longest_ramps_of.iter().any(Option::is_some);
        let ramp = |k: usize| {
            let path = if k < 2 { acc } else { dec };
            let combined = path / weakest[self.jerks[k]].min(vector_jerk);
            combined.max(if of_main_axes { self.longest_of_main_axes(k, x) } else { 0.0 })
        };
        let constant_ramp_time = self.slope.keeps_ramp_times() && !self.rapid;
        let pair = |k: usize| {
            let first = ramp(k);
            // the same row gives the same time
            let same = self.jerks[k] == self.jerks[k + 1];
            (first, if same { first } else { ramp(k + 1) })
        };
        let ((t1, t2), (t3, t4)) = (pair(0), pair(2));
        let ramps = [t1, t2, t3, t4];
        SlopeLimits::Ramped(RampedLimits::new(shape, constant_ramp_time, acc, dec, ramps))
    }
}

impl SlopeTable {
    /// The longest time in s of a ramp over the main axes that determine it (P-CHAN-00758); 0 without such axes.
    fn longest_of_main_axes(&self, ramp: usize, x: &PathExtremes) -> f64 {
        let (plateau, jerk) = (&self.rows[self.plateaus[ramp / 2]], &self.rows[self.jerks[ramp]]);
        let moving = self
            .dynamics
            .longest_ramps_of
            .into_iter()
            .flatten()
            .filter(|axis| x.first[*axis] > 0.0);
        moving.map(|axis| plateau[axis] / jerk[axis]).fold(0.0, f64::max)
    }
}

/// Two-stage slope of a path: its value is the minimum over the axes, which gives one break point per axis.
fn step_slope(d: &ChannelDynamics, x: &PathExtremes, rapid: bool) -> StepLimits {
    let mut axes: SmallVec<[StepAxis; 9]> = d
        .axes
        .iter()
        .zip(x.first.iter())
        .filter(|(_, u)| **u > 0.0)
        .map(|(axis, u)| {
            let s = if rapid { axis.step_rapid } else { axis.step_feed };
            StepAxis {
                acc_mm_s2: s.acc_mm_s2.map(|a| a / u),
                dec_mm_s2: s.dec_mm_s2.map(|a| a / u),
                change_mm_s: s.change_mm_s / u,
            }
        })
        .collect();
    let vector = &d.vector;
    if vector.acc_mm_s2.is_some() || vector.dec_mm_s2.is_some() {
        axes.push(StepAxis {
            acc_mm_s2: [vector.acc_mm_s2.unwrap_or(f64::INFINITY); 2],
            dec_mm_s2: [vector.dec_mm_s2.unwrap_or(f64::INFINITY); 2],
            change_mm_s: f64::INFINITY,
        });
    }
    StepLimits::from_axes(&axes)
}
