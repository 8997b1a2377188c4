//! The violations to be answered: the worst one of those that are close together.

use super::view::View;
use super::violation::{Record, Violation, within};
use crate::deviation::Unkept;

/// Receives violations, and forwards at most one per half kernel. They come in the order of their cycles, except for
/// those close to the first one of a half kernel.
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

    /// Whether only the worst of the violations held and one in cycle `k` will be forwarded.
    pub(super) fn is_close(&self, k: u64) -> bool {
        self.bucket.as_ref().is_some_and(|(since, _)| k.abs_diff(*since) < self.half)
    }

    /// Whether a violation close to those held can matter if its largest component is at most `most_mm`.
    pub(super) fn counts(&self, most_mm: f64, tolerance_mm: f64) -> bool {
        let excess = most_mm - within(tolerance_mm);
        self.bucket.as_ref().is_none_or(|(_, b)| b.excess() <= excess)
            || self.worst.as_ref().is_none_or(|w| w.deviation_mm <= most_mm)
    }

    pub(super) fn take(&mut self, v: Violation, record: &Record) {
        if self.worst.as_ref().is_none_or(|w| w.deviation_mm <= v.deviation_mm) {
            let marks = &self.view.marks;
            let i = marks.partition_point(|m| m.cycles <= v.cycle as f64).max(1) - 1;
            let seq = marks[i].queued.block.seq;
            let Violation { deviation_mm, tolerance_mm, .. } = v;
            // of equal ones the first
            let is_first = |w: &Unkept| w.deviation_mm < deviation_mm || seq < w.seq;
            if self.worst.as_ref().is_none_or(is_first) {
                *self.worst = Some(Unkept { seq, deviation_mm, tolerance_mm });
            }
        }
        if self.is_close(v.cycle) {
            let is_worse = |b: &Violation| {
                b.excess() < v.excess() || b.excess() <= v.excess() && v.cycle < b.cycle
            };
            if let Some((_, b)) = self.bucket.as_mut().filter(|(_, b)| is_worse(b)) {
                *b = v;
            }
        } else if let Some((_, b)) = self.bucket.replace((v.cycle, v)) {
            (self.found)(&b, record);
        }
    }

    /// Forwards the last violation.
    pub(super) fn end(mut self, record: &Record) {
        if let Some((_, v)) = self.bucket.take() {
            (self.found)(&v, record);
        }
    }
}
