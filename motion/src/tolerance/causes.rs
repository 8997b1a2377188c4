//! A violation, the blocks that can cause it, and their parts in the deviation.

use super::demands::Demands;
use super::marks::Mark;
use super::view::View;
use super::violation::{Record, Violation};
use crate::axis::AxisVec;

/// Number of points at which a bend is evaluated.
const BEND_POINTS: u32 = 6;

/// A violation with the marks that can cause it: the first one, and the one after the last.
pub(super) struct Case<'c> {
    pub(super) v: &'c Violation,
    pub(super) record: &'c Record,
    pub(super) demands: &'c Demands,
    pub(super) first: usize,
    pub(super) last: usize,
}

/// A kink or a bent block within reach.
pub(super) struct Part {
    pub(super) mark: usize,
    pub(super) bend: bool,
    /// Contribution to the deviation in mm.
    pub(super) size: f64,
    /// Path length.
    pub(super) s: f64,
}

impl View<'_> {
    /// Oldest cycle whose path length can matter. A point of the segment between two set points: for the first of them, the filters
    /// reach one cycle further back.
    pub(super) fn oldest(&self, v: &Violation) -> u64 {
        v.cycle.saturating_sub(u64::from(self.trial.kernels.length()) + 1)
    }

    /// The violation with the marks that can cause it, if there are any.
    pub(super) fn case<'c>(
        &self,
        v: &'c Violation,
        record: &'c Record,
        demands: &'c Demands,
    ) -> Option<Case<'c>> {
        let marks = &self.marks;
        let until = |k: u64| marks.partition_point(|m| m.cycles <= k as f64);
        let first = until(self.oldest(v)).saturating_sub(1);
        // the set path turns off after its point nearest to the missed one
        let mut last = until(v.cycle + u64::from(v.missed.is_some()));
        // the nearest point may be final, but while the filters hold the missed point the set path can still come
        // closer
        let is_final = |m: &Mark| m.boundary.is_none() && m.block.is_none();
        if let Some((_, s)) = &v.missed
            && marks[..last].iter().all(is_final)
        {
            last = until(record.leaves(*s) + u64::from(self.trial.kernels.length()) + 1);
        }
        (first < last).then_some(Case { v, record, demands, first, last })
    }

    /// Whether the cause of a part can still be changed.
    pub(super) fn is_free(&self, p: &Part, demands: &Demands) -> bool {
        let (m, length) = (&self.marks[p.mark], self.trial.kernels.length());
        if p.bend {
            return m.block.is_some();
        }
        m.boundary.is_some_and(|b| demands.stop[b].is_none_or(|dwell| dwell < length))
    }

    /// The parts in a violation, some of them in its direction if any of them can be changed.
    pub(super) fn causes(&self, case: &Case<'_>) -> Vec<Part> {
        let v = case.v;
        let is_free = |p: &Part| self.is_free(p, case.demands);
        let counts = |p: &Part| is_free(p) && p.size > 0.0;
        let mut parts = self.parts_of(case, &[v.cycle]);
        // the filters hold the set point on one side of a corner, and the segment to it comes from the other side
        if !parts.iter().any(counts) {
            parts = self.parts_of(case, &[v.cycle.saturating_sub(1), v.cycle]);
        }
        // far from the contour, the nearest point is not the middle of what the filters hold; then no part, or not even
        // the sum of all parts, may point in the direction of the deviation
        if !parts.iter().any(counts) || parts.iter().map(|p| p.size).sum::<f64>() <= 0.0 {
            for part in &mut parts {
                part.size = part.size.abs();
            }
        }
        // a corner missed because the dwell there was too short: the filters hold nothing beyond it yet
        if let Some((_, missed)) = &v.missed
            && !parts.iter().any(counts)
        {
            let away = |p: &&mut Part| (p.s - missed).abs();
            let kinks = parts.iter_mut().filter(|p| is_free(p) && !p.bend);
            if let Some(part) = kinks.min_by(|a, b| away(a).total_cmp(&away(b))) {
                part.size = v.deviation_mm;
            }
        }
        parts
    }

    /// Parts in a deviation, positive in its direction, in the order of the path: for the set point of a cycle, or for
    /// the middle of the segment between two.
    fn parts_of(&self, case: &Case<'_>, cycles: &[u64]) -> Vec<Part> {
        let Self { trial, marks, .. } = self;
        let Case { v, record, first, last, .. } = *case;
        let Some(kernel) = trial.kernels.get(v.axis).or_else(|| trial.kernels.longest()) else {
            return Vec::new();
        };
        let at = |delay: u32| record.s(v.cycle.saturating_sub(u64::from(delay)));
        let mean = |weighed: &dyn Fn(f64, f64) -> f64| -> f64 {
            let of = |cycle: &u64| -> f64 {
                let held = |delay: u32| record.s(cycle.saturating_sub(u64::from(delay)));
                kernel.taps().iter().map(|t| weighed(t.weight, held(t.delay))).sum()
            };
            cycles.iter().map(of).sum::<f64>() / cycles.len() as f64
        };
        let middle = mean(&|weight, s| weight * s);
        let weight = |s: f64| {
            mean(&|weight, held| {
                let d = held - s;
                weight.abs() * if s >= middle { d.max(0.0) } else { (-d).max(0.0) }
            })
        };
        let (oldest, newest) = (at(kernel.length()), at(0));
        let length = v.vector.iter().map(|c| c * c).sum::<f64>().sqrt();
        let toward: AxisVec = v.vector.iter().map(|c| c / length).collect();
        let mut curvature = AxisVec::zeros(marks[first].point().len());
        let mut parts = Vec::new();
        for (m, mark) in marks.iter().enumerate().take(last).skip(first) {
            if m > first && mark.is_kink() {
                let size = self.turn(m, &toward) * weight(mark.s_mm);
                parts.push(Part { mark: m, bend: false, size, s: mark.s_mm });
            }
            if mark.queued.bend > 0.0 {
                let from = oldest.max(mark.s_mm);
                let to = newest.min(mark.s_mm + mark.queued.length);
                let step = (to - from) / f64::from(BEND_POINTS);
                let mut size = 0.0;
                for i in 0..BEND_POINTS {
                    let s = from + (f64::from(i) + 0.5) * step;
                    mark.queued
                        .block
                        .path
                        .curvature(mark.queued.offset + s - mark.s_mm, &mut curvature);
                    let pull: f64 = curvature.iter().zip(toward.iter()).map(|(c, u)| c * u).sum();
                    size += pull * weight(s) * step;
                }
                if step > 0.0 {
                    parts.push(Part { mark: m, bend: true, size, s: middle.clamp(from, to) });
                }
            }
        }
        parts
    }
}
