//! The rows of a Parquet trace as the cells of a table.

use crate::error::Error;
use csv::ByteRecord;
use parquet::basic::{LogicalType, Type as Physical};
use parquet::file::metadata::{ParquetMetaData, RowGroupMetaData};
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::record::Field;
use parquet::record::reader::RowIter;
use std::cell::Cell;
use std::fs::File;
use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::sync::Once;

/// A Parquet trace being read.
pub(super) struct Rows {
    name: String,
    rows: RowIter<'static>,
}

fn damaged(name: &str, reason: impl std::fmt::Display) -> Error {
    Error::io(name, io::Error::new(io::ErrorKind::InvalidData, reason.to_string()))
}

/// Whether every column lies within the file, which the reader assumes.
fn is_whole(metadata: &ParquetMetaData, length: u64) -> bool {
    metadata.row_groups().iter().flat_map(RowGroupMetaData::columns).all(|column| {
        let start = column.dictionary_page_offset().unwrap_or(column.data_page_offset());
        let place = u64::try_from(start).ok().zip(u64::try_from(column.compressed_size()).ok());
        let end = place.and_then(|(start, size)| start.checked_add(size));
        end.is_some_and(|end| end <= length) && column.num_values() >= 0
    })
}

thread_local! {
    /// A panic of this thread is caught and reported as a damaged file.
    static TAKING_FOR_GRANTED: Cell<bool> = const { Cell::new(false) };
}

/// Runs code that assumes an intact file and panics if it is not.
fn guarded<T>(name: &str, code: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !TAKING_FOR_GRANTED.get() {
                usual(info);
            }
        }));
    });
    TAKING_FOR_GRANTED.set(true);
    // the data being read are dropped with the error
    let done = panic::catch_unwind(AssertUnwindSafe(code));
    TAKING_FOR_GRANTED.set(false);
    done.unwrap_or_else(|_| Err(damaged(name, "its pages do not contain what they declare")))
}

impl Rows {
    /// Opens a trace; returns its columns too.
    ///
    /// # Errors
    /// [`Error::Io`] if it cannot be read, [`Error::Usage`] for a table that is not a trace.
    pub(super) fn open(path: &Path) -> Result<(Vec<String>, Self), Error> {
        let name = path.display().to_string();
        guarded(&name, || Self::open_whole(path, name.clone()))
    }

    fn open_whole(path: &Path, name: String) -> Result<(Vec<String>, Self), Error> {
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
            return Err(Error::Usage(format!("{name}: not a trace, column `t_s` is missing")));
        }
        if !is_whole(reader.metadata(), length) {
            return Err(damaged(&name, "its footer refers to data outside the file"));
        }
        Ok((header, Self { name, rows: reader.into_iter() }))
    }

    /// Reads the next row; false at the end.
    ///
    /// # Errors
    /// [`Error::Io`] for a damaged file.
    pub(super) fn read(&mut self, row: &mut ByteRecord) -> Result<bool, Error> {
        row.clear();
        let (name, rows) = (&self.name, &mut self.rows);
        let next = guarded(name, || rows.next().transpose().map_err(|e| damaged(name, e)))?;
        let Some(found) = next else { return Ok(false) };
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

#[cfg(test)]
mod tests {
    use super::Rows;
    use crate::error::Error;
    use csv::ByteRecord;
    use parquet::basic::{Encoding, Repetition, Type as Physical};
    use parquet::data_type::DoubleType;
    use parquet::file::properties::{WriterProperties, WriterVersion};
    use parquet::file::writer::SerializedFileWriter;
    use parquet::schema::types::Type;
    use std::path::Path;
    use std::sync::Arc;

    /// A trace in which every third number of a column is missing, as other programs write it.
    fn foreign(encoding: Encoding, version: WriterVersion) -> Vec<u8> {
        let field = |name, repetition| {
            let field = Type::primitive_type_builder(name, Physical::DOUBLE);
            Arc::new(field.with_repetition(repetition).build().unwrap())
        };
        let fields = vec![field("t_s", Repetition::REQUIRED), field("a", Repetition::OPTIONAL)];
        let schema = Type::group_type_builder("t").with_fields(fields).build().unwrap();
        let properties = WriterProperties::builder()
            .set_writer_version(version)
            .set_dictionary_enabled(false)
            .set_encoding(encoding)
            .build();
        let mut bytes = Vec::new();
        let mut writer =
            SerializedFileWriter::new(&mut bytes, Arc::new(schema), Arc::new(properties)).unwrap();
        let mut group = writer.next_row_group().unwrap();
        let numbers: Vec<f64> = (0..60).map(f64::from).collect();
        let present: Vec<i16> = (0..60).map(|k| i16::from(k % 3 > 0)).collect();
        for (values, levels) in [(&numbers[..], None), (&numbers[..40], Some(&present[..]))] {
            let mut column = group.next_column().unwrap().unwrap();
            column.typed::<DoubleType>().write_batch(values, levels, None).unwrap();
            column.close().unwrap();
        }
        group.close().unwrap();
        writer.close().unwrap();
        bytes
    }

    /// How many rows there are.
    fn read(bytes: &[u8], folder: &Path) -> Result<usize, Error> {
        let path = folder.join("a.parquet");
        std::fs::write(&path, bytes).unwrap();
        let (_, mut rows) = Rows::open(&path)?;
        let (mut count, mut row) = (0, ByteRecord::new());
        while rows.read(&mut row)? {
            count += 1;
        }
        Ok(count)
    }

    /// With any single wrong byte there are rows or an error, but never a panic.
    #[test]
    fn damaged_pages_are_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let mut caught = 0;
        for (encoding, version) in [
            (Encoding::PLAIN, WriterVersion::PARQUET_2_0),
            (Encoding::BYTE_STREAM_SPLIT, WriterVersion::PARQUET_1_0),
        ] {
            let whole = foreign(encoding, version);
            assert_eq!(read(&whole, folder.path()).ok(), Some(60));
            for (at, flip) in (4..whole.len() - 4).zip([0x01, 0x40, 0xFF].into_iter().cycle()) {
                let mut bytes = whole.clone();
                bytes[at] ^= flip;
                let said = read(&bytes, folder.path()).map_err(|e| e.to_string());
                caught += usize::from(said.is_err_and(|e| e.contains("what they declare")));
            }
        }
        assert!(caught > 0, "none of them would have been a panic");
    }
}
