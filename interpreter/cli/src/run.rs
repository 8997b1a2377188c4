//! `kontur run`: executes a program and writes traces and a summary.

use crate::args::{RunArgs, SummaryForm};
use crate::console::{Console, Progress};
use crate::error::{Error, Exit};
use crate::files::is_standard;
use crate::interrupt::Running;
use crate::request::{OpenError, Opened};
use crate::target::{Target, create_all, keep_apart};
use crate::times;
use crate::trace::Trace;
use kontur_interpreter::job::{Run, Sink, Totals, Work};
use kontur_interpreter::record::{Asked, Rows};
use kontur_interpreter::summary::{Collector, Summary};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::thread::{Builder, available_parallelism};

/// Runs a program.
///
/// # Errors
/// [`Error`] if options, lists or files are wrong, or a trace cannot be written.
pub(crate) fn run(args: &RunArgs, console: &mut Console) -> Result<Exit, Error> {
    let opened = args.simulation.request(&args.program).open();
    let Opened { mut run, reads } = opened.map_err(|e| announce_lists(e, console))?;
    let table = args.times.as_ref().and_then(Option::as_deref);
    let outputs = args.output.iter().map(PathBuf::as_path).chain(table);
    let outputs: Vec<PathBuf> = outputs.map(Path::to_owned).collect();
    keep_apart(&reads.so_far(), &outputs)?;
    let create = |path| Trace::create(path, &args.signals, args.decimate, run.facts(), console);
    let mut traces: Vec<Trace> =
        args.output.iter().map(|path| create(path)).collect::<Result<_, _>>()?;
    let mut table = create_all(table)?.pop();
    let mut summary = (args.summary != SummaryForm::None).then(|| Collector::new(run.facts()));
    if summary.is_none() {
        let shown = traces.iter().any(Trace::shows_deviation);
        run = if shown { run.without_both_ways() } else { run.without_deviation() };
    }
    let mut times = args.times.as_ref().map(|_| times::Collector::new(run.facts()));
    let alone = traces.len() == 1;
    let takes = times.is_some() || !traces.is_empty();
    let of_times = if times.is_some() { times::Collector::asked() } else { Asked::NONE };
    let asked = traces.iter().fold(of_times, |asked, trace| asked.and(trace.asked()));
    let take = |rows: &Rows<'_>| {
        if let Some(times) = &mut times {
            times.add(rows);
        }
        traces.iter_mut().try_for_each(|t| go_on_without(t.write(rows), alone))
    };
    let take = takes.then_some((asked, take));
    let written = drive(&mut run, Shown::ALONE, console, summary.as_mut(), take);
    // a subroutine reached by the run may be one of the outputs
    keep_apart(&reads.so_far(), &outputs)?;
    // every trace is completed even if another one failed
    let finish = |t: Trace| go_on_without(t.finish(&run), alone);
    let finished: Vec<_> = traces.into_iter().map(finish).collect();
    let interrupted = match written {
        Err(e @ Error::Interrupted { .. }) => Some(e),
        other => {
            other?;
            None
        }
    };
    finished.into_iter().collect::<Result<(), _>>()?;
    let mut totals = run.totals();
    totals.aborted |= interrupted.is_some();
    let summary = summary.map(|summary| summary.finish(&totals));
    let mut times = times.map(times::Collector::finish);
    if let (Some(times), Some(table)) = (&times, &mut table) {
        write_times(times, table, outputs.last())?;
    }
    if let Some(times) = times.as_mut().filter(|_| summary.is_some() && !totals.aborted) {
        times::try_out(times, &args.simulation.request(&args.program));
    }
    if let Some(summary) = summary {
        show_summary(args, &summary, times.as_ref(), console)?;
    }
    if let Some(e) = interrupted {
        return Err(e);
    }
    Ok(exit_of(&totals))
}

fn exit_of(totals: &Totals) -> Exit {
    match totals {
        Totals { input_failed: true, .. } => Exit::Io,
        Totals { aborted: true, .. } => Exit::Aborted,
        _ => Exit::Finished,
    }
}

/// Writes the times of all lines to their table; `path` is named if it fails.
fn write_times(
    times: &times::Times,
    table: &mut Target,
    path: Option<&PathBuf>,
) -> Result<(), Error> {
    let mut write = || {
        let text = times.csv().map_err(io::Error::from)?;
        table.file()?.write_all(&text)?;
        table.show()
    };
    let name = || path.map(|path| path.display().to_string()).unwrap_or_default();
    write().map_err(|e: io::Error| Error::io(name(), e))
}

