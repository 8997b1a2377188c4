//! Open program files: text, structure, and the parsed blocks that run more than once, which are those of [`parsed`](super::parsed).

use super::index::{Index, Labels, STRUCTURE_MAX, Section, build};
use super::parsed::{Fetched, Macros, Parsed, Tree, parse};
use super::places::whole_block;
use super::reads::Reads;
use super::state::Numbers;
use super::unusable::{FileError, is_foreign};
use crate::diag::{Diagnostic, Location};
use crate::exec::options::SkipLevels;
use crate::exec::step::Opened;
use crate::exec::values::variables::external;
use crate::source::{BlockReader, OpenError, Position, Sources};
use crate::syntax::ast::{Block, LabelKind, Span};
use crate::syntax::macros;
use crate::syntax::{Parser, Plain, PlainFrame, PlainWord};
use std::collections::BTreeMap;
use std::io;
use std::sync::Arc;

/// Maximum number of parsed blocks kept for all files; further ones are parsed again on every pass.
const CACHED_MAX: usize = 50_000;

/// Maximum number of block numbers used more than once that are kept per program.
const TWICE_MAX: usize = 10_000;

/// One file.
#[derive(Debug)]
pub(in crate::exec) struct ProgramFile {
    pub(in crate::exec::program) name: Arc<str>,
    reader: BlockReader,
    pub(in crate::exec::program) index: Arc<Index>,
    cache: BTreeMap<u64, (Arc<Parsed>, Position)>,
}

/// The structure of files that were read as a whole before, with the faults found in it.
///
/// A check leaves it to the run that follows, which so reads each text once less. A text that changes between them is an
/// error at the end of the run, see [`Sources::changed`].
#[derive(Debug, Default)]
pub(crate) struct Structures(BTreeMap<Arc<str>, (Arc<Index>, Vec<Diagnostic>)>);

/// The way a block is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) struct Reading {
    /// Whether to keep the block, because it runs again.
    pub(in crate::exec::program) keep: bool,
    /// Between `#VAR` and `#ENDVAR`.
    pub(in crate::exec::program) declaration: bool,
}

/// The way a block that is not executed is checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Look {
    /// No check.
    Pass,
    Block,
    /// Between `#VAR` and `#ENDVAR`.
    Declaration,
}

/// All files of a run.
pub(in crate::exec) struct Files {
    sources: Arc<dyn Sources>,
    /// Levels whose blocks are skipped (`/`).
    skip: SkipLevels,
    open: Vec<ProgramFile>,
    names: Vec<Arc<str>>,
    /// Those that have not been taken by [`Self::take_opened`].
    opened: Vec<Opened>,
    cached: usize,
    /// The last plain block read.
    plain: Plain,
    /// Files by the name written in a program of a file.
    resolved: BTreeMap<(usize, Box<str>), usize>,
    /// External variables that are read without a stop.
    asynchronous: external::Names,
    structures: Structures,
}

impl Files {
    /// No files yet; `structures`: those that an earlier pass over the same texts has found.
    pub(in crate::exec) fn new(
        sources: Arc<dyn Sources>,
        skip: SkipLevels,
        asynchronous: external::Names,
        structures: Structures,
    ) -> Self {
        Self {
            sources,
            skip,
            open: Vec::new(),
            names: Vec::new(),
            opened: Vec::new(),
            cached: 0,
            plain: Plain::default(),
            resolved: BTreeMap::new(),
            asynchronous,
            structures,
        }
    }

    /// External variables that are read without a stop.
    pub(in crate::exec::program) fn asynchronous(&self) -> &external::Names {
        &self.asynchronous
    }

    /// The structure of all files opened so far.
    pub(in crate::exec::program) fn into_structures(self) -> Structures {
        self.structures
    }

    /// The block to which [`Fetched::Plain`] refers.
    pub(in crate::exec) fn plain(&self) -> &Plain {
        &self.plain
    }

    pub(in crate::exec) fn names(&self) -> &[Arc<str>] {
        &self.names
    }

    /// Whether files have been opened since the last call of [`Self::take_opened`].
    pub(in crate::exec) fn has_opened(&self) -> bool {
        !self.opened.is_empty()
    }

    /// Files opened since the last call, in the order of [`Self::names`].
    pub(in crate::exec) fn take_opened(&mut self) -> Vec<Opened> {
        std::mem::take(&mut self.opened)
    }

    pub(in crate::exec) fn file(&self, file: usize) -> &ProgramFile {
        &self.open[file]
    }

