//! A block in the look-ahead queue with everything that depends on it alone.

use crate::block::{Block, SlopeKind};
use crate::corner::Ends;
use crate::limit::SpeedLimit;
use crate::limits::{PathExtremes, path_slope, path_velocity};
use crate::profile::SlopeLimits;
use kontur_filters::time::CycleTime;

/// A block with its own limits, computed once when it enters the queue.
#[derive(Clone, Debug)]
pub struct Queued {
    /// The block.
    pub block: Block,
    /// Tangents and curvatures at both ends.
    pub ends: Ends,
    /// Path length in mm.
    pub length: f64,
    /// Path velocity in mm/s and what it comes from.
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
        Self {
            ends: Ends::of(&block),
            length: block.path.length(),
            velocity: path_velocity(&block, &x),
            slope: path_slope(&block, &x, cycle),
            bend: x.second.iter().copied().fold(0.0, f64::max),
            block,
        }
    }

    /// True if the profile of this block may run on across its ends with a non-zero acceleration.
    pub fn plans_across(&self) -> bool {
        let s = self.block.slope;
        s.kind == SlopeKind::Hsc || (s.optimised && s.kind != SlopeKind::Step)
    }
}
