//! Look-ahead: the speed at every block boundary of a window.
//!
//! Stages, each reads what the ones before guarantee:
//! 1. *caps* (caller): the velocity that each boundary allows for itself, see [`crate::corner`];
//! 2. *knots*: boundaries where the acceleration is zero. STEP: every boundary (its acceleration may jump anyway).
//!    TRAPEZ and SIN2: every boundary except those inside a run of blocks with equal feed, (nearly) equal slope and no
//!    binding cap - such a run is one span. HSC and `NO_OPT=0`: as few as possible, see 5;
//! 3. *backward pass*: no knot is faster than what can still be braked to the next one, so the window ends at rest;
//! 4. *forward pass*: no knot is faster than what can be reached from the one before;
//! 5. *check* (HSC, `NO_OPT=0`): in every span the boundary that is exceeded most becomes a knot, and 3 to 5 are
//!    repeated; every round adds a knot, so it ends.
//!
//! Guarantee: every span is feasible, and by induction a stop is possible from every state that is ever output, because
//! the passes only lower velocities and `reach_down` is monotone.

use crate::limit::SpeedLimit;
use crate::profile::{Infeasible, SlopeLimits, SpanProfile};
use crate::queue::Queued;
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
    loop {
        let stretches = stretches(blocks, feeds, &knot);
        let speeds = passes(&stretches, feeds, caps, v_start, end);
        let mut plan = Plan { spans: Vec::with_capacity(stretches.len()) };
        let mut again = false;
        for (k, s) in stretches.iter().enumerate() {
            let (from, to) = (speeds[k], speeds[k + 1]);
            let profile = s.slope.plan(from.0, to.0, s.feed, s.length)?;
            if s.end - s.first > 1 && blocks[s.first].plans_across() {
                if let Some(worst) = most_exceeded(blocks, feeds, caps, s, &profile) {
                    knot[worst] = true;
                    again = true;
                }
            }
            plan.spans.push(Span {
                first: s.first,
                end: s.end,
                profile,
                why_up: from.1,
                why_down: to.1,
            });
        }
        if !again {
            return Ok(plan);
        }
    }
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
    for end in 1..=blocks.len() {
        if !knot[end] {
            continue;
        }
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
