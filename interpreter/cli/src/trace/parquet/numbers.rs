//! A numeric column of a group: its byte streams, or the only value that it has.
//!
//! The values of a batch are split as soon as they arrive, while they are in the cache of the processor, and the page is
//! compressed from there. A column that does not change within a group is a dictionary of one value and one run of
//! indices to it: some 80 bytes instead of 25 KB, and nothing to split or compress.

use super::chunk::{Chunk, data_page, dictionary, run};
use super::compressor::Compressor;
use super::group::ROWS_PER_GROUP;
use ::parquet::basic::{Compression, Encoding};
use ::parquet::schema::types::ColumnDescPtr;
use bytes::Bytes;
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
        // only the last group is not full
        let joined: Vec<u8>;
        let streams = if self.rows == ROWS_PER_GROUP {
            &self.streams
        } else {
            let streams = self.streams.chunks_exact(ROWS_PER_GROUP);
            joined = streams.map(|stream| &stream[..self.rows]).collect::<Vec<_>>().concat();
            &joined
        };
        let page = compressor.compress(streams)?;
        let page = data_page(page, self.rows, Encoding::BYTE_STREAM_SPLIT);
        let pages = [(page, streams.len())];
        Chunk::of_pages(column, self.rows, Compression::SNAPPY, pages, None)
    }

    fn encode_constant(&self, column: ColumnDescPtr) -> io::Result<Chunk> {
        let only = dictionary(Bytes::copy_from_slice(&self.first.to_le_bytes()), 1);
        let mut indices = vec![1];
        run(&mut indices, 0, self.rows, 1);
        let length = indices.len();
        let indices = data_page(indices.into(), self.rows, Encoding::RLE_DICTIONARY);
        let pages = [(only, WIDTH), (indices, length)];
        Chunk::of_pages(column, self.rows, Compression::UNCOMPRESSED, pages, None)
    }
}

/// Distributes the bytes of values to their streams, the lowest byte to the first one.
fn split<'a>(values: &[f64], mut streams: impl Iterator<Item = &'a mut [u8]>) {
    let (eights, rest) = values.as_chunks::<WIDTH>();
    let count = eights.len();
    let mut streams: [_; WIDTH] = std::array::from_fn(|_| {
        let (eights, rest) = streams.next().unwrap_or_default().as_chunks_mut::<WIDTH>();
        (&mut eights[..count], rest)
    });
    for (i, eight) in eights.iter().enumerate() {
        // iterators over these eight would be calls wherever the library is not optimised together with its users
        let (mut words, mut j) = ([0; WIDTH], 0);
        while j < WIDTH {
            words[j] = eight[j].to_bits();
            j += 1;
        }
        exchange::<4>(&mut words, 0x0000_0000_ffff_ffff);
        exchange::<2>(&mut words, 0x0000_ffff_0000_ffff);
        exchange::<1>(&mut words, 0x00ff_00ff_00ff_00ff);
        j = 0;
        while j < WIDTH {
            streams[j].0[i] = words[j].to_le_bytes();
            j += 1;
        }
    }
    for (i, value) in rest.iter().enumerate() {
        for ((_, stream), byte) in streams.iter_mut().zip(value.to_bits().to_le_bytes()) {
            stream[i] = byte;
        }
    }
}

/// A step of the transposition of a matrix of bytes, after which byte `i` of word `j` is byte `j` of word `i`: blocks of
/// `DISTANCE` bytes and words, those of `mask`, change places across the diagonal.
#[inline]
fn exchange<const DISTANCE: usize>(words: &mut [u64; WIDTH], mask: u64) {
    let bits = 8 * DISTANCE;
    let mut i = 0;
    while i < WIDTH {
        if i & DISTANCE == 0 {
            let differing = (words[i] >> bits ^ words[i + DISTANCE]) & mask;
            words[i] ^= differing << bits;
            words[i + DISTANCE] ^= differing;
        }
        i += 1;
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
