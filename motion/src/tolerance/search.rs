//! The cycles of a plan that have to be measured.
//!
//! Set points can leave the contour only while the filters hold kinks or bends of the path, or at any time if the
//! filters of the axes differ. A bound ([`super::bound`]) excludes most of these cycles.

use super::bound::Companion;
use super::ranges::{chunks, joined, within_of};
use super::set_points::SetPoints;
use super::view::View;
use super::violation::{Record, Violation, within};
use crate::deviation::{ALIKE, Unkept};
use crate::timeline::{PathState, Reader};
use std::sync::atomic::Ordering;

/// Relative difference of path increments per cycle up to which the speed counts as constant.
const EVEN: f64 = 1e-7;

/// The candidates to be measured: set points that may leave the contour, and points of the contour that may be missed.
#[derive(Default)]
pub(super) struct Suspects {
    /// First and last cycle of each run of set points.
    pub(super) cycles: Vec<(u64, u64)>,
    ways: Vec<Way>,
}

/// A section of the contour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// Path length in mm at its first point; `to`: at its last point.
    from: f64,
    to: f64,
    /// Cycle of a set point near the first point.
    pub(super) cycle: u64,
}

impl Suspects {
    fn add(&mut self, k: u64, from: f64, to: f64) {
        match self.cycles.last_mut().filter(|last| last.1 + 1 >= k) {
            Some(last) => last.1 = k,
            None => self.cycles.push((k, k)),
        }
        self.ways.push(Way { from: from.min(to), to: from.max(to), cycle: k });
    }

    fn lengthen(&mut self, to: f64) {
        if let Some(last) = self.ways.last_mut() {
            (last.from, last.to) = (last.from.min(to), last.to.max(to));
        }
    }

    /// Merges sections that touch each other.
    fn in_order(&mut self) {
        self.ways.sort_by(|a, b| a.from.total_cmp(&b.from));
        self.ways.dedup_by(|next, way| {
            let touches = next.from <= way.to;
            if touches {
                way.to = way.to.max(next.to);
            }
            touches
        });
    }

    /// The section that contains the point at path length `s`.
    pub(super) fn way_at(&self, s: f64) -> Option<Way> {
        let i = self.ways.partition_point(|way| way.to < s);
        self.ways.get(i).copied().filter(|way| way.from <= s)
    }

    /// Whether any point of the contour between two path lengths belongs to a section.
    pub(super) fn misses(&self, from: f64, to: f64) -> bool {
        let i = self.ways.partition_point(|way| way.to < from);
        self.ways.get(i).is_some_and(|way| way.from <= to)
    }
}

