//! A block in the look-ahead queue with all quantities that depend on it alone.
//!
//! Made by the planner from the pushed blocks, and read by [`crate::lookahead::plan`].
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! # use kontur_filters::time::CycleTime;
//! use kontur_motion::cap::{Cap, SpeedLimit};
//! use kontur_motion::queue::Queued;
//!
//! let queued = Queued::new(block(1, [0.0, 0.0], [10.0, 0.0], 100.0), CycleTime::from_us(1000).unwrap());
//! assert_eq!(queued.velocity, Cap::new(100.0, SpeedLimit::Feed));
//! assert_eq!(queued.ceiling, Cap::new(1000.0, SpeedLimit::Axis));
//! ```

use crate::block::{Block, Feed, SlopeKind};
use crate::cap::{Cap, SpeedLimit};
use crate::junction::{Ends, kink_velocity};
use crate::limits::{PathExtremes, PathSpeeds, SlopeTable};
use crate::path::{Ball, Path};
use crate::profile::SlopeLimits;
use crate::realtime::Override;
use crate::sections::joined;
use kontur_filters::time::CycleTime;
use smallvec::{SmallVec, smallvec};
use std::sync::Arc;

/// Share of the time that a stretch planned separately has to save.
const WORTH: f64 = 0.1;

/// A stretch of a block with its curvature and speed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    /// Distance of its end in mm from the present start of the block.
    pub(crate) end: f64,
    /// Largest `|q''|` of an axis in 1/mm.
    pub(crate) bend: f64,
    /// Permitted speed in mm/s.
    pub(crate) speed: f64,
}

impl Stretch {
    /// Both stretches as one.
    fn and(&self, next: &Self) -> Self {
        Self { end: next.end, bend: self.bend.max(next.bend), speed: self.speed.min(next.speed) }
    }
}

/// A block with its own limits, computed once when it enters the queue.
#[derive(Clone, Debug)]
pub struct Queued {
    /// The block, boxed where it was programmed because it is large.
    pub block: Box<Block>,
    /// Tangents and curvatures at both ends.
    pub ends: Ends,
    /// Path length in mm at which the block starts; not 0 for the remainder of a block after a change of speed inside
    /// it.
    pub offset: f64,
    /// Path length in mm from the offset to the end.
    pub length: f64,
    /// Path velocities without the real-time override.
    pub speeds: PathSpeeds,
    /// Path velocity in mm/s under the real-time override, with its reason.
    pub velocity: Cap,
    /// The path velocity if no feed rate were programmed.
    pub ceiling: Cap,
    /// Path velocity in mm/s at the end of the block under the real-time override; infinite without an E word.
    pub(crate) end_mm_s: f64,
    /// Path slope.
    pub slope: SlopeLimits,
    /// Largest `|q''|` over the axes in 1/mm; 0 for a line.
    pub bend: f64,
    /// Contains the whole path of the block; `None` for a line, whose distance costs as little as that of its ball.
    pub(crate) ball: Option<Box<Ball>>,
    /// Whether the block continues after the end of this part of it.
    pub(crate) goes_on: bool,
}

/// Path velocity under a real-time override, and the one that would result without a programmed feed rate.
fn rated(block: &Block, speeds: &PathSpeeds, ratios: &Override) -> (Cap, Cap) {
    let rated = |speeds: &PathSpeeds| {
        if block.full_override {
            speeds.limited(speeds.programmed_mm_s)
        } else {
            ratios.velocity(speeds)
        }
    };
    (rated(speeds), rated(&PathSpeeds { programmed_mm_s: f64::INFINITY, ..*speeds }))
}

/// Path velocity in mm/s at the end of a block: overrides act on the E word as on F.
fn rated_end(block: &Block, speeds: &PathSpeeds, ratios: &Override) -> f64 {
    let of_block = |e: f64| e * block.feed_ratio;
    let ratio = if block.full_override { 1.0 } else { ratios.ratio(speeds.rapid) };
    block.end_velocity_mm_s.map_or(f64::INFINITY, |e| of_block(e) * ratio)
}

impl Queued {
    /// Derives the limits of a block.
    pub fn new(block: impl Into<Box<Block>>, cycle: CycleTime) -> Self {
        let block = block.into();
        let table = SlopeTable::of(&block, cycle);
        Self::with(block, &table, &Override::default())
    }

