//! Errors of the grammar in terms the user knows, with the vendor's number where there is one.

mod around;
mod expected;
mod hints;
mod statements;

use self::around::{
    ends_in_negative_radius, ends_in_place, in_cycle_call, in_cycle_list, in_values, is_label,
    last_word, token,
};
use self::expected::{BRACKET, COMMA, END, EQUALS, LEVEL, OPERATOR, VALUE, WORD, expected};
use super::ast::{Function, Span};
use super::grammar::{HASH_WORDS, Rule};
use super::scan;
use crate::diag::{Condition, Diagnostic, Location, Severity};
use pest::error::{Error, ErrorVariant, InputLocation};
use statements::not_a_statement;
pub(super) use statements::statement;
pub(crate) use statements::statement_meant;
use std::borrow::Cow;

/// A fault in a block, without its position in the program.
#[derive(Debug)]
pub(super) struct Problem {
    pub(super) condition: Condition,
    pub(super) span: Span,
    text: String,
    hint: Option<Cow<'static, str>>,
    severity: Option<Severity>,
}

impl Problem {
    pub(super) fn new(condition: Condition, span: Span, text: impl Into<String>) -> Self {
        Self { condition, span, text: text.into(), hint: None, severity: None }
    }

    /// K-0002.
    pub(super) fn syntax(span: Span, text: impl Into<String>) -> Self {
        Self::new(Condition::Syntax, span, text)
    }

    /// The same place with another condition and its hint.
    pub(super) fn of(self, condition: Condition) -> Self {
        Self { condition, hint: None, ..self }
    }

    pub(super) fn hint(mut self, hint: impl Into<Cow<'static, str>>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    pub(super) fn severity(mut self, severity: Severity) -> Self {
        self.severity = Some(severity);
        self
    }

    pub(super) fn diagnostic(self, location: Location) -> Diagnostic {
        let mut diagnostic = Diagnostic::new(self.condition, self.text).at(location);
        if let Some(severity) = self.severity {
            diagnostic = diagnostic.severity(severity);
        }
        match self.hint {
            Some(hint) => diagnostic.hint(hint),
            None => diagnostic,
        }
    }
}

/// K-0001.
pub(super) fn invalid(text: &str, span: Span) -> Problem {
    let shown = text.get(span.start as usize..span.end() as usize).unwrap_or("?");
    let shown: String = shown.chars().take(10).flat_map(char::escape_debug).collect();
    Problem::new(Condition::InvalidCharacter, span, format!("invalid character `{shown}`"))
        .hint("characters outside the dialect are only allowed in comments and strings")
}

/// 20386 for the bracket at `at`, 20927 if it is that of a parameter.
///
/// Assumption: the limit of both is the same, 20927 prints none.
pub(super) fn too_deep(text: &str, at: usize) -> Problem {
    let limit = super::NESTING_MAX;
    let span = Span::new(at, at + 1);
    let (condition, what) = if text[..at].trim_ascii_end().ends_with(['P', 'p']) {
        (Condition::ParameterNesting, "parameters")
    } else {
        (Condition::BracketNesting, "brackets")
    };
    Problem::new(condition, span, format!("{what} nested more than {limit} deep"))
}

/// A list in place of a value in the brackets of a command, such as `[1,2] + 3`.
pub(super) fn list_among_values(masked: &str, span: Span) -> Problem {
    let text = "a list in brackets does not have a value";
    let before = masked.get(..span.start as usize).unwrap_or_default();
    if Context::of(masked) == Context::Command || in_cycle_call(before) {
        Problem::new(Condition::TokenUnknown, span, text)
    } else {
        Problem::syntax(span, text)
    }
}

/// Kind of content of a block, judged by its first character.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Context {
    Words,
    Command,
    Control,
}

impl Context {
    pub(super) fn of(masked: &str) -> Self {
        let content = content(masked);
        if content.starts_with('$') && !starts_with(content, "$GOTO") {
            Self::Control
        } else if let Some(name) = content.strip_prefix('#') {
            let name = name.trim_start();
            let length = name.bytes().take_while(u8::is_ascii_alphanumeric).count();
            let among_words = HASH_WORDS.iter().any(|w| w.eq_ignore_ascii_case(&name[..length]));
            if among_words { Self::Words } else { Self::Command }
        } else {
            Self::Words
        }
    }
}

/// Block without skip mark, number and label.
fn content(masked: &str) -> &str {
    let mut rest = masked.trim_start();
    if let Some(behind) = rest.strip_prefix('/') {
        rest = behind.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start();
    }
    if let Some(behind) = rest.strip_prefix(['N', 'n']) {
        rest = behind.trim_start_matches(|c: char| c.is_ascii_digit());
        rest = rest.strip_prefix(':').unwrap_or(rest).trim_start();
    }
    rest
}

