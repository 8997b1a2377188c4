//! Override and feedhold on a running path.
//!
//! A change of the commanded speed is made from the present state, in three steps:
//! 1. the old plan is kept up to the rest at its end, as the way out that always exists;
//! 2. at the present cycle or, if that fails, 1, 2, 4, ... cycles later in the same span or at the end of a span, a
//!    *leg* takes the path from its velocity and acceleration to the new velocity with zero acceleration. It uses the
//!    limits of the block, reduced to those of the weakest block it crosses. A braking leg is only accepted if it is
//!    nowhere faster than the old plan, an accelerating one only if no cap, E word or block velocity is exceeded, and
//!    both only if the look-ahead finds a plan after it that keeps them. If the speed already approaches a permitted one
//!    with constant jerk, the look-ahead continues from the present acceleration, without a leg;
//! 3. the path after the leg goes back into the queue, the block in which the leg ends as its remainder.
//!
//! Every state that is output therefore still has a stop ahead of it. Until its leg begins the path follows the old
//! plan: shortly before a slower section, where the path is braking already, a change takes effect after that section.
//!
//! Each attempt is a transaction on the plan: the kept part, the leg and a new plan after it replace the present state,
//! which is restored if the result does not keep the tolerance.
//!
//! Tolerance monitoring (`AX_DEV`) examines a leg together with the plan after it before the leg is accepted. If the
//! tolerance cannot be kept that way, the old plan, which keeps it, continues to the next candidate. A leg that ends at
//! rest waits for such a candidate for at most the length of the kernel; then it brakes more gently ([`GENTLER`]),
//! because with filters of different delay even an acceleration moves the axes away from a straight line. If the
//! gentlest leg exceeds the tolerance too, the change waits for the first point of the old plan where it does not, at
//! the latest the rest at its end: a late stop is better than a contour error. The search after a leg begins with the
//! demands of the tolerance from the first plan of the blocks ([`Asked`]): a search from scratch takes as many rounds
//! as the first one and may end with fewer demands, so that a feedhold would make a run faster. Demands added because
//! of a leg are dropped at the next change.

mod leg;

use self::leg::{Leg, SLACK, Spot, cap_between, cut, keeps_caps};
use super::Planner;
use crate::asked::Asked;
use crate::block::SlopeKind::{Hsc, Trapez};
use crate::cap::{Cap, SpeedLimit};
use crate::deviation::What;
use crate::plan::{Plan, Segment, Start};
use crate::profile::FLAT_MM_S2;
use crate::queue::Queued;
use crate::timeline::{Entry, Moment, SAME_END_MM};
use smallvec::SmallVec;
use std::sync::Arc;

/// Shares of the acceleration for a change of speed, tried in this order where the tolerance does not permit more. What
/// counts as gentle depends on speed and filters: a slow path comes to rest within a cycle even with a small share.
pub(super) const GENTLER: [f64; 8] = [1.0, 0.5, 0.25, 0.1, 0.03, 0.01, 0.003, 0.001];

/// Result of an attempt with a leg.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    Taken,
    /// The leg ends at rest and does not keep the tolerance.
    Exceeds,
    /// No plan after the leg keeps the tolerance.
    NoWay,
}

impl Planner {
    /// Applies the requested override and feedhold.
    pub(super) fn replan(&mut self) {
        if self.changes_nothing() {
            self.active = self.wanted;
            return;
        }
        while self.fall_back().is_some() {}
        self.active = self.wanted;
        let (k, cycle) = (self.setpoint.k, self.cycle);
        let old: Vec<Entry> = self.timeline.take().into();
        let over = old.iter().take_while(|e| e.is_over(k, cycle)).count();
        let ahead = self.ahead(&old[over..]);
        for gentle in GENTLER {
            if self.change_speed(&old, over, &ahead, gentle) {
                return;
            }
        }
        // the old plan itself exceeds the tolerance, which has been reported: follow it to its rest
        self.timeline.put(old);
    }

    /// Whether neither a feedhold nor the speed of any known block changes: an override does not act on all blocks (G166,
    /// threads), nor on those that their axes limit. A leg would pass through zero acceleration.
    fn changes_nothing(&self) -> bool {
        let stays = |queued: &Arc<Queued>| Arc::ptr_eq(queued, &queued.rated(&self.wanted.ratios));
        let reserve = &self.plan.reserve.entries;
        let mut planned = self.timeline.entries().chain(reserve).flat_map(|e| &e.blocks);
        self.active.hold.is_none()
            && self.wanted.hold.is_none()
            && planned.all(|(queued, _)| stays(queued))
            && self.plan.segments.iter().all(|segment| stays(&segment.queued))
    }

