//! `kontur report`: runs programs and draws them as one interactive page or one static picture.
//!
//! Both show the same [`views`]. The page contains its own script: a plotting library would be larger than the data,
//! and none links a point of the contour to its time. With `--signals` the picture shows columns of the trace over
//! time, and their spectra.

mod drawn;
mod page;
mod picture;
mod recording;
mod requests;
mod shown;
mod signals;
mod stops;
mod track;
mod vibration;
mod views;

use crate::args::ReportArgs;
use crate::console::Console;
use crate::error::{Error, Exit};
use crate::files::STANDARD;
use crate::request::{Opened, Request};
use crate::run::{Shown, announce_lists, drive};
use crate::target::keep_apart;
use crate::times;
use drawn::Drawn;
use kontur_interpreter::diag::render::printable;
use kontur_interpreter::record::Rows;
use kontur_interpreter::summary::{Collector, State, Summary};
use page::Beside;
use recording::Recording;
use requests::requests;
use std::collections::BTreeSet;
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// Largest program, in bytes and lines, that a page shows.
const MOST_TEXT_BYTES: u64 = 1 << 19;
const MOST_TEXT_LINES: usize = 5000;

/// Runs every program and writes the page (`.html`) or the picture (`.svg`). An aborted run is drawn up to its stop.
///
/// # Errors
/// [`Error`] if options, lists or files are wrong, or the output cannot be written.
pub(crate) fn report(args: &ReportArgs, console: &mut Console) -> Result<Exit, Error> {
    let output = match (&args.output, args.programs.first()) {
        (Some(output), _) => output.clone(),
        (None, Some(program)) if program.as_os_str() == STANDARD => {
            return Err(Error::Usage("a program from standard input requires -o FILE".to_owned()));
        }
        (None, Some(program)) => program.with_extension("html"),
        (None, None) => return Err(Error::Usage("a program is expected".to_owned())),
    };
    let mut read = args.programs.clone();
    read.extend_from_slice(&args.simulation.input);
    keep_apart(&read, std::slice::from_ref(&output))?;
    if let Some(names) = &args.signals {
        return signals::report(args, names, &output, console);
    }
    let form = form(&output)?;
    let mut runs: Vec<Drawn> = Vec::new();
    let mut beside: Vec<Beside> = Vec::new();
    let mut read_texts = BTreeSet::new();
    for (program, values, request) in requests(args)? {
        // runs of one program are distinguished by the varied values
        let program = if values.is_empty() { program } else { format!("{program}, {values}") };
        let (run, times) = drawn(args, program, &request, &output, console)?;
        // several runs of one program show its text once
        let files = run.recording.facts.files.all();
        let texts =
            files.iter().map(|f| read_texts.insert(f.clone()).then(|| lines_of(f)).flatten());
        let texts = texts.collect();
        beside.push(Beside { times, texts, window: args.window });
        runs.push(run);
    }
    // refused programs cannot be drawn
    if runs.iter().any(|r| r.summary.cycles > 0) {
        let drawn = match form {
            Form::Picture => picture::draw(&runs),
            Form::Page => page::draw(&runs, &beside),
        };
        crate::target::write(&[(&output, drawn.as_bytes())])?;
    }
    let aborted = runs.iter().any(|r| r.summary.state == State::Aborted);
    Ok(if aborted { Exit::Aborted } else { Exit::Finished })
}

/// Runs one program, and records what is drawn of it.
fn drawn(
    args: &ReportArgs,
    program: String,
    request: &Request,
    output: &Path,
    console: &mut Console,
) -> Result<(Drawn, times::Times), Error> {
    let outputs = [output.to_owned()];
    let Opened { mut run, reads } = request.open().map_err(|e| announce_lists(e, console))?;
    keep_apart(&reads.so_far(), &outputs)?;
    let mut summary = Collector::new(run.facts());
    let mut recording = Recording::new(run.facts());
    let mut times = times::Collector::new(run.facts());
    let cycle_s = run.facts().cycle_s();
    let is_drawn = |t: f64| args.window.is_none_or(|(from, to)| t >= from && t <= to);
    let take = |rows: &Rows<'_>| {
        times.add(rows);
        recording.add(&rows.during(|k| is_drawn(k as f64 * cycle_s)));
        Ok(())
    };
    let take = Some((times::Collector::asked().and(Recording::asked()), take));
    drive(&mut run, Shown::ALONE, console, Some(&mut summary), take)?;
    // including the subroutines that the run reached
    keep_apart(&reads.so_far(), &outputs)?;
    recording.finish();
    let totals = run.totals();
    let summary = summary.finish(&totals);
    if let (Some((from, to)), true) = (args.window, summary.cycles > 0)
        && recording.buckets.is_empty()
    {
        let text = format!("--window {from}..{to}: the run ends at {} s", summary.duration_s);
        return Err(Error::Usage(text));
    }
    let summary = Summary { program, ..summary };
    Ok((Drawn { recording, summary, guards: totals.guards }, times.finish()))
}

/// The form of a report.
#[derive(Clone, Copy, Debug)]
enum Form {
    Picture,
    Page,
}

fn form(output: &Path) -> Result<Form, Error> {
    let is = |end: &str| output.extension().is_some_and(|e| e.eq_ignore_ascii_case(end));
    if is("svg") {
        Ok(Form::Picture)
    } else if is("html") || is("htm") {
        Ok(Form::Page)
    } else {
        let name = PathBuf::from(output).display().to_string();
        Err(Error::Usage(format!(
            "{name}: a report must be a page (.html) or a picture (.svg); with --signals also a table (.csv)"
        )))
    }
}

/// The lines of a program, if it is a file and short enough for a page.
fn lines_of(file: &str) -> Option<Vec<String>> {
    let file = crate::files::regular(Path::new(file)).ok()?;
    let mut bytes = Vec::new();
    file.take(MOST_TEXT_BYTES + 1).read_to_end(&mut bytes).ok()?;
    let fits = bytes.len() as u64 <= MOST_TEXT_BYTES;
    let text = String::from_utf8_lossy(&bytes);
    let lines: Vec<String> = text.lines().map(printable).collect();
    (fits && lines.len() <= MOST_TEXT_LINES).then_some(lines)
}
