//! What leaves the simulation in addition to its records: points to be measured against the contour, and messages.
//!
//! The simulation never looks at the deviation of its output, so it may be measured later, on another thread.

use super::{Simulation, fault};
use crate::diag::{Condition, Diagnostic, Severity};
use crate::exec::SourceRef;
use crate::record::CycleRecord;
use kontur_motion::axis::AxisVec;
use kontur_motion::deviation::{Change, Meter};
use kontur_motion::tolerance::Unkept;

/// Messages of the program that are kept until they are taken: without motion a loop gives millions at once.
pub(super) const MESSAGES_MAX: usize = 10_000;

/// Points of consecutive cycles, and what they are measured to be.
#[derive(Debug, Default)]
pub(crate) struct Samples {
    /// Path axes.
    axes: usize,
    cycles: Vec<Sample>,
    /// Of each cycle, axis by axis: the set points without the ways of independent axes, then the interpolated ones. What is
    /// measured takes their place: the shortest vector to the contour, then the larger of both ways.
    values: Vec<f64>,
    /// Of the contour, each with the number of the first sample that knows it.
    changes: Vec<(usize, Change)>,
    /// The first excess of a run, and the number of its sample.
    exceeded: Option<(usize, Unkept)>,
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
}

/// What is to be measured of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wanted {
    Nothing,
    /// The set point is the interpolated one, bit for bit.
    Unshaped,
    /// Filters have moved the set point away from it.
    Shaped,
}

impl Samples {
    /// No samples, keeping the memory.
    pub(crate) fn clear(&mut self) {
        self.cycles.clear();
        self.values.clear();
        self.changes.clear();
        self.exceeded = None;
    }

    /// Writes what was measured in sample `i` into the record of its cycle.
    pub(crate) fn fill(&self, i: usize, record: &mut CycleRecord) {
        let (n, sample) = (self.axes, &self.cycles[i]);
        if sample.wanted == Wanted::Nothing {
            return;
        }
        record.contour_err_mm = sample.length_mm;
        let (dev, both_ways) = self.values[2 * n * i..2 * n * (i + 1)].split_at(n);
        for ((axis, dev), both_ways) in record.axes.iter_mut().zip(dev).zip(both_ways) {
            (axis.dev, axis.dev_both_ways) = (*dev, *both_ways);
        }
    }
}

impl Simulation {
    /// Adds the cycle computed last.
    pub(crate) fn sample(&mut self, into: &mut Samples) {
        let n = self.path_axes();
        into.axes = n;
        let number = into.cycles.len();
        into.changes.extend(self.planner.take_changes().map(|change| (number, change)));
        into.values.extend_from_slice(&self.set);
        into.values.extend_from_slice(&self.planner.setpoint().position[..n]);
        let axes = &self.record.axes[..n];
        let shaped = axes.iter().any(|a| a.set.to_bits() != a.ipo.to_bits());
        let wanted = match self.planner.reports_changes() {
            // nothing was output yet
            _ if self.record.k == 0 => Wanted::Nothing,
            false => Wanted::Nothing,
            true if shaped => Wanted::Shaped,
            true => Wanted::Unshaped,
        };
        into.cycles.push(Sample { k: self.record.k, at: self.current, wanted, length_mm: 0.0 });
    }

    /// What the deviation of a sample says, if it is the first that exceeds a tolerance.
    pub(crate) fn exceeded(&mut self, samples: &Samples, i: usize) -> Option<Diagnostic> {
        let (_, exceeded) = samples.exceeded.filter(|(at, _)| *at == i)?;
        let mut d = fault::exceeded(&exceeded);
        d.source = self.executor.locate(samples.cycles[i].at);
        Some(d)
    }
}

/// Measures the cycles of a run against the contour, in their order, from the first one on.
#[derive(Debug, Default)]
pub(crate) struct Measuring {
    meter: Meter,
    vector: AxisVec,
}

impl Measuring {
    /// Measures nothing but the set points until a block demands a tolerance; not a number (NaN) instead of both ways.
    pub(crate) fn set_points_only(&mut self) {
        self.meter.set_points_only();
    }

    /// Measures the next cycles.
    pub(crate) fn measure(&mut self, samples: &mut Samples) {
        let n = samples.axes;
        if self.vector.len() != n {
            self.vector = AxisVec::zeros(n);
        }
        let mut changes = samples.changes.drain(..).peekable();
        for (i, sample) in samples.cycles.iter_mut().enumerate() {
            while let Some((_, change)) = changes.next_if(|(at, _)| *at <= i) {
                self.meter.take(change);
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
            if let Some(exceeded) = self.meter.take_exceeded() {
                samples.exceeded = Some((i, exceeded));
            }
        }
    }
}

/// Messages of a run that have not been taken yet.
#[derive(Debug, Default)]
pub(crate) struct Messages {
    /// Of the simulation, in the order of raising.
    pub(super) own: Vec<Diagnostic>,
    /// Messages of the program (`#MSG`) that are not among them.
    pub(super) unshown: u64,
    /// Of the executor, in the order of raising.
    pub(super) program: Vec<Diagnostic>,
}

impl Messages {
    pub(super) const fn is_empty(&self) -> bool {
        self.own.is_empty() && self.program.is_empty() && self.unshown == 0
    }

    /// Adds a message of the simulation.
    pub(crate) fn push(&mut self, message: Diagnostic) {
        if message.id == Condition::Message && self.own.len() >= MESSAGES_MAX {
            self.unshown += 1;
        } else {
            self.own.push(message);
        }
    }

    /// Adds later ones, if there are any.
    pub(crate) fn absorb(&mut self, later: Option<Self>) {
        let Some(Self { own, unshown, program }) = later else { return };
        for message in own {
            self.push(message);
        }
        self.unshown += unshown;
        self.program.extend(program);
    }

    /// All of them, as a list.
    pub(crate) fn take(&mut self) -> Vec<Diagnostic> {
        let Self { mut own, unshown, program } = std::mem::take(self);
        if unshown > 0 {
            let text = format!("{unshown} more messages of the program at once, not shown");
            own.push(Diagnostic::new(Condition::Message, text).severity(Severity::Note));
        }
        own.extend(program);
        own
    }
}
