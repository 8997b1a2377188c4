//! The leg of a change of speed: from the velocity and acceleration of a spot to another velocity with zero acceleration, with the limits of
//! the weakest block that it crosses.

use super::super::Planner;
use super::super::feedhold::feedhold_slope;
use crate::cap::{Cap, SpeedLimit};
use crate::lookahead::plan;
use crate::plan::Segment;
use crate::profile::{Profile, SlopeLimits};
use crate::queue::Queued;
use crate::timeline::{Entry, Moment, SAME_END_MM, SAME_LENGTH};
use smallvec::{SmallVec, smallvec};
use std::sync::Arc;

/// Relative slack of comparisons of velocities.
pub(super) const SLACK: f64 = 1e-9;
/// Velocity in mm/s that counts as zero at the end of a profile.
const ROUNDING_MM_S: f64 = 1e-6;

/// One or two profiles in a row.
pub(super) type Leg = SmallVec<[Profile; 2]>;

/// A point at which a leg may begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub(super) moment: Moment,
    /// Path length of the program in mm.
    pub(super) s: f64,
    pub(super) v: f64,
    pub(super) a: f64,
    pub(super) why: SpeedLimit,
}

/// Purpose of a leg.
#[derive(Clone, Copy, Debug)]
enum Aim {
    /// None: the acceleration is zero and the velocity not too high.
    Stay,
    /// Reduce the acceleration to zero at once.
    Settle,
    /// Rise to a velocity from a positive acceleration.
    Rise(f64),
    /// Brake to a velocity; a positive acceleration is brought to zero first.
    Brake(f64),
}

impl Planner {
    /// The leg from a spot; `None` if the old plan has to continue.
    pub(super) fn leg_from(
        &self,
        spot: &Spot,
        rest: &[Segment],
        old: &[Entry],
        gentle: f64,
    ) -> Option<Leg> {
        if spot.v > 0.0 { self.leg(spot, rest, old, gentle) } else { Some(Leg::new()) }
    }

    /// Slope of a block during the change of speed, with a share of the acceleration.
    fn slope_of(&self, queued: &Queued, gentle: f64) -> SlopeLimits {
        let slope = match self.active.hold {
            Some(braking) => feedhold_slope(queued, braking, self.cycle),
            None => queued.slope.clone(),
        };
        if gentle < 1.0 { slope.scaled(gentle) } else { slope }
    }

    /// The leg from a spot in motion; `None` if the old plan has to continue.
    fn leg(&self, spot: &Spot, rest: &[Segment], old: &[Entry], gentle: f64) -> Option<Leg> {
        let first = &rest.first()?.queued;
        let target = if self.active.hold.is_some() { 0.0 } else { first.velocity.v_mm_s };
        let slope = self.slope_of(first, gentle);
        let settled = slope.settled(spot.v, spot.a);
        let steady = (settled - spot.v).abs() <= 1e-12 * spot.v;
        let spot = Spot { a: if steady { 0.0 } else { spot.a }, ..*spot };
        // the old plan keeps the tolerance, and so does any slower speed; a faster one has to be examined first
        let monitored =
            self.kernels.any() && rest.iter().any(|s| s.queued.block.tolerance.ax_dev_mm.is_some());
        // where the way to the speed of an E word is too short for two changes of speed
        let (ends_slower, to_end) =
            (first.end_mm_s < target.min(settled), Aim::Brake(first.end_mm_s));
        let aims: &[Aim] = if steady {
            if spot.v <= target { &[Aim::Stay] } else { &[Aim::Brake(target)] }
        } else if spot.a > 0.0 {
            if settled <= target && monitored {
                &[Aim::Settle]
            } else if settled <= target {
                &[Aim::Rise(target), Aim::Settle]
            } else {
                &[Aim::Brake(target)]
            }
        } else if settled >= target {
            if ends_slower { &[Aim::Brake(target), to_end] } else { &[Aim::Brake(target)] }
        } else if monitored {
            return None;
        } else if ends_slower {
            &[Aim::Settle, to_end]
        } else {
            &[Aim::Settle]
        };
        aims.iter().find_map(|aim| self.fit(*aim, &spot, (&slope, gentle), rest, old))
    }

    /// The leg for one aim, with the weakest limits of the blocks it crosses.
    fn fit(
        &self,
        aim: Aim,
        spot: &Spot,
        (first, gentle): (&SlopeLimits, f64),
        rest: &[Segment],
        old: &[Entry],
    ) -> Option<Leg> {
        let mut slope = first.clone();
        // distances of the boundaries crossed
        let mut crossed: SmallVec<[f64; 8]> = SmallVec::new();
        let mut reach = rest.first()?.queued.length;
        let leg = loop {
            let leg = profiles(aim, spot, &slope)?;
            let length: f64 = leg.iter().map(Profile::length).sum();
            // a ramp that was planned to end with the block ends at that boundary
            if length <= reach * (1.0 + SAME_LENGTH) {
                break leg;
            }
            let queued = &rest.get(crossed.len() + 1)?.queued;
            let own = self.slope_of(queued, gentle);
            if !slope.is_like(&own) {
                return None;
            }
            slope = slope.weaker(&own);
            crossed.push(reach);
            reach += queued.length;
        };
        let length: f64 = leg.iter().map(Profile::length).sum();
        let v_end = leg.last().map_or(spot.v, |c| c.end().v_mm_s);
        let falls = matches!(aim, Aim::Brake(_));
        if falls {
            // the leg enters a slower block
            let crossed = rest[1..=crossed.len()].iter().map(|s| s.queued.velocity.v_mm_s);
            let slowest = crossed.fold(f64::INFINITY, f64::min);
            if slowest < v_end * (1.0 - SLACK) {
                return self.fit(Aim::Brake(slowest), spot, (first, gentle), rest, old);
            }
        }
        let kept = if falls {
            let not_faster =
                |s: f64, v: f64| v <= speed_at(old, spot.s + s) * (1.0 + SLACK) + SLACK;
            let mut s = 0.0;
            crossed.iter().all(|s| not_faster(*s, speed_in(&leg, *s)))
                && leg.iter().all(|c| {
                    s += c.length();
                    not_faster(s, c.end().v_mm_s)
                })
        } else {
            let ends_there = length >= reach * (1.0 - SAME_LENGTH);
            let passed = crossed.iter().chain(ends_there.then_some(&reach));
            passed.zip(rest.windows(2)).all(|(s, pair)| {
                let (Segment { queued, .. }, cap) = (&pair[1], cap_between(&pair[0], &pair[1]));
                let v = speed_in(&leg, *s);
                v <= cap.v_mm_s * (1.0 + SLACK)
                    && v.max(v_end) <= queued.velocity.v_mm_s * (1.0 + SLACK)
            })
        };
        (kept && (v_end <= 0.0 || goes_on(&cut(rest.to_vec(), length), v_end))).then_some(leg)
    }
}

