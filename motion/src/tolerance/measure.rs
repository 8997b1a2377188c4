//! Measures by how far the set path misses points of the contour.

use super::foot::{Foot, certain};
use super::harvest::Harvest;
use super::search::Suspects;
use super::set_points::SetPoints;
use super::view::View;
use super::violation::{Record, Violation, within};
use crate::axis::AxisVec;
use crate::contour::Walk;
use crate::deviation::{Excursion, SetPath, Unkept};
use smallvec::{SmallVec, smallvec};

/// Cycles around the set point nearest to one point of the contour within which that of the next point is searched for.
const HINT: u64 = 3;
/// Halvings of a piece of the contour in the search for the point missed most: from the path of one cycle down to
/// rounding.
const HALVINGS: u32 = 24;
/// Maximum number of points of the contour examined per cycle.
const PARTS: f64 = 4.0;
/// Distance between the points examined, in tolerances.
pub(super) const SPACING: f64 = 0.02;

impl View<'_> {
    /// Reports to `found` what is missed of the contour among the suspects and becomes known in the cycles `from..=to`,
    /// at most the worst per half kernel, and updates the worst of all.
    pub(super) fn missed(
        &self,
        (from, to): (u64, u64),
        suspects: &Suspects,
        points: &mut SetPoints<'_>,
        found: &mut impl FnMut(&Violation, &Record),
        worst: &mut Option<Unkept>,
    ) {
        let length = u64::from(self.trial.kernels.length());
        let first = from.saturating_sub(2 * length + 4);
        let reach = length as f64;
        let mut search = Search {
            view: self,
            suspects,
            length,
            first,
            record: Record::of((first, to)),
            set: SetPath::of((first, to), points.axes()),
            harvest: Harvest::new(self, worst, found),
            walk: self.contour.walk(),
            mark: self.marks.partition_point(|m| m.cycles < from as f64 - reach - 2.0),
            looked: None,
            last: None,
            hint: from,
        };
        for k in first..=to {
            points.step(k);
            search.record.push(points.s());
            search.set.push(points.set());
            if k >= from {
                search.kinks(k);
                search.stretch(k);
            }
        }
        search.harvest.end(&search.record);
    }

    /// Largest `|q''|` of an axis in 1/mm between two path lengths.
    fn bend_between(&self, from: f64, to: f64) -> f64 {
        let first = self.marks.partition_point(|m| m.s_mm <= from).max(1) - 1;
        let inside = self.marks[first..].iter().take_while(|m| m.s_mm <= to);
        inside.map(|m| m.queued.bend_between(from - m.s_mm, to - m.s_mm)).fold(0.0, f64::max)
    }

    /// Smallest tolerance in mm of the blocks interpolated between two times.
    pub(super) fn tolerance(&self, from: f64, to: f64) -> f64 {
        if let Some(tolerance) = self.tolerance_mm {
            return tolerance;
        }
        let bounds =
            self.contour.between(from, to).filter_map(|p| p.queued.block.tolerance.ax_dev_mm);
        bounds.fold(f64::INFINITY, f64::min)
    }

    /// Component in the direction `toward` of the change of direction at the entry of a mark's block.
    pub(super) fn turn(&self, m: usize, toward: &[f64]) -> f64 {
        let Some(before) = m.checked_sub(1).map(|b| &self.marks[b]) else { return 0.0 };
        if self.marks[m].goes_on {
            return 0.0;
        }
        let [out, into] = [&before.queued.ends.tangent_out, &self.marks[m].queued.ends.tangent_in];
        toward.iter().zip(into.iter().zip(out.iter())).map(|(u, (b, a))| u * (b - a)).sum()
    }
}

/// A point of the contour, by its path length, and the time in cycles at which it is passed.
struct Place {
    of: AxisVec,
    s: f64,
    moment: f64,
}

