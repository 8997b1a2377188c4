//! Spans on the time axis: where the path is in cycle `k`.
//!
//! The profiles are continuous. A motion starts on a cycle tick; its setpoint `j` is the profile at `j T`, counted as
//! an integer. A thread starts inside a cycle, where the spindle passes its mark. Boundaries of spans and blocks fall
//! inside cycles, and the rest of such a cycle is spent in the next span. The last cycle of a motion is its exact end.

mod moment;
mod reason;

use crate::asked::Asked;
use crate::axis::AxisVec;
use crate::cap::{Cap, SpeedLimit};
use crate::lookahead::Span;
use crate::profile::{Profile, State};
use crate::queue::Queued;
use kontur_filters::time::CycleTime;
pub(crate) use moment::Moment;
use reason::Low;
pub(crate) use reason::is_at;
use smallvec::SmallVec;
use std::collections::VecDeque;
use std::sync::Arc;

/// Relative difference of lengths that counts as rounding.
pub(crate) const SAME_LENGTH: f64 = 1e-12;

/// Parts of a block whose ends are closer together than this, in mm, end at the same point.
pub(crate) const SAME_END_MM: f64 = 1e-9;

/// Findings of earlier examinations about an entry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Seen {
    /// None, or that it exceeds the tolerance.
    Nothing,
    /// According to a first check it keeps the tolerance.
    Glanced,
    /// Its set points stay at the contour; the moment is its start in that measurement. What it misses is not known.
    Stays(Moment),
    /// It kept the tolerance in the last measurement; the moment is its start then.
    Kept(Moment),
}

/// A span placed in time.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) start: Moment,
    pub(crate) end: Moment,
    /// Path length of the program at the start of the span.
    pub(crate) s0: f64,
    pub(crate) profile: Profile,
    pub(crate) why_up: SpeedLimit,
    pub(crate) why_down: SpeedLimit,
    /// Blocks with the path length inside the span at their end; the last one may extend beyond the span.
    pub(crate) blocks: SmallVec<[(Arc<Queued>, f64); 1]>,
    /// Speeds that the plan assigned to the blocks; empty: those of the blocks, as without demands of the tolerance.
    pub(crate) feeds: Vec<Cap>,
    /// Caps at the starts of the blocks, and the demands of the tolerance on them, once the entry is final.
    pub(crate) caps: SmallVec<[(Cap, Option<Asked>); 1]>,
    /// Limits inside the entry to which the speed falls, in order.
    lows: Vec<Low>,
    /// Whether the motion ends here, at its next tick.
    pub(crate) stops: bool,
    pub(crate) seen: Seen,
    /// Time in s since the start from which on another entry applies.
    cut_s: Option<f64>,
}

/// State of the path in one cycle.
#[derive(Clone, Debug, Default)]
pub(crate) struct PathState {
    /// Position of every axis.
    pub(crate) position: AxisVec,
    /// Path length since the start of the program in mm.
    pub(crate) s: f64,
    /// Path velocity in mm/s.
    pub(crate) v: f64,
    /// Path acceleration in mm/s2.
    pub(crate) a: f64,
    /// Path jerk in mm/s3.
    pub(crate) j: f64,
    /// Reason for the present speed.
    pub(crate) limit: SpeedLimit,
    /// Number of the block.
    pub(crate) seq: u64,
}

impl PathState {
    /// At rest at a position.
    pub(crate) fn at_rest(position: &AxisVec) -> Self {
        Self { position: position.clone(), ..Self::default() }
    }
}

impl Entry {
    #[inline]
    pub(crate) fn new(
        start: Moment,
        s0: f64,
        span: &Span,
        window: &[Arc<Queued>],
        stops: bool,
    ) -> Self {
        let why = (span.why_up, span.why_down);
        let blocks = &window[span.first..span.end];
        Self::along(start, s0, span.profile.clone(), why, blocks, stops)
    }

    /// A profile along blocks; `why` are the reasons while accelerating and while braking.
    #[inline]
    pub(crate) fn along(
        start: Moment,
        s0: f64,
        profile: Profile,
        why: (SpeedLimit, SpeedLimit),
        blocks: &[Arc<Queued>],
        stops: bool,
    ) -> Self {
        let mut ends: SmallVec<[(Arc<Queued>, f64); 1]> = SmallVec::with_capacity(blocks.len());
        let mut at = 0.0;
        for queued in blocks {
            at += queued.length;
            ends.push((Arc::clone(queued), at));
        }
        Self {
            start,
            end: start.plus(profile.duration()),
            s0,
            profile,
            why_up: why.0,
            why_down: why.1,
            blocks: ends,
            feeds: Vec::new(),
            caps: SmallVec::new(),
            lows: Vec::new(),
            stops,
            seen: Seen::Nothing,
            cut_s: None,
        }
    }

