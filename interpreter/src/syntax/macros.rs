//! Macros: their text replaces `"NAME"` before a block is parsed.
//!
//! A string that is the name of a macro is a use of it wherever it appears, except for the two strings of a definition
//! `"NAME" = "text"`. Blanks at the ends of a name are ignored (208407691). Positions in the expanded text refer to the
//! use in the program.

use super::ast::Span;
use super::grammar::HASH_WORDS;
use crate::diag::{Condition, Diagnostic};
use crate::source::{BLOCK_LENGTH_MAX, Piece, Position, RawBlock, regions};
use std::ops::Range;
use std::sync::Arc;

/// Deepest nesting of macros in the texts of macros; a macro that uses itself is ended here by 20734.
pub(crate) const MACRO_DEPTH_MAX: usize = 20;

/// A block with its macros replaced.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Expanded {
    text: String,
    position: Position,
    characters: u32,
    pieces: Vec<Piece>,
}

impl Expanded {
    /// The block in the form that the parser takes.
    pub(crate) fn raw(&self) -> RawBlock<'_> {
        RawBlock {
            text: &self.text,
            position: self.position,
            characters: self.characters,
            pieces: &self.pieces,
        }
    }
}

/// Replaces the macros of a block; `None` if it uses none. `lookup` returns the text of a macro by its name.
///
/// # Errors
/// 20734 if macros are nested more than [`MACRO_DEPTH_MAX`] deep; K-MACRO-BRACKET if the text of a macro contains one
/// half of a pair of brackets (source: TF5200 programming manual, macros in mathematical expressions) or an open remark
/// before further words; 20644 if it contains a command and the block contains more; K-MACRO-CONTROL if it contains `$`
/// (source: 208426123, restrictions). An expansion that is too long is cut and gets 20301 from the parser.
pub(crate) fn expand<'m>(
    raw: &RawBlock<'_>,
    file: &Arc<str>,
    lookup: &impl Fn(&str) -> Option<&'m str>,
) -> Result<Option<Expanded>, Box<Diagnostic>> {
    let uses = uses(raw.text, lookup);
    if uses.is_empty() {
        return Ok(None);
    }
    let line: Arc<str> = Arc::from(raw.text);
    let mut out = Expanded {
        text: String::new(),
        position: raw.position,
        characters: raw.characters,
        pieces: Vec::new(),
    };
    let mut at = 0;
    for (range, text) in uses {
        if let Some(wrong) = misfit(raw.text, &range, text) {
            let location = raw.locate(file, Span::new(range.start, range.end));
            return Err(Box::new(wrong.at(location)));
        }
        let is_number = numbers(&raw.text[..range.start]);
        let before = &raw.text[at..range.start];
        let before = if is_number { before.trim_ascii_end() } else { before };
        copy(raw, &line, at..at + before.len(), &mut out);
        at = range.end;
        let start = out.text.len();
        // a call without its blank is still a call, so that the message can name it
        let quote = if is_call(&raw.text[..range.start]) { "\"" } else { "" };
        out.text.push_str(quote);
        if let Err(wrong) = insert(text, is_number, 1, lookup, &mut out.text) {
            let location = raw.locate(file, Span::new(range.start, range.end));
            return Err(Box::new(wrong.diagnostic().at(location)));
        }
        out.text.push_str(quote);
        let place = Span::new(start, out.text.len());
        let home = home(raw, &line, range.start);
        let replaces = Some(Span::new(range.start, range.end).len);
        out.pieces.push(Piece { start: place.start, end: place.end(), replaces, ..home });
    }
    copy(raw, &line, at..raw.text.len(), &mut out);
    let length = out.text.chars().count();
    out.characters = u32::try_from(length).unwrap_or(u32::MAX);
    if let Some((end, _)) = out.text.char_indices().nth(BLOCK_LENGTH_MAX as usize) {
        out.text.truncate(end);
    }
    Ok(Some(out))
}

