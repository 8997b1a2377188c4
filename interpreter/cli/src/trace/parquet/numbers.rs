//! A numeric column of a group: its byte streams, or the only value that it has.
//!
//! The values of a batch are split as soon as they arrive, while they are in the cache of the processor, and the page is
//! compressed from there. A column that does not change within a group is a dictionary of one value and one run of
//! indices to it: some 80 bytes instead of 25 KB, and nothing to split or compress.

use super::chunk::Chunk;
use super::group::ROWS_PER_GROUP;
use ::parquet::basic::{Compression, Encoding};
use ::parquet::column::page::Page;
use ::parquet::schema::types::ColumnDescPtr;
use bytes::Bytes;
use integer_encoding::VarInt;
use std::io;

/// Number of bytes of a value, each of which has its stream.
const WIDTH: usize = size_of::<f64>();

/// The values of a column.
#[derive(Debug)]
pub(super) struct Numbers {
    rows: usize,
    /// Bits of the first value.
    first: u64,
    /// Whether a value has differed from the first one.
    varies: bool,
    /// Then the values: each stream with room for a whole group.
    streams: Vec<u8>,
}

/// Memory for the compression of pages.
#[derive(Debug)]
pub(super) struct Compressor {
    snappy: snap::raw::Encoder,
    /// The streams of a group that is not full, without the gaps.
    joined: Vec<u8>,
    output: Vec<u8>,
}

impl Compressor {
    /// Without memory yet.
    pub(super) fn new() -> Self {
        Self { snappy: snap::raw::Encoder::new(), joined: Vec::new(), output: Vec::new() }
    }
}

impl Numbers {
    /// No values yet.
    pub(super) const fn new() -> Self {
        Self { rows: 0, first: 0, varies: false, streams: Vec::new() }
    }

    /// Adds values, in all not more than a group has rows.
    pub(super) fn extend(&mut self, values: &[f64]) {
        let Some(first) = values.first() else { return };
        if self.rows == 0 {
            self.first = first.to_bits();
        }
        if !self.varies && values.iter().any(|value| value.to_bits() != self.first) {
            self.varies = true;
            self.streams.resize(WIDTH * ROWS_PER_GROUP, 0);
            let streams = self.streams.chunks_exact_mut(ROWS_PER_GROUP);
            for (stream, byte) in streams.zip(self.first.to_le_bytes()) {
                stream[..self.rows].fill(byte);
            }
        }
        let begin = self.rows;
        self.rows += values.len();
        if self.varies {
            let streams = self.streams.chunks_exact_mut(ROWS_PER_GROUP);
            split(values, streams.map(|stream| &mut stream[begin..self.rows]));
        }
    }

    /// Removes the values but keeps the memory.
    pub(super) const fn clear(&mut self) {
        self.rows = 0;
        self.varies = false;
    }

    /// The column as written to a file.
    ///
    /// # Errors
    /// Those of the library.
    pub(super) fn encode(
        &self,
        column: ColumnDescPtr,
        compressor: &mut Compressor,
    ) -> io::Result<Chunk> {
        if self.varies {
            self.encode_streams(column, compressor)
        } else {
            self.encode_constant(column)
        }
    }

    fn encode_streams(
        &self,
        column: ColumnDescPtr,
        compressor: &mut Compressor,
    ) -> io::Result<Chunk> {
        let Compressor { snappy, joined, output } = compressor;
        let streams = if self.rows == ROWS_PER_GROUP {
            &self.streams
        } else {
            joined.clear();
            for stream in self.streams.chunks_exact(ROWS_PER_GROUP) {
                joined.extend_from_slice(&stream[..self.rows]);
            }
            joined
        };
        output.resize(snap::raw::max_compress_len(WIDTH * ROWS_PER_GROUP), 0);
        let length = snappy.compress(streams, output).map_err(io::Error::other)?;
        // shared with the page while it is written, and then used again
        let whole = Bytes::from(std::mem::take(output));
        let page = data_page(whole.slice(..length), self.rows, Encoding::BYTE_STREAM_SPLIT);
        let pages = [(page, streams.len())];
        let chunk = Chunk::of_pages(column, self.rows, Compression::SNAPPY, pages);
        *output = Vec::from(whole);
        chunk
    }

