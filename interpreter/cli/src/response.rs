//! `kontur response`: the effect of filters, shapers and whole axis chains on a signal, as table and picture.
//!
//! Four views: frequency response (magnitude, phase, group delay), step response, residual vibration of a machine
//! driven through a shaper, and the contour at a 90 degree corner.
//!
//! Order of calls: arguments and a console, then the table, then its picture.
//!
//! ```
//! use clap::Parser as _;
//! use kontur::args::{Args, Command};
//! use kontur::console::Console;
//!
//! let words = ["kontur", "response", "--guard", "FREQ=40"];
//! let Command::Response(args) = Args::try_parse_from(words)?.command else { unreachable!() };
//! let mut console = Console::new(std::io::sink(), std::io::sink());
//! let table = kontur::response::table(&args, &mut console).unwrap();
//! assert_eq!(table.header()[..2], ["curve", "f_hz"]);
//! # Ok::<(), clap::Error>(())
//! ```
//!
#![doc = include_str!("../docs/figures.md")]

mod axis;
mod curve;
mod describe;
mod select;
mod view;

use crate::args::ResponseArgs;
use crate::console::Console;
use crate::error::{Error, Exit};
use crate::table::Table;
use std::path::Path;
use view::Answer;

/// Computes one view of all curves and writes it: a table on stdout, or to each `-o` a table (`.csv`) or a picture
/// (`.svg`).
///
/// # Errors
/// [`Error`] if a filter cannot be designed, a view does not suit a curve, or an output cannot be written.
pub fn response(args: &ResponseArgs, console: &mut Console) -> Result<Exit, Error> {
    for output in &args.output {
        kind(output)?;
    }
    crate::target::keep_apart(&[], &args.output)?;
    let view = answer(args, console)?;
    if args.output.is_empty() {
        console.print(&view.table.csv())?;
    }
    let text = |output: &Path| {
        Ok(match kind(output)? {
            Kind::Table => view.table.csv(),
            Kind::Picture => view.plot.draw(),
        })
    };
    let texts: Vec<String> = args.output.iter().map(|o| text(o)).collect::<Result<_, Error>>()?;
    let files = args.output.iter().zip(&texts);
    let files: Vec<(&Path, &[u8])> =
        files.map(|(o, text)| (o.as_path(), text.as_bytes())).collect();
    crate::target::write(&files)?;
    Ok(Exit::Finished)
}

/// The numbers of one view of all curves.
///
/// # Errors
/// [`Error`] if a filter cannot be designed, or a view does not suit a curve.
pub fn table(args: &ResponseArgs, console: &mut Console) -> Result<Table, Error> {
    Ok(answer(args, console)?.table)
}

fn answer(args: &ResponseArgs, console: &mut Console) -> Result<Answer, Error> {
    let (curves, cycle) = select::curves(args, console)?;
    view::view(args, &curves, cycle)
}

/// Content of an output file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Table,
    Picture,
}

fn kind(output: &Path) -> Result<Kind, Error> {
    let is = |end: &str| output.extension().is_some_and(|e| e.eq_ignore_ascii_case(end));
    if is("csv") {
        Ok(Kind::Table)
    } else if is("svg") {
        Ok(Kind::Picture)
    } else {
        let name = output.display();
        Err(Error::Usage(format!(
            "-o {name}: a response must be a table (.csv) or a picture (.svg)"
        )))
    }
}