/// The part of a block that the text of its macro would hide, or that is not permitted beside it.
///
/// Source: TF5200 diagnosis 252099211 (20644). Assumption: a remark that begins in a macro would hide the rest of the block.
fn misfit(block: &str, used: &Range<usize>, text: &str) -> Option<Diagnostic> {
    let is_word = |text: &str| {
        let code = regions::regions(text).find(|(region, range)| {
            !matches!(region, regions::Region::Comment { .. })
                && !text[range.clone()].trim_ascii().is_empty()
        });
        code.is_some()
    };
    let (before, behind) = (&block[..used.start], &block[used.end..]);
    if regions::ends_in_comment(text) && is_word(behind) {
        let shown: String = text.chars().take(40).collect();
        let text =
            format!("the macro text `{shown}` begins a remark that hides the words after it");
        let hint = "write the macro at the end of the block, or the remark in ( )";
        return Some(Diagnostic::new(Condition::MacroBracket, text).hint(hint));
    }
    let command = text.trim_ascii_start().strip_prefix('#')?.trim_ascii_start();
    let name = command.bytes().take_while(u8::is_ascii_alphanumeric).count();
    let among_words = HASH_WORDS.iter().any(|word| word.eq_ignore_ascii_case(&command[..name]));
    let number = before.trim_ascii().trim_start_matches(['N', 'n', '/']);
    let is_first = number.bytes().all(|b| b.is_ascii_digit());
    (name > 0 && !among_words && (!is_first || is_word(behind))).then(|| {
        let shown: String = text.chars().take(40).collect();
        let text = format!("the macro text `{shown}` is a command that must be alone in its block");
        Diagnostic::new(Condition::MacroCommand, text)
    })
}

/// The reason why a macro cannot replace its name.
enum Wrong<'m> {
    /// Macros nested too deeply.
    TooDeep,
    /// This text contains a bracket without its counterpart.
    HalfBracket(&'m str),
    /// This text contains a `$`: the structure of a program is determined before its macros are known.
    Control(&'m str),
}

impl Wrong<'_> {
    fn diagnostic(&self) -> Diagnostic {
        match self {
            Self::TooDeep => {
                let text = format!("macros nested more than {MACRO_DEPTH_MAX} deep");
                Diagnostic::new(Condition::MacroNesting, text)
            }
            Self::HalfBracket(text) => {
                let shown: String = text.chars().take(40).collect();
                let text = format!("the macro text `{shown}` has an unmatched bracket");
                Diagnostic::new(Condition::MacroBracket, text)
            }
            Self::Control(text) => {
                let shown: String = text.chars().take(40).collect();
                let text = format!("the macro text `{shown}` contains a control statement ($)");
                Diagnostic::new(Condition::MacroControl, text)
            }
        }
    }
}

/// Appends the text of a macro with its own macros replaced. The number of a function is one value: `G"A"` is
/// `G[60 - 7]`.
fn insert<'m>(
    text: &'m str,
    is_number: bool,
    depth: usize,
    lookup: &impl Fn(&str) -> Option<&'m str>,
    out: &mut String,
) -> Result<(), Wrong<'m>> {
    if depth > MACRO_DEPTH_MAX {
        return Err(Wrong::TooDeep);
    }
    if !regions::brackets_are_complete(text) {
        return Err(Wrong::HalfBracket(text));
    }
    if regions::code_has(text, b'$') {
        return Err(Wrong::Control(text));
    }
    let computed = is_number && !text.bytes().all(|b| b.is_ascii_digit());
    out.push_str(if computed { "[" } else { "" });
    let mut at = 0;
    for (range, inner) in uses(text, lookup) {
        let is_number = numbers(&text[..range.start]);
        let before = &text[at..range.start];
        out.push_str(if is_number { before.trim_ascii_end() } else { before });
        at = range.end;
        insert(inner, is_number, depth + 1, lookup, out)?;
        // macros that use others twice grow exponentially
        if out.len() > 4 * BLOCK_LENGTH_MAX as usize {
            return Ok(());
        }
    }
    out.push_str(&text[at..]);
    out.push_str(if computed { "]" } else { "" });
    Ok(())
}

