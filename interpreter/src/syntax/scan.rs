//! Prepares the characters of a block for the grammar.
//!
//! The grammar reads a masked text of the same length: comments and invalid characters are blanks. Names of several
//! characters configured in the machine (`X1`, `AP`) are marked, because the grammar does not know which of them exist.

use super::ast::Span;
use super::grammar::HASH_WORDS;
use crate::source::regions::{self, Region, regions};

/// Byte that replaces every character of a configured name in the masked text.
pub(super) const MARK: u8 = 1;

/// Replaces a quote that is never closed in the masked text.
pub(super) const UNCLOSED: char = '\u{2}';

/// Deepest nesting of square brackets; deeper blocks get K-0006. Far deeper than in any program written by hand or by a
/// post-processor, and small enough for the stack of every platform.
pub(crate) const NESTING_MAX: usize = 64;

/// Text as read by the grammar.
pub(super) struct Masked {
    /// Same length in bytes as the block.
    pub(super) text: String,
    /// Invalid characters, blanks in `text`.
    pub(super) invalid: Vec<Span>,
    /// First bracket that is nested too deeply.
    pub(super) too_deep: Option<usize>,
    /// The `(` of a remark after words that is not closed.
    pub(super) open_remark: Option<Span>,
}

/// Masks a block; `names` are configured names in upper case, longest first.
pub(super) fn mask(text: &str, names: &[Box<str>]) -> Masked {
    let bytes = text.as_bytes();
    let mut out = bytes.to_vec();
    let mut invalid: Vec<Span> = Vec::new();
    let mut too_deep = None;
    let mut open_remark = None;
    let mut depth = 0_usize;
    for (region, range) in regions(text) {
        match region {
            Region::Comment { closed } => {
                // blocks are commented out by a single `(`, so it is usual at their beginning, also after their number
                let begins = out[..range.start].iter().all(|b| b"/Nn:0123456789 \t".contains(b));
                if !closed && !begins && bytes[range.start] == b'(' {
                    open_remark = Some(Span::new(range.start, range.start + 1));
                }
                out[range].fill(b' ');
            }
            Region::Text => {}
            Region::Code => {
                for i in range {
                    match bytes[i] {
                        b'[' => {
                            depth += 1;
                            if depth > NESTING_MAX {
                                too_deep = too_deep.or(Some(i));
                            }
                        }
                        b']' => depth = depth.saturating_sub(1),
                        b'"' => out[i] = UNCLOSED as u8, // not closed, otherwise it would be a string
                        byte if is_valid(byte) => {}
                        _ => {
                            out[i] = b' ';
                            match invalid.last_mut() {
                                Some(last) if last.end() as usize == i => last.len += 1,
                                _ => invalid.push(Span::new(i, i + 1)),
                            }
                        }
                    }
                }
            }
        }
    }
    if !names.is_empty() {
        mark_names(&mut out, names);
    }
    // whole characters were replaced, or ASCII by ASCII, so the bytes are valid UTF-8
    let text = String::from_utf8(out).unwrap_or_default();
    Masked { text, invalid, too_deep, open_remark }
}

/// The masked text with its strings blanked out; it is then ASCII only.
pub(super) fn without_texts(masked: &str) -> String {
    let mut out = masked.as_bytes().to_vec();
    for range in regions::strings(masked) {
        out[range].fill(b' ');
    }
    String::from_utf8(out).unwrap_or_default()
}

/// Characters of the dialect outside comments and strings.
fn is_valid(byte: u8) -> bool {
    byte == b'\t' || matches!(byte, b' '..=b'~') && !matches!(byte, b'{' | b'}' | b'`')
}

/// Marks configured names where a DIN word may begin.
fn mark_names(bytes: &mut [u8], names: &[Box<str>]) {
    let first = bytes.iter().copied().find(|b| !matches!(b, b' ' | b'\t'));
    if matches!(first, Some(b'%')) {
        return;
    }
    let (mut i, mut depth) = (0, 0_usize);
    while i < bytes.len() {
        let rest = &bytes[i..];
        let letter_before = i > 0 && (bytes[i - 1].is_ascii_alphabetic() || bytes[i - 1] == b'_');
        match rest[0] {
            // commands and control statements contain no DIN words, except for the `#` words among them
            b'$' => return,
            b'#' if hash_word(rest).is_none() => return,
            b'#' => i += hash_word(rest).unwrap_or(1),
            b'"' => i += regions::string(rest).unwrap_or(1),
            b'[' => {
                depth += 1;
                i += 1;
            }
            b']' => {
                depth = depth.saturating_sub(1);
                i += 1;
            }
            b'@' => i += 1 + run(&rest[1..], |b| b.is_ascii_alphanumeric()),
            b'V' | b'v' if rest.get(1) == Some(&b'.') => i += variable(rest),
            b'L' | b'l' if !letter_before => i += call(rest),
            byte if byte.is_ascii_alphabetic() && depth == 0 && !letter_before => {
                match names.iter().find(|name| name_is_at(rest, name)) {
                    Some(name) => {
                        bytes[i..i + name.len()].fill(MARK);
                        i += name.len();
                    }
                    None => i += 1,
                }
            }
            _ => i += 1,
        }
    }
}

