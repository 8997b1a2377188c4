//! Lines of a list: encoding, positions, and the border between value and comment.

use crate::diag::Location;
use crate::machine::table::Raw;
use std::borrow::Cow;
use std::sync::Arc;

/// A line with its position in the file.
pub(super) struct Line<'a> {
    /// The text without the end of line.
    pub(super) text: Cow<'a, str>,
    number: u32,
    offset: u64,
    utf8: bool,
}

/// Lines of a file. LF, CR LF and CR end a line as in programs, a byte order mark is skipped, and text that is not
/// UTF-8 is read as Latin-1.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = Line<'_>> {
    let mark = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
    let bytes = &bytes[mark..];
    let utf8 = std::str::from_utf8(bytes).is_ok();
    let mut offset = mark as u64;
    let mut number = 0;
    let mut rest = Some(bytes);
    std::iter::from_fn(move || {
        let from = rest?;
        let end = memchr::memchr2(b'\n', b'\r', from).unwrap_or(from.len());
        let (line, behind) = from.split_at(end);
        let mark = if behind.starts_with(b"\r\n") { 2 } else { 1 };
        rest = behind.get(mark..);
        let start = offset;
        offset += (end + mark) as u64;
        number += 1;
        let text = match std::str::from_utf8(line) {
            Ok(text) if utf8 => Cow::Borrowed(text),
            _ => Cow::Owned(line.iter().map(|b| char::from(*b)).collect()),
        };
        Some(Line { text, number, offset: start, utf8 })
    })
}

impl Line<'_> {
    /// Position of a part of the line.
    pub(super) fn location(&self, file: &Arc<str>, part: &str) -> Location {
        // parts are slices of the line, so the difference of the addresses is the position
        let start = (part.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize);
        let before = self.text.get(..start).unwrap_or_default();
        let column = before.chars().count();
        let offset = if self.utf8 { start } else { column };
        Location {
            file: file.clone(),
            line: self.number,
            column: u32::try_from(column + 1).unwrap_or(u32::MAX),
            offset: self.offset + offset as u64,
            length: u32::try_from(part.chars().count().max(1)).unwrap_or(u32::MAX),
            block: None,
            text: self.text.as_ref().into(),
        }
    }
}

/// A value and the text after it.
#[derive(Debug, PartialEq)]
pub(super) struct Parts<'a> {
    /// The value without quotes; `None` if there is none.
    pub(super) value: Option<&'a str>,
    /// Text after a text value, or a number after a number, that is not a comment.
    pub(super) dropped: Option<&'a str>,
}

/// Digits with or without a point, or hexadecimal ones after `0x`.
fn is_number(text: &str) -> bool {
    match text.strip_prefix("0x").or(text.strip_prefix("0X")) {
        Some(digits) => !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_hexdigit()),
        None => {
            text.bytes().any(|b| b.is_ascii_digit())
                && text.bytes().all(|b| b.is_ascii_digit() || b == b'.')
        }
    }
}

fn is_comment(text: &str) -> bool {
    ["#", "(", "/*"].iter().any(|opener| text.starts_with(opener))
}

