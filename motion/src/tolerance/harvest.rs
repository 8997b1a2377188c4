//! The violations to be answered: the worst one of those that are close together.

use super::view::View;
use super::violation::{Record, Violation};
use crate::deviation::Unkept;

/// Receives violations in the order of their cycles, and forwards at most one per half kernel.
pub(super) struct Harvest<'a, F> {
    view: &'a View<'a>,
    half: u64,
    /// The worst one since a cycle. Counted from the first violation, so that a motion is planned alike whenever it
    /// begins.
    bucket: Option<(u64, Violation)>,
    /// The worst of all.
    worst: &'a mut Option<Unkept>,
    found: &'a mut F,
}

impl<'a, F: FnMut(&Violation, &Record)> Harvest<'a, F> {
    pub(super) fn new(view: &'a View<'a>, worst: &'a mut Option<Unkept>, found: &'a mut F) -> Self {
        let half = (u64::from(view.trial.kernels.length()) / 2).max(1);
        Self { view, half, bucket: None, worst, found }
    }

    pub(super) fn take(&mut self, v: Violation, record: &Record) {
        if self.worst.as_ref().is_none_or(|w| w.deviation_mm < v.deviation_mm) {
            let marks = &self.view.marks;
            let i = marks.partition_point(|m| m.cycles <= v.cycle as f64).max(1) - 1;
            let seq = marks[i].queued.block.seq;
            let Violation { deviation_mm, tolerance_mm, .. } = v;
            *self.worst = Some(Unkept { seq, deviation_mm, tolerance_mm });
        }
        self.bucket = Some(match self.bucket.take() {
            Some((since, b)) if v.cycle.abs_diff(since) < self.half => {
                (since, if v.excess() > b.excess() { v } else { b })
            }
            Some((_, b)) => {
                (self.found)(&b, record);
                (v.cycle, v)
            }
            None => (v.cycle, v),
        });
    }

    /// Forwards the last violation.
    pub(super) fn end(mut self, record: &Record) {
        if let Some((_, v)) = self.bucket.take() {
            (self.found)(&v, record);
        }
    }
}
