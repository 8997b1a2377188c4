//! A column of numbers as one page: split into byte streams, compressed, with its least and greatest value.
//!
//! The library's own writer of columns gives the same page. It copies the values, asks for the memory of every step anew and
//! moves one byte at a time, which costs more than twice as much; and numbers are nearly all of a trace.

use ::parquet::basic::{Compression, Encoding, PageType};
use ::parquet::column::page::{CompressedPage, Page, PageWriter as _};
use ::parquet::column::writer::ColumnCloseResult;
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::{ColumnChunkMetaData, PageEncodingStats};
use ::parquet::file::statistics::{Statistics, ValueStatistics};
use ::parquet::file::writer::{SerializedPageWriter, SerializedRowGroupWriter, TrackedWrite};
use ::parquet::schema::types::ColumnDescPtr;
use bytes::Bytes;
use snap::raw::{Encoder, max_compress_len};
use std::io::Write;

/// Bytes of a number.
const BYTES: usize = 8;

/// Writes columns of numbers, one after the other, in the same memory.
#[derive(Debug)]
pub(super) struct NumberPages {
    /// All first bytes, then all second bytes, ...
    streams: Vec<u8>,
    /// The same compressed, and room for what cannot be.
    packed: Vec<u8>,
    /// Header and page.
    chunk: Vec<u8>,
    snappy: Encoder,
}

impl NumberPages {
    pub(super) fn new() -> Self {
        let (streams, packed, chunk) = (Vec::new(), Vec::new(), Vec::new());
        Self { streams, packed, chunk, snappy: Encoder::new() }
    }

    /// Writes numbers as the next column of a group.
    ///
    /// # Errors
    /// Of the library and of what it writes to.
    pub(super) fn put<W: Write + Send>(
        &mut self,
        group: &mut SerializedRowGroupWriter<'_, W>,
        column: &ColumnDescPtr,
        values: &[f64],
    ) -> Result<(), ParquetError> {
        let size = values.len() * BYTES;
        self.streams.resize(size, 0);
        split(values, &mut self.streams);
        // what is longer from before is not written again
        let room = max_compress_len(size).max(self.packed.len());
        self.packed.resize(room, 0);
        let packed_size = self.snappy.compress(&self.streams, &mut self.packed)?;

        let packed = Bytes::from(std::mem::take(&mut self.packed));
        self.chunk.clear();
        let mut sink = TrackedWrite::new(std::mem::take(&mut self.chunk));
        let page = Page::DataPage {
            buf: packed.slice(..packed_size),
            num_values: u32::try_from(values.len())?,
            encoding: Encoding::BYTE_STREAM_SPLIT,
            def_level_encoding: Encoding::RLE,
            rep_level_encoding: Encoding::RLE,
            statistics: None,
        };
        let written =
            SerializedPageWriter::new(&mut sink).write_page(CompressedPage::new(page, size))?;
        let chunk = Bytes::from(sink.into_inner()?);
        let pages = PageEncodingStats {
            page_type: PageType::DATA_PAGE,
            encoding: Encoding::BYTE_STREAM_SPLIT,
            count: 1,
        };
        let metadata = ColumnChunkMetaData::builder(column.clone())
            .set_compression(Compression::SNAPPY)
            .set_encodings(vec![Encoding::RLE, Encoding::BYTE_STREAM_SPLIT])
            .set_page_encoding_stats(vec![pages])
            .set_num_values(i64::try_from(values.len())?)
            .set_total_compressed_size(i64::try_from(written.compressed_size)?)
            .set_total_uncompressed_size(i64::try_from(written.uncompressed_size)?)
            .set_data_page_offset(0)
            .set_statistics(statistics(values))
            .build()?;
        let closed = ColumnCloseResult {
            bytes_written: written.bytes_written,
            rows_written: values.len() as u64,
            metadata,
            bloom_filter: None,
            column_index: None,
            offset_index: None,
        };
        group.append_column(&chunk, closed)?;
        // nobody else holds them any more: they come back without a copy
        (self.packed, self.chunk) = (packed.into(), chunk.into());
        Ok(())
    }
}

/// Moves byte `i` of every number to the `i`-th of eight parts.
fn split(values: &[f64], streams: &mut [u8]) {
    let (eights, rest) = values.as_chunks::<BYTES>();
    let mut places = streams.chunks_exact_mut(values.len().max(1));
    let mut streams: [_; BYTES] = std::array::from_fn(|_| places.next().unwrap_or_default());
    for (j, stream) in streams.iter_mut().enumerate() {
        for (place, value) in stream[eights.len() * BYTES..].iter_mut().zip(rest) {
            *place = value.to_le_bytes()[j];
        }
    }
    // of the same length, so that it is looked at once
    let [a, b, c, d, e, f, g, h] =
        streams.map(|stream| &mut stream.as_chunks_mut::<BYTES>().0[..eights.len()]);
    for (i, eight) in eights.iter().enumerate() {
        let mut words = [0; BYTES];
        for j in 0..BYTES {
            words[j] = eight[j].to_bits();
        }
        let words = transposed(words);
        a[i] = words[0].to_le_bytes();
        b[i] = words[1].to_le_bytes();
        c[i] = words[2].to_le_bytes();
        d[i] = words[3].to_le_bytes();
        e[i] = words[4].to_le_bytes();
        f[i] = words[5].to_le_bytes();
        g[i] = words[6].to_le_bytes();
        h[i] = words[7].to_le_bytes();
    }
}

