//! Measures by how far the set path leaves the contour.

use super::BORDER_CYCLES;
use super::bound::Companion;
use super::harvest::Harvest;
use super::measure::SPACING;
use super::set_points::SetPoints;
use super::view::View;
use super::violation::{Record, Violation, within};
use crate::contour::{Sight, WARY};
use crate::deviation::Unkept;
use crate::deviation::{Excursion, SetPath};

/// Share of the tolerance from which on the length of a vector requires a check of the alternatives to it: below this
/// share, a vector longer by less than `WARY` still keeps the tolerance.
const DOUBT: f64 = 0.94;

/// Result of the measurement of set points.
#[derive(Default)]
pub(super) struct Left {
    /// The worst violation.
    pub(super) worst: Option<Unkept>,
    /// First and last cycle of each run of set points that the bound did not exclude, in order: only there can points
    /// of the contour be missed.
    pub(super) suspects: Vec<(u64, u64)>,
}

impl View<'_> {
    /// Measures the set path in ranges of cycles, given in order, and reports the worst violations, at most one per
    /// half kernel, to `found`.
    pub(super) fn leaving<'v>(
        &'v self,
        among: &[(u64, u64)],
        points: &mut SetPoints<'v>,
        mut found: impl FnMut(&Violation, &Record),
    ) -> Left {
        let mut left = Left::default();
        let n = points.axes();
        let mut companion = Companion::new(&self.marks, &self.contour, n);
        for (from, to) in self.stretches(among) {
            let first = self.first_for((from, to));
            let mut record = Record::of((first, to));
            let mut set = SetPath::of((first, to), n);
            let mut sight = Sight::default();
            let mut harvest = Harvest::new(self, &mut left.worst, &mut found);
            let mut waiting: Vec<(f64, u64)> = Vec::new();
            let suspects =
                self.suspects((from, to), WARY, points, &mut companion, |k, points, apart| {
                    record.push(points.s());
                    set.push(points.set());
                    let Some(apart) = apart.filter(|_| k >= from) else { return };
                    if harvest.is_close(k) {
                        waiting.push((apart, k));
                        return;
                    }
                    self.settle(&mut waiting, &set, &mut sight, &mut harvest, &record);
                    if let Some(v) = self.leaves_at(k, apart, &set, &mut sight) {
                        harvest.take(v, &record);
                    }
                });
            self.settle(&mut waiting, &set, &mut sight, &mut harvest, &record);
            harvest.end(&record);
            left.suspects.extend(suspects.cycles);
        }
        left
    }

    /// Measures the set points that wait, given by the bounds of their distances in mm and their cycles. The one with
    /// the largest bound comes first, because it rules out most of the others.
    fn settle<F: FnMut(&Violation, &Record)>(
        &self,
        waiting: &mut Vec<(f64, u64)>,
        set: &SetPath,
        sight: &mut Sight,
        harvest: &mut Harvest<'_, F>,
        record: &Record,
    ) {
        waiting.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        for (apart, k) in waiting.drain(..) {
            // of the vectors that count as the shortest
            let longest = (1.0 + WARY) * apart;
            if harvest.counts(longest, self.tolerance_at(k))
                && let Some(v) = self.leaves_at(k, apart, set, sight)
            {
                harvest.take(v, record);
            }
        }
    }

    /// Smallest tolerance in mm of the blocks within reach of the filters in cycle `k`.
    fn tolerance_at(&self, k: u64) -> f64 {
        let moment = k as f64;
        self.tolerance(moment - f64::from(self.trial.kernels.length()), moment)
    }

    /// The violation on the segment to the set point of cycle `k`, if there is one. `apart`: the bound of its distance
    /// in mm.
    fn leaves_at(&self, k: u64, apart: f64, set: &SetPath, sight: &mut Sight) -> Option<Violation> {
        let contour = &self.contour;
        let moment = k as f64;
        let within_reach = (moment - f64::from(self.trial.kernels.length()), moment);
        let tolerance_mm = self.tolerance_at(k);
        if tolerance_mm.is_infinite() {
            return None;
        }
        // the shortest vectors keep the tolerance if the bound does, which is close to them where the filters are equal
        let keeps = apart <= within(tolerance_mm) && !self.trial.kernels.differ();
        let slack = (BORDER_CYCLES, BORDER_CYCLES);
        if keeps && contour.is_one_path(within_reach, slack, sight) {
            return None;
        }
        // the components depend on which blocks count as within reach
        let doubt = (BORDER_CYCLES, 10.0 * SPACING * tolerance_mm);
        let doubtful = |sight: &mut Sight| set.doubtful(contour, k, within_reach, doubt, sight);
        let alternatives = keeps.then(|| doubtful(sight));
        if alternatives.is_some_and(|largest| largest <= within(tolerance_mm)) {
            return None;
        }
        let mut out = Excursion::none(set.axes());
        set.leaves(contour, k, within_reach, sight, &mut out);
        let mut deviation_mm = out.largest();
        if out.length > DOUBT * tolerance_mm && deviation_mm <= within(tolerance_mm) {
            deviation_mm = deviation_mm.max(alternatives.unwrap_or_else(|| doubtful(sight)));
        }
        let axis = out.axis();
        let (vector, missed) = (out.vector, None);
        let v = Violation { cycle: k, deviation_mm, tolerance_mm, axis, vector, missed };
        (deviation_mm > within(tolerance_mm)).then_some(v)
    }
}
