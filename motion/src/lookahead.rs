//! Look-ahead: the speed at every block boundary of a window.
//!
//! Stages, each relying on the results of the ones before:
//! 1. *caps* (from the caller): the velocity that each boundary permits on its own, see [`crate::junction`];
//! 2. *knots*: boundaries at which the acceleration is zero. STEP: every boundary (its acceleration may jump anyway).
//!    Constant ramp times (P-CHAN-00349): every boundary except those inside a run of blocks with equal feed rate,
//!    (nearly) equal slope and no cap below the feed rate; such a run is one span. TRAPEZ, SIN2, HSC: the local minima
//!    of the speed, unless they are so close to each other that bringing the acceleration to zero costs speed. For the
//!    start of braking under G901 see [`late`];
//! 3. *backward pass*: no knot is faster than the speed from which the path can brake to the next one, so the window
//!    ends at rest;
//! 4. *forward pass*: no knot is faster than what can be reached from the one before;
//! 5. *check* (TRAPEZ, SIN2, HSC): a span that exceeds a limit inside, or whose blocks differ in acceleration, is
//!    planned along its limits, see [`crate::ride`]. Where that is refused, or takes longer than with zero acceleration
//!    at boundaries, the boundary that is exceeded most becomes a knot, and 3 to 5 are repeated;
//! 6. *passing* (HSC): where that is faster, a kink is passed with a non-zero acceleration, see [`passing`].
//!
//! Guarantee: every span is feasible. By induction a stop is possible from every state that is ever output, because the
//! passes only lower velocities and `reach_down` is monotone.
//!
//! Called by the planner with the blocks in the queue, again for every window.
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! # use kontur_filters::time::CycleTime;
//! use kontur_motion::cap::{Cap, SpeedLimit};
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

mod draft;
mod knots;
mod late;
mod passing;
mod stretch;

use crate::cap::{Cap, SpeedLimit};
use crate::profile::FLAT_MM_S2;
use crate::profile::{Infeasible, Profile};
use crate::queue::Queued;
use crate::ride::{Cell, connects_gently, jerk_steps, ride};
pub(crate) use draft::Draft;
use std::sync::Arc;
use stretch::{Stretch, Weakest, cells, most_exceeded};

/// Relative difference of speeds that counts as rounding.
pub(crate) const ROUNDING: f64 = 1e-7;

/// Blocks planned as one profile.
#[derive(Clone, Debug)]
pub struct Span {
    /// Index of the first block in the window.
    pub first: usize,
    /// Index after the last block.
    pub end: usize,
    /// The profile.
    pub profile: Profile,
    /// Reason for the speed limit while accelerating.
    pub why_up: SpeedLimit,
    /// Reason for the speed limit while braking.
    pub why_down: SpeedLimit,
    /// Speeds in mm/s between which the span was planned: those of the profile up to rounding.
    asked: (f64, f64),
}

/// Input of a plan: blocks with the limits of each of them and of each boundary. Entry `i` of `caps`, `forced`,
/// `entries` and `carried` belongs to the boundary before block `i`.
#[derive(Clone, Debug)]
struct Window<'a> {
    blocks: &'a [Arc<Queued>],
    feeds: &'a [Cap],
    caps: &'a [Cap],
    forced: &'a [bool],
    v_start: Cap,
    a_start: f64,
    /// Speed at the end.
    end: Cap,
    /// Speed at which a block may be entered: its feed rate, or more under G901.
    entries: Vec<Cap>,
    /// Whether braking under G901 continues across the boundary.
    carried: Vec<bool>,
}

/// Plans a window of blocks from `v_start` to rest, in spans that cover every block. A non-zero acceleration at the
/// start (mm/s2) is that of a plan with constant jerk that was left there.
///
/// `caps[i]` belongs to the boundary before block `i`; `caps[0]` is not used. `forced` boundaries are knots.
///
/// # Errors
/// [`Infeasible`] if even the slowest plan does not fit. The passes exclude this, so it would be an internal error.
pub fn plan(
    blocks: &[Arc<Queued>],
    feeds: &[Cap],
    caps: &[Cap],
    forced: &[bool],
    (v_start, a_start): (Cap, f64),
    end: SpeedLimit,
) -> Result<Vec<Span>, Infeasible> {
    Ok(plan_again(blocks, (feeds, caps), forced, (v_start, a_start), end, None)?.spans)
}