    /// Derives the limits of a block with its table, under a real-time override.
    pub(crate) fn with(block: Box<Block>, table: &SlopeTable, ratios: &Override) -> Self {
        let x = PathExtremes::of(&block.path);
        let speeds = PathSpeeds::of(&block, &x);
        let mut queued = Self {
            ends: Ends::default(),
            offset: 0.0,
            length: 0.0,
            speeds,
            velocity: Cap::STOP,
            ceiling: Cap::STOP,
            end_mm_s: 0.0,
            slope: table.path_slope(&x),
            bend: 0.0,
            ball: None,
            goes_on: false,
            block,
        };
        queued.derive(&x, table.cycle, ratios);
        queued
    }

    /// Makes this block, which nobody has any more, another one, and returns the programmed block that it was.
    ///
    /// Value by value: replaced as a whole, a block would be copied several times.
    pub(crate) fn become_block(
        &mut self,
        block: Box<Block>,
        table: &SlopeTable,
        ratios: &Override,
    ) -> Box<Block> {
        let before = std::mem::replace(&mut self.block, block);
        let x = PathExtremes::of(&self.block.path);
        self.speeds = PathSpeeds::of(&self.block, &x);
        self.slope = table.path_slope(&x);
        self.derive(&x, table.cycle, ratios);
        before
    }

    /// Derives everything but the speeds and the slope of the block.
    fn derive(&mut self, x: &PathExtremes, cycle: CycleTime, ratios: &Override) {
        let block = &self.block;
        self.ends.follow(block);
        if block.tangential {
            let (from, to) = (&self.ends.tangent_in, &self.ends.tangent_out);
            let kink = kink_velocity(block, block, from, to, cycle, false);
            self.speeds.curve_mm_s = self.speeds.curve_mm_s.max(kink);
        }
        (self.velocity, self.ceiling) = rated(block, &self.speeds, ratios);
        self.end_mm_s = rated_end(block, &self.speeds, ratios);
        (self.offset, self.length, self.goes_on) = (0.0, block.path.length(), false);
        self.bend = x.second.iter().copied().fold(0.0, f64::max);
        self.ball = (!block.path.is_straight()).then(|| Box::new(Ball::around(&block.path)));
    }

    /// The block under a real-time override.
    pub(crate) fn rated(self: &Arc<Self>, ratios: &Override) -> Arc<Self> {
        let (velocity, ceiling) = rated(&self.block, &self.speeds, ratios);
        let of_block = rated_end(&self.block, &self.speeds, ratios);
        let end_mm_s = if self.goes_on { f64::INFINITY } else { of_block };
        let same_end = end_mm_s.to_bits() == self.end_mm_s.to_bits();
        if velocity == self.velocity && ceiling == self.ceiling && same_end {
            Arc::clone(self)
        } else {
            Arc::new(Self { velocity, ceiling, end_mm_s, ..Self::clone(self) })
        }
    }

    /// Limit of the E word at the end of the block.
    pub(crate) fn end_cap(&self) -> Cap {
        Cap::new(self.end_mm_s, SpeedLimit::Feed)
    }

    /// The remainder of the block from `s` mm after its present start on.
    pub(crate) fn remainder(self: &Arc<Self>, s: f64) -> Arc<Self> {
        if s <= 0.0 {
            return Arc::clone(self);
        }
        let mut rest = Self::clone(self);
        rest.offset += s;
        rest.length =
            if self.goes_on { self.length - s } else { self.block.path.length() - rest.offset };
        rest.block.path.tangent(rest.offset, &mut rest.ends.tangent_in);
        if let Some(curvatures) = &mut rest.ends.curvatures {
            rest.block.path.curvature(rest.offset, &mut curvatures[0]);
        }
        Arc::new(rest)
    }

    /// The first `s` mm of the remaining block.
    pub(crate) fn up_to(&self, s: f64) -> Self {
        let mut part = Self::clone(self);
        (part.length, part.goes_on, part.end_mm_s) = (s, true, f64::INFINITY);
        let end = part.offset + s;
        part.block.path.tangent(end, &mut part.ends.tangent_out);
        if let Some(curvatures) = &mut part.ends.curvatures {
            part.block.path.curvature(end, &mut curvatures[1]);
        }
        part
    }

