//! Look-ahead: the speed at every block boundary of a window.
//!
//! Stages, each reads what the ones before guarantee:
//! 1. *caps* (caller): the velocity that each boundary allows for itself, see [`crate::corner`];
//! 2. *knots*: boundaries where the acceleration is zero. STEP: every boundary (its acceleration may jump anyway).
//!    TRAPEZ and SIN2: every boundary except those inside a run of blocks with equal feed, (nearly) equal slope and no
//!    binding cap - such a run is one span. HSC and `NO_OPT=0`: the local minima of the speed, unless they are so close
//!    to each other that a stop of the acceleration costs speed;
//! 3. *backward pass*: no knot is faster than what can still be braked to the next one, so the window ends at rest;
//! 4. *forward pass*: no knot is faster than what can be reached from the one before;
//! 5. *check* (HSC, `NO_OPT=0`): a span that exceeds a limit inside is planned along its limits, see [`crate::ride`]; where
//!    that is refused, the boundary that is exceeded most becomes a knot, and 3 to 5 are repeated.
//!
//! Guarantee: every span is feasible, and by induction a stop is possible from every state that is ever output, because
//! the passes only lower velocities and `reach_down` is monotone.

use crate::limit::SpeedLimit;
use crate::profile::{Infeasible, Rates, SlopeLimits, SpanProfile};
use crate::queue::Queued;
use crate::ride::{Cell, has_hill, ride};
use std::sync::Arc;

/// Relative difference of path acceleration up to which blocks of one run are planned as one span with the smaller
/// value (Assumption: a CAM contour changes its direction from block to block by little, and the control does not
/// stop accelerating there).
const NEARLY_EQUAL: f64 = 0.1;

/// A velocity with its reason.
pub type Cap = (f64, SpeedLimit);

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

/// The plan of a window.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// Spans in order; together they cover every block.
    pub spans: Vec<Span>,
}

struct Stretch {
    first: usize,
    end: usize,
    length: f64,
    feed: f64,
    slope: SlopeLimits,
}

/// Plans a window of blocks from `v_start` to rest.
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
    v_start: Cap,
    end: SpeedLimit,
) -> Result<Plan, Infeasible> {
    let n = blocks.len();
    let mut knot = vec![false; n + 1];
    (knot[0], knot[n]) = (true, true);
    mark_knots(blocks, feeds, caps, forced, &mut knot);
    let mut soft = minima(blocks, feeds, caps, v_start.0, &knot);
    let mut known: Vec<Span> = Vec::new();
    loop {
        let all: Vec<bool> = knot.iter().zip(&soft).map(|(k, s)| *k || *s).collect();
        let stretches = stretches(blocks, feeds, &all);
        let speeds = passes(&stretches, feeds, caps, v_start, end);
        if drop_lowered(&stretches, &speeds, feeds, caps, &knot, &mut soft) {
            continue;
        }
        let mut spans: Vec<Span> = Vec::with_capacity(stretches.len());
        let mut again = false;
        for (k, s) in stretches.iter().enumerate() {
            let (from, to) = (speeds[k], speeds[k + 1]);
            if let Some(same) = unchanged(&known, s, from.0, to.0) {
                spans.push(same);
                continue;
            }
            #[cfg(test)]
            crate::work::add();
            let mut profile = s.slope.plan(from.0, to.0, s.feed, s.length)?;
            if s.end - s.first > 1
                && blocks[s.first].plans_across()
                && let Some(worst) = most_exceeded(blocks, feeds, caps, s, &profile)
            {
                let cells = cells(blocks, feeds, caps, s.first, s.end);
                if let Some(chain) = cells.and_then(|c| ride(&c, from.0, to.0)) {
                    profile = SpanProfile::from_chain(chain);
                } else {
                    knot[worst] = true;
                    again = true;
                }
            }
            spans.push(Span {
                first: s.first,
                end: s.end,
                profile,
                why_up: from.1,
                why_down: to.1,
            });
        }
        if !again {
            return Ok(Plan { spans });
        }
        known = spans;
    }
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
            let cap = if i + 1 < end { caps[i + 1].0 } else { f64::INFINITY };
            Some(Cell { end: at, v: feeds[i].0, cap, rates: rates(&blocks[i])? })
        })
        .collect()
}

fn rates(block: &Queued) -> Option<Rates> {
    match &block.slope {
        SlopeLimits::Ramped(limits) => limits.rates(),
        SlopeLimits::Step(_) => None,
    }
}

