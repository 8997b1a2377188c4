//! Whether rounding a corner saves time: a rounded corner must not take longer than the sharp one.
//!
//! A sharp corner limits the speed at one point only, to the speed allowed at its kink. A curve limits it over its whole
//! length, to what its curvature and the rate of change of that curvature allow. A small curve at a sharp corner, or between
//! two chords of a few hundredths of a millimetre, is the slower of the two.
//!
//! Both are timed from the middle of the block before the corner to the middle of the block after it, as if the speed
//! had a maximum at those points. For a row of equal corners this is exact.

use crate::block::Block;
use crate::junction::{Ends, transition};
use crate::limits::{PathExtremes, PathSpeeds, SlopeTable};
use crate::profile::SlopeLimits;
use kontur_filters::time::CycleTime;

/// Relative rounding error allowed when times are compared.
const SLACK: f64 = 1e-9;
/// Share of a programmed feed rate at which a curve counts as limited by it: converted units, or feed rates that differ by
/// rounding, do not decide whether a corner is rounded.
const AT_FEED: f64 = 0.999;

/// A part of a curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    pub(crate) length_mm: f64,
    /// Highest speed.
    pub(crate) v_mm_s: f64,
}

/// A block next to the corner, seen from the corner: speed rises with the distance from it on either side.
struct Side {
    slope: SlopeLimits,
    v_mm_s: f64,
    half_mm: f64,
    /// The block before the corner: away from the corner means backwards in time, so its legs are braking legs.
    before: bool,
    /// A leg may extend over several blocks.
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

    /// Highest speed, at most `limit`, that a leg from `v` reaches within `length`, and the time for the whole length.
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
    fn away(&self, slowest: f64, outer: &[Part], distance: f64) -> f64 {
        let rest = self.half_mm - distance;
        let inside: f64 = outer.iter().map(|part| part.length_mm).sum();
        let held = inside / slowest + self.leg(slowest, self.v_mm_s, rest).1;
        if !self.across {
            return held;
        }
        let limit = outer.iter().map(|part| part.v_mm_s).fold(self.v_mm_s, f64::min);
        let (v, rising) = self.leg(slowest, limit, inside);
        let in_two = rising + self.leg(v, self.v_mm_s, rest).1;
        let mut passed = 0.0;
        let starts = outer.iter().map(|part| {
            let at = passed;
            passed += part.length_mm;
            at
        });
        let at_once = starts.enumerate().find_map(|(skipped, at)| {
            self.through(slowest, &outer[skipped..], inside - at + rest).map(|t| at / slowest + t)
        });
        held.min(in_two).min(at_once.unwrap_or(f64::INFINITY))
    }

    /// Time of a single leg from `v` over `length`, if it stays within the speeds of the parts that it passes first.
    fn through(&self, v: f64, parts: &[Part], length: f64) -> Option<f64> {
        let (to, time) = self.leg(v, self.v_mm_s, length);
        // a braking leg is a speed-up reversed in time
        let profile = if self.before {
            self.slope.plan(to, v, to, length).ok()?
        } else {
            self.slope.plan(v, to, to, length).ok()?
        };
        let mut passed = 0.0;
        let kept = parts.iter().all(|part| {
            passed += part.length_mm;
            let at = if self.before { length - passed } else { passed };
            profile.at(profile.time_at(at)).v_mm_s <= part.v_mm_s * (1.0 + SLACK)
        });
        kept.then_some(time)
    }
}

/// A corner between two blocks, with the short blocks that a curve bridges.
pub(crate) struct Passage<'a> {
    pub(crate) from: &'a Block,
    pub(crate) bridged: &'a [Block],
    pub(crate) to: &'a Block,
    pub(crate) cycle: CycleTime,
    pub(crate) kernel_active: bool,
}

impl Passage<'_> {
    /// Whether the curve in `parts` takes no longer than the sharp corner; `pre_mm` and `post_mm` are its corner
    /// distances.
    pub(crate) fn is_worth(&self, parts: &[Part], pre_mm: f64, post_mm: f64) -> bool {
        // where the path stops (G116) a curve only adds a stop
        if self.to.dynamics.stop_at_transitions {
            return false;
        }
        let slowest = slowest(parts);
        let sides = self.sides();
        // only the programmed feed rates limit the curve
        if sides.iter().all(|side| slowest >= AT_FEED * side.v_mm_s) {
            return true;
        }
        let v = self.sharp_mm_s().min(sides[0].v_mm_s).min(sides[1].v_mm_s);
        let bridged: f64 = self.bridged.iter().map(|b| b.path.length()).sum();
        let over = if bridged > 0.0 { bridged / v } else { 0.0 };
        let away = sides.iter().map(|side| side.leg(v, side.v_mm_s, side.half_mm).1);
        let sharp = over + away.sum::<f64>();
        curve_s(&sides, parts, [pre_mm, post_mm]) <= sharp * (1.0 + SLACK)
    }

    /// Highest speed at the sharp corner.
    pub(crate) fn sharp_mm_s(&self) -> f64 {
        let blocks = || [self.from].into_iter().chain(self.bridged).chain([self.to]);
        let ends: Vec<Ends> = blocks().map(Ends::of).collect();
        let caps = blocks().zip(blocks().skip(1)).zip(ends.windows(2)).map(|((a, b), ends)| {
            transition(a, b, &ends[0], &ends[1], self.cycle, self.kernel_active).v_mm_s
        });
        caps.fold(f64::INFINITY, f64::min)
    }

    /// Time in s for the parts alone, as if the speed had a maximum at both ends.
    pub(crate) fn time_s(&self, parts: &[Part]) -> f64 {
        let sides = self.sides();
        curve_s(&sides, parts, sides.each_ref().map(|side| side.half_mm))
    }

    fn sides(&self) -> [Side; 2] {
        [Side::of(self.from, true, self.cycle), Side::of(self.to, false, self.cycle)]
    }
}

fn slowest(parts: &[Part]) -> f64 {
    parts.iter().map(|part| part.v_mm_s).fold(f64::INFINITY, f64::min)
}

/// Time in s for the curve and the remainder of both sides: the slowest part at its speed, everything outside it as
/// fast as one or two legs permit.
fn curve_s(sides: &[Side; 2], parts: &[Part], distances: [f64; 2]) -> f64 {
    let slowest = slowest(parts);
    let is_slow = |part: &Part| part.v_mm_s <= slowest * (1.0 + SLACK);
    let first = parts.iter().position(is_slow).unwrap_or(0);
    let last = parts.iter().rposition(is_slow).unwrap_or(parts.len() - 1);
    let outer = [parts[..first].iter().rev().copied().collect(), parts[last + 1..].to_vec()];
    let inner: f64 = parts[first..=last].iter().map(|part| part.length_mm).sum();
    let outside = sides.iter().zip(&outer).zip(distances);
    inner / slowest
        + outside.map(|((side, outer), distance)| side.away(slowest, outer, distance)).sum::<f64>()
}
