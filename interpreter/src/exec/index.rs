//! Structure of a program file: heads, control statements and labels with their places; nothing else is kept.
//!
//! One pass over the text, without parsing: only the beginning of a block is looked at. So a jump needs no search, and
//! memory does not depend on the blocks in between.

use crate::diag::{Diagnostic, Severity};
use crate::exec::fault::own;
use crate::exec::options::SkipLevels;
use crate::source::{BlockReader, Position, RawBlock};
use crate::syntax::ast::{LabelKind, Span};
use std::collections::BTreeMap;
use std::io;
use std::sync::Arc;

/// Deepest nesting of control statements. Assumption: the vendor prints no number for 20211.
const NESTING_MAX: usize = 64;

/// Mistakes of structure that are reported for one file.
const DIAGNOSTICS_MAX: usize = 100;

/// What begins a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keyword {
    If,
    /// `$IF .. $GOTO ..`: no block of its own.
    IfGoto,
    ElseIf,
    Else,
    EndIf,
    Switch,
    Case,
    Default,
    EndSwitch,
    For,
    EndFor,
    While,
    EndWhile,
    Do,
    EndDo,
    Repeat,
    Until,
    Break,
    Continue,
    CommentBegin,
    CommentEnd,
    ConditionalIf,
    ConditionalElse,
    ConditionalEnd,
    /// `%` text inside a main program.
    Remark,
}

impl Keyword {
    fn of_control(word: &str) -> Option<Self> {
        Some(match word {
            "IF" => Self::If,
            "ELSEIF" => Self::ElseIf,
            "ELSE" => Self::Else,
            "ENDIF" => Self::EndIf,
            "SWITCH" => Self::Switch,
            "CASE" => Self::Case,
            "DEFAULT" => Self::Default,
            "ENDSWITCH" => Self::EndSwitch,
            "FOR" => Self::For,
            "ENDFOR" => Self::EndFor,
            "WHILE" => Self::While,
            "ENDWHILE" => Self::EndWhile,
            "DO" => Self::Do,
            "ENDDO" => Self::EndDo,
            "REPEAT" => Self::Repeat,
            "UNTIL" => Self::Until,
            "BREAK" => Self::Break,
            "CONTINUE" => Self::Continue,
            _ => return None,
        })
    }

    /// How it is written.
    pub(super) fn text(self) -> &'static str {
        match self {
            Self::If | Self::IfGoto => "$IF",
            Self::ElseIf => "$ELSEIF",
            Self::Else => "$ELSE",
            Self::EndIf => "$ENDIF",
            Self::Switch => "$SWITCH",
            Self::Case => "$CASE",
            Self::Default => "$DEFAULT",
            Self::EndSwitch => "$ENDSWITCH",
            Self::For => "$FOR",
            Self::EndFor => "$ENDFOR",
            Self::While => "$WHILE",
            Self::EndWhile => "$ENDWHILE",
            Self::Do => "$DO",
            Self::EndDo => "$ENDDO",
            Self::Repeat => "$REPEAT",
            Self::Until => "$UNTIL",
            Self::Break => "$BREAK",
            Self::Continue => "$CONTINUE",
            Self::CommentBegin => "#COMMENT BEGIN",
            Self::CommentEnd => "#COMMENT END",
            Self::ConditionalIf => "#IF",
            Self::ConditionalElse => "#ELSE",
            Self::ConditionalEnd => "#ENDIF",
            Self::Remark => "%",
        }
    }

    /// What closes a statement that opens a block.
    pub(super) fn closer(self) -> Option<Self> {
        Some(match self {
            Self::If => Self::EndIf,
            Self::Switch => Self::EndSwitch,
            Self::For => Self::EndFor,
            Self::While => Self::EndWhile,
            Self::Do => Self::EndDo,
            Self::Repeat => Self::Until,
            Self::ConditionalIf => Self::ConditionalEnd,
            _ => return None,
        })
    }

    /// What a clause or a closing statement belongs to.
    fn opener(self) -> Option<Self> {
        Some(match self {
            Self::ElseIf | Self::Else | Self::EndIf => Self::If,
            Self::Case | Self::Default | Self::EndSwitch => Self::Switch,
            Self::EndFor => Self::For,
            Self::EndWhile => Self::While,
            Self::EndDo => Self::Do,
            Self::Until => Self::Repeat,
            Self::ConditionalElse | Self::ConditionalEnd => Self::ConditionalIf,
            _ => return None,
        })
    }

    pub(super) fn is_loop(self) -> bool {
        matches!(self, Self::For | Self::While | Self::Do | Self::Repeat)
    }
}

/// Index of an entry.
pub(super) type EntryId = u32;

