//! G901: braking to a lower feed rate begins after the end of the faster block.
//!
//! The slower block may be entered above its feed rate, limited by its other limits and the boundary. There the path
//! brakes at once to the feed rate, holds it and continues as usual. The boundary is a knot, and braking ends within
//! the run of blocks with this feed rate, so that the speed at its end is the same as without G901.
//!
//! If a run is shorter than the braking distance, braking may be *carried*: if the end of the run is under G901 too,
//! the next run is slower still, and the result is faster, the next run is joined to it and braking continues across
//! the boundary to the feed rate of the next run.
//!
//! A path that already drives at its velocity limit brakes before the boundary: there G901 has no effect. The other
//! limits of the slower block cap its entry speed. Assumption: a block drives at its limit if its feed rate, with the
//! override, is at or above what its axes permit, whether or not it is long enough to reach it.
//!
//! Source: TF5200 programming manual 206238219, G08/G09/G900/G901.
//!
//! None of this is certain to be faster, so the fastest of three plans is used: with carried braking, without it, and
//! without G901.

use super::outline::Outline;
use super::{Span, Stretch, Window, is_above, limits};
use crate::cap::Cap;
use crate::profile::Infeasible;

/// Bisection steps for the entry speed of a run of several blocks.
const HALVINGS: u32 = 40;
/// Rounds of carrying; each joins as many runs as possible.
const ROUNDS: usize = 16;

/// Entry speeds of the blocks; `None` if no block may be entered above its feed rate.
pub(super) fn entries(blocks: &[Outline], feeds: &[Cap]) -> Option<Vec<Cap>> {
    if !blocks.iter().any(|block| block.may_brake_late) {
        return None;
    }
    let mut entries = feeds.to_vec();
    for i in 1..blocks.len() {
        let most = highest(blocks, feeds, i);
        let reached = most.lower(feeds[i - 1]);
        if is_above(reached.v_mm_s, feeds[i].v_mm_s) {
            entries[i] = reached;
        }
    }
    (entries != feeds).then_some(entries)
}

/// Highest entry speed of block `i`, whatever the feed rate of the block before.
fn highest(blocks: &[Outline], feeds: &[Cap], i: usize) -> Cap {
    // a cap below the feed rate of the block (tolerance monitoring) is a limit
    let [before, block] = [i - 1, i].map(|i| &blocks[i].queued);
    let own = feeds[i].v_mm_s >= block.velocity.v_mm_s;
    let below_limit = before.velocity.v_mm_s < before.ceiling.v_mm_s;
    let late = own && below_limit && before.brakes_late_into(block);
    if late && block.ceiling.v_mm_s > feeds[i].v_mm_s { block.ceiling } else { feeds[i] }
}

/// Plans a window with these entry speeds; `early` is the window without them.
pub(super) fn plan(early: &Window<'_>, entries: &[Cap]) -> Result<Vec<Span>, Infeasible> {
    let limits = &limits(early.feeds, early.caps, entries)[..];
    let late = Window { entries, limits, ..*early };
    let carried = &late.carried_from_start()[..];
    let late = Window { carried, ..late };
    let best = match (late.plan_passing(), early.plan_passing()) {
        (Ok(late), Ok(early)) => faster(late, early),
        (Ok(plan), _) | (_, Ok(plan)) => plan,
        (Err(e), _) => return Err(e),
    };
    Ok(match late.carried(&best) {
        Some(carried) => faster(carried, best),
        None => best,
    })
}

/// The faster of two plans, the second one if they are equal.
fn faster(a: Vec<Span>, b: Vec<Span>) -> Vec<Span> {
    let time = |plan: &Vec<Span>| plan.iter().map(|s| s.profile.duration()).sum::<f64>();
    if time(&a) < time(&b) { a } else { b }
}

