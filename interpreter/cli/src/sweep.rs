//! `kontur sweep`: one program under every combination of parameters, one row per run.
//!
//! The runs are independent and use all cores; the rows are in the order of the combinations, whichever run ends first.
//! A run that ends with an error has a row with the ID of the error.
//!
//! The command line calls [`sweep()`]; a caller that distributes the runs uses a [`Plan`] and computes its rows in any
//! order.
//!
//! ```
//! use clap::Parser as _;
//! use kontur::args::{Args, Command};
//! use kontur::sweep::Plan;
//!
//! let program = "../../programs/square_corner.nc";
//! let words = ["kontur", "sweep", program, "--vary", "X.getriebe[0].kv=3000,5000"];
//! let Command::Sweep(args) = Args::try_parse_from(words)?.command else { unreachable!() };
//! let plan = Plan::new(args).unwrap();
//! assert_eq!((plan.len(), plan.keys().collect::<Vec<_>>()), (2, vec!["X.getriebe[0].kv"]));
//! # Ok::<(), clap::Error>(())
//! ```

mod columns;
mod idle;
mod journal;
mod one;
#[cfg(feature = "parquet")]
mod parquet;
mod picture;
mod plan;
mod rows;

use crate::args::{SweepArgs, Vary};
use crate::combinations::{combinations, put, settings};
use crate::console::Console;
use crate::error::{Error, Exit};
use crate::interrupt::Running;
use crate::request::{OpenError, Opened};
use crate::target::{Target, create_all, keep_apart};
use idle::{idle, is_finished, is_there};
use journal::Journal;
use kontur_interpreter::diag::Severity;
use one::{Failure, row};
pub use plan::Plan;
use rayon::prelude::*;
pub use rows::Row;
use rows::Rows;
use std::collections::BTreeSet;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::mpsc;

/// The column with the parameters without effect, if there are any; a shard always has it.
pub const WITHOUT_EFFECT: &str = "without_effect";
/// The message about such a parameter.
pub const NO_DIFFERENCE: &str = "all values give the same results in these columns; the program sets its own value, the value is not used, or it affects other results";

/// Runs every combination and writes the rows: as a table on stdout, or to each `-o` as CSV, Parquet or picture.
///
/// A stopped sweep continues where it stopped: finished rows are kept in a journal next to the first `-o`.
///
/// If no run finishes the exit code is [`Exit::Aborted`], except for a shard, whose job is then done.
///
/// # Errors
/// [`Error`] if options, lists or files are wrong, or an output cannot be written.
pub fn sweep(args: &SweepArgs, console: &mut Console) -> Result<Exit, Error> {
    let mut combinations = combinations(&args.vary)?;
    if let Some(shard) = &args.shard {
        let picture = args.output.iter().find(|o| is(o, "svg"));
        if let Some(picture) = picture {
            let name = picture.display();
            return Err(Error::Usage(format!("-o {name}: a shard has too few rows for a picture")));
        }
        let range = shard.of(combinations.len()).map_err(Error::Usage)?;
        combinations = combinations.drain(range).collect();
    }
    let (standard, files): (Vec<_>, Vec<_>) =
        args.output.iter().partition(|o| crate::files::is_standard(o));
    // a file that cannot be written ends the sweep before its first run
    let (title, reads) = first(args, &combinations, console)?;
    let journal = files.first().map(|path| journal::beside(path));
    let written: Vec<PathBuf> = args.output.iter().cloned().chain(journal.clone()).collect();
    keep_apart(&reads, &written)?;
    let targets = create_all(files.iter().map(|path| path.as_path()))?;
    let mut journal = journal.map(|path| Journal::open(&path, args, &reads)).transpose()?;
    let (rows, reads) = run_all(args, &combinations, journal.as_mut(), console)?;
    // one of the runs may have reached another subroutine
    keep_apart(&reads.into_iter().collect::<Vec<_>>(), &args.output)?;
    let rows = Rows { title, ..rows };
    let without = idle(&args.vary, &combinations, &rows.cells);
    // a shard does not have the rows of the others
    let part = if args.shard.is_some() { "in this part " } else { "" };
    for name in unmeasured(args, &rows) {
        let text =
            format!("--amplitude {name}: none of the runs lasts until the end of this window");
        console.say(Severity::Warning, &text);
    }
    for key in &without {
        console.say(Severity::Note, &format!("{key}: {part}{NO_DIFFERENCE}"));
    }
    // all shards have this column, even if it is empty, so that their headers are equal
    let rows = if without.is_empty() && args.shard.is_none() {
        rows
    } else {
        rows.noting(WITHOUT_EFFECT, &without.join(" "))
    };
    if args.output.is_empty() || !standard.is_empty() {
        console.print(&rows.table().csv())?;
    }
    for (path, mut target) in files.into_iter().zip(targets) {
        write(path, &mut target, args, &combinations, &rows)?;
    }
    if let Some(journal) = journal {
        journal.remove();
    }
    if args.shard.is_some() {
        return Ok(Exit::Finished);
    }
    let any_finished = rows.cells.iter().any(|row| is_finished(&args.vary, row));
    Ok(if any_finished { Exit::Finished } else { Exit::Aborted })
}

/// Amplitudes with a window that no run reaches.
fn unmeasured<'a>(args: &'a SweepArgs, rows: &Rows) -> Vec<&'a str> {
    let missing = |name: &str| {
        let column = rows.header.iter().position(|header| header == name);
        column.is_some_and(|c| rows.cells.iter().all(|row| !is_there(&row[c])))
    };
    let names = args.amplitude.iter().map(|amplitude| amplitude.text.as_str());
    names.filter(|name| !rows.cells.is_empty() && missing(name)).collect()
}

