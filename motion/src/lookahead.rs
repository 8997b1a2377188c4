//! Look-ahead: the speed at every block boundary of a window.
//!
//! Stages, each reads what the ones before guarantee:
//! 1. *caps* (caller): the velocity that each boundary allows for itself, see [`crate::corner`];
//! 2. *knots*: boundaries where the acceleration is zero. STEP: every boundary (its acceleration may jump anyway).
//!    Constant ramp times (P-CHAN-00349): every boundary except those inside a run of blocks with equal feed, (nearly)
//!    equal slope and no binding cap - such a run is one span. TRAPEZ, SIN2, HSC: the local minima of the speed, unless
//!    they are so close to each other that a stop of the acceleration costs speed. Where braking under G901 begins, see
//!    [`late`];
//! 3. *backward pass*: no knot is faster than what can still be braked to the next one, so the window ends at rest;
//! 4. *forward pass*: no knot is faster than what can be reached from the one before;
//! 5. *check* (TRAPEZ, SIN2, HSC): a span that exceeds a limit inside, or whose blocks differ in acceleration, is planned
//!    along its limits, see [`crate::ride`]; where that is refused, the boundary that is exceeded most becomes a knot, and
//!    3 to 5 are repeated.
//!
//! Guarantee: every span is feasible, and by induction a stop is possible from every state that is ever output, because
//! the passes only lower velocities and `reach_down` is monotone.
//!
//! Called by the planner with what is in the queue, again for every window.
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! # use kontur_filters::time::CycleTime;
//! use kontur_motion::limit::{Cap, SpeedLimit};
//! use kontur_motion::lookahead::plan;
//! use kontur_motion::queue::Queued;
//!
//! let cycle = CycleTime::from_us(1000).unwrap();
//! let blocks = [block(1, [0.0, 0.0], [20.0, 0.0], 100.0), block(2, [20.0, 0.0], [20.0, 20.0], 100.0)];
//! let blocks = blocks.map(|block| Arc::new(Queued::new(block, cycle)));
//! let feeds: Vec<_> = blocks.iter().map(|queued| queued.velocity).collect();
//! let caps = [Cap::STOP, Cap::new(3.5, SpeedLimit::Corner)];
//! let start = (Cap::STOP, 0.0);
//! let spans = plan(&blocks, &feeds, &caps, &[false; 2], start, SpeedLimit::Stop).unwrap();
//! // from rest to the corner, from there to rest
//! assert!((spans[0].profile.at(spans[0].profile.duration()).v_mm_s - 3.5).abs() < 1e-6);
//! assert_eq!(spans.last().unwrap().end, 2);
//! ```

mod late;

use crate::limit::{Cap, SpeedLimit};
use crate::profile::{Infeasible, Rates, SlopeLimits, SpanProfile};
use crate::queue::Queued;
use crate::ride::{Cell, has_hill, ride};
use std::sync::Arc;

/// Relative difference of path acceleration up to which blocks of one run are planned as one span with the smaller
/// value (Assumption: a CAM contour changes its direction from block to block by little, and the control does not
/// stop accelerating there).
const NEARLY_EQUAL: f64 = 0.1;

/// Relative difference of path acceleration from which on blocks planned across are not planned with the weakest of them.
const UNEVEN: f64 = 0.01;

/// Relative difference of speeds that is rounding.
const ROUNDING: f64 = 1e-7;

/// Acceleration that is zero but for rounding.
const FLAT_MM_S2: f64 = 1e-6;

/// Blocks planned as one profile.
#[derive(Clone, Debug)]
pub struct Span {
    /// Index of the first block in the window.
    pub first: usize,
    /// Index behind the last block.
    pub end: usize,
    /// The profile.
    pub profile: SpanProfile,
    /// What held the speed down while accelerating.
    pub why_up: SpeedLimit,
    /// What held the speed down while braking.
    pub why_down: SpeedLimit,
}

struct Stretch {
    first: usize,
    end: usize,
    length: f64,
    feed: f64,
    slope: SlopeLimits,
}

