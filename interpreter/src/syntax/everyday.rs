//! Common typing mistakes: one message at the wrong character, with the correct form.
//!
//! The search covers blocks that did not parse; a few mistakes give a valid block with another meaning.

use super::ast::Span;
use super::foreign::words;
use super::problem::{Problem, statement};
use crate::diag::Condition;
use std::ops::Range;

/// A mistake, and the part of its block that is read all the same.
pub(super) struct Found {
    pub(super) problem: Problem,
    rest: Rest,
}

/// The part of a block that can still be read.
enum Rest {
    /// The text before this byte.
    UpTo(usize),
    /// The whole text, with one character read as another.
    ReadAs(usize, &'static str),
    /// The text without this range.
    Without(Range<usize>),
}

impl Found {
    /// The part of a block that is read; of the same length.
    pub(super) fn rest(&self, masked: &str) -> String {
        let blanks = |range: &Range<usize>| {
            [&masked[..range.start], &" ".repeat(range.len()), &masked[range.end..]].concat()
        };
        match &self.rest {
            Rest::UpTo(end) => blanks(&(*end..masked.len())),
            Rest::ReadAs(at, other) => [&masked[..*at], other, &masked[at + 1..]].concat(),
            Rest::Without(range) => blanks(range),
        }
    }
}

/// The mistake in a block of words that did not parse. `code`: the block with blanks in place of comments and texts;
/// `error`: the place at which the grammar failed; `brace`: the first invalid character, if it is a brace.
pub(super) fn recognise(code: &str, error: usize, brace: Option<Span>) -> Option<Found> {
    without_dollar(code)
        .or_else(|| hidden(code))
        .or_else(|| remark(code, brace))
        .or_else(|| decimal_comma(code))
        .or_else(|| letter_in_number(code, error))
}

/// Mistakes in a block that parses, because its words have another meaning.
pub(super) fn hidden(code: &str) -> Option<Found> {
    label(code).or_else(|| letter_before_word(code)).or_else(|| value_of_statement(code))
}

/// `CASE 2`, `WHILE 1`: a word of an axis or a spindle with this name, as it is written.
fn value_of_statement(code: &str) -> Option<Found> {
    let (at, word) = first_word(code)?;
    code[at + word.len()..].starts_with([' ', '\t']).then(|| without_dollar(code))?
}

/// `FOR P1=1,3,1`, `IF P1==1`, `GOTO N10`.
fn without_dollar(code: &str) -> Option<Found> {
    let (at, word) = first_word(code)?;
    let statement = statement(&word.to_ascii_uppercase())?;
    // `$IF`, and the names in `DO X`, are preceded by other characters
    let is_first = code[..at].trim_ascii_end().bytes().next_back() != Some(b'$');
    let problem = Problem::syntax(Span::new(at, at + word.len()), format!("`{word}` without `$`"))
        .hint(format!("write ${statement}"));
    is_first.then_some(Found { problem, rest: Rest::UpTo(at) })
}

/// `START: X1`: a name with a colon.
fn label(code: &str) -> Option<Found> {
    let (at, word) = first_word(code)?;
    let end = at + word.len();
    let behind = code[end..].strip_prefix(':')?;
    let is_name = word.starts_with(|c: char| c.is_ascii_alphabetic())
        && word[1..].contains(|c: char| !c.is_ascii_digit());
    let is_label = is_name && (behind.is_empty() || behind.starts_with([' ', '\t']));
    let problem = Problem::syntax(Span::new(at, end + 1), format!("`{word}:` is not a label"))
        .hint(format!("write [{word}] and jump with $GOTO [{word}]; numbered labels are N10:"));
    is_label.then_some(Found { problem, rest: Rest::Without(at..end + 1) })
}

/// `// text`, `! text`, `{text}`, `' text`.
fn remark(code: &str, brace: Option<Span>) -> Option<Found> {
    let at = outside_brackets(code)
        .find(|(at, byte)| match byte {
            b'/' => code[*at..].starts_with("//"),
            b'!' => !code[at + 1..].starts_with('='),
            b'\'' => code[..*at].is_empty() || code[..*at].ends_with([' ', '\t']),
            _ => false,
        })
        .map(|(at, _)| at);
    let at = match (at, brace) {
        (Some(at), Some(brace)) => at.min(brace.start as usize),
        (at, brace) => at.or(brace.map(|span| span.start as usize))?,
    };
    let (length, shown) = match code.as_bytes()[at] {
        b'/' => (2, "//"),
        b'!' => (1, "!"),
        b'\'' => (1, "'"),
        _ => (1, "{"),
    };
    let text = format!("`{shown}` does not begin a remark");
    let problem = Problem::syntax(Span::new(at, at + length), text)
        .hint("begin remarks with ; or write them in ( )");
    Some(Found { problem, rest: Rest::UpTo(at) })
}

/// `X10,5`.
fn decimal_comma(code: &str) -> Option<Found> {
    let (at, _) = outside_brackets(code).find(|(at, byte)| {
        let digit = |c: char| c.is_ascii_digit();
        *byte == b',' && code[..*at].ends_with(digit) && code[at + 1..].starts_with(digit)
    })?;
    let is_part = |c: char| c.is_ascii_digit() || c == '.';
    let behind = code[at + 1..].trim_start_matches(is_part);
    // the rest of a list whose opening bracket is missing
    if behind.trim_ascii_start().starts_with(']') {
        return None;
    }
    let start = code[..at].trim_end_matches(is_part).len();
    let end = code.len() - behind.len();
    let problem = Problem::syntax(Span::new(at, at + 1), "a number with a decimal comma")
        .hint(format!("write {}.{}", &code[start..at], &code[at + 1..end]));
    Some(Found { problem, rest: Rest::ReadAs(at, ".") })
}

/// `X1O`, `GO1`, `X1l`: a letter in place of a digit in the word at which the grammar failed.
fn letter_in_number(code: &str, error: usize) -> Option<Found> {
    let (start, word) =
        words(code).take_while(|(start, _)| *start < error).last().filter(|(start, word)| {
            code.get(start + word.len()..error).is_none_or(|gap| gap.trim_ascii().is_empty())
        })?;
    let number = word.get(1..)?;
    let addressed = word.starts_with(|c: char| c.is_ascii_alphabetic())
        && number.bytes().all(|b| b.is_ascii_digit() || matches!(b, b'.' | b'O' | b'o' | b'l'))
        && number.contains(|c: char| c.is_ascii_digit());
    let at = start + 1 + number.find(['O', 'o', 'l'])?;
    addressed.then(|| figure(code, at))
}

/// `G0l X1`: the call of a subroutine with this name is hardly intended.
fn letter_before_word(code: &str) -> Option<Found> {
    let (start, word) = words(code).find(|(start, word)| {
        let number = word.get(1..).and_then(|number| number.strip_suffix('l'));
        let is_number = number.is_some_and(|number| {
            !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit() || b == b'.')
        });
        let mut behind = code[start + word.len()..].trim_start_matches([' ', '\t']).chars();
        let begins_word = behind.next().is_none_or(|c| c.is_ascii_alphabetic())
            && behind.next().is_none_or(|c| c.is_ascii_digit() || "+-.=".contains(c));
        is_number && begins_word
    })?;
    Some(figure(code, start + word.len() - 1))
}

