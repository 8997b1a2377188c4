//! The text of blocks that messages name, read again from their files.
//!
//! The program may already be decoded further on, on another thread, so it is read independently of that.

use crate::diag::Location;
use crate::exec::step::{Opened, SourceRef};
use crate::source::{BlockReader, Position, Sources};
use crate::syntax::ast::Span;
use std::fmt;
use std::sync::Arc;

/// The files of a run, for positions in them.
pub(crate) struct Places {
    sources: Arc<dyn Sources>,
    names: Vec<Arc<str>>,
    files: Vec<File>,
}

/// A file is opened for the first message.
enum File {
    Closed(Opened),
    Open(BlockReader),
    Lost,
}

impl fmt::Debug for Places {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Places").field("names", &self.names).finish_non_exhaustive()
    }
}

impl Places {
    /// No files yet.
    pub(crate) fn new(sources: Arc<dyn Sources>) -> Self {
        Self { sources, names: Vec::new(), files: Vec::new() }
    }

    /// Adds files; [`SourceRef::file`] counts them.
    pub(crate) fn add(&mut self, opened: Vec<Opened>) {
        for file in opened {
            self.names.push(Arc::clone(&file.name));
            self.files.push(File::Closed(file));
        }
    }

    /// Names of the files.
    pub(crate) fn names(&self) -> &[Arc<str>] {
        &self.names
    }

    /// Position and text of a block; `None` before the first one.
    pub(crate) fn locate(&mut self, source: SourceRef) -> Option<Location> {
        if source.line == 0 {
            return None;
        }
        let file = self.files.get_mut(source.file as usize)?;
        if let File::Closed(Opened { written, caller, .. }) = file {
            let found = self.sources.open(written, caller.as_deref());
            *file = found.map_or(File::Lost, |source| File::Open(BlockReader::new(source)));
        }
        let File::Open(reader) = file else { return None };
        let mut location =
            whole_block(reader, self.names.get(source.file as usize)?, position(source))?;
        location.block = source.block;
        Some(location)
    }
}

/// Beginning of a block in its file.
pub(in crate::exec::program) const fn position(source: SourceRef) -> Position {
    Position { offset: source.offset, line: source.line }
}

/// Position of the whole block.
pub(in crate::exec::program) fn whole_block(
    reader: &mut BlockReader,
    name: &Arc<str>,
    position: Position,
) -> Option<Location> {
    reader.seek(position);
    let raw = reader.next_block().ok()??;
    let end = raw.text.trim_end().len();
    let start = end - raw.text[..end].trim_start().len();
    Some(raw.locate(name, Span::new(start, end)))
}
