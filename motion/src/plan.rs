//! The plan: everything after the part that is final.
//!
//! It contains the segments with the boundaries before them, the demands of `AX_DEV` on them, the state in which the
//! path enters the first one, and the most recent way to rest. The passes are functions on it: [`crate::lookahead`]
//! determines the speed of a window ([`Plan::place`]), [`crate::tolerance`] examines the result and tightens the
//! demands, and the planner makes its first part final. A change of override or feedhold either replaces the plan or
//! leaves it unchanged.
//!
//! The plan is about segments, speeds and moments; setpoints, filters and the final part are not touched here.

mod reserve;
mod short;

use crate::asked::Asked;
use crate::cap::{Cap, SpeedLimit};
use crate::lookahead::{Draft, plan_again};
use crate::profile::Infeasible;
use crate::queue::Queued;
use crate::timeline::{Entry, Moment};
use crate::tolerance::{Demands, Kernels};
use kontur_filters::time::CycleTime;
pub(crate) use reserve::{Later, Reserve};
use short::lower_caps;
use std::collections::VecDeque;
use std::sync::Arc;

/// A block, or a part of one, with the boundary before it.
#[derive(Clone, Debug)]
pub(crate) struct Segment {
    pub(crate) queued: Arc<Queued>,
    /// Speed that the boundary permits.
    pub(crate) cap: Cap,
    /// Demands of the tolerance on both in their first plan.
    pub(crate) asked: Option<Asked>,
}

impl Segment {
    /// The limits that its entry keeps.
    pub(crate) fn limits(&self) -> (Cap, Option<Asked>) {
        (self.cap, self.asked)
    }
}

/// State in which the path enters its first segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    pub(crate) moment: Moment,
    /// Path length of the program in mm.
    pub(crate) s_mm: f64,
    /// Speed and its reason.
    pub(crate) speed: Cap,
    /// Path acceleration in mm/s2.
    pub(crate) a_mm_s2: f64,
}

/// The part of the path that is not final, see the module.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    pub(crate) segments: VecDeque<Segment>,
    /// Number of programmed blocks among them: a spline or a rounded corner is planned in parts.
    programmed: usize,
    pub(crate) start: Start,
    /// Demands of the tolerance on the segments, as far as they have been planned.
    pub(crate) demands: Demands,
    /// Remainder of the most recent plan, from the start to rest.
    pub(crate) reserve: Reserve,
    /// The most recent plan; most of it is reused in the next one.
    draft: Draft,
}

impl Default for Plan {
    fn default() -> Self {
        let rest = Start { moment: Moment::default(), s_mm: 0.0, speed: Cap::STOP, a_mm_s2: 0.0 };
        Self::from_state(rest)
    }
}

impl Plan {
    /// A plan without segments.
    pub(crate) fn from_state(start: Start) -> Self {
        Self {
            segments: VecDeque::new(),
            programmed: 0,
            start,
            demands: Demands::default(),
            reserve: Reserve::default(),
            draft: Draft::default(),
        }
    }

    /// Appends a segment, and lowers the caps of those that fall into one cycle with it.
    pub(crate) fn push(&mut self, segment: Segment, cycle: CycleTime, kernel_active: bool) {
        let seq = segment.queued.block.seq;
        if self.segments.back().is_none_or(|last| last.queued.block.seq != seq) {
            self.programmed += 1;
        }
        self.segments.push_back(segment);
        lower_caps(&mut self.segments, cycle, kernel_active);
    }

    /// Replaces all segments, with the demands of the tolerance on the new ones.
    pub(crate) fn replace(&mut self, segments: Vec<Segment>) {
        self.demands = Demands::again(segments.iter().map(|s| s.asked.unwrap_or_default()));
        self.segments = segments.into();
        self.draft = Draft::default();
        self.programmed = programmed(&self.segments);
    }

    /// Number of programmed blocks.
    pub(crate) fn programmed(&self) -> usize {
        self.programmed
    }