    /// Changes the speed at the first point where a leg with this share of the acceleration fits; false if waiting any
    /// longer is not acceptable. `ahead` may end before the old plan does; the path then ends there.
    pub(super) fn change_speed(
        &mut self,
        old: &[Entry],
        over: usize,
        ahead: &[(f64, Segment)],
        gentle: f64,
    ) -> bool {
        let (k, cycle) = (self.setpoint.k, self.cycle);
        let gentlest = GENTLER.last() == Some(&gentle);
        let moves = self.spot(old, over, over).v > 0.0;
        // inside the entry of the present cycle, at increasing intervals
        let later = std::iter::successors(Some(1), |later| Some(2 * later));
        let inside = later.take_while(|later| {
            moves && old.get(over).is_some_and(|e| !e.is_over(k + later, cycle))
        });
        let inside: SmallVec<[(usize, u64); 32]> = inside.map(|later| (over, later)).collect();
        let ends = (over + 1..=old.len()).map(|i| (i, 0));
        let end = ahead.last().map_or(f64::INFINITY, |(s, segment)| s + segment.queued.length);
        let mut exceeds = false;
        for (i, later) in std::iter::once((over, 0)).chain(inside).chain(ends) {
            let (spot, kept) = if later > 0 {
                let mut kept = old[..=i].to_vec();
                kept[i].cut(k + later, cycle);
                (self.inside(&old[i], k + later), kept)
            } else {
                (self.spot(old, over, i), old[..i].to_vec())
            };
            if spot.s > end + SAME_END_MM {
                break;
            }
            let waited = spot.moment.cycles(cycle) - k as f64;
            if exceeds && !gentlest && waited >= f64::from(self.kernels.length()) {
                break;
            }
            let rest = behind(ahead, spot.s);
            if gentle >= 1.0 && self.may_go_on(&spot, &rest) {
                let outcome = self.install(&spot, kept.clone(), Leg::new(), rest.clone());
                if outcome == Outcome::Taken {
                    return true;
                }
            }
            if let Some(leg) = self.leg_from(&spot, &rest, &old[over..], gentle) {
                match self.install(&Spot { a: 0.0, ..spot }, kept, leg, rest) {
                    Outcome::Taken => return true,
                    outcome => exceeds |= outcome == Outcome::Exceeds,
                }
            }
        }
        false
    }

    /// All known segments from the entry of the present cycle on, each with the path length at its start.
    pub(super) fn ahead(&self, old: &[Entry]) -> Vec<(f64, Segment)> {
        let mut out: Vec<(f64, Segment)> = Vec::new();
        let mut add = |s: f64, queued: &Arc<Queued>, cap: Cap, asked: Option<Asked>| {
            // skip the remainder of a block that is already listed
            let listed = out.last().is_some_and(|(_, Segment { queued: listed, .. })| {
                let [own, other] = [queued, listed].map(|q| q.offset + q.length);
                queued.offset > listed.offset && (own - other).abs() <= SAME_END_MM
            });
            if !listed {
                let queued = queued.rated(&self.active.ratios);
                out.push((s, Segment { queued, cap, asked }));
            }
        };
        for entry in old {
            for ((queued, s_end), (cap, asked)) in entry.blocks.iter().zip(&entry.caps) {
                add(entry.s0 + (s_end - queued.length), queued, *cap, *asked);
            }
        }
        let mut s = self.plan.start.s_mm;
        for Segment { queued, cap, asked } in self.plan.asked() {
            add(s, &queued, cap, asked);
            s += queued.length;
        }
        out
    }

    /// The state at the present cycle (`i` = the entry of that cycle), or at the end of the entry before `i`.
    fn spot(&self, old: &[Entry], over: usize, i: usize) -> Spot {
        let next = old.get(i);
        if let Some(entry) = next.filter(|_| i == over) {
            return self.inside(entry, self.setpoint.k);
        }
        let before = i.checked_sub(1).and_then(|i| old.get(i)).filter(|e| !e.stops);
        let last = before.map(Entry::last).unwrap_or_default();
        Spot {
            moment: next.map_or(self.plan.start.moment, |e| e.start),
            s: next.map_or(self.plan.start.s_mm, |e| e.s0),
            v: last.v_mm_s,
            a: last.a_mm_s2,
            why: before.map_or(SpeedLimit::Stop, |e| e.why_down),
        }
    }

    /// The state in cycle `k` of an entry, or at its start if that is later.
    fn inside(&self, entry: &Entry, k: u64) -> Spot {
        let t = entry.seconds_at(k, self.cycle);
        let state = entry.profile.at(t);
        Spot {
            moment: if t > 0.0 { Moment::tick(k) } else { entry.start },
            s: entry.s0 + state.s_mm,
            v: state.v_mm_s,
            a: state.a_mm_s2,
            why: self.state.limit,
        }
    }

