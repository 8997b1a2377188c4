//! Syntax of the parts that a check did not execute: branches not taken, blocks jumped over, subroutines not called.
//!
//! Source: TF5200 programming manual, control blocks: in a branch that is not taken the control reads only block
//! numbers and nested control statements. Faults in those are errors here, too. Any other fault there would not stop
//! this program, so it is reported as a warning, K-0118. Text in `#COMMENT` blocks and in inactive `#IF` branches is
//! ignored; text after the end of the main program is only mentioned, K-0004.

use super::executor::Executor;
use super::files::{Files, Look};
use super::index::{Index, Keyword, Section};
use super::state::Calls;
use crate::diag::{Condition, Diagnostic, Severity};
use crate::exec::block::groups::is_cycle_call;
use crate::exec::commands::is_known;
use crate::source::Position;
use crate::syntax::Parser;
use crate::syntax::ast::{Block, Body, CallKind, CodeNumber, Command, WordKind};

/// Maximum number of faults reported for parts that were not reached.
const REPORTS_MAX: usize = 20;

impl Executor {
    /// Checks the syntax of all parts that were not executed.
    pub(in crate::exec) fn check_unreached(&mut self) {
        // the text beyond the limit might run
        if self.is_limited() {
            return;
        }
        self.reached.store();
        self.decoder.report.source.block = None;
        let mut left = REPORTS_MAX;
        for file in 0..self.files.names().len() {
            let index = std::sync::Arc::clone(&self.files.file(file).index);
            let silence = Silence::of(&index);
            for section in &index.sections {
                let end = if section.local {
                    section.end
                } else {
                    let last = self.reached.last(file, section.start.offset, section.end);
                    last.unwrap_or(section.start.offset)
                };
                if !section.local && file == 0 {
                    self.text_behind_end(&index, section, end);
                }
                for (from, to) in self.reached.gaps(file, section.start, end) {
                    let mut gap = Gap {
                        file,
                        index: &index,
                        files: &mut self.files,
                        parser: &self.parser,
                        calls: &self.decoder.calls,
                        declarations: false,
                        silent: silence.around(from),
                    };
                    let (found, calls_more) = gap.read(from, to, left);
                    self.calls_more |= calls_more;
                    left -= found.len();
                    for diagnostic in found {
                        self.report(diagnostic);
                    }
                    if left == 0 {
                        return;
                    }
                }
            }
        }
    }

    /// K-0004: blocks after the M02 or M30 that ended the main program. An end inside a control block, or with a label
    /// after it, need not be the end of the program.
    fn text_behind_end(&mut self, index: &Index, section: &Section, end: u64) {
        let main = matches!(&self.levels[..], [main] if main.is_outside_structures());
        let last = self.position.offset >= section.start.offset && self.position.offset < end;
        if self.found.errors() > 0
            || !main
            || !last
            || self.end_program_called
            || index.has_label(end, section.end)
        {
            return;
        }
        if let Some(place) = &index.further {
            let text = "a second program after the end of the main program never runs";
            self.report(Diagnostic::new(Condition::TextBehindEnd, text).at(place.clone()));
        }
        let gaps = self.reached.gaps(0, section.start, section.end);
        let Some((mut at, _)) = gaps.last().copied().filter(|(at, _)| at.offset == end) else {
            return;
        };
        while at.offset < section.end {
            let mut found = Vec::new();
            let macros = &self.decoder.calls.macros;
            let parsed = self.files.look(0, at, Look::Block, &self.parser, macros, &mut found);
            let Ok(Some((block, next))) = parsed else { return };
            let remark = index.at(at).is_some_and(|id| {
                matches!(index.entry(id).keyword, Keyword::CommentBegin | Keyword::Remark)
            });
            if remark {
                return;
            }
            if block.body != Body::Empty || !found.is_empty() {
                let text = "text after the end of the program never runs";
                let location = self.files.locate_block(0, at);
                let diagnostic = Diagnostic::new(Condition::TextBehindEnd, text);
                self.report(match location {
                    Some(location) => diagnostic.at(location),
                    None => diagnostic,
                });
                return;
            }
            at = next;
        }
    }
}

/// A part of a file that a check did not execute, while it is read.
struct Gap<'a> {
    file: usize,
    index: &'a Index,
    files: &'a mut Files,
    parser: &'a Parser,
    calls: &'a Calls,
    /// Between `#VAR` and `#ENDVAR`.
    declarations: bool,
    /// End of the ignored text.
    silent: Option<u64>,
}

