//! Where the grammar failed, and what it expected there.

use super::around::{in_cycle_call, token};
use super::context::{Context, starts_with};
use super::expected::{BRACKET, VALUE, WORD, expected};
use super::refine::refine;
use super::{Problem, hints};
use crate::diag::Condition;
use crate::syntax::END_OF_DECLARATIONS;
use crate::syntax::ast::{Function, Span};
use crate::syntax::grammar::Rule;
use crate::syntax::scan;
use pest::error::{Error, ErrorVariant, InputLocation};

/// A list in place of a value in the brackets of a command, such as `[1,2] + 3`.
pub(in crate::syntax) fn list_among_values(masked: &str, span: Span) -> Problem {
    let text = "a list in brackets does not have a value";
    let before = masked.get(..span.start as usize).unwrap_or_default();
    if Context::of(masked) == Context::Command || in_cycle_call(before) {
        Problem::new(Condition::TokenUnknown, span, text)
    } else {
        Problem::syntax(span, text)
    }
}

/// A function of the control of which no page says what it returns; 22162 (diagnosis 1020648843) only names it.
pub(in crate::syntax) const FORMATTED_TEXT: &str = "FSTRING";

/// The position at which the grammar failed.
pub(in crate::syntax) fn place_of(error: &Error<Rule>) -> usize {
    match error.location {
        InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
    }
}

/// The problem found by the grammar in `masked`, of which `offset` bytes were left out at the beginning.
pub(in crate::syntax) fn from_error(
    error: &Error<Rule>,
    masked: &str,
    context: Context,
    offset: usize,
) -> Problem {
    let at = offset + place_of(error);
    let mut at = at + masked[at..].bytes().take_while(|b| matches!(b, b' ' | b'\t')).count();
    if at == masked.len() {
        at = masked.trim_ascii_end().len().max(offset);
    }
    let expected = match &error.variant {
        ErrorVariant::ParsingError { positives, .. } => expected(positives),
        ErrorVariant::CustomError { .. } => Vec::new(),
    };
    let unclosed = masked[offset..].find(scan::UNCLOSED).map(|quote| offset + quote);
    if let Some(quote) = unclosed.filter(|quote| *quote <= at) {
        let problem = Problem::syntax(Span::new(quote, quote + 1), "string without closing `\"`");
        return refine(problem, &masked[offset..quote], "\"", context, masked, &expected)
            .hint("close the text with \"");
    }
    let rest = masked[at..].trim_ascii_end();
    if expected.contains(&VALUE) && starts_with(rest, FORMATTED_TEXT) {
        let text = format!("{FORMATTED_TEXT} is not supported");
        let end = rest.find(']').map_or(FORMATTED_TEXT.len(), |bracket| bracket + 1);
        let span = Span::new(at, at + end);
        return Problem::new(Condition::Unsupported, span, text);
    }
    let mut text = if rest.is_empty() {
        "the block ends too early".to_owned()
    } else {
        format!("unexpected `{}`", &rest[..token(rest)])
    };
    if !expected.is_empty() {
        text.push_str(", expected ");
        text.push_str(&expected.join(" or "));
    }
    let problem = Problem::syntax(Span::new(at, at + token(rest)), text);
    let before = &masked[offset..at];
    if let Some(condition) = misplaced(before, rest, &expected) {
        return Problem { condition, ..problem };
    }
    let problem = match no_word(before, &expected) {
        Some((length, text)) if context == Context::Words => {
            let start = offset + before.trim_ascii_end().len() - length;
            let span = Span::new(start, start + length);
            among_words(
                Problem::syntax(span, text),
                before,
                &masked[offset..start],
                &masked[start..],
            )
        }
        _ => refine(problem, before, rest, context, masked, &expected),
    };
    hints::completed(problem, context, masked, before, rest, &expected)
}

/// Letters that do not begin a word, after `read`: a second block number, or a remark; `from`: the text from them on.
fn among_words(problem: Problem, before: &str, read: &str, from: &str) -> Problem {
    if is_numbered(before) && is_numbered(from) {
        return problem.of(if read.split_whitespace().nth(1).is_some() {
            Condition::BlockNumberBehindWords
        } else {
            Condition::BlockNumberTwice
        });
    }
    let length = problem.span.len as usize;
    if from.bytes().take(length).all(|b| b.is_ascii_alphabetic()) {
        return problem.hint("remarks begin with ; or are written in ( )");
    }
    problem
}