/// As [`plan`], reusing a draft of the same blocks, or of blocks of which the first ones are already before the start
/// ([`Draft::pass`]).
pub(crate) fn plan_again(
    blocks: &[Arc<Queued>],
    (feeds, caps): (&[Cap], &[Cap]),
    forced: &[bool],
    (v_start, a_start): (Cap, f64),
    end: SpeedLimit,
    before: Option<Draft>,
) -> Result<Draft, Infeasible> {
    let known = before.as_ref().map(|draft| draft.left(a_start, blocks, (feeds, caps)));
    let known = known.unwrap_or_default();
    if blocks.is_empty() {
        return Ok(Draft::default());
    }
    let (entries, carried) = (feeds.to_vec(), vec![false; blocks.len()]);
    let end = Cap::new(0.0, end);
    // where a plan was left inside a span, its speed was computed by other formulas
    let rounded = !is_above(v_start.v_mm_s, feeds[0].v_mm_s) && a_start.abs() > FLAT_MM_S2;
    let v_start =
        if rounded { v_start.lower(Cap { v_mm_s: feeds[0].v_mm_s, ..v_start }) } else { v_start };
    let early = Window { blocks, feeds, caps, forced, v_start, a_start, end, entries, carried };
    // braking under G901 concerns the whole window
    if let Some(entries) = late::entries(blocks, feeds) {
        return Ok(Draft::of_spans(late::plan(&early, entries)?));
    }
    let spans = early.plan(known)?;
    let passing = early.pass(&spans);
    Ok(Draft::new(spans, passing, a_start, blocks, (feeds, caps), before.unwrap_or_default()))
}

impl<'a> Window<'a> {
    /// Cap of the boundary before block `b`.
    fn limit(&self, b: usize) -> Cap {
        self.caps[b].lower(self.feeds[b - 1]).lower(self.entries[b])
    }

    /// Plans the window; `known` are spans planned earlier under the same limits, in order.
    fn plan(&self, mut known: Vec<Span>) -> Result<Vec<Span>, Infeasible> {
        let Self { blocks, feeds, caps, .. } = *self;
        let n = blocks.len();
        let mut knot = vec![false; n + 1];
        (knot[0], knot[n]) = (true, true);
        let plain = self.mark_knots(&mut knot);
        let mut soft = self.minima(&knot, &plain);
        loop {
            let all: Vec<bool> = knot.iter().zip(&soft).map(|(k, s)| *k || *s).collect();
            let stretches = self.stretches(&all);
            let speeds = self.passes(&stretches);
            if self.drop_lowered(&stretches, &speeds, &knot, &mut soft) {
                continue;
            }
            let mut spans: Vec<Span> = Vec::with_capacity(stretches.len());
            let mut again = false;
            // the speed at the start is already final; the earlier plan then continues
            if !self.keeps(&stretches[0], speeds[0].v_mm_s, speeds[1].v_mm_s) {
                let (length_mm, needed_mm) = (stretches[0].length, f64::INFINITY);
                return Err(Infeasible { length_mm, needed_mm });
            }
            for (k, s) in stretches.iter().enumerate() {
                let (from, to) = (speeds[k], speeds[k + 1]);
                let asked = (from.v_mm_s, to.v_mm_s);
                if let Some(same) = unchanged(&known, s, asked) {
                    spans.push(Span { why_up: from.why, why_down: to.why, ..same });
                    continue;
                }
                #[cfg(test)]
                crate::closed_forms::add();
                let a0 = if k == 0 { self.a_start } else { 0.0 };
                if a0.abs() > FLAT_MM_S2 {
                    let going_on = cells(blocks, feeds, caps, s.first, s.end)
                        .and_then(|cells| ride(&cells, (from.v_mm_s, a0), to.v_mm_s));
                    let Some(profile) = going_on else {
                        if s.end < blocks.len() && soft[s.end] && !knot[s.end] {
                            soft[s.end] = false;
                            again = true;
                            spans = known;
                            break;
                        }
                        return Err(Infeasible { length_mm: s.length, needed_mm: f64::INFINITY });
                    };
                    let (first, end) = (s.first, s.end);
                    let (why_up, why_down) = (from.why, to.why);
                    spans.push(Span { first, end, profile, why_up, why_down, asked });
                    continue;
                }
                let mut profile = s.profile(from.v_mm_s, to.v_mm_s)?;
                let across = blocks[s.first..s.end].iter().any(|b| b.plans_across());
                if s.end - s.first > 1 && across && !s.is_above(from.v_mm_s) {
                    let worst = most_exceeded(blocks, feeds, caps, s, &profile);
                    let divides = |b| self.only_divides(b);
                    let mut steps = Vec::new();
                    let along = |cells: Vec<Cell>| {
                        let ride = ride(&cells, (from.v_mm_s, 0.0), to.v_mm_s)?;
                        steps = jerk_steps(&cells);
                        let gentle =
                            !steps.is_empty() || worst.is_some() && connects_gently(&cells);
                        let slower = gentle
                            && self.part(s, from, to).is_faster_with_knots(&steps, ride.duration());
                        (!slower).then_some(ride)
                    };
                    let ridden = (worst.is_some() || s.is_uneven(blocks, divides, profile.peak()))
                        .then(|| cells(blocks, feeds, caps, s.first, s.end))
                        .flatten()
                        .and_then(along);
                    match (ridden, worst) {
                        (Some(ride), None) if ride.duration() >= profile.duration() => {}
                        (Some(ride), _) => profile = ride,
                        (None, worst) => {
                            let steps = steps.iter().map(|step| s.first + step);
                            for b in steps.chain(worst) {
                                (knot[b], again) = (true, true);
                            }
                        }
                    }
                }
                spans.push(Span {
                    first: s.first,
                    end: s.end,
                    profile,
                    why_up: from.why,
                    why_down: to.why,
                    asked,
                });
            }
            if !again {
                return Ok(spans);
            }
            known = spans;
        }
    }

