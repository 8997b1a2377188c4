//! K-0152: a motion takes longer than its programmed time (G93), since accelerations, corners or limits do not permit it.
//!
//! Source: TF5200 programming manual, machining time (G93): such a block gets an error message.
//! Assumption: a warning, for the first motion that takes a tenth more than its time: the ramps of a motion from rest take more in
//! any case.

use super::fault;
use super::state::{Simulation, Timed};
use crate::exec::SourceRef;
use kontur_motion::block::{Block, Feed};

/// Excess over a programmed time, relative to it, that ramps may take without a message.
const TOLERATED: f64 = 0.1;

/// The programmed time of a motion in s, without an override of the program.
pub(super) fn time_of(block: &Block) -> Option<f64> {
    let Feed::Duration(time_s) = block.feed else { return None };
    (block.feed_ratio.to_bits() == 1.0_f64.to_bits()).then_some(time_s)
}

impl Simulation {
    /// A motion begins after cycle `k`, where the one before it ends.
    pub(super) fn time_begins(&mut self, time_s: Option<f64>, source: SourceRef, k: u64) {
        self.time_ends(k);
        self.times.current =
            time_s.map(|time_s| Timed { time_s, from_k: k, source, changed: false });
    }

    /// The path comes to rest, or another motion begins after cycle `k`.
    pub(super) fn time_ends(&mut self, k: u64) {
        let Some(timed) = self.times.current.take() else { return };
        let taken_s = self.cycle.time_of(k - timed.from_k);
        // it began and ended between two cycles
        let most_s = timed.time_s * (1.0 + TOLERATED) + self.cycle.seconds();
        if timed.changed || self.times.told || taken_s <= most_s {
            return;
        }
        self.times.told = true;
        let mut d = fault::time_not_kept(timed.time_s, taken_s);
        d.source = self.program.locate(timed.source);
        self.messages.own.push(d);
    }

    /// Notes an override or a feedhold.
    pub(super) fn watch_time(&mut self) {
        let Some(timed) = &mut self.times.current else { return };
        timed.changed |= self.inputs.changes_speed(false).is_some();
    }
}