/// A problem between `#VAR` and `#ENDVAR`.
pub(in crate::syntax) fn of_declaration(found: Problem, masked: &str) -> Problem {
    match masked.trim_ascii_start().as_bytes().first() {
        Some(b'R' | b'r') => found.of(Condition::RadiusArray),
        Some(b'V' | b'v' | b'P' | b'p' | b'@') => found.of(Condition::DeclarationCharacter),
        _ => found.of(Condition::DeclarationCharacter).hint(END_OF_DECLARATIONS),
    }
}

/// The vendor's number for faults common to all kinds of blocks.
fn misplaced(before: &str, rest: &str, expected: &[&str]) -> Option<Condition> {
    let written = before.trim_ascii_end();
    let ends_in = |word: &str| {
        let at = written.len().checked_sub(word.len());
        at.and_then(|at| written.get(at..)).is_some_and(|end| end.eq_ignore_ascii_case(word))
    };
    if ends_in("$GOTO") && !rest.is_empty() {
        return Some(Condition::GotoTarget);
    }
    if expected.contains(&VALUE) && is_function(rest) {
        return Some(Condition::FunctionBracket);
    }
    if let (Some(head), true) = (written.strip_suffix('['), expected.contains(&VALUE)) {
        return name_expected(head);
    }
    None
}

/// The vendor's number for a function that takes a name but got another argument; `head`: the text up to its bracket.
fn name_expected(head: &str) -> Option<Condition> {
    let head = head.trim_ascii_end().to_ascii_uppercase();
    [
        ("MACRO_CONTENT", Condition::MacroContentArgument),
        ("MACRO_LENGTH", Condition::MacroLengthArgument),
        ("SIZEOF", Condition::SizeOfArgument),
    ]
    .into_iter()
    .find_map(|(name, condition)| head.ends_with(name).then_some(condition))
}

/// Whether the text begins with a block number.
fn is_numbered(text: &str) -> bool {
    let first = text.trim_ascii_start().trim_start_matches(['/', ' ']);
    let number = first.strip_prefix(['N', 'n']).unwrap_or("");
    number.starts_with(|c: char| c.is_ascii_digit())
}

/// Whether the text is the name of a function without its bracket.
fn is_function(rest: &str) -> bool {
    let name = rest.bytes().take_while(|b| b.is_ascii_alphabetic() || *b == b'_').count();
    let behind = rest[name..].trim_start_matches([' ', '\t']);
    // ATAN2 is the only name with a digit
    let behind = if rest[..name].eq_ignore_ascii_case("ATAN") {
        behind.strip_prefix('2').unwrap_or(behind)
    } else {
        behind
    };
    !behind.starts_with('[') && Function::from_name(&rest[..name]).is_some()
}

/// Length and message for letters that do not begin a word: the grammar could only have continued with a bracket, or
/// took several letters for the name of an axis.
fn no_word(before: &str, expected: &[&str]) -> Option<(usize, String)> {
    let before = before.trim_ascii_end();
    let length = before.bytes().rev().take_while(u8::is_ascii_alphanumeric).count();
    let word = &before[before.len() - length..];
    let upper = word.to_ascii_uppercase();
    let operator = matches!(upper.as_str(), "AND" | "OR" | "XOR" | "MOD");
    let name = length > 1 && !operator && word.bytes().all(|b| b.is_ascii_alphabetic());
    // G1, G[..], GP1
    let bare_g = upper == "G" && expected == [WORD];
    if expected != [BRACKET] && !(expected == [VALUE] && name) && !bare_g {
        return None;
    }
    let text = match upper.as_bytes() {
        [] => return None,
        [b'G' | b'M' | b'H'] => format!("`{word}` not followed by a number"),
        [b'G' | b'M' | b'H', b'0'..=b'9', ..] => {
            format!("`{word}` is followed by an invalid word")
        }
        [b'L'] | [b'L', b'L'] => format!("`{word}` without the name of a program"),
        [b'N'] | [b'N', b'0'..=b'9', ..] if before.len() == length => {
            format!("`{word}` is not a block number")
        }
        [b'N'] | [b'N', b'0'..=b'9', ..] => {
            format!("`{word}`: a block number must be first in its block")
        }
        _ => format!("`{word}` is not a word of an NC program"),
    };
    Some((length, text))
}