/// The letter at `at` in place of a digit.
fn figure(code: &str, at: usize) -> Found {
    let letter = &code[at..=at];
    let (figure, condition) = match letter {
        "l" => ("1", Condition::Syntax),
        _ => ("0", Condition::ONotImplemented),
    };
    let text = format!("the letter {letter} in a number");
    let problem = Problem::new(condition, Span::new(at, at + 1), text)
        .hint(format!("write the digit {figure}"));
    Found { problem, rest: Rest::ReadAs(at, figure) }
}

/// Bytes outside square brackets, with their positions.
fn outside_brackets(code: &str) -> impl Iterator<Item = (usize, u8)> {
    let mut depth = 0_usize;
    code.bytes().enumerate().filter(move |(_, byte)| {
        match byte {
            b'[' => depth += 1,
            b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth == 0
    })
}

/// The first word after the block number.
fn first_word(code: &str) -> Option<(usize, &str)> {
    let number = |word: &str| {
        let digits = word.strip_prefix(['N', 'n']).unwrap_or_default();
        !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())
    };
    let (at, word) = words(code).find(|(_, word)| !number(word))?;
    let before = code[..at].trim_ascii();
    let is_first = before.is_empty() || number(before.trim_start_matches('/').trim_ascii_start());
    is_first.then_some((at, word))
}

#[cfg(test)]
mod tests {
    use super::{hidden, recognise};

    #[test]
    fn the_place_and_what_remains() {
        for (block, error, place, rest) in [
            ("X1O F1000", 4, 2, "X10 F1000"),
            ("GO1 X1", 4, 1, "G01 X1"),
            ("N5 X1.O Y2", 8, 6, "N5 X1.0 Y2"),
            ("X10,5 Y3", 3, 3, "X10.5 Y3"),
            ("G1 X10 // X5", 8, 7, "G1 X10      "),
            ("G1 X10 ! text", 7, 7, "G1 X10       "),
            ("N10 FOR P1=1,3,1", 3, 4, "N10             "),
            ("GOTO N10", 0, 0, "        "),
            ("START: X1", 5, 0, "       X1"),
        ] {
            let found = recognise(block, error, None).expect(block);
            assert_eq!((found.problem.span.start, &*found.rest(block)), (place, rest), "{block}");
        }
        for block in ["CASE 2", "N10 WHILE 1", "until 5"] {
            let found = hidden(block).expect(block);
            assert!(found.rest(block).trim_start_matches("N10").trim().is_empty(), "{block}");
        }
        let found = hidden("G0l X1 F100").expect("a figure");
        assert_eq!((found.problem.span.start, &*found.rest("G0l X1 F100")), (2, "G01 X1 F100"));
    }

    #[test]
    fn other_mistakes_are_not_taken_for_these() {
        for block in ["X1 Y", "P1=[1,2", "V.P.A'=", "OO X1", "N10: X1 Y"] {
            assert!(recognise(block, block.len(), None).is_none(), "{block}");
        }
        for block in
            ["x5l sub.nc", "g0 l x1", "N10: X1", "X1 L10", "[L1] X1", "LC:\\a.nc", "P1=V.P.a1l X5"]
        {
            assert!(hidden(block).is_none(), "{block}");
        }
    }
}