    /// State at the end.
    pub(crate) fn last(&self) -> State {
        self.cut_s.map_or_else(|| self.profile.end(), |t| self.profile.at(t))
    }

    /// The parts before and after block `n`, with the acceleration between them unchanged; `None` if the profile cannot
    /// be split there.
    pub(crate) fn split(&self, n: usize) -> Option<[Self; 2]> {
        let s = self.blocks[n - 1].1;
        let (before, behind) = self.profile.split(s)?;
        let (own, later) = self.blocks.split_at(n);
        let (own_feeds, later_feeds) = self.feeds.split_at(n.min(self.feeds.len()));
        let later = later.iter().map(|(queued, end)| (Arc::clone(queued), end - s));
        let cut = self.start.plus(before.duration());
        let first = Self {
            end: cut,
            profile: before,
            blocks: own.iter().cloned().collect(),
            feeds: own_feeds.to_vec(),
            caps: self.caps.clone(),
            lows: Vec::new(),
            stops: false,
            ..*self
        };
        let second = Self {
            start: cut,
            s0: self.s0 + s,
            profile: behind,
            blocks: later.collect(),
            feeds: later_feeds.to_vec(),
            caps: self.caps.clone(),
            lows: Vec::new(),
            ..*self
        };
        Some([first, second])
    }

    /// Replaces a block by parts of it.
    pub(crate) fn divide(&mut self, block: usize, parts: &[Arc<Queued>]) {
        let mut end = self.blocks[block].1;
        self.blocks.remove(block);
        if let Some(feed) = self.feeds.get(block).copied() {
            let more = std::iter::repeat_n(feed, parts.len().saturating_sub(1));
            self.feeds.splice(block..block, more);
        }
        for part in parts.iter().rev() {
            self.blocks.insert(block, (Arc::clone(part), end));
            end -= part.length;
        }
    }

    /// Ends the entry in cycle `k`.
    pub(crate) fn cut(&mut self, k: u64, cycle: CycleTime) {
        let t = self.seconds_at(k, cycle);
        let s = self.profile.at(t).s_mm;
        let inside = self.blocks.iter().take_while(|(q, s_end)| s_end - q.length < s).count();
        self.blocks.truncate(inside.max(1));
        self.caps.truncate(inside.max(1));
        (self.cut_s, self.stops) = (Some(t), false);
        self.end = self.start.plus(t);
    }

    /// Whether the motion or the dwell of this entry is over in cycle `k`.
    pub(crate) fn is_over(&self, k: u64, cycle: CycleTime) -> bool {
        if self.stops {
            k >= self.end.next_tick(cycle)
        } else {
            k >= self.start.origin
                && self.seconds_at(k, cycle)
                    >= self.cut_s.unwrap_or_else(|| self.profile.duration())
        }
    }

    /// Time in s since the start in cycle `k`; 0 before it (during a dwell).
    pub(crate) fn seconds_at(&self, k: u64, cycle: CycleTime) -> f64 {
        (cycle.time_of(k.saturating_sub(self.start.origin)) - self.start.seconds()).max(0.0)
    }

    /// State in cycle `k`; exact at the end of a motion.
    pub(crate) fn state(&self, k: u64, cycle: CycleTime, out: &mut PathState) {
        self.walk(cycle).state(k, out);
    }

    /// The entry, prepared to be read in many cycles.
    pub(crate) fn walk(&self, cycle: CycleTime) -> Walk<'_> {
        let (start_s, end_s) = (self.start.seconds(), self.end.seconds());
        let last_k = if self.stops { self.end.next_tick(cycle) } else { u64::MAX };
        Walk { entry: self, cycle, start_s, end_s, last_k }
    }

    /// Moments in cycles and path lengths of the program at which the blocks of the span are entered.
    pub(crate) fn entries(
        &self,
        cycle: CycleTime,
    ) -> impl Iterator<Item = (f64, f64, &Arc<Queued>)> {
        self.blocks.iter().map(move |(q, s_end)| {
            let s = s_end - q.length;
            let t = if s <= 0.0 { 0.0 } else { self.profile.time_at(s) };
            (self.start.cycles(cycle) + t / cycle.seconds(), self.s0 + s, q)
        })
    }
}

/// Consecutive spans, read in order of time.
#[derive(Clone, Debug, Default)]
pub(crate) struct Timeline {
    entries: VecDeque<Entry>,
}

impl Timeline {
    pub(crate) fn push(&mut self, entry: Entry) {
        self.entries.push_back(entry);
    }

    pub(crate) fn append(&mut self, mut entries: VecDeque<Entry>) {
        if self.entries.is_empty() {
            // entries are large: not copied
            self.entries = entries;
        } else {
            self.entries.append(&mut entries);
        }
    }

    pub(crate) fn entries(&self) -> impl DoubleEndedIterator<Item = &Entry> {
        self.entries.iter()
    }

