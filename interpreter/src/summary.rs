//! The summary of a run, accumulated from its columns.
//!
//! Order of calls: a started run, [`Collector::add`] for all its cycles, [`Collector::message`] for each message,
//! [`Collector::finish`]. As the sink of a run a collector does all but the last one.
//!
//! ```
//! use kontur_interpreter::job::{Job, MachineLists};
//! use kontur_interpreter::source::MemorySources;
//! use kontur_interpreter::summary::{Collector, State};
//!
//! let (machine, _) = MachineLists::default().load().unwrap();
//! let sources = MemorySources::new().with("part.nc", "N10 G01 X10 F1000\nN20 M30\n");
//! let mut run = Job::new(machine, sources, "part.nc").start().unwrap();
//! // a collector sees every cycle and every message, and ends with what only the run knows
//! let mut collector = Collector::new(run.facts());
//! let Ok(()) = run.to_end(&mut collector);
//! let summary = collector.finish(&run.totals());
//! assert_eq!(summary.state, State::Finished);
//! assert_eq!(summary.path_length_mm, 10.0);
//! assert!(summary.text().contains("contour error  none"));
//! ```

mod results;
mod ripple;
#[cfg(test)]
mod tests;
mod text;

use crate::diag::Diagnostic;
use crate::job::{Facts, Run, SettledStop, Sink, Totals};
use crate::record::{Asked, AxisRecord, CycleRecord, Quantity, Rest, Rows, SpeedLimit};
use serde::Serialize;
use std::collections::BTreeMap;
use std::convert::Infallible;

pub use results::Measure;
pub use ripple::SpeedRipple;

/// Number of messages that are kept; more are only counted, because a program may repeat a warning without end.
const MESSAGES_KEPT: usize = 1000;

/// Ratio of contour errors up to which they are the same one: that of the first corner of several equal ones is named, whatever
/// their last bits are.
const SAME_ERROR: f64 = 1.0 + 1e-9;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// To the end of the program.
    Finished,
    /// Refused, or stopped by an error.
    Aborted,
}

impl State {
    /// Name in results.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Finished => "finished",
            Self::Aborted => "aborted",
        }
    }
}

/// Largest magnitudes of one axis in mm (deg) and seconds.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct AxisSummary {
    /// Name in the NC program.
    pub name: String,
    /// `mm` or `deg`.
    pub unit: &'static str,
    /// Velocity of the set position.
    pub max_vel: f64,
    /// Acceleration of the set position.
    pub max_acc: f64,
    /// Jerk of the set position.
    pub max_jerk: f64,
    /// Axis error: delay-aligned set minus ipo.
    pub max_err: f64,
    /// Deviation from the contour; `None` for an axis that follows another one, at least for a while: it is no part of the contour.
    pub max_dev: Option<f64>,
    /// Lag: reference minus actual position.
    pub max_lag: f64,
    /// Largest delay of filters or Vibration Guard in cycles.
    pub filter_delay_cycles: f64,
    /// Exact stops.
    pub stops: u64,
    /// The slowest of them; `None` without a stop.
    pub slowest_stop: Option<StopSummary>,
}

/// An exact stop of one axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StopSummary {
    /// Axis.
    pub axis: String,
    /// Program time in seconds at which the actual position was inside the window (t2).
    pub time_s: f64,
    /// Seconds from the set position at its target to the actual position inside the window (t2 - t1).
    pub settling_s: f64,
    /// File of the block that stopped.
    pub file: String,
    /// Line of the file.
    pub line: u32,
    /// N number.
    pub block: Option<u64>,
}

/// The largest contour error and its position.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ContourError {
    /// Length of the shortest vector from the set point to the contour in mm.
    pub mm: f64,
    /// Program time in seconds.
    pub time_s: f64,
    /// File.
    pub file: String,
    /// Line of the file.
    pub line: u32,
    /// N number.
    pub block: Option<u64>,
}