/// One statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) position: Position,
    /// The keyword in its block.
    pub(super) span: Span,
    pub(super) keyword: Keyword,
    /// Statement that opened the structure; itself for an opening one.
    pub(super) open: Option<EntryId>,
    /// Next clause of the structure, at last its closing statement.
    pub(super) next: Option<EntryId>,
    /// Closing statement.
    pub(super) end: Option<EntryId>,
    /// Innermost structure around it.
    pub(super) parent: Option<EntryId>,
}

/// Target of a jump.
#[derive(Clone, Copy, Debug)]
pub(super) struct LabelPlace {
    pub(super) position: Position,
    /// Innermost structure around it.
    pub(super) parent: Option<EntryId>,
}

/// A main program or local subroutine.
#[derive(Clone, Debug)]
pub(super) struct Section {
    pub(super) name: Option<Arc<str>>,
    pub(super) local: bool,
    /// First block.
    pub(super) start: Position,
    /// Where the next section or nothing begins.
    pub(super) end: u64,
}

/// Structure of a file.
#[derive(Clone, Debug, Default)]
pub(super) struct Index {
    pub(super) entries: Vec<Entry>,
    pub(super) sections: Vec<Section>,
    labels: BTreeMap<(usize, LabelKind), LabelPlace>,
}

impl Index {
    /// The entry at a place.
    pub(super) fn at(&self, position: Position) -> Option<EntryId> {
        let i = self.entries.binary_search_by_key(&position.offset, |e| e.position.offset).ok()?;
        EntryId::try_from(i).ok()
    }

    pub(super) fn entry(&self, id: EntryId) -> &Entry {
        &self.entries[id as usize]
    }

    /// Label of a section.
    pub(super) fn label(&self, section: usize, label: &LabelKind) -> Option<&LabelPlace> {
        // a range of one key would need an owned label: labels are short
        self.labels.get(&(section, label.clone()))
    }

    /// The section that is not local.
    pub(super) fn main(&self) -> Option<usize> {
        self.sections.iter().position(|s| !s.local)
    }
}

/// Beginning of a block: what an index has to know.
struct Head<'t> {
    skip: Option<u8>,
    number: Option<&'t str>,
    label: Option<LabelKind>,
    /// Where the label begins.
    label_at: usize,
    /// Text behind skip mark, number and label.
    rest: &'t str,
    /// Where it begins.
    at: usize,
}

fn head(text: &str) -> Head<'_> {
    let mut rest = blank(text);
    let mut skip = None;
    if let Some(behind) = rest.strip_prefix('/') {
        let digits = digits(behind);
        skip = Some(behind[..digits].parse().unwrap_or(1));
        rest = blank(&behind[digits..]);
    }
    let mut number = None;
    let mut label = None;
    let mut label_at = text.len() - rest.len();
    if let Some(behind) = rest.strip_prefix(['N', 'n']) {
        let behind = blank(behind);
        let length = digits(behind);
        if length > 0 {
            number = Some(&behind[..length]);
            rest = blank(&behind[length..]);
            if let Some(behind) = rest.strip_prefix(':') {
                label = number.and_then(|n| n.parse().ok()).map(LabelKind::Number);
                rest = blank(behind);
            }
        }
    }
    if let (true, Some(end)) = (label.is_none() && rest.starts_with('['), rest.find(']')) {
        let name = rest[1..end].trim();
        if !name.is_empty() {
            label_at = text.len() - rest.len();
            label = Some(LabelKind::Name(name.to_uppercase().into()));
            rest = blank(&rest[end + 1..]);
        }
    }
    Head { skip, number, label, label_at, rest, at: text.len() - rest.len() }
}

fn digits(text: &str) -> usize {
    text.bytes().take_while(u8::is_ascii_digit).count()
}

/// Without blanks and closed comments at the beginning.
fn blank(text: &str) -> &str {
    let mut rest = text.trim_start_matches([' ', '\t']);
    while rest.starts_with('(') {
        let mut depth = 0;
        let end = rest.bytes().position(|b| {
            match b {
                b'(' => depth += 1,
                b')' => depth -= 1,
                _ => {}
            }
            depth == 0
        });
        rest = match end {
            Some(end) => rest[end + 1..].trim_start_matches([' ', '\t']),
            None => "",
        };
    }
    rest
}

/// Letters at the beginning, in upper case.
fn word(text: &str) -> String {
    text.chars().take_while(char::is_ascii_alphanumeric).collect::<String>().to_ascii_uppercase()
}

