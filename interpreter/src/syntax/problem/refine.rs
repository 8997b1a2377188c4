//! The vendor's number and a hint for a problem, by the kind of the block and the text around.

use super::Problem;
use super::around::{
    ends_in_negative_radius, ends_in_place, in_cycle_call, in_cycle_list, in_values, is_label,
    last_word,
};
use super::context::{Context, content, starts_with};
use super::expected::{COMMA, END, EQUALS, LEVEL, OPERATOR};
use super::statements::not_a_statement;
use crate::diag::Condition;
use crate::syntax::ast::Span;

/// Adds the vendor's number and a hint.
pub(super) fn refine(
    problem: Problem,
    before: &str,
    rest: &str,
    context: Context,
    masked: &str,
    expected: &[&str],
) -> Problem {
    let content = content(masked);
    match context {
        Context::Command => in_command(problem, before, rest, content),
        Context::Control if rest.starts_with('=') => problem.hint("`==` compares"),
        Context::Control => match behind_control(content, before, rest, expected) {
            Some(condition) => Problem { condition, ..problem },
            None if rest.starts_with('$') => not_a_statement(&problem, rest),
            None => problem,
        },
        Context::Words => among_words(problem, before, rest, expected),
    }
}

/// Brackets open at the end of a text.
fn depth(before: &str) -> usize {
    before.matches('[').count().saturating_sub(before.matches(']').count())
}

/// A problem of a `#` command.
fn in_command(problem: Problem, before: &str, rest: &str, content: &str) -> Problem {
    if depth(before) > 0 {
        let positions = asks_for_positions(content);
        let condition =
            if positions { Condition::PositionRequest } else { Condition::TokenUnknown };
        let problem = Problem { condition, ..problem };
        return if rest.is_empty() { problem.hint("the bracket is not closed") } else { problem };
    }
    if before.trim_end().ends_with(']') {
        return Problem { condition: Condition::WordsBehindCommand, ..problem };
    }
    problem
}

/// A problem of a block of words.
fn among_words(problem: Problem, before: &str, rest: &str, expected: &[&str]) -> Problem {
    let depth = depth(before);
    let raised = |problem: Problem, condition| Problem { condition, ..problem };
    if starts_with(rest, "$ELSE") {
        raised(problem, Condition::ElseNotAlone)
    } else if starts_with(rest, "$ENDFOR") {
        raised(problem, Condition::EndForNotAlone)
    } else if rest.starts_with('#') {
        raised(problem, Condition::CommandNotAlone).hint("a # command must be alone in its block")
    } else if rest.starts_with('$') {
        raised(problem, Condition::ControlNotAlone)
            .hint("a control statement must be first in its block")
    } else if rest.starts_with('\\') {
        problem.hint("`\\` continues a block only as the last character of its line")
    } else if expected.contains(&LEVEL) {
        problem.hint("M17 [MAIN [LABEL]], M17 [JUMPS=2 N100]: a label has separate brackets")
    } else if depth == 0 && is_label(rest) && !before.trim_ascii().is_empty() {
        raised(problem, Condition::LabelBehindWords)
    } else if depth == 1 && rest.starts_with(',') && in_values(before) {
        raised(problem, Condition::ArrayOutsideDeclaration)
    } else if depth > 0 && in_cycle_list(before) {
        raised(problem, Condition::CallCharacter)
    } else if depth > 0 && in_cycle_call(before) {
        let hint = if rest.is_empty() {
            "the bracket is not closed"
        } else {
            "L CYCLE [NAME=\"file\" @P1=.. @P2=..]: words and parameters of the cycle"
        };
        raised(problem, Condition::TokenUnknown).hint(hint)
    } else if rest.starts_with('=') && ends_in_negative_radius(before) {
        negative_radius(&problem, before)
    } else if expected.contains(&EQUALS) && ends_in_place(before) {
        without_value(&problem, before)
    } else {
        problem
    }
}

/// `#GET CMDPOS`, `#GET ACTPOS` and `#SET IPO SOLLPOS`, whose brackets have a separate number.
fn asks_for_positions(content: &str) -> bool {
    let names = [&["#GET", "CMDPOS"][..], &["#GET", "ACTPOS"], &["#SET", "IPO", "SOLLPOS"]];
    names.iter().any(|name| has_name(content, name))
}

/// Whether the block is the command with these words in its name.
fn has_name(content: &str, name: &[&str]) -> bool {
    let words = content.split('[').next().unwrap_or_default().split_ascii_whitespace();
    words.map(str::to_ascii_uppercase).eq(name.iter().copied())
}

/// The vendor's number for faults after a control statement.
fn behind_control(content: &str, before: &str, rest: &str, expected: &[&str]) -> Option<Condition> {
    if starts_with(content, "$FOR") {
        return match before.contains('=') {
            false if expected.contains(&EQUALS) => Some(Condition::ForWithoutEquals),
            // two commas separate three values
            true if before.matches(',').count() < 2 && expected.contains(&COMMA) => {
                Some(Condition::ForWithoutComma)
            }
            true if !rest.is_empty() && expected.contains(&END) => Some(Condition::ControlNotAlone),
            _ => None,
        };
    }
    // after a complete value, or after a statement without a value
    let complete = !rest.is_empty() && expected.iter().any(|e| [OPERATOR, END].contains(e));
    let of = |(word, _): &&(&str, Condition)| starts_with(content, word);
    TRAILING.iter().find(of).filter(|_| complete).map(|(_, condition)| *condition)
}

/// Numbers for words after each control statement.
const TRAILING: [(&str, Condition); 16] = [
    ("$IF", Condition::IfTrailing),
    ("$ELSEIF", Condition::ElseIfTrailing),
    ("$ELSE", Condition::ElseNotAlone),
    ("$ENDIF", Condition::EndIfNotAlone),
    ("$SWITCH", Condition::SwitchTrailing),
    ("$CASE", Condition::CaseTrailing),
    ("$DEFAULT", Condition::DefaultNotAlone),
    ("$ENDFOR", Condition::EndForNotAlone),
    ("$WHILE", Condition::WhileTrailing),
    ("$ENDWHILE", Condition::EndWhileNotAlone),
    ("$REPEAT", Condition::RepeatNotAlone),
    ("$UNTIL", Condition::UntilTrailing),
    ("$DO", Condition::DoNotAlone),
    ("$ENDDO", Condition::EndDoTrailing),
    ("$BREAK", Condition::BreakNotAlone),
    ("$CONTINUE", Condition::ContinueNotAlone),
];

/// 20187 for the radius at the end of `before`.
fn negative_radius(problem: &Problem, before: &str) -> Problem {
    let word = last_word(before);
    let start =
        problem.span.start as usize - (before.len() - before.trim_ascii_end().len()) - word.len();
    let text = format!("the radius only has the index 1, not {}", &word[1..]);
    Problem::new(Condition::RadiusIndexFormat, Span::new(start, start + word.len()), text)
}

/// 20194 for the parameter or variable at the end of `before`.
fn without_value(problem: &Problem, before: &str) -> Problem {
    let trimmed = before.trim_ascii_end();
    let word = last_word(before);
    let start = problem.span.start as usize - (before.len() - trimmed.len()) - word.len();
    let text = format!("`{word}` without `=` and a value");
    Problem::new(Condition::AssignmentExpected, Span::new(start, start + word.len()), text)
        .hint("P1=5 assigns a value: P is a parameter in this dialect, not an address")
}