/// The search along the contour, cycle by cycle.
struct Search<'s, F> {
    view: &'s View<'s>,
    suspects: &'s Suspects,
    /// Length of the longest kernel in cycles.
    length: u64,
    /// The cycle of the first set point.
    first: u64,
    record: Record,
    set: SetPath,
    harvest: Harvest<'s, F>,
    walk: Walk<'s>,
    /// The first mark that the filters may still hold.
    mark: usize,
    /// Path length up to which the points between the kinks have been examined.
    looked: Option<f64>,
    /// The last one of them, if the next one follows it.
    last: Option<Foot>,
    /// A cycle near that of its nearest set point.
    hint: u64,
}

impl<F: FnMut(&Violation, &Record)> Search<'_, F> {
    /// Examines the kinks that the filters no longer hold in cycle `k`.
    fn kinks(&mut self, k: u64) {
        let (view, reach) = (self.view, self.length as f64);
        while let Some(mark) =
            view.marks.get(self.mark).filter(|m| m.cycles + reach + 1.0 <= k as f64)
        {
            if self.mark > 0 && mark.is_kink() && self.suspects.way_at(mark.s_mm).is_some() {
                let place = Place { of: mark.point().clone(), s: mark.s_mm, moment: mark.cycles };
                self.look(place, self.held(mark.cycles), None);
            }
            self.mark += 1;
        }
    }

    /// Examines the other points that the filters no longer hold in cycle `k`, at the spacing that matters.
    fn stretch(&mut self, k: u64) {
        let passed = k.saturating_sub(self.length + 1);
        if passed <= self.first {
            return;
        }
        let tolerance = self.view.tolerance(passed as f64, k as f64);
        // on a slow path not in every cycle, but from where the last one was examined
        let from = self.looked.unwrap_or_else(|| self.record.s(passed - 1));
        let to = self.record.s(passed);
        self.looked = Some(from);
        if to - from < SPACING * tolerance && tolerance.is_finite() {
            return;
        }
        self.looked = Some(to);
        if !self.suspects.misses(from, to) {
            self.last = None;
            return;
        }
        for s in self.places((from, to), tolerance) {
            self.follow(s, passed, tolerance);
        }
    }

    /// Path lengths of the points to be examined between two others.
    fn places(&self, (from, to): (f64, f64), tolerance: f64) -> SmallVec<[f64; 8]> {
        let marks = &self.view.marks;
        let parts = ((to - from) / (10.0 * SPACING * tolerance)).ceil().clamp(1.0, PARTS) as u32;
        let even = (1..=parts).map(|i| from + f64::from(i) / f64::from(parts) * (to - from));
        // the contour is not straight at a kink
        let first_mark = marks.partition_point(|m| m.s_mm <= from);
        let ahead = marks[first_mark..].iter().take_while(|m| m.s_mm < to);
        let kinks = ahead.filter(|m| m.is_kink() || m.queued.bend > 0.0).map(|m| m.s_mm);
        let mut places: SmallVec<[f64; 8]> = even.chain(kinks).collect();
        places.sort_by(f64::total_cmp);
        places
    }

    /// Examines the point at a path length, passed in cycle `passed` at the latest, and what lies between it and the last one.
    fn follow(&mut self, s: f64, passed: u64, tolerance: f64) {
        let before = self.last.take();
        let Some(way) = self.suspects.way_at(s) else { return };
        let (place, held) = self.place(s, passed);
        // the nearest set point is close to the last one found
        let hint = before.as_ref().map_or(way.cycle, |_| self.hint).max(held);
        let near = (hint.saturating_sub(HINT).max(held), hint + HINT);
        let foot = self.look(place, near, before.as_ref());
        self.hint = foot.as_ref().map_or(near.0, |foot| foot.cycle);
        self.last.clone_from(&foot);
        if let (Some(low), Some(high)) = (before, foot) {
            self.refine((low, high), passed, tolerance);
        }
    }

    /// Halves the contour between two points as long as more can be missed there.
    fn refine(&mut self, (low, high): (Foot, Foot), passed: u64, tolerance: f64) {
        let bend = self.view.bend_between(low.s, high.s);
        let mut open: SmallVec<[(Foot, Foot, u32); 4]> = smallvec![(low, high, HALVINGS)];
        while let Some((mut low, mut high, halvings)) = open.pop() {
            // next to a point that may be missed, the nearest part of the set path may be another one
            if low.length.max(high.length) > certain(tolerance) {
                self.widen(&mut low, passed);
                self.widen(&mut high, passed);
            }
            if halvings == 0 || !low.may_hide_more(&high, &self.set, bend, tolerance) {
                continue;
            }
            let (place, held) = self.place(0.5 * (low.s + high.s), passed);
            let (first, last) = (low.cycle.min(high.cycle), low.cycle.max(high.cycle));
            let near = (first.saturating_sub(HINT).max(held), last + HINT);
            let Some(foot) = self.look(place, near, Some(&low)) else { break };
            open.push((foot.clone(), high, halvings - 1));
            open.push((low, foot, halvings - 1));
        }
    }

    /// Searches all cycles for the nearest set point of a point for which only some were searched.
    fn widen(&mut self, foot: &mut Foot, passed: u64) {
        if !foot.is_local {
            return;
        }
        let moment = self.record.leaves(foot.s).min(passed) as f64;
        let place = Place { of: foot.of.clone(), s: foot.s, moment };
        if let Some(other) = self.look(place, self.held(moment), Some(foot)) {
            *foot = other;
        }
    }

    /// The point at a path length, and the cycle in which it is passed.
    fn place(&mut self, s: f64, passed: u64) -> (Place, u64) {
        let mut of = AxisVec::zeros(self.set.axes());
        self.walk.position(s, &mut of);
        let held = self.record.leaves(s).min(passed);
        (Place { of, s, moment: held as f64 }, held)
    }

    /// The cycles in which the filters may hold a point that is passed at some time.
    fn held(&self, moment: f64) -> (u64, u64) {
        let first = moment.floor().max(0.0) as u64;
        (first, first + self.length + 2)
    }

    /// Finds the set point nearest to a point among the cycles `near`, and among all in which the filters may hold it if those are not
    /// certain to be enough; reports a violation. A neighbouring point, `by`, leads to it.
    fn look(&mut self, place: Place, near: (u64, u64), by: Option<&Foot>) -> Option<Foot> {
        let Place { of, s, moment } = place;
        let n = of.len();
        let tolerance_mm = self.view.tolerance(moment, moment + self.length as f64);
        let wary_mm = certain(tolerance_mm);
        let all = self.held(moment);
        let hint = by.map(|foot| foot.cycle);
        let mut out = Excursion::none(n);
        let excluded = by.is_some_and(|foot| foot.excludes(&of, near, wary_mm));
        let mut nearest = None;
        if near == all || !excluded {
            nearest = self.set.misses(&of, near, hint, wary_mm, &mut out);
        }
        let is_local = near != all && !excluded && out.length <= wary_mm;
        if near != all && !is_local {
            out = Excursion::none(n);
            nearest = self.set.misses(&of, all, hint, wary_mm, &mut out);
        }
        let (cycle, vector) = nearest?;
        let deviation_mm = out.largest();
        if deviation_mm > within(tolerance_mm) {
            let (axis, vector) = (out.axis(), out.vector.clone());
            let missed = Some((of.clone(), s));
            let v = Violation { cycle, deviation_mm, tolerance_mm, axis, vector, missed };
            self.harvest.take(v, &self.record);
        }
        let point = of.iter().zip(vector.iter()).map(|(p, v)| p + v).collect();
        let among = if is_local { near } else { all };
        let among = (among.0, among.1.min(self.set.end() - 1));
        Some(Foot { s, of, cycle, length: out.length, deviation_mm, point, among, is_local })
    }
}
