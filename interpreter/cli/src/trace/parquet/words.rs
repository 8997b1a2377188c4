//! A column of words: those that occur in a group, and runs of indices to them.
//!
//! Words change seldom, so a row costs one comparison, and a run of rows some two bytes.

use super::chunk::{Chunk, data_page, dictionary, run};
use super::compressor::Compressor;
use ::parquet::basic::{Compression, Encoding};
use ::parquet::data_type::{AsBytes as _, ByteArray};
use ::parquet::file::statistics::Statistics;
use ::parquet::schema::types::ColumnDescPtr;
use std::io;

/// The words of the rows, known by their keys.
#[derive(Debug)]
pub(super) struct Words<K> {
    /// Those that occur, in the order of their first rows.
    keys: Vec<K>,
    /// Place in `keys` and number of rows.
    runs: Vec<(usize, usize)>,
}

impl<K: Copy + PartialEq> Words<K> {
    /// No words yet.
    pub(super) const fn new() -> Self {
        Self { keys: Vec::new(), runs: Vec::new() }
    }

    /// Adds words.
    pub(super) fn extend(&mut self, keys: impl Iterator<Item = K>) {
        for key in keys {
            if let Some((last, rows)) = self.runs.last_mut()
                && self.keys[*last] == key
            {
                *rows += 1;
                continue;
            }
            let place = self.keys.iter().position(|known| *known == key).unwrap_or_else(|| {
                self.keys.push(key);
                self.keys.len() - 1
            });
            self.runs.push((place, 1));
        }
    }

    /// Removes the words but keeps the memory.
    pub(super) fn clear(&mut self) {
        self.keys.clear();
        self.runs.clear();
    }

    /// The column as written to a file.
    ///
    /// # Errors
    /// Those of the library.
    pub(super) fn encode(
        &self,
        column: ColumnDescPtr,
        compressor: &mut Compressor,
        word: impl Fn(K) -> ByteArray,
    ) -> io::Result<Chunk> {
        let words: Vec<ByteArray> = self.keys.iter().map(|key| word(*key)).collect();
        let mut plain = Vec::new();
        for word in &words {
            plain.extend((word.len() as u32).to_le_bytes());
            plain.extend(word.as_bytes());
        }
        let bits = self.keys.len().saturating_sub(1).max(1).ilog2() + 1;
        let mut indices = vec![bits as u8];
        for (place, rows) in &self.runs {
            run(&mut indices, *place, *rows, bits.div_ceil(8) as usize);
        }
        let rows = self.runs.iter().map(|(_, rows)| rows).sum();
        let known = dictionary(compressor.compress(&plain)?, words.len());
        let data = data_page(compressor.compress(&indices)?, rows, Encoding::RLE_DICTIONARY);
        let pages = [(known, plain.len()), (data, indices.len())];
        let texts = || words.iter().map(ByteArray::as_bytes);
        let stored = |text: Option<&[u8]>| text.map(|text| text.to_vec().into());
        let [least, greatest] = [texts().min(), texts().max()].map(stored);
        let range = Statistics::byte_array(least, greatest, None, Some(0), false);
        Chunk::of_pages(column, rows, Compression::SNAPPY, pages, Some(range))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::parquet::file::Unfinished;
    use ::parquet::basic::{LogicalType, Repetition, Type as Physical};
    use ::parquet::file::properties::WriterProperties;
    use ::parquet::file::reader::{FileReader as _, SerializedFileReader};
    use ::parquet::record::RowAccessor as _;
    use ::parquet::schema::types::{SchemaDescriptor, Type};
    use kontur_kit::Random;
    use std::sync::Arc;

    /// Random runs of few and of more than 256 words come back from the library's reader, with their least and greatest word.
    #[test]
    fn words_come_back() {
        let field = Type::primitive_type_builder("word", Physical::BYTE_ARRAY)
            .with_logical_type(Some(LogicalType::String))
            .with_repetition(Repetition::REQUIRED)
            .build();
        let schema = Type::group_type_builder("trace").with_fields(vec![Arc::new(field.unwrap())]);
        let schema = Arc::new(SchemaDescriptor::new(Arc::new(schema.build().unwrap())));
        let mut random = Random::new(3);
        for kinds in [1, 2, 3, 5, 300] {
            let mut wanted: Vec<u64> = Vec::new();
            let mut words = Words::new();
            for _ in 0..kinds + 400 {
                let key = random.bits() % kinds;
                let rows = random.bits() as usize % 20;
                wanted.extend(std::iter::repeat_n(key, rows));
                words.extend(std::iter::repeat_n(key, rows));
            }
            let name = |key: u64| format!("w{key}");
            let word = |key| ByteArray::from(name(key).as_str());
            let column = schema.column(0);
            let chunk = words.encode(column, &mut Compressor::new(), word).unwrap();
            let path = tempfile::NamedTempFile::new().unwrap();
            let mut file = Unfinished::begin(path.reopen().unwrap(), Arc::clone(&schema)).unwrap();
            file.append(&[chunk]).unwrap();
            file.finish(&WriterProperties::default(), None).unwrap();
            let reader = SerializedFileReader::new(path.reopen().unwrap()).unwrap();
            let rows = reader.get_row_iter(None).unwrap();
            let found = rows.map(|row| row.unwrap().get_string(0).unwrap().clone());
            assert!(found.eq(wanted.iter().map(|key| name(*key))), "{kinds}");
            let mut names: Vec<String> = wanted.iter().map(|key| name(*key)).collect();
            names.sort();
            let range = reader.metadata().row_group(0).column(0).statistics().unwrap().clone();
            assert_eq!(range.min_bytes_opt(), names.first().map(String::as_bytes));
            assert_eq!(range.max_bytes_opt(), names.last().map(String::as_bytes));
        }
    }
}
