//! The summary of a run, accumulated from its records.

mod ripple;

use crate::times::Times;
use kontur_interpreter::diag::{Diagnostic, Severity};
use kontur_interpreter::job::{Facts, SettledStop, Totals};
use kontur_interpreter::record::{AxisRecord, CycleRecord, Rest, SpeedLimit};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

pub use ripple::SpeedRipple;

/// More messages than this are counted and no longer kept: a program may repeat a warning without end.
const MESSAGES_KEPT: usize = 1000;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// To the end of the program.
    Finished,
    /// Refused, or stopped by an error.
    Aborted,
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
    /// Deviation from the contour.
    pub max_dev: f64,
    /// Lag: reference minus actual position.
    pub max_lag: f64,
    /// Largest delay of filters or Vibration Guard in cycles.
    pub filter_delay_cycles: f64,
    /// Exact stops.
    pub stops: u64,
    /// The slowest of them; none without a stop.
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
    /// File of the block whose stop it was.
    pub file: String,
    /// Line of the file.
    pub line: u32,
    /// N number.
    pub block: Option<u64>,
}

/// Where the contour error was largest.
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

/// What a run was like.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Program as the user named it.
    pub program: String,
    /// Machine.
    pub machine: String,
    /// Cycle time in microseconds.
    pub cycle_us: u32,
    /// How it ended.
    pub state: State,
    /// Rows of the undecimated trace.
    pub cycles: u64,
    /// Program time of the last row in seconds.
    pub duration_s: f64,
    /// Path / feed in seconds, rapid blocks at the rapid speed of their axes, without ramps, corners and limits.
    pub ideal_duration_s: f64,
    /// Time in seconds for which the path dwelt (G04, `#TIME`); part of `stop` in `time_by_v_limit_s`.
    pub dwell_s: f64,
    /// Time in seconds for which the path waited for M, H and S functions as long as the lists declare; part of `stop` in
    /// `time_by_v_limit_s`.
    pub technology_s: f64,
    /// Time in seconds for which feedhold or override 0 kept the path at rest.
    pub held_s: f64,
    /// Time in seconds from the end of the last motion until every axis was in its exact-stop window.
    pub arrival_s: f64,
    /// Exact stops of the axes, the first thousand, in the order in which they ended.
    pub stops: Vec<StopSummary>,
    /// What the duration does not contain.
    pub not_counted: Vec<String>,
    /// Blocks decoded.
    pub blocks: u64,
    /// Length of the path in mm.
    pub path_length_mm: f64,
    /// Deepest dip of the path speed without a corner; none if it never dipped.
    pub speed_ripple: Option<SpeedRipple>,
    /// Path axes in channel order, then spindles.
    pub axes: Vec<AxisSummary>,
    /// Largest contour error; none if there was no cycle.
    pub max_contour_error: Option<ContourError>,
    /// Seconds by what held the speed down.
    pub time_by_v_limit_s: BTreeMap<&'static str, f64>,
    /// Messages, the first thousand.
    pub messages: Vec<Diagnostic>,
    /// Messages beyond the first thousand.
    pub messages_omitted: u64,
}

