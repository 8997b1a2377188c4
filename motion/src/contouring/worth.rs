//! Whether the curve at a corner is worth it: a rounded corner may not take longer than the sharp one.
//!
//! A sharp corner is a point that is passed with the speed of its kink; a curve is passed over its whole length with the
//! speed that its curvature and the change of it allow. A small curve at a sharp corner, or at the flat one between two
//! chords of a hundredth of a millimetre, has the lower speed, and over a longer way.
//!
//! Both are timed from the middle of the block before the corner to the middle of the one after it, as if the speed had its
//! peak there: in a row of equal corners these are the times of the whole row.

use crate::block::Block;
use crate::junction::{Ends, transition};
use crate::limits::{PathExtremes, PathSpeeds, SlopeTable};
use crate::profile::SlopeLimits;
use kontur_filters::time::CycleTime;

/// Part of the time of the sharp corner that the estimate of a curve may be above it.
const SLACK: f64 = 1e-9;

/// A block next to the corner, seen from there; both are driven away from the corner, in time or against it.
struct Side {
    slope: SlopeLimits,
    v_mm_s: f64,
    half_mm: f64,
    /// Time runs towards the corner: the speed is built up by braking.
    before: bool,
    /// A leg may pass several blocks.
    across: bool,
}

impl Side {
    fn of(block: &Block, before: bool, cycle: CycleTime) -> Self {
        let x = PathExtremes::of(&block.path);
        let speeds = PathSpeeds::of(block, &x);
        Self {
            slope: SlopeTable::of(block, cycle).path_slope(&x),
            v_mm_s: speeds.limited(speeds.programmed_mm_s).v_mm_s,
            half_mm: 0.5 * block.path.length(),
            before,
            across: block.slope.plans_across(),
        }
    }

    /// Highest speed, at most `limit`, with which a leg from `v` ends within `length`, and its time over all of it.
    fn leg(&self, v: f64, limit: f64, length: f64) -> (f64, f64) {
        let v = v.min(limit);
        let slope = &self.slope;
        let (reach, distance, time) = if self.before {
            let to = slope.reach_down(v, length).min(limit).max(v);
            (to, slope.down_distance(to, v), slope.down_time(to, v))
        } else {
            let to = slope.reach_up(v, length).min(limit).max(v);
            (to, slope.up_distance(v, to), slope.up_time(v, to))
        };
        (reach, time + (length - distance).max(0.0) / reach)
    }

    /// Time from the slowest part of a curve to the middle of the block: `outer` has length and speed of the parts in
    /// between, from the slowest one on, `distance` is the corner distance.
    fn away(&self, slowest: f64, outer: &[(f64, f64)], distance: f64) -> f64 {
        let rest = self.half_mm - distance;
        let inside: f64 = outer.iter().map(|part| part.0).sum();
        let held = inside / slowest + self.leg(slowest, self.v_mm_s, rest).1;
        if !self.across {
            return held;
        }
        let limit = outer.iter().map(|part| part.1).fold(self.v_mm_s, f64::min);
        let (v, rising) = self.leg(slowest, limit, inside);
        let in_two = rising + self.leg(v, self.v_mm_s, rest).1;
        let mut passed = 0.0;
        let starts = outer.iter().map(|part| {
            let at = passed;
            passed += part.0;
            at
        });
        let at_once = starts.enumerate().find_map(|(skipped, at)| {
            self.through(slowest, &outer[skipped..], inside - at + rest).map(|t| at / slowest + t)
        });
        held.min(in_two).min(at_once.unwrap_or(f64::INFINITY))
    }

    /// Time of one leg from `v` over `length`, if it keeps the speeds of the parts that it passes first.
    fn through(&self, v: f64, parts: &[(f64, f64)], length: f64) -> Option<f64> {
        let (to, time) = self.leg(v, self.v_mm_s, length);
        // in time or against it, the leg is the same
        let profile = if self.before {
            self.slope.plan(to, v, to, length).ok()?
        } else {
            self.slope.plan(v, to, to, length).ok()?
        };
        let mut passed = 0.0;
        let kept = parts.iter().all(|(part, cap)| {
            passed += part;
            let at = if self.before { length - passed } else { passed };
            profile.at(profile.time_at(at)).v_mm_s <= cap * (1.0 + SLACK)
        });
        kept.then_some(time)
    }
}

/// A corner between two blocks, with those that a curve bridges.
pub(super) struct Passage<'a> {
    pub(super) from: &'a Block,
    pub(super) bridged: &'a [Block],
    pub(super) to: &'a Block,
    pub(super) cycle: CycleTime,
    pub(super) kernel_active: bool,
}

impl Passage<'_> {
    /// True if the curve in `parts`, each with its speed in mm/s, is passed at least as fast as the sharp corner; `pre_mm` and
    /// `post_mm` are its corner distances.
    pub(super) fn is_worth(&self, parts: &[(Block, f64)], pre_mm: f64, post_mm: f64) -> bool {
        let slowest = parts.iter().map(|part| part.1).fold(f64::INFINITY, f64::min);
        let sides = [Side::of(self.from, true, self.cycle), Side::of(self.to, false, self.cycle)];
        // nothing but the feed that one of the blocks is programmed with holds the curve down
        if sides.iter().any(|side| slowest >= side.v_mm_s) {
            return true;
        }
        let sharp = self.sharp_s(&sides);
        curve_s(&sides, parts, slowest, [pre_mm, post_mm]) <= sharp * (1.0 + SLACK)
    }

    fn sharp_s(&self, sides: &[Side; 2]) -> f64 {
        let blocks = || [self.from].into_iter().chain(self.bridged).chain([self.to]);
        let ends: Vec<Ends> = blocks().map(Ends::of).collect();
        let caps = blocks().zip(blocks().skip(1)).zip(ends.windows(2)).map(|((a, b), ends)| {
            transition(a, b, &ends[0], &ends[1], self.cycle, self.kernel_active).v_mm_s
        });
        let v = caps.fold(f64::INFINITY, f64::min).min(sides[0].v_mm_s).min(sides[1].v_mm_s);
        let bridged: f64 = self.bridged.iter().map(|b| b.path.length()).sum();
        let over = if bridged > 0.0 { bridged / v } else { 0.0 };
        over + sides.iter().map(|side| side.leg(v, side.v_mm_s, side.half_mm).1).sum::<f64>()
    }
}

/// Time of the curve and of what is left of both sides: the slowest part with its speed, what lies outside as fast as
/// one leg, or two, allow.
fn curve_s(sides: &[Side; 2], parts: &[(Block, f64)], slowest: f64, distances: [f64; 2]) -> f64 {
    let is_slow = |part: &&(Block, f64)| part.1 <= slowest * (1.0 + SLACK);
    let first = parts.iter().position(|part| is_slow(&part)).unwrap_or(0);
    let last = parts.iter().rposition(|part| is_slow(&part)).unwrap_or(parts.len() - 1);
    let lengths = |parts: &mut dyn Iterator<Item = &(Block, f64)>| {
        parts.map(|(block, v)| (block.path.length(), *v)).collect::<Vec<_>>()
    };
    let outer = [lengths(&mut parts[..first].iter().rev()), lengths(&mut parts[last + 1..].iter())];
    let inner: f64 = parts[first..=last].iter().map(|part| part.0.path.length()).sum();
    let outside = sides.iter().zip(&outer).zip(distances);
    inner / slowest
        + outside.map(|((side, outer), distance)| side.away(slowest, outer, distance)).sum::<f64>()
}
