//! The times at which a plan enters its blocks.
//!
//! The plans of a search have the same blocks. What a mark says of the contour stays from one plan to the next; only
//! times, and path lengths by their rounding, are new.

use super::{BORDER_CYCLES, Kernels, Trial};
use crate::axis::AxisVec;
use crate::contour::{Contour, SAME_START_MM};
use crate::queue::Queued;
use kontur_filters::kernel::Kernel;
use std::sync::Arc;

/// Change of direction treated as 0.
pub(super) const STRAIGHT: f64 = 1e-9;

/// Entry of a block in a plan.
#[derive(Debug)]
pub(super) struct Mark {
    pub(super) cycles: f64,
    /// Index of the boundary in the window; `None` if it can no longer change.
    pub(super) boundary: Option<usize>,
    /// Index of the block in the window; `None` if it is final.
    pub(super) block: Option<usize>,
    pub(super) queued: Arc<Queued>,
    /// Path length at the start of the block.
    pub(super) s_mm: f64,
    /// Largest change of direction of an axis with a kernel, and that axis.
    pub(super) jump: f64,
    pub(super) axis: usize,
    /// Point of entry, if this is not the start of the path.
    pub(super) inside: Option<AxisVec>,
    /// Whether the path continues without a corner from the mark before, as the remainder of its block.
    pub(super) goes_on: bool,
}

impl Mark {
    /// Whether the path has a kink at the entry: a straight line may be continued by another block.
    pub(super) fn is_kink(&self) -> bool {
        self.jump > STRAIGHT
    }

    /// Point of entry.
    pub(super) fn point(&self) -> &AxisVec {
        self.inside.as_ref().unwrap_or_else(|| self.queued.block.path.start())
    }
}

/// Blocks already within reach, then those of the plan, and their contour.
#[derive(Debug, Default)]
pub(crate) struct Marks {
    pub(super) list: Vec<Mark>,
    pub(super) contour: Contour,
}

impl Marks {
    /// Turns the marks of an earlier plan of the same search, if there is one, into those of another.
    pub(super) fn follow(&mut self, trial: &Trial<'_>) {
        let now = trial.now as f64;
        let reach = f64::from(trial.kernels.length());
        let mut count = 0;
        for passed in trial.past.between(now - reach - BORDER_CYCLES - 1.0, f64::INFINITY) {
            self.enter(count, trial, (passed.cycles, passed.s_mm, &passed.queued), None);
            count += 1;
        }
        let past = count;
        for entry in trial.plan {
            for at in entry.entries(trial.cycle) {
                self.enter(count, trial, at, Some(count - past));
                count += 1;
            }
        }
        self.list.truncate(count);
        self.contour.truncate(count);
    }

    /// Sets mark `i` to an entry, given by its time in cycles and path length in mm.
    fn enter(
        &mut self,
        i: usize,
        trial: &Trial<'_>,
        (cycles, s_mm, queued): (f64, f64, &Arc<Queued>),
        block: Option<usize>,
    ) {
        // the remainder of a block continues without a corner
        let start = s_mm - queued.offset;
        let before = i.checked_sub(1).map(|before| &self.list[before]);
        let goes_on =
            before.is_some_and(|m| (m.s_mm - m.queued.offset - start).abs() < SAME_START_MM);
        let same = |m: &&mut Mark| {
            Arc::ptr_eq(&m.queued, queued) && m.block == block && m.goes_on == goes_on
        };
        if let Some(known) = self.list.get_mut(i).filter(same) {
            (known.cycles, known.s_mm) = (cycles, s_mm);
            self.contour.enter_again(i, cycles, s_mm);
            return;
        }
        self.list.truncate(i);
        self.contour.truncate(i);
        let (mut jump, mut axis) = (0.0, 0);
        if let Some(before) = self.list.last().filter(|_| !goes_on) {
            let (a, b) = (&before.queued.ends.tangent_out, &queued.ends.tangent_in);
            for i in 0..a.len() {
                let du = (b[i] - a[i]).abs();
                if du > jump && trial.kernels.get(i).is_some() {
                    (jump, axis) = (du, i);
                }
            }
        }
        let axis = if jump > 0.0 { axis } else { widest(trial.kernels) };
        let path = &queued.block.path;
        let inside = (queued.offset > 0.0).then(|| {
            let mut point = path.start().clone();
            path.position(queued.offset, &mut point);
            point
        });
        // at the start of the path only a dwell is possible
        let boundary = block.filter(|b| *b > 0 || trial.at_rest);
        let queued = Arc::clone(queued);
        self.contour.enter(cycles, s_mm, Arc::clone(&queued));
        self.list.push(Mark { cycles, boundary, block, queued, s_mm, jump, axis, inside, goes_on });
    }
}

