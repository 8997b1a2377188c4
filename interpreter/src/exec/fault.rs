//! Conditions raised while a block is executed, with their position in the block.

use super::step::SourceRef;
use crate::diag::{Condition, Diagnostic, Severity};
use crate::syntax::ast::Span;

/// A diagnostic with a position that is relative to its block.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fault {
    pub(super) diagnostic: Diagnostic,
    pub(super) span: Span,
    /// Block of the span, if it is earlier than the current one.
    pub(super) origin: Option<SourceRef>,
}

/// Result of an operation that may fail with a fault.
pub(super) type Outcome<T> = Result<T, Box<Fault>>;

impl Fault {
    pub(super) fn of(diagnostic: Diagnostic, span: Span) -> Box<Self> {
        Box::new(Self { diagnostic, span, origin: None })
    }

    /// A condition of the text at `span`.
    pub(super) fn new(condition: Condition, text: impl Into<String>, span: Span) -> Box<Self> {
        Self::of(Diagnostic::new(condition, text), span)
    }

    /// A valid word that the tool does not execute.
    pub(super) fn unsupported(what: impl std::fmt::Display, span: Span) -> Box<Self> {
        Self::new(Condition::Unsupported, format!("{what} is not supported"), span)
    }

    /// Modifies the diagnostic.
    pub(super) fn with(mut self: Box<Self>, f: impl FnOnce(Diagnostic) -> Diagnostic) -> Box<Self> {
        self.diagnostic = f(self.diagnostic);
        self
    }

    /// Assigns the span to this block, unless another one was named.
    pub(super) fn in_block(mut self: Box<Self>, source: SourceRef) -> Box<Self> {
        self.origin = self.origin.or(Some(source));
        self
    }

    /// Lowers the severity to a warning.
    pub(super) fn warning(self: Box<Self>) -> Box<Self> {
        self.with(|d| d.severity(Severity::Warning))
    }

    pub(super) fn hint(self: Box<Self>, hint: impl Into<String>) -> Box<Self> {
        self.with(|d| d.hint(hint))
    }

    pub(super) fn is_error(&self) -> bool {
        self.diagnostic.is_error()
    }
}
