//! The Parquet writer: the columns of the CSV trace with every bit of the numbers.
//!
//! Numbers are stored as byte streams (all first bytes, all second bytes, ...), which makes smooth curves compressible;
//! lines and block numbers are stored as differences. A dictionary of 64 K different values would cost time and save
//! nothing. The codec is Snappy, which is plain Rust and supported by every reader. Minimum and maximum of a group are
//! stored for the columns by which readers select rows (line, block, words), but not for numbers: finding them costs
//! more than splitting their bytes.
//!
//! Rows are collected ([`columns`]) and encoded in groups ([`numbers`], [`words`], [`chunk`]), which are then only copied
//! ([`file`]).
//!
//! A Parquet file is readable only once its footer is written. So each group that has waited for [`PERIOD`], or that would
//! take too much memory, goes to a separate file in the folder `.NAME.*.parts` beside the target, and the end puts them
//! together without decoding them: what a kill or a full disk leaves is a folder of whole Parquet files, which readers
//! take as one table. A short run is written once and has no parts.

mod chunk;
mod columns;
mod compressor;
mod file;
mod group;
mod numbers;
mod words;

use super::batch::Batch;
use crate::clock::now;
use crate::target::{Target, folder_of};
use ::parquet::file::metadata::KeyValue;
use chunk::Chunk;
use columns::Waiting;
use file::Unfinished;
use group::ROWS_PER_GROUP;
use kontur_interpreter::job::{Facts, Totals};
use kontur_interpreter::record::columns::Column;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Largest buffer that stays allocated when it is free, see [`keep_free_memory`]: more than that of any page.
const KEPT: usize = 16 << 20;

/// Longest time for which a group is only in memory, which bounds the loss after a kill.
const PERIOD: Duration = Duration::from_millis(900);

/// Number of bytes of groups that are only in memory, at most, apart from the last one of them.
const IN_MEMORY: usize = 32 << 20;

/// A Parquet trace.
pub(crate) struct ParquetWriter {
    waiting: Waiting,
    /// Groups that are only in memory.
    groups: Vec<Vec<Chunk>>,
    /// When the first of them was encoded.
    since: Instant,
    target: Target,
    /// Path of the trace.
    path: PathBuf,
    /// Folder of the earlier groups, if there are any.
    folder: Option<TempDir>,
    parts: Vec<PathBuf>,
}

impl std::fmt::Debug for ParquetWriter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ParquetWriter").field("rows", &self.waiting.len()).finish_non_exhaustive()
    }
}

impl ParquetWriter {
    /// Starts a trace.
    ///
    /// # Errors
    /// The system's.
    pub(crate) fn new(
        path: &Path,
        target: Target,
        columns: &[Column],
        facts: &Facts,
    ) -> io::Result<Self> {
        keep_free_memory();
        Ok(Self {
            waiting: Waiting::new(columns, facts)?,
            groups: Vec::new(),
            since: now(),
            target,
            path: path.to_owned(),
            folder: None,
            parts: Vec::new(),
        })
    }

    /// Adds rows.
    ///
    /// # Errors
    /// The system's, e.g. a full disk.
    pub(crate) fn write(&mut self, batch: &Batch) -> io::Result<()> {
        let mut first = 0;
        while first < batch.len() {
            let rows = first..batch.len().min(first + ROWS_PER_GROUP - self.waiting.len());
            first = rows.end;
            self.waiting.take(batch, rows);
            if self.waiting.len() == ROWS_PER_GROUP {
                self.end_group()?;
                let chunks = self.groups.iter().flatten();
                let bytes: usize = chunks.map(|chunk| chunk.pages().len()).sum();
                if bytes > IN_MEMORY {
                    self.write_parts()?;
                }
            }
        }
        self.flush()
    }

    /// Writes the groups that have waited for long.
    ///
    /// # Errors
    /// As [`Self::write`].
    pub(crate) fn flush(&mut self) -> io::Result<()> {
        let late = !self.groups.is_empty() && self.since.elapsed() >= PERIOD;
        if late { self.write_parts() } else { Ok(()) }
    }

