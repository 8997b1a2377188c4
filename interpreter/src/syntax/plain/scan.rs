//! Blanks and digits.

use crate::source::regions::comment_length;

/// Position after blanks and comments in brackets, which are blanks for the grammar.
pub(super) fn blanks(bytes: &[u8], mut at: usize) -> usize {
    loop {
        match bytes.get(at) {
            Some(b' ' | b'\t') => at += 1,
            Some(b'(') => at += comment_length(&bytes[at..]),
            _ => return at,
        }
    }
}

/// Digits from `at` on: value and end position; limited in number, so that the value does not overflow.
pub(super) fn integer(bytes: &[u8], at: usize) -> Option<(u64, usize)> {
    let mut value = 0_u64;
    let mut end = at;
    while let Some(byte) = bytes.get(end).filter(|b| b.is_ascii_digit()) {
        value = value * 10 + u64::from(byte - b'0');
        end += 1;
        if end > at + 18 {
            return None;
        }
    }
    (end > at).then_some((value, end))
}