/// Axis with the longest kernel.
fn widest(kernels: &Kernels) -> usize {
    let length = |i: &usize| kernels.get(*i).map_or(0, Kernel::length);
    (0..kernels.axes.len()).max_by_key(length).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cap::SpeedLimit;
    use crate::example::block;
    use crate::profile::Profile;
    use crate::timeline::{Entry, Moment, Timeline};
    use kontur_filters::time::CycleTime;
    use proptest::prelude::*;

    /// A plan of some blocks that begins at `s_mm`: spans of these numbers of blocks at these speeds in mm/s.
    fn plan(blocks: &[Arc<Queued>], mut s_mm: f64, spans: &[(usize, f64)]) -> Vec<Entry> {
        let mut at = Moment::tick(1);
        let mut rest = blocks;
        let mut entries = Vec::new();
        for (count, speed) in spans.iter().cycle() {
            if rest.is_empty() {
                break;
            }
            let (now, later) = rest.split_at((*count).min(rest.len()));
            let length = now.iter().map(|q| q.length).sum();
            let profile = Profile::even(*speed, length);
            let why = (SpeedLimit::Feed, SpeedLimit::Feed);
            let entry = Entry::along(at, s_mm, profile, why, now, later.is_empty());
            (at, s_mm, rest) = (entry.end, s_mm + length, later);
            entries.push(entry);
        }
        entries
    }

    proptest! {
        /// Plans of one search, with other spans and speeds and, once, with other blocks from some place on: the marks
        /// that follow them equal those made anew for each.
        #[test]
        fn marks_of_an_earlier_plan_leave_no_trace(
            chords in prop::collection::vec((1e-3..2.0f64, 0.0..1.5f64), 4..20),
            plans in prop::collection::vec(prop::collection::vec((1..5usize, 1.0..100.0f64), 1..6), 2..6),
            (first, other, at_rest) in (0..3usize, 0..20usize, any::<bool>()),
        ) {
            let cycle = CycleTime::from_us(1000).unwrap();
            let mut at = [0.0, 0.0];
            let mut queue = |chords: &[(f64, f64)]| -> Vec<Arc<Queued>> {
                let blocks = chords.iter().zip(1..).map(|((length, angle), seq)| {
                    let from = at;
                    at = [at[0] + length * libm::cos(*angle), at[1] + length * libm::sin(*angle)];
                    Arc::new(Queued::new(block(seq, from, at, 100.0), cycle))
                });
                blocks.collect()
            };
            let mut blocks = queue(&chords);
            let (mut past, mut s_mm) = (Contour::default(), 0.0);
            for queued in blocks.drain(..first) {
                past.enter(0.0, s_mm, Arc::clone(&queued));
                s_mm += queued.length;
            }
            let kernels = Kernels::new(vec![Some(Arc::new(kontur_filters::kernel::Kernel::delay(3))), None]);
            let timeline = Timeline::default();
            let mut known = Marks::default();
            for (i, spans) in plans.iter().enumerate() {
                if i == 1 {
                    let kept = other.min(blocks.len());
                    let behind = queue(&chords[first + kept..]);
                    blocks.truncate(kept);
                    blocks.extend(behind);
                }
                let plan = plan(&blocks, s_mm, spans);
                let (timeline, past, kernels, plan) = (&timeline, &past, &kernels, &plan[..]);
                let (now, stop) = (0, None);
                let trial = Trial { timeline, plan, past, kernels, cycle, now, at_rest, stop };
                known.follow(&trial);
                let mut anew = Marks::default();
                anew.follow(&trial);
                prop_assert_eq!(format!("{known:?}"), format!("{anew:?}"));
            }
        }
    }
}