    fn stretches(&self, knot: &[bool]) -> Vec<Stretch<'a>> {
        let mut out = Vec::with_capacity(self.blocks.len());
        let mut first = 0;
        for (end, _) in knot.iter().enumerate().skip(1).filter(|(_, k)| **k) {
            out.push(self.stretch(first, end));
            first = end;
        }
        out
    }

    fn stretch(&self, first: usize, end: usize) -> Stretch<'a> {
        let Self { blocks, feeds, .. } = *self;
        let mut s = Stretch {
            first,
            end,
            length: blocks[first].length,
            feed: feeds[first].v_mm_s,
            slope: Weakest::One(&blocks[first].slope),
        };
        for i in first + 1..end {
            s.length += blocks[i].length;
            s.feed = if self.carried[i] {
                // the speed at which the braking ends
                feeds[i].v_mm_s
            } else {
                // across blocks of different feed rates the check finds the boundaries that are exceeded
                s.feed.max(feeds[i].v_mm_s)
            };
            s.slope.join(&blocks[i].slope);
        }
        s
    }

    /// A stretch as a separate window, between the speeds at its ends.
    fn part(&self, s: &Stretch<'_>, v_start: Cap, end: Cap) -> Self {
        let blocks = s.first..s.end;
        Self {
            blocks: &self.blocks[blocks.clone()],
            feeds: &self.feeds[blocks.clone()],
            caps: &self.caps[blocks.clone()],
            forced: &self.forced[blocks.clone()],
            v_start,
            a_start: 0.0,
            end,
            entries: self.entries[blocks.clone()].to_vec(),
            carried: self.carried[blocks].to_vec(),
        }
    }

    /// Whether the window takes less than `most_s` with zero acceleration at these boundaries and at every boundary
    /// that would otherwise be exceeded.
    fn is_faster_with_knots(&self, knots: &[usize], most_s: f64) -> bool {
        let n = self.blocks.len();
        let mut knot = vec![false; n + 1];
        for b in knots.iter().chain(&[0, n]) {
            knot[*b] = true;
        }
        loop {
            let stretches = self.stretches(&knot);
            let speeds = self.passes(&stretches);
            let (mut time, mut exceeds) = (0.0, false);
            for (s, v) in stretches.iter().zip(speeds.windows(2)) {
                let Ok(profile) = s.profile(v[0].v_mm_s, v[1].v_mm_s) else { return false };
                time += profile.duration();
                if time >= most_s {
                    return false;
                }
                if let Some(b) = most_exceeded(self.blocks, self.feeds, self.caps, s, &profile) {
                    (knot[b], exceeds) = (true, true);
                }
            }
            if !exceeds {
                return true;
            }
        }
    }

    /// Backward and forward pass: the cap at every knot.
    fn passes(&self, stretches: &[Stretch<'_>]) -> Vec<Cap> {
        let m = stretches.len();
        let mut v = vec![self.v_start; m + 1];
        v[m] = self.end;
        for k in (1..m).rev() {
            let s = &stretches[k];
            let best = self.limit(s.first);
            let behind = v[k + 1];
            v[k] = if s.slope.clearly_reaches_down(best.v_mm_s, behind.v_mm_s, s.length) {
                best
            } else {
                best.lower(Cap::new(s.slope.reach_down(behind.v_mm_s, s.length), behind.why))
            };
            v[k].v_mm_s = self.entry_speed(s, v[k].v_mm_s, behind.v_mm_s);
        }
        for k in 1..m {
            let s = &stretches[k - 1];
            let before = v[k - 1];
            let reach = if k == 1 {
                s.reach_from(self.v_start.v_mm_s, self.a_start)
            } else if s.slope.clearly_reaches_up(before.v_mm_s, v[k].v_mm_s, s.length) {
                continue;
            } else {
                s.slope.reach_up(before.v_mm_s, s.length)
            };
            v[k] = v[k].lower(Cap::new(reach, before.why));
        }
        v
    }
}

/// Whether a speed exceeds a feed rate by more than rounding.
fn is_above(v: f64, feed: f64) -> bool {
    v > feed * (1.0 + ROUNDING)
}

/// The span of the previous round, if neither its ends nor its speeds have changed.
fn unchanged(known: &[Span], s: &Stretch<'_>, asked: (f64, f64)) -> Option<Span> {
    let span = &known[known.binary_search_by_key(&s.first, |span| span.first).ok()?];
    let same = span.end == s.end
        && span.asked.0.to_bits() == asked.0.to_bits()
        && span.asked.1.to_bits() == asked.1.to_bits();
    same.then(|| span.clone())
}
