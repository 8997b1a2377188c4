//! Blanks and digits.

use crate::source::regions::closed_comment;

/// Position after blanks and comments in brackets, which are blanks for the grammar.
pub(super) fn blanks(bytes: &[u8], mut at: usize) -> usize {
    loop {
        match bytes.get(at) {
            Some(b' ' | b'\t') => at += 1,
            // one that is not closed may be a mistake, which is reported
            Some(b'(') => match closed_comment(&bytes[at..]) {
                Some(length) => at += length,
                None => return at,
            },
            _ => return at,
        }
    }
}

/// As [`blanks`], where no word has been read: a remark that is not closed comments out the block.
pub(super) fn before_words(bytes: &[u8], at: usize) -> usize {
    match blanks(bytes, at) {
        at if bytes.get(at) == Some(&b'(') => bytes.len(),
        at => at,
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
