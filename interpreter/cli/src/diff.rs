//! `kontur diff`: two traces, or a trace and a fresh run, row by row.
//!
//! Positions may differ by 1e-6 mm, a hundredth of the vendor's increment of 0.1 um; speeds by that divided by 1 ms,
//! and so on for every further derivative. Neither trace is ever held in memory.
//!
//! With `--map` B is a recording of a machine ([`recording`]).

mod compare;
mod delay;
#[cfg(feature = "parquet")]
mod parquet;
mod recording;
mod table;
mod text;
mod verdict;

use crate::args::{DiffArgs, OutputForm};
use crate::console::Console;
use crate::error::{Error, Exit};
use crate::files::is_standard;
use compare::Comparison;
use serde::Serialize;
use std::path::{Path, PathBuf};
use table::Table;
use text::text;
use verdict::Verdict;

/// Compares; exit code 0 if equal, 1 if different or if a program that was run has ended with an error.
///
/// # Errors
/// [`Error`] if a trace cannot be read or a program cannot be run.
pub(crate) fn diff(args: &DiffArgs, console: &mut Console) -> Result<Exit, Error> {
    are_files([&args.a, &args.b])?;
    let is_a = table::is_trace(&args.a)?;
    let is_b = args.map.is_empty() && table::is_trace(&args.b)?;
    if is_a
        && (is_b || !args.map.is_empty())
        && let Some(option) = args.simulation.given()
    {
        let text = format!("{option}: both files are traces, there is nothing to run");
        return Err(Error::Usage(text));
    }
    if args.map.is_empty() {
        diff_rows(args, [is_a, is_b], console)
    } else {
        diff_recording(args, is_a, console)
    }
}

/// A trace, or the rows of a fresh run, if possible with the given columns.
fn open(
    path: &Path,
    is_trace: bool,
    like: Option<&[String]>,
    (args, console): (&DiffArgs, &mut Console),
) -> Result<Table, Error> {
    if is_trace {
        return Table::read(path);
    }
    let opened = args.simulation.request(path).open();
    let opened = opened.map_err(|e| crate::run::announce_lists(e, console))?;
    Table::run(opened.run, like)
}

/// A, a trace or a program, against the recording of a machine.
fn diff_recording(args: &DiffArgs, is_a: bool, console: &mut Console) -> Result<Exit, Error> {
    let names = [args.a.display().to_string(), args.b.display().to_string()];
    let mut a = open(&args.a, is_a, Some(&recording::columns(&args.map)), (args, console))?;
    let outcome = recording::compare(&mut a, &args.b, &args.map, args.rate, args.tolerance);
    for message in a.take_messages() {
        console.announce(&message);
    }
    let outcome = match outcome {
        // what cannot be compared is a consequence of the messages
        Err(Error::Usage(_)) if a.has_failed() => return Ok(Exit::Aborted),
        outcome => outcome?,
    };
    let aborted = failed(&names, [a.has_failed(), false]);
    let program = (!is_a).then_some(args.a.as_path());
    let verdict = || recording::verdict(&outcome, program);
    let words = || recording::text(&names, &outcome);
    let done = Done { names: &names, outcome: &outcome, equal: outcome.equal, aborted };
    done.report(args.format, words, verdict, console)
}

