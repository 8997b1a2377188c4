//! The examination of a plan: changes are measured, and excesses answered.

use super::answered::{Answered, Exceeded};
use super::demands::Demands;
use super::findings::Findings;
use super::foresee::{foresee, foresees};
use super::leaves::Left;
use super::marks::Marks;
use super::places::Places;
use super::ranges::joined;
use super::set_points::SetPoints;
use super::view::View;
use super::violation::{Record, Violation};
use super::{BORDER_CYCLES, Monitor, Trial, Verdict};
use crate::deviation::Unkept;
use crate::queue::Queued;
use crate::timeline::{Entry, Seen};
use std::sync::Arc;

/// Rounds of planning after which an examination no longer ends with the first kind of excess: the answers to the two
/// kinds cause each other.
const ROUNDS_OF_PATIENCE: usize = 24;
/// Rounds of planning after which the causes of an excess get a stop and a dwell as long as the kernel.
const ROUNDS_OF_SPEED: usize = 64;
/// Additional rounds per block.
const ROUNDS_PER_BLOCK: usize = 2;
/// Rounds of planning after which the tolerance is given up with a message.
const ROUNDS: usize = 96;

impl Monitor {
    /// Examines a plan, and tightens the demands if it does not keep the tolerance.
    ///
    /// Cheap checks come first, and an excess is answered before the rest is measured. In a plan that has been examined
    /// before, only the changes are measured; last of all, what has moved in time by a fraction of a cycle, because its
    /// set points are then elsewhere. Returns what is now known of every entry. `marks` are those of the last plan of
    /// the search, and become those of this one.
    pub(crate) fn examine(
        &self,
        trial: &Trial<'_>,
        round: usize,
        demands: &mut Demands,
        marks: &mut Marks,
    ) -> (Verdict, Vec<Seen>) {
        let view = View::new(trial, self, std::mem::take(marks));
        let answer = view.answer(round, demands);
        *marks = view.into_marks();
        answer
    }
}

impl View<'_> {
    /// See [`Monitor::examine`].
    fn answer(&self, round: usize, demands: &mut Demands) -> (Verdict, Vec<Seen>) {
        let (view, trial) = (self, self.trial);
        let blocks = demands.feed.len();
        // even speeds and divided blocks come first; without bends there is nothing to divide, and blame is not needed
        // for it
        if round == 0 && !trial.bends() && foresees(trial.kernels) {
            let found = view.examine(round, &Places::default(), |_, _| ());
            if found.worst.is_none() {
                return (Verdict::Kept, found.seen(trial));
            }
            if trial.foresee(demands) {
                demands.answered = Some(found.answered(trial));
                return (Verdict::Tightened, found.seen(trial));
            }
        }
        let mut findings = Findings::none(blocks);
        // after many rounds everything within reach counts as a cause
        let all = round >= ROUNDS_OF_SPEED + ROUNDS_PER_BLOCK * blocks;
        let mut places = Places::default();
        let found = view.examine(round, &demands.places, |v, record| {
            places.add(v, record, trial.kernels.length());
            view.blame(v, record, all, demands, &mut findings);
        });
        let seen = found.seen(trial);
        let only = found.depth == Depth::Again;
        demands.places.follow(places.take(), only);
        let Some(worst) = found.worst else {
            return (Verdict::Kept, seen);
        };
        let parts = view.parts(&findings);
        if !parts.is_empty() {
            return (Verdict::Divided(parts), seen);
        }
        // an answer at one corner can require another one at the next
        if round >= ROUNDS + ROUNDS_PER_BLOCK * blocks {
            return (Verdict::GivenUp(worst), seen);
        }
        if round == 0 && trial.foresee(demands) {
            demands.answered = Some(found.answered(trial));
        } else {
            view.tighten(&findings, all, demands);
        }
        (if only { Verdict::Again } else { Verdict::Tightened }, seen)
    }
}

/// The last step that an examination has reached; the steps before it found the tolerance kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Depth {
    /// Where the last plan exceeded the tolerance.
    Again,
    /// A first look at the changes.
    Glance,
    /// How far the changed set path leaves the contour.
    Leaves,
    /// How far it misses the contour.
    Misses,
    /// Both, where only the times have changed.
    Moved,
}

/// The excesses of a plan.
struct Found {
    worst: Option<Unkept>,
    /// The violations: at most one of each kind per half kernel.
    exceeded: Vec<Exceeded>,
    /// Runs of set points that the bound does not exclude.
    suspects: Vec<(u64, u64)>,
    depth: Depth,
}

impl Found {
    /// The plan with its excesses.
    fn answered(&self, trial: &Trial<'_>) -> Answered {
        Answered::new(self.exceeded.iter(), trial.plan, trial.cycle)
    }

