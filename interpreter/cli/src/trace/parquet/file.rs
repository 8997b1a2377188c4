//! A Parquet file while it is written: groups one after the other, and the footer that describes them.
//!
//! The library's writer moves every column through a buffer of its own before the system gets it. Here an encoded column
//! goes to the system as it is, and the groups of another file are copied by the system alone.

use super::chunk::Chunk;
use super::group::to_io;
use ::parquet::file::metadata::{
    ColumnChunkMetaData, FileMetaData, KeyValue, ParquetMetaData, ParquetMetaDataReader,
    ParquetMetaDataWriter, RowGroupMetaData,
};
use ::parquet::file::properties::WriterProperties;
use ::parquet::schema::types::SchemaDescPtr;
use std::fs::File;
use std::io::{self, BufWriter, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::Path;
use std::sync::Arc;

/// The first and the last bytes of a file.
const MAGIC: &[u8] = b"PAR1";

/// A file that has no footer yet.
#[derive(Debug)]
pub(super) struct Unfinished {
    /// Collects the columns of a few bytes; larger ones pass it by.
    file: BufWriter<File>,
    /// Number of bytes so far.
    length: u64,
    schema: SchemaDescPtr,
    groups: Vec<RowGroupMetaData>,
}

impl Unfinished {
    /// Begins an empty file.
    ///
    /// # Errors
    /// The system's.
    pub(super) fn begin(file: File, schema: SchemaDescPtr) -> io::Result<Self> {
        let mut file = BufWriter::new(file);
        file.write_all(MAGIC)?;
        Ok(Self { file, length: MAGIC.len() as u64, schema, groups: Vec::new() })
    }

    /// Appends a group of encoded columns.
    ///
    /// # Errors
    /// The system's.
    pub(super) fn append(&mut self, chunks: &[Chunk]) -> io::Result<()> {
        let begin = self.length;
        let mut columns = Vec::with_capacity(chunks.len());
        for chunk in chunks {
            columns.push(moved(chunk.metadata(), self.length.cast_signed())?);
            self.file.write_all(chunk.pages())?;
            self.length += chunk.pages().len() as u64;
        }
        let rows = chunks.first().map_or(0, Chunk::rows);
        self.describe(begin, columns, rows.cast_signed() as i64)
    }

    /// Appends the groups of a finished file of the same columns.
    ///
    /// # Errors
    /// The system's; those of the library, if the file is damaged.
    pub(super) fn append_file(&mut self, path: &Path) -> io::Result<()> {
        let mut other = File::open(path)?;
        let metadata = ParquetMetaDataReader::new().parse_and_finish(&other).map_err(to_io)?;
        for group in metadata.row_groups() {
            let ranges = || group.columns().iter().map(ColumnChunkMetaData::byte_range);
            let first = ranges().map(|(first, _)| first).min().unwrap_or_default();
            let bytes: u64 = ranges().map(|(_, bytes)| bytes).sum();
            let begin = self.length;
            let distance = begin.cast_signed() - first.cast_signed();
            let columns = group.columns().iter().map(|column| moved(column, distance));
            let columns = columns.collect::<io::Result<_>>()?;
            other.seek(SeekFrom::Start(first))?;
            // the standard library leaves copying from file to file to the system: no memory here is touched
            self.file.flush()?;
            if io::copy(&mut (&other).take(bytes), self.file.get_mut())? != bytes {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
            self.length += bytes;
            self.describe(begin, columns, group.num_rows())?;
        }
        Ok(())
    }

    /// Describes the group that has just been appended.
    fn describe(
        &mut self,
        begin: u64,
        columns: Vec<ColumnChunkMetaData>,
        rows: i64,
    ) -> io::Result<()> {
        let uncompressed = columns.iter().map(ColumnChunkMetaData::uncompressed_size).sum();
        let ordinal = i32::try_from(self.groups.len()).map_err(io::Error::other)?;
        let group = RowGroupMetaData::builder(Arc::clone(&self.schema))
            .set_column_metadata(columns)
            .set_total_byte_size(uncompressed)
            .set_num_rows(rows)
            .set_ordinal(ordinal)
            .set_file_offset(begin.cast_signed())
            .build();
        self.groups.push(group.map_err(to_io)?);
        Ok(())
    }

    /// Completes the file.
    ///
    /// # Errors
    /// The system's.
    pub(super) fn finish(
        mut self,
        properties: &WriterProperties,
        notes: Option<Vec<KeyValue>>,
    ) -> io::Result<()> {
        let version = properties.writer_version().as_num();
        let rows = self.groups.iter().map(RowGroupMetaData::num_rows).sum();
        let by = Some(properties.created_by().to_owned());
        let file = FileMetaData::new(version, rows, by, notes, self.schema, None);
        let metadata = ParquetMetaData::new(file, self.groups);
        ParquetMetaDataWriter::new(&mut self.file, &metadata).finish().map_err(to_io)?;
        self.file.flush()
    }
}

/// The description of a column whose pages lie `distance` bytes behind the places that it states.
fn moved(column: &ColumnChunkMetaData, distance: i64) -> io::Result<ColumnChunkMetaData> {
    let dictionary = column.dictionary_page_offset().map(|offset| offset + distance);
    let data = column.data_page_offset() + distance;
    let builder = column.clone().into_builder();
    builder.set_data_page_offset(data).set_dictionary_page_offset(dictionary).build().map_err(to_io)
}