    /// Whether the path is at rest where the plan starts.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.start.speed.v_mm_s <= 0.0
    }

    /// Whether the first segment must not be entered (override 0).
    pub(crate) fn is_barred(&self) -> bool {
        self.segments.front().is_some_and(|s| s.queued.velocity.v_mm_s <= 0.0)
    }

    /// The blocks up to the first one with zero speed; the path ends before it.
    pub(crate) fn window(&self) -> Vec<Arc<Queued>> {
        let blocks = self.segments.iter().map(|s| &s.queued);
        let mut window = Vec::with_capacity(self.segments.len());
        window.extend(blocks.take_while(|q| q.velocity.v_mm_s > 0.0).cloned());
        window
    }

    /// Plans a window and places the spans on the time axis; `forced` boundaries are knots, and `end` is the reason why
    /// the path ends. Spans that begin at block `enough` or later are not placed; these must have no demands, and the path must not
    /// stop there.
    ///
    /// # Errors
    /// [`Infeasible`] if no speed profile leads from the start to rest.
    pub(crate) fn place(
        &mut self,
        window: &[Arc<Queued>],
        forced: &[bool],
        (start, end): (Moment, SpeedLimit),
        enough: usize,
        cycle: CycleTime,
    ) -> Result<(Vec<Entry>, Later), Infeasible> {
        let lower = |cap: Cap, demand: f64| cap.lower(Cap::new(demand, SpeedLimit::AxDev));
        let (n, demands) = (window.len(), &self.demands);
        let feeds: Vec<Cap> = window
            .iter()
            .enumerate()
            .map(|(i, q)| {
                let floor = if i == 0 { self.start.speed.v_mm_s } else { 0.0 };
                lower(q.velocity, demands.feed[i].max(floor))
            })
            .collect();
        let cap = |i: usize| {
            let own = self.segments.get(i).map_or(Cap::new(0.0, end), |s| s.cap);
            match i.checked_sub(1) {
                Some(before) => own.lower(window[before].end_cap()),
                None => own,
            }
        };
        let caps: Vec<Cap> = (0..=n).map(|i| lower(cap(i), demands.cap[i])).collect();
        let forced: Vec<bool> = (0..=n).map(|i| forced[i] || demands.stop[i].is_some()).collect();
        let gentle = demands.soften(window);
        let from = (self.start.speed, self.start.a_mm_s2);
        let limits = (&feeds[..], &caps[..]);
        let draft = std::mem::take(&mut self.draft);
        self.draft = plan_again(&gentle, limits, &forced, from, end, draft)?;
        let spans = &self.draft.spans;
        // after a rest the start may have to wait until the corner before it has left the filters
        let mut at = match demands.stop[0] {
            Some(wait) => Moment::tick(start.next_tick(cycle) + u64::from(wait)),
            None => start,
        };
        let mut s = self.start.s_mm;
        let (now, later) = spans.split_at(spans.partition_point(|span| span.first < enough));
        let mut entries = Vec::with_capacity(now.len() + 1);
        for span in now {
            let stop = demands.stop[span.end];
            let stops = stop.is_some() || (span.end == n && end != SpeedLimit::Lookahead);
            // made in place: entries are large
            entries.push(Entry::new(at, s, span, window, stops));
            let Some(entry) = entries.last_mut() else { continue };
            let (blocks, feeds) = (span.first..span.end, &feeds[span.first..span.end]);
            if window[blocks].iter().zip(feeds).any(|(q, feed)| q.velocity != *feed) {
                entry.feeds.extend_from_slice(feeds);
            }
            at = match stop {
                Some(dwell) => Moment::tick(entry.end.next_tick(cycle) + u64::from(dwell)),
                None => entry.end,
            };
            s += span.profile.length();
        }
        Ok((entries, Later::new(later, at, s)))
    }

    /// The entries of the reserve, all of which are made now.
    pub(crate) fn placed_reserve(&mut self) -> &mut VecDeque<Entry> {
        let Self { reserve, segments, .. } = self;
        reserve.place(segments.iter().map(|segment| &segment.queued));
        &mut reserve.entries
    }

    /// The segments with the present demands of the tolerance.
    pub(crate) fn asked(&self) -> impl Iterator<Item = Segment> {
        let segments = self.segments.iter().enumerate();
        segments
            .map(|(i, s)| Segment { asked: s.asked.or_else(|| self.demands.of(i)), ..s.clone() })
    }

    /// Removes and returns the first segments, which become final.
    pub(crate) fn pass(&mut self, count: usize) -> Vec<Segment> {
        let Self { segments, demands, .. } = self;
        let passed = segments.drain(..count).enumerate();
        let final_ones = passed
            .map(|(i, s)| Segment { asked: s.asked.or_else(|| demands.of(i)), ..s })
            .collect();
        self.demands.pass(count);
        self.draft.pass(count);
        self.programmed = programmed(&self.segments);
        final_ones
    }

    /// Replaces segments, given by their index, by parts of them.
    pub(crate) fn divide(
        &mut self,
        blocks: Vec<(usize, Vec<Arc<Queued>>)>,
        kernels: &Kernels,
        cycle: CycleTime,
    ) {
        self.placed_reserve();
        for (b, parts) in blocks.into_iter().rev() {
            let mut first = 0;
            for entry in &mut self.reserve.entries {
                if b < first + entry.blocks.len() {
                    entry.divide(b - first, &parts);
                    break;
                }
                first += entry.blocks.len();
            }
            for part in parts[1..].iter().rev() {
                let cap = Cap::new(f64::INFINITY, SpeedLimit::Curve);
                self.segments.insert(b + 1, Segment { queued: Arc::clone(part), cap, asked: None });
            }
            self.segments[b].queued = Arc::clone(&parts[0]);
            self.demands.divide(b, &parts, kernels, cycle);
        }
    }
}

/// Index at which the last `count` programmed blocks of a window begin.
pub(crate) fn last_blocks(window: &[Arc<Queued>], count: usize) -> usize {
    let (mut left, mut at) = (count, window.len());
    while at > 0 {
        if at == window.len() || window[at - 1].block.seq != window[at].block.seq {
            if left == 0 {
                break;
            }
            left -= 1;
        }
        at -= 1;
    }
    at
}

/// Number of programmed blocks, some of them in parts.
fn programmed(segments: &VecDeque<Segment>) -> usize {
    let seqs = segments.iter().map(|s| s.queued.block.seq);
    let behind = seqs.clone().skip(1);
    usize::from(!segments.is_empty()) + seqs.zip(behind).filter(|(a, b)| a != b).count()
}