/// Whether the file name has this extension.
fn is(path: &Path, end: &str) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case(end))
}

/// Program and machine of the first combination, and the files read by its run.
fn first(
    args: &SweepArgs,
    combinations: &[Vec<usize>],
    console: &mut Console,
) -> Result<(String, Vec<PathBuf>), Error> {
    let Some(first) = combinations.first() else { return Ok(Default::default()) };
    let mut request = args.simulation.request(&args.program);
    put(&args.vary, first, &mut request);
    match request.open() {
        Ok(Opened { run, reads }) => {
            let facts = run.facts();
            Ok((format!("{}, machine {}", facts.program, facts.machine), reads.so_far()))
        }
        Err(e) => Err(refused(args, first, e, console)),
    }
}

/// The error of a combination that cannot be run.
fn refused(args: &SweepArgs, combination: &[usize], e: OpenError, console: &mut Console) -> Error {
    console.say(Severity::Note, &settings(&args.vary, combination).join(" "));
    crate::run::announce_lists(e, console)
}

fn write(
    output: &Path,
    target: &mut Target,
    args: &SweepArgs,
    combinations: &[Vec<usize>],
    rows: &Rows,
) -> Result<(), Error> {
    let to_error = |e| Error::io(output.display().to_string(), e);
    if is(output, "parquet") {
        #[cfg(feature = "parquet")]
        return target
            .file()
            .and_then(|file| parquet::write(file, rows))
            .and_then(|()| target.show())
            .map_err(to_error);
        #[cfg(not(feature = "parquet"))]
        return Err(Error::Usage(format!(
            "{}: built without Parquet, use a .csv file",
            output.display()
        )));
    }
    let text = if is(output, "svg") {
        picture::draw(args, combinations, rows)?
    } else {
        rows.table().csv()
    };
    target.file().and_then(|file| file.write_all(text.as_bytes())).map_err(to_error)?;
    target.show().map_err(to_error)
}

/// Runs these combinations with progress on the terminal, and enters their rows into the journal; the first one that failed.
fn run_open(
    args: &SweepArgs,
    combinations: &[Vec<usize>],
    open: &[usize],
    mut journal: Option<&mut Journal>,
    console: &mut Console,
    mut take: impl FnMut(usize, Row, Vec<PathBuf>),
) -> Result<Option<(usize, Failure)>, Error> {
    let before = combinations.len() - open.len();
    let mut progress = console.progress();
    let _running = Running::start();
    let mut failed: Option<(usize, Failure)> = None;
    let mut written = Ok(());
    std::thread::scope(|scope| {
        let (send, receive) = mpsc::channel();
        scope.spawn(move || {
            open.par_iter().for_each_with(send, |send, &i| {
                if Running::is_interrupted() {
                    return;
                }
                let row = row(args, &combinations[i]);
                // the receiver exists until the last sender is dropped
                let _ = send.send((i, row));
            });
        });
        for (count, (i, row)) in receive.into_iter().enumerate() {
            progress.show_rest(before + count + 1, combinations.len(), count + 1);
            match row {
                Ok((row, read)) => {
                    if let (Some(journal), Ok(())) = (&mut journal, &written) {
                        written = journal.write(i, &row);
                    }
                    take(i, row, read);
                }
                // the first combination that fails, not the first one to report it
                Err(e) if failed.as_ref().is_none_or(|(first, _)| i < *first) => {
                    failed = Some((i, e));
                }
                Err(_) => {}
            }
        }
    });
    drop(progress);
    written?;
    if Running::is_interrupted() {
        failed = failed.or(Some((0, Failure::Interrupted)));
    }
    Ok(failed)
}

/// Runs the combinations that are not in the journal, with progress on the terminal; returns all rows, and the files
/// that were read for them.
fn run_all(
    args: &SweepArgs,
    combinations: &[Vec<usize>],
    mut journal: Option<&mut Journal>,
    console: &mut Console,
) -> Result<(Rows, BTreeSet<PathBuf>), Error> {
    let mut done: Vec<Option<Row>> = vec![None; combinations.len()];
    for (i, row) in journal.as_mut().map(|j| j.take_rows()).unwrap_or_default() {
        if let Some(place) = done.get_mut(i) {
            *place = Some(row);
        }
    }
    let open: Vec<usize> = (0..done.len()).filter(|i| done[*i].is_none()).collect();
    let before = done.len() - open.len();
    if before > 0 {
        let text =
            format!("continues where it was stopped: {before} of {} runs are complete", done.len());
        console.say(Severity::Note, &text);
    }
    let mut reads = BTreeSet::new();
    let failed = run_open(args, combinations, &open, journal, console, |i, row, read| {
        reads.extend(read);
        done[i] = Some(row);
    })?;
    match failed {
        None => {}
        Some((_, Failure::Interrupted)) => return Err(Error::Stopped),
        Some((_, Failure::Open(OpenError::Usage(text)))) => return Err(Error::Usage(text)),
        Some((i, Failure::Open(e))) => return Err(refused(args, &combinations[i], e, console)),
    }
    let mut rows = Rows { title: String::new(), header: Vec::new(), cells: Vec::new() };
    for (header, cells) in done.into_iter().flatten() {
        rows.header = header;
        rows.cells.push(cells);
    }
    Ok((rows, reads))
}