/// The summary of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Program as given by the user.
    pub program: String,
    /// Machine.
    pub machine: String,
    /// Cycle time in microseconds.
    pub cycle_us: u32,
    /// State at the end.
    pub state: State,
    /// Rows of the undecimated trace.
    pub cycles: u64,
    /// Program time of the last row in seconds.
    pub duration_s: f64,
    /// Path / feed in seconds, rapid blocks at the rapid speed of their axes, without ramps, corners and limits.
    pub ideal_duration_s: f64,
    /// Time in seconds of dwells (G04, `#TIME`); part of `stop` in `time_by_v_limit_s`.
    pub dwell_s: f64,
    /// Time in seconds of waits for M, H, S and T functions with declared durations; part of `stop` in
    /// `time_by_v_limit_s`.
    pub technology_s: f64,
    /// Time in seconds for which feedhold or override 0 kept the path at rest.
    pub held_s: f64,
    /// Time in seconds from the end of the last motion until every axis was in its exact-stop window.
    pub arrival_s: f64,
    /// Exact stops of the axes, the first thousand, in the order in which they ended.
    pub stops: Vec<StopSummary>,
    /// Parts that the duration does not include.
    pub not_counted: Vec<String>,
    /// Blocks executed; in a stopped run those up to the motion in which it stopped, with the next one.
    pub blocks: u64,
    /// Length of the path in mm.
    pub path_length_mm: f64,
    /// Deepest dip of the path speed without a corner; `None` if there is none.
    pub speed_ripple: Option<SpeedRipple>,
    /// Path axes in channel order, then spindles.
    pub axes: Vec<AxisSummary>,
    /// Largest contour error; `None` if there was no cycle.
    pub max_contour_error: Option<ContourError>,
    /// Seconds by reason for the speed.
    pub time_by_v_limit_s: BTreeMap<&'static str, f64>,
    /// Messages, the first thousand.
    pub messages: Vec<Diagnostic>,
    /// Messages beyond the first thousand.
    pub messages_omitted: u64,
}

/// Collects a summary.
#[derive(Clone, Debug)]
pub struct Collector {
    facts: Facts,
    axes: Vec<AxisRecord>,
    last: Option<(u64, f64)>,
    cycles: u64,
    /// The first of the largest contour errors, with its cycle and place.
    worst: (f64, u64, u32, u32, Option<u64>),
    /// The largest contour error in mm.
    most_error_mm: f64,
    limits: [u64; SpeedLimit::ALL.len()],
    rests: [u64; Rest::ALL.len()],
    ripple: ripple::Collector,
    messages: Vec<Diagnostic>,
    omitted: u64,
}

impl Collector {
    /// Starts a summary.
    pub fn new(facts: &Facts) -> Self {
        Self {
            facts: facts.clone(),
            axes: vec![AxisRecord::default(); facts.axes.len()],
            last: None,
            cycles: 0,
            worst: (0.0, 0, 0, 0, None),
            most_error_mm: 0.0,
            limits: [0; SpeedLimit::ALL.len()],
            rests: [0; Rest::ALL.len()],
            ripple: ripple::Collector::new(facts),
            messages: Vec::new(),
            omitted: 0,
        }
    }

    /// Axis quantities that it reads.
    pub fn asked() -> Asked {
        Asked::of(&[
            Quantity::Ipo,
            Quantity::Vel,
            Quantity::Acc,
            Quantity::Jerk,
            Quantity::Err,
            Quantity::DevBothWays,
            Quantity::Lag,
        ])
    }

    /// Adds cycles with the columns of [`Self::asked`].
    pub fn add(&mut self, rows: &Rows<'_>) {
        for (i, most) in self.axes.iter_mut().enumerate() {
            let magnitude = |before: f64, quantity| {
                let column = rows.column(i, quantity).iter();
                column.fold(before, |most: f64, x| most.max(x.abs()))
            };
            most.vel = magnitude(most.vel, Quantity::Vel);
            most.acc = magnitude(most.acc, Quantity::Acc);
            most.jerk = magnitude(most.jerk, Quantity::Jerk);
            most.err = magnitude(most.err, Quantity::Err);
            most.lag = magnitude(most.lag, Quantity::Lag);
            let both_ways = rows.column(i, Quantity::DevBothWays).iter();
            most.dev = both_ways.fold(most.dev, |most: f64, x| most.max(*x));
        }
        for (i, cycle) in rows.cycles().iter().enumerate() {
            self.add_whole(cycle, |axis| rows.column(axis, Quantity::Ipo).get(i).copied());
        }
    }

    /// Adds the values of a cycle that do not belong to an axis; `ipo`: interpolated setpoints of the axes.
    fn add_whole(&mut self, record: &CycleRecord, ipo: impl Fn(usize) -> Option<f64>) {
        let error_mm = record.contour_err_mm;
        if self.cycles == 0 || error_mm > self.worst.0 * SAME_ERROR {
            self.worst = (error_mm, record.k, record.file, record.line, record.block);
            self.most_error_mm = error_mm;
        } else if error_mm > self.most_error_mm {
            self.most_error_mm = error_mm;
        }
        // row k covers the time since the previous row; the first row is the start itself
        if let Some((before, _)) = self.last {
            let cycles = record.k.saturating_sub(before);
            if let Some(i) = SpeedLimit::ALL.iter().position(|l| *l == record.path.limit) {
                self.limits[i] += cycles;
            }
            if let Some(i) = Rest::ALL.iter().position(|r| Some(*r) == record.path.rest) {
                self.rests[i] += cycles;
            }
        }
        self.ripple.add(record, ipo, self.facts.cycle_us);
        self.last = Some((record.k, record.path.s_mm));
        self.cycles += 1;
    }

