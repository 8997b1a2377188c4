//! Sums in brackets: numbers, P parameters, `+ - * /`, nested brackets.

use super::scan::{blanks, integer};
use crate::syntax::ast::{
    Binary, BinaryOp, Expr, ExprKind, ParameterIndex, Place, PlaceKind, Span,
};
use crate::syntax::number::short_decimal;

/// Maximum nesting, and maximum number of operators per bracket; other sums are left to the grammar.
const DEPTH_MAX: usize = 4;
const OPERATORS_MAX: usize = 32;

/// The expression of the bracket at `at`, its span including the bracket; `None` if it requires the grammar.
pub(super) fn bracket(bytes: &[u8], at: usize) -> Option<Expr> {
    Sum { bytes, at, depth: 0, operators: 0 }.bracket()
}

/// Reads one bracket from left to right.
struct Sum<'a> {
    bytes: &'a [u8],
    at: usize,
    depth: usize,
    operators: usize,
}

impl Sum<'_> {
    fn next(&mut self) -> Option<u8> {
        self.at = blanks(self.bytes, self.at);
        self.bytes.get(self.at).copied()
    }

    fn bracket(&mut self) -> Option<Expr> {
        let start = self.at;
        self.depth += 1;
        if self.depth > DEPTH_MAX {
            return None;
        }
        self.at += 1;
        let inner = self.sum()?;
        if self.next()? != b']' {
            return None;
        }
        self.at += 1;
        self.depth -= 1;
        Some(Expr { span: Span::new(start, self.at), ..inner })
    }

    fn sum(&mut self) -> Option<Expr> {
        let mut left = self.product()?;
        loop {
            let op = match self.next()? {
                b'+' => BinaryOp::Add,
                b'-' => BinaryOp::Subtract,
                _ => return Some(left),
            };
            self.at += 1;
            let right = self.product()?;
            left = self.joined(op, left, right)?;
        }
    }

    fn product(&mut self) -> Option<Expr> {
        let mut left = self.value()?;
        loop {
            let op = match self.next()? {
                b'*' if self.bytes.get(self.at + 1) != Some(&b'*') => BinaryOp::Multiply,
                b'/' => BinaryOp::Divide,
                _ => return Some(left),
            };
            self.at += 1;
            let right = self.value()?;
            left = self.joined(op, left, right)?;
        }
    }

    fn joined(&mut self, op: BinaryOp, left: Expr, right: Expr) -> Option<Expr> {
        self.operators += 1;
        let span = left.span.to(right.span);
        let kind = ExprKind::Binary(Box::new(Binary { op, left, right }));
        (self.operators <= OPERATORS_MAX).then_some(Expr { kind, span })
    }

    fn value(&mut self) -> Option<Expr> {
        let first = self.next()?;
        let start = self.at;
        let kind = match first {
            b'[' => return self.bracket(),
            b'P' | b'p' => {
                let (index, end) = integer(self.bytes, start + 1)?;
                self.at = end;
                // an array, or a name with the same beginning
                if matches!(self.bytes.get(end), Some(b'[' | b'_' | b'a'..=b'z' | b'A'..=b'Z')) {
                    return None;
                }
                let index = ParameterIndex::Literal(u32::try_from(index).unwrap_or(u32::MAX));
                let (indirections, subscripts) = (0, Vec::new());
                let kind = PlaceKind::Parameter { indirections, index, subscripts };
                ExprKind::Place(Box::new(Place { kind, span: Span::new(start, end) }))
            }
            _ => {
                let negative = first == b'-';
                self.at += usize::from(negative);
                let (x, length) = short_decimal(self.bytes, self.at)?;
                self.at += length;
                ExprKind::Number(if negative { -x } else { x })
            }
        };
        Some(Expr { kind, span: Span::new(start, self.at) })
    }
}
