//! Kinks passed with an acceleration (HSC).
//!
//! A plan gets to a kink that holds it down as early as it can: at a local minimum of the speed with acceleration zero, on
//! the way up with what a rise to this speed has left. Over both sides that is not the best: where the path may change its
//! acceleration faster before the kink than after it, or has less to lose there, a slower approach pays that passes
//! the kink at the same speed with an acceleration `a` under way. The lowest speed then lies before the kink: with
//! the jerk `j` of that block `a^2 / 2j` below the speed `v` at the kink, `v t - j t^3 / 3` away from it, `t = a / j`.
//!
//! To the first order in `a` one side loses the time `a rho / j`, the other one gains as much with its own `rho` and `j`;
//! `rho = 1 - v / peak` of the hill on that side. That says on which side the minimum lies better. How far away is found by
//! trying; a kink where a trial saves nothing is left as it is, and so is one between several blocks with limits of their
//! own: there a trial costs a plan of all of them, and on surfaces and circles of chords it was found to save less than 1 %.
//!
//! It reads a plan and puts spans in its place that begin and end at the same kinks, in less time.
//!
//! TRAPEZ brings the acceleration to zero where it reaches the speed of a kink; HSC may have one at the end of a block
//! (P-CHAN-00071). Assumption: also at a kink, within the limits of both blocks. An axis then changes its acceleration in one
//! cycle by that of the path times its change of direction, in addition to the jump of its velocity, which is all that the limits
//! of kinks know. Where `AX_DEV` holds a kink down, its speed has been found with the acceleration as it was, and that
//! stays so.

use super::stretch::cells;
use super::{FLAT_MM_S2, Span, Window, is_above};
use crate::block::SlopeKind;
use crate::cap::SpeedLimit;
use crate::profile::{Infeasible, Profile, State};
use crate::ride::Alone;

/// Part of the largest acceleration up to which one is tried: the minimum stays above rest.
const MOST: f64 = 0.98;
/// Trials at a kink.
const TRIALS: usize = 5;
/// Part by which what one side gains exceeds what the other loses, from which on an acceleration is looked for.
const UNEVEN: f64 = 0.2;
/// Part of the gain to the first order that is worth another trial.
const ENOUGH: f64 = 0.02;
/// Part of the largest acceleration within which two are the same, and up to which the one that is tried least lies.
const NEAR: f64 = 0.05;
/// Relative difference from its limit within which a speed is held down by it.
const AT_LIMIT: f64 = 1e-6;

/// A kink between two spans, and what may be had there.
struct Kink {
    /// What lies before it and after it.
    sides: [Alone; 2],
    v: f64,
    /// Acceleration with which it is passed, and the largest one that is tried, with their signs.
    now: f64,
    most: f64,
    /// What the difference would save in s, to the first order.
    gain_s: f64,
}

/// Two spans that take less time, in the place of span `k - 1` and span `k`.
struct Pair {
    k: usize,
    gain_s: f64,
    profiles: [Profile; 2],
}