impl Gap<'_> {
    /// The faults of its blocks, up to `most`, and whether one of them would open a file unknown to the check.
    fn read(&mut self, from: Position, to: u64, most: usize) -> (Vec<Diagnostic>, bool) {
        let (mut all, mut calls_more, mut at) = (Vec::new(), false, from);
        while at.offset < to && all.len() < most {
            let look = self.look_at(at, to);
            let mut found = Vec::new();
            let macros = &self.calls.macros;
            let parsed = self.files.look(self.file, at, look, self.parser, macros, &mut found);
            // the file was read before: parts that can no longer be read have been reported
            let Ok(Some((block, next))) = parsed else { break };
            calls_more |= self.may_open(&block);
            if let Body::Command(command) = &block.body {
                if look == Look::Block {
                    found.extend(self.unknown(command, at).map(|d| (d, false)));
                }
                self.declarations =
                    (self.declarations || command.is("VAR")) && !command.is("ENDVAR");
            }
            // what is only unusual does no harm where it does not run
            let wrong = found.into_iter().filter(|(d, _)| d.id != Condition::Odd);
            let room = most - all.len();
            let told = wrong.map(|(d, is_structure)| if is_structure { d } else { unreached(d) });
            all.extend(told.take(room));
            at = next;
        }
        (all, calls_more)
    }

    /// How the block at a position is checked.
    fn look_at(&mut self, at: Position, to: u64) -> Look {
        let entry = self.index.at(at).map(|id| self.index.entry(id));
        if let Some(entry) = entry
            && (entry.keyword.is_silent() || entry.keyword == Keyword::ConditionalIf)
        {
            let end = entry.end.map_or(to, |end| self.index.entry(end).position.offset);
            self.silent = self.silent.max(Some(end));
        }
        let remark = entry.is_some_and(|entry| entry.keyword == Keyword::Remark);
        match (remark || self.silent.is_some_and(|end| at.offset <= end), self.declarations) {
            (true, _) => Look::Pass,
            (false, true) => Look::Declaration,
            (false, false) => Look::Block,
        }
    }

    /// The fault of a command that does not exist.
    fn unknown(&mut self, command: &Command, at: Position) -> Option<Diagnostic> {
        if is_known(command) || is_structure_command(command) {
            return None;
        }
        let place = self.files.locate(self.file, at, command.span, &self.calls.macros)?;
        let text = format!("unknown command #{}", command.name());
        Some(Diagnostic::new(Condition::CommandUnknown, text).at(place))
    }

    /// Whether a block that was not executed would open a file unknown to the check.
    fn may_open(&self, block: &Block) -> bool {
        let Body::Words(words) = &block.body else { return false };
        words.iter().any(|word| match &word.kind {
            WordKind::Call(call) => !call.local && !matches!(call.kind, CallKind::Sequence(_)),
            WordKind::G { number, .. } => is_cycle_call(*number),
            WordKind::ComputedG(_) => true,
            WordKind::M(CodeNumber::Literal(6) | CodeNumber::Computed(_), _) => {
                self.calls.tool_change_file.is_some()
            }
            WordKind::Address { name, .. } => {
                let data = matches!(name.letter(), Some(b'D' | b'T'));
                data && self.calls.tool_data_file.is_some()
            }
            _ => false,
        })
    }
}

/// Inactive `#IF` branches and comments of a file.
struct Silence {
    /// Start of each, and the furthest end of all up to there.
    ends: Vec<(Position, u64)>,
}

impl Silence {
    fn of(index: &Index) -> Self {
        let mut furthest = 0;
        let entries = index.silencing().map(|e| {
            let end = e.end.map_or(u64::MAX, |end| index.entry(end).position.offset);
            furthest = end.max(furthest);
            (e.position, furthest)
        });
        Self { ends: entries.collect() }
    }

    /// End of the comment or branch around a position, if there is one.
    fn around(&self, at: Position) -> Option<u64> {
        let before = self.ends.partition_point(|(begin, _)| *begin < at);
        let (_, end) = self.ends.get(before.checked_sub(1)?)?;
        (*end >= at.offset).then_some(*end)
    }
}

/// Whether a command structures the text and has no row of its own.
fn is_structure_command(command: &Command) -> bool {
    ["VAR", "ENDVAR", "IF", "ELSE", "ENDIF", "COMMENT BEGIN", "COMMENT END"]
        .iter()
        .any(|name| command.is(name))
}

/// Turns a diagnostic into a warning that names its position.
fn unreached(diagnostic: Diagnostic) -> Diagnostic {
    let text = format!("in a part that does not run: {} ({})", diagnostic.text, diagnostic.id);
    let usual = || {
        "this part is never executed; the control only checks control statements in it".to_owned()
    };
    let hint = diagnostic.hint.or_else(|| Some(usual()));
    Diagnostic { id: Condition::Unreached.id(), text, hint, ..diagnostic }
        .severity(Severity::Warning)
}