/// Divides the rest of a line after the key, without surrounding blanks, into its parts.
pub(super) fn value(raw: Raw, rest: &str) -> Parts<'_> {
    if raw == Raw::Code {
        return Parts { value: Some(code(rest)).filter(|code| !code.is_empty()), dropped: None };
    }
    let rest = if raw == Raw::Text { rest } else { after_remarks(rest) };
    if rest.is_empty() || is_comment(rest) {
        return Parts { value: None, dropped: None };
    }
    if let Some(quoted) = rest.strip_prefix('"') {
        let (value, tail) = quoted.split_once('"').unwrap_or((quoted, ""));
        return Parts { value: Some(value.trim_end()), dropped: leftover(raw, tail) };
    }
    if let Raw::Flags(names) = raw {
        let value = flags(rest);
        // a further flag without a joining `|` is not meant as a comment; after a number its name is one, as in the
        // vendor's lists, and nothing but a number is not
        let is_flag = |word: &&str| {
            let word = word.trim_end_matches([',', ';']);
            names.iter().any(|(name, _)| name.eq_ignore_ascii_case(word))
        };
        let tail = &rest[value.len()..];
        let words = tail.split_whitespace().skip_while(|word| matches!(*word, "+" | "&" | ","));
        let mut words = words.take_while(|word| !is_comment(word));
        let next = words.next();
        let dropped = if value.starts_with(|c: char| c.is_ascii_digit()) {
            next.filter(|next| is_number(next) && words.all(is_number))
        } else {
            next.filter(is_flag)
        };
        return Parts { value: Some(value), dropped };
    }
    let (word, tail) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
    if raw == Raw::Text {
        return Parts { value: Some(word), dropped: leftover(raw, tail) };
    }
    let end = word.find('#').unwrap_or(word.len());
    // nothing but numbers behind a number is no comment: `5 000`, but `5000 10 is 0.1/s`
    let mut words = std::iter::once(word).chain(tail.split_whitespace());
    let numbers = words.by_ref().take_while(|word| !is_comment(word)).all(is_number);
    let next = tail.split_whitespace().next().filter(|next| numbers && !is_comment(next));
    Parts { value: Some(&word[..end]), dropped: next }
}

/// NC code extends to the end of the line, including brackets and `#`.
///
/// Assumption: a `#` between blanks, and `/*`, begin a comment of the list.
fn code(rest: &str) -> &str {
    let ends = |text: &str| text.chars().next_back().is_none_or(char::is_whitespace);
    let begins = |text: &str| text.chars().next().is_none_or(char::is_whitespace);
    let remark = |at: &usize| ends(&rest[..*at]) && begins(&rest[at + 1..]);
    let number_sign = rest.match_indices('#').map(|(at, _)| at).find(remark);
    let end = rest.find("/*").into_iter().chain(number_sign).min().unwrap_or(rest.len());
    let code = rest[..end].trim_end();
    let inner = code.strip_prefix('"').and_then(|code| code.strip_suffix('"'));
    inner.filter(|inner| !inner.replace("\\\"", "").contains('"')).unwrap_or(code)
}

/// The text after remarks in closed brackets: the documents print some between key and value.
fn after_remarks(mut rest: &str) -> &str {
    while let Some((_, behind)) = rest.strip_prefix('(').and_then(|r| r.split_once(')')) {
        let behind = behind.trim_start();
        if behind.is_empty() {
            break;
        }
        rest = behind;
    }
    rest
}

/// After numbers and names any text is a comment; after a text a comment needs its opening characters.
fn leftover(raw: Raw, tail: &str) -> Option<&str> {
    let tail = tail.trim();
    (raw == Raw::Text && !tail.is_empty() && !is_comment(tail)).then_some(tail)
}

