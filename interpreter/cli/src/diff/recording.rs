//! A trace or a fresh run against a recording of a machine, such as an export of TwinCAT Scope.
//!
//! The recording has its own names, units, signs, sampling times and start. The user gives names and units
//! ([`Pairing`]); the shift in time is determined: the one at which the speeds of all paired signals correlate best,
//! then refined below one cycle. Where the recording has no samples nothing is compared.

mod shift;
mod signals;

use super::table::Table;
use super::verdict::{Failure, Signal, Verdict};
use crate::args::{Pairing, Tolerance};
use crate::error::Error;
use crate::recorded::{self, DropOut};
use serde::Serialize;
use signals::{MOST_CYCLES, Recorded, Trace, rows, statistics};
use std::ops::RangeInclusive;
use std::path::Path;

/// Number of drop-outs listed individually.
const MOST_NAMED: usize = 10;
/// Finest difference of positions that a recording can resolve, in mm or deg: one increment of the control, 0.1 um.
const FLOOR_MM: f64 = 1e-4;

/// The comparison of one pair of signals.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct PairOutcome {
    /// Column of the trace.
    pub(super) column: String,
    /// Channel of the recording.
    pub(super) channel: String,
    /// Factor of the channel.
    pub(super) factor: f64,
    /// Rows compared.
    pub(super) rows: usize,
    /// Rows that differ by more than the tolerance.
    pub(super) different: usize,
    /// Largest difference that counts as equal.
    pub(super) tolerance: f64,
    /// Mean of recording - trace: an offset of the zero points.
    pub(super) mean: f64,
    /// Root mean square of the difference without that mean.
    pub(super) rms: f64,
    /// First row that differs.
    pub(super) first: Option<At>,
    /// Row with the largest difference.
    pub(super) worst: Option<At>,
    /// Stretches without samples.
    pub(super) drop_outs: Vec<DropOut>,
    /// Whether the trace moves where the recording has no samples.
    pub(super) trace_goes_on: bool,
    /// Whether the recording moves where the trace has no rows.
    pub(super) recording_goes_on: bool,
}

/// One row.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct At {
    /// Time of the trace in s.
    pub(super) time_s: f64,
    /// NC line.
    pub(super) line: Option<String>,
    /// Value of the trace.
    pub(super) a: f64,
    /// Value of the recording, times its factor.
    pub(super) b: f64,
}

/// The result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Outcome {
    /// Every pair agrees over the whole motion.
    pub(super) equal: bool,
    /// Cycles by which the recording begins before the trace (negative: after it).
    pub(super) shift_cycles: f64,
    /// Cycle of the trace in s.
    pub(super) cycle_s: f64,
    /// Each pair.
    pub(super) pairs: Vec<PairOutcome>,
}

/// Compares.
///
/// # Errors
/// [`Error::Usage`] for columns or channels that do not exist, and signals too long or too short to be compared.
pub(super) fn compare(
    trace: &mut Table,
    path: &Path,
    pairings: &[Pairing],
    rate_hz: Option<f64>,
    tolerance: Tolerance,
) -> Result<Outcome, Error> {
    let name = path.display().to_string();
    let recorded = signals::channels(&recorded::read(path)?, pairings, rate_hz, &name)?;
    let trace = signals::read(trace, pairings)?;
    let wrong = |text: String| Err(Error::Usage(text));
    let Some(cycle_s) = shift::cycle_of(&trace.times_s) else {
        return wrong("the trace has fewer than three rows with increasing times".to_owned());
    };
    let longest = recorded.iter().map(|r| r.end_s() / cycle_s).fold(0.0, f64::max);
    if trace.times_s.len() > MOST_CYCLES || longest > MOST_CYCLES as f64 {
        return wrong(format!("signals of more than {MOST_CYCLES} cycles are not compared"));
    }
    let shift_cycles = shift::find(&trace, &recorded, cycle_s);
    let pairs: Vec<PairOutcome> = pairings
        .iter()
        .enumerate()
        .map(|(i, p)| {
            let tolerance = permitted(&p.column, tolerance, cycle_s);
            pair(p, (&trace, i), &recorded[i], shift_cycles * cycle_s, tolerance)
        })
        .collect();
    Ok(Outcome { equal: pairs.iter().all(PairOutcome::agrees), shift_cycles, cycle_s, pairs })
}