/// The segments after the first `s` mm; a remainder no longer than rounding is dropped, and of the segment after a dropped one
/// nothing that short is missing.
pub(super) fn cut(mut blocks: Vec<Segment>, mut s: f64) -> Vec<Segment> {
    let mut gone = 0;
    // a leg to the end of a block and the remainder of the block are computed by different formulas
    let is_over = |length: f64, s: f64| {
        s >= length * (1.0 - SAME_LENGTH) || s > 0.0 && length - s <= SAME_END_MM
    };
    while gone < blocks.len() && is_over(blocks[gone].queued.length, s) {
        s = (s - blocks[gone].queued.length).max(0.0);
        gone += 1;
    }
    blocks.drain(..gone);
    if let Some(first) = blocks.first_mut().filter(|_| gone == 0 || s > SAME_END_MM) {
        first.queued = first.queued.remainder(s);
    }
    blocks
}

fn profiles(aim: Aim, spot: &Spot, slope: &SlopeLimits) -> Option<Leg> {
    let (v, a) = (spot.v, spot.a);
    let settled = slope.settled(v, a);
    Some(match aim {
        Aim::Stay => Leg::new(),
        Aim::Settle => smallvec![slope.change(v, a, settled)?],
        Aim::Rise(target) => smallvec![slope.change(v, a, target)?],
        Aim::Brake(target) if a < 0.0 => smallvec![slope.change(v, a, target)?],
        Aim::Brake(target) => {
            let mut leg = Leg::new();
            if a > 0.0 && settled > v {
                leg.push(slope.change(v, a, settled)?);
            }
            let length = slope.down_distance(settled, target);
            leg.push(slope.plan(settled, target, settled, length).ok()?);
            leg
        }
    })
}

/// Speed limit between two segments: that of the corner and that of an E word.
pub(super) fn cap_between(before: &Segment, next: &Segment) -> Cap {
    next.cap.lower(before.queued.end_cap())
}

/// Velocity of a leg after `s` mm.
fn speed_in(leg: &[Profile], mut s: f64) -> f64 {
    let mut v = 0.0;
    for profile in leg {
        v = speed_after(profile, s);
        if s <= profile.length() {
            break;
        }
        s -= profile.length();
    }
    v
}

/// Velocity of the old plan at a path length of the program.
fn speed_at(old: &[Entry], s: f64) -> f64 {
    let i = old.partition_point(|e| e.s0 <= s).max(1) - 1;
    old.get(i).map_or(0.0, |e| speed_after(&e.profile, s - e.s0))
}

/// Whether the look-ahead finds a plan that starts with `v`.
fn goes_on(rest: &[Segment], v: f64) -> bool {
    let (mut blocks, mut caps, mut feeds) = (Vec::new(), Vec::new(), Vec::new());
    for segment in rest.iter().take_while(|s| s.queued.velocity.v_mm_s > 0.0) {
        feeds.push(segment.queued.velocity);
        blocks.push(Arc::clone(&segment.queued));
        caps.push(
            caps.len().checked_sub(1).map_or(segment.cap, |i| cap_between(&rest[i], segment)),
        );
    }
    caps.push(Cap::STOP);
    let free = vec![false; caps.len()];
    if blocks.is_empty() {
        return false;
    }
    let start = (Cap::new(v, SpeedLimit::Feed), 0.0);
    let spans = plan(&blocks, &feeds, &caps, &free, start, SpeedLimit::Stop);
    spans.is_ok_and(|spans| {
        let mut s = 0.0;
        let ends = blocks[..spans[0].end].iter().map(|q| {
            s += q.length;
            s
        });
        keeps_caps(&spans[0].profile, ends.zip(&caps[1..blocks.len()]))
    })
}

/// Whether a profile passes boundaries, given by their distance from its start in mm, at permitted speeds. The
/// look-ahead plans across a boundary whose speed is out of reach from the start.
pub(super) fn keeps_caps<'a>(
    profile: &Profile,
    mut ends: impl Iterator<Item = (f64, &'a Cap)>,
) -> bool {
    ends.all(|(s, cap)| speed_after(profile, s) <= cap.v_mm_s * (1.0 + SLACK) + ROUNDING_MM_S)
}

/// Velocity of a profile after `s` mm.
fn speed_after(profile: &Profile, s: f64) -> f64 {
    profile.at(profile.time_at(s)).v_mm_s
}
