//! Code, strings and comments of a block, which decide where lines continue and what the grammar must not see.

use std::ops::Range;

/// Kind of a part of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Region {
    Code,
    /// `"..."`, quotes included; a quote without an end is code.
    Text,
    /// `(...)`, nested, or everything after `;` or an unclosed `(`.
    Comment {
        closed: bool,
    },
}

/// Divides a text into regions.
pub(crate) struct Regions<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Whether a quote without an end was found: later ones have none either, and the search is skipped.
    unclosed: bool,
}

impl Iterator for Regions<'_> {
    type Item = (Region, Range<usize>);

    fn next(&mut self) -> Option<Self::Item> {
        let start = self.at;
        let rest = &self.bytes[start..];
        let (region, length) = match rest.first()? {
            b';' => (Region::Comment { closed: false }, rest.len()),
            b'(' => comment(rest),
            b'"' => {
                let length = if self.unclosed { None } else { string(rest) };
                self.unclosed = length.is_none();
                length.map_or((Region::Code, 1), |length| (Region::Text, length))
            }
            _ => {
                let length = memchr::memchr3(b';', b'(', b'"', rest).unwrap_or(rest.len());
                (Region::Code, length)
            }
        };
        self.at += length;
        Some((region, start..self.at))
    }
}

/// The regions of a text.
pub(crate) fn regions(text: &str) -> Regions<'_> {
    Regions { bytes: text.as_bytes(), at: 0, unclosed: false }
}

/// Length of a comment in round brackets.
fn comment(bytes: &[u8]) -> (Region, usize) {
    let mut depth = 0_usize;
    for (i, byte) in bytes.iter().enumerate() {
        match byte {
            b'(' => depth += 1,
            b')' => {
                depth -= 1;
                if depth == 0 {
                    return (Region::Comment { closed: true }, i + 1);
                }
            }
            _ => {}
        }
    }
    (Region::Comment { closed: false }, bytes.len())
}

/// Length of the comment that begins with the first byte, if it is closed.
pub(crate) fn closed_comment(bytes: &[u8]) -> Option<usize> {
    let (region, length) = comment(bytes);
    (region == Region::Comment { closed: true }).then_some(length)
}

/// Length of a string with its quotes, `None` if the closing one is missing.
pub(crate) fn string(bytes: &[u8]) -> Option<usize> {
    let mut i = 1;
    loop {
        match bytes.get(i)? {
            b'\\' if bytes.get(i + 1) == Some(&b'"') => i += 2,
            b'"' => return Some(i + 1),
            _ => i += 1,
        }
    }
}

/// Whether text appended to `text` would be part of a comment.
pub(crate) fn ends_in_comment(text: &str) -> bool {
    regions(text).last().is_some_and(|(region, _)| region == Region::Comment { closed: false })
}

/// Whether a square bracket is open at the end of `text`.
pub(crate) fn bracket_is_open(text: &str) -> bool {
    brackets(text).open > 0
}

/// Whether every square bracket of `text` has its counterpart in it.
pub(crate) fn brackets_are_complete(text: &str) -> bool {
    brackets(text) == Brackets { open: 0, closed_too_often: false }
}

/// Square brackets of the code in a text without a counterpart in it.
#[derive(Default, PartialEq, Eq)]
struct Brackets {
    open: usize,
    closed_too_often: bool,
}

fn brackets(text: &str) -> Brackets {
    let mut found = Brackets::default();
    let code = regions(text).filter(|(region, _)| *region == Region::Code);
    for byte in code.flat_map(|(_, range)| &text.as_bytes()[range]) {
        match byte {
            b'[' => found.open += 1,
            b']' if found.open == 0 => found.closed_too_often = true,
            b']' => found.open -= 1,
            _ => {}
        }
    }
    found
}

/// Whether a text contains a character outside its strings and comments.
pub(crate) fn code_has(text: &str, byte: u8) -> bool {
    regions(text)
        .any(|(region, range)| region == Region::Code && text.as_bytes()[range].contains(&byte))
}

/// Positions of the strings of a block, quotes included.
pub(crate) fn strings(text: &str) -> impl Iterator<Item = Range<usize>> {
    regions(text).filter(|(region, _)| *region == Region::Text).map(|(_, range)| range)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn open_comments_and_brackets_are_seen() {
        assert!(ends_in_comment("X1 (a") && ends_in_comment("X1 ;a"));
        assert!(!ends_in_comment("X1 (a) "));
        assert!(bracket_is_open("L CYCLE [A=1") && !bracket_is_open("X[1](["));
        for (text, open, complete) in [
            ("[[1]", true, false),
            ("][", true, false),
            ("1]", false, false),
            ("[\"]\"]", false, true),
        ] {
            assert_eq!(
                (bracket_is_open(text), brackets_are_complete(text)),
                (open, complete),
                "{text}"
            );
        }
    }
}
