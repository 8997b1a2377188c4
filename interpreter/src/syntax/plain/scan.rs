//! Blanks and digits.

use crate::source::regions::closed_comment;
use crate::syntax::number::{digits, integer_in_word, word_at};

/// Position after blanks and comments in brackets, which are blanks for the grammar.
#[inline]
pub(super) fn blanks(bytes: &[u8], at: usize) -> usize {
    // between most words there is one blank or none
    let behind = at + usize::from(bytes.get(at) == Some(&b' '));
    match bytes.get(behind) {
        Some(b' ' | b'\t' | b'(') => several_blanks(bytes, behind),
        _ => behind,
    }
}

fn several_blanks(bytes: &[u8], mut at: usize) -> usize {
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
    if let Some((value, length)) = word_at(bytes, at).and_then(integer_in_word) {
        return Some((value, at + length));
    }
    let (count, value) = digits(bytes.get(at..)?, 0);
    (1..=18).contains(&count).then_some((value, at + count))
}