    /// Whether the speed already approaches a permitted one and a plan may start from the present acceleration, so that
    /// it need not be reduced first. Blocks with a tolerance, and braking under G901, are planned as a whole.
    fn may_go_on(&self, spot: &Spot, rest: &[Segment]) -> bool {
        let Some(Segment { queued: first, .. }) = rest.first() else { return false };
        let constant_jerk = |q: &Queued| matches!(q.block.slope.kind, Trapez | Hsc);
        let whole = |q: &Queued| {
            q.block.late_braking || self.kernels.any() && q.block.tolerance.ax_dev_mm.is_some()
        };
        let mut ahead = rest.iter().map(|s| &*s.queued);
        let rises = spot.a > FLAT_MM_S2;
        let falls = spot.a < -FLAT_MM_S2;
        let (settled, most) = (first.slope.settled(spot.v, spot.a), first.velocity.v_mm_s);
        self.active.hold.is_none()
            && spot.v > 0.0
            && spot.v <= most
            && (rises && settled <= most || falls && settled < most)
            && ahead.all(|q| constant_jerk(q) && !whole(q))
    }

    /// Puts the kept part and a leg on the timeline and the path after it into the plan; without a leg the plan begins
    /// with the acceleration of the spot. If the path would be too fast for the tolerance there, only the timeline is
    /// changed.
    fn install(&mut self, spot: &Spot, kept: Vec<Entry>, leg: Leg, rest: Vec<Segment>) -> Outcome {
        let speed = Cap::new(spot.v, spot.why);
        let start = Start { moment: spot.moment, s_mm: spot.s, speed, a_mm_s2: spot.a };
        let before = std::mem::replace(&mut self.plan, Plan::from_state(start));
        self.timeline.put(kept);
        let left = self.contour.part_at(spot.moment.cycles(self.cycle) - SLACK);
        let stays = self.contour.len();
        let outcome = self.follow(leg, rest);
        if outcome != Outcome::Taken {
            self.plan = before;
            self.contour.restore(stays, left);
        }
        self.report(|planner| What::Contour(planner.contour.clone()));
        outcome
    }

    /// Appends a leg and finds the way to rest after it.
    fn follow(&mut self, leg: Leg, mut rest: Vec<Segment>) -> Outcome {
        let moves = !leg.is_empty();
        let why = if self.active.hold.is_some() { SpeedLimit::Stop } else { SpeedLimit::Feed };
        for profile in leg {
            let length = profile.length();
            let mut from = 0.0;
            // a segment that it enters by rounding only follows it, see `cut`, and would be driven twice
            let along = rest.iter().take_while(|segment| {
                let inside = from <= 0.0 || length - from > SAME_END_MM;
                from += segment.queued.length;
                inside
            });
            let along: Vec<Segment> = along.cloned().collect();
            let blocks: Vec<_> = along.iter().map(|s| Arc::clone(&s.queued)).collect();
            let stops = profile.end().v_mm_s <= 0.0;
            let Start { moment, s_mm, .. } = self.plan.start;
            let mut entry = Entry::along(moment, s_mm, profile, (why, why), &blocks, stops);
            entry.hold_to(along.iter().map(Segment::limits));
            self.append(entry, 0);
            rest = cut(rest, length);
        }
        self.plan.replace(rest);
        let at_rest = self.plan.is_at_rest();
        if at_rest && self.excess().is_none() {
            return Outcome::Taken;
        }
        // the rest is longer than in the old plan, and the contour still held by the filters leaves no time to wait
        let must_rest = at_rest && (moves || self.active.hold.is_some());
        if must_rest {
            return Outcome::Exceeds;
        }
        let Some(way_out) = self.way_out() else { return Outcome::NoWay };
        if !at_rest {
            let caps: Vec<Cap> = self
                .plan
                .segments
                .iter()
                .zip(self.plan.segments.iter().skip(1))
                .map(|(before, next)| cap_between(before, next))
                .collect();
            // without an entry, a barred block: the path cannot continue at any speed
            let keeps = way_out.first().is_some_and(|entry| {
                keeps_caps(&entry.profile, entry.blocks.iter().map(|block| block.1).zip(&caps))
            });
            if !keeps {
                return Outcome::NoWay;
            }
        }
        self.plan.reserve = way_out.into();
        if at_rest {
            // later this way is no longer known
            self.fall_back();
        }
        Outcome::Taken
    }
}

/// The segments after path length `s` of the program.
fn behind(ahead: &[(f64, Segment)], s: f64) -> Vec<Segment> {
    let first = ahead.partition_point(|b| b.0 <= s).max(1) - 1;
    let rest = ahead[first.min(ahead.len())..].iter().map(|(_, segment)| segment.clone());
    let into = ahead.get(first).map_or(0.0, |b| s - b.0);
    cut(rest.collect(), into)
}