    /// Adds a message.
    pub fn message(&mut self, message: &Diagnostic) {
        if self.messages.len() < MESSAGES_KEPT {
            self.messages.push(message.clone());
        } else {
            self.omitted += 1;
        }
    }

    /// Number of cycles so far.
    pub const fn cycles(&self) -> u64 {
        self.cycles
    }

    /// The summary, completed by totals from the simulation.
    pub fn finish(self, totals: &Totals) -> Summary {
        let facts = self.facts;
        let seconds = |cycles: u64| cycles as f64 * f64::from(facts.cycle_us) / 1e6;
        let (k, path_length_mm) = self.last.unwrap_or_default();
        let (mm, (_, at, file, line, block)) = (self.most_error_mm, self.worst);
        let axes = self.axes.iter().zip(&facts.axes).enumerate();
        let name = |file: u32| facts.files.name(file);
        let rested_s = |rest: Rest| {
            let kinds = Rest::ALL.iter().zip(self.rests);
            kinds.filter(|(r, _)| **r == rest).map(|(_, cycles)| seconds(cycles)).sum()
        };
        let stop = |stop: &SettledStop| StopSummary::of(stop, &facts);
        Summary {
            state: if totals.aborted { State::Aborted } else { State::Finished },
            cycles: self.cycles,
            duration_s: seconds(k),
            ideal_duration_s: totals.ideal_duration_s,
            dwell_s: rested_s(Rest::Dwell),
            technology_s: rested_s(Rest::Technology),
            held_s: rested_s(Rest::Held),
            arrival_s: rested_s(Rest::Arrival),
            stops: totals.stops.first.iter().map(stop).collect(),
            not_counted: totals.not_counted.clone(),
            blocks: totals.blocks,
            path_length_mm,
            speed_ripple: self.ripple.finish(facts.cycle_us),
            axes: axes
                .map(|(i, (most, axis))| AxisSummary {
                    name: axis.name.clone(),
                    unit: axis.unit(),
                    max_vel: most.vel,
                    max_acc: most.acc,
                    max_jerk: most.jerk,
                    max_err: most.err,
                    max_dev: (!totals.followers.contains(&i)).then_some(most.dev),
                    max_lag: most.lag,
                    filter_delay_cycles: totals.filter_delay_cycles.get(i).copied().unwrap_or(0.0),
                    stops: totals.stops.axes.get(&i).map_or(0, |(count, _)| *count),
                    slowest_stop: totals.stops.axes.get(&i).map(|(_, slowest)| stop(slowest)),
                })
                .collect(),
            max_contour_error: (self.cycles > 0).then(|| ContourError {
                mm,
                time_s: seconds(at),
                file: name(file),
                line,
                block,
            }),
            time_by_v_limit_s: SpeedLimit::ALL
                .iter()
                .zip(self.limits)
                .map(|(limit, cycles)| (limit.name(), seconds(cycles)))
                .collect(),
            messages: self.messages,
            messages_omitted: self.omitted,
            program: facts.program,
            machine: facts.machine,
            cycle_us: facts.cycle_us,
        }
    }
}

impl StopSummary {
    fn of(stop: &SettledStop, facts: &Facts) -> Self {
        Self {
            axis: facts.axes.get(stop.axis).map(|a| a.name.clone()).unwrap_or_default(),
            time_s: stop.k as f64 * f64::from(facts.cycle_us) / 1e6,
            settling_s: stop.settling_s,
            file: facts.files.name(stop.source.file),
            line: stop.source.line,
            block: stop.source.block,
        }
    }
}

impl Sink for Collector {
    type Stop = Infallible;

    fn reads(&self) -> Option<Asked> {
        Some(Self::asked())
    }

    fn rows(&mut self, rows: &Rows<'_>) -> Result<(), Infallible> {
        self.add(rows);
        Ok(())
    }

    fn pause(&mut self, run: &mut Run) -> Result<(), Infallible> {
        run.take_diagnostics().iter().for_each(|said| self.message(said));
        Ok(())
    }
}

impl Summary {
    /// One JSON object on one line.
    pub fn json(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}
