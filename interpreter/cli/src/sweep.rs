//! `kontur sweep`: one program under every combination of parameters, one row per run.
//!
//! The runs share nothing and go over all cores; rows stand in the order of the combinations whatever finishes first. A
//! run that an error ends has its row, with the ID of the error.

pub mod args;
mod columns;
#[cfg(feature = "parquet")]
mod parquet;
mod picture;

use crate::console::Console;
use crate::engine::{Engine, OpenError, Request};
use crate::spectrum::{AmplitudeSpectrum, MOST_SAMPLES};
use crate::summary::{Collector, State, Summary};
use crate::table::Table;
use crate::trace::columns::Column;
use crate::vary::{combinations, settings};
use crate::{Error, Exit};
use args::{Amplitude, SweepArgs};
use columns::Cell;
use rayon::prelude::*;
use std::path::Path;
use std::sync::mpsc;

/// What one run leaves behind.
#[derive(Clone, Debug)]
struct Outcome {
    summary: Summary,
    /// In the order of `--amplitude`; not a number if the run did not get that far.
    amplitudes: Vec<f64>,
}

/// Why there is no outcome.
enum Failure {
    Open(OpenError),
    Usage(String),
}

/// All rows of a sweep.
struct Rows {
    header: Vec<String>,
    cells: Vec<Vec<Cell>>,
}

/// Runs every combination and writes the rows: as a table on stdout, or to each `-o` as CSV, Parquet or picture.
///
/// # Errors
/// [`Error`] if options, lists or files are wrong, or an output cannot be written.
pub fn sweep(args: &SweepArgs, engine: &dyn Engine, console: &mut Console) -> Result<Exit, Error> {
    crate::run::keep_apart(std::slice::from_ref(&args.program), &args.output)?;
    let combinations = combinations(&args.vary)?;
    let outcomes = outcomes(args, &combinations, engine, console)?;
    let rows = columns::rows(args, &combinations, &outcomes)?;
    let (standard, files): (Vec<_>, Vec<_>) =
        args.output.iter().partition(|o| o.as_os_str() == crate::files::STANDARD);
    if args.output.is_empty() || !standard.is_empty() {
        console.print(&rows.table().csv())?;
    }
    for output in files {
        write(output, args, &combinations, &outcomes, &rows)?;
    }
    let all_aborted = outcomes.iter().all(|o| o.summary.state == State::Aborted);
    Ok(if all_aborted { Exit::Aborted } else { Exit::Finished })
}

fn write(
    output: &Path,
    args: &SweepArgs,
    combinations: &[Vec<usize>],
    outcomes: &[Outcome],
    rows: &Rows,
) -> Result<(), Error> {
    let is = |end: &str| output.extension().is_some_and(|e| e.eq_ignore_ascii_case(end));
    let to_error = |e| Error::io(output.display().to_string(), e);
    if is("parquet") {
        #[cfg(feature = "parquet")]
        return parquet::write(output, rows).map_err(to_error);
        #[cfg(not(feature = "parquet"))]
        return Err(Error::Usage(format!(
            "{}: built without Parquet, use a .csv file",
            output.display()
        )));
    }
    let text = if is("svg") {
        picture::draw(args, combinations, outcomes, rows)?
    } else {
        rows.table().csv()
    };
    std::fs::write(output, text).map_err(to_error)
}

impl Rows {
    fn table(&self) -> Table {
        let mut table = Table::new(&self.header.iter().map(String::as_str).collect::<Vec<_>>());
        for row in &self.cells {
            table.push(row.iter().map(Cell::text).collect());
        }
        table
    }
}

/// Runs everything, with a count of what is done on the terminal.
fn outcomes(
    args: &SweepArgs,
    combinations: &[Vec<usize>],
    engine: &dyn Engine,
    console: &mut Console,
) -> Result<Vec<Outcome>, Error> {
    let mut progress = console.progress();
    let mut done: Vec<Option<Outcome>> = vec![None; combinations.len()];
    let mut failed: Option<(usize, Failure)> = None;
    std::thread::scope(|scope| {
        let (send, receive) = mpsc::channel();
        scope.spawn(move || {
            combinations.par_iter().enumerate().for_each_with(send, |send, (i, combination)| {
                let mut request = args.simulation.request(&args.program);
                request.settings.extend(settings(&args.vary, combination));
                // the receiver lives until the last sender is gone
                let _ = send.send((i, one(args, &request, engine)));
            });
        });
        for (count, (i, outcome)) in receive.into_iter().enumerate() {
            progress.show(|| format!("{} of {} runs", count + 1, combinations.len()));
            match outcome {
                Ok(outcome) => done[i] = Some(outcome),
                // the first combination that fails, not the first to say so
                Err(e) if failed.as_ref().is_none_or(|(first, _)| i < *first) => {
                    failed = Some((i, e));
                }
                Err(_) => {}
            }
        }
    });
    drop(progress);
    match failed {
        None => Ok(done.into_iter().flatten().collect()),
        Some((_, Failure::Usage(text))) => Err(Error::Usage(text)),
        Some((i, Failure::Open(e))) => {
            console.error_text(&settings(&args.vary, &combinations[i]).join(" "));
            Err(crate::run::announce_lists(e, args.simulation.diagnostics, console))
        }
    }
}

/// One run.
fn one(args: &SweepArgs, request: &Request, engine: &dyn Engine) -> Result<Outcome, Failure> {
    let mut source = engine.open(request).map_err(Failure::Open)?;
    let facts = source.facts().clone();
    let cycle_s = f64::from(facts.cycle_us) / 1e6;
    let mut wanted: Vec<(&Amplitude, Column, Vec<f64>)> = Vec::new();
    for amplitude in &args.amplitude {
        let column = amplitude.column(&facts).map_err(Failure::Usage)?;
        wanted.push((amplitude, column, Vec::new()));
    }
    let mut summary = Collector::new(&facts);
    let mut messages = source.take_diagnostics();
    while let Some(record) = source.next_cycle() {
        summary.add(record);
        for (amplitude, column, samples) in &mut wanted {
            if amplitude.holds(record.k as f64 * cycle_s) && samples.len() < MOST_SAMPLES {
                samples.push(column.number(record).unwrap_or_default());
            }
        }
        if record.k.is_multiple_of(1024) {
            messages.extend(source.take_diagnostics());
        }
    }
    messages.extend(source.take_diagnostics());
    for message in &messages {
        summary.message(message);
    }
    let amplitudes = wanted.iter().map(|(amplitude, _, samples)| {
        let whole =
            amplitude.window_s.is_none_or(|(_, end)| summary.cycles() as f64 * cycle_s > end);
        let peak =
            AmplitudeSpectrum::of(samples, cycle_s).peak(amplitude.band_hz).filter(|_| whole);
        peak.map_or(f64::NAN, |p| p[1])
    });
    let amplitudes = amplitudes.collect();
    Ok(Outcome { summary: summary.finish(&source.totals()), amplitudes })
}
