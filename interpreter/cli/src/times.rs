//! `kontur run --times`: the time of a run by line and by the reason for its speed.
//!
//! Every cycle has one [`Reason`] and belongs to one line, so the times add up to the duration exactly. While the speed
//! changes, the time is attributed to the change: with constant acceleration an axis is at its limit, otherwise the
//! slope builds the acceleration up or reduces it. The limit *for* which the speed changes is that of the trace column
//! `v_limit`.

mod proposals;
mod reason;
mod render;

use kontur_interpreter::job::{Facts, FileNames};
use kontur_interpreter::record::{Asked, CycleRecord, Motion, Quantity, Rows, SpeedLimit};
use serde::Serialize;
use std::collections::{BTreeMap, HashMap};

pub(crate) use proposals::{Proposal, try_out};
pub(crate) use reason::Reason;

/// Number of lines in the readable form and in the summary.
const MOST_EXPENSIVE: usize = 10;

/// Reason, axis (of [`Reason::AxisV`] and [`Reason::AxisA`]), and the limit for which the speed changes.
type Key = (Reason, Option<u8>, SpeedLimit);

/// Cycles of a line.
#[derive(Clone, Debug)]
struct Line {
    place: (u32, u32),
    block: Option<u64>,
    motion: Motion,
    cycles: Vec<(Key, u64)>,
}

/// Smallest and largest value.
type Range = (f64, f64);

fn widen(range: &mut Range, value: f64) {
    *range = (range.0.min(value), range.1.max(value));
}

/// The extremes of one axis.
#[derive(Clone, Copy, Debug)]
struct Reached {
    position: Range,
    velocity: Range,
    acceleration: Range,
    torque: Range,
}

impl Reached {
    const NOTHING: Self = {
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        Self { position: none, velocity: none, acceleration: none, torque: none }
    };

    fn add(&mut self, rows: &Rows<'_>, axis: usize) {
        let column = |quantity| rows.column(axis, quantity).iter();
        column(Quantity::Set).for_each(|x| widen(&mut self.position, *x));
        column(Quantity::Vel).for_each(|x| widen(&mut self.velocity, *x));
        column(Quantity::Acc).for_each(|x| widen(&mut self.acceleration, *x));
        column(Quantity::TorqueNm).for_each(|x| widen(&mut self.torque, *x));
    }
}

/// Collects the times. It takes about 100 bytes for each line that moves or waits.
#[derive(Clone, Debug)]
pub(crate) struct Collector {
    facts: Facts,
    lines: Vec<Line>,
    index: HashMap<(u32, u32), usize>,
    /// Index of the line of the previous cycle.
    current: usize,
    reached: Vec<Reached>,
    /// Interpolated positions of the last cycle and of the two before it.
    ipo: [Vec<f64>; 3],
    last_k: Option<u64>,
}

impl Collector {
    /// Starts the accounting.
    pub(crate) fn new(facts: &Facts) -> Self {
        Self {
            facts: facts.clone(),
            lines: Vec::new(),
            index: HashMap::new(),
            current: 0,
            reached: vec![Reached::NOTHING; facts.axes.len()],
            ipo: [const { Vec::new() }; 3],
            last_k: None,
        }
    }

    /// What it reads of the axes.
    pub(crate) fn asked() -> Asked {
        use Quantity::{Acc, Ipo, Set, TorqueNm, Vel};
        Asked::of(&[Ipo, Set, Vel, Acc, TorqueNm])
    }

    /// Adds cycles with the columns of [`Self::asked`].
    pub(crate) fn add(&mut self, rows: &Rows<'_>) {
        for (axis, reached) in self.reached.iter_mut().enumerate() {
            reached.add(rows, axis);
        }
        for (i, cycle) in rows.cycles().iter().enumerate() {
            self.ipo.rotate_right(1);
            self.ipo[0].clear();
            self.ipo[0].extend((0..rows.axes()).map(|axis| rows.column(axis, Quantity::Ipo)[i]));
            self.add_cycle(cycle);
        }
    }

    fn add_cycle(&mut self, record: &CycleRecord) {
        if let Some(before) = self.last_k {
            let reason = Reason::of(record);
            let axis = match reason {
                Reason::AxisV => self.nearest_to_its_limit(record, false),
                Reason::AxisA => self.nearest_to_its_limit(record, true),
                _ => None,
            };
            // the limit of a constant speed is its reason already
            let changes = matches!(reason, Reason::AxisA | Reason::Slope);
            let towards = if changes { record.path.limit } else { SpeedLimit::Feed };
            let key = (reason, axis, towards);
            self.count(record, key, record.k.saturating_sub(before));
        }
        self.last_k = Some(record.k);
    }

    fn count(&mut self, record: &CycleRecord, key: Key, cycles: u64) {
        let place = (record.file, record.line);
        if self.lines.get(self.current).is_none_or(|line| line.place != place) {
            let next = self.lines.len();
            self.current = *self.index.entry(place).or_insert(next);
            if self.current == next {
                let motion = Motion::None;
                self.lines.push(Line { place, block: record.block, motion, cycles: Vec::new() });
            }
        }
        let line = &mut self.lines[self.current];
        if record.path.rest.is_none() {
            line.motion = record.path.motion;
        }
        match line.cycles.iter_mut().find(|(known, _)| *known == key) {
            Some((_, count)) => *count += cycles,
            None => line.cycles.push((key, cycles)),
        }
    }