impl View<'_> {
    /// Measures the plan in ranges of cycles, given in order, in both directions: by how far it leaves the contour and,
    /// if it does not, by how far it misses it. The worst violations of each stretch, at most one per half kernel, go
    /// to `found`; returns the worst of all.
    pub(super) fn search<'v>(
        &'v self,
        among: &[(u64, u64)],
        points: &mut SetPoints<'v>,
        mut found: impl FnMut(&Violation, &Record),
    ) -> Option<Unkept> {
        let left = self.leaving(among, points, &mut found);
        left.worst.or_else(|| self.missing(among, points, found))
    }

    /// Measures by how far points of the contour are missed in some cycles; otherwise as [`Self::search`].
    pub(super) fn missing<'v>(
        &'v self,
        among: &[(u64, u64)],
        points: &mut SetPoints<'v>,
        mut found: impl FnMut(&Violation, &Record),
    ) -> Option<Unkept> {
        let reach = u64::from(self.trial.kernels.length());
        let mut worst: Option<Unkept> = None;
        let mut companion = Companion::new(&self.marks, &self.contour, points.axes());
        for stretch in self.stretches(among) {
            let suspects = self.suspects(stretch, ALIKE, points, &mut companion, |_, _, _| ());
            // whether a point is missed is known only after it has left the filters
            let ends = suspects.cycles.iter().map(|(a, b)| (*a, b + reach + 2));
            let held = ends.map(|(a, b)| (a.max(stretch.0), b.min(stretch.1)));
            for (from, to) in joined(held.filter(|(a, b)| a <= b).collect(), reach) {
                self.missed((from, to), &suspects, points, &mut found, &mut worst);
            }
        }
        worst
    }

    /// First cycle of the survey for a range of cycles: points missed from there on are known within the range.
    pub(super) fn first_for(&self, (from, _): (u64, u64)) -> u64 {
        from.saturating_sub(u64::from(self.trial.kernels.length()) + 3)
    }

    /// The cycles to be measured among those given, stretch by stretch, until the host stops the planner.
    pub(super) fn stretches(&self, among: &[(u64, u64)]) -> impl Iterator<Item = (u64, u64)> {
        let stop = self.trial.stop;
        let goes_on = move |_: &(u64, u64)| !stop.is_some_and(|stop| stop.load(Ordering::Relaxed));
        let stretches = self.active(among).into_iter().flat_map(|(from, to)| chunks(from, to));
        stretches.take_while(goes_on)
    }

    /// The cycles, among those given, in which the set path can leave the contour or miss part of it.
    fn active(&self, among: &[(u64, u64)]) -> Vec<(u64, u64)> {
        let reach = u64::from(self.trial.kernels.length());
        let mut reader = Reader::new(self.trial.timeline, self.trial.plan);
        let mut active: Vec<(u64, u64)> = Vec::new();
        let calm = self.calm();
        let (Some(begin), Some(end)) = (among.first(), among.last()) else { return active };
        // what these marks hold is missed before the first of the cycles
        let missed = |k: f64| k + 2.0 * (reach as f64 + 2.0) + 1.0 < begin.0 as f64;
        let first = self.marks.partition_point(|mark| missed(mark.cycles)).saturating_sub(1);
        let last = self.marks.partition_point(|mark| mark.cycles <= end.1 as f64 + 1.0);
        let mut passed = 0;
        for m in first..last {
            let Some(held) = self.held(m) else { continue };
            // missed points are searched for after they have left the filters
            let inside = within_of(among, &mut passed, (held.0, held.1 + reach as f64 + 2.0));
            if calm {
                active.extend(inside);
                continue;
            }
            // on a straight block only where the speed changes
            for (from, to) in inside {
                let mut k = from;
                while k <= to {
                    let until = to.min(k + reach.max(8));
                    let begin = k.saturating_sub(2 * reach + 4);
                    if k <= from || !self.is_steady(m, begin, until, &mut reader) {
                        active.push((k, until));
                    }
                    k = until + 1;
                }
            }
        }
        joined(active, reach)
    }

    /// The parts of a range of cycles that the bound does not exclude, where a vector may be taken for the shortest one
    /// that is longer by a share of at most `wary`. `each` is called for every cycle, if its set point
    /// is a suspect with the bound in mm of its distance.
    pub(super) fn suspects(
        &self,
        (from, to): (u64, u64),
        wary: f64,
        points: &mut SetPoints<'_>,
        companion: &mut Companion<'_>,
        mut each: impl FnMut(u64, &SetPoints<'_>, Option<f64>),
    ) -> Suspects {
        let length = self.trial.kernels.length();
        let reach = f64::from(length);
        let first = self.first_for((from, to));
        companion.jump();
        let mut out = Suspects::default();
        let mut before: Option<[f64; 2]> = None;
        let mut last: Option<u64> = None;
        let mut begin: Option<f64> = None;
        for k in first..=to {
            points.step(k);
            let beside = points.beside();
            let known = beside >= *begin.get_or_insert(points.s());
            let apart = companion.step(points.set(), beside);
            let [older, newer] = before.unwrap_or([beside; 2]);
            before = Some([newer, beside]);
            let moment = k as f64;
            let tolerance = self.tolerance(moment - reach, moment + reach);
            let suspect = (known || k >= from) && (1.0 + wary) * apart > within(tolerance);
            each(k, points, suspect.then_some(apart));
            if suspect {
                out.add(k, older, beside);
                last = Some(k);
            } else if last.is_some_and(|last| last + 1 == k) {
                // the section is extended up to the neighbouring point, which is needed as well
                out.lengthen(beside);
            }
        }
        out.in_order();
        out
    }

    /// Times between which the filters hold the entry of a mark's block, or the block itself if it can leave the
    /// contour; `None` if neither applies.
    fn held(&self, m: usize) -> Option<(f64, f64)> {
        let Self { trial, marks, .. } = self;
        let kernels = trial.kernels;
        let (mark, reach) = (&marks[m], f64::from(kernels.length()));
        let restless = kernels.unequal || kernels.overshoot;
        let lasts = restless || mark.queued.bend > 0.0;
        if !lasts && !mark.is_kink() {
            return None;
        }
        let until = if lasts {
            marks.get(m + 1).map_or_else(|| self.rest(), |next| next.cycles)
        } else {
            mark.cycles
        };
        Some((mark.cycles, until + reach + 2.0))
    }

    /// Whether the kernels are equal and without overshoot: only kinks and bends leave the contour then.
    fn calm(&self) -> bool {
        !self.trial.kernels.unequal && !self.trial.kernels.overshoot
    }

    /// Whether the path moves at constant speed along the straight block of mark `m` in the cycles `first..=last`: the
    /// set points that depend only on these cycles have the same deviation vector. A speed that rises and falls at most
    /// once equals its mean at both ends only if it is constant.
    fn is_steady(&self, m: usize, first: u64, last: u64, reader: &mut Reader<'_>) -> bool {
        let Self { trial, marks, .. } = self;
        let ends = marks.get(m + 1).map_or_else(|| self.rest(), |next| next.cycles);
        let inside = marks[m].cycles <= first as f64 && last as f64 <= ends;
        if !inside || !marks[m].queued.block.path.is_straight() {
            return false;
        }
        let mut state = PathState::at_rest(marks[m].point());
        let [from, to] = [first, last].map(|k| {
            self.state(k, reader, &mut state);
            state.s
        });
        let step = (to - from) / (last - first) as f64;
        let steps = [first, first + (last - first) / 2, last - 1].map(|k| {
            self.state(k, reader, &mut state);
            let s = state.s;
            self.state(k + 1, reader, &mut state);
            state.s - s
        });
        steps.iter().all(|other| (other - step).abs() <= EVEN * step + 1e-9 * trial.cycle.seconds())
    }
}
