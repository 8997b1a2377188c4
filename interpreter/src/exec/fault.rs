//! Conditions met while a block is executed, with their place in the block.

use super::step::SourceRef;
use crate::diag::{Diagnostic, Severity};
use crate::syntax::ast::Span;

/// A diagnostic whose place is known only within its block.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fault {
    pub(super) diagnostic: Diagnostic,
    pub(super) span: Span,
    /// Block of the span, if it is an earlier one than that in work.
    pub(super) origin: Option<SourceRef>,
}

/// Result of something that may end in a fault.
pub(super) type Outcome<T> = Result<T, Box<Fault>>;

impl Fault {
    pub(super) fn new(diagnostic: Diagnostic, span: Span) -> Box<Self> {
        Box::new(Self { diagnostic, span, origin: None })
    }

    /// A condition with a vendor number.
    pub(super) fn vendor(id: u32, text: impl Into<String>, span: Span) -> Box<Self> {
        Self::new(Diagnostic::vendor(id, text), span)
    }

    /// A condition with one of kontur's own numbers, see [`own`].
    pub(super) fn kontur(id: u16, text: impl Into<String>, span: Span) -> Box<Self> {
        Self::new(Diagnostic::kontur(id, text), span)
    }

    /// A legal word that the tool does not execute.
    pub(super) fn unsupported(what: impl std::fmt::Display, span: Span) -> Box<Self> {
        Self::kontur(own::UNSUPPORTED, format!("{what} is not supported"), span)
    }

    /// Changes the diagnostic.
    pub(super) fn with(mut self: Box<Self>, f: impl FnOnce(Diagnostic) -> Diagnostic) -> Box<Self> {
        self.diagnostic = f(self.diagnostic);
        self
    }

    /// The span belongs to this block, unless another one was named.
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

/// Numbers of kontur's own conditions that the executor raises.
pub(super) mod own {
    pub(in crate::exec) const SYNTAX: u16 = 2;
    pub(in crate::exec) const NO_END: u16 = 3;
    pub(in crate::exec) const PERCENT: u16 = 5;
    pub(in crate::exec) const NESTING: u16 = 6;
    pub(in crate::exec) const DUPLICATE_KEY: u16 = 7;
    pub(in crate::exec) const DUPLICATE_GROUP: u16 = 8;
    pub(in crate::exec) const RANGE: u16 = 9;
    pub(in crate::exec) const RADIUS_TOO_SMALL: u16 = 10;
    pub(in crate::exec) const SQRT: u16 = 11;
    pub(in crate::exec) const UNDEFINED: u16 = 12;
    pub(in crate::exec) const NO_FILE: u16 = 13;
    pub(in crate::exec) const NO_SUBROUTINE: u16 = 14;
    pub(in crate::exec) const LABEL: u16 = 15;
    pub(in crate::exec) const LABEL_INTO: u16 = 16;
    pub(in crate::exec) const ENDLESS: u16 = 17;
    pub(in crate::exec) const WAIT: u16 = 18;
    pub(in crate::exec) const UNSUPPORTED: u16 = 19;
    pub(in crate::exec) const FEEDFORWARD_LIMIT: u16 = 20;
    pub(in crate::exec) const FEEDFORWARD_NEGATIVE: u16 = 21;
    pub(in crate::exec) const FILTER_RANGE: u16 = 33;
    pub(in crate::exec) const GUARD_RANGE: u16 = 34;
    /// Word without effect on set positions: parsed and ignored.
    pub(in crate::exec) const IGNORED: u16 = 100;
    /// Word that another dialect gives another meaning.
    pub(in crate::exec) const DIALECT: u16 = 101;
    /// Axis exchange switched a program-activated Vibration Guard off.
    pub(in crate::exec) const GUARD_EXCHANGED: u16 = 102;
    /// Keys of `#VIB GUARD` stored while the guard is off.
    pub(in crate::exec) const GUARD_STORED: u16 = 103;
    /// List conflict: FIR filter and Vibration Guard in one axis.
    pub(in crate::exec) const LIST_FIR_AND_GUARD: u16 = 104;
    /// List conflict: `#FILTER` with a Vibration Guard activated by the list.
    pub(in crate::exec) const FILTER_WITH_LIST_GUARD: u16 = 105;
    /// List conflict: `#VIB GUARD` with a filter type in the list.
    pub(in crate::exec) const GUARD_WITH_LIST_FILTER: u16 = 106;
    /// `ACC_FACT` without P-AXIS-00013.
    pub(in crate::exec) const ACC_FACT_IGNORED: u16 = 107;
    /// Feedforward beside other commands of a spindle.
    pub(in crate::exec) const SPINDLE_FEEDFORWARD: u16 = 108;
    /// Something legal but unusual: a sub-word ignored or taken in one of several ways.
    pub(in crate::exec) const ODD: u16 = 109;
    /// External variable created by its first write.
    pub(in crate::exec) const EXTERNAL_CREATED: u16 = 110;
    /// Feature replaced by a simpler one.
    pub(in crate::exec) const FALLBACK: u16 = 111;
    /// Unequal kernels of the axes of the channel.
    pub(in crate::exec) const UNEQUAL_KERNELS: u16 = 112;
    /// Tool data missing.
    pub(in crate::exec) const NO_TOOL: u16 = 114;
    /// Tool radius compensation: the contour is too tight for the tool.
    pub(in crate::exec) const COMPENSATION: u16 = 115;
    /// Start, end and centre of an arc do not fit (G165).
    pub(in crate::exec) const ARC_CENTRE: u16 = 117;
    /// A compensated tool cuts its own contour at a bottleneck.
    pub(in crate::exec) const BOTTLENECK: u16 = 119;
    /// Spindle speed above the limit of the spindle.
    pub(in crate::exec) const SPINDLE_LIMIT: u16 = 131;
    /// Syntax error in a part of the program that does not run.
    pub(in crate::exec) const UNREACHED: u16 = 118;
    /// The program has more errors than are reported.
    pub(in crate::exec) const TOO_MANY: u16 = 116;
}
