//! Byte loop for plain blocks, which are almost all lines of a CAM program.
//!
//! It accepts a skip mark, a block number or a label `N10:`, G, M and H functions, one-letter addresses with plain numbers or
//! sums in brackets, also after `=` or blanks, and comments. It yields numbers, from which [`Plain::tree`] makes the same tree as the grammar. All other
//! blocks are left to the grammar, so it never reports an error, and nothing but a note on a remark that is not closed. The
//! tests compare both over random and damaged lines.

mod scan;
mod sum;

use super::ast::{
    Block, BlockNumber, Body, CodeNumber, Expr, ExprKind, Label, LabelKind, Name, Sign, Span, Word,
    WordKind,
};
use super::number::{decimal_in_word, short_decimal, word_at};
use scan::{before_words, blanks, integer};
use smallvec::SmallVec;

/// A plain block.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Plain {
    /// Everything except the words.
    pub(crate) frame: PlainFrame,
    /// Words in written order.
    pub(crate) words: SmallVec<[PlainWord; 6]>,
}

/// The parts of a plain block other than its words.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PlainFrame {
    /// Skip level 1 to 10.
    pub(crate) skip: Option<u8>,
    /// Block number, also of a label.
    pub(crate) number: Option<u64>,
    /// Place of the label `N10:`.
    label: Option<Span>,
    /// The whole block without blanks and comments at its ends.
    pub(crate) span: Span,
    /// Whether there may be a comment in it: not every character has been checked.
    pub(super) remarks: bool,
    /// The `(` of a remark after words that is not closed: it extends to the end, which is worth a note.
    pub(crate) open_remark: Option<Span>,
}

/// A word of a plain block.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlainWord {
    /// Letter in upper case.
    pub(crate) letter: u8,
    /// Number of characters between the letter and its value.
    gap: u8,
    /// What follows it.
    pub(crate) value: PlainValue,
    /// Place, value included.
    pub(crate) span: Span,
}

/// Value of a word.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum PlainValue {
    /// Number of a G, M or H function; `u32::MAX` if it does not fit.
    Code(u32),
    /// A number with its sign.
    Number(f64),
    /// A sum in brackets, possibly with a sign.
    Sum(Box<Expr>),
}

/// Reads a line as a plain block and passes its words on one by one. `None` if the line requires the grammar or `take`
/// stops the reading; the words passed on until then are void.
#[inline]
pub(super) fn read(bytes: &[u8], mut take: impl FnMut(PlainWord) -> bool) -> Option<PlainFrame> {
    let mut at = before_words(bytes, 0);
    let begin = at;
    let mut frame = PlainFrame { remarks: at > 1, ..PlainFrame::default() };
    let mut end = at;
    if bytes.get(at) == Some(&b'/') {
        let level;
        (level, end) = skip_level(bytes, at + 1)?;
        frame.skip = Some(level);
        at = before_words(bytes, end);
        frame.remarks |= at > end + 1;
    }
    let before_number = at;
    if matches!(bytes.get(at), Some(b'N' | b'n')) {
        let value;
        (value, at) = integer(bytes, at + 1)?;
        frame.number = Some(value);
        match bytes.get(at) {
            Some(b':') => {
                at += 1;
                frame.label = Some(Span::new(before_number, at));
            }
            // a value that only the grammar can read
            Some(b'.') => return None,
            _ => {}
        }
        end = at;
    }
    let mut empty = true;
    at = before_words(bytes, at);
    frame.remarks |= at > end + 1;
    while let Some(letter) = bytes.get(at).filter(|b| **b != b';') {
        let (start, letter) = (at, letter.to_ascii_uppercase());
        let (value, gap);
        (value, gap, end) = match short_number(bytes, start, letter) {
            Some((number, end)) => (PlainValue::Number(number), 0, end),
            None => word(bytes, start, letter)?,
        };
        at = blanks(bytes, end);
        if bytes.get(at) == Some(&b'(') {
            frame.open_remark = Some(Span::new(at, at + 1));
            at = bytes.len();
        }
        followed_by_word(bytes, at)?;
        frame.remarks |= at > end + 1 || gap > 1 || matches!(value, PlainValue::Sum(_));
        if !take(PlainWord { letter, gap, value, span: Span::new(start, end) }) {
            return None;
        }
        empty = false;
    }
    frame.remarks |= at < bytes.len() || frame.open_remark.is_some();
    // a remark alone has no span
    if frame.number.is_some() || frame.skip.is_some() || !empty {
        frame.span = Span::new(begin, end);
    }
    Some(frame)
}

impl Plain {
    /// Reads a line into this block; `None` if it requires the grammar.
    pub(super) fn recognize(&mut self, bytes: &[u8]) -> Option<()> {
        let Self { frame, words } = self;
        words.clear();
        let push = |word| {
            words.push(word);
            true
        };
        *frame = read(bytes, push)?;
        Some(())
    }

    /// The same tree as by the grammar.
    pub(crate) fn tree(&self) -> Block {
        let words: Vec<Word> = self.words.iter().map(PlainWord::tree).collect();
        let PlainFrame { skip, number, label, span, .. } = self.frame;
        let kind = number.map(LabelKind::Number);
        Block {
            skip,
            number: number.map(BlockNumber::Literal),
            label: label.zip(kind).map(|(span, kind)| Label { kind, span }),
            body: if words.is_empty() { Body::Empty } else { Body::Words(words) },
            span,
        }
    }
}