/// The text of a macro with its own macros replaced; `None` if it cannot be used or is longer than a block.
pub(crate) fn resolved<'m>(
    text: &'m str,
    lookup: &impl Fn(&str) -> Option<&'m str>,
) -> Option<String> {
    let mut out = String::new();
    insert(text, false, 1, lookup, &mut out).ok()?;
    (out.chars().count() <= BLOCK_LENGTH_MAX as usize).then_some(out)
}

/// Whether the text ends where a macro name is expected and not its text: `MACRO_LENGTH["NAME"]`.
fn names_macro(before: &str) -> bool {
    let Some(head) = before.trim_ascii_end().strip_suffix('[') else { return false };
    let head = head.trim_ascii_end();
    ["MACRO_LENGTH", "MACRO_CONTENT"].iter().any(|name| {
        let at = head.len().checked_sub(name.len());
        at.and_then(|at| head.get(at..)).is_some_and(|end| end.eq_ignore_ascii_case(name))
    })
}

/// The positions of macros in a text, and their texts.
fn uses<'m>(text: &str, lookup: &impl Fn(&str) -> Option<&'m str>) -> Vec<(Range<usize>, &'m str)> {
    let mut found = Vec::new();
    let mut defined = false;
    for range in regions::strings(text) {
        let behind = text[range.end..].trim_ascii_start();
        let definition = behind.starts_with('=') && !behind.starts_with("==");
        let skip = std::mem::replace(&mut defined, definition) || definition;
        if !skip && !names_macro(&text[..range.start]) {
            let name = text[range.start + 1..range.end - 1].replace("\\\"", "\"");
            found.extend(lookup(name.trim_ascii()).map(|text| (range, text)));
        }
    }
    found
}

