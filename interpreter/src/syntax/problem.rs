//! Errors of the grammar in terms the user knows, with the vendor's number where there is one.

mod around;
mod context;
mod expected;
mod failure;
mod hints;
mod refine;
mod statements;

use super::ast::Span;
use crate::diag::{Condition, Diagnostic, Location, Severity};
pub(super) use context::Context;
pub(super) use failure::{FORMATTED_TEXT, from_error, list_among_values, of_declaration, place_of};
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