/// Length of a `#` word that may occur among DIN words.
fn hash_word(bytes: &[u8]) -> Option<usize> {
    let start = 1 + run(&bytes[1..], |b| matches!(b, b' ' | b'\t'));
    let length = start + run(&bytes[start..], |b| b.is_ascii_alphanumeric() || b == b'_');
    let name = std::str::from_utf8(&bytes[start..length]).ok()?;
    HASH_WORDS.iter().any(|w| w.eq_ignore_ascii_case(name)).then_some(length)
}

/// A name with a digit needs `=` or a bracket: `X1=10`, but `X10` is X.
fn name_is_at(bytes: &[u8], name: &str) -> bool {
    let Some(head) = bytes.get(..name.len()) else { return false };
    if !head.eq_ignore_ascii_case(name.as_bytes()) {
        return false;
    }
    let behind = bytes[name.len()..].iter().find(|b| !matches!(b, b' ' | b'\t'));
    !name.contains(|c: char| c.is_ascii_digit()) || matches!(behind, Some(b'=' | b'['))
}

/// Length of a variable.
fn variable(bytes: &[u8]) -> usize {
    let mut i = 1;
    while let Some(byte) = bytes.get(i) {
        let sign = matches!(byte, b'+' | b'-') && bytes[i - 1] == b'.';
        if !(sign
            || *byte == b'.'
            || *byte == b'@'
            || *byte == b'_'
            || byte.is_ascii_alphanumeric())
        {
            break;
        }
        i += 1;
    }
    i
}

/// Length of `L`, `LL` with the name after it.
fn call(bytes: &[u8]) -> usize {
    let letters = run(bytes, |b| matches!(b, b'L' | b'l'));
    let blanks = run(&bytes[letters..], |b| matches!(b, b' ' | b'\t'));
    if blanks == 0 {
        return letters;
    }
    let begin = letters + blanks;
    begin + run(&bytes[begin..], |b| !matches!(b, b' ' | b'\t' | b'[' | b'"' | b',' | b'#' | b'$'))
}

/// Length of the run of bytes at the beginning that meet a condition.
fn run(bytes: &[u8], accept: impl Fn(u8) -> bool) -> usize {
    bytes.iter().take_while(|b| accept(**b)).count()
}

#[cfg(test)]
mod tests {
    use super::mask;

    fn masked(text: &str, names: &[&str]) -> String {
        let names: Vec<Box<str>> = names.iter().map(|n| Box::from(*n)).collect();
        mask(text, &names).text.replace('\u{1}', "_")
    }

    #[test]
    fn comments_become_blanks_and_strings_stay() {
        assert_eq!(masked("X1 (a (b) c)Y2", &[]), "X1          Y2");
        assert_eq!(masked("( N010 #SLOPE[TYPE=HSC]", &[]).trim(), "");
        assert_eq!(masked(r#"["(a;\"" ;x"#, &[]), r#"["(a;\""   "#);
        assert_eq!(masked("X1 ;(Y2)", &[]).trim_end(), "X1");
        assert_eq!(masked("\"a ;b", &[]), "\u{2}a   ");
    }

    #[test]
    fn configured_names_are_marked_only_as_words() {
        let names = ["X1", "AP"];
        assert_eq!(masked("N10AP5X1=3X10", &names), "N10__5__=3X10");
        assert_eq!(masked("X10 ap-5 XV.P.AP X[AP]", &names), "X10 __-5 XV.P.AP X[AP]");
        assert_eq!(masked("L AP #AX [AP]", &names), "L AP #AX [AP]");
        assert_eq!(masked("P1=V.A.-AP.AP @AP1", &names), "P1=V.A.-AP.AP @AP1");
        assert_eq!(masked("#PSET AP5", &names), "#PSET __5");
    }

    #[test]
    fn invalid_characters_are_listed() {
        let found = mask("X1ä{Y2 (ä) \"ä\"", &[]);
        assert_eq!(found.text, "X1   Y2      \"ä\"");
        assert_eq!((found.invalid[0].start, found.invalid[0].len, found.invalid.len()), (2, 3, 1));
    }
}
