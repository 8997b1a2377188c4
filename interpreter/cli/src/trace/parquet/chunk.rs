//! The columns of a group in the form in which they are copied to files.

use super::group::to_io;
use ::parquet::basic::{Compression, Encoding};
use ::parquet::column::page::{CompressedPage, Page, PageWriter};
use ::parquet::column::writer::ColumnWriterImpl;
use ::parquet::data_type::DataType;
use ::parquet::file::metadata::ColumnChunkMetaData;
use ::parquet::file::properties::WriterPropertiesPtr;
use ::parquet::file::statistics::Statistics;
use ::parquet::file::writer::{SerializedPageWriter, TrackedWrite};
use ::parquet::schema::types::ColumnDescPtr;
use bytes::Bytes;
use integer_encoding::VarInt as _;
use std::io;

/// Room for the headers of the pages of a column.
const HEADERS: usize = 128;

/// A column of a group: its pages, and their description, with places from the beginning of the first page on.
#[derive(Debug)]
pub(super) struct Chunk {
    pages: Vec<u8>,
    rows: usize,
    metadata: ColumnChunkMetaData,
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
        let metadata = writer.close().map_err(to_io)?.metadata;
        let rows = present.map_or(values.len(), <[i16]>::len);
        Ok(Self { pages: sink.into_inner().map_err(to_io)?, rows, metadata })
    }

    /// Pages without missing values that are encoded and compressed already, each with its uncompressed size; a
    /// dictionary comes first. `range`: the least and the greatest value, for readers that select rows by them.
    ///
    /// # Errors
    /// Those of the library.
    pub(super) fn of_pages<const N: usize>(
        column: ColumnDescPtr,
        rows: usize,
        compression: Compression,
        pages: [(Page, usize); N],
        range: Option<Statistics>,
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
        let pages = sink.into_inner().map_err(to_io)?;
        let mut metadata = ColumnChunkMetaData::builder(column)
            .set_encodings(encodings)
            .set_compression(compression)
            .set_num_values(rows.cast_signed() as i64)
            .set_total_compressed_size(pages.len().cast_signed() as i64)
            .set_total_uncompressed_size(uncompressed.cast_signed() as i64)
            .set_data_page_offset(data)
            .set_dictionary_page_offset(dictionary);
        if let Some(range) = range {
            metadata = metadata.set_statistics(range);
        }
        Ok(Self { pages, rows, metadata: metadata.build().map_err(to_io)? })
    }

    /// The pages with their headers.
    pub(super) fn pages(&self) -> &[u8] {
        &self.pages
    }

    /// Number of rows.
    pub(super) const fn rows(&self) -> usize {
        self.rows
    }

    /// What the footer of a file says of the column, with places as if the file began with it.
    pub(super) const fn metadata(&self) -> &ColumnChunkMetaData {
        &self.metadata
    }
}

/// A page of values that are never missing.
pub(super) fn data_page(buf: Bytes, rows: usize, encoding: Encoding) -> Page {
    Page::DataPage {
        buf,
        num_values: rows as u32,
        encoding,
        def_level_encoding: Encoding::RLE,
        rep_level_encoding: Encoding::RLE,
        statistics: None,
    }
}

/// A page of the values to which indices refer.
pub(super) const fn dictionary(buf: Bytes, values: usize) -> Page {
    Page::DictionaryPage {
        buf,
        num_values: values as u32,
        encoding: Encoding::PLAIN,
        is_sorted: false,
    }
}

/// Appends a run of the same index, which takes `width` bytes, to indices (the hybrid of runs and packed bits, which
/// begins with the number of bits of an index).
pub(super) fn run(indices: &mut Vec<u8>, index: usize, rows: usize, width: usize) {
    indices.extend((rows << 1).encode_var_vec());
    indices.extend(&index.to_le_bytes()[..width]);
}