/// What is planned: blocks with what each of them and each boundary allows. Entry `i` of `caps`, `forced`, `entries` and
/// `carried` belongs to the boundary before block `i`.
#[derive(Clone, Debug)]
struct Window<'a> {
    blocks: &'a [Arc<Queued>],
    feeds: &'a [Cap],
    caps: &'a [Cap],
    forced: &'a [bool],
    v_start: Cap,
    a_start: f64,
    end: SpeedLimit,
    /// Speed at which a block may be entered: its feed, or more under G901.
    entries: Vec<Cap>,
    /// Braking under G901 goes on across the boundary.
    carried: Vec<bool>,
}

/// Plans a window of blocks from `v_start` to rest, in spans that cover every block. An acceleration at the start (mm/s2) is the one at which a plan of
/// constant jerk was left.
///
/// `caps[i]` belongs to the boundary before block `i`; `caps[0]` is not read. `forced` boundaries are knots.
///
/// # Errors
/// [`Infeasible`] if even the slowest plan does not fit, which the passes exclude; it would be an internal error.
pub fn plan(
    blocks: &[Arc<Queued>],
    feeds: &[Cap],
    caps: &[Cap],
    forced: &[bool],
    (v_start, a_start): (Cap, f64),
    end: SpeedLimit,
) -> Result<Vec<Span>, Infeasible> {
    if blocks.is_empty() {
        return Ok(Vec::new());
    }
    let (entries, carried) = (feeds.to_vec(), vec![false; blocks.len()]);
    // where a plan was left inside, its speed has been computed in another way
    let rounded = !is_above(v_start.v_mm_s, feeds[0].v_mm_s) && a_start.abs() > FLAT_MM_S2;
    let v_start =
        if rounded { v_start.lower(Cap { v_mm_s: feeds[0].v_mm_s, ..v_start }) } else { v_start };
    let early = Window { blocks, feeds, caps, forced, v_start, a_start, end, entries, carried };
    match late::entries(blocks, feeds) {
        Some(entries) => late::plan(&early, entries),
        None => early.plan(),
    }
}