/// Byte `j` of word `i` becomes byte `i` of word `j`: halves change places, then quarters, then bytes.
#[inline]
fn transposed([a, b, c, d, e, f, g, h]: [u64; BYTES]) -> [u64; BYTES] {
    /// The upper parts of `a` change places with the lower ones of `b`.
    #[inline]
    fn exchange<const BITS: u32>(low: u64, a: u64, b: u64) -> (u64, u64) {
        let both = (a >> BITS ^ b) & low;
        (a ^ both << BITS, b ^ both)
    }
    let halves = |a, b| exchange::<32>(0x0000_0000_ffff_ffff, a, b);
    let quarters = |a, b| exchange::<16>(0x0000_ffff_0000_ffff, a, b);
    let bytes = |a, b| exchange::<8>(0x00ff_00ff_00ff_00ff, a, b);
    let ((a, e), (b, f), (c, g), (d, h)) = (halves(a, e), halves(b, f), halves(c, g), halves(d, h));
    let ((a, c), (b, d), (e, g), (f, h)) =
        (quarters(a, c), quarters(b, d), quarters(e, g), quarters(f, h));
    let ((a, b), (c, d), (e, f), (g, h)) = (bytes(a, b), bytes(c, d), bytes(e, f), bytes(g, h));
    [a, b, c, d, e, f, g, h]
}

/// Least and greatest number and how many are none (NaN). By the order of the format -0 lies before 0, and a bound may be
/// wider than what is there.
fn statistics(values: &[f64]) -> Statistics {
    let (fours, rest) = values.as_chunks::<4>();
    let (mut least, mut greatest, mut nans) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4], 0);
    let mut take = |i: usize, value: f64| {
        // nothing is less or greater than what is no number
        least[i] = if value < least[i] { value } else { least[i] };
        greatest[i] = if value > greatest[i] { value } else { greatest[i] };
    };
    for four in fours {
        (0..4).for_each(|i| take(i, four[i]));
    }
    for value in rest {
        take(0, *value);
    }
    for value in values {
        nans += u64::from(value.is_nan());
    }
    let least = least.into_iter().fold(f64::INFINITY, f64::min);
    let greatest = greatest.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let bounds = (nans < values.len() as u64).then(|| {
        (if least == 0.0 { -0.0 } else { least }, if greatest == 0.0 { 0.0 } else { greatest })
    });
    let (least, greatest) = bounds.unzip();
    ValueStatistics::new(least, greatest, None, Some(0), false).with_nan_count(Some(nans)).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_kit::Random;

    /// Numbers of any bits, and those that are special.
    fn numbers(random: &mut Random, count: usize) -> Vec<f64> {
        let special = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1.5];
        let mut number = || {
            let bits = random.bits() ^ random.bits() >> 32;
            if random.chance(0.5) { random.pick(&special) } else { f64::from_bits(bits) }
        };
        (0..count).map(|_| number()).collect()
    }

    #[test]
    fn every_byte_comes_to_its_stream() {
        let mut random = Random::new(1);
        for count in (0..40).chain([1000, 1001]) {
            let values = numbers(&mut random, count);
            let mut streams = vec![0; BYTES * count];
            split(&values, &mut streams);
            for (i, value) in values.iter().enumerate() {
                for (j, byte) in value.to_le_bytes().into_iter().enumerate() {
                    assert_eq!(streams[j * count + i], byte, "byte {j} of number {i} of {count}");
                }
            }
        }
    }

    /// No number lies outside of the bounds in the order of the format, and both are there but for the sign of a zero.
    #[test]
    fn the_bounds_are_those_of_the_numbers() {
        let mut random = Random::new(2);
        for case in 0..2000 {
            let count = random.below(12);
            let values = numbers(&mut random, count);
            let Statistics::Double(found) = statistics(&values) else { panic!("other numbers") };
            let is: Vec<f64> = values.iter().copied().filter(|v| !v.is_nan()).collect();
            assert_eq!(found.nan_count_opt(), Some((count - is.len()) as u64), "case {case}");
            let (least, greatest) = (found.min_opt(), found.max_opt());
            assert_eq!((least.is_some(), greatest.is_some()), (!is.is_empty(), !is.is_empty()));
            for value in &is {
                assert!(least.unwrap().total_cmp(value).is_le(), "case {case}: {values:?}");
                assert!(greatest.unwrap().total_cmp(value).is_ge(), "case {case}: {values:?}");
            }
            assert!(least.is_none_or(|l| is.contains(l)), "case {case}: {values:?}");
            assert!(greatest.is_none_or(|g| is.contains(g)), "case {case}: {values:?}");
        }
    }
}
