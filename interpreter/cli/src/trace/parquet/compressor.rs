//! The compression of pages, with memory that is used again.

use bytes::Bytes;
use std::io;

/// Compresses pages with Snappy.
#[derive(Debug)]
pub(super) struct Compressor {
    snappy: snap::raw::Encoder,
    /// The last page and the room behind it.
    output: Bytes,
}

impl Compressor {
    /// Without memory yet.
    pub(super) fn new() -> Self {
        Self { snappy: snap::raw::Encoder::new(), output: Bytes::new() }
    }

    /// Bytes, compressed. The result shares its memory with the next one, which takes new memory if it is still in use.
    ///
    /// # Errors
    /// The library's, beyond 4 GiB.
    pub(super) fn compress(&mut self, bytes: &[u8]) -> io::Result<Bytes> {
        let room = snap::raw::max_compress_len(bytes.len());
        // the last page is in its chunk by now, so its memory is free
        let last = std::mem::take(&mut self.output);
        let mut output = last.try_into_mut().unwrap_or_default();
        if output.len() < room {
            output.resize(room, 0);
        }
        let length = self.snappy.compress(bytes, &mut output).map_err(io::Error::other)?;
        self.output = output.freeze();
        Ok(self.output.slice(..length))
    }
}
