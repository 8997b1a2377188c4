//! A stretch: the blocks between two knots, as one length with the weakest of their limits.
//!
//! A stretch has its blocks; the speeds at its ends belong to the window.

use super::outline::{Outline, rates};
use super::{Window, is_above};
use crate::cap::Cap;
use crate::profile::{Infeasible, Profile, Rates, SlopeLimits};
use crate::ride::{Cell, has_hill};
use smallvec::SmallVec;
use std::ops::Deref;

/// Relative difference of the path acceleration from which on blocks planned across are not planned with the weakest of
/// them.
const UNEVEN: f64 = 0.01;
/// The same for rows of blocks. With less, the noise of a contour of short blocks would have all of it planned along its
/// limits, which takes up to twice the time and gains less than a thousandth.
const CLEARLY: f64 = 0.1;

/// Relative difference from which on a speed exceeds a limit; less is rounding.
const EXCEEDED: f64 = 1e-9;

/// Blocks `first..end` between two knots.
pub(super) struct Stretch<'a> {
    pub(super) first: usize,
    pub(super) end: usize,
    /// Length in mm.
    pub(super) length: f64,
    /// Highest feed rate in mm/s.
    pub(super) feed: f64,
    pub(super) slope: Weakest<'a>,
}

/// The slope of a single block by reference, or the weakest of several. Limits are large, and most stretches have one
/// block.
pub(super) enum Weakest<'a> {
    One(&'a SlopeLimits),
    OfSeveral(Box<SlopeLimits>),
}

impl Deref for Weakest<'_> {
    type Target = SlopeLimits;

    fn deref(&self) -> &SlopeLimits {
        match self {
            Self::One(slope) => slope,
            Self::OfSeveral(slope) => slope,
        }
    }
}

impl Weakest<'_> {
    /// Combines the limits with those of other blocks.
    fn join<'b>(&mut self, others: impl Iterator<Item = &'b SlopeLimits> + Clone) {
        let weakest = self.weakest(others);
        match self {
            Self::One(_) => *self = Self::OfSeveral(Box::new(weakest)),
            Self::OfSeveral(slope) => **slope = weakest,
        }
    }
}

impl<'a> Window<'a> {
    /// The stretches between knots.
    pub(super) fn stretches(&self, is_knot: impl Fn(usize) -> bool) -> Vec<Stretch<'a>> {
        let mut out = Vec::with_capacity(self.blocks.len());
        let mut first = 0;
        for end in (1..=self.blocks.len()).filter(|b| is_knot(*b)) {
            out.push(self.stretch(first, end));
            first = end;
        }
        out
    }

    /// Joins stretches between which there is no knot any more.
    pub(super) fn join_dropped(
        &self,
        stretches: &mut Vec<Stretch<'a>>,
        is_knot: impl Fn(usize) -> bool,
    ) {
        stretches.dedup_by(|behind, joined| {
            let dropped = !is_knot(behind.first);
            if dropped {
                self.prolong(joined, behind.end);
            }
            dropped
        });
    }

    /// The blocks from `first` up to the boundary before block `end`.
    pub(super) fn stretch(&self, first: usize, end: usize) -> Stretch<'a> {
        let mut s = Stretch::of(self.blocks, self.feeds, first);
        self.prolong(&mut s, end);
        s
    }

    /// Prolongs a stretch up to the boundary before block `end`.
    fn prolong(&self, s: &mut Stretch<'a>, end: usize) {
        for i in s.end..end {
            s.length += self.blocks[i].length;
            let feed = self.feeds[i].v_mm_s;
            s.feed = if self.carried[i] {
                // the speed at which the braking ends
                feed
            } else {
                // across blocks of different feed rates the check finds the boundaries that are exceeded
                s.feed.max(feed)
            };
        }
        if s.end < end {
            s.slope.join(self.blocks[s.end..end].iter().map(|block| &block.queued.slope));
            s.end = end;
        }
    }
}

