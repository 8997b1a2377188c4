//! The Parquet writer: the columns of the CSV trace with every bit of the numbers.
//!
//! Numbers are stored as byte streams (all first bytes, all second bytes, ...), which makes smooth curves compressible;
//! lines and block numbers are stored as differences. A dictionary of 64 K different values would cost time and save
//! nothing. The codec is Snappy, which is plain Rust and supported by every reader. Minimum and maximum of a group are
//! stored for the columns by which readers select rows (time, line, block, words), but not for other numbers: finding
//! them costs more than splitting their bytes.
//!
//! A Parquet file is readable only once its footer is written. So each group of rows goes to a separate file in the folder
//! `.NAME.*.parts` beside the target, and the end puts them together without decoding them: what a kill or a full disk
//! leaves is a folder of whole Parquet files, which readers take as one table. The last group goes to the target at once: most
//! traces are written once and have no parts.

use super::batch::{Batch, Head};
use crate::target::{Target, folder_of};
use ::parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as Physical};
use ::parquet::column::writer::ColumnCloseResult;
use ::parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::{EnabledStatistics, WriterProperties};
use ::parquet::file::reader::{FileReader as _, SerializedFileReader};
use ::parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use ::parquet::schema::types::{ColumnPath, Type};
use bytes::Bytes;
use kontur_interpreter::job::{Facts, FileNames, Totals};
use kontur_interpreter::record::SpeedLimit;
use kontur_interpreter::record::columns::{Column, Content};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

/// Number of rows that are collected before they are written.
const ROWS_PER_GROUP: usize = 65_536;

/// Number of bytes handed to the system at once.
const PIECE: usize = 1 << 20;

/// Largest buffer that stays allocated when it is free, see [`keep_free_memory`]: more than that of any page.
const KEPT: usize = 16 << 20;

/// The values of one column waiting to be written.
#[derive(Debug)]
enum Values {
    Number(Vec<f64>),
    Integer(Vec<i64>),
    /// Integers that may be missing, with a 1 for each one present.
    Optional(Vec<i64>, Vec<i16>),
    Word(Vec<ByteArray>),
}

impl Values {
    fn clear(&mut self) {
        match self {
            Self::Number(v) => v.clear(),
            Self::Integer(v) => v.clear(),
            Self::Optional(v, present) => {
                v.clear();
                present.clear();
            }
            Self::Word(v) => v.clear(),
        }
    }
}

/// A Parquet trace.
pub(crate) struct ParquetWriter {
    columns: Vec<(Column, Values)>,
    rows: usize,
    cycle_us: u64,
    files: FileNames,
    limits: Vec<(SpeedLimit, ByteArray)>,
    schema: Arc<Type>,
    properties: Arc<WriterProperties>,
    target: Target,
    /// Path of the trace.
    path: PathBuf,
    /// Folder of the earlier groups, if there are any.
    folder: Option<TempDir>,
    parts: Vec<PathBuf>,
}

