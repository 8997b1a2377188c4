//! The reasons for the speed of an entry where it changes.
//!
//! A profile along many blocks falls to a limit inside and rises from it again. Its speed there is due to that limit,
//! not to those at the ends of the profile.

use super::Entry;
use crate::asked::Asked;
use crate::cap::{Cap, SpeedLimit};
use crate::lookahead::ROUNDING;
use crate::profile::FLAT_MM_S2;
use crate::profile::State;

/// Relative difference up to which the speed counts as being at a limit: the gap that a ride leaves.
const TOUCHES: f64 = 1e-3;

/// A limit inside an entry that the speed falls to or follows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Low {
    /// Path length in mm since the start of the span.
    s_mm: f64,
    why: SpeedLimit,
}

/// Whether a speed in mm/s follows a limit.
pub(crate) fn is_at(v_mm_s: f64, limit: Cap) -> bool {
    v_mm_s >= limit.v_mm_s * (1.0 - TOUCHES)
}

impl Entry {
    /// Stores the limits of its blocks and what the tolerance asks of them, once the entry is final.
    pub(crate) fn hold_to(&mut self, limits: impl IntoIterator<Item = (Cap, Option<Asked>)>) {
        self.caps = limits.into_iter().collect();
        self.lows = if self.blocks.len() > 1 && self.profile.rises_after_a_fall() {
            (1..self.blocks.len()).filter_map(|i| self.low_before(i)).collect()
        } else {
            Vec::new()
        };
    }

    /// The limit at the start of a block if the speed is at it.
    fn low_before(&self, i: usize) -> Option<Low> {
        let feed = |i: usize| self.feeds.get(i).copied().unwrap_or(self.blocks[i].0.velocity);
        let limit = self.caps.get(i)?.0.lower(feed(i - 1)).lower(feed(i));
        let s_mm = self.blocks[i - 1].1;
        let v = self.profile.at(self.profile.time_at(s_mm)).v_mm_s;
        is_at(v, limit).then_some(Low { s_mm, why: limit.why })
    }

    /// The reason for the speed from which it last rises.
    pub(crate) fn last_rise(&self) -> SpeedLimit {
        self.lows.last().map_or(self.why_up, |low| low.why)
    }

    /// The reason for the speed in a state inside block `i`.
    #[inline]
    pub(super) fn reason(&self, i: usize, state: &State) -> SpeedLimit {
        let at = || self.lows.partition_point(|low| low.s_mm <= state.s_mm);
        let top = self.feeds.get(i).unwrap_or(&self.blocks[i].0.velocity);
        if state.a_mm_s2 > FLAT_MM_S2 {
            at().checked_sub(1).map_or(self.why_up, |low| self.lows[low].why)
        } else if state.a_mm_s2 < -FLAT_MM_S2 {
            self.lows.get(at()).map_or(self.why_down, |low| low.why)
        } else if state.v_mm_s >= top.v_mm_s * (1.0 - ROUNDING) {
            // a constant speed after a change of speed contains the rounding of that change
            top.why
        } else {
            self.lows.get(at()).map_or(self.why_down, |low| low.why)
        }
    }
}
