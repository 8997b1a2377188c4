//! Whether rounding a corner saves time: a rounded corner must not take longer than the sharp one.
//!
//! A sharp corner limits the speed at one point only, to the speed allowed at its kink. A curve limits it over its whole
//! length, to what its curvature and the rate of change of that curvature allow. A small curve at a sharp corner, or between
//! two chords of a few hundredths of a millimetre, is the slower of the two. Under `AX_DEV` the set path may need a stop at the
//! sharp corner; a curve that has to be slowed down for it mostly takes longer still ([`monitored`]).
//!
//! Both are timed from the middle of the block before the corner to the middle of the block after it, as if the speed
//! had a maximum at those points. For a row of equal corners this is exact.

mod monitored;

use crate::block::Block;
use crate::junction::{Ends, transition};
use crate::limits::{PathExtremes, PathSpeeds, SlopeTable};
use crate::path::PolyPath;
use crate::profile::SlopeLimits;
use kontur_filters::time::CycleTime;
use monitored::Passing;
pub(crate) use monitored::{Monitored, OnlyPlanned};

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
    /// Largest second derivative of an axis in 1/mm, if `AX_DEV` applies.
    pub(crate) bend: f64,
}

impl Part {
    /// A part of a curve in `length_mm` of a path; `bent`: `AX_DEV` applies.
    pub(crate) fn of(path: &PolyPath, length_mm: f64, v_mm_s: f64, bent: bool) -> Self {
        let largest = || path.extremes()[1].iter().copied().fold(0.0, f64::max);
        Self { length_mm, v_mm_s, bend: if bent { largest() } else { 0.0 } }
    }
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
            self.through(slowest, &outer[skipped..], inside - at + rest)
                .map(|t| over_s(at, slowest) + t)
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
    /// `AX_DEV`, if it applies.
    pub(crate) monitored: Option<Monitored<'a>>,
    /// Share of the filter in which a curve has to pass to count as a corner under `AX_DEV`.
    pub(crate) corner_share: f64,
}

impl Passage<'_> {
    /// Whether the curve in `parts` takes no longer than the sharp corner; `pre_mm` and `post_mm` are its corner
    /// distances, `off_mm` is its distance from the corner.
    pub(crate) fn is_worth(
        &self,
        parts: &[Part],
        [pre_mm, post_mm]: [f64; 2],
        off_mm: f64,
    ) -> bool {
        // where the path stops (G116) a curve only adds a stop
        if self.to.dynamics.stop_at_transitions {
            return false;
        }
        let sides = self.sides();
        let most = || self.sharp_mm_s().min(sides[0].v_mm_s).min(sides[1].v_mm_s);
        let (mut v, mut slower, mut held_s) = (None, None, 0.0);
        if let Some(monitored) = &self.monitored {
            let (turn, most) = (self.turn(), most());
            v = Some(monitored.sharp(&sides, turn, most).v_mm_s);
            if v < Some(most) && !monitored.passes(&sides, parts, turn, off_mm) {
                return false;
            }
            let limited = monitored.limited(parts, turn, off_mm, self.corner_share);
            if limited.iter().zip(parts).any(|(limited, part)| limited.v_mm_s < part.v_mm_s) {
                held_s = monitored.reach_s();
            }
            slower = Some(limited);
        }
        let parts = slower.as_deref().unwrap_or(parts);
        let slowest = slowest(parts);
        // only the programmed feed rates limit the curve
        if sides.iter().all(|side| slowest >= AT_FEED * side.v_mm_s) {
            return true;
        }
        let v = v.unwrap_or_else(most);
        let bridged = self.bridged.iter().map(|block| self.bridged_s(block, v));
        let away = sides.iter().map(|side| side.leg(v, side.v_mm_s, side.half_mm).1);
        let sharp = bridged.chain(away).sum::<f64>();
        curve_s(&sides, parts, [pre_mm, post_mm]) + held_s <= sharp * (1.0 + SLACK)
    }

    /// Time in s over a bridged block between corners passed at `v`; where the path stops at them, from rest to rest.
    fn bridged_s(&self, block: &Block, v: f64) -> f64 {
        if v > 0.0 {
            return over_s(block.path.length(), v);
        }
        let halves = [true, false].map(|before| Side::of(block, before, self.cycle));
        halves.iter().map(|half| half.leg(v, half.v_mm_s, half.half_mm).1).sum()
    }

    /// Largest change of a component of the direction, at a corner to or from a bridged block or over all of them.
    pub(crate) fn turn(&self) -> f64 {
        let blocks = [self.from].into_iter().chain(self.bridged).chain([self.to]);
        let ends: Vec<Ends> = blocks.map(Ends::of).collect();
        let whole = ends.first().into_iter().zip(ends.last());
        let corners = whole.chain(ends.iter().zip(&ends[1..]));
        corners.map(|(a, b)| change(&a.tangent_out, &b.tangent_in)).fold(0.0, f64::max)
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

    /// Time in s for the parts before and after the corner alone, as if the speed had a maximum at both ends;
    /// `sharp`: with the sharp corner between them.
    pub(crate) fn time_s(&self, [mut parts, after]: [Vec<Part>; 2], sharp: bool) -> f64 {
        let sides = self.sides();
        let mut dwell_s = 0.0;
        if sharp {
            let most = self.sharp_mm_s();
            let free = Passing { v_mm_s: most, dwell_s: 0.0 };
            let passing = self.monitored.map_or(free, |m| m.sharp(&sides, self.turn(), most));
            dwell_s = passing.dwell_s;
            parts.push(Part { length_mm: 0.0, v_mm_s: passing.v_mm_s, bend: 0.0 });
        }
        parts.extend(after);
        if let Some(monitored) = &self.monitored {
            parts = monitored.limited(&parts, self.turn(), 0.0, self.corner_share);
        }
        dwell_s + curve_s(&sides, &parts, sides.each_ref().map(|side| side.half_mm))
    }

    fn sides(&self) -> [Side; 2] {
        [Side::of(self.from, true, self.cycle), Side::of(self.to, false, self.cycle)]
    }
}

/// Largest change of a component between two directions.
fn change(from: &[f64], to: &[f64]) -> f64 {
    from.iter().zip(to).map(|(u, w)| (w - u).abs()).fold(0.0, f64::max)
}

/// Time in s for a length at a speed; the path may stop at a point.
fn over_s(length_mm: f64, v_mm_s: f64) -> f64 {
    if length_mm > 0.0 { length_mm / v_mm_s } else { 0.0 }
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
    over_s(inner, slowest)
        + outside.map(|((side, outer), distance)| side.away(slowest, outer, distance)).sum::<f64>()
}