    /// Whether a block is skipped (`/`).
    pub(in crate::exec::program) fn skips(&self, block: &Block) -> bool {
        block.skip.is_some_and(|level| self.skip.contains(level))
    }

    /// The path of a file that a program of file `caller` names, relative to the folder of the latter, without opening it for the
    /// program.
    ///
    /// # Errors
    /// Where it was searched.
    pub(in crate::exec::program) fn search(
        &self,
        name: &str,
        caller: Option<usize>,
    ) -> Result<String, OpenError> {
        let caller = caller.map(|file| &*self.names[file]);
        let path = self.sources.open(name, caller)?.name();
        let caller = caller.unwrap_or_default();
        let folder = caller.rfind(['/', '\\']).map_or("", |last| &caller[..=last]);
        Ok(path.strip_prefix(folder).unwrap_or(&path).to_owned())
    }

    /// The file with a name as written in `caller`. Faults in the structure of a new file are returned as well.
    pub(in crate::exec) fn open(
        &mut self,
        name: &str,
        caller: Option<usize>,
        parser: &Parser,
    ) -> Result<(usize, Vec<Diagnostic>), FileError> {
        if let Some(caller) = caller
            && let Some(file) = self.resolved.get(&(caller, Box::from(name)))
        {
            return Ok((*file, Vec::new()));
        }
        let caller_name = caller.map(|c| Arc::clone(&self.names[c]));
        let source = self.sources.open(name, caller_name.as_deref()).map_err(FileError::Open)?;
        let full = source.name();
        let known = self.names.iter().position(|n| *n == full);
        let (file, diagnostics) = if let Some(file) = known {
            (file, Vec::new())
        } else {
            let mut reader = BlockReader::new(source);
            // the main program was named by the user
            if caller.is_some()
                && is_foreign(&mut reader, &full, parser).map_err(FileError::Read)?
            {
                return Err(FileError::Foreign(full));
            }
            let (index, diagnostics) = if let Some(known) = self.structures.0.get(&full) {
                known.clone()
            } else {
                let (index, found) =
                    build(&mut reader, &full, self.skip).map_err(FileError::Read)?;
                let structure = (Arc::new(index), found);
                self.structures.0.insert(Arc::clone(&full), structure.clone());
                structure
            };
            self.names.push(Arc::clone(&full));
            self.opened.push(Opened {
                name: Arc::clone(&full),
                written: Box::from(name),
                caller: caller_name,
            });
            self.open.push(ProgramFile { name: full, reader, index, cache: BTreeMap::new() });
            (self.open.len() - 1, diagnostics)
        };
        if let Some(caller) = caller {
            self.resolved.insert((caller, Box::from(name)), file);
        }
        Ok((file, diagnostics))
    }

    /// Discards parsed blocks, because names or macros have changed.
    pub(in crate::exec) fn forget(&mut self) {
        for file in &mut self.open {
            file.cache.clear();
        }
        self.cached = 0;
    }

    /// Makes room for the blocks of a new loop.
    pub(in crate::exec) fn make_room(&mut self) {
        if self.cached >= CACHED_MAX {
            self.forget();
        }
    }

