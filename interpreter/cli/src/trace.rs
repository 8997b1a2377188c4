//! The trace: columns, and the files they go to.

pub mod columns;
pub mod csv;
pub mod fixed;
#[cfg(feature = "parquet")]
pub mod parquet;

pub use columns::DEFAULT_SIGNALS;

use crate::Error;
use crate::engine::{Facts, Source};
use kontur_interpreter::record::CycleRecord;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// One trace file.
#[derive(Debug)]
pub struct Trace {
    path: PathBuf,
    writer: Writer,
    decimate: u64,
}

#[derive(Debug)]
enum Writer {
    Csv(csv::CsvWriter),
    #[cfg(feature = "parquet")]
    Parquet(Box<parquet::ParquetWriter>),
}

impl Trace {
    /// Creates the file and writes the header.
    ///
    /// # Errors
    /// [`Error::Usage`] for an unknown signal, [`Error::Io`] if the file cannot be created.
    pub fn create(path: &Path, signals: &str, decimate: u64, facts: &Facts) -> Result<Self, Error> {
        let columns = columns::select(signals, facts).map_err(Error::Usage)?;
        let is_parquet = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet"));
        #[cfg(not(feature = "parquet"))]
        if is_parquet {
            let message = format!("{}: built without Parquet, use a .csv file", path.display());
            return Err(Error::Usage(message));
        }
        let to_error = |e| Error::io(path.display().to_string(), e);
        let file = File::create(path).map_err(to_error)?;
        let writer = match is_parquet {
            #[cfg(feature = "parquet")]
            true => {
                let writer = parquet::ParquetWriter::new(file, columns, facts).map_err(to_error)?;
                Writer::Parquet(Box::new(writer))
            }
            _ => Writer::Csv(csv::CsvWriter::new(file, csv::Rows::new(columns, facts))),
        };
        Ok(Self { path: path.to_owned(), writer, decimate: decimate.max(1) })
    }

    /// Adds a record, if it is one of every `decimate`.
    ///
    /// # Errors
    /// [`Error::Io`], e.g. a full disk.
    pub fn write(&mut self, record: &CycleRecord) -> Result<(), Error> {
        if !record.k.is_multiple_of(self.decimate) {
            return Ok(());
        }
        let written = match &mut self.writer {
            Writer::Csv(w) => w.write(record),
            #[cfg(feature = "parquet")]
            Writer::Parquet(w) => w.write(record),
        };
        written.map_err(|e| self.error(e))
    }

    /// Brings everything to the file.
    ///
    /// # Errors
    /// As [`Trace::write`].
    pub fn finish(self, source: &dyn Source) -> Result<(), Error> {
        let name = self.path.display().to_string();
        let finished = match self.writer {
            Writer::Csv(mut w) => w.flush(),
            #[cfg(feature = "parquet")]
            Writer::Parquet(w) => w.finish(source.facts(), &source.totals()),
        };
        // only Parquet has a place for what is known at the end
        #[cfg(not(feature = "parquet"))]
        let _ = source;
        finished.map_err(|e| Error::io(name, e))
    }

    fn error(&self, e: io::Error) -> Error {
        Error::io(self.path.display().to_string(), e)
    }
}
