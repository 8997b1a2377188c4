//! The deviation of what is output, cycle by cycle.

use super::{Excursion, SetPath};
use crate::axis::AxisVec;
use crate::contour::{Contour, Sight};

/// Deviation in both directions, cycle by cycle, for the output.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gauge {
    reach: u64,
    /// Whether the filters differ between the axes.
    every: bool,
    set: SetPath,
    path: SetPath,
    found: Excursion,
    sight: Sight,
    /// Number of the last block that has left the filters.
    left: u64,
    /// Last cycle whose set point differed from the interpolated one.
    filtered: Option<u64>,
    /// Shortest vector to the last set point with its length in mm.
    shortest: Option<(f64, AxisVec)>,
}

impl Gauge {
    /// For filters that reach back `reach` cycles; `every`: they differ between the axes.
    pub(crate) fn new(reach: u32, every: bool) -> Self {
        Self { reach: u64::from(reach), every, ..Self::default() }
    }

    /// Forgets known distances, because the contour was replaced.
    pub(crate) fn look_anew(&mut self) {
        self.sight = Sight::default();
    }

    /// Largest components found in the last cycle, per axis.
    pub(crate) fn found(&self) -> &[f64] {
        &self.found.vector
    }

    /// Length in mm and components of the shortest vector from the contour to the last set point, if there is a contour.
    pub(crate) fn shortest(&self) -> Option<(f64, &[f64])> {
        self.shortest.as_ref().map(|(length, vector)| (*length, &**vector))
    }

    /// Processes the set point of a cycle in which the filters change nothing, and finds what was missed of the part of
    /// the contour that has just left the filters: axes that have all arrived may still have cut a corner that the
    /// filters held until now. `least_mm`: see [`Self::step`].
    pub(crate) fn unfiltered(
        &mut self,
        contour: &Contour,
        k: u64,
        point: &[f64],
        least_mm: Option<f64>,
    ) {
        self.shortest = None;
        if self.filtered.is_some_and(|last| k <= last + self.reach + 2) {
            self.enter(k, point, point);
            self.found = Excursion::none(point.len());
            if let Some(least_mm) = least_mm {
                self.let_go(contour, k, least_mm);
            }
        } else {
            self.found.clear();
            self.set.restart(k, point);
            self.path.restart(k, point);
        }
    }

    /// Processes the set point and the interpolated point of cycle `k`. Finds the largest components of the vectors
    /// from the contour to the line that ends at the set point, and of the vectors to the set path from those points of
    /// the contour that have just left the filters; for the least tolerance of the run see [`Self::miss`]. Without such
    /// a tolerance only the shortest vector to the set point is found.
    pub(crate) fn step(
        &mut self,
        contour: &Contour,
        k: u64,
        (set, path): (&[f64], &[f64]),
        least_mm: Option<f64>,
    ) {
        self.enter(k, set, path);
        self.filtered = Some(k);
        self.found = Excursion::none(set.len());
        let (reach, moment) = (self.reach as f64, k as f64);
        let within = (moment - reach, moment);
        if let Some(least_mm) = least_mm {
            self.shortest = self.set.leaves(contour, k, within, &mut self.sight, &mut self.found);
            self.let_go(contour, k, least_mm);
        } else {
            let mut vector = AxisVec::zeros(set.len());
            let length = contour.nearest_in_sight(set, within, &mut self.sight, &mut vector);
            self.shortest = length.map(|length| (length, vector));
        }
    }

    fn enter(&mut self, k: u64, set: &[f64], path: &[f64]) {
        if self.set.end() != k || self.set.axes() != set.len() {
            self.set = SetPath::starting(k, set.len());
            self.path = self.set.clone();
        }
        let old = k.saturating_sub(2 * self.reach + 4);
        for (kept, point) in [(&mut self.set, set), (&mut self.path, path)] {
            kept.push(point);
            kept.forget_before(old);
        }
    }

    /// Finds what was missed of the part of the contour that leaves the filters in cycle `k`.
    fn let_go(&mut self, contour: &Contour, k: u64, least_mm: f64) {
        let passed = k as f64 - self.reach as f64 - 1.0;
        let entered = contour.entered_near(passed, contour.index(self.left).unwrap_or_default());
        self.left = contour.number(entered);
        for (moment, point) in contour.kinks(passed - 1.0, entered) {
            let first = moment.floor().max(0.0) as u64;
            self.miss(contour, k, &point, (first, first + self.reach + 2), least_mm);
        }
        if let Some(first) = k.checked_sub(self.reach + 1)
            && (self.every || contour.is_bent(entered))
            && let Some(point) = self.path.get(first).map(AxisVec::from_slice)
        {
            self.miss(contour, k, &point, (first, k), least_mm);
        }
    }

    /// Adds the vector from a point of the contour to the set path between two cycles: the shortest one or, if that
    /// exceeds the tolerance of the blocks that the filters held, the one with the smallest largest component. Vectors
    /// up to `least_mm`, the least tolerance of the run, do not exceed any.
    fn miss(&mut self, contour: &Contour, k: u64, point: &[f64], among: (u64, u64), least_mm: f64) {
        let mut shortest = Excursion::none(point.len());
        self.set.misses(point, among, f64::INFINITY, &mut shortest);
        let exceeds = shortest.largest() > least_mm
            && loosest(contour, k, self.reach).is_some_and(|(mm, _)| shortest.largest() > mm);
        let least = exceeds.then(|| self.set.reaches(point, among)).flatten();
        self.found.take(&least.unwrap_or(shortest.vector));
    }
}

/// Loosest tolerance in mm of the blocks that filters with this reach held until cycle `k`, with the number of its
/// block; infinite if one of them is not monitored.
pub(crate) fn loosest(contour: &Contour, k: u64, reach: u64) -> Option<(f64, u64)> {
    let (reach, moment) = (reach as f64, k as f64);
    let held = contour.between(moment - 2.0 * reach - 3.0, moment);
    let tolerances = held.map(|passed| {
        let block = &passed.queued.block;
        (block.tolerance.ax_dev_mm.unwrap_or(f64::INFINITY), block.seq)
    });
    tolerances.max_by(|a, b| a.0.total_cmp(&b.0))
}