impl<'a> Stretch<'a> {
    /// The stretch of one block.
    fn of(blocks: &'a [Outline], feeds: &[Cap], first: usize) -> Self {
        let (block, feed) = (&blocks[first], feeds[first].v_mm_s);
        let slope = Weakest::One(&block.queued.slope);
        Self { first, end: first + 1, length: block.length, feed, slope }
    }
}

impl Stretch<'_> {
    /// Both stretches as one, with the feed rate of the second: braking continues from the first into the second.
    pub(super) fn carried_into(mut self, second: &Self) -> Self {
        self.slope.join(std::iter::once(&*second.slope));
        self.length += second.length;
        (self.end, self.feed) = (second.end, second.feed);
        self
    }

    /// Largest speed at the end, with zero acceleration, from a speed and an acceleration at the start; the
    /// acceleration is brought to zero first.
    pub(super) fn reach_from(&self, v: f64, a: f64) -> f64 {
        let settled = self.slope.settled(v, a);
        let length = self.slope.change(v, a, settled).map_or(0.0, |c| c.length());
        self.slope.reach_up(settled.max(0.0), (self.length - length).max(0.0))
    }

    /// Whether one of its blocks, or several with the same limits such as the parts of a line, permits more than all of
    /// them together and is long enough at this speed to use it.
    pub(super) fn is_uneven(&self, blocks: &[Outline], v: f64) -> bool {
        let mut length = 0.0;
        blocks[self.first..self.end].iter().enumerate().any(|(i, block)| {
            if block.queued.slope.nearly_equals(&self.slope, UNEVEN) {
                return false;
            }
            let goes_on = i > 0 && block.same_rates();
            length = if goes_on { length + block.length } else { block.length };
            rates(&block.queued).is_some_and(|r| has_hill(length, v, &r))
        })
    }

    /// The same for a row of different blocks, each of which permits clearly more than all of them together: one weak
    /// block does not slow all others.
    pub(super) fn has_strong_row(&self, blocks: &[Outline], v: f64) -> bool {
        // rows that end with the present block, the longest first, each with its own weakest limits
        let mut rows: SmallVec<[(f64, Rates); 8]> = SmallVec::new();
        blocks[self.first..self.end].iter().any(|block| {
            if block.queued.slope.nearly_equals(&self.slope, CLEARLY) {
                rows.clear();
                return false;
            }
            let Some(own) = rates(&block.queued) else { return false };
            for (length, weakest) in &mut rows {
                (*length, *weakest) = (*length + block.length, weakest.weaker(&own));
            }
            rows.push((block.length, own));
            // of rows with the same limits the longest one is enough
            rows.dedup_by(|shorter, longer| shorter.1.nearly_equals(&longer.1, UNEVEN));
            rows.iter().any(|(length, weakest)| has_hill(*length, v, weakest))
        })
    }

    /// Whether a speed at its start is above its feed rate (G901).
    pub(super) fn is_above(&self, v0: f64) -> bool {
        is_above(v0, self.feed)
    }

    /// The speed in mm/s of a single block between these speeds if it has nothing but one speed, as most blocks of a run.
    pub(super) fn even_speed(&self, (v0, v1): (f64, f64)) -> Option<f64> {
        let is_even = self.end - self.first == 1
            && self.feed <= v0
            && v0.to_bits() == v1.to_bits()
            && !self.is_above(v0)
            && v0 > 0.0
            && self.length > 0.0
            && matches!(*self.slope, SlopeLimits::Ramped(_));
        is_even.then_some(v0)
    }

    pub(super) fn profile(&self, v0: f64, v1: f64) -> Result<Profile, Infeasible> {
        if self.is_above(v0) {
            self.slope.plan_from_above(v0, v1, self.feed, self.length)
        } else {
            self.slope.plan(v0, v1, self.feed, self.length)
        }
    }
}

/// Limits of the blocks of a stretch; `None` with STEP and with constant ramp times.
pub(super) fn cells(
    blocks: &[Outline],
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
            Some(Cell { end: at, v: feeds[i].v_mm_s, cap, rates: rates(&blocks[i].queued)? })
        })
        .collect()
}

