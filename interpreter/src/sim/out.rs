//! The output of the simulation: its cycles as rows, points to be measured against the contour, and messages.
//!
//! The simulation never uses the deviation of its output, so it can be measured later, on another thread.

use super::fault;
use super::state::Simulation;
use crate::diag::Diagnostic;
use crate::exec::SourceRef;
use crate::record::{CycleRecord, Quantity, RowBuffer};
use kontur_motion::axis::AxisVec;
use kontur_motion::deviation::Unkept;
use kontur_motion::deviation::{Change, Meter};
use std::ops::Range;

/// Points of consecutive cycles, and their measured deviation.
#[derive(Debug, Default)]
pub(crate) struct Samples {
    /// Number of path axes.
    axes: usize,
    /// Gantry slaves, which are not measured (indices into the axes of a record).
    bridges: Range<usize>,
    cycles: Vec<Sample>,
    /// For each cycle, axis by axis: the set points without the ways of independent axes, then the interpolated points.
    /// The results replace them: the shortest vector to the contour, then the larger deviation of both directions.
    values: Vec<f64>,
    /// Changes of the contour, each with the number of the first sample after it.
    changes: Vec<(usize, Change)>,
    /// The first excess of a run.
    exceeded: Option<Exceeded>,
    /// Whether the run ends with these samples.
    pub(crate) ends: bool,
    /// The first sample in whose cycle messages were raised.
    said_at: Option<usize>,
}

/// An excess of a tolerance in the output.
#[derive(Clone, Copy, Debug)]
struct Exceeded {
    unkept: Unkept,
    /// The block that was interpolated where it is largest.
    at: SourceRef,
    /// Number of samples after which it is known.
    after: usize,
}

/// One cycle among them.
#[derive(Clone, Copy, Debug)]
struct Sample {
    k: u64,
    /// The block that is interpolated.
    at: SourceRef,
    wanted: Wanted,
    /// Length in mm of the shortest vector from the set point to the contour, once it is measured.
    length_mm: f64,
    /// Path axes that follow another one, which are not measured; one bit each, for the first 64.
    followers: u64,
}

impl Sample {
    /// Whether an axis has no deviation of its own.
    fn follows(&self, axis: usize) -> bool {
        axis < 64 && self.followers >> axis & 1 == 1
    }
}

/// The measurement that a cycle requires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wanted {
    Nothing,
    /// The set point is the interpolated one, bit for bit.
    Unshaped,
    /// Filters have moved the set point away from the interpolated one.
    Shaped,
}

impl Samples {
    /// Removes all samples but keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.cycles.clear();
        self.values.clear();
        self.changes.clear();
        (self.exceeded, self.ends, self.said_at) = (None, false, None);
    }

    /// Writes the results into the rows of their cycles.
    pub(crate) fn fill(&self, rows: &mut RowBuffer) {
        let n = self.axes;
        let measured = || self.cycles.iter().enumerate().filter(|s| s.1.wanted != Wanted::Nothing);
        for (i, sample) in measured() {
            rows.cycle_mut(i).contour_err_mm = sample.length_mm;
        }
        for (quantity, first) in [(Quantity::Dev, 0), (Quantity::DevBothWays, n)] {
            if !rows.asked().has(quantity) {
                continue;
            }
            for axis in 0..n {
                for (i, _) in measured() {
                    *rows.value_mut(axis, quantity, i) = self.values[2 * n * i + first + axis];
                }
            }
            for (i, sample) in self.cycles.iter().enumerate() {
                for axis in self.followers(sample) {
                    *rows.value_mut(axis, quantity, i) = f64::NAN;
                }
            }
        }
    }

    /// The axes that have no deviation of their own in a cycle, measured or not (indices into those of a record).
    fn followers(&self, sample: &Sample) -> impl Iterator<Item = usize> {
        let path_axes = if sample.followers == 0 { 0 } else { self.axes };
        (0..path_axes).filter(|axis| sample.follows(*axis)).chain(self.bridges.clone())
    }

    /// Writes the results of the last cycle into its record.
    pub(crate) fn fill_last(&self, record: &mut CycleRecord) {
        let Some((i, sample)) = self.cycles.iter().enumerate().next_back() else { return };
        if sample.wanted != Wanted::Nothing {
            let n = self.axes;
            record.contour_err_mm = sample.length_mm;
            let (dev, both_ways) = self.values[2 * n * i..2 * n * (i + 1)].split_at(n);
            for ((axis, dev), both_ways) in record.axes.iter_mut().zip(dev).zip(both_ways) {
                (axis.dev, axis.dev_both_ways) = (*dev, *both_ways);
            }
        }
        for axis in self.followers(sample) {
            let axis = &mut record.axes[axis];
            (axis.dev, axis.dev_both_ways) = (f64::NAN, f64::NAN);
        }
    }

    /// Number of cycles after which an excess of a tolerance is known, until [`Simulation::exceeded`] has taken it.
    pub(crate) fn exceeded_after(&self) -> Option<usize> {
        self.exceeded.map(|exceeded| exceeded.after)
    }

    /// The first cycle in which messages were raised.
    pub(crate) const fn said_at(&self) -> Option<usize> {
        self.said_at
    }
}

