//! Sources of programs, and their text block by block.
//!
//! The library itself does not open files: programs come through [`Sources`]. [`BlockReader`] converts bytes to logical
//! blocks (line ends, continued lines, encoding, length limit) through a window of fixed size, so memory does not
//! depend on the length of a program or of a line. Words are left to [`crate::syntax`].
//!
//! Order of calls: sources open a program, a reader takes its bytes, [`BlockReader::next_block`] returns the blocks one
//! by one.
//!
//! ```
//! use kontur_interpreter::source::{BlockReader, MemorySources, Sources};
//!
//! let sources = MemorySources::new().with("part.nc", "N10 X1 \\\nY2\nN20 M30\n");
//! let mut blocks = BlockReader::new(sources.open("part.nc", None).unwrap());
//! let block = blocks.next_block().unwrap().unwrap();
//! // a continued line is one block, and the position of every character is known
//! assert_eq!((block.text, block.position.line), ("N10 X1  Y2", 1));
//! assert_eq!(blocks.next_block().unwrap().unwrap().position.line, 3);
//! ```

mod foreign;
mod memory;
mod reader;
pub(crate) mod regions;
#[cfg(test)]
mod tests;
pub mod text;

pub use memory::MemorySources;
pub use reader::BlockReader;

use crate::diag::Location;
use std::io;
use std::sync::Arc;

/// Longest block in characters; 20301 warns about longer ones.
///
/// Source: TF5200 programming manual, block structure.
pub(crate) const BLOCK_LENGTH: u32 = 4000;

/// Longest block that is decoded, in characters; above it 20301 is an error.
///
/// Source: TF5200 diagnosis, 20301. The limit holds for the joined block if lines are continued.
pub(crate) const BLOCK_LENGTH_MAX: u32 = 4096;

/// Opens programs.
pub trait Sources: Send + Sync {
    /// Opens `name`, as written in the program `caller` (its [`Source::name`]) or on the command line.
    ///
    /// # Errors
    /// If a program of that name cannot be opened; the error lists every place that was tried.
    fn open(&self, name: &str, caller: Option<&str>) -> Result<Box<dyn Source>, OpenError>;

    /// A program that has changed since it was first opened, and how that was noticed; called at the end of a run.
    fn changed(&self) -> Option<(String, io::Error)> {
        None
    }
}

/// Bytes of one program.
pub trait Source: Send {
    /// Name in messages, also used as the caller of called programs.
    fn name(&self) -> Arc<str>;

    /// Reads bytes from `offset` on into `buffer` and returns their number; 0 at the end of the program.
    ///
    /// # Errors
    /// The error of the read operation.
    fn read_at(&mut self, offset: u64, buffer: &mut [u8]) -> io::Result<usize>;
}

/// A program could not be opened (K-0013).
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name}: {reason}")]
pub struct OpenError {
    /// Requested name.
    pub name: String,
    /// Reason.
    pub reason: String,
    /// Places tried, in order.
    pub searched: Vec<String>,
}

/// Position of a block in a program, for [`BlockReader::seek`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Offset of the first byte of the block's first line.
    pub offset: u64,
    /// Number of that line, from 1.
    pub line: u32,
}

impl Position {
    /// The beginning of a program.
    pub const START: Self = Self { offset: 0, line: 1 };
}

impl Default for Position {
    fn default() -> Self {
        Self::START
    }
}

/// A part of a block's text that is contiguous in one line of the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Start in the block's text, in bytes.
    pub start: u32,
    /// Start in its line as decoded, in bytes.
    pub column: u32,
    /// Offset of the line in the program.
    pub offset: u64,
    /// Number of the line, from 1.
    pub line: u32,
    /// Whether the line was decoded as Latin-1, with one byte in the program per character.
    pub latin1: bool,
    /// End of the line in the block's text; the text after it belongs to the next piece.
    pub end: u32,
    /// Length in bytes of the text that the piece replaces (use of a macro): all of the piece has one position in the
    /// program.
    pub replaces: Option<u32>,
    /// The decoded line.
    pub text: Arc<str>,
}

/// A piece of the text of a block, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Span {
    /// Offset of the first byte from the start of the block's text.
    pub start: u32,
    /// Length in bytes; 0 marks a position between two bytes.
    pub len: u32,
}

impl Span {
    /// The span from `start` up to, but not including, `end` (bytes of the block's text).
    pub fn new(start: usize, end: usize) -> Self {
        let clamp = |v: usize| u32::try_from(v).unwrap_or(u32::MAX);
        Self { start: clamp(start), len: clamp(end.saturating_sub(start)) }
    }

    /// First byte after the span.
    pub fn end(self) -> u32 {
        self.start.saturating_add(self.len)
    }

    /// The smallest span that contains both.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        let start = self.start.min(other.start);
        Self { start, len: self.end().max(other.end()) - start }
    }
}

/// One logical block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RawBlock<'a> {
    /// Text without line ends; continued lines are joined, with a blank for each `\`. At most
    /// [`BLOCK_LENGTH_MAX`] characters.
    pub text: &'a str,
    /// Position in the program.
    pub position: Position,
    /// Length in characters, including text that was cut off.
    pub characters: u32,
    /// Pieces of the text; empty for a block of one line in UTF-8.
    pub pieces: &'a [Piece],
}

impl<'a> RawBlock<'a> {
    /// A block of one line at the beginning of a program, for tests and single lines from elsewhere.
    pub fn from_line(text: &'a str) -> Self {
        let characters = u32::try_from(text.chars().count()).unwrap_or(u32::MAX);
        let end = text.char_indices().nth(BLOCK_LENGTH_MAX as usize).map_or(text.len(), |(i, _)| i);
        Self { text: &text[..end], position: Position::START, characters, pieces: &[] }
    }

    /// Line, column, offset and source text of a span of this block in the program called `file`.
    pub fn locate(&self, file: &Arc<str>, span: Span) -> Location {
        let start = span.start as usize;
        let piece = self.pieces.iter().rev().find(|piece| piece.start as usize <= start);
        let (line, offset, text, mut from, mut to, latin1) = match piece {
            None => (
                self.position.line,
                self.position.offset,
                Arc::from(self.text),
                start,
                span.end() as usize,
                false,
            ),
            Some(piece) => {
                let text = Arc::clone(&piece.text);
                let column = piece.column as usize;
                let (from, to) = if let Some(length) = piece.replaces {
                    (column, column + length as usize)
                } else {
                    let end = span.end().min(piece.end) as usize;
                    let begin = piece.start as usize;
                    (start - begin + column, end.max(start) - begin + column)
                };
                (piece.line, piece.offset, text, from, to, piece.latin1)
            }
        };
        from = floor_boundary(&text, from);
        to = floor_boundary(&text, to).max(from);
        let before = count(&text[..from]);
        Location {
            file: Arc::clone(file),
            line,
            column: before.saturating_add(1),
            offset: offset + if latin1 { u64::from(before) } else { from as u64 },
            length: count(&text[from..to]).max(1),
            block: None,
            text,
        }
    }
}

/// Characters of a text.
fn count(text: &str) -> u32 {
    u32::try_from(text.chars().count()).unwrap_or(u32::MAX)
}

/// The last character boundary at or before `at`.
fn floor_boundary(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}
