//! The rows of a Parquet trace as the cells of a table.

use crate::Error;
use csv::ByteRecord;
use parquet::basic::{Encoding, LogicalType, Type as Physical};
use parquet::errors::ParquetError;
use parquet::file::metadata::{ParquetMetaData, RowGroupMetaData};
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::record::Field;
use parquet::record::reader::RowIter;
use std::fs::File;
use std::io;
use std::path::Path;

/// A Parquet trace that is being read.
pub(super) struct Rows {
    name: String,
    rows: RowIter<'static>,
}

fn damaged(name: &str, reason: impl std::fmt::Display) -> Error {
    Error::io(name, io::Error::new(io::ErrorKind::InvalidData, reason.to_string()))
}

/// True if every column lies inside the file; the reader takes that for granted.
fn is_whole(metadata: &ParquetMetaData, length: u64) -> bool {
    metadata.row_groups().iter().flat_map(RowGroupMetaData::columns).all(|column| {
        let start = column.dictionary_page_offset().unwrap_or(column.data_page_offset());
        let place = u64::try_from(start).ok().zip(u64::try_from(column.compressed_size()).ok());
        let end = place.and_then(|(start, size)| start.checked_add(size));
        end.is_some_and(|end| end <= length) && column.num_values() >= 0
    })
}

/// True if every page of split bytes has as many of them as its numbers need; the decoder takes that for granted.
fn holds_its_numbers(reader: &SerializedFileReader<File>) -> Result<bool, ParquetError> {
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group)?;
        for i in 0..group.num_columns() {
            let column = group.metadata().column(i).column_descr();
            let width = match column.physical_type() {
                Physical::INT32 | Physical::FLOAT => 4,
                _ => 8,
            };
            for page in group.get_column_page_reader(i)? {
                let page = page?;
                let split = page.encoding() == Encoding::BYTE_STREAM_SPLIT;
                let count = page.num_values() as usize;
                // of an optional column the number of values that are there is not known before it is decoded
                if split && column.max_def_level() == 0 && page.buffer().len() < count * width {
                    return Ok(false);
                }
            }
        }
    }
    Ok(true)
}

impl Rows {
    /// Opens a trace; its columns come with it.
    ///
    /// # Errors
    /// [`Error::Io`] if it cannot be read, [`Error::Usage`] for a table that is no trace.
    pub(super) fn open(path: &Path) -> Result<(Vec<String>, Self), Error> {
        let name = path.display().to_string();
        let file = File::open(path).map_err(|e| Error::io(&name, e))?;
        let length = file.metadata().map_err(|e| Error::io(&name, e))?.len();
        let reader = SerializedFileReader::new(file).map_err(|e| damaged(&name, e))?;
        let schema = reader.metadata().file_metadata().schema_descr();
        let mut header = Vec::new();
        for column in schema.columns() {
            let is_text = matches!(column.logical_type_ref(), Some(LogicalType::String));
            let known = match column.physical_type() {
                Physical::BYTE_ARRAY => is_text,
                Physical::INT96 | Physical::FIXED_LEN_BYTE_ARRAY => false,
                _ => true,
            };
            if column.path().parts().len() > 1 || column.max_rep_level() > 0 || !known {
                let what = column.path().string();
                let text = format!("{name}: column `{what}` is neither numbers nor text");
                return Err(Error::Usage(text));
            }
            header.push(column.name().to_owned());
        }
        if !header.iter().any(|name| name == "t_s") {
            return Err(Error::Usage(format!("{name}: no trace, it has no column `t_s`")));
        }
        if !is_whole(reader.metadata(), length) {
            return Err(damaged(&name, "its footer names data that lie outside the file"));
        }
        if !holds_its_numbers(&reader).map_err(|e| damaged(&name, e))? {
            return Err(damaged(&name, "a page holds fewer numbers than it names"));
        }
        Ok((header, Self { name, rows: reader.into_iter() }))
    }

    /// Reads the next row; false at the end.
    ///
    /// # Errors
    /// [`Error::Io`] for a damaged file.
    pub(super) fn read(&mut self, row: &mut ByteRecord) -> Result<bool, Error> {
        row.clear();
        let Some(found) = self.rows.next() else { return Ok(false) };
        let found = found.map_err(|e| damaged(&self.name, e))?;
        for (_, field) in found.get_column_iter() {
            match field {
                Field::Null => row.push_field(b""),
                Field::Str(text) => row.push_field(text.as_bytes()),
                Field::Double(x) => row.push_field(x.to_string().as_bytes()),
                other => row.push_field(other.to_string().as_bytes()),
            }
        }
        Ok(true)
    }
}