/// True if a line holds M02 or M30 outside comments.
fn ends_program(text: &str) -> bool {
    let bytes = text.as_bytes();
    memchr::memchr2_iter(b'M', b'm', bytes).any(|i| {
        let rest = &text[i + 1..];
        let length = digits(rest);
        let comment = memchr::memchr2(b'(', b';', &bytes[..i]).is_some();
        !comment && matches!(rest[..length].trim_start_matches('0'), "2" | "30")
    })
}

/// The pass.
struct Builder<'a> {
    file: &'a Arc<str>,
    index: Index,
    /// Open structures.
    stack: Vec<EntryId>,
    /// Structures open at each open `#IF`.
    conditional: Vec<Vec<EntryId>>,
    /// Open `#IF`s.
    conditional_open: Vec<EntryId>,
    /// Last clause of each open structure.
    last_clause: BTreeMap<EntryId, EntryId>,
    comment: Option<EntryId>,
    section: Option<usize>,
    has_main: bool,
    /// `%` blocks inside the main program, with the end of the program seen before each.
    remarks: Vec<(EntryId, bool)>,
    end_seen: bool,
    diagnostics: Vec<Diagnostic>,
}

/// Indexes a program; what is wrong with its structure comes beside.
pub(super) fn build(
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
        comment: None,
        section: None,
        has_main: false,
        remarks: Vec::new(),
        end_seen: false,
        diagnostics: Vec::new(),
    };
    reader.seek(Position::START);
    let mut position = reader.position();
    while let Some(raw) = reader.next_block()? {
        builder.block(&raw, skip);
        position = reader.position();
    }
    builder.close(position.offset);
    builder.decide_remarks();
    Ok((builder.index, builder.diagnostics))
}

