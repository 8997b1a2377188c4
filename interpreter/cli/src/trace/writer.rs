//! The writer of a trace file, by its format.

use super::batch::Batch;
use super::csv;
#[cfg(feature = "parquet")]
use super::parquet;
use kontur_interpreter::job::Run;
use std::io;

/// The writer of a file.
#[derive(Debug)]
pub(super) enum Writer {
    Csv(Box<csv::CsvWriter>),
    #[cfg(feature = "parquet")]
    Parquet(Box<parquet::ParquetWriter>),
}

impl Writer {
    pub(super) fn write(&mut self, batch: &Batch) -> io::Result<()> {
        match self {
            Self::Csv(w) => w.write(batch),
            #[cfg(feature = "parquet")]
            Self::Parquet(w) => w.write(batch),
        }
    }

    /// Hands over waiting rows, as far as possible before the end.
    pub(super) fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Csv(w) => w.flush(),
            #[cfg(feature = "parquet")]
            Self::Parquet(w) => w.flush(),
        }
    }

    pub(super) fn finish(self, run: &Run) -> io::Result<()> {
        // only Parquet stores values that are known at the end
        #[cfg(not(feature = "parquet"))]
        let _ = run;
        match self {
            Self::Csv(mut w) => w.finish(),
            #[cfg(feature = "parquet")]
            Self::Parquet(w) => w.finish(run.facts(), &run.totals()),
        }
    }
}