fn starts_with(text: &str, keyword: &str) -> bool {
    text.get(..keyword.len()).is_some_and(|head| head.eq_ignore_ascii_case(keyword))
        && !text[keyword.len()..].starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_')
}

/// A function of the control of which no page says what it returns; 22162 (diagnosis 1020648843) only names it.
pub(super) const FORMATTED_TEXT: &str = "FSTRING";

/// The position at which the grammar failed.
pub(super) fn place_of(error: &Error<Rule>) -> usize {
    match error.location {
        InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
    }
}

/// The problem found by the grammar in `masked`, of which `offset` bytes were left out at the beginning.
pub(super) fn from_error(
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
            let problem = Problem::syntax(Span::new(start, start + length), text);
            let second = is_numbered(before) && is_numbered(&masked[start..]);
            let condition = match second {
                true if masked[offset..start].split_whitespace().nth(1).is_some() => {
                    Condition::BlockNumberBehindWords
                }
                true => Condition::BlockNumberTwice,
                false => Condition::Syntax,
            };
            let problem = Problem { condition, ..problem };
            if condition == Condition::Syntax
                && masked[start..].bytes().take(length).all(|b| b.is_ascii_alphabetic())
            {
                problem.hint("remarks begin with ; or are written in ( )")
            } else {
                problem
            }
        }
        _ => refine(problem, before, rest, context, masked, &expected),
    };
    hints::completed(problem, context, masked, before, rest, &expected)
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
        [b'N'] | [b'N', b'0'..=b'9', ..] => {
            format!("`{word}`: a block number must be first in its block")
        }
        _ => format!("`{word}` is not a word of an NC program"),
    };
    Some((length, text))
}

/// Adds the vendor's number and a hint.
fn refine(
    problem: Problem,
    before: &str,
    rest: &str,
    context: Context,
    masked: &str,
    expected: &[&str],
) -> Problem {
    let content = content(masked);
    let raised = |problem: Problem, condition| Problem { condition, ..problem };
    let depth = before.matches('[').count().saturating_sub(before.matches(']').count());
    match context {
        Context::Command if depth > 0 => {
            let condition = if asks_for_positions(content) {
                Condition::PositionRequest
            } else {
                Condition::TokenUnknown
            };
            let problem = raised(problem, condition);
            if rest.is_empty() { problem.hint("the bracket is not closed") } else { problem }
        }
        Context::Command if before.trim_end().ends_with(']') => {
            raised(problem, Condition::WordsBehindCommand)
        }
        Context::Control if rest.starts_with('=') => problem.hint("`==` compares"),
        Context::Control => match behind_control(content, before, rest, expected) {
            Some(condition) => raised(problem, condition),
            None if rest.starts_with('$') => not_a_statement(&problem, rest),
            None => problem,
        },
        Context::Words if starts_with(rest, "$ELSE") => raised(problem, Condition::ElseNotAlone),
        Context::Words if starts_with(rest, "$ENDFOR") => {
            raised(problem, Condition::EndForNotAlone)
        }
        Context::Words if rest.starts_with('#') => raised(problem, Condition::CommandNotAlone)
            .hint("a # command must be alone in its block"),
        Context::Words if rest.starts_with('$') => raised(problem, Condition::ControlNotAlone)
            .hint("a control statement must be first in its block"),
        Context::Words if rest.starts_with('\\') => {
            problem.hint("`\\` continues a block only as the last character of its line")
        }
        Context::Words if expected.contains(&LEVEL) => {
            problem.hint("M17 [MAIN [LABEL]], M17 [JUMPS=2 N100]: a label has separate brackets")
        }
        Context::Words if depth == 0 && is_label(rest) && !before.trim_ascii().is_empty() => {
            raised(problem, Condition::LabelBehindWords)
        }
        Context::Words if depth == 1 && rest.starts_with(',') && in_values(before) => {
            raised(problem, Condition::ArrayOutsideDeclaration)
        }
        Context::Words if depth > 0 && in_cycle_list(before) => {
            raised(problem, Condition::CallCharacter)
        }
        Context::Words if depth > 0 && in_cycle_call(before) => {
            let hint = if rest.is_empty() {
                "the bracket is not closed"
            } else {
                "L CYCLE [NAME=\"file\" @P1=.. @P2=..]: words and parameters of the cycle"
            };
            raised(problem, Condition::TokenUnknown).hint(hint)
        }
        Context::Words if rest.starts_with('=') && ends_in_negative_radius(before) => {
            negative_radius(&problem, before)
        }
        Context::Words if expected.contains(&EQUALS) && ends_in_place(before) => {
            without_value(&problem, before)
        }
        _ => problem,
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
