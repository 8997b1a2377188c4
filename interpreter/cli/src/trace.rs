//! The trace: columns, and the files they go to.

pub(crate) mod csv;
pub(crate) mod fixed;
#[cfg(feature = "parquet")]
pub(crate) mod parquet;

use crate::Error;
use crate::console::Console;
use crate::files::STANDARD;
use crate::target::Target;
use kontur_interpreter::job::{Facts, Run};
use kontur_interpreter::record::CycleRecord;
use kontur_interpreter::record::columns::{self, Column};
use std::io;
use std::path::{Path, PathBuf};

/// One trace file.
#[derive(Debug)]
pub(crate) struct Trace {
    path: PathBuf,
    writer: Writer,
    decimate: u64,
}

#[derive(Debug)]
enum Writer {
    Csv(csv::CsvWriter),
    #[cfg(feature = "parquet")]
    Parquet(Box<parquet::ParquetWriter>),
    /// Its reader has gone.
    Closed,
}

impl Trace {
    /// Begins the file, `-` is stdout; it gets its name with its first rows (CSV) or when it is finished (Parquet).
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
        let is = |end: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(end));
        if is("html") || is("svg") {
            let message = format!(
                "{}: a trace is CSV or Parquet; `kontur report` writes pages and pictures",
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
        let to_error = |e| Error::io(path.display().to_string(), e);
        let decimate = decimate.max(1);
        if path.as_os_str() == STANDARD {
            let target = csv::Target::Standard(console.output());
            let writer = Writer::Csv(csv::CsvWriter::new(target, csv::Rows::new(columns, facts)));
            return Ok(Self { path: "stdout".into(), writer, decimate });
        }
        let target = Target::create(path).map_err(to_error)?;
        let writer = match is_parquet {
            #[cfg(feature = "parquet")]
            true => {
                let writer = parquet::ParquetWriter::new(path, target, columns, facts);
                Writer::Parquet(Box::new(writer.map_err(to_error)?))
            }
            _ => {
                let rows = csv::Rows::new(columns, facts);
                Writer::Csv(csv::CsvWriter::new(csv::Target::File(target), rows))
            }
        };
        Ok(Self { path: path.to_owned(), writer, decimate })
    }

    /// Adds a record, if it is one of every `decimate`.
    ///
    /// # Errors
    /// [`Error::Io`], e.g. a full disk.
    pub(crate) fn write(&mut self, record: &CycleRecord) -> Result<(), Error> {
        if !record.k.is_multiple_of(self.decimate) {
            return Ok(());
        }
        let written = match &mut self.writer {
            Writer::Csv(w) => w.write(record),
            #[cfg(feature = "parquet")]
            Writer::Parquet(w) => w.write(record),
            Writer::Closed => Ok(()),
        };
        written.map_err(|e| error(&self.path, e))
    }

    /// Writes no more.
    pub(crate) fn close(&mut self) {
        self.writer = Writer::Closed;
    }

    /// Brings everything to the file; without a record none is written.
    ///
    /// # Errors
    /// As [`Trace::write`].
    pub(crate) fn finish(mut self, run: &Run) -> Result<(), Error> {
        let finished = match self.writer {
            Writer::Csv(ref mut w) => w.finish(),
            #[cfg(feature = "parquet")]
            Writer::Parquet(w) => w.finish(run.facts(), &run.totals()),
            Writer::Closed => Ok(()),
        };
        // only Parquet has a place for what is known at the end
        #[cfg(not(feature = "parquet"))]
        let _ = run;
        finished.map_err(|e| error(&self.path, e))
    }
}

/// The columns that `--signals` asks for.
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
