//! A block in the look-ahead queue with everything that depends on it alone.

use crate::block::{Block, SlopeKind};
use crate::corner::Ends;
use crate::limit::SpeedLimit;
use crate::limits::{PathExtremes, PathSpeeds, path_slope};
use crate::profile::SlopeLimits;
use crate::realtime::Override;
use kontur_filters::time::CycleTime;
use std::sync::Arc;

/// A block with its own limits, computed once when it enters the queue.
#[derive(Clone, Debug)]
pub struct Queued {
    /// The block.
    pub block: Block,
    /// Tangents and curvatures at both ends.
    pub ends: Ends,
    /// Path length in mm at which the block starts: not 0 for the rest of a block after a change of speed inside it.
    pub offset: f64,
    /// Path length in mm from the offset to the end.
    pub length: f64,
    /// Path velocities without the real-time override.
    pub speeds: PathSpeeds,
    /// Path velocity in mm/s under the real-time override, and what it comes from.
    pub velocity: (f64, SpeedLimit),
    /// Path slope.
    pub slope: SlopeLimits,
    /// Largest `|q''|` over the axes in 1/mm; 0 for a line.
    pub bend: f64,
}

impl Queued {
    /// Derives the limits of a block.
    pub fn new(block: Block, cycle: CycleTime) -> Self {
        let x = PathExtremes::of(&block.path);
        let speeds = PathSpeeds::of(&block, &x);
        Self {
            offset: 0.0,
            speeds,
            ends: Ends::of(&block),
            length: block.path.length(),
            velocity: speeds.limited(speeds.programmed_mm_s),
            slope: path_slope(&block, &x, cycle),
            bend: x.second.iter().copied().fold(0.0, f64::max),
            block,
        }
    }

    /// The block under a real-time override.
    pub(crate) fn rated(self: &Arc<Self>, ratios: &Override) -> Arc<Self> {
        let velocity = if self.block.full_override {
            self.speeds.limited(self.speeds.programmed_mm_s)
        } else {
            ratios.velocity(&self.speeds)
        };
        if velocity == self.velocity {
            Arc::clone(self)
        } else {
            Arc::new(Self { velocity, ..Self::clone(self) })
        }
    }

    /// What is left of the block `s` mm behind its present start.
    pub(crate) fn remainder(self: &Arc<Self>, s: f64) -> Arc<Self> {
        if s <= 0.0 {
            return Arc::clone(self);
        }
        let mut rest = Self::clone(self);
        rest.offset += s;
        rest.length = rest.block.path.length() - rest.offset;
        rest.block.path.tangent(rest.offset, &mut rest.ends.tangent_in);
        rest.block.path.curvature(rest.offset, &mut rest.ends.curvature_in);
        Arc::new(rest)
    }

    /// True if the profile of this block may run on across its ends with a non-zero acceleration.
    pub fn plans_across(&self) -> bool {
        let s = self.block.slope;
        s.kind == SlopeKind::Hsc || (s.optimised && s.kind != SlopeKind::Step)
    }
}
