//! The columns of a trace as types of Parquet, and the values of the rows that wait to become a group.

use super::chunk::Chunk;
use super::compressor::Compressor;
use super::group::{ROWS_PER_GROUP, to_io};
use super::numbers::Numbers;
use super::words::Words;
use crate::trace::batch::{Batch, Head};
use ::parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::Int64Type;
use ::parquet::file::properties::{EnabledStatistics, WriterProperties};
use ::parquet::schema::types::{ColumnPath, SchemaDescPtr, SchemaDescriptor, Type};
use kontur_interpreter::job::{Facts, FileNames};
use kontur_interpreter::record::SpeedLimit;
use kontur_interpreter::record::columns::{Column, Content};
use std::io;
use std::ops::Range;
use std::sync::Arc;

/// The rows that wait.
pub(super) struct Waiting {
    values: Vec<(Content, Values)>,
    rows: usize,
    cycle_us: u64,
    files: FileNames,
    schema: SchemaDescPtr,
    properties: Arc<WriterProperties>,
    compressor: Compressor,
}

/// The values of a column.
enum Values {
    Number(Numbers),
    Integer(Vec<i64>),
    /// Integers that may be missing, with a 1 for each one present.
    Optional(Vec<i64>, Vec<i16>),
    Limit(Words<SpeedLimit>),
    /// Names of files, by their numbers.
    File(Words<u32>),
}

impl Values {
    const fn of(content: Content) -> Self {
        match content {
            Content::Line => Self::Integer(Vec::new()),
            Content::Block => Self::Optional(Vec::new(), Vec::new()),
            Content::File => Self::File(Words::new()),
            Content::Limit => Self::Limit(Words::new()),
            _ => Self::Number(Numbers::new()),
        }
    }

    fn clear(&mut self) {
        match self {
            Self::Number(v) => v.clear(),
            Self::Integer(v) => v.clear(),
            Self::Optional(v, present) => {
                v.clear();
                present.clear();
            }
            Self::Limit(v) => v.clear(),
            Self::File(v) => v.clear(),
        }
    }
}

impl Waiting {
    /// No rows of these columns yet.
    ///
    /// # Errors
    /// Those of the library.
    pub(super) fn new(columns: &[Column], facts: &Facts) -> io::Result<Self> {
        let (schema, properties) = described(columns)?;
        Ok(Self {
            values: columns.iter().map(|c| (c.content, Values::of(c.content))).collect(),
            rows: 0,
            cycle_us: u64::from(facts.cycle_us),
            files: facts.files.clone(),
            schema: Arc::new(SchemaDescriptor::new(schema)),
            properties: Arc::new(properties),
            compressor: Compressor::new(),
        })
    }

    /// Number of rows.
    pub(super) const fn len(&self) -> usize {
        self.rows
    }

    /// The types of the columns.
    pub(super) fn schema(&self) -> SchemaDescPtr {
        Arc::clone(&self.schema)
    }

    /// How they are written.
    pub(super) fn properties(&self) -> &WriterProperties {
        &self.properties
    }

    /// Takes rows of a batch, column by column.
    pub(super) fn take(&mut self, batch: &Batch, rows: Range<usize>) {
        let cycle_us = self.cycle_us;
        let heads = &batch.heads()[rows.clone()];
        let mut numbers = batch.numbers().iter();
        for (content, values) in &mut self.values {
            match (values, content) {
                (Values::Number(v), Content::Time) => {
                    let time = |head: &Head| head.k.saturating_mul(cycle_us) as f64 / 1e6;
                    v.extend(&heads.iter().map(time).collect::<Vec<f64>>());
                }
                (Values::Number(v), _) => {
                    if let Some(column) = numbers.next() {
                        v.extend(&column[rows.clone()]);
                    }
                }
                (Values::Integer(v), _) => v.extend(heads.iter().map(|h| i64::from(h.line))),
                (Values::Optional(v, present), _) => {
                    let block = |head: &Head| head.block.and_then(|n| i64::try_from(n).ok());
                    present.extend(heads.iter().map(|head| i16::from(block(head).is_some())));
                    v.extend(heads.iter().filter_map(block));
                }
                (Values::Limit(v), _) => v.extend(heads.iter().map(|head| head.limit)),
                (Values::File(v), _) => v.extend(heads.iter().map(|head| head.file)),
            }
        }
        self.rows += heads.len();
    }

    /// Makes the rows a group; none wait any more.
    ///
    /// # Errors
    /// Those of the library.
    pub(super) fn encode(&mut self) -> io::Result<Vec<Chunk>> {
        let Self { values, schema, properties, compressor, rows, files, .. } = self;
        *rows = 0;
        let columns = values.iter_mut().zip(schema.columns());
        columns
            .map(|((_, values), column)| {
                let (column, properties) = (Arc::clone(column), Arc::clone(properties));
                let chunk = match values {
                    Values::Number(v) => v.encode(column, compressor),
                    Values::Integer(v) => Chunk::encode::<Int64Type>(column, properties, v, None),
                    Values::Optional(v, present) => {
                        Chunk::encode::<Int64Type>(column, properties, v, Some(present))
                    }
                    Values::Limit(v) => v.encode(column, compressor, |limit| limit.name().into()),
                    Values::File(v) => {
                        v.encode(column, compressor, |file| files.name(file).as_str().into())
                    }
                };
                values.clear();
                chunk
            })
            .collect()
    }
}

/// Types of the columns, and how the columns are written that the library encodes.
fn described(columns: &[Column]) -> io::Result<(Arc<Type>, WriterProperties)> {
    let mut properties = WriterProperties::builder()
        .set_created_by(concat!("kontur ", env!("CARGO_PKG_VERSION")).to_owned())
        .set_compression(Compression::SNAPPY)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        // a group has one page per column, which needs no index
        .set_offset_index_disabled(true)
        // whole pages: the memory of a page is allocated once and does not grow
        .set_write_batch_size(ROWS_PER_GROUP);
    let mut fields = Vec::with_capacity(columns.len());
    for column in columns {
        let (physical, logical, repetition) = match column.content {
            Content::Line => (Physical::INT64, None, Repetition::REQUIRED),
            Content::Block => (Physical::INT64, None, Repetition::OPTIONAL),
            Content::File | Content::Limit => {
                (Physical::BYTE_ARRAY, Some(LogicalType::String), Repetition::REQUIRED)
            }
            _ => (Physical::DOUBLE, None, Repetition::REQUIRED),
        };
        if physical == Physical::INT64 {
            let path = ColumnPath::from(column.name.as_str());
            properties = properties
                .set_column_dictionary_enabled(path.clone(), false)
                .set_column_encoding(path, Encoding::DELTA_BINARY_PACKED);
        }
        let field = Type::primitive_type_builder(&column.name, physical)
            .with_logical_type(logical)
            .with_repetition(repetition)
            .build()
            .map_err(to_io)?;
        fields.push(Arc::new(field));
    }
    let schema = Type::group_type_builder("trace").with_fields(fields).build();
    Ok((Arc::new(schema.map_err(to_io)?), properties.build()))
}