impl Simulation {
    /// Adds the points of the next cycles, the first of which is cycle `k`; their columns are written. `positions`:
    /// setpoints of the path, axis by axis.
    pub(super) fn add_points<'a>(
        &self,
        (k, count): (u64, usize),
        positions: impl Fn(usize) -> &'a [f64],
        rows: &mut RowBuffer,
        into: &mut Samples,
    ) {
        let n = self.path_axes();
        let is_measured = self.is_measured();
        for quantity in [Quantity::Dev, Quantity::DevBothWays] {
            if !is_measured && rows.asked().has(quantity) {
                (0..n).for_each(|axis| rows.next_mut(axis, quantity, count).fill(f64::NAN));
            }
        }
        into.axes = n;
        into.bridges = n + self.spindles.len()..self.chains.len();
        let first = into.cycles.len();
        // before the first output nothing is measured
        let wanted = |k| if is_measured && k > 0 { Wanted::Unshaped } else { Wanted::Nothing };
        let at = self.blocks.current;
        let sample = |k| Sample { k, at, wanted: wanted(k), length_mm: 0.0, followers: 0 };
        into.cycles.extend((k..k + count as u64).map(sample));
        let from = into.values.len();
        into.values.resize(from + 2 * n * count, 0.0);
        for p in 0..n {
            let (set, ipo) =
                (rows.next(p, Quantity::Set, count), rows.next(p, Quantity::Ipo, count));
            let values = into.values[from..].chunks_exact_mut(2 * n);
            let cycles = &mut into.cycles[first..];
            for ((values, cycle), ((set, ipo), position)) in
                values.zip(cycles).zip(set.iter().zip(ipo).zip(positions(p)))
            {
                if set.to_bits() != ipo.to_bits() && cycle.wanted == Wanted::Unshaped {
                    cycle.wanted = Wanted::Shaped;
                }
                (values[p], values[n + p]) = (*set, *position);
            }
        }
    }

    /// Takes the ways of independent axes out of the last point: the set position without them is measured against the
    /// contour, and while one of them moves, it does not count.
    pub(super) fn take_out_ways(&mut self, into: &mut Samples) {
        let n = into.axes;
        if let Some(sample) = into.cycles.last_mut() {
            let follows = (0..n.min(64)).filter(|axis| self.independent.follows(*axis));
            sample.followers = follows.fold(0, |bits, axis| bits | 1 << axis);
        }
        let last = into.values.len() - 2 * n;
        let (set, path) = into.values[last..].split_at_mut(n);
        for (p, (set, path)) in set.iter_mut().zip(path).enumerate() {
            if self.independent.is_on_its_way(p, self.chains.all[p].settled()) {
                *set = *path;
            } else {
                *set -= self.independent.done_mm(p);
            }
        }
    }

    /// Completes the row of the next cycle: that of the record, whose columns are written and whose points were added.
    pub(super) fn show(&mut self, rows: &mut RowBuffer, into: &mut Samples) {
        if rows.asked().has(Quantity::Target) {
            for (axis, target) in self.targets.iter().enumerate() {
                rows.next_mut(axis, Quantity::Target, 1)[0] = *target;
            }
        }
        let number = rows.len();
        for change in self.planner.take_changes() {
            into.changes.push((number, change));
        }
        if self.has_messages() {
            into.said_at.get_or_insert(number);
        }
        into.cycles[number].at = self.blocks.current;
        rows.push(&self.record);
    }

    /// The message about the first corner that exceeds a tolerance, returned once.
    pub(crate) fn exceeded(&mut self, samples: &mut Samples) -> Option<Diagnostic> {
        let exceeded = samples.exceeded.take()?;
        let mut d = fault::exceeded(&exceeded.unkept);
        d.source = self.program.locate(exceeded.at);
        Some(d)
    }
}

/// Measures the cycles of a run against the contour, in order, from the first one on.
#[derive(Debug, Default)]
pub(crate) struct Measuring {
    meter: Meter,
    vector: AxisVec,
    /// The block that was interpolated in the cycle that exceeds a tolerance most.
    exceeded_at: Option<SourceRef>,
}

impl Measuring {
    /// Measures only the set points until a block requires a tolerance; the deviation in both directions is NaN until
    /// then.
    pub(crate) fn set_points_only(&mut self) {
        self.meter.set_points_only();
    }

    /// Measures the next cycles.
    pub(crate) fn measure(&mut self, samples: &mut Samples) {
        let n = samples.axes;
        if self.vector.len() != n {
            self.vector = AxisVec::zeros(n);
        }
        let mut changes = samples.changes.drain(..);
        let mut next = changes.next();
        for (i, sample) in samples.cycles.iter_mut().enumerate() {
            while let Some((_, change)) = next.take_if(|(at, _)| *at <= i) {
                self.meter.take(change);
                next = changes.next();
            }
            let (set, path) = samples.values[2 * n * i..2 * n * (i + 1)].split_at_mut(n);
            // on the contour bit for bit: nothing to search
            sample.length_mm = match sample.wanted {
                Wanted::Nothing => continue,
                Wanted::Shaped => self.meter.filtered(sample.k, set, path, &mut self.vector),
                Wanted::Unshaped => {
                    self.meter.unfiltered(sample.k, path);
                    self.vector.fill(0.0);
                    0.0
                }
            };
            let excursion = self.meter.excursion();
            for (p, dev) in self.vector.iter().enumerate() {
                set[p] = *dev;
                path[p] = excursion.map_or(f64::NAN, |found| {
                    found.get(p).map_or(dev.abs(), |d| d.abs().max(dev.abs()))
                });
            }
            if self.meter.exceeds_most_at() == Some(sample.k) {
                self.exceeded_at = Some(sample.at);
            }
            if let Some(unkept) = self.meter.take_exceeded()
                && let Some(at) = self.exceeded_at
            {
                samples.exceeded = Some(Exceeded { unkept, at, after: i + 1 });
            }
        }
        if samples.ends {
            self.meter.end();
            if let Some(unkept) = self.meter.take_exceeded()
                && let Some(at) = self.exceeded_at
            {
                samples.exceeded = Some(Exceeded { unkept, at, after: samples.cycles.len() });
            }
        }
    }
}