impl Builder<'_> {
    fn block(&mut self, raw: &RawBlock<'_>, skip: SkipLevels) {
        let head = head(raw.text);
        let first = head.rest.bytes().next();
        if let Some(open) = self.comment {
            if first == Some(b'#') && is_command(head.rest, "COMMENT", "END") {
                let id = self.push(raw.position, head.at, Keyword::CommentEnd);
                self.index.entries[open as usize].end = Some(id);
                self.comment = None;
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
        let content =
            first.is_some_and(|b| b != b';') || head.number.is_some() || head.label.is_some();
        if self.section.is_none() && content {
            self.open_section(None, false, raw.position);
        }
        if let Some(label) = head.label.clone() {
            self.label(raw, label, head.label_at);
        }
        match first {
            Some(b'$') => self.control(raw, &head),
            Some(b'#') => self.command(raw, &head),
            Some(_) if self.has_main => self.end_seen |= ends_program(raw.text),
            _ => {}
        }
    }

    fn push(&mut self, position: Position, at: usize, keyword: Keyword) -> EntryId {
        let id = EntryId::try_from(self.index.entries.len()).unwrap_or(EntryId::MAX);
        self.index.entries.push(Entry {
            position,
            span: Span::new(at, at + keyword.text().len()),
            keyword,
            open: None,
            next: None,
            end: None,
            parent: self.stack.last().copied(),
        });
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
        let name = name.map(Arc::from);
        self.index.sections.push(Section { name, local, start, end: u64::MAX });
    }

    /// The section ends here; open structures end with it.
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
        if let Some(name) = local {
            self.close(raw.position.offset);
            let name = name_of(name);
            if self.has_main {
                let text = "a local subroutine behind the main program: the control may refuse it";
                let d = Diagnostic::kontur(own::ODD, text).severity(Severity::Note);
                self.report(raw, raw.text.len() - rest.len(), 2, d);
            }
            let known = self.index.sections.iter().any(|s| s.local && s.name.as_deref() == name);
            if known {
                let text = format!("local subroutine {} twice", name.unwrap_or(""));
                let d = Diagnostic::kontur(own::ODD, text).severity(Severity::Warning);
                self.report(raw, raw.text.len() - rest.len(), rest.trim_end().len(), d);
            }
            self.open_section(name, true, next);
        } else if self.has_main {
            // whether it is a remark is known at the end of the file
            let id = self.push(raw.position, raw.text.len() - rest.len(), Keyword::Remark);
            self.remarks.push((id, self.end_seen));
        } else {
            self.close(raw.position.offset);
            self.open_section(name_of(behind.trim_start()), false, next);
        }
    }

    /// A `%` block ends the main program if the file goes on with a further program.
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
        if self.index.labels.contains_key(&(section, label.clone())) {
            let shown = match &label {
                LabelKind::Number(n) => format!("N{n}:"),
                LabelKind::Name(name) => format!("[{name}]"),
            };
            let d = Diagnostic::vendor(20836, format!("label {shown} is defined twice"));
            self.report(raw, at, shown.len(), d);
            return;
        }
        self.index.labels.insert((section, label), place);
    }

    fn command(&mut self, raw: &RawBlock<'_>, head: &Head<'_>) {
        let name = word(&head.rest[1..]);
        match name.as_str() {
            "COMMENT" if is_command(head.rest, "COMMENT", "BEGIN") => {
                let behind = head.rest[1 + name.len()..].trim_start();
                if !matches!(blank(&behind["BEGIN".len()..]).bytes().next(), None | Some(b';')) {
                    let text = "#COMMENT BEGIN does not stand alone in its block";
                    let d = Diagnostic::vendor(20566, text);
                    self.report(raw, head.at, head.rest.trim_end().len(), d);
                }
                self.comment = Some(self.push(raw.position, head.at, Keyword::CommentBegin));
            }
            "IF" => {
                let id = self.push(raw.position, head.at, Keyword::ConditionalIf);
                self.index.entries[id as usize].open = Some(id);
                self.conditional.push(self.stack.clone());
                self.conditional_open.push(id);
            }
            "ELSE" | "ENDIF" => {
                let Some(open) = self.conditional_open.last().copied() else {
                    let d = Diagnostic::kontur(own::SYNTAX, format!("#{name} without #IF"));
                    self.report(raw, head.at, name.len() + 1, d);
                    return;
                };
                let keyword =
                    if name == "ELSE" { Keyword::ConditionalElse } else { Keyword::ConditionalEnd };
                let id = self.push(raw.position, head.at, keyword);
                self.index.entries[id as usize].open = Some(open);
                self.chain(open, id);
                if keyword == Keyword::ConditionalEnd {
                    self.finish(open, id);
                    self.conditional_open.pop();
                    self.conditional.pop();
                } else if let Some(stack) = self.conditional.last() {
                    // the branches stand beside each other
                    self.stack.clone_from(stack);
                }
            }
            _ => {}
        }
    }

    fn control(&mut self, raw: &RawBlock<'_>, head: &Head<'_>) {
        let name = word(&head.rest[1..]);
        let Some(mut keyword) = Keyword::of_control(&name) else { return };
        if keyword == Keyword::If && contains_goto(head.rest) {
            keyword = Keyword::IfGoto;
        }
        let id = self.push(raw.position, head.at, keyword);
        if keyword.closer().is_some() {
            self.index.entries[id as usize].open = Some(id);
            self.stack.push(id);
            if self.stack.len() > NESTING_MAX {
                let text = format!("control statements nested more than {NESTING_MAX} deep");
                let d = Diagnostic::vendor(20211, text);
                self.report(raw, head.at, name.len() + 1, d);
            }
            return;
        }
        let Some(opener) = keyword.opener() else { return };
        let found = self
            .stack
            .iter()
            .rposition(|open| self.index.entries[*open as usize].keyword == opener);
        let Some(depth) = found else {
            let text = format!("{} without {}", keyword.text(), opener.text());
            let d = match keyword {
                Keyword::EndFor => Diagnostic::vendor(20232, text),
                Keyword::ElseIf => Diagnostic::vendor(20216, text),
                _ => Diagnostic::kontur(own::SYNTAX, text),
            };
            self.report(raw, head.at, name.len() + 1, d);
            return;
        };
        if let Some(inner) = self.stack.get(depth + 1).copied() {
            let inner = self.index.entries[inner as usize];
            let closer = inner.keyword.closer().map_or("", Keyword::text);
            let text = format!(
                "{} inside {}: its {closer} is missing (line {})",
                keyword.text(),
                inner.keyword.text(),
                inner.position.line
            );
            let d = Diagnostic::kontur(own::SYNTAX, text);
            self.report(raw, head.at, name.len() + 1, d);
            self.stack.truncate(depth + 1);
        }
        let open = self.stack[depth];
        let parent = self.index.entries[open as usize].parent;
        self.index.entries[id as usize].open = Some(open);
        self.index.entries[id as usize].parent = parent;
        self.chain(open, id);
        if keyword.opener().and_then(Keyword::closer) == Some(keyword) {
            self.finish(open, id);
            self.stack.truncate(depth);
        }
    }

    /// Appends a clause to its structure.
    fn chain(&mut self, open: EntryId, id: EntryId) {
        let last = self.last_clause.insert(open, id).unwrap_or(open);
        self.index.entries[last as usize].next = Some(id);
    }

    /// The structure is closed: every clause learns where.
    fn finish(&mut self, open: EntryId, end: EntryId) {
        self.last_clause.remove(&open);
        let mut at = Some(open);
        while let Some(id) = at {
            let entry = &mut self.index.entries[id as usize];
            entry.end = Some(end);
            at = entry.next;
        }
    }
}

