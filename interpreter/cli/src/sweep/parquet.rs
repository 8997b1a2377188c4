//! The rows of a sweep as a Parquet file: numbers as numbers, texts as strings, null where there is no number.

use super::rows::Rows;
use crate::table::Cell;
use ::parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use ::parquet::errors::ParquetError;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::Type;
use std::fs::File;
use std::io;
use std::sync::Arc;

/// Writes the file.
///
/// # Errors
/// The system's, e.g. a full disk.
pub(super) fn write(file: &mut File, rows: &Rows) -> io::Result<()> {
    let properties = WriterProperties::builder()
        .set_created_by(concat!("kontur ", env!("CARGO_PKG_VERSION")).to_owned())
        .set_compression(Compression::SNAPPY)
        .build();
    let is_word = |i: usize| rows.cells.iter().any(|row| matches!(row[i], Cell::Word(_)));
    let mut fields = Vec::new();
    for (i, name) in rows.header.iter().enumerate() {
        let (physical, logical, repetition) = if is_word(i) {
            (Physical::BYTE_ARRAY, Some(LogicalType::String), Repetition::REQUIRED)
        } else {
            (Physical::DOUBLE, None, Repetition::OPTIONAL)
        };
        let field = Type::primitive_type_builder(name, physical)
            .with_logical_type(logical)
            .with_repetition(repetition);
        fields.push(Arc::new(field.build().map_err(to_io)?));
    }
    let schema = Type::group_type_builder("sweep").with_fields(fields).build().map_err(to_io)?;
    let mut writer =
        SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties)).map_err(to_io)?;
    let mut group = writer.next_row_group().map_err(to_io)?;
    for i in 0..rows.header.len() {
        let missing = || io::Error::other("fewer columns than the schema");
        let mut column = group.next_column().map_err(to_io)?.ok_or_else(missing)?;
        if is_word(i) {
            let words: Vec<ByteArray> =
                rows.cells.iter().map(|row| ByteArray::from(row[i].text().as_str())).collect();
            column.typed::<ByteArrayType>().write_batch(&words, None, None).map_err(to_io)?;
        } else {
            let number = |row: &Vec<Cell>| row[i].number().filter(|x| x.is_finite());
            let numbers: Vec<Option<f64>> = rows.cells.iter().map(number).collect();
            let present: Vec<i16> = numbers.iter().map(|x| i16::from(x.is_some())).collect();
            let numbers: Vec<f64> = numbers.into_iter().flatten().collect();
            column
                .typed::<DoubleType>()
                .write_batch(&numbers, Some(&present), None)
                .map_err(to_io)?;
        }
        column.close().map_err(to_io)?;
    }
    group.close().map_err(to_io)?;
    writer.close().map_err(to_io)?;
    Ok(())
}

fn to_io(e: ParquetError) -> io::Error {
    io::Error::other(e)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::parquet::file::reader::{FileReader, SerializedFileReader};
    use ::parquet::record::RowAccessor;

    #[test]
    fn reads_back() {
        let rows = Rows {
            title: String::new(),
            header: ["X.a", "state", "t"].map(str::to_owned).to_vec(),
            cells: vec![
                vec![Cell::Number(1.5, 1), Cell::Word("finished".to_owned()), Cell::Number(0.1, 2)],
                vec![
                    Cell::Number(2.0, 1),
                    Cell::Word("aborted".to_owned()),
                    Cell::Number(f64::NAN, 2),
                ],
            ],
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.parquet");
        write(&mut File::create(&path).unwrap(), &rows).unwrap();
        let reader = SerializedFileReader::new(File::open(&path).unwrap()).unwrap();
        let read: Vec<_> = reader.get_row_iter(None).unwrap().map(|r| r.unwrap()).collect();
        assert_eq!(read.len(), 2);
        assert_eq!(read[0].get_double(0).unwrap().to_bits(), 1.5_f64.to_bits());
        assert_eq!(read[1].get_string(1).unwrap(), "aborted");
        assert_eq!(read[0].get_double(2).unwrap().to_bits(), 0.1_f64.to_bits());
        assert!(read[1].get_double(2).is_err(), "nothing where there is no number");
    }
}