/// Words joined by `|`, with or without blanks around it.
fn flags(rest: &str) -> &str {
    let mut end = 0;
    let mut joined = true;
    for word in rest.split_inclusive(char::is_whitespace) {
        let trimmed = word.trim_end();
        let start = word.as_ptr() as usize - rest.as_ptr() as usize;
        if !trimmed.is_empty() {
            if is_comment(trimmed) || !(joined || trimmed.starts_with('|')) {
                break;
            }
            joined = trimmed.ends_with('|');
            end = start + trimmed.find('#').unwrap_or(trimmed.len());
            if trimmed.contains('#') {
                break;
            }
        }
    }
    &rest[..end]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_end_where_comments_begin() {
        let text = |rest| value(Raw::Text, rest);
        assert_eq!(text("X        (table"), Parts { value: Some("X"), dropped: None });
        assert_eq!(text("\"two words \" (c"), Parts { value: Some("two words"), dropped: None });
        assert_eq!(text("two words"), Parts { value: Some("two"), dropped: Some("words") });
        assert_eq!(text("(only a comment"), Parts { value: None, dropped: None });
        let code = |rest| value(Raw::Code, rest).value;
        assert_eq!(code("G01 X10 (to the edge)  # start"), Some("G01 X10 (to the edge)"));
        assert_eq!(code("#SLOPE[TYPE=STEP] /* hard"), Some("#SLOPE[TYPE=STEP]"));
        assert_eq!(code("\"P5 = P2 + 3\""), Some("P5 = P2 + 3"));
        assert_eq!(code("\"A\" \"B\""), Some("\"A\" \"B\""));
        assert_eq!(code("# nothing"), None);
        let number = |rest| value(Raw::Uns32, rest).value;
        assert_eq!(number("5000      50/s"), Some("5000"));
        assert_eq!(number("500000    /* um/s"), Some("500000"));
        assert_eq!(number("0x101#0x001"), Some("0x101"));
        let names = |rest| value(Raw::Flags(&[]), rest).value;
        assert_eq!(names("VEL | ACC"), Some("VEL | ACC"));
        assert_eq!(names("VEL|ACC and more"), Some("VEL|ACC"));
        assert_eq!(names("(from V3.1 on) ADD_VEL | ADD_ACC"), Some("ADD_VEL | ADD_ACC"));
        assert_eq!(names("(only a remark)"), None);
        let both = value(Raw::Flags(&[("VEL", 1), ("ACC", 2)]), "VEL ACC");
        assert_eq!(both, Parts { value: Some("VEL"), dropped: Some("ACC") });
        let number = value(Raw::Flags(&[("VEL", 1)]), "0x00000001     VEL  (speed");
        assert_eq!(number, Parts { value: Some("0x00000001"), dropped: None });
        let sum = value(Raw::Flags(&[("VEL", 1), ("ACC", 2)]), "VEL + ACC");
        assert_eq!(sum, Parts { value: Some("VEL"), dropped: Some("ACC") });
        let numbers = value(Raw::Flags(&[("VEL", 1)]), "0x1 0x4 # both");
        assert_eq!(numbers, Parts { value: Some("0x1"), dropped: Some("0x4") });
        let sum = value(Raw::Flags(&[("VEL", 1)]), "0x1 + 0x4");
        assert_eq!(sum, Parts { value: Some("0x1"), dropped: Some("0x4") });
        let explained = value(Raw::Flags(&[("VEL", 1)]), "0x101 0x1: VEL");
        assert_eq!(explained, Parts { value: Some("0x101"), dropped: None });
        let remark = value(Raw::Flags(&[("VEL", 1)]), "VEL and more");
        assert_eq!(remark, Parts { value: Some("VEL"), dropped: None });
        assert_eq!(names("VEL |ACC  # both"), Some("VEL |ACC"));
        assert_eq!(names("0x101 #0x001: Activation velocity feedforward"), Some("0x101"));
    }

    #[test]
    fn places_count_characters_and_bytes() {
        let bytes = "\u{feff}# ä\r\nkey ü  5\n".as_bytes();
        let all: Vec<Line<'_>> = lines(bytes).collect();
        assert_eq!(all[1].text, "key ü  5");
        let part = &all[1].text[8..];
        let at = all[1].location(&"f".into(), part);
        assert_eq!((at.line, at.column, at.length), (2, 8, 1));
        assert_eq!(bytes[usize::try_from(at.offset).unwrap()], b'5');
        // every end of line, each alone, and the last one missing
        let bytes = b"a 1\nb 2\r\nc 3\rd 4\r\re 5";
        let text = |line: &Line<'_>| line.text.clone().into_owned();
        let all: Vec<Line<'_>> = lines(bytes).collect();
        let texts: Vec<String> = all.iter().map(text).collect();
        assert_eq!(texts, ["a 1", "b 2", "c 3", "d 4", "", "e 5"]);
        let last = all[5].location(&"f".into(), &all[5].text);
        assert_eq!((last.line, bytes[usize::try_from(last.offset).unwrap()]), (6, b'e'));
        let ends: Vec<String> = lines(b"a\r\n").map(|line| text(&line)).collect();
        assert_eq!(ends, ["a", ""]);
        // the same in Latin-1: one byte per character
        let bytes = b"a \xfc  5";
        let line = lines(bytes).next().unwrap();
        let at = line.location(&"f".into(), &line.text[6..]);
        assert_eq!((at.column, at.offset), (6, 5));
    }
}