/// The boundary inside a span at which the profile exceeds its cap, or the velocity of the block before it, most.
pub(super) fn most_exceeded(
    blocks: &[Outline],
    feeds: &[Cap],
    caps: &[Cap],
    s: &Stretch<'_>,
    profile: &Profile,
) -> Option<usize> {
    // a profile whose peak is below every limit needs no look at the boundaries
    let inside = caps[s.first + 1..s.end].iter().chain(&feeds[s.first..s.end]);
    let lowest = inside.map(|cap| cap.v_mm_s).fold(f64::INFINITY, f64::min);
    if profile.peak() <= lowest * (1.0 + 0.5 * EXCEEDED) {
        return None;
    }
    let mut worst = (1.0 + EXCEEDED, None);
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
        // a peak inside the block: the velocity is kept at both ends, but not in the middle
        let peak = profile.highest_inside(at - blocks[i].length, at).max(before).max(behind);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cap::SpeedLimit;
    use crate::example::{Arc, block};
    use crate::lookahead::outline::follow;
    use crate::queue::Queued;
    use kontur_filters::time::CycleTime;
    use proptest::prelude::*;

    proptest! {
        /// A limit counts as exceeded if and only if one of many sampled speeds is above it, whether it is far below the peak,
        /// close to it or above it.
        #[test]
        fn exceeded_is_what_samples_exceed(
            lengths in prop::collection::vec(0.5..4.0f64, 1..8),
            ratios in prop::collection::vec(prop_oneof![Just(1.0), 0.3..1.5f64, 0.98..1.02f64], 16),
        ) {
            let cycle = CycleTime::from_us(1000).unwrap();
            let n = lengths.len();
            let mut x = 0.0;
            let blocks = (1..).zip(&lengths).map(|(seq, length)| {
                let from = x;
                x += length;
                Arc::new(Queued::new(block(seq, [from, 0.0], [x, 0.0], 1000.0), cycle))
            });
            let blocks: Vec<Arc<Queued>> = blocks.collect();
            let mut outlines = Vec::new();
            follow(&mut outlines, &blocks);
            let slope = Weakest::One(&blocks[0].slope);
            let s = Stretch { first: 0, end: n, length: x, feed: 1000.0, slope };
            let profile = s.profile(0.0, 0.0).unwrap();
            let samples = |i: u32| profile.at(profile.duration() * f64::from(i) / 20_000.0);
            let samples: Vec<_> = (0..=20_000).map(samples).collect();
            let fastest = samples.iter().map(|state| state.v_mm_s).fold(0.0, f64::max);
            let cap = |ratio: &f64| Cap::new(ratio * fastest, SpeedLimit::Corner);
            let (feeds, caps): (Vec<Cap>, Vec<Cap>) =
                (ratios[..n].iter().map(cap).collect(), ratios[8..=8 + n].iter().map(cap).collect());
            let (mut from, mut worst) = (0.0, 0.0_f64);
            for i in 0..n {
                let to = from + lengths[i];
                // neighbouring samples on both sides of the ends
                let first = samples.partition_point(|state| state.s_mm < from).saturating_sub(1);
                let last = samples.partition_point(|state| state.s_mm <= to).min(20_000);
                let inside = samples[first..=last].iter().map(|state| state.v_mm_s).fold(0.0, f64::max);
                worst = worst.max(inside / feeds[i].v_mm_s);
                if i + 1 < n {
                    worst = worst.max(samples[last].v_mm_s / caps[i + 1].v_mm_s);
                }
                from = to;
            }
            // a single block has no boundary inside
            prop_assume!((worst - 1.0).abs() > 2e-3);
            let exceeded = most_exceeded(&outlines, &feeds, &caps, &s, &profile);
            prop_assert_eq!(exceeded.is_some(), n > 1 && worst > 1.0);
        }
    }
}