impl std::fmt::Debug for ParquetWriter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ParquetWriter").field("rows", &self.rows).finish_non_exhaustive()
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
        columns: Vec<Column>,
        facts: &Facts,
    ) -> io::Result<Self> {
        keep_free_memory();
        let mut properties = WriterProperties::builder()
            .set_created_by(concat!("kontur ", env!("CARGO_PKG_VERSION")).to_owned())
            .set_compression(Compression::SNAPPY)
            .set_statistics_enabled(EnabledStatistics::Chunk)
            // a group has one page per column, which needs no index
            .set_offset_index_disabled(true)
            // whole pages: the memory of a page is allocated once and does not grow
            .set_write_batch_size(ROWS_PER_GROUP);
        let mut fields = Vec::with_capacity(columns.len());
        for column in &columns {
            let (physical, logical, repetition) = match column.content {
                Content::Line => (Physical::INT64, None, Repetition::REQUIRED),
                Content::Block => (Physical::INT64, None, Repetition::OPTIONAL),
                Content::File | Content::Limit => {
                    (Physical::BYTE_ARRAY, Some(LogicalType::String), Repetition::REQUIRED)
                }
                _ => (Physical::DOUBLE, None, Repetition::REQUIRED),
            };
            // there are few different words, so they keep their dictionary
            let encoding = match physical {
                Physical::DOUBLE => Some(Encoding::BYTE_STREAM_SPLIT),
                Physical::INT64 => Some(Encoding::DELTA_BINARY_PACKED),
                _ => None,
            };
            let path = || ColumnPath::from(column.name.as_str());
            if column.content.is_number() {
                properties =
                    properties.set_column_statistics_enabled(path(), EnabledStatistics::None);
            }
            if let Some(encoding) = encoding {
                properties = properties
                    .set_column_dictionary_enabled(path(), false)
                    .set_column_encoding(path(), encoding);
            }
            let field = Type::primitive_type_builder(&column.name, physical)
                .with_logical_type(logical)
                .with_repetition(repetition)
                .build()
                .map_err(to_io)?;
            fields.push(Arc::new(field));
        }
        let schema = Type::group_type_builder("trace").with_fields(fields).build();
        let schema = Arc::new(schema.map_err(to_io)?);
        let empty = |c: &Column| match c.content {
            Content::Line => Values::Integer(Vec::new()),
            Content::Block => Values::Optional(Vec::new(), Vec::new()),
            Content::File | Content::Limit => Values::Word(Vec::new()),
            _ => Values::Number(Vec::new()),
        };
        Ok(Self {
            columns: columns.into_iter().map(|c| (empty(&c), c)).map(|(v, c)| (c, v)).collect(),
            rows: 0,
            cycle_us: u64::from(facts.cycle_us),
            files: facts.files.clone(),
            limits: SpeedLimit::ALL.map(|l| (l, word(l.name()))).into(),
            schema,
            properties: Arc::new(properties.build()),
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
            let rows = first..batch.len().min(first + ROWS_PER_GROUP - self.rows);
            first = rows.end;
            self.gather(&batch.heads()[rows.clone()], batch.numbers(), rows);
            if self.rows == ROWS_PER_GROUP {
                self.write_group().map_err(|e| self.kept(e))?;
            }
        }
        Ok(())
    }

    /// Takes the values of some rows, column by column.
    fn gather(&mut self, heads: &[Head], numbers: &[Vec<f64>], rows: Range<usize>) {
        let Self { cycle_us, files, limits, .. } = self;
        let mut numbers = numbers.iter();
        for (column, values) in &mut self.columns {
            match (values, column.content) {
                (Values::Number(v), Content::Time) => {
                    let time = |head: &Head| head.k.saturating_mul(*cycle_us) as f64 / 1e6;
                    v.extend(heads.iter().map(time));
                }
                (Values::Number(v), _) => {
                    if let Some(column) = numbers.next() {
                        v.extend_from_slice(&column[rows.clone()]);
                    }
                }
                (Values::Integer(v), _) => v.extend(heads.iter().map(|h| i64::from(h.line))),
                (Values::Optional(v, present), _) => {
                    let block = |head: &Head| head.block.and_then(|n| i64::try_from(n).ok());
                    present.extend(heads.iter().map(|head| i16::from(block(head).is_some())));
                    v.extend(heads.iter().filter_map(block));
                }
                (Values::Word(v), Content::File) => {
                    v.extend(heads.iter().map(|h| ByteArray::from(files.name(h.file).as_str())));
                }
                (Values::Word(v), _) => v.extend(heads.iter().map(|head| {
                    let found = limits.iter().find(|l| l.0 == head.limit);
                    found.map(|l| l.1.clone()).unwrap_or_default()
                })),
            }
        }
        self.rows += heads.len();
    }

    /// Writes the waiting rows to a separate file.
    fn write_group(&mut self) -> io::Result<()> {
        let folder = match self.folder.take() {
            Some(folder) => folder,
            None => folder_beside(&self.path)?,
        };
        let path = folder.path().join(format!("{:06}.parquet", self.parts.len() + 1));
        self.folder = Some(folder);
        // until it is complete it has a name that readers of folders skip
        let unfinished = folder_of(&path).join(format!(".{:06}.part", self.parts.len() + 1));
        let mut writer = writer(&self.schema, &self.properties, File::create(&unfinished)?)?;
        self.put_waiting(&mut writer)?;
        writer.close().map_err(to_io)?;
        std::fs::rename(&unfinished, &path)?;
        self.parts.push(path);
        self.columns.iter_mut().for_each(|(_, values)| values.clear());
        self.rows = 0;
        Ok(())
    }

    /// Writes the waiting rows as a group of a file; they still wait.
    fn put_waiting(&self, file: &mut SerializedFileWriter<impl Write + Send>) -> io::Result<()> {
        let mut group = file.next_row_group().map_err(to_io)?;
        for (_, values) in &self.columns {
            match values {
                Values::Number(v) => put::<DoubleType>(&mut group, v, None)?,
                Values::Integer(v) => put::<Int64Type>(&mut group, v, None)?,
                Values::Optional(v, present) => put::<Int64Type>(&mut group, v, Some(present))?,
                Values::Word(v) => put::<ByteArrayType>(&mut group, v, None)?,
            }
        }
        group.close().map_err(to_io)?;
        Ok(())
    }

    /// Combines everything under the name of the trace; without rows nothing is written.
    ///
    /// # Errors
    /// The system's, e.g. for a full disk; the data written so far stay in the folder stated in the error.
    pub(crate) fn finish(mut self, facts: &Facts, totals: &Totals) -> io::Result<()> {
        self.join(facts, totals).map_err(|e| {
            // the rows that wait are kept like the others, if there is room without what was put together
            drop(self.target.file().and_then(|file| file.set_len(0)));
            if self.rows > 0 {
                drop(self.write_group());
            }
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

    /// Copies the parts and adds the rows that wait.
    fn join(&mut self, facts: &Facts, totals: &Totals) -> io::Result<()> {
        if self.parts.is_empty() && self.rows == 0 {
            return Ok(());
        }
        let file = self.target.file()?.try_clone()?;
        let mut writer = writer(&self.schema, &self.properties, file)?;
        for part in &self.parts {
            let part = File::open(part)?;
            let reader = SerializedFileReader::new(part.try_clone()?).map_err(to_io)?;
            let mut group = writer.next_row_group().map_err(to_io)?;
            let metadata = reader.metadata().row_group(0);
            for column in metadata.columns() {
                let closed = ColumnCloseResult {
                    bytes_written: column.compressed_size().cast_unsigned(),
                    rows_written: metadata.num_rows().cast_unsigned(),
                    metadata: column.clone(),
                    bloom_filter: None,
                    column_index: None,
                    offset_index: None,
                };
                group.append_column(&part, closed).map_err(to_io)?;
            }
            group.close().map_err(to_io)?;
        }
        if self.rows > 0 {
            self.put_waiting(&mut writer)?;
        }
        let mut note = |key: &str, value: String| {
            writer.append_key_value_metadata(KeyValue::new(key.to_owned(), value));
        };
        note("kontur.program", facts.program.clone());
        note("kontur.machine", facts.machine.clone());
        note("kontur.cycle_us", facts.cycle_us.to_string());
        for (axis, delay) in facts.axes.iter().zip(&totals.filter_delay_cycles) {
            note(&format!("kontur.filter_delay_cycles.{}", axis.name), delay.to_string());
        }
        writer.close().map_err(to_io)?;
        self.target.show()
    }
}

/// Makes the allocator keep the memory of a page for the next one. Every page takes several buffers of half a megabyte.
/// The GNU C library returns such memory to the system at once, which clears it before each use, until a larger buffer
/// has been freed. On other systems this is only an unused buffer.
fn keep_free_memory() {
    drop(std::hint::black_box(Vec::<u8>::with_capacity(KEPT)));
}

/// A word that is cheap to clone, without a reference count.
fn word(text: &'static str) -> ByteArray {
    Bytes::from_static(text.as_bytes()).into()
}

/// The folder of the parts of a trace.
fn folder_beside(path: &Path) -> io::Result<TempDir> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut builder = tempfile::Builder::new();
    builder.prefix(&format!(".{name}.")).suffix(".parts").tempdir_in(folder_of(path))
}

/// Begins a Parquet file.
fn writer(
    schema: &Arc<Type>,
    properties: &Arc<WriterProperties>,
    file: File,
) -> io::Result<SerializedFileWriter<BufWriter<File>>> {
    let file = BufWriter::with_capacity(PIECE, file);
    SerializedFileWriter::new(file, Arc::clone(schema), Arc::clone(properties)).map_err(to_io)
}

fn put<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, impl Write + Send>,
    values: &[T::T],
    present: Option<&[i16]>,
) -> io::Result<()> {
    let column = group.next_column().map_err(to_io)?;
    let mut column = column.ok_or_else(|| io::Error::other("fewer columns than the schema"))?;
    column.typed::<T>().write_batch(values, present, None).map_err(to_io)?;
    column.close().map_err(to_io)
}

fn to_io(e: ParquetError) -> io::Error {
    match e {
        ParquetError::External(inner) => match inner.downcast::<io::Error>() {
            Ok(e) => *e,
            Err(other) => io::Error::other(other),
        },
        other => io::Error::other(other),
    }
}

#[cfg(test)]
mod tests;