    /// Replaces all entries.
    pub(crate) fn put(&mut self, entries: Vec<Entry>) {
        self.entries = entries.into();
    }

    /// Removes and returns all entries.
    pub(crate) fn take(&mut self) -> VecDeque<Entry> {
        std::mem::take(&mut self.entries)
    }

    /// Drops the entries before cycle `k` and fills `out`; false if `k` is after the last span.
    pub(crate) fn advance(&mut self, k: u64, cycle: CycleTime, out: &mut PathState) -> bool {
        let mut at = 0;
        let found = self.find(&mut at, k, cycle);
        if let Some(entry) = found {
            entry.state(k, cycle, out);
        }
        let found = found.is_some();
        self.drop_first(at);
        found
    }

    /// The entry of cycle `k`, searched from number `at` on, which is set to its number; `None` if `k` is after the
    /// last span. A path that has stopped for good stays at its last entry.
    pub(crate) fn find(&self, at: &mut usize, k: u64, cycle: CycleTime) -> Option<&Entry> {
        while let Some(entry) = self.entries.get(*at) {
            let next = self.entries.get(*at + 1);
            let resting = entry.stops && next.is_some_and(|e| k <= e.start.origin);
            if resting || entry.walk(cycle).covers(k) {
                return Some(entry);
            }
            if next.is_none() && entry.stops {
                return None;
            }
            *at += 1;
        }
        None
    }

    /// Drops the first entries.
    pub(crate) fn drop_first(&mut self, count: usize) {
        // where they lie: an entry that is taken out would be copied
        self.entries.drain(..count.min(self.entries.len()));
    }
}

/// An entry with the values that are the same in all of its cycles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Walk<'a> {
    entry: &'a Entry,
    cycle: CycleTime,
    start_s: f64,
    end_s: f64,
    /// Cycle of the end of a motion.
    last_k: u64,
}

impl Walk<'_> {
    /// Whether cycle `k` is not after the end.
    #[inline]
    pub(crate) fn covers(&self, k: u64) -> bool {
        if self.entry.stops {
            k <= self.last_k
        } else {
            self.cycle.time_of(k.saturating_sub(self.entry.start.origin)) < self.end_s
        }
    }

    /// State in cycle `k`; exact at the end of a motion.
    #[inline]
    pub(crate) fn state(&self, k: u64, out: &mut PathState) {
        let Entry { profile, blocks, .. } = self.entry;
        // before the start the path rests at its beginning
        let since = self.cycle.time_of(k.saturating_sub(self.entry.start.origin));
        let t = (since - self.start_s).max(0.0);
        let over = k >= self.last_k;
        let state = profile.at(if over { profile.duration() } else { t });
        let i = match &blocks[..] {
            [_] => 0,
            blocks => blocks.partition_point(|b| b.1 <= state.s_mm).min(blocks.len() - 1),
        };
        let (queued, s_end) = &blocks[i];
        let path = &queued.block.path;
        let s = queued.offset + state.s_mm - (s_end - queued.length);
        if over {
            if queued.goes_on || *s_end > profile.length() * (1.0 + SAME_LENGTH) {
                path.position(s, &mut out.position);
            } else {
                out.position.copy_from_slice(path.end());
            }
            (out.v, out.a, out.j) = (0.0, 0.0, 0.0);
            out.limit = self.entry.why_down;
        } else {
            path.position(s, &mut out.position);
            (out.v, out.a, out.j) = (state.v_mm_s, state.a_mm_s2, state.j_mm_s3);
            out.limit = self.entry.reason(i, &state);
        }
        out.s = self.entry.s0 + state.s_mm;
        out.seq = queued.block.seq;
    }
}

/// Path states of increasing cycles along the final part and a plan after it; after the end of a motion the path rests
/// there until the next one starts.
#[derive(Debug)]
pub(crate) struct Reader<'a> {
    placed: &'a VecDeque<Entry>,
    plan: &'a [Entry],
    at: usize,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(timeline: &'a Timeline, plan: &'a [Entry]) -> Self {
        Self { placed: &timeline.entries, plan, at: 0 }
    }

    fn get(&self, i: usize) -> Option<&'a Entry> {
        self.placed.get(i).or_else(|| self.plan.get(i - self.placed.len()))
    }

    /// State in cycle `k`; before the first and after the last span the path rests at its end.
    pub(crate) fn state(&mut self, k: u64, cycle: CycleTime, out: &mut PathState) {
        let started = |e: &Entry| {
            k >= e.start.origin && cycle.time_of(k - e.start.origin) >= e.start.seconds()
        };
        while self.at > 0 && !self.get(self.at).is_some_and(started) {
            self.at -= 1;
        }
        while self.get(self.at + 1).is_some_and(started) {
            self.at += 1;
        }
        if let Some(e) = self.get(self.at) {
            e.state(k, cycle, out);
        }
    }
}
