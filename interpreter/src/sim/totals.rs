//! What a run adds up in addition to its records.

use crate::diag::{Condition, Diagnostic, Severity};
use crate::exec::{Event, ShapingSettings, ShapingSetup, SourceRef};
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_motion::axis::AxisDynamics;
use kontur_motion::block::{Block, Feed};
use std::collections::BTreeMap;

/// An exact stop of one axis that reached its window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SettledStop {
    /// Index into the axes of a record.
    pub axis: usize,
    /// Block whose stop it was.
    pub source: SourceRef,
    /// Cycle of t2: the actual position is inside the window.
    pub k: u64,
    /// t2 - t1 in s.
    pub settling_s: f64,
}

/// The exact stops of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stops {
    /// The first of them, at most [`Self::KEPT`].
    pub first: Vec<SettledStop>,
    /// Per axis: how many, and the slowest.
    pub axes: BTreeMap<usize, (u64, SettledStop)>,
}

impl Stops {
    /// Stops that are kept one by one; a program may stop without end.
    pub const KEPT: usize = 1000;

    /// Adds a stop.
    pub(super) fn add(&mut self, stop: SettledStop) {
        if self.first.len() < Self::KEPT {
            self.first.push(stop);
        }
        let (count, slowest) = self.axes.entry(stop.axis).or_insert((0, stop));
        *count += 1;
        if stop.settling_s > slowest.settling_s {
            *slowest = stop;
        }
    }
}

/// A motion as it was programmed, for what is counted of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Programmed {
    length_mm: f64,
    ideal_s: f64,
    /// Blocks of the program up to it.
    blocks: u64,
}

impl Programmed {
    /// A motion that comes from the program as the last of so many blocks.
    pub(super) fn new(block: &Block, blocks: u64) -> Self {
        let length_mm = block.path.length();
        let ideal_s = match block.feed {
            Feed::PathVelocity(v) => length_mm / v,
            Feed::Duration(t) => t,
            Feed::Rapid => slowest_s(block, |axis| axis.v_rapid_mm_s),
            Feed::ShareOfMaximum(share) => slowest_s(block, |axis| share * axis.v_max_mm_s),
        };
        Self { length_mm, ideal_s, blocks }
    }
}

/// How far the path has come in what was programmed: the look-ahead takes more from the program than a run that is stopped
/// drives.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Progress {
    /// Ideal time of the motions before the current one.
    done_s: f64,
    /// The current one; after a stop nothing but the blocks up to there.
    current: Programmed,
    /// Path length at which the current one began.
    from_mm: f64,
}

impl Progress {
    /// A motion begins at a path length; the ones before it are complete.
    pub(super) fn begin(&mut self, motion: Programmed, s_mm: f64) {
        self.complete(self.current.blocks);
        (self.current, self.from_mm) = (motion, s_mm);
    }

    /// Everything up to so many blocks of the program has been executed.
    pub(super) fn complete(&mut self, blocks: u64) {
        self.done_s += self.current.ideal_s;
        self.current = Programmed { blocks, ..Programmed::default() };
    }

    /// Blocks, and the ideal time in s, up to a path length.
    pub(super) fn up_to(&self, s_mm: f64) -> (u64, f64) {
        let Self { done_s, current, from_mm } = self;
        let share = (s_mm - from_mm) / current.length_mm;
        let part_s = if share > 0.0 { current.ideal_s * share.min(1.0) } else { 0.0 };
        (current.blocks, done_s + part_s)
    }
}

/// What is known when the last cycle has been computed and what no record holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Totals {
    /// The program was refused or stopped by an error.
    pub aborted: bool,
    /// The source of the real-time inputs failed.
    pub input_failed: bool,
    /// Exact stops.
    pub stops: Stops,
    /// Blocks executed, in a run that was stopped those up to the motion in which it was.
    pub blocks: u64,
    /// Path length / programmed feed of the feed blocks, the way of the slowest axis at its rapid speed of the rapid ones,
    /// in s: without ramps, corners and limits. Dwells and technology times are not in it. Of a motion in which the run was
    /// stopped its share of the path counts.
    pub ideal_duration_s: f64,
    /// What the duration does not contain (M functions, tool changes, spindle run-up).
    pub not_counted: Vec<String>,
    /// Largest mean delay of the shaping of each axis in cycles.
    pub filter_delay_cycles: Vec<f64>,
    /// Settings that the Vibration Guard of an axis (index into the axes of a record) worked with, in the order in which they came up, at most
    /// [`Self::GUARDS_KEPT`].
    pub guards: Vec<(usize, VibGuardSettings)>,
}

impl Totals {
    /// Different settings of the Vibration Guard that are kept; a program may change them without end.
    pub(crate) const GUARDS_KEPT: usize = 100;

    /// Notes what the kernels are made from.
    pub(super) fn shaped(&mut self, setup: &ShapingSetup) {
        for (axis, shaping) in setup.axes.iter().enumerate() {
            if let ShapingSettings::VibGuard(settings) = shaping.settings
                && shaping.kernel.is_some()
                && self.guards.len() < Self::GUARDS_KEPT
                && !self.guards.contains(&(axis, settings))
            {
                self.guards.push((axis, settings));
            }
        }
    }

    /// Notes an event that moves nothing; a message of the program comes back as a note for the log.
    pub(super) fn note(&mut self, event: Event, time_s: f64) -> Option<Diagnostic> {
        match event {
            Event::Uncounted { function } => {
                self.not_counted.push(function);
                None
            }
            Event::Message { text, .. } => {
                let mut message =
                    Diagnostic::new(Condition::Message, text).severity(Severity::Note);
                message.time_s = Some(time_s);
                Some(message)
            }
            Event::MFunction { .. }
            | Event::HFunction { .. }
            | Event::Tool { .. }
            | Event::Feedforward { .. }
            | Event::SpindleFeedforward { .. }
            | Event::SpindleAcceleration { .. }
            | Event::SpindleLimits { .. }
            | Event::SpindleFollows { .. }
            | Event::CuttingSpeed { .. }
            | Event::Timer { .. }
            | Event::Independent { .. }
            | Event::Oscillation { .. }
            | Event::Couple { .. }
            | Event::Uncouple { .. }
            | Event::Wear(_)
            | Event::Engaged(_)
            | Event::Banding(_)
            | Event::Spindle { .. } => None,
        }
    }
}

/// Time that the axis that needs longest takes for its way at a speed.
fn slowest_s(block: &Block, speed_mm_s: impl Fn(&AxisDynamics) -> f64) -> f64 {
    let ways = block.path.start().iter().zip(block.path.end().iter()).zip(&block.dynamics.axes);
    let times = ways.map(|((from, to), axis)| (to - from).abs() / speed_mm_s(axis));
    times.filter(|t| t.is_finite()).fold(0.0, f64::max)
}