impl PlainWord {
    fn tree(&self) -> Word {
        let Self { letter, gap, ref value, span } = *self;
        let address = |sign, value| WordKind::Address { name: Name::Letter(letter), sign, value };
        let kind = match value {
            PlainValue::Code(number) if letter == b'G' => {
                WordKind::G { number: *number, value: None }
            }
            PlainValue::Code(number) if letter == b'H' => {
                WordKind::H(CodeNumber::Literal(*number), None)
            }
            PlainValue::Code(number) => WordKind::M(CodeNumber::Literal(*number), None),
            PlainValue::Number(x) => {
                let before = 1 + u32::from(gap);
                let behind = Span { start: span.start + before, len: span.len - before };
                // a number without a sign is not negative, and neither is 0
                let sign = x.is_sign_negative().then_some(Sign::Minus);
                address(sign, Expr { kind: ExprKind::Number(*x), span: behind })
            }
            PlainValue::Sum(sum) => {
                let sign = matches!(sum.kind, ExprKind::Negate(_)).then_some(Sign::Minus);
                address(sign, Expr::clone(sum))
            }
        };
        Word { kind, span }
    }
}

/// Whether a number follows this letter.
const fn takes_number(letter: u8) -> bool {
    matches!(letter, b'A'..=b'F' | b'I'..=b'K' | b'Q'..=b'U' | b'W'..=b'Z')
}

/// Value and end of the word at `start` if it is a letter and a short number, as most words of a long program; else see
/// [`word`].
#[inline]
fn short_number(bytes: &[u8], start: usize, letter: u8) -> Option<(f64, usize)> {
    if !takes_number(letter) {
        return None;
    }
    let negative = bytes.get(start + 1) == Some(&b'-');
    let at = start + 1 + usize::from(negative);
    let (value, length) = decimal_in_word(word_at(bytes, at)?)?;
    Some((if negative { -value } else { value }, at + length))
}

/// Value of the word at `start`, the number of characters between it and the letter, and its end.
fn word(bytes: &[u8], start: usize, letter: u8) -> Option<(PlainValue, u8, usize)> {
    let at = start + 1;
    match letter {
        b'G' | b'H' | b'M' => {
            let (value, end) = integer(bytes, at)?;
            Some((PlainValue::Code(u32::try_from(value).unwrap_or(u32::MAX)), 0, end))
        }
        letter if takes_number(letter) => {
            let first = match bytes.get(at) {
                Some(b' ' | b'\t' | b'=' | b'(') => behind_equals(bytes, at),
                _ => at,
            };
            let (value, end) = value(bytes, first)?;
            Some((value, u8::try_from(first - at).ok()?, end))
        }
        _ => None,
    }
}

/// Position after blanks and at most one `=`.
fn behind_equals(bytes: &[u8], at: usize) -> usize {
    match blanks(bytes, at) {
        at if bytes.get(at) == Some(&b'=') => blanks(bytes, at + 1),
        at => at,
    }
}

/// Value and end of the number or bracket at `start`.
fn value(bytes: &[u8], start: usize) -> Option<(PlainValue, usize)> {
    let negative = bytes.get(start) == Some(&b'-');
    let at = start + usize::from(negative);
    if bytes.get(at) == Some(&b'[') {
        let sum = sum::bracket(bytes, at)?;
        let end = sum.span.end() as usize;
        let value = if negative { negated(sum, start)? } else { PlainValue::Sum(Box::new(sum)) };
        return Some((value, end));
    }
    let (value, length) = short_decimal(bytes, at)?;
    Some((PlainValue::Number(if negative { -value } else { value }), at + length))
}

/// A bracket with a minus sign at `start`; `None` for a negative number in it, which the grammar reads.
fn negated(sum: Expr, start: usize) -> Option<PlainValue> {
    match sum.kind {
        ExprKind::Number(x) => (!x.is_sign_negative()).then_some(PlainValue::Number(-x)),
        kind => {
            let span = Span::new(start, sum.span.end() as usize);
            let inner = Expr { kind, span: sum.span };
            Some(PlainValue::Sum(Box::new(Expr { kind: ExprKind::Negate(Box::new(inner)), span })))
        }
    }
}

/// Level of the skip mark whose digits begin at `at`, and its end; `None` if there is no such level.
fn skip_level(bytes: &[u8], at: usize) -> Option<(u8, usize)> {
    if !bytes.get(at).is_some_and(u8::is_ascii_digit) {
        return Some((1, at));
    }
    let (level, end) = integer(bytes, at)?;
    let level = u8::try_from(level).ok().filter(|level| (1..=10).contains(level))?;
    Some((level, end))
}

/// `Some` at the end, or before a letter that may begin a new word; the next step checks whether it does. After a G
/// function a value may follow, after an operand an operator. A letter begins a new word unless it begins a parameter,
/// variable or function.
fn followed_by_word(bytes: &[u8], at: usize) -> Option<()> {
    match bytes.get(at) {
        None | Some(b';') => Some(()),
        Some(byte) if byte.is_ascii_alphabetic() => {
            // two letters in a row: an operator (`MOD`), a function or a name
            (!bytes.get(at + 1)?.is_ascii_alphabetic()).then_some(())
        }
        Some(_) => None,
    }
}
