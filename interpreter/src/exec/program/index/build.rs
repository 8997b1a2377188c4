//! Builds the index of a file: its sections, labels and control statements with their partners.

mod control;
mod sections;

use super::LABEL_MAX;
use super::entry::{Entry, EntryId};
use super::head::{
    Head, SAYING, behind_command, blank, ends_program, head, is_command, real_time_cycle,
    says_nothing, split_word, word,
};
use super::keyword::Keyword;
use super::{Index, LabelPlace};
use crate::diag::{Condition, Diagnostic, Location};
use crate::exec::options::SkipLevels;
use crate::source::{BLOCK_LENGTH_MAX, BlockReader, Position, RawBlock};
use crate::syntax::ast::{LabelKind, Span};
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::sync::Arc;

/// Maximum memory in bytes for control statements, labels and programs of one file: only its structure is kept.
pub(in crate::exec::program) const STRUCTURE_MAX: usize = 100_000_000;

/// Memory in bytes of a program or a local subroutine, including its name.
const SECTION_BYTES: usize = 256;

/// Maximum number of structural faults reported for one file.
const DIAGNOSTICS_MAX: usize = 100;

/// State of the pass over the text.
struct Builder<'a> {
    pub(super) file: &'a Arc<str>,
    pub(super) index: Index,
    /// Open structures.
    stack: Vec<EntryId>,
    /// Structures open at each open `#IF`.
    conditional: Vec<Vec<EntryId>>,
    /// Open `#IF`s.
    conditional_open: Vec<EntryId>,
    /// Last clause of each open structure.
    last_clause: BTreeMap<EntryId, EntryId>,
    /// Open structures that have had their `$DEFAULT`.
    defaults: BTreeSet<EntryId>,
    /// Open comment or real-time cycle, and its position.
    silent: Option<(EntryId, Location)>,
    pub(super) section: Option<usize>,
    has_main: bool,
    /// `%` blocks inside the main program, each with whether the end of the program came before it.
    remarks: Vec<(EntryId, bool)>,
    end_seen: bool,
    /// The main program, if it has no head and a local subroutine follows its blocks without M30.
    unfinished: Option<usize>,
    /// `%` after the end of the main program, until a block follows.
    behind_end: Option<Location>,
    diagnostics: Vec<Diagnostic>,
    /// Whether reading has stopped, because the nesting is too deep or the file too large.
    gives_up: bool,
}

