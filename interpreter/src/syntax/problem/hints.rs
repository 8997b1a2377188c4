//! What to write instead, for blocks that the grammar refuses, judged by the text around the position of the error.

use super::Problem;
use super::around::{last_word, token};
use super::context::{Context, content};
use super::expected::VALUE;
use crate::diag::Condition;
use crate::syntax::scan;

/// Hint of K-0002 for words where nothing in particular is known about the mistake.
const WORDS: &str = "write words as an address and a value (G01 X10.5 F1000), remarks with ;";

/// The problem with a hint, unless it has one: for the text `rest` of a block, which cannot follow `before`. `masked` is the
/// whole block.
pub(super) fn completed(
    problem: Problem,
    context: Context,
    masked: &str,
    before: &str,
    rest: &str,
    expected: &[&str],
) -> Problem {
    if problem.hint.is_some() {
        return problem;
    }
    let hint = unbalanced(masked).or_else(|| match context {
        Context::Command => bare_key(content(masked)),
        Context::Words => in_words(before, rest, expected),
        Context::Control => None,
    });
    match hint {
        Some(hint) => problem.hint(hint),
        None if problem.condition == Condition::Syntax && context == Context::Words => {
            problem.hint(WORDS)
        }
        None => problem,
    }
}

/// The bracket of a block that is not closed or not opened, in words.
fn unbalanced(masked: &str) -> Option<String> {
    let code = scan::without_texts(masked);
    let mut open = Vec::new();
    for (at, bracket) in code.match_indices(['[', ']']) {
        if bracket == "[" {
            open.push(at);
        } else if open.pop().is_none() {
            return Some(format!("the ] of `{}` closes no bracket", word_at(&code, at)));
        }
    }
    open.last().map(|at| format!("close the bracket of `{}`", word_at(&code, *at)))
}

/// The word around a bracket. Its column would not do: the block may have several lines.
fn word_at(code: &str, at: usize) -> String {
    const LONGEST: usize = 24;
    let (before, after) = code.split_at(at);
    let before = before.rsplit(char::is_whitespace).next().unwrap_or_default();
    let before: Vec<char> = before.chars().rev().take(LONGEST).collect();
    let after = after.split(char::is_whitespace).next().unwrap_or_default();
    before.into_iter().rev().chain(after.chars().take(LONGEST)).collect()
}

/// `#SLOPE TYPE=TRAPEZ`: the key of a command without its bracket.
fn bare_key(content: &str) -> Option<String> {
    let (head, value) = content.split_once('=')?;
    let (name, key) = head.trim_ascii_end().rsplit_once([' ', '\t'])?;
    let value = &value.trim_ascii_start()[..token(value.trim_ascii_start())];
    let bare = !head.contains('[') && !value.is_empty() && key.bytes().all(is_name);
    bare.then(|| format!("keys are written in brackets: {} [{key}={value}]", name.trim_ascii_end()))
}

fn in_words(before: &str, rest: &str, expected: &[&str]) -> Option<String> {
    if rest.starts_with([')', '(']) {
        return Some("expressions are grouped by [ ]; a remark is written in ( )".to_owned());
    }
    let word = last_word(before);
    let is_number = word
        .strip_prefix(['N', 'n'])
        .is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit()));
    if is_number && rest.starts_with('.') {
        return Some(format!("block numbers are integers: {word}"));
    }
    let is_letter = matches!(word.as_bytes(), [letter] if letter.is_ascii_alphabetic());
    let wanted = is_letter && expected.first() == Some(&VALUE);
    wanted.then(|| format!("write the value of {word} next to it: {word}10.5"))
}

const fn is_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}