    /// The path axis with the largest share of its velocity or acceleration limit; in tapping this may be the spindle.
    fn nearest_to_its_limit(&self, record: &CycleRecord, acceleration: bool) -> Option<u8> {
        let [now, newer, older] = &self.ipo;
        let axes = self.facts.axes.iter().zip(now).enumerate();
        let tapping = record.path.spindle.map(usize::from);
        let shares = axes
            .filter(|(i, (facts, _))| !facts.spindle || tapping == Some(*i))
            .filter_map(|(i, (facts, now))| {
                let step = now - newer.get(i)?;
                let share = if acceleration {
                    (step - (newer.get(i)? - older.get(i)?)).abs() / facts.a_max
                } else {
                    step.abs() / facts.v_max
                };
                Some((i, share))
            });
        let (i, _) = shares.filter(|(_, share)| *share > 0.0).max_by(|a, b| a.1.total_cmp(&b.1))?;
        u8::try_from(i).ok()
    }

    /// What the axes that have moved have reached.
    fn ranges(&self) -> Vec<AxisRange> {
        let axes = self.facts.axes.iter().zip(&self.reached);
        axes.filter(|(_, reached)| reached.position.0.is_finite())
            .map(|(facts, reached)| AxisRange {
                name: facts.name.clone(),
                unit: facts.unit(),
                position: reached.position,
                velocity: reached.velocity,
                acceleration: reached.acceleration,
                torque_n_m: reached.torque,
            })
            .collect()
    }

    /// The times of the run.
    pub(crate) fn finish(self) -> Times {
        let cycle_s = f64::from(self.facts.cycle_us) / 1e6;
        let total: u64 = self.lines.iter().flat_map(|l| &l.cycles).map(|(_, n)| n).sum();
        let name_of = |axis: Option<u8>| {
            let facts = axis.and_then(|i| self.facts.axes.get(usize::from(i)));
            facts.map(|a| a.name.clone())
        };
        let of_cycles = |cycles: &BTreeMap<Key, u64>| -> Vec<TimeByReason> {
            let mut list: Vec<TimeByReason> = cycles
                .iter()
                .map(|((reason, axis, limit), n)| TimeByReason {
                    reason: *reason,
                    axis: name_of(*axis),
                    towards: matches!(reason, Reason::AxisA | Reason::Slope).then(|| limit.name()),
                    seconds: *n as f64 * cycle_s,
                    share: *n as f64 / total.max(1) as f64,
                })
                .collect();
            list.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
            list
        };
        let mut all = BTreeMap::new();
        for (key, n) in self.lines.iter().flat_map(|l| &l.cycles) {
            *all.entry(*key).or_insert(0) += n;
        }
        let mut lines: Vec<TimeOfLine> = self
            .lines
            .iter()
            .map(|line| {
                let cycles: u64 = line.cycles.iter().map(|(_, n)| n).sum();
                TimeOfLine {
                    file: self.facts.files.name(line.place.0),
                    line: line.place.1,
                    block: line.block,
                    kind: line.motion.name(),
                    seconds: cycles as f64 * cycle_s,
                    share: cycles as f64 / total.max(1) as f64,
                    reasons: of_cycles(&line.cycles.iter().copied().collect()),
                    helps: None,
                }
            })
            .collect();
        lines.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
        Times {
            duration_s: total as f64 * cycle_s,
            reasons: of_cycles(&all),
            axes: self.ranges(),
            lines,
            proposals: Vec::new(),
            files: self.facts.files,
        }
    }
}

/// Time of one reason.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct TimeByReason {
    /// The reason.
    pub reason: Reason,
    /// Axis at its limit (`axis_v`, `axis_a`): of several, the one with the largest share of its velocity
    /// (P-AXIS-00212) or acceleration (P-AXIS-00008).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<String>,
    /// Limit for which the speed changes (`axis_a`, `slope`): a value of the trace column `v_limit`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub towards: Option<&'static str>,
    /// Time in s.
    pub seconds: f64,
    /// Share of the duration, 0 to 1.
    pub share: f64,
}

/// Times of one line.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct TimeOfLine {
    /// File.
    pub file: String,
    /// Line of the file; 0: before the first motion.
    pub line: u32,
    /// N number.
    pub block: Option<u64>,
    /// `rapid`, `line`, `arc`, `curve`; `none` if the line only waits.
    pub kind: &'static str,
    /// Time in s.
    pub seconds: f64,
    /// Share of the duration, 0 to 1.
    pub share: f64,
    /// By reason, the longest first.
    pub reasons: Vec<TimeByReason>,
    /// The proposal that saves most here.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub helps: Option<Help>,
}

/// The effect of a proposal on one line.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Help {
    /// The proposal, as in the list of proposals.
    pub what: String,
    /// Time in s by which the line becomes shorter.
    pub saves_s: f64,
}

/// Smallest and largest values of one axis in mm (deg) and s.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct AxisRange {
    /// Name in the NC program.
    pub name: String,
    /// `mm` or `deg`.
    pub unit: &'static str,
    /// Set position.
    pub position: Range,
    /// Velocity of the set position.
    pub velocity: Range,
    /// Acceleration of the set position.
    pub acceleration: Range,
    /// Torque feedforward in Nm (N for linear motors); 0 without one.
    pub torque_n_m: Range,
}

/// The time of a run by reason and by line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Times {
    /// Duration in s.
    pub duration_s: f64,
    /// By reason, the longest first.
    pub reasons: Vec<TimeByReason>,
    /// By line, the longest first.
    pub lines: Vec<TimeOfLine>,
    /// The extremes of the axes.
    pub axes: Vec<AxisRange>,
    /// Proposals, if they were tried; the largest saving first.
    pub proposals: Vec<Proposal>,
    files: FileNames,
}
