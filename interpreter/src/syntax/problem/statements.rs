//! Names of control statements, and what a misspelt one means.

use super::Problem;
use crate::suggest;
use crate::syntax::ast::Span;

/// Control statements.
const STATEMENTS: [&str; 19] = [
    "IF",
    "ELSEIF",
    "ELSE",
    "ENDIF",
    "SWITCH",
    "CASE",
    "DEFAULT",
    "ENDSWITCH",
    "FOR",
    "ENDFOR",
    "WHILE",
    "ENDWHILE",
    "DO",
    "ENDDO",
    "REPEAT",
    "UNTIL",
    "BREAK",
    "CONTINUE",
    "GOTO",
];

/// The control statement with this name, which is in upper case.
pub(in crate::syntax) fn statement(word: &str) -> Option<&'static str> {
    STATEMENTS.into_iter().find(|statement| *statement == word)
}

/// Control statements with a value.
const WITH_VALUE: [&str; 9] =
    ["ELSEIF", "IF", "SWITCH", "CASE", "FOR", "WHILE", "UNTIL", "ENDDO", "GOTO"];

/// The control statement that `word` (upper case) was meant to be: one followed by its value without a blank, or
/// misspelt.
pub(crate) fn statement_meant(word: &str) -> Option<&'static str> {
    suggest::nearest(word, STATEMENTS).or_else(|| without_blank(word))
}

/// The statement at the beginning of a word in upper case.
fn without_blank(word: &str) -> Option<&'static str> {
    WITH_VALUE.into_iter().find(|statement| word.starts_with(statement))
}

/// A word after `$` that is not a control statement: one followed by its value without a blank, a misspelt one, or any
/// other.
pub(super) fn not_a_statement(problem: &Problem, rest: &str) -> Problem {
    let apart = rest.len() - rest[1..].trim_ascii_start().len();
    let of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let length = rest[apart..].find(|c| !of_name(c)).unwrap_or(rest.len() - apart);
    let (start, word) = (problem.span.start as usize, &rest[apart..apart + length]);
    let (upper, span) = (word.to_ascii_uppercase(), Span::new(start, start + apart + length));
    let said = |text: String| Problem::new(problem.condition, span, text);
    if STATEMENTS.contains(&upper.as_str()) {
        return said(format!("blank between `$` and {upper}")).hint(format!("write ${upper}"));
    }
    let unknown = said(format!("`${word}` is not a control statement"));
    match (suggest::nearest(&upper, STATEMENTS), without_blank(&upper)) {
        (Some(near), None) => unknown.hint(format!("did you mean `${near}`?")),
        (_, Some(statement)) => said(format!("`${word}` without a blank after ${statement}"))
            .hint(format!("write ${statement} {}", &word[statement.len()..])),
        (None, None) => unknown.hint(format!("${} exist", STATEMENTS.join(" $"))),
    }
}