    fn encode_constant(&self, column: ColumnDescPtr) -> io::Result<Chunk> {
        let dictionary = Page::DictionaryPage {
            buf: Bytes::copy_from_slice(&self.first.to_le_bytes()),
            num_values: 1,
            encoding: Encoding::PLAIN,
            is_sorted: false,
        };
        let run = run_of_zero(self.rows);
        let length = run.len();
        let run = data_page(run.into(), self.rows, Encoding::RLE_DICTIONARY);
        let pages = [(dictionary, WIDTH), (run, length)];
        Chunk::of_pages(column, self.rows, Compression::UNCOMPRESSED, pages)
    }
}

/// A page of values that are never missing.
fn data_page(buf: Bytes, rows: usize, encoding: Encoding) -> Page {
    Page::DataPage {
        buf,
        num_values: rows as u32,
        encoding,
        def_level_encoding: Encoding::RLE,
        rep_level_encoding: Encoding::RLE,
        statistics: None,
    }
}

/// Indices to a dictionary: their width of one bit, and one run of the index 0 (the hybrid of runs and packed bits).
fn run_of_zero(rows: usize) -> Vec<u8> {
    let mut bytes = vec![1];
    bytes.extend((rows << 1).encode_var_vec());
    bytes.push(0);
    bytes
}

/// Distributes the bytes of values to their streams, the lowest byte to the first one.
fn split<'a>(values: &[f64], mut streams: impl Iterator<Item = &'a mut [u8]>) {
    let (eights, rest) = values.as_chunks::<WIDTH>();
    let mut streams: [_; WIDTH] =
        std::array::from_fn(|_| streams.next().unwrap_or_default().as_chunks_mut::<WIDTH>());
    let mut words = [0; WIDTH];
    for (i, eight) in eights.iter().enumerate() {
        for (word, value) in words.iter_mut().zip(eight) {
            *word = value.to_bits();
        }
        transpose(&mut words);
        for ((stream, _), bytes) in streams.iter_mut().zip(&words) {
            stream[i] = bytes.to_le_bytes();
        }
    }
    for (i, value) in rest.iter().enumerate() {
        for ((_, stream), byte) in streams.iter_mut().zip(value.to_bits().to_le_bytes()) {
            stream[i] = byte;
        }
    }
}

/// Transposes a matrix of bytes: byte `i` of word `j` becomes byte `j` of word `i`. Quarters, then their quarters, change
/// places across the diagonal.
#[inline]
fn transpose(words: &mut [u64; WIDTH]) {
    const STEPS: [(usize, u64); 3] =
        [(4, 0x0000_0000_ffff_ffff), (2, 0x0000_ffff_0000_ffff), (1, 0x00ff_00ff_00ff_00ff)];
    for (distance, mask) in STEPS {
        for i in (0..WIDTH).filter(|i| i & distance == 0) {
            let bits = 8 * distance;
            let differing = (words[i] >> bits ^ words[i + distance]) & mask;
            words[i] ^= differing << bits;
            words[i + distance] ^= differing;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_kit::Random;

    /// Byte `j` of value `i` is at place `i` of stream `j`, wherever the batches end and the first difference occurs.
    #[test]
    fn streams_hold_the_bytes_of_the_values() {
        let mut random = Random::new(7);
        for constant in [0, 1, 9, 300] {
            let mut values = vec![-0.25; constant];
            values.extend((0..1000).map(|_| f64::from_bits(random.bits())));
            let mut numbers = Numbers::new();
            let mut rest = values.as_slice();
            while !rest.is_empty() {
                let (batch, more) = rest.split_at(rest.len().min(random.bits() as usize % 40));
                numbers.extend(batch);
                rest = more;
            }
            for (j, stream) in numbers.streams.chunks(ROWS_PER_GROUP).enumerate() {
                for (i, value) in values.iter().enumerate() {
                    assert_eq!(stream[i], value.to_le_bytes()[j], "{constant}: {i} {j}");
                }
            }
        }
    }
}