/// Name behind a program head: the first word.
fn name_of(text: &str) -> Option<&str> {
    let end = text.find([' ', '\t', '(', ';']).unwrap_or(text.len());
    (end > 0).then(|| &text[..end])
}

/// True for `#FIRST SECOND`.
fn is_command(rest: &str, first: &str, second: &str) -> bool {
    let behind = &rest[1..];
    let length = behind.bytes().take_while(u8::is_ascii_alphanumeric).count();
    behind[..length].eq_ignore_ascii_case(first) && word(behind[length..].trim_start()) == second
}

/// True if `$GOTO` stands behind the condition.
fn contains_goto(rest: &str) -> bool {
    let code = rest.split([';', '(']).next().unwrap_or("");
    code.to_ascii_uppercase().contains("$GOTO")
}

#[cfg(test)]
mod tests {
    use super::{Index, Keyword, build};
    use crate::exec::options::SkipLevels;
    use crate::source::{BlockReader, MemorySources, Sources};
    use std::sync::Arc;

    fn index(text: &str) -> (Index, Vec<String>) {
        let source = MemorySources::new().with("a.nc", text).open("a.nc", None).unwrap();
        let file: Arc<str> = Arc::from("a.nc");
        let mut reader = BlockReader::new(source);
        let (index, diagnostics) = build(&mut reader, &file, SkipLevels::NONE).unwrap();
        let shown = diagnostics
            .iter()
            .map(|d| format!("{} {}", d.id, d.source.as_ref().map_or(0, |s| s.line)))
            .collect();
        (index, shown)
    }

    #[test]
    fn local_subroutines_and_the_main_program() {
        let (i, d) = index("; x\n%L SQUARE (c)\nN10 X1\n%L B\n%MAIN\nX2\nM30\n");
        let names: Vec<_> =
            i.sections.iter().map(|s| (s.name.as_deref(), s.local, s.start.line)).collect();
        let expected = [(Some("SQUARE"), true, 2), (Some("B"), true, 4), (Some("MAIN"), false, 5)];
        assert_eq!(names, expected);
        assert!(d.is_empty());
        let (i, _) = index("(head)\nX1\nM30\n");
        assert_eq!((i.sections.len(), i.sections[0].start.line), (1, 2));
        let (i, _) = index("%LONG\nX1\n");
        assert_eq!(i.sections[0].name.as_deref(), Some("LONG"));
    }

    #[test]
    fn percent_lines_inside_a_program_are_remarks_unless_a_program_follows() {
        let (i, _) = index("%A\nX1\n% remark\nX2\nM30\n");
        assert_eq!(i.sections.len(), 1);
        assert!(i.sections[0].end > 15);
        let (i, _) = index("%A\nX1\nM30\n%B\nX2\nM30\n");
        assert_eq!(i.sections[0].end, 10);
    }

    #[test]
    fn partners_of_control_statements() {
        let (i, d) = index("$IF P1\n$FOR P1=1,2,1\n$ENDFOR\n$ELSEIF P2\n$ELSE\nX1\n$ENDIF\n");
        assert!(d.is_empty(), "{d:?}");
        let next: Vec<_> = i.entries.iter().map(|e| e.next).collect();
        assert_eq!(next, [Some(3), Some(2), None, Some(4), Some(5), None]);
        assert_eq!(i.entries[4].end, Some(5));
        assert_eq!(i.entries[1].parent, Some(0));
        assert_eq!(i.entries[0].keyword, Keyword::If);
    }

    #[test]
    fn structural_mistakes_have_their_ids() {
        assert_eq!(index("$ENDFOR\n").1, ["20232 1"]);
        assert_eq!(index("X1\n$ELSEIF P1\n").1, ["20216 2"]);
        assert_eq!(index("$ELSE\n").1, ["K-0002 1"]);
        assert_eq!(index("N1: X1\nN1: X2\n").1, ["20836 2"]);
        assert_eq!(index("$WHILE P1\n$IF P2\n$ENDWHILE\n").1, ["K-0002 3"]);
        let deep = "$IF 1\n".repeat(65);
        assert_eq!(index(&deep).1, ["20211 65"]);
    }

    #[test]
    fn nothing_inside_comment_blocks_counts() {
        let (i, d) = index("#COMMENT BEGIN\n$IF (\n%L X\n#COMMENT END\nX1\n");
        assert!(d.is_empty());
        assert_eq!(i.entries.len(), 2);
        assert_eq!(i.entries[0].end, Some(1));
        assert_eq!(i.sections.len(), 1);
    }
}