/// Whether the text ends in `LL` directly before the name: `LL"NAME"` (source: TF5200 programming manual 206841355, the
/// blank is mandatory).
fn is_call(before: &str) -> bool {
    let word = before.trim_end_matches(|c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.');
    before[word.len()..].eq_ignore_ascii_case("LL")
}

/// Whether the text ends in `G`, `M` or `H`, with only blanks before the name (source: TF5200 channel parameters
/// 149215627, programming manual 208407691).
fn numbers(before: &str) -> bool {
    let Some(word) = before.trim_ascii_end().strip_suffix(['G', 'g', 'M', 'm', 'H', 'h']) else {
        return false;
    };
    !word.ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.')
}

/// The piece that contains a position of the unexpanded text, shifted so that it begins there.
fn home(raw: &RawBlock<'_>, line: &Arc<str>, at: usize) -> Piece {
    let at = Span::new(at, at).start;
    match raw.pieces.iter().rev().find(|piece| piece.start <= at) {
        Some(piece) => Piece { column: piece.column + (at - piece.start), ..piece.clone() },
        None => Piece {
            start: at,
            column: at,
            offset: raw.position.offset,
            line: raw.position.line,
            latin1: false,
            end: Span::new(0, line.len()).len,
            replaces: None,
            text: Arc::clone(line),
        },
    }
}

/// Copies unexpanded text together with its positions.
fn copy(raw: &RawBlock<'_>, line: &Arc<str>, range: Range<usize>, out: &mut Expanded) {
    let mut at = range.start;
    while at < range.end {
        let home = home(raw, line, at);
        // up to the beginning of the next piece
        let next = raw.pieces.iter().map(|p| p.start as usize).find(|start| *start > at);
        let end = next.unwrap_or(range.end).min(range.end);
        let start = out.text.len();
        out.text.push_str(&raw.text[at..end]);
        let span = Span::new(start, out.text.len());
        out.pieces.push(Piece { start: span.start, end: span.end(), ..home });
        at = end;
    }
}

#[cfg(test)]
mod tests {
    use super::{Expanded, expand};
    use crate::diag::{Condition, Diagnostic};
    use crate::source::RawBlock;
    use crate::syntax::ast::Span;
    use std::sync::Arc;

    fn run(line: &str) -> Result<Option<Expanded>, Box<Diagnostic>> {
        let lookup = |name: &str| match name {
            "A" => Some("X10 \"B\" Y5"),
            "B" => Some("Z1"),
            "SUM" => Some("60 - 7"),
            "FIVE" => Some("54"),
            "CANCEL" => Some("G\"SUM\""),
            "HALF" => Some("COS["),
            "INSIDE" => Some("X\"HALF\"90]"),
            "WHOLE" => Some("SIN[90] (a remark [)"),
            "JUMP" => Some("$GOTO [E]"),
            "DOLLAR" => Some("\"JUMP\""),
            "PRICE" => Some("#MSG [\"5 $\"] (or $)"),
            "LOOP" => Some("\"LOOP\""),
            "TWICE" => Some("\"LONG\" \"LONG\""),
            "LONG" => {
                Some("0123456789012345678901234567890123456789 \"TEN\" \"TEN\" \"TEN\" \"TEN\"")
            }
            "TEN" => Some("\"L1\" \"L1\" \"L1\" \"L1\" \"L1\" \"L1\" \"L1\" \"L1\" \"L1\" \"L1\""),
            "L1" => Some(
                "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx",
            ),
            _ => None,
        };
        expand(&RawBlock::from_line(line), &Arc::from("f"), &lookup)
    }

    #[test]
    fn uses_are_replaced_and_definitions_stay() {
        let text = |line: &str| run(line).unwrap().map(|e| e.raw().text.to_owned());
        assert_eq!(text("G1 \"A\" F5").as_deref(), Some("G1 X10 Z1 Y5 F5"));
        assert_eq!(text("\"A\" = \"B\""), None);
        assert_eq!(text("N10 LL\"B\"").as_deref(), Some("N10 LL\"Z1\""));
        assert_eq!(text("LL \"B\"").as_deref(), Some("LL Z1"));
        assert_eq!(text("L\"B\"").as_deref(), Some("LZ1"));
        assert_eq!(text("V.P.S = \"other\" ; \"A\""), None);
        assert_eq!(text("P1==\"B\"").as_deref(), Some("P1==Z1"));
        // as the number of a function, the text is one value
        assert_eq!(text("G\"SUM\"").as_deref(), Some("G[60 - 7]"));
        assert_eq!(text("N10 M\"SUM\"G\"FIVE\"").as_deref(), Some("N10 M[60 - 7]G54"));
        assert_eq!(text("\"CANCEL\" X1").as_deref(), Some("G[60 - 7] X1"));
        assert_eq!(text("XG\"SUM\"").as_deref(), Some("XG60 - 7"));
    }

    #[test]
    fn places_map_to_the_use() {
        let expanded = run("G1 \"A\" F5").unwrap().unwrap();
        let raw = expanded.raw();
        let column = |start, end| {
            let place = raw.locate(&Arc::from("f"), Span::new(start, end));
            (place.column, place.length, place.text.to_string())
        };
        let line = "G1 \"A\" F5".to_owned();
        assert_eq!(column(0, 2), (1, 2, line.clone()));
        assert_eq!(column(7, 9), (4, 3, line.clone()));
        assert_eq!(column(13, 15), (8, 2, line));
    }

    #[test]
    fn a_macro_holds_whole_levels_of_brackets() {
        for line in ["X\"HALF\" 90]", "\"INSIDE\""] {
            assert_eq!(run(line).unwrap_err().id, Condition::MacroBracket, "{line}");
        }
        assert!(run("X\"WHOLE\"").unwrap().is_some());
        // the definition itself is not expanded
        assert_eq!(run("\"HALF\" = \"COS[\""), Ok(None));
    }

    #[test]
    fn a_macro_holds_no_control_statement() {
        for line in ["\"JUMP\"", "$IF 1 \"JUMP\"", "X1 \"DOLLAR\""] {
            assert_eq!(run(line).unwrap_err().id, Condition::MacroControl, "{line}");
        }
        assert!(run("\"PRICE\"").unwrap().is_some());
        assert!(run("$IF \"B\"").unwrap().is_some());
    }

    #[test]
    fn endless_and_exploding_macros_end() {
        assert_eq!(run("\"LOOP\"").unwrap_err().id, Condition::MacroNesting);
        assert!(run("\"TWICE\"").unwrap().unwrap().raw().characters > 4096);
    }
}
