//! Byte loop for plain blocks: almost every line of a CAM program.
//!
//! It accepts a block number, G and M functions, one-letter addresses with plain numbers and a comment behind `;`, and gives the tree that
//! the grammar gives. Everything else it hands over, so it never reports an error. The tests compare both over random
//! and damaged lines.

use super::ast::{
    Block, BlockNumber, Body, CodeNumber, Expr, ExprKind, Name, Sign, Span, Word, WordKind,
};
use super::number::short_decimal;

/// Words of a usual block: one allocation holds them.
const USUAL_WORDS: usize = 8;

/// The tree of a plain block, `None` if the grammar has to see it.
pub(super) fn recognize(text: &str) -> Option<Block> {
    let bytes = text.as_bytes();
    let mut at = blanks(bytes, 0);
    let begin = at;
    let mut number = None;
    if matches!(bytes.get(at), Some(b'N' | b'n')) {
        let (value, end) = integer(bytes, at + 1)?;
        number = Some(BlockNumber::Literal(value));
        at = end;
        // A label, or a value of the grammar's choice.
        if matches!(bytes.get(at), Some(b':' | b'.')) {
            return None;
        }
    }
    let mut end = at;
    at = blanks(bytes, at);
    if number.is_none() && matches!(bytes.get(at), None | Some(b';')) {
        return Some(Block::default());
    }
    let mut words = Vec::new();
    while let Some(letter) = bytes.get(at).filter(|b| **b != b';') {
        let word = word(bytes, at, letter.to_ascii_uppercase())?;
        at = word.span.end() as usize;
        end = at;
        if words.is_empty() {
            words.reserve_exact(USUAL_WORDS);
        }
        words.push(word);
        at = blanks(bytes, at);
    }
    let body = if words.is_empty() { Body::Empty } else { Body::Words(words) };
    Some(Block { skip: None, number, label: None, body, span: Span::new(begin, end) })
}

fn word(bytes: &[u8], start: usize, letter: u8) -> Option<Word> {
    match letter {
        b'G' | b'M' => {
            let (value, end) = integer(bytes, start + 1)?;
            let number = u32::try_from(value).unwrap_or(u32::MAX);
            let kind = if letter == b'G' {
                WordKind::G { number, value: None }
            } else {
                WordKind::M(CodeNumber::Literal(number), None)
            };
            // A value may follow; a letter begins a new word, unless it begins a parameter, variable or function.
            let next = blanks(bytes, end);
            followed_by_word(bytes, next)?;
            Some(Word { kind, span: Span::new(start, end) })
        }
        b'A'..=b'F' | b'I'..=b'K' | b'Q'..=b'U' | b'W'..=b'Z' => {
            let mut at = start + 1;
            let negative = bytes.get(at) == Some(&b'-');
            at += usize::from(negative);
            let (value, length) = short_decimal(&bytes[at..])?;
            let span = Span::new(start + 1, at + length);
            followed_by_word(bytes, blanks(bytes, at + length))?;
            let kind = ExprKind::Number(if negative { -value } else { value });
            let value = Expr { kind, span };
            let sign = negative.then_some(Sign::Minus);
            let kind = WordKind::Address { name: Name::Letter(letter), sign, value };
            Some(Word { kind, span: Span::new(start, at + length) })
        }
        _ => None,
    }
}

/// True at the end, or before a letter of which this file knows that it begins a word of its own: whether it is one, the
/// next step finds out.
fn followed_by_word(bytes: &[u8], at: usize) -> Option<()> {
    match bytes.get(at) {
        None | Some(b';') => Some(()),
        Some(byte) if byte.is_ascii_alphabetic() => {
            // Two letters in a row: an operator (`MOD`), a function or a name.
            (!bytes.get(at + 1)?.is_ascii_alphabetic()).then_some(())
        }
        Some(_) => None,
    }
}

fn blanks(bytes: &[u8], mut at: usize) -> usize {
    while matches!(bytes.get(at), Some(b' ' | b'\t')) {
        at += 1;
    }
    at
}

/// Digits from `at` on: value and end; short enough not to overflow.
fn integer(bytes: &[u8], at: usize) -> Option<(u64, usize)> {
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