/// Two traces or programs, row by row; a fresh run produces the columns of the trace that it is compared with.
fn diff_rows(
    args: &DiffArgs,
    [is_a, is_b]: [bool; 2],
    console: &mut Console,
) -> Result<Exit, Error> {
    let names = [args.a.display().to_string(), args.b.display().to_string()];
    let (mut a, mut b) = if is_a || !is_b {
        let a = open(&args.a, is_a, None, (args, console))?;
        let b = open(&args.b, is_b, Some(a.header()), (args, console))?;
        (a, b)
    } else {
        let b = open(&args.b, is_b, None, (args, console))?;
        (open(&args.a, is_a, Some(b.header()), (args, console))?, b)
    };
    let every = align(&mut a, &mut b)?;
    let mut progress = console.progress();
    let mut comparison = Comparison::new(a.header(), b.header(), args.tolerance);
    while comparison.next(a.next()?, b.next()?) {
        if comparison.rows().is_multiple_of(4096) {
            progress.show(|| format!("{} rows", comparison.rows()));
        }
    }
    drop(progress);
    for message in a.take_messages().iter().chain(&b.take_messages()) {
        console.announce(message);
    }
    let aborted = failed(&names, [a.has_failed(), b.has_failed()]);
    let outcome = comparison.finish(every);
    let program = [(is_a, &args.a), (is_b, &args.b)].into_iter().find(|(trace, _)| !trace);
    let verdict = || verdict::of(&outcome, program.map(|(_, path)| path.as_path()));
    let done = Done { names: &names, outcome: &outcome, equal: outcome.equal, aborted };
    done.report(args.format, || text(&names, &outcome), verdict, console)
}

/// Thins out the side whose rows are a fraction of the time of the other's apart, as where one trace was written with
/// `--decimate`; returns of how many rows of each side one is compared.
fn align(a: &mut Table, b: &mut Table) -> Result<[u64; 2], Error> {
    let (Some([start_a, next_a]), Some([start_b, next_b])) = (a.first_times()?, b.first_times()?)
    else {
        return Ok([1, 1]);
    };
    let steps = [next_a - start_a, next_b - start_b];
    let ratio = steps[0].max(steps[1]) / steps[0].min(steps[1]);
    let whole = ratio.round();
    // times have six digits
    let fits = (start_a - start_b).abs() < 1e-9 && (ratio - whole).abs() < 1e-6 * whole;
    if !fits || !(2.0..1e9).contains(&whole) {
        return Ok([1, 1]);
    }
    let every = whole as u64;
    if steps[0] < steps[1] {
        a.thin(every);
        Ok([every, 1])
    } else {
        b.thin(every);
        Ok([1, every])
    }
}

/// The names of the runs that have failed.
fn failed(names: &[String; 2], runs: [bool; 2]) -> Vec<&str> {
    names.iter().zip(runs).filter_map(|(name, failed)| failed.then_some(name.as_str())).collect()
}

/// Refuses the standard input.
fn are_files(paths: [&PathBuf; 2]) -> Result<(), Error> {
    if paths.into_iter().any(|path| is_standard(path)) {
        let text = "diff compares files: `-`, the standard input, has no name to tell a trace from a program";
        return Err(Error::Usage(text.to_owned()));
    }
    Ok(())
}

/// A completed comparison.
struct Done<'a, O> {
    names: &'a [String; 2],
    outcome: &'a O,
    equal: bool,
    /// Programs that were run and have ended with an error: even a trace that agrees is not that of a finished program.
    aborted: Vec<&'a str>,
}

impl<O: Serialize> Done<'_, O> {
    fn report(
        &self,
        format: OutputForm,
        text: impl FnOnce() -> String,
        verdict: impl FnOnce() -> Verdict,
        console: &mut Console,
    ) -> Result<Exit, Error> {
        let [a, b] = self.names;
        let verdict = || {
            let mut verdict = verdict();
            self.aborted.iter().for_each(|program| verdict.aborted(program));
            verdict
        };
        let printed = match format {
            OutputForm::Text => {
                let ended = self
                    .aborted
                    .iter()
                    .map(|program| format!("{program} was refused, or ended with an error\n"));
                text() + &ended.collect::<String>()
            }
            OutputForm::Json => {
                let (aborted, result) = (&self.aborted, self.outcome);
                serde_json::json!({ "a": a, "b": b, "aborted": aborted, "result": result })
                    .to_string()
            }
            OutputForm::Junit => verdict().junit(self.names),
            OutputForm::Github => verdict().github(self.names),
        };
        console.print(&printed)?;
        let passed = self.equal && self.aborted.is_empty();
        Ok(if passed { Exit::Finished } else { Exit::Aborted })
    }
}