/// Boundaries at which the fastest speed without a jerk limit has a local minimum worth the name: there the acceleration passes
/// through zero in any case, so they are knots that cost nothing.
fn minima(
    blocks: &[Arc<Queued>],
    feeds: &[Cap],
    caps: &[Cap],
    v_start: f64,
    knot: &[bool],
) -> Vec<bool> {
    let n = blocks.len();
    let cap = |i: usize| caps[i].0.min(feeds[i - 1].0).min(feeds[i].0);
    let mut square: Vec<f64> = (1..n).map(|i| cap(i) * cap(i)).collect();
    square.insert(0, v_start * v_start);
    square.push(0.0);
    let own = square.clone();
    let gain = |i: usize, up: bool| {
        rates(&blocks[i]).map_or(0.0, |r| 2.0 * blocks[i].length * if up { r.acc } else { r.dec })
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
    stretches: &[Stretch],
    speeds: &[Cap],
    feeds: &[Cap],
    caps: &[Cap],
    knot: &[bool],
    soft: &mut [bool],
) -> bool {
    let mut any = false;
    // from the speed at the start, which is final, the first one may be out of reach
    if let [first, second, ..] = stretches {
        let (v0, v1) = (speeds[0].0, speeds[1].0);
        if soft[second.first] && first.slope.down_distance(v0.max(v1), v1) > first.length {
            soft[second.first] = false;
            any = true;
        }
    }
    for (s, v) in stretches.iter().zip(speeds).skip(1) {
        let b = s.first;
        let cap = caps[b].0.min(feeds[b - 1].0).min(feeds[b].0);
        if soft[b] && !knot[b] && v.0 < cap * (1.0 - 1e-9) {
            soft[b] = false;
            any = true;
        }
    }
    any
}

fn mark_knots(
    blocks: &[Arc<Queued>],
    feeds: &[Cap],
    caps: &[Cap],
    forced: &[bool],
    knot: &mut [bool],
) {
    let mut run = 0;
    for i in 1..blocks.len() {
        let (a, b) = (&blocks[i - 1], &blocks[i]);
        let joined = !forced[i]
            && a.block.slope == b.block.slope
            && if a.plans_across() {
                caps[i].0 > 0.0
            } else {
                let feed = feeds[i - 1].0.min(feeds[i].0);
                caps[i].0 >= feed
                    && (feeds[i - 1].0 - feeds[i].0).abs() <= 1e-9 * feed
                    && blocks[run].slope.nearly_equals(&b.slope, NEARLY_EQUAL)
            };
        if !joined {
            knot[i] = true;
            run = i;
        }
    }
}

fn stretches(blocks: &[Arc<Queued>], feeds: &[Cap], knot: &[bool]) -> Vec<Stretch> {
    let mut out = Vec::with_capacity(blocks.len());
    let mut first = 0;
    for (end, _) in knot.iter().enumerate().skip(1).filter(|(_, k)| **k) {
        let mut s = Stretch {
            first,
            end,
            length: blocks[first].length,
            feed: feeds[first].0,
            slope: blocks[first].slope.clone(),
        };
        for i in first + 1..end {
            s.length += blocks[i].length;
            // across blocks of different feed the check finds what is exceeded
            s.feed = s.feed.max(feeds[i].0);
            s.slope = s.slope.weaker(&blocks[i].slope);
        }
        out.push(s);
        first = end;
    }
    out
}

/// Backward and forward pass: speed and reason at every knot.
fn passes(
    stretches: &[Stretch],
    feeds: &[Cap],
    caps: &[Cap],
    v_start: Cap,
    end: SpeedLimit,
) -> Vec<Cap> {
    let m = stretches.len();
    let mut v = vec![v_start; m + 1];
    v[m] = (0.0, end);
    for k in (1..m).rev() {
        let b = stretches[k].first;
        let mut best = caps[b];
        for feed in [feeds[b - 1], feeds[b]] {
            if feed.0 < best.0 {
                best = feed;
            }
        }
        let reach = stretches[k].slope.reach_down(v[k + 1].0, stretches[k].length);
        v[k] = if reach < best.0 { (reach, v[k + 1].1) } else { best };
    }
    for k in 1..m {
        let reach = stretches[k - 1].slope.reach_up(v[k - 1].0, stretches[k - 1].length);
        if reach < v[k].0 {
            v[k] = (reach, v[k - 1].1);
        }
    }
    v
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
            let cap = caps[i + 1].0.min(feeds[i].0).min(feeds[i + 1].0);
            let ratio = behind / cap.max(1e-12);
            if ratio > worst.0 {
                worst = (ratio, Some(i + 1));
            }
        }
        // a peak inside the block: both ends are within the block's velocity, the middle is not
        let peak = profile.highest_between(at - blocks[i].length, at).max(before).max(behind);
        if peak / feeds[i].0 > worst.0 {
            let inner = if i > s.first { i } else { i + 1 };
            if inner > s.first && inner < s.end {
                worst = (peak / feeds[i].0, Some(inner));
            }
        }
        before = behind;
    }
    worst.1
}