    /// Whether braking to the feed rate of the next block may begin in that block (G901).
    pub(crate) fn brakes_late_into(&self, next: &Self) -> bool {
        self.may_brake_late() && next.block.slope.kind != SlopeKind::Hsc
    }

    /// Whether this holds for some next block.
    pub(crate) fn may_brake_late(&self) -> bool {
        let Block { late_braking, feed, slope, .. } = &*self.block;
        *late_braking && *feed != Feed::Rapid && slope.kind != SlopeKind::Hsc
    }

    /// Velocity in mm/s that the path never exceeds in this block after `before`, with any override.
    pub(crate) fn fastest_behind(&self, before: &Self) -> f64 {
        if before.brakes_late_into(self) { self.speeds.highest() } else { self.speeds.fastest() }
    }

    /// Stretches of different curvature, by the distance of their ends from the present start; a single one unless the
    /// block is a curve.
    pub(crate) fn bends(&self) -> SmallVec<[(f64, f64); 1]> {
        let Path::Curve(curve) = &self.block.path else {
            return smallvec![(self.length, self.bend)];
        };
        let mut from = 0.0;
        let mut out: SmallVec<[(f64, f64); 1]> = SmallVec::new();
        for (end, bend) in curve.bends() {
            let end = (end - self.offset).min(self.length);
            if end > from {
                out.push((end, bend.min(self.bend)));
                from = end;
            }
        }
        out
    }

    /// Largest `|q''|` of an axis in 1/mm between two distances from the present start.
    pub(crate) fn bend_between(&self, from: f64, to: f64) -> f64 {
        let mut start = 0.0;
        let inside = self.bends().into_iter().filter(|(end, _)| {
            let inside = *end >= from && start <= to;
            start = *end;
            inside
        });
        inside.map(|(_, bend)| bend).fold(0.0, f64::max)
    }

    /// The block in parts with separate speeds if that is worthwhile; otherwise in one part. `stretches` are those of
    /// [`Self::bends`], or parts of them, each with its permitted speed.
    pub(crate) fn parts(
        self: &Arc<Self>,
        stretches: impl IntoIterator<Item = Stretch>,
    ) -> Vec<Arc<Self>> {
        let stretches: Vec<Stretch> = stretches.into_iter().collect();
        let mut from = 0.0;
        let groups = joined(stretches.iter().map(|stretch| (stretch.end, stretch.speed)), WORTH);
        let groups: Vec<(f64, Stretch)> = groups
            .into_iter()
            .filter_map(|range| {
                let start = from;
                let both = stretches[range].iter().copied().reduce(|a, b| a.and(&b))?;
                from = both.end;
                Some((start, both))
            })
            .collect();
        let last = groups.len().saturating_sub(1);
        let part = |(i, (from, stretch)): (usize, (f64, Stretch))| {
            let rest = self.remainder(from);
            let part = if i < last { rest.up_to(stretch.end - from) } else { Self::clone(&rest) };
            Arc::new(Self { bend: stretch.bend, ..part })
        };
        if last == 0 {
            return vec![Arc::clone(self)];
        }
        groups.into_iter().enumerate().map(part).collect()
    }

    /// The block in three parts: its first and its last `reach_mm`, and the rest.
    pub(crate) fn with_ends_apart(self: &Arc<Self>, reach_mm: f64) -> Vec<Arc<Self>> {
        let behind = self.remainder(reach_mm);
        let middle_mm = behind.length - reach_mm;
        let last = behind.remainder(middle_mm);
        vec![Arc::new(self.up_to(reach_mm)), Arc::new(behind.up_to(middle_mm)), last]
    }

    /// See [`Slope::plans_across`](crate::block::Slope::plans_across). A block too short for a change of speed with constant
    /// ramp times is planned across as well: otherwise a polygon of such blocks would not leave the speed of its slowest
    /// kink (Assumption: P-CHAN-00349 lowers the excitation of single motions, 149301515).
    pub(crate) fn plans_across(&self) -> bool {
        let way_mm = || self.velocity.v_mm_s * self.slope.constant_ramps_s();
        self.block.slope.plans_across() || self.block.path.length() < way_mm()
    }
}