    /// What is known of every entry of the plan.
    fn seen(&self, trial: &Trial<'_>) -> Vec<Seen> {
        let length = f64::from(trial.kernels.length());
        let beside = 0.5 * length + BORDER_CYCLES + 3.0;
        let seen = trial.plan.iter().map(|e| {
            let [from, to] = [e.start, e.end].map(|m| m.cycles(trial.cycle));
            let near = |at: &Exceeded| {
                let (before, behind) = if at.missed {
                    (2.0 * length + 4.0, 2.0 * length + 4.0)
                } else {
                    (beside, length + beside)
                };
                (from - before..=to + behind).contains(&(at.cycle as f64))
            };
            if self.exceeded.iter().any(near) {
                return Seen::Nothing;
            }
            match (self.depth, e.seen) {
                (Depth::Glance, Seen::Nothing) => Seen::Glanced,
                (Depth::Leaves, Seen::Nothing | Seen::Glanced) => {
                    let owes = trial.owes(e, &self.suspects);
                    if owes { Seen::Stays(e.start) } else { Seen::Kept(e.start) }
                }
                (Depth::Misses, Seen::Nothing | Seen::Glanced) | (Depth::Moved, _) => {
                    Seen::Kept(e.start)
                }
                // the first direction was measured at another time
                (Depth::Misses, Seen::Stays(at)) => Seen::Kept(at),
                (_, seen) => seen,
            }
        });
        seen.collect()
    }
}

impl View<'_> {
    /// Measures the plan where the last one exceeded the tolerance, looks at the changes since the last examination,
    /// measures them in both directions, and then what has moved in
    /// time; an excess usually ends it.
    fn examine(
        &self,
        round: usize,
        places: &Places,
        mut found: impl FnMut(&Violation, &Record),
    ) -> Found {
        let mut exceeded = Vec::new();
        let mut found = |v: &Violation, record: &Record| {
            exceeded.push(Exceeded::of(v));
            found(v, record);
        };
        let trial = self.trial;
        let is_new = |e: &Entry| matches!(e.seen, Seen::Nothing | Seen::Glanced);
        let patient = round < ROUNDS_OF_PATIENCE;
        let mut points = SetPoints::new(self);
        let mut depth = Depth::Again;
        let mut suspects = Vec::new();
        let mut worst = self.search_again(places, is_new, &mut points, &mut found);
        if worst.is_some() {
            return Found { worst, exceeded, suspects, depth };
        }
        depth = Depth::Glance;
        if patient {
            worst = self.glance(&trial.shown_by(|e| e.seen == Seen::Nothing), &mut found);
        }
        if worst.is_none() {
            depth = Depth::Leaves;
            Left { worst, suspects } =
                self.leaving(&trial.shown_by(is_new), &mut points, &mut found);
        }
        if worst.is_none() || !patient {
            depth = Depth::Misses;
            let changed = trial.missed_by(|e| match e.seen {
                Seen::Nothing | Seen::Glanced => trial.owes(e, &suspects),
                Seen::Stays(_) => true,
                Seen::Kept(_) => false,
            });
            let both =
                [worst, self.missing(&changed, &mut points, &mut found)].into_iter().flatten();
            worst = both.max_by(|a, b| a.deviation_mm.total_cmp(&b.deviation_mm));
        }
        if worst.is_none() {
            let is_moved = |e: &Entry| match e.seen {
                Seen::Stays(at) | Seen::Kept(at) => !at.is_whole_cycles_from(e.start),
                Seen::Nothing | Seen::Glanced => false,
            };
            let left = self.leaving(&trial.shown_by(is_moved), &mut points, &mut found);
            worst = left.worst;
            // where one of them leaves the contour, the points missed by the others have not been measured at their new
            // times
            if worst.is_none() {
                depth = Depth::Moved;
                let moved = trial.missed_by(|e| is_moved(e) && trial.owes(e, &left.suspects));
                worst = self.missing(&moved, &mut points, &mut found);
            }
        }
        Found { worst, exceeded, suspects, depth }
    }
}

impl Trial<'_> {
    /// Whether a block of the plan is bent.
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

    /// Future cycles whose set points depend on some entries.
    pub(super) fn shown_by(&self, which: impl Fn(&Entry) -> bool) -> Vec<(u64, u64)> {
        self.reached_by(f64::from(self.kernels.length()) + BORDER_CYCLES + 3.0, which)
    }

    /// Future cycles in which the points missed by set points that depend on some entries become known.
    fn missed_by(&self, which: impl Fn(&Entry) -> bool) -> Vec<(u64, u64)> {
        self.reached_by(2.0 * f64::from(self.kernels.length()) + 5.0, which)
    }

    /// Whether a point of the contour that the filters hold together with an entry can be missed: a run of suspects
    /// lies within reach.
    fn owes(&self, entry: &Entry, suspects: &[(u64, u64)]) -> bool {
        let reach = f64::from(self.kernels.length()) + BORDER_CYCLES + 1.0;
        let [from, to] = [entry.start, entry.end].map(|m| m.cycles(self.cycle));
        let first = suspects.partition_point(|row| (row.1 as f64) < from - reach);
        suspects.get(first).is_some_and(|row| row.0 as f64 <= to + 2.0 * reach)
    }

    fn reached_by(&self, reach: f64, which: impl Fn(&Entry) -> bool) -> Vec<(u64, u64)> {
        let entries = self.timeline.entries().chain(self.plan).filter(|e| which(e));
        let cycles = entries.map(|e| {
            let [from, to] = [e.start, e.end].map(|m| m.cycles(self.cycle));
            ((from - 3.0).max(0.0) as u64, (to + reach).ceil() as u64)
        });
        let ahead = cycles.map(|(from, to)| (from.max(self.now + 1), to));
        joined(ahead.filter(|(from, to)| from <= to).collect(), 0)
    }
}