impl Window<'_> {
    /// The highest entry speed of a stretch, up to `most`, that ends with `v1`: above its feed rate no boundary inside
    /// may be passed faster than permitted, neither now nor when a later plan ends the stretch at its feed rate.
    pub(super) fn entry_speed(&self, s: &Stretch<'_>, most: f64, v1: f64) -> f64 {
        if !s.is_above(most) {
            return most;
        }
        let most = most.min(s.slope.reach_down(s.feed, s.length));
        let keeps = |v0: f64| self.keeps(s, v0, v1) && self.keeps(s, v0, s.feed);
        if keeps(most) {
            return most;
        }
        let (mut low, mut high) = (s.feed, most);
        for _ in 0..HALVINGS {
            let mid = 0.5 * (low + high);
            if keeps(mid) { low = mid } else { high = mid }
        }
        low
    }

    /// Whether every boundary inside a stretch is passed at a permitted speed.
    pub(super) fn keeps(&self, s: &Stretch<'_>, v0: f64, v1: f64) -> bool {
        if s.end - s.first == 1 || !s.is_above(v0) {
            return true;
        }
        let Ok(profile) = s.profile(v0, v1) else { return false };
        let mut at = 0.0;
        (s.first + 1..s.end).all(|i| {
            at += self.blocks[i - 1].length;
            let limit = self.caps[i].v_mm_s.min(highest(self.blocks, self.feeds, i).v_mm_s);
            !is_above(profile.at(profile.time_at(at)).v_mm_s, limit)
        })
    }

    /// Whether braking may continue across the boundary before block `b`: to a feed rate that is not higher and that
    /// the boundary permits.
    fn joins(&self, b: usize) -> bool {
        let (from, to) = (&self.blocks[b - 1], &self.blocks[b]);
        !self.forced[b]
            && self.feeds[b].v_mm_s <= self.feeds[b - 1].v_mm_s.min(self.caps[b].v_mm_s)
            && to.same_slope()
            && from.queued.brakes_late_into(&to.queued)
    }

    /// Boundaries across which braking that begins before the window has to be carried.
    fn carried_from_start(&self) -> Vec<bool> {
        let mut carried = self.carried.to_vec();
        let v0 = self.v_start.v_mm_s;
        for end in 1..self.blocks.len() {
            let s = Window { carried: &carried, ..*self }.stretch(0, end);
            if !s.is_above(v0) || s.slope.down_distance(v0, s.feed) <= s.length || !self.joins(end)
            {
                break;
            }
            carried[end] = true;
        }
        carried
    }

    /// A plan with braking carried across the ends of runs as far as that makes it faster; `None` if it does so
    /// nowhere.
    fn carried(&self, base: &[Span]) -> Option<Vec<Span>> {
        let mut carried = self.carried.to_vec();
        let mut plan: Option<Vec<Span>> = None;
        for _ in 0..ROUNDS {
            let now = plan.as_deref().unwrap_or(base);
            let joints = Window { carried: &carried, ..*self }.joints(now);
            if joints.is_empty() {
                break;
            }
            for b in joints {
                carried[b] = true;
            }
            match (Window { carried: &carried, ..*self }).plan_passing() {
                Ok(next) => plan = Some(next),
                Err(_) => break,
            }
        }
        plan
    }

    /// Ends of runs across which braking should continue, because the two runs and the part before them then take less
    /// time, with the other speeds unchanged.
    fn joints(&self, plan: &[Span]) -> Vec<usize> {
        let mut out = Vec::new();
        let mut k = 1;
        while k + 1 < plan.len() {
            let b = plan[k + 1].first;
            if self.gains(plan, k) {
                out.push(b);
                // the neighbouring speeds change
                k += 3;
            } else {
                k += 1;
            }
        }
        out
    }

    /// Whether spans `k` and `k + 1` are faster as one.
    fn gains(&self, plan: &[Span], k: usize) -> bool {
        let [before, first, second] = &plan[k - 1..=k + 1] else { return false };
        let start = |s: &Span| s.profile.at(0.0).v_mm_s;
        let best = self.limits[first.first].v_mm_s;
        if !is_above(self.entries[first.first].v_mm_s, self.feeds[first.first].v_mm_s)
            || !is_above(best, start(first))
            || !self.joins(second.first)
        {
            return false;
        }
        let stretch = |span: &Span| self.stretch(span.first, span.end);
        let (up, whole) = (stretch(before), stretch(first).carried_into(&stretch(second)));
        let v0 = start(before);
        let v1 = second.profile.at(second.profile.duration()).v_mm_s;
        // braking ends at the feed rate of the second run at the latest
        if is_above(v1, whole.feed) {
            return false;
        }
        let v = best
            .min(whole.slope.reach_down(v1, whole.length))
            .min(up.slope.reach_up(v0, up.length));
        let v = self.entry_speed(&whole, v, v1);
        let (Ok(up), Ok(whole)) = (up.profile(v0, v), whole.profile(v, v1)) else { return false };
        let time = [before, first, second].iter().map(|s| s.profile.duration()).sum::<f64>();
        up.duration() + whole.duration() < time * (1.0 - 1e-9)
    }
}
