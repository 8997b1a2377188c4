//! The trace: columns, and the files they go to.

pub mod columns;
pub mod csv;
pub mod fixed;

pub use columns::DEFAULT_SIGNALS;

use crate::Error;
use crate::engine::Facts;
use kontur_interpreter::record::CycleRecord;
use std::fs::File;
use std::path::{Path, PathBuf};

/// One trace file.
#[derive(Debug)]
pub struct Trace {
    path: PathBuf,
    writer: csv::CsvWriter,
    decimate: u64,
}

impl Trace {
    /// Creates the file and writes the header.
    ///
    /// # Errors
    /// [`Error::Usage`] for an unknown signal or file type, [`Error::Io`] if the file cannot be created.
    pub fn create(path: &Path, signals: &str, decimate: u64, facts: &Facts) -> Result<Self, Error> {
        let columns = columns::select(signals, facts).map_err(Error::Usage)?;
        if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet")) {
            let message = format!("{}: built without Parquet, use a .csv file", path.display());
            return Err(Error::Usage(message));
        }
        let file = File::create(path).map_err(|e| Error::io(path.display().to_string(), e))?;
        let writer = csv::CsvWriter::new(file, csv::Rows::new(columns, facts));
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
        self.writer.write(record).map_err(|e| Error::io(self.path.display().to_string(), e))
    }

    /// Brings everything to the file.
    ///
    /// # Errors
    /// As [`Trace::write`].
    pub fn finish(mut self) -> Result<(), Error> {
        self.writer.flush().map_err(|e| Error::io(self.path.display().to_string(), e))
    }
}
