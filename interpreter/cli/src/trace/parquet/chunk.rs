//! The columns of a group in the form in which they are copied to files.

use super::group::to_io;
use ::parquet::basic::{Compression, Encoding};
use ::parquet::column::page::{CompressedPage, Page, PageWriter};
use ::parquet::column::writer::{ColumnCloseResult, ColumnWriterImpl};
use ::parquet::data_type::DataType;
use ::parquet::file::metadata::ColumnChunkMetaData;
use ::parquet::file::properties::WriterPropertiesPtr;
use ::parquet::file::writer::{SerializedPageWriter, SerializedRowGroupWriter, TrackedWrite};
use ::parquet::schema::types::ColumnDescPtr;
use bytes::Bytes;
use std::io::{self, Write};

/// Room for the headers of the pages of a column.
const HEADERS: usize = 128;

/// A column of a group: its pages, and the description for the footer of a file.
#[derive(Debug)]
pub(super) struct Chunk {
    pages: Bytes,
    closed: ColumnCloseResult,
}

impl Chunk {
    /// Values encoded by the library; with `present`, a 1 for each one that is not missing.
    ///
    /// # Errors
    /// Those of the library.
    pub(super) fn encode<T: DataType>(
        column: ColumnDescPtr,
        properties: WriterPropertiesPtr,
        values: &[T::T],
        present: Option<&[i16]>,
    ) -> io::Result<Self> {
        let mut sink = TrackedWrite::new(Vec::new());
        let pages = Box::new(SerializedPageWriter::new(&mut sink));
        let mut writer = ColumnWriterImpl::<T>::new(column, properties, pages);
        writer.write_batch(values, present, None).map_err(to_io)?;
        let closed = writer.close().map_err(to_io)?;
        Ok(Self { pages: sink.into_inner().map_err(to_io)?.into(), closed })
    }

    /// Pages without missing values that are encoded and compressed already, each with its uncompressed size; a
    /// dictionary comes first.
    ///
    /// # Errors
    /// Those of the library.
    pub(super) fn of_pages<const N: usize>(
        column: ColumnDescPtr,
        rows: usize,
        compression: Compression,
        pages: [(Page, usize); N],
    ) -> io::Result<Self> {
        let values: usize = pages.iter().map(|(page, _)| page.buffer().len()).sum();
        let mut sink = TrackedWrite::new(Vec::with_capacity(values + HEADERS));
        let (mut uncompressed, mut encodings) = (0, vec![Encoding::RLE]);
        let (mut dictionary, mut data) = (None, 0);
        for (page, size) in pages {
            encodings.push(page.encoding());
            let is_dictionary = !page.is_data_page();
            let page = CompressedPage::new(page, size);
            let written = SerializedPageWriter::new(&mut sink).write_page(page).map_err(to_io)?;
            uncompressed += written.uncompressed_size;
            let offset = written.offset.cast_signed();
            if is_dictionary { dictionary = Some(offset) } else { data = offset }
        }
        let pages: Bytes = sink.into_inner().map_err(to_io)?.into();
        let metadata = ColumnChunkMetaData::builder(column)
            .set_encodings(encodings)
            .set_compression(compression)
            .set_num_values(rows.cast_signed() as i64)
            .set_total_compressed_size(pages.len().cast_signed() as i64)
            .set_total_uncompressed_size(uncompressed.cast_signed() as i64)
            .set_data_page_offset(data)
            .set_dictionary_page_offset(dictionary)
            .build();
        let closed = closed(pages.len() as u64, rows as u64, metadata.map_err(to_io)?);
        Ok(Self { pages, closed })
    }

    /// Number of bytes.
    pub(super) const fn len(&self) -> usize {
        self.pages.len()
    }

    /// Appends the column to a group of a file.
    ///
    /// # Errors
    /// The system's.
    pub(super) fn append_to(
        &self,
        group: &mut SerializedRowGroupWriter<'_, impl Write + Send>,
    ) -> io::Result<()> {
        let ColumnCloseResult { bytes_written, rows_written, ref metadata, .. } = self.closed;
        let closed = closed(bytes_written, rows_written, metadata.clone());
        group.append_column(&self.pages, closed).map_err(to_io)
    }
}

/// The description of a column without indices.
pub(super) const fn closed(
    bytes_written: u64,
    rows_written: u64,
    metadata: ColumnChunkMetaData,
) -> ColumnCloseResult {
    ColumnCloseResult {
        bytes_written,
        rows_written,
        metadata,
        bloom_filter: None,
        column_index: None,
        offset_index: None,
    }
}
