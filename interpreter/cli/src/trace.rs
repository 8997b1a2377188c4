//! The trace: columns and their files.

mod background;
pub(crate) mod batch;
pub(crate) mod csv;
pub(crate) mod fixed;
#[cfg(feature = "parquet")]
pub(crate) mod parquet;
mod writer;

use crate::console::Console;
use crate::error::Error;
use crate::files::STANDARD;
use crate::target::Target;
use background::Background;
use batch::Numbers;
use kontur_interpreter::job::{Facts, Run};
use kontur_interpreter::record::columns::{self, Column};
use kontur_interpreter::record::{Asked, Rows};
use std::io;
use std::path::{Path, PathBuf};
use writer::Writer;

/// One trace file.
#[derive(Debug)]
pub(crate) struct Trace {
    path: PathBuf,
    way: Way,
    decimate: u64,
    shows_deviation: bool,
    asked: Asked,
}

/// The path of the records to their file.
#[derive(Debug)]
enum Way {
    /// By a separate thread.
    Thread(Background),
    /// The thread has ended with an error.
    Ended(Writer),
    /// The reader is gone.
    Closed,
}

impl Trace {
    /// Begins the file, `-` is stdout; it gets its name with its first rows (CSV) or when it is complete (Parquet).
    ///
    /// # Errors
    /// [`Error::Usage`] for an unknown signal, [`Error::Io`] if the file cannot be created.
    pub(crate) fn create(
        path: &Path,
        signals: &str,
        decimate: u64,
        facts: &Facts,
        console: &Console,
    ) -> Result<Self, Error> {
        let columns = select(signals, facts)?;
        let shows_deviation = columns.iter().any(Column::shows_deviation);
        let asked = columns::asked(&columns);
        let is = |end: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(end));
        if is("html") || is("svg") {
            let message = format!(
                "{}: a trace must be CSV or Parquet; use `kontur report` to write pages and pictures",
                path.display()
            );
            return Err(Error::Usage(message));
        }
        let is_parquet = is("parquet");
        #[cfg(not(feature = "parquet"))]
        if is_parquet {
            let message = format!("{}: built without Parquet, use a .csv file", path.display());
            return Err(Error::Usage(message));
        }
        let name = if path.as_os_str() == STANDARD { "stdout".into() } else { path.to_owned() };
        let to_error = |e| Error::io(name.display().to_string(), e);
        let numbers = Numbers::of(&columns);
        let csv = |target| {
            let rows = csv::Rows::new(&columns, facts);
            Writer::Csv(Box::new(csv::CsvWriter::new(target, rows)))
        };
        let writer = if path.as_os_str() == STANDARD {
            csv(csv::Target::Standard(console.output()))
        } else {
            let target = Target::create(path).map_err(to_error)?;
            match is_parquet {
                #[cfg(feature = "parquet")]
                true => {
                    let writer = parquet::ParquetWriter::new(path, target, &columns, facts);
                    Writer::Parquet(Box::new(writer.map_err(to_error)?))
                }
                _ => csv(csv::Target::File(target)),
            }
        };
        let way = Way::Thread(Background::start(writer, numbers).map_err(to_error)?);
        Ok(Self { path: name, way, decimate: decimate.max(1), shows_deviation, asked })
    }

    /// Whether a column needs the deviation from the contour.
    pub(crate) const fn shows_deviation(&self) -> bool {
        self.shows_deviation
    }

    /// Axis quantities that its columns need.
    pub(crate) const fn asked(&self) -> Asked {
        self.asked
    }

    /// Adds one of every `decimate` cycles.
    ///
    /// # Errors
    /// [`Error::Io`], e.g. for a full disk, about these or earlier cycles.
    pub(crate) fn write(&mut self, rows: &Rows<'_>) -> Result<(), Error> {
        let Way::Thread(thread) = &mut self.way else { return Ok(()) };
        let decimate = usize::try_from(self.decimate).unwrap_or(usize::MAX);
        let shown = rows.from_multiple_of(self.decimate);
        if thread.write(&shown, decimate) { Ok(()) } else { self.end() }
    }

    /// Ends the thread.
    fn end(&mut self) -> Result<(), Error> {
        let Way::Thread(thread) = std::mem::replace(&mut self.way, Way::Closed) else {
            return Ok(());
        };
        let ended = thread.end().and_then(|(writer, written)| {
            self.way = Way::Ended(writer);
            written
        });
        ended.map_err(|e| error(&self.path, e))
    }

    /// Completes the file; without a record it is not written.
    ///
    /// # Errors
    /// As [`Trace::write`].
    pub(crate) fn finish(mut self, run: &Run) -> Result<(), Error> {
        let ended = self.end();
        let finished = match self.way {
            Way::Ended(writer) => writer.finish(run).map_err(|e| error(&self.path, e)),
            Way::Thread(_) | Way::Closed => Ok(()),
        };
        ended.and(finished)
    }
}

/// The columns selected by `--signals`.
///
/// # Errors
/// [`Error::Usage`] for an unknown word.
pub(crate) fn select(signals: &str, facts: &Facts) -> Result<Vec<Column>, Error> {
    columns::select(signals, facts).map_err(|e| Error::Usage(format!("--signals: {e}")))
}

fn error(path: &Path, e: io::Error) -> Error {
    if e.kind() == io::ErrorKind::BrokenPipe {
        Error::ClosedPipe
    } else {
        Error::io(path.display().to_string(), e)
    }
}