impl Builder<'_> {
    fn block(&mut self, raw: &RawBlock<'_>, skip: SkipLevels) {
        let head = head(raw.text);
        let first = head.rest.bytes().next();
        if let Some((open, _)) = self.silent {
            if first == Some(b'#') {
                self.end_of_silence(raw, &head, open);
            }
            return;
        }
        if head.skip.is_some_and(|level| skip.contains(level)) {
            return;
        }
        if first == Some(b'%') {
            self.program_head(raw, head.rest);
            return;
        }
        // in a block that is too long, more text may follow the part that is read
        let comment = first == Some(b'#') && is_command(head.rest, "COMMENT", "BEGIN");
        let content = first.is_some_and(|b| b != b';' && !comment)
            || head.label.is_some()
            || raw.characters > BLOCK_LENGTH_MAX;
        if self.section.is_none() && content {
            self.open_section(None, false, raw.position);
        }
        if content && let Some(place) = self.behind_end.take() {
            self.index.further = Some(place);
        }
        if let Some(label) = head.label.clone() {
            self.label(raw, label, head.label_at);
        }
        match first {
            Some(b'$') => self.control(raw, &head),
            Some(b'#') => self.command(raw, &head),
            // without `$` only the block itself is faulty, not its structure
            Some(_) if Keyword::of_control(&word(head.rest)).is_some() => self.control(raw, &head),
            Some(_) if self.has_main => self.end_seen |= ends_program(raw.text),
            _ => {}
        }
    }

    fn is_full(&self) -> bool {
        let Index { entries, sections, labels, .. } = &self.index;
        entries.bytes() + labels.bytes() + sections.len() * SECTION_BYTES > STRUCTURE_MAX
    }

    fn push(&mut self, position: Position, at: usize, keyword: Keyword) -> EntryId {
        let id = EntryId::try_from(self.index.entries.len()).unwrap_or(EntryId::MAX);
        let parent = self.stack.last().copied();
        self.index.entries.push(Entry { parent, ..Entry::alone(position, at, keyword) }, parent);
        id
    }

    fn report(&mut self, raw: &RawBlock<'_>, at: usize, length: usize, diagnostic: Diagnostic) {
        if self.diagnostics.len() >= DIAGNOSTICS_MAX {
            return;
        }
        let location = raw.locate(self.file, Span::new(at, at + length));
        self.diagnostics.push(diagnostic.at(location));
    }

    fn label(&mut self, raw: &RawBlock<'_>, label: LabelKind, at: usize) {
        let Some(section) = self.section else { return };
        let parent = self.stack.last().copied();
        let place = LabelPlace { position: raw.position, parent };
        if let LabelKind::Number(n) = label
            && n > LABEL_MAX
        {
            let text = format!("the number of the label is above {LABEL_MAX}");
            let d = Diagnostic::new(Condition::LabelNumberTooLarge, text);
            let digits = raw.text[at..].find(':').unwrap_or(1);
            self.report(raw, at, digits, d);
            return;
        }
        let (before, digits) = number_before(&raw.text[..at]);
        if matches!(label, LabelKind::Name(_))
            && before.parse().is_ok_and(|number: f64| number > LABEL_MAX as f64)
        {
            let text = format!("the block number before the label is above {LABEL_MAX}");
            let d = Diagnostic::new(Condition::LabelBlockNumber, text);
            self.report(raw, digits, before.len(), d);
            return;
        }
        if self.index.labels.get(section, &label).is_some() {
            let shown = match &label {
                LabelKind::Number(n) => format!("N{n}:"),
                LabelKind::Name(name) => format!("[{name}]"),
            };
            let d =
                Diagnostic::new(Condition::LabelTwice, format!("label {shown} is defined twice"));
            self.report(raw, at, shown.len(), d);
            return;
        }
        self.index.labels.insert(section, label, place);
    }

    fn command(&mut self, raw: &RawBlock<'_>, head: &Head<'_>) {
        let text = blank(&head.rest[1..]);
        let name = word(text);
        match name.as_str() {
            "COMMENT" if is_command(head.rest, "COMMENT", "BEGIN") => {
                self.alone(raw, head, Condition::CommentBeginNotAlone);
                self.silence(raw, head, Keyword::CommentBegin);
            }
            "COMMENT" if is_command(head.rest, "COMMENT", "END") => {
                let d = Diagnostic::new(Condition::Unpaired, "#COMMENT END without #COMMENT BEGIN");
                self.report(raw, head.at, Keyword::CommentEnd.text().len(), d);
            }
            "RT" if real_time_cycle(head.rest) == Some(true) => {
                self.silence(raw, head, Keyword::RealTimeBegin);
            }
            "IF" => {
                let id = self.push(raw.position, head.at, Keyword::ConditionalIf);
                self.index.entries.change(id, |e| e.open = Some(id));
                self.conditional.push(self.stack.clone());
                self.conditional_open.push(id);
                self.nested(raw, head, self.conditional_open.len(), Condition::ConditionalNesting);
            }
            "ELSE" | "ENDIF" => self.else_or_end(raw, head, &name, text),
            _ => {}
        }
    }

    /// `#ELSE` or `#ENDIF`, by its name, with the text of the block.
    fn else_or_end(&mut self, raw: &RawBlock<'_>, head: &Head<'_>, name: &str, text: &str) {
        let Some(open) = self.conditional_open.last().copied() else {
            let d = Diagnostic::new(Condition::Syntax, format!("#{name} without #IF"))
                .hint("write #IF before it, or remove it");
            self.report(raw, head.at, name.len() + 1, d);
            return;
        };
        let keyword =
            if name == "ELSE" { Keyword::ConditionalElse } else { Keyword::ConditionalEnd };
        let said = if !is_end(split_word(text).1) {
            let text = format!("{} is not alone in its block", keyword.text());
            Some((text, "move the words to the next block"))
        } else if keyword == Keyword::ConditionalElse && self.last_clause.contains_key(&open) {
            let text = "a second #ELSE of the same #IF: its blocks never run".to_owned();
            Some((text, "remove it, or write #ENDIF and a further #IF before it"))
        } else {
            None
        };
        if let Some((text, hint)) = said {
            let d = Diagnostic::new(Condition::Syntax, text).hint(hint);
            self.report(raw, head.at, head.rest.trim_end().len(), d);
        }
        let id = self.push(raw.position, head.at, keyword);
        self.index.entries.change(id, |e| e.open = Some(open));
        self.chain(open, id);
        if keyword == Keyword::ConditionalEnd {
            self.finish(open, id);
            self.conditional_open.pop();
            self.conditional.pop();
        } else if let Some(stack) = self.conditional.last() {
            // the branches are siblings
            self.stack.clone_from(stack);
        }
    }

    /// Ignores all blocks from here to the matching end.
    fn silence(&mut self, raw: &RawBlock<'_>, head: &Head<'_>, keyword: Keyword) {
        let place = Span::new(head.at, head.at + head.rest.trim_end().len());
        let id = self.push(raw.position, head.at, keyword);
        self.silent = Some((id, raw.locate(self.file, place)));
    }

    /// Reports a comment that does not end in its file; a real-time cycle is refused where it is executed.
    fn end_of_file(&mut self) {
        let Some((open, place)) = self.silent.take() else { return };
        if self.index.entry(open).keyword == Keyword::CommentBegin {
            let text = "#COMMENT BEGIN without #COMMENT END: it hides the rest of the file";
            self.diagnostics.push(Diagnostic::new(Condition::Unpaired, text).at(place));
        }
    }

    /// A command inside a comment or a real-time cycle, which may be its end.
    fn end_of_silence(&mut self, raw: &RawBlock<'_>, head: &Head<'_>, open: EntryId) {
        let end = if self.index.entry(open).keyword == Keyword::CommentBegin {
            if !is_command(head.rest, "COMMENT", "END") {
                return;
            }
            self.alone(raw, head, Condition::CommentEndNotAlone);
            Keyword::CommentEnd
        } else if real_time_cycle(head.rest) == Some(false) {
            Keyword::RealTimeEnd
        } else {
            return;
        };
        let id = self.push(raw.position, head.at, end);
        self.index.entries.change(open, |e| e.end = Some(id));
        self.silent = None;
    }

    /// Checks that `#COMMENT BEGIN` and `#COMMENT END` are alone in their blocks.
    fn alone(&mut self, raw: &RawBlock<'_>, head: &Head<'_>, condition: Condition) {
        if !is_end(behind_command(head.rest)) {
            let name = if condition == Condition::CommentBeginNotAlone { "BEGIN" } else { "END" };
            let text = format!("#COMMENT {name} is not alone in its block");
            let d = Diagnostic::new(condition, text);
            self.report(raw, head.at, head.rest.trim_end().len(), d);
        }
    }
}

