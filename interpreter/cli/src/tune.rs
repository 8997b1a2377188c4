//! `kontur tune`: from measurements on a machine to settings that do not excite its vibration.
//!
//! Residual vibration is computed for the kernels of the cycle time, never taken from a table: the vendor's table of
//! permitted deviations normalises the set frequency by the real one, its worked example the other way round. Every
//! answer contains both.
//!
//! Order of calls: arguments and a console, then the answer; the command line prints all of it.
//!
//! ```
//! use clap::Parser as _;
//! use kontur::args::{Args, Command};
//! use kontur::console::Console;
//!
//! let words = ["kontur", "tune", "--freq", "32"];
//! let Command::Tune(args) = Args::try_parse_from(words)?.command else { unreachable!() };
//! let mut console = Console::new(std::io::sink(), std::io::sink());
//! let answer = kontur::tune::answer(&args, &mut console).unwrap();
//! assert!(answer.command.is_some_and(|command| command.contains("FREQ=32")));
//! # Ok::<(), clap::Error>(())
//! ```

mod combined;
mod order;
mod picture;
mod program;
mod proposal;
mod recording;
mod task;
pub mod vibration;

use crate::args::TuneArgs;
use crate::console::Console;
use crate::error::{Error, Exit};
use crate::lists::Lists;
use crate::target::{keep_apart, write};
use kontur_filters::analysis::tuning::VibrationBand;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use recording::Measured;
use std::path::PathBuf;
use task::{Task, median};
use vibration::Estimate;

pub use task::Answer;

/// Answers the question in the arguments.
///
/// # Errors
/// [`Error`] if lists or files are wrong, or no answer is possible.
pub fn tune(args: &TuneArgs, console: &mut Console) -> Result<Exit, Error> {
    Ok(answer(args, console)?.exit)
}

/// Like [`tune`], with the numbers that are printed.
///
/// # Errors
/// As [`tune`].
pub fn answer(args: &TuneArgs, console: &mut Console) -> Result<Answer, Error> {
    let lists = Lists::default();
    let cycle = cycle(args, &lists, console)?;
    let inputs = args.recording.iter().chain(&args.program).cloned();
    let read: Vec<PathBuf> = lists.read_so_far().into_iter().chain(inputs).collect();
    keep_apart(&read, args.output.as_slice())?;
    if let Some(tolerance_mm) = args.order_for {
        return order::answer(tolerance_mm, args.feed, cycle, console);
    }
    let Measured { freqs, damping: measured_damping, others, recordings } =
        if args.recording.is_empty() {
            let exact = |value: &f64| Estimate { value: *value, half_width: 0.0 };
            Measured { freqs: args.freq.iter().map(exact).collect(), ..Measured::default() }
        } else {
            recording::measured(args, console)?
        };
    // the evaluated settings are those of the proposed command
    let damping = args.damping.or(measured_damping.map(rounded));
    let damping = damping.unwrap_or(VibGuardSettings::default().damping);
    let bands_hz: Vec<(f64, f64)> =
        freqs.iter().map(|f| (f.value - f.half_width, f.value + f.half_width)).collect();
    let ends: Vec<f64> = bands_hz.iter().flat_map(|(low, high)| [*low, *high]).collect();
    // the proposal is valid for the whole interval of every measured frequency
    let band = VibrationBand::of(&ends, damping)
        .ok_or_else(|| Error::Usage("no natural frequency to tune for".to_owned()))?;
    let freqs_hz: Vec<f64> = freqs.iter().map(|f| f.value).collect();
    let task = Task {
        bands_hz,
        at_hz: args.at.unwrap_or_else(|| (100.0 * median(&freqs_hz)).round() / 100.0),
        freqs_hz,
        others,
        band,
        limit_ratio: args.max_residual / 100.0,
        feed_mm_min: args.feed,
        max_dev_mm: args.max_dev,
        cycle,
    };
    let rows = task.rows();
    if rows.is_empty() {
        return Err(Error::Usage(task.without_mode()));
    }
    console.print(&task.text(&rows))?;
    let answer = match (&args.program, args.max_dev) {
        (Some(file), Some(max_dev_mm)) => program::answer(&task, args, file, max_dev_mm, console)?,
        _ => task.answer(&rows, console)?,
    };
    // last, because the files read by the program are known now
    if let Some(output) = &args.output {
        write(&[(output, picture::draw(&recordings).as_bytes())])?;
    }
    Ok(answer)
}

/// The cycle of the machine, if one is given, otherwise that of the option.
fn cycle(args: &TuneArgs, lists: &Lists, console: &mut Console) -> Result<CycleTime, Error> {
    let loaded = args.simulation.request("").machine(lists);
    let (machine, messages) = loaded.map_err(|e| crate::run::announce_lists(e, console))?;
    // with a program, its run repeats them
    if args.program.is_none() {
        for message in &messages {
            console.announce(message);
        }
    }
    Ok(machine.cycle)
}

/// A damping ratio as written: measurements give no more digits.
fn rounded(damping: f64) -> f64 {
    (damping * 1e4).round() / 1e4
}