    /// Makes a group of the rows that wait.
    fn end_group(&mut self) -> io::Result<()> {
        if self.groups.is_empty() {
            self.since = now();
        }
        self.groups.push(self.waiting.encode()?);
        Ok(())
    }

    /// Writes each group that is only in memory to a separate file.
    fn write_parts(&mut self) -> io::Result<()> {
        for group in std::mem::take(&mut self.groups) {
            self.write_part(&group).map_err(|e| self.kept(e))?;
        }
        Ok(())
    }

    fn write_part(&mut self, group: &[Chunk]) -> io::Result<()> {
        let folder = match self.folder.take() {
            Some(folder) => folder,
            None => folder_beside(&self.path)?,
        };
        let path = folder.path().join(format!("{:06}.parquet", self.parts.len() + 1));
        self.folder = Some(folder);
        // until it is complete it has a name that readers of folders skip
        let unfinished = folder_of(&path).join(format!(".{:06}.part", self.parts.len() + 1));
        let mut file = Unfinished::begin(File::create(&unfinished)?, self.waiting.schema())?;
        file.append(group)?;
        file.finish(self.waiting.properties(), None)?;
        std::fs::rename(&unfinished, &path)?;
        self.parts.push(path);
        Ok(())
    }

    /// Combines everything under the name of the trace; without rows nothing is written.
    ///
    /// # Errors
    /// The system's, e.g. for a full disk; the data written so far stay in the folder stated in the error.
    pub(crate) fn finish(mut self, facts: &Facts, totals: &Totals) -> io::Result<()> {
        if self.waiting.len() > 0 {
            self.end_group()?;
        }
        self.join(facts, totals).map_err(|e| {
            // the groups in memory are kept like the others, if there is room without what was put together
            drop(self.target.file().and_then(|file| file.set_len(0)));
            drop(self.write_parts());
            self.kept(e)
        })
    }

    /// An error that states the folder of the parts, which are kept.
    fn kept(&mut self, e: io::Error) -> io::Error {
        match &mut self.folder {
            Some(folder) if !self.parts.is_empty() => {
                folder.disable_cleanup(true);
                let folder = folder.path().display();
                io::Error::new(e.kind(), format!("{e}; the rows up to there are in {folder}"))
            }
            _ => e,
        }
    }

    /// Copies the parts and adds the groups in memory.
    fn join(&mut self, facts: &Facts, totals: &Totals) -> io::Result<()> {
        if self.parts.is_empty() && self.groups.is_empty() {
            return Ok(());
        }
        let file = self.target.file()?.try_clone()?;
        let mut file = Unfinished::begin(file, self.waiting.schema())?;
        for part in &self.parts {
            file.append_file(part)?;
        }
        for group in &self.groups {
            file.append(group)?;
        }
        let note = |key: &str, value: String| KeyValue::new(key.to_owned(), value);
        let mut notes = vec![
            note("kontur.program", facts.program.clone()),
            note("kontur.machine", facts.machine.clone()),
            note("kontur.cycle_us", facts.cycle_us.to_string()),
        ];
        for (axis, delay) in facts.axes.iter().zip(&totals.filter_delay_cycles) {
            let key = format!("kontur.filter_delay_cycles.{}", axis.name);
            notes.push(note(&key, delay.to_string()));
        }
        file.finish(self.waiting.properties(), Some(notes))?;
        self.target.show()
    }
}

/// Makes the allocator keep the memory of a page for the next one. Every page takes several buffers of half a megabyte.
/// The GNU C library returns such memory to the system at once, which clears it before each use, until a larger buffer
/// has been freed. On other systems this is only an unused buffer.
fn keep_free_memory() {
    drop(std::hint::black_box(Vec::<u8>::with_capacity(KEPT)));
}

/// The folder of the parts of a trace.
fn folder_beside(path: &Path) -> io::Result<TempDir> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut builder = tempfile::Builder::new();
    builder.prefix(&format!(".{name}.")).suffix(".parts").tempdir_in(folder_of(path))
}

#[cfg(test)]
mod tests;