    /// The block at a position, and the position of the next one; `None` at the end of the file.
    pub(in crate::exec) fn block(
        &mut self,
        file: usize,
        position: Position,
        reading: Reading,
        parser: &Parser,
        table: &Macros,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> io::Result<Option<(Fetched, Position)>> {
        let Self { open, plain, asynchronous, .. } = self;
        let ProgramFile { name, reader, cache, .. } = &mut open[file];
        if reading.keep
            && let Some((parsed, next)) = cache.get(&position.offset)
        {
            return Ok(Some((Fetched::Tree(Tree::Kept(Arc::clone(parsed))), *next)));
        }
        reader.seek(position);
        let Some(raw) = reader.next_block()? else { return Ok(None) };
        if !reading.keep && !reading.declaration && Parser::plain(&raw, plain) {
            diagnostics.extend(Parser::note(&raw, plain, name));
            return Ok(Some((Fetched::Plain, reader.position())));
        }
        let before = diagnostics.len();
        let block = parse(&raw, name, reading.declaration, parser, table, diagnostics);
        let faulty = diagnostics[before..].iter().any(Diagnostic::is_error);
        let next = reader.position();
        let parsed = Parsed { reads: Reads::of(&block, asynchronous), block, faulty };
        if !reading.keep || self.cached >= CACHED_MAX {
            return Ok(Some((Fetched::Tree(Tree::Once(parsed)), next)));
        }
        let parsed = Arc::new(parsed);
        cache.insert(position.offset, (Arc::clone(&parsed), next));
        self.cached += 1;
        Ok(Some((Fetched::Tree(Tree::Kept(parsed)), next)))
    }

    /// Reads the line at a position as a plain block, as [`Parser::plain_line`] does, and returns the position of the
    /// next one as well. `None` also if its kind shows only when it is read as a block.
    #[inline]
    pub(in crate::exec) fn plain_line(
        &mut self,
        file: usize,
        at: Position,
        take: impl FnMut(PlainWord) -> bool,
    ) -> Option<(PlainFrame, Position)> {
        let ProgramFile { reader, .. } = &mut self.open[file];
        reader.seek(at);
        let frame = reader.take_line(|line| Parser::plain_line(line, take))?;
        Some((frame, reader.position()))
    }

    /// The syntax of a block that is not executed, and the position of the next one. A diagnostic is marked if it
    /// concerns the block number or a control statement.
    pub(in crate::exec) fn look(
        &mut self,
        file: usize,
        position: Position,
        look: Look,
        parser: &Parser,
        table: &Macros,
        found: &mut Vec<(Diagnostic, bool)>,
    ) -> io::Result<Option<(Block, Position)>> {
        let ProgramFile { name, reader, .. } = &mut self.open[file];
        reader.seek(position);
        let Some(raw) = reader.next_block()? else { return Ok(None) };
        let mut block = Block::default();
        if look != Look::Pass {
            let (mut structure, mut all) = (Vec::new(), Vec::new());
            parser.inactive(&raw, name, &mut structure);
            block = parse(&raw, name, look == Look::Declaration, parser, table, &mut all);
            let same = |d: &Diagnostic| {
                structure.iter().any(|s| {
                    s.id == d.id
                        && s.source.as_ref().map(|l| l.offset)
                            == d.source.as_ref().map(|l| l.offset)
                })
            };
            found.extend(all.into_iter().map(|d| {
                let is_structure = same(&d);
                (d, is_structure)
            }));
        }
        Ok(Some((block, reader.position())))
    }

    /// Position of the first block with each number in a section, outside `#COMMENT`; `None` if there are too many to
    /// keep.
    ///
    /// # Errors
    /// The file cannot be read.
    pub(super) fn numbers(&mut self, file: usize, section: usize) -> io::Result<Option<Numbers>> {
        let ProgramFile { reader, index, .. } = &mut self.open[file];
        let Section { start, end, .. } = index.sections[section];
        reader.seek(start);
        let (mut numbers, mut twice) = (Labels::default(), BTreeMap::new());
        while reader.position().offset < end && numbers.bytes() <= STRUCTURE_MAX {
            let Some(raw) = reader.next_block()? else { break };
            let Some(number) = super::index::number_of(raw.text).map(LabelKind::Number) else {
                continue;
            };
            let Some(place) = index.block(raw.position) else { continue };
            if numbers.get(section, &number).is_none() {
                numbers.insert(section, number, place);
            } else if let LabelKind::Number(number) = number
                && twice.len() < TWICE_MAX
            {
                twice.entry(number).or_insert(raw.position.line);
            }
        }
        Ok(Some(Numbers { first: numbers, twice }).filter(|n| n.first.bytes() <= STRUCTURE_MAX))
    }

    /// Position of the block that follows the one at a position.
    pub(super) fn behind(&mut self, file: usize, position: Position) -> Position {
        let ProgramFile { reader, .. } = &mut self.open[file];
        reader.seek(position);
        // it was read before: where it can no longer be read, the file ends
        match reader.next_block() {
            Ok(Some(_)) => reader.position(),
            _ => position,
        }
    }

    /// Position of the whole block.
    pub(in crate::exec) fn locate_block(
        &mut self,
        file: usize,
        position: Position,
    ) -> Option<Location> {
        let ProgramFile { name, reader, .. } = self.open.get_mut(file)?;
        whole_block(reader, name, position)
    }

    /// Position of a span within the block.
    pub(in crate::exec) fn locate(
        &mut self,
        file: usize,
        position: Position,
        span: Span,
        table: &Macros,
    ) -> Option<Location> {
        let ProgramFile { name, reader, .. } = &mut self.open[file];
        reader.seek(position);
        let raw = reader.next_block().ok()??;
        let lookup = |name: &str| table.get(name).map(|text| &**text);
        match macros::expand(&raw, name, &lookup) {
            Ok(Some(expanded)) => Some(expanded.raw().locate(name, span)),
            _ => Some(raw.locate(name, span)),
        }
    }
}