/// Whether nothing but a remark follows.
fn is_end(text: &str) -> bool {
    text.is_empty() || text.starts_with(';')
}

/// Builds the index of a program. Faults in its structure are returned as well.
pub(in crate::exec) fn build(
    reader: &mut BlockReader,
    file: &Arc<str>,
    skip: SkipLevels,
) -> io::Result<(Index, Vec<Diagnostic>)> {
    let mut builder = Builder {
        file,
        index: Index::default(),
        stack: Vec::new(),
        conditional: Vec::new(),
        conditional_open: Vec::new(),
        last_clause: BTreeMap::new(),
        defaults: BTreeSet::new(),
        silent: None,
        section: None,
        has_main: false,
        remarks: Vec::new(),
        unfinished: None,
        end_seen: false,
        behind_end: None,
        diagnostics: Vec::new(),
        gives_up: false,
    };
    reader.seek(Position::START);
    loop {
        let looks = builder.silent.is_some() || builder.behind_end.is_some();
        if builder.section.is_some() && !looks {
            reader.skip_lines(SAYING, says_nothing);
        }
        let Some(raw) = reader.next_block()? else { break };
        builder.block(&raw, skip);
        if builder.is_full() {
            let text = format!(
                "control statements, labels and subroutines of one file take more than {} MB",
                STRUCTURE_MAX / 1_000_000
            );
            let hint = "split the program into several files, called one after the other";
            let location = raw.locate(file, Span::new(0, raw.text.len()));
            let diagnostic = Diagnostic::new(Condition::Nesting, text).at(location).hint(hint);
            builder.diagnostics.push(diagnostic);
            builder.gives_up = true;
        }
        if builder.gives_up {
            break;
        }
    }
    if !builder.gives_up {
        builder.end_of_file();
    }
    builder.close(reader.position().offset);
    builder.decide_remarks();
    Ok((builder.index, builder.diagnostics))
}

/// The digits at the end of a text, and their position.
fn number_before(text: &str) -> (&str, usize) {
    let text = text.trim_ascii_end();
    let at = text.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    (&text[at..], at)
}