impl Window<'_> {
    /// Speed and reason that the boundary before block `b` allows.
    fn limit(&self, b: usize) -> Cap {
        self.caps[b].lower(self.feeds[b - 1]).lower(self.entries[b])
    }

    fn plan(&self) -> Result<Vec<Span>, Infeasible> {
        let Self { blocks, feeds, caps, .. } = *self;
        let n = blocks.len();
        let mut knot = vec![false; n + 1];
        (knot[0], knot[n]) = (true, true);
        let plain = self.mark_knots(&mut knot);
        let mut soft = self.minima(&knot, &plain);
        let mut known: Vec<Span> = Vec::new();
        loop {
            let all: Vec<bool> = knot.iter().zip(&soft).map(|(k, s)| *k || *s).collect();
            let stretches = self.stretches(&all);
            let speeds = self.passes(&stretches);
            if self.drop_lowered(&stretches, &speeds, &knot, &mut soft) {
                continue;
            }
            let mut spans: Vec<Span> = Vec::with_capacity(stretches.len());
            let mut again = false;
            // a speed that is final already; the plan that it comes from goes on
            if !self.keeps(&stretches[0], speeds[0].v_mm_s, speeds[1].v_mm_s) {
                let (length_mm, needed_mm) = (stretches[0].length, f64::INFINITY);
                return Err(Infeasible { length_mm, needed_mm });
            }
            for (k, s) in stretches.iter().enumerate() {
                let (from, to) = (speeds[k], speeds[k + 1]);
                if let Some(same) = unchanged(&known, s, from.v_mm_s, to.v_mm_s) {
                    spans.push(same);
                    continue;
                }
                #[cfg(test)]
                crate::work::add();
                let a0 = if k == 0 { self.a_start } else { 0.0 };
                if a0.abs() > FLAT_MM_S2 {
                    let going_on = cells(blocks, feeds, caps, s.first, s.end)
                        .and_then(|cells| ride(&cells, (from.v_mm_s, a0), to.v_mm_s));
                    let Some(chain) = going_on else {
                        if s.end < blocks.len() && soft[s.end] && !knot[s.end] {
                            soft[s.end] = false;
                            again = true;
                            break;
                        }
                        return Err(Infeasible { length_mm: s.length, needed_mm: f64::INFINITY });
                    };
                    let (first, end) = (s.first, s.end);
                    let (why_up, why_down) = (from.why, to.why);
                    let profile = SpanProfile::from_chain(chain);
                    spans.push(Span { first, end, profile, why_up, why_down });
                    continue;
                }
                let mut profile = s.profile(from.v_mm_s, to.v_mm_s)?;
                if s.end - s.first > 1 && blocks[s.first].plans_across() && !s.is_above(from.v_mm_s)
                {
                    let worst = most_exceeded(blocks, feeds, caps, s, &profile);
                    let chain = (worst.is_some() || s.is_uneven(blocks, profile.peak()))
                        .then(|| cells(blocks, feeds, caps, s.first, s.end))
                        .flatten()
                        .and_then(|cells| ride(&cells, (from.v_mm_s, 0.0), to.v_mm_s));
                    match (chain.map(SpanProfile::from_chain), worst) {
                        (Some(ride), None) if ride.duration() >= profile.duration() => {}
                        (Some(ride), _) => profile = ride,
                        (None, Some(worst)) => {
                            knot[worst] = true;
                            again = true;
                        }
                        (None, None) => {}
                    }
                }
                spans.push(Span {
                    first: s.first,
                    end: s.end,
                    profile,
                    why_up: from.why,
                    why_down: to.why,
                });
            }
            if !again {
                return Ok(spans);
            }
            known = spans;
        }
    }

    /// Boundaries at which the fastest speed without a jerk limit has a local minimum worth the name: there the acceleration
    /// passes through zero in any case, so they are knots that cost nothing. `plain`: blocks that are not planned across.
    fn minima(&self, knot: &[bool], plain: &[bool]) -> Vec<bool> {
        let blocks = self.blocks;
        let n = blocks.len();
        let mut square: Vec<f64> =
            (1..n).map(|i| self.limit(i).v_mm_s * self.limit(i).v_mm_s).collect();
        square.insert(0, self.v_start.v_mm_s * self.v_start.v_mm_s);
        square.push(0.0);
        let own = square.clone();
        let gain = |i: usize, up: bool| {
            rates(&blocks[i])
                .map_or(0.0, |r| 2.0 * blocks[i].length * if up { r.acc } else { r.dec })
        };
        for i in (0..n).rev() {
            square[i] = square[i].min(square[i + 1] + gain(i, false));
        }
        for i in 0..n {
            square[i + 1] = square[i + 1].min(square[i] + gain(i, true));
        }
        let own_hill = |i: usize| {
            let v = square[i].max(square[i + 1]).sqrt();
            rates(&blocks[i]).is_some_and(|r| has_hill(blocks[i].length, v, &r))
        };
        (0..=n)
            .map(|i| {
                i > 0
                    && i < n
                    && !knot[i]
                    && !plain[i]
                    && blocks[i].plans_across()
                    && rates(&blocks[i]).is_some()
                    && square[i] >= own[i]
                    && (square[i] <= square[i - 1] || own_hill(i - 1))
                    && (square[i] <= square[i + 1] || own_hill(i))
            })
            .collect()
    }

    /// Drops the minima at which acceleration zero would cost speed; true if there were any.
    fn drop_lowered(
        &self,
        stretches: &[Stretch],
        speeds: &[Cap],
        knot: &[bool],
        soft: &mut [bool],
    ) -> bool {
        let mut any = false;
        // from the speed at the start, which is final, the first one may be out of reach
        if let [first, second, ..] = stretches {
            let (v0, v1) = (speeds[0].v_mm_s, speeds[1].v_mm_s);
            if soft[second.first] && first.slope.down_distance(v0.max(v1), v1) > first.length {
                soft[second.first] = false;
                any = true;
            }
        }
        for (s, v) in stretches.iter().zip(speeds).skip(1) {
            let b = s.first;
            if soft[b] && !knot[b] && v.v_mm_s < self.limit(b).v_mm_s * (1.0 - 1e-9) {
                soft[b] = false;
                any = true;
            }
        }
        any
    }

    /// Marks the boundaries that are knots in any case. Returns which blocks are planned as with plain TRAPEZ or SIN2: the
    /// run of equal feed in which braking under G901 begins.
    fn mark_knots(&self, knot: &mut [bool]) -> Vec<bool> {
        let Self { blocks, feeds, caps, .. } = *self;
        let mut run = 0;
        let mut plain = vec![false; blocks.len()];
        plain[0] = is_above(self.v_start.v_mm_s, feeds[0].v_mm_s);
        for i in 1..blocks.len() {
            let (a, b) = (&blocks[i - 1], &blocks[i]);
            let drops = is_above(self.entries[i].v_mm_s, feeds[i].v_mm_s);
            let joined = self.carried[i]
                || !self.forced[i]
                    && a.block.slope == b.block.slope
                    && if a.plans_across() && !plain[i - 1] {
                        caps[i].v_mm_s > 0.0 && !drops
                    } else {
                        let feed = feeds[i - 1].v_mm_s.min(feeds[i].v_mm_s);
                        caps[i].v_mm_s >= feed
                            && (feeds[i - 1].v_mm_s - feeds[i].v_mm_s).abs() <= 1e-9 * feed
                            && blocks[run].slope.nearly_equals(&b.slope, NEARLY_EQUAL)
                    };
            plain[i] = if joined { plain[i - 1] } else { drops };
            if !joined {
                knot[i] = true;
                run = i;
            }
        }
        plain
    }

    fn stretches(&self, knot: &[bool]) -> Vec<Stretch> {
        let mut out = Vec::with_capacity(self.blocks.len());
        let mut first = 0;
        for (end, _) in knot.iter().enumerate().skip(1).filter(|(_, k)| **k) {
            out.push(self.stretch(first, end));
            first = end;
        }
        out
    }

    fn stretch(&self, first: usize, end: usize) -> Stretch {
        let Self { blocks, feeds, .. } = *self;
        let mut s = Stretch {
            first,
            end,
            length: blocks[first].length,
            feed: feeds[first].v_mm_s,
            slope: blocks[first].slope.clone(),
        };
        for i in first + 1..end {
            s.length += blocks[i].length;
            s.feed = if self.carried[i] {
                // what the braking ends at
                feeds[i].v_mm_s
            } else {
                // across blocks of different feed the check finds what is exceeded
                s.feed.max(feeds[i].v_mm_s)
            };
            s.slope = s.slope.weaker(&blocks[i].slope);
        }
        s
    }

    /// Backward and forward pass: speed and reason at every knot.
    fn passes(&self, stretches: &[Stretch]) -> Vec<Cap> {
        let m = stretches.len();
        let mut v = vec![self.v_start; m + 1];
        v[m] = Cap::new(0.0, self.end);
        for k in (1..m).rev() {
            let s = &stretches[k];
            let best = self.limit(s.first);
            let behind = v[k + 1];
            let reach = s.slope.reach_down(behind.v_mm_s, s.length);
            v[k] = best.lower(Cap::new(reach, behind.why));
            v[k].v_mm_s = self.entry_speed(s, v[k].v_mm_s, behind.v_mm_s);
        }
        for k in 1..m {
            let s = &stretches[k - 1];
            let reach = if k == 1 {
                s.reach_from(self.v_start.v_mm_s, self.a_start)
            } else {
                s.slope.reach_up(v[k - 1].v_mm_s, s.length)
            };
            v[k] = v[k].lower(Cap::new(reach, v[k - 1].why));
        }
        v
    }
}

