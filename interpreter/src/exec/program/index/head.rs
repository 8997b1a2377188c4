//! The beginning of a block, as far as the structure requires it: label, words, ends of programs, empty lines.

use crate::source::regions::{Region, regions};
use crate::syntax::ast::LabelKind;

/// Beginning of a block, as needed by an index.
pub(super) struct Head<'t> {
    pub(super) skip: Option<u8>,
    pub(super) label: Option<LabelKind>,
    /// Position of the label.
    pub(super) label_at: usize,
    /// Text after skip mark, number and label.
    pub(super) rest: &'t str,
    /// Position of `rest`.
    pub(super) at: usize,
}

pub(super) fn head(text: &str) -> Head<'_> {
    let mut rest = blank(text);
    let mut skip = None;
    if let Some(behind) = rest.strip_prefix('/') {
        let digits = digits(behind);
        skip = Some(behind[..digits].parse().unwrap_or(1));
        rest = blank(&behind[digits..]);
    }
    let mut label = None;
    let mut label_at = text.len() - rest.len();
    if let Some(behind) = rest.strip_prefix(['N', 'n']) {
        let behind = blank(behind);
        let length = digits(behind);
        if length > 0 {
            let number = &behind[..length];
            rest = blank(&behind[length..]);
            if let Some(behind) = rest.strip_prefix(':') {
                label = Some(LabelKind::Number(number.parse().unwrap_or(u64::MAX)));
                rest = blank(behind);
            }
        } else if let Some(number) = behind.strip_prefix(['P', 'p']) {
            // `NP123`: the number is in a parameter
            rest = blank(&number[digits(number)..]);
        }
    }
    if label.is_none()
        && rest.starts_with('[')
        && let Some(end) = rest.find(']')
    {
        let name = rest[1..end].trim();
        if !name.is_empty() {
            label_at = text.len() - rest.len();
            label = Some(LabelKind::Name(name.to_uppercase().into()));
            rest = blank(&rest[end + 1..]);
            // the block number may follow the name: `[NAME] N10`
            if let Some(behind) = rest.strip_prefix(['N', 'n'])
                && digits(behind) > 0
            {
                rest = blank(&behind[digits(behind)..]);
            }
        }
    }
    Head { skip, label, label_at, rest, at: text.len() - rest.len() }
}

/// The structural elements of a block other than `$` and labels, with their position: `%`, and the commands that hide
/// blocks.
pub(in crate::exec) fn structure(text: &str) -> Option<(&'static str, usize)> {
    let Head { rest, at, .. } = head(text);
    let name = match rest.bytes().next()? {
        b'%' => "%",
        b'#' => match word(blank(&rest[1..])).as_str() {
            "IF" => "#IF",
            "ELSE" => "#ELSE",
            "ENDIF" => "#ENDIF",
            "COMMENT" if is_command(rest, "COMMENT", "BEGIN") => "#COMMENT BEGIN",
            "COMMENT" if is_command(rest, "COMMENT", "END") => "#COMMENT END",
            "RT" if real_time_cycle(rest)? => "#RT CYCLE",
            "RT" => "#RT CYCLE END",
            _ => return None,
        },
        _ => return None,
    };
    Some((name, at))
}

/// Number of a block, unless it is computed.
pub(in crate::exec) fn number_of(text: &str) -> Option<u64> {
    let mut rest = blank(text);
    if let Some(behind) = rest.strip_prefix('/') {
        rest = blank(&behind[digits(behind)..]);
    }
    let behind = blank(rest.strip_prefix(['N', 'n'])?);
    behind[..digits(behind)].parse().ok()
}

fn digits(text: &str) -> usize {
    text.bytes().take_while(u8::is_ascii_digit).count()
}

/// The text without blanks and closed comments at its beginning.
pub(super) fn blank(text: &str) -> &str {
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
pub(super) fn word(text: &str) -> String {
    text.chars().take_while(char::is_ascii_alphanumeric).collect::<String>().to_ascii_uppercase()
}

/// Whether a line ends the main program: M02, M30, or M17 or M29 outside comments.
pub(super) fn ends_program(text: &str) -> bool {
    let bytes = text.as_bytes();
    memchr::memchr2_iter(b'M', b'm', bytes).any(|i| {
        let rest = &text[i + 1..];
        let length = digits(rest);
        matches!(rest[..length].trim_start_matches('0'), "2" | "30" | "17" | "29")
            && !text[..i].ends_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && is_code(text, i)
    })
}

/// Whether a byte is neither in a comment nor in a text.
fn is_code(text: &str, at: usize) -> bool {
    memchr::memchr3(b'(', b';', b'"', &text.as_bytes()[..at]).is_none()
        || regions(text).any(|(region, range)| region == Region::Code && range.contains(&at))
}

/// Bytes that do not occur in a line that [has no effect on the structure](says_nothing): `M` could end the program,
/// `\` continues a line.
pub(super) const SAYING: [u8; 3] = [b'M', b'm', b'\\'];

/// Whether a line without bytes of [`SAYING`], inside a section, has no effect on the structure, as most lines of a
/// long program: an optional block number, then a word of one letter. Several letters may be a control statement
/// without its `$`.
pub(super) fn says_nothing(line: &[u8]) -> bool {
    let mut rest = line;
    if let [b'N' | b'n', behind @ ..] = line {
        let digits = behind.iter().take_while(|b| b.is_ascii_digit()).count();
        let blanks = behind[digits..].iter().take_while(|b| matches!(b, b' ' | b'\t')).count();
        rest = if digits > 0 { &behind[digits + blanks..] } else { &[] };
    }
    rest.first().is_some_and(u8::is_ascii_alphabetic)
        && !rest.get(1).is_some_and(u8::is_ascii_alphabetic)
}

/// Name after a program head: the first word.
pub(super) fn name_of(text: &str) -> Option<&str> {
    let end = text.find([' ', '\t', '(', ';']).unwrap_or(text.len());
    (end > 0).then(|| &text[..end])
}

/// Whether it is `#FIRST SECOND`.
pub(super) fn is_command(rest: &str, first: &str, second: &str) -> bool {
    let behind = blank(&rest[1..]);
    let (name, more) = split_word(behind);
    name.eq_ignore_ascii_case(first) && word(more) == second
}

/// The word at the beginning, and the text behind it without blanks and comments before that.
pub(super) fn split_word(text: &str) -> (&str, &str) {
    let length = text.bytes().take_while(u8::is_ascii_alphanumeric).count();
    (&text[..length], blank(&text[length..]))
}

/// What follows the first two words of a command.
pub(super) fn behind_command(rest: &str) -> &str {
    split_word(split_word(blank(&rest[1..])).1).1
}

/// `#RT CYCLE` and `#RT CYCLE DEF` (true), `#RT CYCLE END` (false); `None` for other commands, including those that
/// manage such cycles.
pub(super) fn real_time_cycle(rest: &str) -> Option<bool> {
    if !is_command(rest, "RT", "CYCLE") {
        return None;
    }
    match word(behind_command(rest)).as_str() {
        "" | "DEF" => Some(true),
        "END" => Some(false),
        _ => None,
    }
}

/// Whether `$GOTO` follows the condition; `$` may be missing in both.
pub(super) fn contains_goto(rest: &str) -> bool {
    let code: String = regions(rest)
        .map(|(region, range)| if region == Region::Code { &rest[range] } else { " " })
        .collect();
    let code = code.to_ascii_uppercase();
    let mut words = code.split_ascii_whitespace();
    code.contains("$GOTO") || !code.starts_with('$') && words.any(|word| word == "GOTO")
}
