//! Builds the index of a file: its sections, labels and control statements with their partners.

mod control;

use super::LABEL_MAX;
use super::entry::{Entry, EntryId};
use super::head::{
    Head, SAYING, behind_command, blank, ends_program, head, is_command, name_of, real_time_cycle,
    says_nothing, split_word, word,
};
use super::keyword::Keyword;
use super::{Index, LabelPlace, Section};
use crate::diag::{Condition, Diagnostic, Location, Severity};
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

    fn open_section(&mut self, name: Option<&str>, local: bool, start: Position) {
        self.section = Some(self.index.sections.len());
        self.has_main |= !local;
        let name: Option<Arc<str>> = name.map(Arc::from);
        if let (Some(name), true, Some(section)) = (&name, local, self.section) {
            self.index.locals_upper.entry(name.to_ascii_uppercase()).or_insert(section);
            self.index.locals.entry(Arc::clone(name)).or_insert(section);
        }
        self.index.sections.push(Section { name, local, start, end: u64::MAX });
    }

    /// Ends the section; open structures end with it.
    fn close(&mut self, offset: u64) {
        if let Some(section) = self.section.take() {
            self.index.sections[section].end = offset;
        }
        self.stack.clear();
        self.conditional.clear();
        self.conditional_open.clear();
    }

    fn program_head(&mut self, raw: &RawBlock<'_>, rest: &str) {
        let behind = &rest[1..];
        let local = behind
            .strip_prefix(['L', 'l'])
            .filter(|name| name.starts_with([' ', '\t']))
            .map(str::trim_start)
            // without a name it is a main program called L
            .filter(|name| name_of(name).is_some());
        let next = Position { offset: raw.position.offset, line: raw.position.line };
        if let Some(text) = local {
            self.behind_end = None;
            let nameless = |main: &usize| self.index.sections[*main].name.is_none();
            self.unfinished =
                self.unfinished.or(self.section.filter(nameless)).filter(|_| !self.end_seen);
            self.close(raw.position.offset);
            let name = name_of(text);
            if self.has_main {
                let text = "a local subroutine after the main program: the control may refuse it";
                let d = Diagnostic::new(Condition::Odd, text).severity(Severity::Note);
                self.report(raw, raw.text.len() - rest.len(), 2, d);
            }
            if name.is_some_and(|name| self.index.locals.contains_key(name)) {
                let text = format!("local subroutine {} twice", name.unwrap_or(""));
                let d = Diagnostic::new(Condition::Odd, text).severity(Severity::Warning);
                self.report(raw, raw.text.len() - rest.len(), rest.trim_end().len(), d);
            }
            self.words_after_name(raw, text);
            self.open_section(name, true, next);
        } else if let (Some(_), Some(name)) = (self.unfinished, name_of(behind.trim_start())) {
            // a reader takes %MAIN for the program
            let text = format!(
                "program {name} never runs: the blocks before the first % are the main program"
            );
            let hint = "do not write blocks before the first %L or %; write M30 after the blocks if they are the program";
            let d = Diagnostic::new(Condition::TextBehindEnd, text);
            let d = d.severity(Severity::Error).hint(hint);
            self.report(raw, raw.text.len() - rest.len(), rest.trim_end().len(), d);
            self.unfinished = None;
        } else if self.has_main {
            // only at the end of the file is it known whether it is a remark
            let id = self.push(raw.position, raw.text.len() - rest.len(), Keyword::Remark);
            if self.end_seen && !self.remarks.iter().any(|(_, ended_before)| *ended_before) {
                let at = raw.text.len() - rest.len();
                let end = at + rest.trim_end().len();
                self.behind_end = Some(raw.locate(self.file, Span::new(at, end)));
            }
            self.remarks.push((id, self.end_seen));
        } else {
            self.close(raw.position.offset);
            self.words_after_name(raw, behind.trim_start());
            self.open_section(name_of(behind.trim_start()), false, next);
        }
    }

    /// The text after the name in a `%` block is not executed, although it may look so, unlike a remark; `head` ends
    /// with the block.
    fn words_after_name(&mut self, raw: &RawBlock<'_>, head: &str) {
        let Some(name) = name_of(head) else { return };
        let words = head[name.len()..].trim_start();
        let is_remark = words.starts_with(['(', ';']) || words.is_empty();
        if !is_remark {
            let words = words.trim_end();
            let text = format!("`{words}` after the name of a program is not executed");
            let d = Diagnostic::new(Condition::Odd, text).severity(Severity::Warning);
            let d = d.hint("write words of the program in a block of their own, remarks in (..)");
            let at = raw.text.len() - head[name.len()..].trim_start().len();
            self.report(raw, at, words.len(), d);
        }
    }

    /// A `%` block ends the main program if a further program follows in the file.
    fn decide_remarks(&mut self) {
        let Some(main) = self.index.main() else { return };
        let subroutine_behind =
            self.index.sections[main + 1..].iter().any(|s| s.local).then_some(());
        for (id, ended_before) in &self.remarks {
            let offset = self.index.entry(*id).position.offset;
            if subroutine_behind.is_some() || (*ended_before && self.end_seen) {
                let end = &mut self.index.sections[main].end;
                *end = (*end).min(offset);
            }
        }
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
