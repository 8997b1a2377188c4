//! Bytes to logical blocks.

use super::foreign::{UTF_16_BYTES, is_binary, is_utf_16};
use super::regions::{bracket_is_open, ends_in_comment};
use super::{BLOCK_LENGTH_MAX, Piece, Position, RawBlock, Source};
use std::fmt;
use std::io;
use std::ops::Range;
use std::sync::Arc;

/// Number of bytes read at once; more than the longest line that is kept.
const WINDOW: usize = 64 * 1024;

/// Number of bytes of a line that are kept: the longest block in characters of up to four bytes, and one more character
/// to detect longer ones.
const LINE_BYTES: usize = (BLOCK_LENGTH_MAX as usize + 1) * 4;

/// Number of bytes of lines that are examined together when lines are skipped.
const STRETCH: usize = 1024;

/// Byte order mark of UTF-8.
const BOM: &[u8] = b"\xEF\xBB\xBF";

/// Reads a program block by block.
///
/// A block ends with CRLF, LF, CR, NUL, ETX or the end of the program. A line whose last character outside comments is
/// `\` is continued by the next one, whose block number is dropped; while a bracket is open, there may be empty lines
/// and lines that begin with `;` in between.
pub struct BlockReader {
    source: Box<dyn Source>,
    /// Bytes of the program from `base` on.
    window: Vec<u8>,
    /// Valid bytes in `window`.
    filled: usize,
    /// Offset of `window[0]` in the program.
    base: u64,
    /// Next byte in `window`.
    at: usize,
    /// Whether the source returned 0 bytes after the window.
    ended: bool,
    /// Number of the next line.
    line: u32,
    /// Text of a block that is not one line of UTF-8.
    text: String,
    pieces: Vec<Piece>,
}

impl fmt::Debug for BlockReader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("BlockReader")
            .field("source", &self.source.name())
            .field("position", &self.position())
            .finish_non_exhaustive()
    }
}

/// One physical line in the window.
struct Line {
    range: Range<usize>,
    /// Number of bytes that did not fit.
    cut: u64,
}

impl BlockReader {
    /// A reader at the beginning of a program.
    pub fn new(source: Box<dyn Source>) -> Self {
        Self {
            source,
            window: Vec::new(),
            filled: 0,
            base: 0,
            at: 0,
            ended: false,
            line: 1,
            text: String::new(),
            pieces: Vec::new(),
        }
    }

    /// Name of the program.
    pub fn name(&self) -> Arc<str> {
        self.source.name()
    }

    /// Position of the next block.
    pub fn position(&self) -> Position {
        Position { offset: self.base + self.at as u64, line: self.line }
    }

    /// Moves to a position returned by [`position`](Self::position) or contained in a block.
    pub fn seek(&mut self, position: Position) {
        self.line = position.line;
        let inside = position.offset.checked_sub(self.base);
        match inside.and_then(|d| usize::try_from(d).ok()) {
            Some(at) if at <= self.filled => self.at = at,
            _ => {
                self.base = position.offset;
                self.at = 0;
                self.filled = 0;
                self.ended = false;
            }
        }
    }

