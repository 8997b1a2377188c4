//! Totals of a run in addition to its records.

use crate::diag::{Condition, Diagnostic, Severity};
use crate::exec::{Event, ShapingSettings, ShapingSetup, SourceRef};
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_motion::axis::AxisDynamics;
use kontur_motion::block::{Block, Feed};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// An exact stop of one axis that reached its window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SettledStop {
    /// Index into the axes of a record.
    pub axis: usize,
    /// Block of the stop.
    pub source: SourceRef,
    /// Cycle of t2, in which the actual position is inside the window.
    pub k: u64,
    /// t2 - t1 in s.
    pub settling_s: f64,
}

/// The exact stops of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stops {
    /// The first stops, at most [`Self::KEPT`].
    pub first: Vec<SettledStop>,
    /// Per axis: the number of stops, and the slowest.
    pub axes: BTreeMap<usize, (u64, SettledStop)>,
}

impl Stops {
    /// Number of stops that are kept individually, since a program may stop without end.
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

/// A programmed motion, with the values that count towards the totals.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Programmed {
    /// Number of its block; `None`: no motion.
    seq: Option<u64>,
    length_mm: f64,
    ideal_s: f64,
    /// Blocks of the program up to it.
    blocks: u64,
}

impl Programmed {
    /// A motion that is the last of this number of blocks.
    pub(super) fn new(block: &Block, blocks: u64) -> Self {
        let length_mm = block.path.length();
        let ideal_s = match block.feed {
            Feed::PathVelocity(v) => length_mm / v,
            Feed::Duration(t) => t,
            Feed::Rapid => slowest_s(block, |axis| axis.v_rapid_mm_s),
            Feed::ShareOfMaximum(share) => slowest_s(block, |axis| share * axis.v_max_mm_s),
        };
        Self { seq: Some(block.seq), length_mm, ideal_s, blocks }
    }
}

/// What becomes of motions that are changed between program and planner: curves are shorter than their corners.
#[derive(Clone, Debug, Default)]
pub(super) struct Changed {
    /// Sums over the parts of each motion, in order; zero if nothing is left of it.
    motions: VecDeque<Programmed>,
}

impl Changed {
    /// A motion that may be changed.
    pub(super) fn begin(&mut self, seq: u64) {
        self.motions.push_back(Programmed { seq: Some(seq), ..Programmed::default() });
    }

    /// A part that goes to the planner.
    pub(super) fn add(&mut self, part: &Block) {
        let Programmed { seq, length_mm, ideal_s, .. } = Programmed::new(part, 0);
        let last = self.motions.iter_mut().rev().find(|motion| motion.seq == seq);
        if let Some(motion) = last {
            motion.length_mm += length_mm;
            motion.ideal_s += ideal_s;
        }
    }

    /// The motion as it is driven; earlier ones are dropped.
    fn driven(&mut self, motion: Programmed) -> Programmed {
        if self.motions.is_empty() {
            return motion;
        }
        while self.motions.front().is_some_and(|first| first.seq < motion.seq) {
            self.motions.pop_front();
        }
        self.as_driven(motion)
    }

    fn as_driven(&self, motion: Programmed) -> Programmed {
        match self.motions.iter().find(|changed| changed.seq == motion.seq) {
            Some(Programmed { length_mm, ideal_s, .. }) => {
                Programmed { length_mm: *length_mm, ideal_s: *ideal_s, ..motion }
            }
            None => motion,
        }
    }
}

/// Progress of the path in the program: the look-ahead takes more from the program than a stopped run executes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Progress {
    /// Ideal time of the motions before the current one.
    done_s: f64,
    /// The current motion; after a stop only the number of blocks up to it.
    current: Programmed,
    /// Path length at which the current motion began.
    from_mm: f64,
}

impl Progress {
    /// Begins a motion after the cycle with a path length; earlier ones are complete. A motion that continues another
    /// one begins at its end, within the next cycle.
    pub(super) fn begin(&mut self, motion: Programmed, s_mm: f64, changed: &mut Changed) {
        let before = changed.driven(self.current);
        self.from_mm = s_mm.max(self.from_mm + before.length_mm);
        self.complete(self.current.blocks, changed);
        self.current = motion;
    }

    /// Marks this number of blocks of the program as executed.
    pub(super) fn complete(&mut self, blocks: u64, changed: &mut Changed) {
        self.done_s += changed.driven(self.current).ideal_s;
        self.current = Programmed { blocks, ..Programmed::default() };
    }

    /// Ends the current motion at a path length before its programmed end.
    pub(super) fn cut(&mut self, s_mm: f64, changed: &Changed) {
        let (blocks, done_s) = self.up_to(s_mm, changed);
        (self.done_s, self.from_mm) = (done_s, s_mm);
        self.current = Programmed { blocks, ..Programmed::default() };
    }

    /// Blocks, and the ideal time in s, up to a path length.
    pub(super) fn up_to(&self, s_mm: f64, changed: &Changed) -> (u64, f64) {
        let Self { done_s, current, from_mm } = self;
        let current = changed.as_driven(*current);
        let share = (s_mm - from_mm) / current.length_mm;
        let part_s = if share > 0.0 { current.ideal_s * share.min(1.0) } else { 0.0 };
        (current.blocks, done_s + part_s)
    }
}

/// Results that are known when the last cycle has been computed and are not part of any record.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Totals {
    /// The program was refused or stopped by an error.
    pub aborted: bool,
    /// The source of the real-time inputs failed.
    pub input_failed: bool,
    /// Exact stops.
    pub stops: Stops,
    /// Number of blocks executed; in a stopped run those up to the motion in which it stopped, with the next one, which
    /// its end depends on.
    pub blocks: u64,
    /// Path length / programmed feed rate for feed blocks, and the way of the slowest axis at its rapid velocity for
    /// rapid blocks, in s: without ramps, corners and limits. Dwells and technology times are not included. A motion in
    /// which the run was stopped, or that ends at a probe signal, counts by its share of the path.
    pub ideal_duration_s: f64,
    /// Parts that the duration does not include (M functions, tool changes, spindle run-up).
    pub not_counted: Vec<String>,
    /// Axes (indices into those of a record) that follow another one, at least for a while: their deviation from the contour
    /// is not measured.
    pub followers: BTreeSet<usize>,
    /// Largest mean delay of the shaping of each axis in cycles.
    pub filter_delay_cycles: Vec<f64>,
    /// Settings used by the Vibration Guard of an axis (index into the axes of a record), in order of occurrence, at
    /// most [`Self::GUARDS_KEPT`].
    pub guards: Vec<(usize, VibGuardSettings)>,
}

impl Totals {
    /// Number of different settings of the Vibration Guard that are kept, since a program may change them without end.
    pub(crate) const GUARDS_KEPT: usize = 100;

    /// Notes the settings of the kernels.
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

    /// Notes an event without motion; returns a message of the program as a note for the log.
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
            | Event::SoftwareLimits { .. }
            | Event::SpindleFeedforward { .. }
            | Event::SpindleAcceleration { .. }
            | Event::SpindleDynamics { .. }
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

/// Time in s of the axis that takes longest for its way at a speed.
fn slowest_s(block: &Block, speed_mm_s: impl Fn(&AxisDynamics) -> f64) -> f64 {
    let ways = block.path.start().iter().zip(block.path.end().iter()).zip(&block.dynamics.axes);
    let times = ways.map(|((from, to), axis)| (to - from).abs() / speed_mm_s(axis));
    times.filter(|t| t.is_finite()).fold(0.0, f64::max)
}
