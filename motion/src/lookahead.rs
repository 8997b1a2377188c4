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
mod outline;
mod passing;
mod stretch;

use crate::cap::{Cap, SpeedLimit};
use crate::profile::FLAT_MM_S2;
use crate::profile::{Infeasible, Profile};
use crate::queue::Queued;
use crate::ride::{JERK_STEPS, connects_gently, jerk_steps, ride};
pub(crate) use draft::Draft;
use outline::Outline;
use std::sync::Arc;
use stretch::{Stretch, cells, most_exceeded};

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

impl Span {
    /// Whether it was planned along this stretch between these speeds.
    fn is_of(&self, s: &Stretch<'_>, (v0, v1): (f64, f64)) -> bool {
        (self.first, self.end) == (s.first, s.end)
            && self.asked.0.to_bits() == v0.to_bits()
            && self.asked.1.to_bits() == v1.to_bits()
    }
}

/// Input of a plan: blocks with the limits of each of them and of each boundary. Entry `i` of `caps`, `forced`,
/// `entries`, `limits` and `carried` belongs to the boundary before block `i`.
#[derive(Clone, Copy, Debug)]
struct Window<'a> {
    blocks: &'a [Outline],
    feeds: &'a [Cap],
    caps: &'a [Cap],
    forced: &'a [bool],
    v_start: Cap,
    a_start: f64,
    /// Speed at the end.
    end: Cap,
    /// Speed at which a block may be entered: its feed rate, or more under G901.
    entries: &'a [Cap],
    /// Lowest of the cap, the feed rate of the block before, and the speed at which the block may be entered; not used
    /// for the first block.
    limits: &'a [Cap],
    /// Whether braking under G901 continues across the boundary.
    carried: &'a [bool],
}

/// The limits of a [`Window`].
fn limits(feeds: &[Cap], caps: &[Cap], entries: &[Cap]) -> Vec<Cap> {
    let inside = caps[1..].iter().zip(feeds).zip(&entries[1..]);
    let lowest = inside.map(|((cap, before), entry)| cap.lower(*before).lower(*entry));
    caps[..1].iter().copied().chain(lowest).collect()
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
    let start = (v_start, a_start);
    Ok(plan_again(blocks, (feeds, caps), forced, start, end, Draft::default())?.spans)
}

/// As [`plan`], reusing a draft of the same blocks, or of blocks of which the first ones are already before the start
/// ([`Draft::pass`]).
pub(crate) fn plan_again(
    blocks: &[Arc<Queued>],
    (feeds, caps): (&[Cap], &[Cap]),
    forced: &[bool],
    (v_start, a_start): (Cap, f64),
    end: SpeedLimit,
    mut draft: Draft,
) -> Result<Draft, Infeasible> {
    if blocks.is_empty() {
        return Ok(Draft::default());
    }
    draft.follow(a_start, blocks, (feeds, caps));
    let known = std::mem::take(&mut draft.spans);
    let blocks = draft.blocks();
    // where a plan was left inside a span, its speed was computed by other formulas
    let rounded = !is_above(v_start.v_mm_s, feeds[0].v_mm_s) && a_start.abs() > FLAT_MM_S2;
    let v_start =
        if rounded { v_start.lower(Cap { v_mm_s: feeds[0].v_mm_s, ..v_start }) } else { v_start };
    let (end, entries) = (Cap::new(0.0, end), feeds);
    let (limits, carried) = (&limits(feeds, caps, entries)[..], &vec![false; blocks.len()][..]);
    let early =
        Window { blocks, feeds, caps, forced, v_start, a_start, end, entries, limits, carried };
    // braking under G901 concerns the whole window
    if let Some(entries) = late::entries(blocks, feeds) {
        return Ok(Draft::of_spans(late::plan(&early, &entries)?));
    }
    let spans = early.plan(known)?;
    let passing = early.pass(&spans);
    draft.keep(spans, passing);
    Ok(draft)
}