    /// The next block, `None` at the end of the program.
    ///
    /// # Errors
    /// The error of the source.
    pub fn next_block(&mut self) -> io::Result<Option<RawBlock<'_>>> {
        if self.base + self.at as u64 == 0 {
            self.skip_bom()?;
        }
        let position = self.position();
        let Some(line) = self.next_line()? else { return Ok(None) };
        let bytes = &self.window[line.range.clone()];
        let continued = bytes.trim_ascii_end().last() == Some(&b'\\');
        let plain = !continued && line.cut == 0 && bytes.len() <= BLOCK_LENGTH_MAX as usize;
        let ascii = bytes.is_ascii();
        if !plain || (!ascii && std::str::from_utf8(bytes).is_err()) {
            return self.assemble(position, line).map(Some);
        }
        // The borrow of the window has to begin after the other path, so valid text is validated again.
        let text = std::str::from_utf8(&self.window[line.range]).unwrap_or_default();
        let characters = if ascii { text.len() } else { text.chars().count() };
        let characters = u32::try_from(characters).unwrap_or(u32::MAX);
        Ok(Some(RawBlock { text, position, characters, pieces: &[] }))
    }

    /// Skips lines for as long as `skip` accepts them, the window contains them as a whole, and they contain none of
    /// the `rare` bytes. Each of them has to be a complete block.
    pub(crate) fn skip_lines(&mut self, rare: [u8; 3], skip: impl Fn(&[u8]) -> bool) {
        while self.skip_stretch(rare, &skip) {}
    }

    /// Skips the lines of one stretch; true if all of them were skipped.
    ///
    /// The end of the stretch is searched once rather than line by line.
    fn skip_stretch(&mut self, rare: [u8; 3], skip: &impl Fn(&[u8]) -> bool) -> bool {
        let rest = &self.window[self.at..self.filled];
        let stretch = &rest[..rest.len().min(STRETCH)];
        let found = |end: usize, at: Option<usize>| at.unwrap_or(end);
        let mut until = found(stretch.len(), memchr::memchr2(0, 3, stretch));
        until = found(until, memchr::memchr3(rare[0], rare[1], rare[2], &stretch[..until]));
        let mut next_cr = memchr::memchr(b'\r', &stretch[..until]).unwrap_or(until);
        let mut at = 0;
        while let Some(length) = memchr::memchr(b'\n', &stretch[at..until]) {
            let end = at + length;
            let mut line = &stretch[at..end];
            if next_cr < end {
                // a single CR ends a block as well
                if next_cr + 1 < end {
                    return false;
                }
                line = &stretch[at..next_cr];
                next_cr = memchr::memchr(b'\r', &stretch[end..until]).map_or(until, |i| end + i);
            }
            if !skip(line) {
                return false;
            }
            at = end + 1;
            self.at += length + 1;
            self.line = self.line.saturating_add(1);
        }
        // a line that extends beyond the stretch is examined again from its beginning
        until == stretch.len() && at > 0
    }

    /// Offers the next line if the window contains it with its LF, and moves past it if it is accepted. `take` has to
    /// refuse incomplete blocks: a line with CR, NUL or ETX in it, or one that the next line continues.
    #[inline]
    pub(crate) fn take_line<T>(&mut self, take: impl FnOnce(&[u8]) -> Option<T>) -> Option<T> {
        // `take` does not handle a byte order mark
        if self.base + self.at as u64 == 0 {
            return None;
        }
        let rest = &self.window[self.at..self.filled];
        let length = memchr::memchr(b'\n', rest)?;
        let line = &rest[..length];
        let taken = take(line.strip_suffix(b"\r").unwrap_or(line))?;
        self.at += length + 1;
        self.line = self.line.saturating_add(1);
        Some(taken)
    }

    /// A block in Latin-1, of several lines or too long.
    fn assemble(&mut self, position: Position, first: Line) -> io::Result<RawBlock<'_>> {
        self.text.clear();
        self.pieces.clear();
        let mut characters = 0_u64;
        let mut here = position;
        let mut line = first;
        loop {
            let more = self.append(here, &line);
            characters += more.characters;
            if !more.continued {
                break;
            }
            let open = bracket_is_open(&self.text);
            let next = loop {
                here = self.position();
                let Some(next) = self.next_line()? else { break None };
                let bytes = self.window[next.range.clone()].trim_ascii_start();
                if !(open && (bytes.is_empty() || bytes[0] == b';')) {
                    break Some(next);
                }
            };
            match next {
                Some(next) => line = next,
                None => break,
            }
        }
        let characters = u32::try_from(characters).unwrap_or(u32::MAX);
        Ok(RawBlock { text: &self.text, position, characters, pieces: &self.pieces })
    }

    /// Decodes one line and appends it to the block.
    fn append(&mut self, position: Position, line: &Line) -> Appended {
        let bytes = &self.window[line.range.clone()];
        // A cut may split a character: its remaining bytes must not turn the line into Latin-1.
        let (decoded, latin1) = match std::str::from_utf8(bytes) {
            Ok(text) => (text.to_owned(), false),
            Err(e) if line.cut > 0 && e.error_len().is_none() => {
                (String::from_utf8_lossy(&bytes[..e.valid_up_to()]).into_owned(), false)
            }
            Err(_) => (bytes.iter().copied().map(char::from).collect::<String>(), true),
        };
        let continuation = !self.pieces.is_empty();
        let from = if continuation { own_number(&decoded) } else { 0 };
        let mut part = &decoded[from..];
        let mut characters = part.chars().count() as u64 + line.cut;
        let room = (BLOCK_LENGTH_MAX as usize).saturating_sub(self.text.chars().count());
        // When a block is full, further text is not examined.
        let stripped = part.trim_ascii_end().strip_suffix('\\').filter(|rest| {
            line.cut == 0 && (room == 0 || !ends_in_comment(&format!("{}{rest}", self.text)))
        });
        let continued = stripped.is_some();
        if let Some(rest) = stripped {
            part = rest;
            characters = rest.chars().count() as u64 + 1;
        }
        if let Some((end, _)) = part.char_indices().nth(room) {
            part = &part[..end];
        }
        let start = to_u32(self.text.len());
        // Lines that no longer fit add no piece: the number of pieces is bounded like the text.
        if room > 0 {
            self.text.push_str(part);
            let end = to_u32(self.text.len());
            if continued && room > part.chars().count() {
                self.text.push(' ');
            }
            let text = Arc::from(decoded.as_str());
            let Position { offset, line } = position;
            let column = to_u32(from);
            self.pieces.push(Piece {
                start,
                column,
                offset,
                line,
                latin1,
                end,
                replaces: None,
                text,
            });
        }
        Appended { characters, continued }
    }

    fn skip_bom(&mut self) -> io::Result<()> {
        while self.filled < UTF_16_BYTES && self.fill()? {}
        if is_utf_16(&self.window[..self.filled]) {
            let text = "the text is UTF-16 without a byte order mark; save it as UTF-8";
            return Err(io::Error::new(io::ErrorKind::InvalidData, text));
        }
        match self.window[..self.filled] {
            [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => {
                let text = "the text is UTF-16; save it as UTF-8";
                return Err(io::Error::new(io::ErrorKind::InvalidData, text));
            }
            ref text if text.starts_with(BOM) => self.at = BOM.len(),
            ref bytes if is_binary(bytes) => {
                let text = "the file is not a text: it begins as an archive does, or contains control characters";
                return Err(io::Error::new(io::ErrorKind::InvalidData, text));
            }
            _ => {}
        }
        Ok(())
    }

    /// The next line in the window, without its end; cut off if it is longer than [`LINE_BYTES`].
    fn next_line(&mut self) -> io::Result<Option<Line>> {
        let mut searched = 0;
        loop {
            let rest = &self.window[self.at..self.filled];
            let found = line_end(&rest[searched..]).map(|i| i + searched);
            if let Some(length) = found {
                // CR may be the first half of CRLF: the byte after it must be known.
                if rest[length] == b'\r' && length + 1 == rest.len() && self.fill()? {
                    searched = length;
                    continue;
                }
                let rest = &self.window[self.at..self.filled];
                let end = if rest[length..].starts_with(b"\r\n") { 2 } else { 1 };
                let kept = length.min(LINE_BYTES);
                let range = self.at..self.at + kept;
                self.at += length + end;
                self.line = self.line.saturating_add(1);
                return Ok(Some(Line { range, cut: (length - kept) as u64 }));
            }
            searched = rest.len();
            if searched > LINE_BYTES {
                return self.long_line().map(Some);
            }
            if !self.fill()? {
                if searched == 0 {
                    return Ok(None);
                }
                let range = self.at..self.filled;
                self.at = self.filled;
                self.line = self.line.saturating_add(1);
                return Ok(Some(Line { range, cut: 0 }));
            }
        }
    }

    /// A line that does not end within the limit: keeps its beginning in the window and skips the rest.
    fn long_line(&mut self) -> io::Result<Line> {
        let kept = self.window[self.at..self.at + LINE_BYTES].to_vec();
        self.at += LINE_BYTES;
        let mut cut = 0_u64;
        loop {
            let rest = &self.window[self.at..self.filled];
            if let Some(length) = line_end(rest) {
                cut += length as u64;
                if rest[length] == b'\r' && length + 1 == rest.len() {
                    self.fill()?;
                }
                let rest = &self.window[self.at..self.filled];
                self.at += length + if rest[length..].starts_with(b"\r\n") { 2 } else { 1 };
                break;
            }
            cut += rest.len() as u64;
            self.at = self.filled;
            if !self.fill()? {
                break;
            }
        }
        // The kept bytes are moved in front of the rest; the window then begins earlier in memory, not in the program.
        let tail = self.window[self.at..self.filled].to_vec();
        self.base += self.at as u64;
        self.base -= LINE_BYTES as u64;
        self.window.clear();
        self.window.extend_from_slice(&kept);
        self.window.extend_from_slice(&tail);
        self.at = LINE_BYTES;
        self.filled = self.window.len();
        self.line = self.line.saturating_add(1);
        Ok(Line { range: 0..LINE_BYTES, cut })
    }

    /// Drops used bytes and reads more; false at the end of the program.
    fn fill(&mut self) -> io::Result<bool> {
        if self.ended {
            return Ok(false);
        }
        self.window.copy_within(self.at..self.filled, 0);
        self.base += self.at as u64;
        self.filled -= self.at;
        self.at = 0;
        if self.window.len() < self.filled + WINDOW {
            self.window.resize(self.filled + WINDOW, 0);
        }
        let offset = self.base + self.filled as u64;
        let read = loop {
            match self.source.read_at(offset, &mut self.window[self.filled..]) {
                Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
                result => break result?,
            }
        };
        self.filled += read;
        self.ended = read == 0;
        Ok(read > 0)
    }
}

/// What one line added to a block.
struct Appended {
    characters: u64,
    continued: bool,
}

/// First LF, CR, NUL or ETX.
fn line_end(bytes: &[u8]) -> Option<usize> {
    let end = memchr::memchr3(b'\n', b'\r', 0, bytes);
    memchr::memchr(3, &bytes[..end.unwrap_or(bytes.len())]).or(end)
}

/// Length of blanks and an `N` number at the beginning of a continuation line.
fn own_number(text: &str) -> usize {
    let bytes = text.as_bytes();
    let blanks = bytes.iter().take_while(|b| matches!(b, b' ' | b'\t')).count();
    if !matches!(bytes.get(blanks), Some(b'N' | b'n')) {
        return 0;
    }
    let digits = bytes[blanks + 1..].iter().take_while(|b| b.is_ascii_digit()).count();
    if digits == 0 { 0 } else { blanks + 1 + digits }
}

fn to_u32(v: usize) -> u32 {
    u32::try_from(v).unwrap_or(u32::MAX)
}