/// Collects a summary, record by record.
#[derive(Clone, Debug)]
pub struct Collector {
    facts: Facts,
    axes: Vec<AxisRecord>,
    last: Option<(u64, f64)>,
    cycles: u64,
    worst: (f64, u64, u32, u32, Option<u64>),
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
            limits: [0; SpeedLimit::ALL.len()],
            rests: [0; Rest::ALL.len()],
            ripple: ripple::Collector::new(facts),
            messages: Vec::new(),
            omitted: 0,
        }
    }

    /// Adds a cycle.
    pub fn add(&mut self, record: &CycleRecord) {
        for (most, axis) in self.axes.iter_mut().zip(&record.axes) {
            most.vel = most.vel.max(axis.vel.abs());
            most.acc = most.acc.max(axis.acc.abs());
            most.jerk = most.jerk.max(axis.jerk.abs());
            most.err = most.err.max(axis.err.abs());
            most.dev = most.dev.max(axis.dev_both_ways);
            most.lag = most.lag.max(axis.lag.abs());
        }
        if self.cycles == 0 || record.contour_err_mm > self.worst.0 {
            let place = (record.contour_err_mm, record.k, record.file, record.line, record.block);
            self.worst = place;
        }
        // row k stands for the time since the row before; the first row is the start itself
        if let Some((before, _)) = self.last {
            let cycles = record.k.saturating_sub(before);
            if let Some(i) = SpeedLimit::ALL.iter().position(|l| *l == record.path.limit) {
                self.limits[i] += cycles;
            }
            if let Some(i) = Rest::ALL.iter().position(|r| Some(*r) == record.path.rest) {
                self.rests[i] += cycles;
            }
        }
        self.ripple.add(record, self.facts.cycle_us);
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

    /// The summary, with what only the simulation knows.
    pub fn finish(self, totals: &Totals) -> Summary {
        let facts = self.facts;
        let seconds = |cycles: u64| cycles as f64 * f64::from(facts.cycle_us) / 1e6;
        let (k, path_length_mm) = self.last.unwrap_or_default();
        let (mm, at, file, line, block) = self.worst;
        let axes = self.axes.iter().zip(&facts.axes).enumerate();
        let name = |file: u32| facts.files.name(file);
        let rested_s = |rest: Rest| {
            let kinds = Rest::ALL.iter().zip(self.rests);
            kinds.filter(|(r, _)| **r == rest).map(|(_, cycles)| seconds(cycles)).sum()
        };
        let stop = |stop: &SettledStop| StopSummary {
            axis: facts.axes.get(stop.axis).map(|a| a.name.clone()).unwrap_or_default(),
            time_s: seconds(stop.k),
            settling_s: stop.settling_s,
            file: name(stop.source.file),
            line: stop.source.line,
            block: stop.source.block,
        };
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
                    max_dev: most.dev,
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

fn many(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

impl Summary {
    /// One JSON object on one line; with times it has them as `times`.
    pub fn json(&self, times: Option<&Times>) -> String {
        #[derive(Serialize)]
        struct WithTimes<'a> {
            #[serde(flatten)]
            summary: &'a Summary,
            #[serde(skip_serializing_if = "Option::is_none")]
            times: Option<serde_json::Value>,
        }
        let object = WithTimes { summary: self, times: times.map(Times::json) };
        serde_json::to_string(&object).unwrap_or_default()
    }

    /// The readable form.
    pub fn text(&self) -> String {
        let mut out = String::new();
        // writing to a String cannot fail
        let _ = self.write_text(&mut out);
        out
    }

    fn write_text(&self, out: &mut String) -> std::fmt::Result {
        let state = if self.state == State::Finished { "finished" } else { "aborted" };
        writeln!(out, "{}  {state}", self.program)?;
        let cycle_ms = f64::from(self.cycle_us) / 1000.0;
        writeln!(out, "  machine        {}, cycle {cycle_ms} ms", self.machine)?;
        writeln!(out, "  duration       {:.3} s ({} cycles)", self.duration_s, self.cycles)?;
        writeln!(out, "  ideal          {:.3} s (path / feed)", self.ideal_duration_s)?;
        if self.dwell_s > 0.0 {
            writeln!(out, "  dwells         {:.3} s", self.dwell_s)?;
        }
        if self.technology_s > 0.0 {
            let text = "M, H and S functions, by their declared durations";
            writeln!(out, "  technology     {:.3} s ({text})", self.technology_s)?;
        }
        if self.held_s > 0.0 {
            writeln!(out, "  held           {:.3} s (feedhold or override 0)", self.held_s)?;
        }
        if self.arrival_s > 0.0 {
            let text = "end of the last motion until the axes were in position";
            writeln!(out, "  arrival        {:.3} s ({text})", self.arrival_s)?;
        }
        for what in &self.not_counted {
            writeln!(out, "  not counted    {what}")?;
        }
        writeln!(out, "  path           {:.4} mm in {} blocks", self.path_length_mm, self.blocks)?;
        if let Some(ripple) = &self.speed_ripple {
            let (low, high) = (ripple.v_min_mm_s, ripple.v_max_mm_s);
            let place = self.place(&ripple.file, ripple.line, None);
            let percent = 100.0 * ripple.ratio;
            writeln!(
                out,
                "  speed ripple   {percent:.2} %: {low:.4} of {high:.4} mm/s at {place} (corners above {} deg left out)",
                ripple::CORNER_DEG
            )?;
        }
        if let Some(worst) = self.max_contour_error.as_ref().filter(|worst| worst.mm > 0.0) {
            let place = self.place(&worst.file, worst.line, worst.block);
            writeln!(
                out,
                "  contour error  at most {:.6} mm at t = {:.6} s, {place}",
                worst.mm, worst.time_s
            )?;
        } else if self.max_contour_error.is_some() {
            writeln!(out, "  contour error  none")?;
        }
        if self.cycles > 0 {
            self.write_axes(out)?;
        }
        if self.duration_s > 0.0 {
            write!(out, "  speed held by ")?;
            let mut shares: Vec<(&str, f64)> =
                self.time_by_v_limit_s.iter().map(|(name, s)| (*name, *s)).collect();
            if let Some((_, stop)) =
                shares.iter_mut().find(|(name, _)| *name == SpeedLimit::Stop.name())
            {
                *stop -= self.dwell_s + self.technology_s;
            }
            shares.push((Rest::Dwell.name(), self.dwell_s));
            shares.push((Rest::Technology.name(), self.technology_s));
            shares.retain(|(_, s)| *s > 0.5e-9);
            shares.sort_by(|a, b| b.1.total_cmp(&a.1));
            for (i, (name, seconds)) in shares.iter().enumerate() {
                let comma = if i > 0 { ", " } else { "" };
                write!(out, "{comma}{name} {:.1} %", 100.0 * seconds / self.duration_s)?;
            }
            writeln!(out)?;
        }
        let count = |severity| self.messages.iter().filter(|m| m.severity == severity).count();
        let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
        if errors + warnings > 0 || self.messages_omitted > 0 {
            write!(
                out,
                "  messages       {}, {}",
                many(errors, "error"),
                many(warnings, "warning")
            )?;
            if self.messages_omitted > 0 {
                write!(out, " and {} more", self.messages_omitted)?;
            }
            writeln!(out)?;
        }
        Ok(())
    }

    /// `line 4, N40`, and the file if it is not the program.
    fn place(&self, file: &str, line: u32, block: Option<u64>) -> String {
        let block = block.map_or_else(String::new, |n| format!(", N{n}"));
        let of = if file == self.program { String::new() } else { format!(" of {file}") };
        format!("line {line}{block}{of}")
    }

    fn write_axes(&self, out: &mut String) -> std::fmt::Result {
        writeln!(
            out,
            "  {:<6} {:>12} {:>12} {:>14} {:>11} {:>11} {:>11} {:>10}",
            "axis", "|vel| /s", "|acc| /s2", "|jerk| /s3", "|err|", "|dev|", "|lag|", "delay"
        )?;
        for a in &self.axes {
            let delay_ms = a.filter_delay_cycles * f64::from(self.cycle_us) / 1000.0;
            writeln!(
                out,
                "  {:<6} {:>12.4} {:>12.3} {:>14.1} {:>11.6} {:>11.6} {:>11.6} {:>7.2} ms",
                format!("{} {}", a.name, a.unit),
                a.max_vel,
                a.max_acc,
                a.max_jerk,
                a.max_err,
                a.max_dev,
                a.max_lag,
                delay_ms
            )?;
        }
        for a in &self.axes {
            if let Some(slowest) = &a.slowest_stop {
                let place = self.place(&slowest.file, slowest.line, slowest.block);
                writeln!(
                    out,
                    "  settling {:<5} {}, t2 - t1 at most {:.3} s at t = {:.3} s, {place}",
                    a.name,
                    many(usize::try_from(a.stops).unwrap_or(usize::MAX), "stop"),
                    slowest.settling_s,
                    slowest.time_s
                )?;
            }
        }
        Ok(())
    }
}
