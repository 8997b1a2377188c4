//! The compression of pages, with memory that is used again.

use bytes::Bytes;
use std::io;

/// Compresses pages with Snappy.
#[derive(Debug)]
pub(super) struct Compressor {
    snappy: snap::raw::Encoder,
    output: Vec<u8>,
}

impl Compressor {
    /// Without memory yet.
    pub(super) fn new() -> Self {
        Self { snappy: snap::raw::Encoder::new(), output: Vec::new() }
    }

    /// Bytes, compressed.
    ///
    /// # Errors
    /// The library's, beyond 4 GiB.
    pub(super) fn compress(&mut self, bytes: &[u8]) -> io::Result<Bytes> {
        let room = snap::raw::max_compress_len(bytes.len());
        if self.output.len() < room {
            self.output.resize(room, 0);
        }
        let length = self.snappy.compress(bytes, &mut self.output).map_err(io::Error::other)?;
        Ok(Bytes::copy_from_slice(&self.output[..length]))
    }
}
