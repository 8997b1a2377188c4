//! A first look, for filters many cycles long, at a plan that the search has not finished: a few set points per kernel
//! length, each with the nearest point of the contour.
//!
//! Most plans of a search fail by far, and then their location is enough. What this look misses is found when the last
//! plans are measured.

use super::harvest::Harvest;
use super::view::{Buffer, View};
use super::violation::{Record, Violation, within};
use crate::axis::AxisVec;
use crate::contour::WARY;
use crate::deviation::Unkept;

/// Set points examined per kernel length.
const LOOKS: u32 = 128;

impl View<'_> {
    /// Looks at the plan in ranges of cycles, given in order; otherwise as [`Self::search`].
    pub(super) fn glance(
        &self,
        among: &[(u64, u64)],
        mut found: impl FnMut(&Violation, &Record),
    ) -> Option<Unkept> {
        let Self { trial, contour, .. } = self;
        let length = trial.kernels.length();
        let (reach, every) = (f64::from(length), u64::from((length / LOOKS).max(1)));
        let mut worst: Option<Unkept> = None;
        if every == 1 {
            return worst;
        }
        let mut buffer = Buffer::new(self);
        let n = buffer.set().len();
        let (mut companion, mut vector) = (AxisVec::zeros(n), AxisVec::zeros(n));
        let mut walk = contour.walk();
        for (from, to) in self.stretches(among) {
            let first = from.saturating_sub(u64::from(length) + 1);
            let mut record = Record::of((first, to));
            let mut harvest = Harvest::new(self, &mut worst, &mut found);
            buffer.seek(first);
            for k in first..=to {
                buffer.take(k);
                record.push(buffer.s());
                if k < from || (k - from) % every != 0 {
                    continue;
                }
                let moment = k as f64;
                let tolerance_mm = self.tolerance(moment - reach, moment);
                buffer.filter();
                walk.position(buffer.middle(), &mut companion);
                let aside =
                    buffer.set().iter().zip(companion.iter()).map(|(a, b)| (a - b) * (a - b));
                if tolerance_mm.is_infinite()
                    || (1.0 + WARY) * aside.sum::<f64>().sqrt() <= within(tolerance_mm)
                {
                    continue;
                }
                contour.nearest(buffer.set(), moment - reach, moment, &mut vector);
                let largest = |i: &usize, j: &usize| vector[*i].abs().total_cmp(&vector[*j].abs());
                let Some(axis) = (0..n).max_by(largest) else { continue };
                let deviation_mm = vector[axis].abs();
                if deviation_mm > within(tolerance_mm) {
                    let (cycle, vector, missed) = (k, vector.clone(), None);
                    let v = Violation { cycle, deviation_mm, tolerance_mm, axis, vector, missed };
                    harvest.take(v, &record);
                }
            }
            harvest.end(&record);
        }
        worst
    }
}
