//! `kontur run`: a program goes in, traces and a summary come out.

use crate::args::{MessageForm, RunArgs, SummaryForm};
use crate::console::{Console, Progress};
use crate::engine::{Engine, OpenError, Source, Totals};
use crate::files::is_standard;
use crate::interrupt::Running;
use crate::summary::Collector;
use crate::target::{self, keep_apart};
use crate::trace::Trace;
use crate::{Error, Exit, render, times};
use kontur_interpreter::diag::Diagnostic;
use std::path::PathBuf;

/// Cycles between two looks at the clock and at new messages.
const LOOK_EVERY: u64 = 1024;

/// Runs a program.
///
/// # Errors
/// [`Error`] if options, lists or files are wrong, or a trace cannot be written.
pub fn run(args: &RunArgs, engine: &mut dyn Engine, console: &mut Console) -> Result<Exit, Error> {
    let form = args.simulation.diagnostics;
    let mut source = engine
        .open(&args.simulation.request(&args.program))
        .map_err(|e| announce_lists(e, form, console))?;
    let table = args.times.iter().flatten();
    let written: Vec<PathBuf> = args.output.iter().chain(table).cloned().collect();
    keep_apart(&source.reads(), &written)?;
    let create = |path| Trace::create(path, &args.signals, args.decimate, source.facts(), console);
    let mut traces: Vec<Trace> =
        args.output.iter().map(|path| create(path)).collect::<Result<_, _>>()?;
    let mut summary = Collector::new(source.facts());
    let mut times = args.times.as_ref().map(|_| times::Collector::new(source.facts()));
    let alone = traces.len() == 1;
    let written = drive(source.as_mut(), console, form, &mut summary, &mut |record| {
        if let Some(times) = &mut times {
            times.add(record);
        }
        traces.iter_mut().try_for_each(|t| match t.write(record) {
            // nobody reads stdout any more: the files go on
            Err(Error::ClosedPipe) if !alone => {
                t.close();
                Ok(())
            }
            other => other,
        })
    });
    // every trace is brought to its file even if another one failed
    let finished: Vec<_> = traces.into_iter().map(|t| t.finish(source.as_ref())).collect();
    let interrupted = match written {
        Err(e @ Error::Interrupted { .. }) => Some(e),
        other => {
            other?;
            None
        }
    };
    finished.into_iter().collect::<Result<(), _>>()?;
    let mut totals = source.totals();
    totals.aborted |= interrupted.is_some();
    let summary = summary.finish(&totals);
    let times = times.map(times::Collector::finish);
    if let (Some(times), Some(Some(path))) = (&times, &args.times) {
        let table = times.csv().map_err(|e| Error::io(path.display().to_string(), e.into()))?;
        target::write(path, &table)?;
    }
    let text = match args.summary {
        SummaryForm::Text => {
            let times = times.map(|t| t.text()).unwrap_or_default();
            Some(summary.text() + &times)
        }
        SummaryForm::Json => Some(summary.json(times.as_ref())),
        SummaryForm::None => None,
    };
    match text {
        // stdout belongs to the trace
        Some(text) if args.output.iter().any(|o| is_standard(o)) => console.error_text(&text),
        Some(text) => console.print(&text)?,
        None => {}
    }
    if let Some(e) = interrupted {
        return Err(e);
    }
    Ok(match totals {
        Totals { input_failed: true, .. } => Exit::Io,
        Totals { aborted: true, .. } => Exit::Aborted,
        _ => Exit::Finished,
    })
}

/// Drives a source to its end: every record to `take` and to the summary, every message to the console.
///
/// # Errors
/// The first error of `take`, or [`Error::Interrupted`]; messages raised up to then have been printed.
pub fn drive(
    source: &mut dyn Source,
    console: &mut Console,
    form: MessageForm,
    summary: &mut Collector,
    take: &mut dyn FnMut(&kontur_interpreter::record::CycleRecord) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut progress = console.progress();
    let cycle_s = f64::from(source.facts().cycle_us) / 1e6;
    let mut result = Ok(());
    let _running = Running::start();
    while let Some(record) = source.next_cycle() {
        summary.add(record);
        result = take(record);
        if result.is_err() {
            break;
        }
        if summary.cycles().is_multiple_of(LOOK_EVERY) {
            let (t, line) = (record.k as f64 * cycle_s, record.line);
            progress.show(|| format!("t = {t:.1} s, line {line}"));
            messages(source, console, form, summary, &progress);
            if Running::is_interrupted() {
                result = Err(Error::Interrupted { time_s: t });
                break;
            }
        }
    }
    messages(source, console, form, summary, &progress);
    result
}

fn messages(
    source: &mut dyn Source,
    console: &mut Console,
    form: MessageForm,
    summary: &mut Collector,
    progress: &Progress,
) {
    for message in source.take_diagnostics() {
        summary.message(&message);
        progress.suspend(|| announce(&message, form, console));
    }
}

/// Prints one message to stderr.
pub fn announce(message: &Diagnostic, form: MessageForm, console: &mut Console) {
    let text = match form {
        MessageForm::Text => render::text(message, console.is_terminal()),
        MessageForm::Json => render::json(message),
    };
    console.error_text(&text);
}

/// Prints the messages of refused lists or inputs and turns the rest into an error.
pub fn announce_lists(e: OpenError, form: MessageForm, console: &mut Console) -> Error {
    if let OpenError::Lists(messages) | OpenError::Inputs(messages) = &e {
        for message in messages {
            announce(message, form, console);
        }
    }
    e.into()
}