impl Stretch {
    /// Both in one, with the feed of the second one: braking goes on from the first to the second.
    fn carried_into(self, second: &Self) -> Self {
        Self {
            first: self.first,
            end: second.end,
            length: self.length + second.length,
            feed: second.feed,
            slope: self.slope.weaker(&second.slope),
        }
    }

    /// Largest speed at its end, acceleration zero, from a speed and an acceleration at its start: the acceleration is
    /// reduced to zero first.
    fn reach_from(&self, v: f64, a: f64) -> f64 {
        let settled = self.slope.settled(v, a);
        let length = self.slope.change(v, a, settled).map_or(0.0, |c| c.length());
        self.slope.reach_up(settled.max(0.0), (self.length - length).max(0.0))
    }

    /// True if one of its blocks allows more than all of them together, and is long enough at this speed to use it.
    fn is_uneven(&self, blocks: &[Arc<Queued>], v: f64) -> bool {
        blocks[self.first..self.end].iter().any(|b| {
            !b.slope.nearly_equals(&self.slope, UNEVEN)
                && rates(b).is_some_and(|r| has_hill(b.length, v, &r))
        })
    }

    /// True if a speed at its start is above its feed (G901).
    fn is_above(&self, v0: f64) -> bool {
        is_above(v0, self.feed)
    }