/// The tolerance of the user, but never finer than one increment and its differences.
fn permitted(column: &str, asked: Tolerance, cycle_s: f64) -> f64 {
    let floor = Tolerance {
        mm: FLOOR_MM,
        mm_s: FLOOR_MM / cycle_s,
        mm_s2: FLOOR_MM / (cycle_s * cycle_s),
        mm_s3: FLOOR_MM / (cycle_s * cycle_s * cycle_s),
        other: 0.0,
    };
    let of = |t: Tolerance| t.of(column).unwrap_or_default();
    of(asked).max(of(floor))
}

fn pair(
    p: &Pairing,
    (trace, column): (&Trace, usize),
    recorded: &Recorded,
    shift_s: f64,
    tolerance: f64,
) -> PairOutcome {
    let (times_s, a) = (&trace.times_s, &trace.columns[column]);
    let found = statistics(times_s, a, recorded, shift_s);
    let mut outcome = PairOutcome {
        column: p.column.clone(),
        channel: p.channel.clone(),
        factor: p.factor,
        rows: found.rows,
        different: 0,
        tolerance,
        mean: found.mean,
        rms: found.rms,
        first: None,
        worst: None,
        drop_outs: recorded.drop_outs.clone(),
        trace_goes_on: false,
        recording_goes_on: false,
    };
    let mut size = tolerance;
    for (row, a, b) in rows(times_s, a, recorded, shift_s) {
        if (b - a).abs() <= tolerance {
            continue;
        }
        let at = || Some(At { time_s: times_s[row], line: trace.line(row), a, b });
        outcome.different += 1;
        if outcome.first.is_none() {
            outcome.first = at();
        }
        if (b - a).abs() > size {
            (size, outcome.worst) = ((b - a).abs(), at());
        }
    }
    if found.rows > 0 {
        let leaves = |values: &[f64], at: f64| values.iter().any(|x| (x - at).abs() > tolerance);
        let [rows, samples] = common(times_s, recorded, shift_s);
        let b = &recorded.values;
        let goes_on = |x: &[f64], common: RangeInclusive<usize>| {
            let (first, last) = (*common.start(), *common.end());
            leaves(&x[..first], x[first]) || leaves(&x[last + 1..], x[last])
        };
        outcome.trace_goes_on = goes_on(a, rows);
        outcome.recording_goes_on = goes_on(b, samples);
    }
    outcome
}

/// The rows and samples in the time that both signals cover, plus one interval at either end: nothing is known about
/// the signal between its first or last sample and the neighbouring one that is missing.
fn common(times_s: &[f64], recorded: &Recorded, shift_s: f64) -> [RangeInclusive<usize>; 2] {
    let (rows, samples) = (times_s.len() - 1, recorded.values.len() - 1);
    let place = |row: usize| recorded.place(times_s[row] - times_s[0] + shift_s);
    let (first, last) = (place(0), place(rows));
    let cycle = (last - first) / rows as f64;
    let interval = cycle.max(1.0) + 1e-6;
    let row = |at: f64| ((at - first) / cycle).clamp(0.0, rows as f64);
    let sample = |at: f64| at.clamp(0.0, samples as f64);
    [
        row(-interval).ceil() as usize..=row(samples as f64 + interval).floor() as usize,
        sample(first - interval).ceil() as usize..=sample(last + interval).floor() as usize,
    ]
}

/// Columns that a comparison needs.
pub(super) fn columns(pairings: &[Pairing]) -> Vec<String> {
    let mut names = vec!["t_s".to_owned(), "line".to_owned()];
    names.extend(pairings.iter().map(|p| p.column.clone()));
    names
}