impl Window<'_> {
    /// Plans the window; `known` are spans planned earlier under the same limits, in order.
    fn plan(&self, mut known: Vec<Span>) -> Result<Vec<Span>, Infeasible> {
        let n = self.blocks.len();
        let mut knot = vec![false; n + 1];
        (knot[0], knot[n]) = (true, true);
        let plain = self.mark_knots(&mut knot);
        let mut soft = self.minima(&knot, &plain);
        let mut stretches = self.stretches(|b| knot[b] || soft[b]);
        loop {
            let speeds = self.passes(&stretches);
            if self.drop_lowered(&stretches, &speeds, &knot, &mut soft) {
                self.join_dropped(&mut stretches, |b| knot[b] || soft[b]);
                continue;
            }
            let mut spans: Vec<Span> = Vec::with_capacity(stretches.len());
            let mut again = false;
            // the speed at the start is already final; the earlier plan then continues
            if !self.keeps(&stretches[0], speeds[0].v_mm_s, speeds[1].v_mm_s) {
                let (length_mm, needed_mm) = (stretches[0].length, f64::INFINITY);
                return Err(Infeasible { length_mm, needed_mm });
            }
            let mut next = 0;
            for (s, ends) in stretches.iter().zip(speeds.windows(2)) {
                let (from, to) = (ends[0], ends[1]);
                let asked = (from.v_mm_s, to.v_mm_s);
                next += known[next..].iter().take_while(|span| span.first < s.first).count();
                if let Some(same) = known.get(next).filter(|span| span.is_of(s, asked)) {
                    spans.push(Span { why_up: from.why, why_down: to.why, ..same.clone() });
                    continue;
                }
                #[cfg(test)]
                crate::closed_forms::add();
                let (first, end, why_up, why_down) = (s.first, s.end, from.why, to.why);
                let continues = first == 0 && self.a_start.abs() > FLAT_MM_S2;
                if let Some(v) = s.even_speed(asked).filter(|_| !continues) {
                    let profile = Profile::even(v, s.length);
                    spans.push(Span { first, end, profile, why_up, why_down, asked });
                    continue;
                }
                let profile = if continues {
                    let cells = cells(self.blocks, self.feeds, self.caps, s.first, s.end);
                    let start = (from.v_mm_s, self.a_start);
                    match cells.and_then(|cells| ride(&cells, start, to.v_mm_s)) {
                        Some(profile) => profile,
                        None if s.end < n && soft[s.end] && !knot[s.end] => {
                            (soft[s.end], again) = (false, true);
                            spans = known;
                            break;
                        }
                        None => {
                            let (length_mm, needed_mm) = (s.length, f64::INFINITY);
                            return Err(Infeasible { length_mm, needed_mm });
                        }
                    }
                } else {
                    let (profile, exceeded) = self.profile(s, from, to)?;
                    for b in exceeded {
                        (knot[b], again) = (true, true);
                    }
                    profile
                };
                spans.push(Span { first, end, profile, why_up, why_down, asked });
            }
            if !again {
                return Ok(spans);
            }
            known = spans;
            stretches = self.stretches(|b| knot[b] || soft[b]);
        }
    }

    /// The profile of a stretch with zero acceleration at both ends, and the boundaries inside that have to become
    /// knots because it exceeds their limits, or is slower without them.
    fn profile(
        &self,
        s: &Stretch<'_>,
        from: Cap,
        to: Cap,
    ) -> Result<(Profile, Vec<usize>), Infeasible> {
        let Self { blocks, feeds, caps, .. } = *self;
        let profile = s.profile(from.v_mm_s, to.v_mm_s)?;
        let across = || blocks[s.first..s.end].iter().any(|b| b.plans_across);
        if s.end - s.first == 1 || !across() || s.is_above(from.v_mm_s) {
            return Ok((profile, Vec::new()));
        }
        let worst = most_exceeded(blocks, feeds, caps, s, &profile);
        // the stop at the end of the look-ahead is planned again with the blocks that follow
        let is_final = s.end < blocks.len() || self.end.why != SpeedLimit::Lookahead;
        let uneven = || {
            let peak = profile.peak();
            s.is_uneven(blocks, peak) || is_final && s.has_strong_row(blocks, peak)
        };
        let along = (worst.is_some() || uneven())
            .then(|| cells(blocks, feeds, caps, s.first, s.end))
            .flatten();
        let Some(along) = along else { return Ok((profile, worst.into_iter().collect())) };
        let ride = ride(&along, (from.v_mm_s, 0.0), to.v_mm_s)
            .filter(|ride| worst.is_some() || ride.duration() < profile.duration());
        // what knots at steps of the jerk have to save; a profile that exceeds a limit needs a knot in any case
        let known = ride.as_ref().or(worst.is_none().then_some(&profile)).map(Profile::duration);
        let part = self.part(s, from, to);
        let faster = |steps: &Vec<usize>| {
            let gentle = !steps.is_empty() || worst.is_some() && connects_gently(&along);
            gentle && known.is_some_and(|known_s| part.is_faster_with_knots(steps, known_s))
        };
        let mut tried = JERK_STEPS.map(|ratio| jerk_steps(&along, ratio)).to_vec();
        tried.dedup();
        let steps = tried.into_iter().find(faster);
        Ok(match (steps, ride) {
            (Some(steps), _) => {
                (profile, steps.iter().map(|step| s.first + step).chain(worst).collect())
            }
            (None, Some(ride)) => (ride, Vec::new()),
            (None, None) => (profile, worst.into_iter().collect()),
        })
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
            entries: &self.entries[blocks.clone()],
            limits: &self.limits[blocks.clone()],
            carried: &self.carried[blocks],
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
            let stretches = self.stretches(|b| knot[b]);
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
            let best = self.limits[s.first];
            let behind = v[k + 1];
            // along a path at its feed rate there is nothing to reach
            v[k] = if best.v_mm_s <= behind.v_mm_s
                || s.slope.clearly_reaches_down(best.v_mm_s, behind.v_mm_s, s.length)
            {
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
            } else if v[k].v_mm_s <= before.v_mm_s
                || s.slope.clearly_reaches_up(before.v_mm_s, v[k].v_mm_s, s.length)
            {
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