    fn profile(&self, v0: f64, v1: f64) -> Result<SpanProfile, Infeasible> {
        if self.is_above(v0) {
            self.slope.plan_from_above(v0, v1, self.feed, self.length)
        } else {
            self.slope.plan(v0, v1, self.feed, self.length)
        }
    }
}

/// True if a speed exceeds a feed by more than rounding.
fn is_above(v: f64, feed: f64) -> bool {
    v > feed * (1.0 + ROUNDING)
}

/// The span of the last round, if neither its ends nor its speeds have changed.
fn unchanged(known: &[Span], s: &Stretch, v0: f64, v1: f64) -> Option<Span> {
    let span = &known[known.binary_search_by_key(&s.first, |span| span.first).ok()?];
    let ends = (span.profile.at(0.0).v_mm_s, span.profile.at(span.profile.duration()).v_mm_s);
    let same =
        span.end == s.end && ends.0.to_bits() == v0.to_bits() && ends.1.to_bits() == v1.to_bits();
    same.then(|| span.clone())
}

/// Limits of the blocks of a stretch; `None` with STEP and with constant ramp times.
fn cells(
    blocks: &[Arc<Queued>],
    feeds: &[Cap],
    caps: &[Cap],
    first: usize,
    end: usize,
) -> Option<Vec<Cell>> {
    let mut at = 0.0;
    (first..end)
        .map(|i| {
            at += blocks[i].length;
            // the boundary belongs to both blocks
            let both = |i: usize| caps[i + 1].v_mm_s.min(feeds[i].v_mm_s).min(feeds[i + 1].v_mm_s);
            let cap = if i + 1 < end { both(i) } else { f64::INFINITY };
            Some(Cell { end: at, v: feeds[i].v_mm_s, cap, rates: rates(&blocks[i])? })
        })
        .collect()
}

fn rates(block: &Queued) -> Option<Rates> {
    match &block.slope {
        SlopeLimits::Ramped(limits) => limits.rates(),
        SlopeLimits::Step(_) => None,
    }
}

/// The boundary inside a span whose cap, or whose block's velocity, the profile exceeds most.
fn most_exceeded(
    blocks: &[Arc<Queued>],
    feeds: &[Cap],
    caps: &[Cap],
    s: &Stretch,
    profile: &SpanProfile,
) -> Option<usize> {
    let mut worst = (1.0 + 1e-9, None);
    let mut at = 0.0;
    let mut before = profile.at(0.0).v_mm_s;
    for i in s.first..s.end {
        at += blocks[i].length;
        let behind = if i + 1 == s.end {
            profile.at(profile.duration()).v_mm_s
        } else {
            profile.at(profile.time_at(at)).v_mm_s
        };
        if i + 1 < s.end {
            let cap = caps[i + 1].v_mm_s.min(feeds[i].v_mm_s).min(feeds[i + 1].v_mm_s);
            let ratio = behind / cap.max(1e-12);
            if ratio > worst.0 {
                worst = (ratio, Some(i + 1));
            }
        }
        // a peak inside the block: both ends are within the block's velocity, the middle is not
        let peak = profile.highest_between(at - blocks[i].length, at).max(before).max(behind);
        if peak / feeds[i].v_mm_s > worst.0 {
            let inner = if i > s.first { i } else { i + 1 };
            if inner > s.first && inner < s.end {
                worst = (peak / feeds[i].v_mm_s, Some(inner));
            }
        }
        before = behind;
    }
    worst.1
}