/// The verdict on every pair; `program` is the program that ran for the trace.
pub(super) fn verdict(outcome: &Outcome, program: Option<&Path>) -> Verdict {
    let signal = |p: &PairOutcome| {
        let mut details = Vec::new();
        for (name, at) in [("first", &p.first), ("worst", &p.worst)] {
            details.extend(at.as_ref().map(|at| format!("{name}: {}", at.sentence())));
        }
        details.extend(p.goes_on().map(str::to_owned));
        let message = match p.rows {
            0 => "nothing to compare".to_owned(),
            rows => {
                let (different, tolerance) = (p.different, p.tolerance);
                format!("{different} of {rows} rows differ by more than {tolerance:e}")
            }
        };
        let line = p.first.as_ref().and_then(|at| at.line.as_ref()?.parse().ok());
        let place = program.zip(line).map(|(file, line)| (file.display().to_string(), line));
        let failure = (!p.agrees()).then_some(Failure { message, details, place });
        Signal { name: format!("{} = {}", p.column, p.channel), failure }
    };
    Verdict { signals: outcome.pairs.iter().map(signal).collect() }
}

impl PairOutcome {
    fn agrees(&self) -> bool {
        self.rows > 0 && self.different == 0 && !self.trace_goes_on && !self.recording_goes_on
    }

    /// The sides that move after the end of the other.
    fn goes_on(&self) -> impl Iterator<Item = &'static str> {
        let trace = self.trace_goes_on.then_some("A moves where B has no samples");
        let recording = self.recording_goes_on.then_some("B moves where A has no rows");
        trace.into_iter().chain(recording)
    }
}

impl At {
    fn sentence(&self) -> String {
        let line = self.line.as_ref().map_or_else(String::new, |l| format!(", line {l}"));
        format!("t = {:.6} s{line}: {:.7} in A, {:.7} in B", self.time_s, self.a, self.b)
    }
}

/// The result as text.
pub(super) fn text(names: &[String; 2], outcome: &Outcome) -> String {
    let mut out = String::new();
    // writing to a String cannot fail
    let _ = write_text(&mut out, names, outcome);
    out
}

fn write_text(
    out: &mut impl std::fmt::Write,
    [a, b]: &[String; 2],
    o: &Outcome,
) -> std::fmt::Result {
    let verdict = if o.equal { "equal" } else { "different" };
    writeln!(out, "{verdict}: {a} (A) and the recording {b} (B)")?;
    let shift_s = o.shift_cycles.abs() * o.cycle_s;
    let cycles = format!("{:.2}", o.shift_cycles.abs());
    let cycles = cycles.trim_end_matches('0').trim_end_matches('.');
    let side = if o.shift_cycles > 0.0 { "before" } else { "after" };
    if o.shift_cycles.abs() > 0.0 {
        writeln!(out, "  shift  B begins {cycles} cycles ({shift_s:.6} s) {side} A")?;
    } else {
        writeln!(out, "  shift  none")?;
    }
    for p in &o.pairs {
        let factor =
            if (p.factor - 1.0).abs() > 0.0 { format!("{}*", p.factor) } else { String::new() };
        writeln!(out, "  {} = {factor}{}", p.column, p.channel)?;
        writeln!(
            out,
            "    {} rows compared, {} differ by more than {:e}; mean {:.3e}, rms around it {:.3e}",
            p.rows, p.different, p.tolerance, p.mean, p.rms
        )?;
        for (name, at) in [("first", &p.first), ("worst", &p.worst)] {
            if let Some(at) = at {
                writeln!(out, "    {name}  {}", at.sentence())?;
            }
        }
        for drop_out in p.drop_outs.iter().take(MOST_NAMED) {
            let count = drop_out.samples.len();
            let samples = if count == 1 { "sample" } else { "samples" };
            writeln!(
                out,
                "    drop-out  {count} {samples} missing after {:.6} s of B: not compared",
                drop_out.after_s
            )?;
        }
        if let Some(more) = p.drop_outs.len().checked_sub(MOST_NAMED + 1) {
            writeln!(out, "    drop-outs  {} more", more + 1)?;
        }
        for words in p.goes_on() {
            writeln!(out, "    {words}")?;
        }
    }
    Ok(())
}
