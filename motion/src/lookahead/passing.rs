//! Kinks passed with an acceleration (HSC).
//!
//! A plan arrives at a limiting kink as early as it can: with zero acceleration at a local minimum of the speed, or,
//! while speeding up, with the acceleration that the rise to this speed leaves. Over both sides this is not always
//! optimal. Where the path can change its acceleration faster before the kink than after it, or has less to lose there,
//! a slower approach pays off that passes the kink at the same speed with an acceleration `a`. The minimum of the speed
//! is then before the kink: with the jerk `j` of that block it is `a^2 / 2j` below the speed `v` at the kink and
//! `v t - j t^3 / 3` away from it, `t = a / j`.
//!
//! To first order in `a` one side loses the time `a rho / j`, and the other gains the same expression with its `rho`
//! and `j`; `rho = 1 - v / peak` of the hill on that side. This decides on which side the minimum should be. Its
//! distance is found by trial. A kink where a trial saves nothing is left as it is, and so is a kink between spans of
//! several blocks with different limits: there each trial costs a plan of all of them, and on surfaces and circles of
//! chords it saved less than 1 %.
//!
//! The input is a plan; some of its spans are replaced by ones with the same ends and a shorter duration.
//!
//! TRAPEZ brings the acceleration to zero where it reaches the speed of a kink; HSC may have a non-zero acceleration at
//! the end of a block (P-CHAN-00071). Assumption: this also holds at a kink, within the limits of both blocks. The
//! acceleration of an axis then changes within one cycle by that of the path times the change of direction of the axis,
//! in addition to the velocity jump, the only quantity in the limits of kinks. Kinks limited by `AX_DEV` are excluded,
//! since their speed was determined with the present acceleration.

use super::stretch::cells;
use super::{Span, Window, is_above};
use crate::block::SlopeKind;
use crate::cap::SpeedLimit;
use crate::profile::FLAT_MM_S2;
use crate::profile::{Infeasible, Profile, State};
use crate::ride::Alone;

/// Share of the largest acceleration up to which one is tried, so that the minimum of the speed stays above zero.
const MOST: f64 = 0.98;
/// Largest number of trials at a kink.
const TRIALS: usize = 5;
/// Net saving, as a share of the gain of one side, from which on an acceleration is searched for.
const UNEVEN: f64 = 0.2;
/// Share of the first-order gain that justifies another trial.
const ENOUGH: f64 = 0.02;
/// Share of the largest acceleration within which two accelerations count as equal; also the smallest one that is
/// tried.
const NEAR: f64 = 0.05;
/// Relative difference within which a speed counts as being at its limit.
const AT_LIMIT: f64 = 1e-6;

/// A kink between two spans, and its potential.
struct Kink {
    /// The spans before and after it.
    sides: [Alone; 2],
    v: f64,
    /// Acceleration at which it is passed now, and the largest one that is tried, both signed, mm/s2.
    now: f64,
    most: f64,
    /// Time in s that the difference would save, to first order.
    gain_s: f64,
}

/// Two spans that take less time and replace spans `k - 1` and `k`.
struct Pair {
    k: usize,
    gain_s: f64,
    profiles: [Profile; 2],
}

impl Window<'_> {
    /// Plans from scratch, passing kinks with an acceleration.
    pub(super) fn plan_passing(&self) -> Result<Vec<Span>, Infeasible> {
        let plan = self.plan(Vec::new())?;
        Ok(self.pass(&plan).unwrap_or(plan))
    }

    /// A plan that passes kinks with an acceleration; `None` if that gains nothing.
    pub(super) fn pass(&self, plan: &[Span]) -> Option<Vec<Span>> {
        if !(1..self.blocks.len()).any(|b| self.is_free(b)) {
            return None;
        }
        let mut spans = self.parted(plan);
        let mut found: Vec<Pair> = (1..spans.len()).filter_map(|k| self.pair(&spans, k)).collect();
        if found.is_empty() {
            return None;
        }
        // the best ones first, in an order that does not depend on the direction of travel
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

    /// Whether a kink may be passed with an acceleration.
    fn is_free(&self, b: usize) -> bool {
        let (before, behind) = (&self.blocks[b - 1], &self.blocks[b]);
        let cap = self.caps[b];
        // braking to a lower feed rate ends at that feed rate; braking under G901 begins at a boundary
        let late = |i: usize| {
            let entered = if i == 0 { self.v_start } else { self.entries[i] };
            self.carried[i] || is_above(entered.v_mm_s, self.feeds[i].v_mm_s)
        };
        let feed = self.feeds[b - 1].v_mm_s.min(self.feeds[b].v_mm_s);
        cap.v_mm_s > 0.0
            && is_above(feed, cap.v_mm_s)
            && cap.why != SpeedLimit::AxDev
            && !self.forced[b]
            && before.plans_across
            && behind.same_slope()
            && !late(b - 1)
            && !late(b)
            && behind.queued.block.slope.kind == SlopeKind::Hsc
    }

    /// The spans of the plan, split at the kinks that limit them inside.
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
                let cap = self.limits[b];
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

    /// The best pair around the start of span `k`, if it is faster than the present one.
    fn pair(&self, spans: &[Span], k: usize) -> Option<Pair> {
        let pair = [&spans[k - 1], &spans[k]];
        let kink = self.kink(pair)?;
        let now: f64 = pair.iter().map(|s| s.profile.duration()).sum();
        let state = |s: State| (s.v_mm_s, s.a_mm_s2);
        let (start, end) = (state(pair[0].profile.at(0.0)), state(pair[1].profile.end()));
        // `x`: share of the difference between the present acceleration and the largest one
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
            // a parabola through the origin and the last two trials: gain = (slope - bend x) x
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

    /// The kink between two spans, if a different acceleration is worth a trial.
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
        // seconds per unit of acceleration: the net saving, and the gain of the better side
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
