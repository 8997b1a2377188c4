//! Text files of users: lists, recordings, inputs, traces to compare.
//!
//! One reader with one limit for all of them. Files that are not text, or have an endless line, are refused with a
//! plain message before they fill the memory.
//!
//! Order of calls: open a file, then read it line by line to its end or first error.
//!
//! ```
//! use kontur_interpreter::source::text::{Text, beginning};
//! use std::io::Read as _;
//!
//! let mut read = String::new();
//! Text::new(&b"t_s,X_set_mm\n0,1\n"[..])?.read_to_string(&mut read)?;
//! assert_eq!(read.lines().count(), 2);
//! // a file that is not text ends with a sentence
//! let mut zeros = Text::new(std::io::repeat(0))?;
//! assert!(zeros.read_to_string(&mut read).unwrap_err().to_string().contains("not text"));
//! assert_eq!(beginning(&"1".repeat(1000)).len(), 83);
//! # Ok::<(), std::io::Error>(())
//! ```

use crate::diag::QUOTED_MAX;
use std::io::{self, BufRead, BufReader, Read};

/// Largest number of bytes of a line; a longer one is not a line of a table or a list.
pub(crate) const LINE_MAX: usize = 65_536;

/// Bytes of a text file, unchanged.
///
/// Errors: UTF-16, characters with code 0, and a line longer than [`LINE_MAX`].
#[derive(Debug)]
pub struct Text<R> {
    reader: BufReader<R>,
    /// Number of the present line, from 1.
    line: u64,
    /// Its bytes so far.
    length: usize,
}

impl<R: Read> Text<R> {
    /// A text from its beginning.
    ///
    /// # Errors
    /// The system's, and for a text in UTF-16.
    pub fn new(inner: R) -> io::Result<Self> {
        let mut reader = BufReader::with_capacity(1 << 16, inner);
        if let [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] = reader.fill_buf()? {
            return Err(wrong("the text is UTF-16; save it as UTF-8"));
        }
        Ok(Self { reader, line: 1, length: 0 })
    }
}

/// A line, or the beginning of a long one: at most [`QUOTED_MAX`] characters.
pub fn beginning(text: &str) -> String {
    let mut characters = text.chars();
    let mut shown: String = characters.by_ref().take(QUOTED_MAX).collect();
    if characters.next().is_some() {
        shown.push_str("...");
    }
    shown
}

fn wrong(text: impl Into<String>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, text.into())
}

impl<R: Read> Read for Text<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.reader.read(buffer)?;
        let mut rest = &buffer[..count];
        if let Some(at) = memchr::memchr(0, rest) {
            let line = self.line + memchr::memchr_iter(b'\n', &rest[..at]).count() as u64;
            return Err(wrong(format!(
                "line {line} contains a character with code 0: this is not text"
            )));
        }
        while let Some(end) = memchr::memchr(b'\n', rest) {
            self.count(end)?;
            rest = &rest[end + 1..];
            self.line += 1;
            self.length = 0;
        }
        self.count(rest.len())?;
        Ok(count)
    }
}

impl<R> Text<R> {
    fn count(&mut self, bytes: usize) -> io::Result<()> {
        self.length += bytes;
        if self.length <= LINE_MAX {
            return Ok(());
        }
        Err(wrong(format!("line {} is longer than {LINE_MAX} bytes", self.line)))
    }
}

#[cfg(test)]
mod tests {
    use super::{LINE_MAX, Text};
    use std::io::Read;

    fn read(bytes: &[u8]) -> Result<Vec<u8>, String> {
        let mut out = Vec::new();
        let text = Text::new(bytes);
        text.and_then(|mut t| t.read_to_end(&mut out)).map_err(|e| e.to_string())?;
        Ok(out)
    }

    #[test]
    fn text_comes_through_and_everything_else_has_a_reason() {
        assert_eq!(read(b"\xEF\xBB\xBFa,b\r\n1,2").unwrap(), b"\xEF\xBB\xBFa,b\r\n1,2");
        let long = "1".repeat(LINE_MAX);
        assert_eq!(read(format!("{long}\n{long}").as_bytes()).unwrap().len(), 2 * LINE_MAX + 1);
        for (bytes, reason) in [
            (&b"\xFF\xFEt\0"[..], "UTF-16"),
            (b"\xFE\xFF\0t", "UTF-16"),
            (b"a\nb\0", "line 2 contains a character with code 0"),
            (format!("a\n{long}1").as_bytes(), "line 2 is longer than 65536 bytes"),
        ] {
            assert!(read(bytes).unwrap_err().contains(reason), "{reason}");
        }
        // an endless line is refused at once
        let mut endless = Text::new(std::io::repeat(b'7')).unwrap();
        assert!(endless.read_to_end(&mut Vec::new()).is_err());
    }
}
