//! A plan under examination on the cycle grid: the times at which blocks are entered, and the resulting set points.

use super::marks::{Mark, Marks};
use super::{Monitor, Trial};
use crate::axis::AxisVec;
use crate::contour::{Contour, Walk};
use crate::timeline::{Entry, PathState, Reader};

/// Number of rows in a buffer, in reaches of the kernels, from which on old rows are discarded.
const ROOM: usize = 4;

/// A plan together with the setpoints before it.
pub(super) struct View<'a> {
    pub(super) trial: &'a Trial<'a>,
    pub(super) monitor: &'a Monitor,
    /// Blocks already within reach, then those of the plan.
    pub(super) marks: Vec<Mark>,
    /// The blocks of the marks.
    pub(super) contour: Contour,
    /// Tolerance in mm, if it is the same for all marks.
    pub(super) tolerance_mm: Option<f64>,
}

impl<'a> View<'a> {
    /// `known`: the marks of an earlier plan of the same search.
    pub(super) fn new(trial: &'a Trial<'a>, monitor: &'a Monitor, mut known: Marks) -> Self {
        known.follow(trial);
        let Marks { list: marks, contour } = known;
        let mut tolerances = marks.iter().map(|m| m.queued.block.tolerance.ax_dev_mm);
        let first = tolerances.next().flatten();
        let tolerance_mm = first.filter(|_| tolerances.all(|t| t == first));
        Self { trial, monitor, marks, contour, tolerance_mm }
    }

    /// The marks, for the next plan of a search.
    pub(super) fn into_marks(self) -> Marks {
        Marks { list: self.marks, contour: self.contour }
    }

    /// State of the path in cycle `k`, output or planned.
    pub(super) fn state(&self, k: u64, reader: &mut Reader<'_>, state: &mut PathState) {
        let trial = self.trial;
        if k > trial.now {
            reader.state(k, trial.cycle, state);
        } else {
            let history = &self.monitor.history;
            let back = (trial.now - k) as usize;
            let i = history.len().saturating_sub(1 + back);
            if let Some((position, s)) = history.get(i) {
                state.position.copy_from_slice(position);
                state.s = *s;
            }
        }
    }

    /// Time in cycles at which the plan comes to rest.
    pub(super) fn rest(&self) -> f64 {
        let Trial { timeline, plan, now, cycle, .. } = self.trial;
        let last = plan.last().or_else(|| timeline.entries().next_back());
        last.map_or(*now as f64, |e| e.end.cycles(*cycle))
    }

    /// Highest planned speed in mm/s of the timeline entry that contains a block of the window.
    pub(super) fn peak_of(&self, block: usize) -> f64 {
        let mut behind = 0;
        let holds = |e: &&Entry| {
            behind += e.blocks.len();
            block < behind
        };
        self.trial.plan.iter().find(holds).map_or(0.0, |e| e.profile.peak())
    }

    /// Planned speed in mm/s at a boundary of the window.
    pub(super) fn speed_at(&self, boundary: usize) -> f64 {
        let mut index = 0;
        for e in self.trial.plan {
            if boundary < index + e.blocks.len() {
                let s = if boundary == index { 0.0 } else { e.blocks[boundary - index - 1].1 };
                return e.profile.at(e.profile.time_at(s)).v_mm_s;
            }
            index += e.blocks.len();
        }
        0.0
    }
}

/// Raw positions within reach of the kernels, and the resulting set point.
pub(super) struct Buffer<'a> {
    view: &'a View<'a>,
    reader: Reader<'a>,
    walk: Walk<'a>,
    /// Cycle by cycle, oldest first: the position of every axis, then the path length.
    rows: Vec<f64>,
    /// Number of values in a row.
    width: usize,
    /// Number of rows within reach of the kernels, including the newest.
    reach: usize,
    state: PathState,
    /// The filtered row: the set point, then the mean path length.
    filtered: AxisVec,
    /// The cycle after the last one read.
    next: Option<u64>,
}

impl<'a> Buffer<'a> {
    pub(super) fn new(view: &'a View<'a>) -> Self {
        let trial = view.trial;
        let n = view.marks.first().map_or(0, |m| m.queued.block.path.start().len());
        let reach = trial.kernels.length() as usize + 1;
        Self {
            view,
            reader: Reader::new(trial.timeline, trial.plan),
            walk: view.contour.walk(),
            rows: vec![0.0; reach * (n + 1)],
            width: n + 1,
            reach,
            state: PathState::at_rest(&AxisVec::zeros(n)),
            filtered: AxisVec::zeros(n + 1),
            next: None,
        }
    }

    /// Prepares the buffer so that `first` is the next cycle to read.
    pub(super) fn seek(&mut self, first: u64) {
        if self.next != Some(first) {
            for back in (1..self.reach as u64).rev() {
                self.take(first.saturating_sub(back));
            }
        }
    }

    /// Reads cycle `k` without filtering.
    pub(super) fn take(&mut self, k: u64) {
        self.view.state(k, &mut self.reader, &mut self.state);
        let kept = (self.reach - 1) * self.width;
        if self.rows.len() >= ROOM * self.reach * self.width {
            let old = self.rows.len() - kept;
            self.rows.copy_within(old.., 0);
            self.rows.truncate(kept);
        }
        self.rows.extend_from_slice(&self.state.position);
        self.rows.push(self.state.s);
        self.next = Some(k + 1);
    }

    /// Reads cycle `k` and filters.
    pub(super) fn step(&mut self, k: u64) {
        self.take(k);
        self.filter();
    }

    /// Computes the set point and mean path length of the last cycle read.
    pub(super) fn filter(&mut self) {
        let Self { rows, width, .. } = self;
        let newest = rows.len() - *width;
        let row = |delay: u32| {
            let at = newest - delay as usize * *width;
            &rows[at..at + *width]
        };
        self.view.trial.kernels.filter(row, &mut self.filtered);
    }

    /// Set point of the last cycle filtered.
    pub(super) fn set(&self) -> &[f64] {
        &self.filtered[..self.width - 1]
    }

    /// Path length of the last cycle read.
    pub(super) fn s(&self) -> f64 {
        self.rows[self.rows.len() - 1]
    }

    /// Mean of the path lengths within the longest kernel, filtered as the positions are; limited to their range.
    pub(super) fn middle(&self) -> f64 {
        self.within_reach(self.filtered[self.width - 1])
    }

    /// Path length of the point of the contour that accompanies the set point of the last cycle filtered: the mean of
    /// [`Self::middle`], or, where the filters differ and move the set point along the path, the one beside it.
    pub(super) fn beside(&mut self) -> f64 {
        let middle = self.middle();
        if !self.view.trial.kernels.differ() {
            return middle;
        }
        let foot = self.walk.foot(middle, &self.filtered[..self.width - 1]);
        self.within_reach(foot)
    }

    /// The nearest path length among those within reach of the kernels.
    fn within_reach(&self, s_mm: f64) -> f64 {
        let oldest = self.rows.len() - (self.reach - 1) * self.width - 1;
        // between a plan and what was driven the path length may fall by its last digit
        s_mm.max(self.rows[oldest]).min(self.s())
    }
}