/// Prints the summary, with the times of the blocks if there are any.
fn show_summary(
    args: &RunArgs,
    summary: &Summary,
    times: Option<&times::Times>,
    console: &mut Console,
) -> Result<(), Error> {
    let text = match (args.summary, times) {
        (SummaryForm::Json, Some(times)) => times.json_of(summary),
        (SummaryForm::Json, None) => summary.json(),
        (SummaryForm::Text | SummaryForm::None, times) => {
            summary.text() + &times.map(times::Times::text).unwrap_or_default()
        }
    };
    if args.output.iter().any(|o| is_standard(o)) {
        // stdout is used by the trace
        console.error_text(&text);
        return Ok(());
    }
    console.print(&text)
}

/// Continues with the other outputs where stdout is no longer read.
fn go_on_without(written: Result<(), Error>, alone: bool) -> Result<(), Error> {
    match written {
        Err(Error::ClosedPipe) if !alone => Ok(()),
        other => other,
    }
}

/// The progress of a run on the terminal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shown<'a> {
    /// Label that distinguishes it from others, before its progress.
    pub label: &'a str,
    /// Whether only errors are printed.
    pub errors_only: bool,
}

impl Shown<'_> {
    /// A single run.
    pub(crate) const ALONE: Self = Self { label: "", errors_only: false };
}

/// Runs to the end: passes all cycles to the summary and to `take` if given, with the columns it needs, and every
/// message to the console.
///
/// # Errors
/// The first error of `take`, or [`Error::Interrupted`]; messages raised before it have been printed.
pub(crate) fn drive(
    run: &mut Run,
    shown: Shown<'_>,
    console: &mut Console,
    summary: Option<&mut Collector>,
    take: Option<(Asked, impl FnMut(&Rows<'_>) -> Result<(), Error>)>,
) -> Result<(), Error> {
    let progress = console.progress();
    let _running = Running::start();
    let mut watch = Watch { shown, console, progress, summary, take };
    if available_parallelism().is_ok_and(|cores| cores.get() > 1) {
        run.to_end_on_threads(on_thread, &mut watch)
    } else {
        run.to_end(&mut watch)
    }
}

/// Starts a thread for some work, if possible.
fn on_thread(name: &str, work: Work) -> bool {
    Builder::new().name(name.to_owned()).spawn(work).is_ok()
}

/// A run with an observer that may stop it.
struct Watch<'a, F> {
    shown: Shown<'a>,
    console: &'a mut Console,
    progress: Progress,
    summary: Option<&'a mut Collector>,
    /// The observer, and the columns it needs.
    take: Option<(Asked, F)>,
}

impl<F: FnMut(&Rows<'_>) -> Result<(), Error>> Sink for Watch<'_, F> {
    type Stop = Error;

    fn reads(&self) -> Option<Asked> {
        let of_summary = self.summary.is_some().then(Collector::asked);
        let others = self.take.as_ref().map(|(asked, _)| *asked);
        of_summary.into_iter().chain(others).reduce(Asked::and)
    }

    fn rows(&mut self, rows: &Rows<'_>) -> Result<(), Error> {
        if let Some(summary) = &mut self.summary {
            summary.add(rows);
        }
        self.take.as_mut().map_or(Ok(()), |(_, take)| take(rows))
    }

    fn pause(&mut self, run: &mut Run) -> Result<(), Error> {
        for message in run.take_diagnostics() {
            if let Some(summary) = &mut self.summary {
                summary.message(&message);
            }
            if !self.shown.errors_only || message.is_error() {
                self.progress.suspend(|| self.console.announce(&message));
            }
        }
        let record = run.record();
        let time_s = record.k as f64 * run.facts().cycle_s();
        self.progress
            .show(|| format!("{}t = {time_s:.1} s, line {}", self.shown.label, record.line));
        if Running::is_interrupted() {
            return Err(Error::Interrupted { time_s });
        }
        Ok(())
    }
}

/// Prints the messages of refused lists or inputs and converts the rest into an error.
pub(crate) fn announce_lists(e: OpenError, console: &mut Console) -> Error {
    if let OpenError::Lists(messages) | OpenError::Inputs(messages) = &e {
        for message in messages {
            console.announce(message);
        }
    }
    e.into()
}