impl Window<'_> {
    /// Plans from nothing, with kinks passed with an acceleration.
    pub(super) fn plan_passing(&self) -> Result<Vec<Span>, Infeasible> {
        let plan = self.plan(Vec::new())?;
        Ok(self.pass(&plan).unwrap_or(plan))
    }

    /// A plan in which kinks are passed with an acceleration; `None` where nothing is gained by that.
    pub(super) fn pass(&self, plan: &[Span]) -> Option<Vec<Span>> {
        if !(1..self.blocks.len()).any(|b| self.is_free(b)) {
            return None;
        }
        let mut spans = self.parted(plan);
        let mut found: Vec<Pair> = (1..spans.len()).filter_map(|k| self.pair(&spans, k)).collect();
        if found.is_empty() {
            return None;
        }
        // the best ones first, whichever side the plan is seen from
        found.sort_by(|a, b| b.gain_s.total_cmp(&a.gain_s));
        let mut changed = vec![false; spans.len()];
        for pair in found {
            let k = pair.k;
            let pair = if changed[k - 1] || changed[k] { self.pair(&spans, k) } else { Some(pair) };
            let Some(Pair { profiles, .. }) = pair else { continue };
            for (k, profile) in (k - 1..).zip(profiles) {
                spans[k].profile = profile;
                changed[k] = true;
            }
        }
        Some(spans)
    }

    /// True if a kink may be passed with an acceleration.
    fn is_free(&self, b: usize) -> bool {
        let [before, behind] = [b - 1, b].map(|i| &self.blocks[i]);
        let cap = self.caps[b];
        // braking to a lower feed ends at that feed; braking under G901 begins at a boundary
        let late = |i: usize| {
            let entered = if i == 0 { self.v_start } else { self.entries[i] };
            self.carried[i] || is_above(entered.v_mm_s, self.feeds[i].v_mm_s)
        };
        let feed = self.feeds[b - 1].v_mm_s.min(self.feeds[b].v_mm_s);
        cap.v_mm_s > 0.0
            && is_above(feed, cap.v_mm_s)
            && cap.why != SpeedLimit::AxDev
            && !self.forced[b]
            && before.plans_across()
            && before.block.slope == behind.block.slope
            && !late(b - 1)
            && !late(b)
            && behind.block.slope.kind == SlopeKind::Hsc
    }

    /// The spans, those that are held down by kinks on their way in parts.
    fn parted(&self, plan: &[Span]) -> Vec<Span> {
        let mut out = Vec::with_capacity(plan.len());
        for span in plan {
            let mut rest = span.clone();
            let mut at = 0.0;
            for b in span.first + 1..span.end {
                at += self.blocks[b - 1].length;
                if !self.is_free(b) {
                    continue;
                }
                let v = rest.profile.at(rest.profile.time_at(at)).v_mm_s;
                let cap = self.limit(b);
                if v < cap.v_mm_s * (1.0 - AT_LIMIT) {
                    continue;
                }
                let Some((first, second)) = rest.profile.split(at) else { continue };
                out.push(Span { end: b, profile: first, why_down: cap.why, ..rest });
                rest = Span { first: b, profile: second, why_up: cap.why, ..rest };
                at = 0.0;
            }
            out.push(rest);
        }
        out
    }

    /// The best pair around the start of span `k`, if it is faster than what is there.
    fn pair(&self, spans: &[Span], k: usize) -> Option<Pair> {
        let pair = [&spans[k - 1], &spans[k]];
        let kink = self.kink(pair)?;
        let now: f64 = pair.iter().map(|s| s.profile.duration()).sum();
        let state = |s: State| (s.v_mm_s, s.a_mm_s2);
        let (start, end) = (state(pair[0].profile.at(0.0)), state(pair[1].profile.end()));
        // `x`: part of the difference between the acceleration now and the largest one
        let tried = |x: f64| {
            let here = (kink.v, kink.now + x * (kink.most - kink.now));
            let [in_front, after] = &kink.sides;
            let pair = [in_front.fastest(start, here)?, after.fastest(here, end)?];
            Some((now - pair.iter().map(Profile::duration).sum::<f64>(), pair))
        };
        let mut best: Option<Pair> = None;
        let (mut x, mut last) = (0.5, None);
        for _ in 0..TRIALS {
            let Some((gain_s, profiles)) = tried(x) else {
                x *= 0.5;
                continue;
            };
            if gain_s > best.as_ref().map_or(0.0, |b| b.gain_s) {
                best = Some(Pair { k, gain_s, profiles });
            }
            // a parabola through nothing and the last two: gain = (slope - bend x) x
            let (slope, bend) = match last {
                None => (kink.gain_s, (kink.gain_s - gain_s / x) / x),
                Some((x0, gain0)) => {
                    let bend = (gain0 / x0 - gain_s / x) / (x - x0);
                    (gain_s / x + bend * x, bend)
                }
            };
            let next = if bend > 0.0 { (0.5 * slope / bend).clamp(NEAR, 1.0) } else { 1.0 };
            let more = (slope - bend * next) * next - gain_s.max(0.0);
            if (next - x).abs() < NEAR || more < ENOUGH * kink.gain_s {
                break;
            }
            last = Some((x, gain_s));
            x = next;
        }
        best
    }

    /// The kink between two spans, if another acceleration there is worth a trial.
    fn kink(&self, [first, second]: [&Span; 2]) -> Option<Kink> {
        let b = second.first;
        let here = second.profile.at(0.0);
        let (v, now) = (here.v_mm_s, here.a_mm_s2);
        if v <= 0.0 || !self.is_free(b) {
            return None;
        }
        let [before, behind] = [first, second]
            .map(|s| Alone::of(&cells(self.blocks, self.feeds, self.caps, s.first, s.end)?));
        let sides = [before?, behind?];
        let [before, behind] = &sides;
        let [in_front, after] = [first, second].map(|s| 1.0 - v / s.profile.peak().max(v));
        // seconds per unit of acceleration: what is saved, and how much of it the one side gains
        let (lost, gained) = (in_front / before.jerk(), after / behind.jerk());
        let is_up = gained >= lost;
        let (saved, gained) = ((gained - lost).abs(), gained.max(lost));
        let inside = if is_up { before } else { behind };
        let [limit, other] = [before, behind].map(|side| side.rates()[usize::from(!is_up)]);
        let most = MOST * limit.min(other).min((2.0 * v * inside.jerk()).sqrt());
        let most = if is_up { most } else { -most };
        let more = if is_up { most - now } else { now - most };
        if more <= FLAT_MM_S2 || saved < UNEVEN * gained {
            return None;
        }
        Some(Kink { sides, v, now, most, gain_s: saved * more })
    }
}
