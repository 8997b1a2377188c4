//! The examination of a plan: what has changed is measured, and what exceeds is answered.

use super::blame::Findings;
use super::demands::Demands;
use super::even::{foresee, foresees};
use super::measure::{Record, Violation};
use super::search::joined;
use super::view::View;
use super::{Monitor, Trial, Unkept, Verdict};
use crate::queue::Queued;
use crate::timeline::{Entry, Moment};
use std::sync::Arc;

/// Rounds of planning after which the causes of an excess stop and dwell for the whole kernel.
const ROUNDS_OF_SPEED: usize = 64;
/// Rounds more for every block.
const ROUNDS_PER_BLOCK: usize = 2;
/// Rounds of planning after which the tolerance is given up with a message.
const ROUNDS: usize = 96;
impl Monitor {
    /// Examines a plan, and tightens the demands if it does not keep the tolerance.
    ///
    /// Of a plan that has been examined before only what has changed is measured, and last of all, if that keeps the
    /// tolerance, what has moved in time: the set points lie elsewhere then. Returns for every entry where it was measured,
    /// see [`Entry::kept`].
    pub(crate) fn examine(
        &self,
        trial: &Trial<'_>,
        round: usize,
        demands: &mut Demands,
    ) -> (Verdict, Vec<Option<Moment>>) {
        let view = View::new(trial, self);
        let blocks = demands.feed.len();
        // even speeds and parts of blocks are asked for first; where there are no bends to divide, nobody is to blame for that
        if round == 0 && !trial.bends() && foresees(trial.kernels) {
            let found = view.examine(|_, _| ());
            if found.worst.is_none() {
                return (Verdict::Kept, found.kept(trial));
            }
            if trial.foresee(demands) {
                return (Verdict::Tightened, found.kept(trial));
            }
        }
        let mut findings = Findings::none(blocks);
        // after many rounds everything in reach counts as a cause
        let all = round >= ROUNDS_OF_SPEED + ROUNDS_PER_BLOCK * blocks;
        let found = view.examine(|v, record| view.blame(v, record, all, demands, &mut findings));
        let kept = found.kept(trial);
        let Some(worst) = found.worst else {
            return (Verdict::Kept, kept);
        };
        let parts = view.parts(&findings);
        if !parts.is_empty() {
            return (Verdict::Divided(parts), kept);
        }
        // an answer at one corner can make another one necessary at the next
        if round >= ROUNDS + ROUNDS_PER_BLOCK * blocks {
            return (Verdict::GivenUp(worst), kept);
        }
        if round > 0 || !trial.foresee(demands) {
            view.tighten(&findings, (round, all), demands);
        }
        (Verdict::Tightened, kept)
    }
}

/// What of a plan exceeds the tolerance.
struct Found {
    worst: Option<Unkept>,
    /// Cycles of the violations.
    exceeded: Vec<u64>,
    /// What has changed keeps the tolerance, and what has moved was measured, too.
    calm: bool,
}

impl Found {
    /// For every entry of the plan where it has been found to keep the tolerance, see [`Entry::kept`].
    fn kept(&self, trial: &Trial<'_>) -> Vec<Option<Moment>> {
        let reach = 2.0 * f64::from(trial.kernels.length()) + 4.0;
        let kept = trial.plan.iter().map(|e| {
            let [from, to] = [e.start, e.end].map(|m| m.cycles(trial.cycle));
            let near = |k: &u64| (from - reach..=to + reach).contains(&(*k as f64));
            if self.exceeded.iter().any(near) {
                None
            } else if self.calm || e.kept.is_none() {
                Some(e.start)
            } else {
                e.kept
            }
        });
        kept.collect()
    }
}

impl View<'_> {
    /// Measures what has changed since the last examination, then, if that keeps the tolerance, what has moved in time.
    fn examine(&self, mut found: impl FnMut(&Violation, &Record)) -> Found {
        let mut exceeded: Vec<u64> = Vec::new();
        let mut found = |v: &Violation, record: &Record| {
            exceeded.push(v.cycle);
            found(v, record);
        };
        let changed = self.trial.reached_by(|e| e.kept.is_none());
        let worst = self.search(&changed, &mut found);
        let calm = worst.is_none();
        let worst = worst.or_else(|| {
            let moved = self.trial.reached_by(|e| e.kept.is_some_and(|at| at != e.start));
            self.search(&moved, &mut found)
        });
        Found { worst, exceeded, calm }
    }
}

impl Trial<'_> {
    /// True if a block of the plan is bent.
    fn bends(&self) -> bool {
        self.plan.iter().flat_map(|e| &e.blocks).any(|(queued, _)| queued.bend > 0.0)
    }

    /// See [`foresee`].
    fn foresee(&self, demands: &mut Demands) -> bool {
        let blocks = self.plan.iter().flat_map(|e| &e.blocks);
        let window: Vec<Arc<Queued>> = blocks.map(|(queued, _)| Arc::clone(queued)).collect();
        let start = self.plan.first().map_or(0.0, |e| e.s0);
        foresee(demands, &window, self.past, start, (self.kernels, self.cycle))
    }

    /// Cycles still to come whose set points, or what they miss, depend on some entries.
    fn reached_by(&self, which: impl Fn(&Entry) -> bool) -> Vec<(u64, u64)> {
        let reach = 2.0 * f64::from(self.kernels.length()) + 5.0;
        let entries = self.timeline.entries().chain(self.plan).filter(|e| which(e));
        let cycles = entries.map(|e| {
            let [from, to] = [e.start, e.end].map(|m| m.cycles(self.cycle));
            ((from - 3.0).max(0.0) as u64, (to + reach).ceil() as u64)
        });
        let ahead = cycles.map(|(from, to)| (from.max(self.now + 1), to));
        joined(ahead.filter(|(from, to)| from <= to).collect(), 0)
    }
}
