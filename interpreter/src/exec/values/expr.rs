//! Values of expressions.
//!
//! Source: TF5200 programming manual, arithmetic expressions. Assumption: results that are not finite cause K-0009.

use super::functions;
use super::number::{as_number, bits, finite, is_true, whole};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::syntax::ast::{Binary, BinaryOp, Expr, ExprKind, Span};

impl Value {
    pub(in crate::exec) fn truth(value: bool) -> Self {
        Self::Number(if value { 1.0 } else { 0.0 })
    }
}

impl Decoder {
    /// Value of an expression.
    pub(in crate::exec) fn value(&self, expr: &Expr) -> Outcome<Value> {
        match &expr.kind {
            ExprKind::Number(x) => Ok(Value::Number(*x)),
            ExprKind::Bool(b) => Ok(Value::truth(*b)),
            ExprKind::Pi => Ok(Value::Number(std::f64::consts::PI)),
            ExprKind::Radius => self.modal.last_radius(expr.span).map(Value::Number),
            ExprKind::Text(text) => Ok(Value::Text(text.clone())),
            ExprKind::MFunction(number) => {
                Ok(Value::truth(self.machine.channel.functions.m_waits.contains_key(number)))
            }
            ExprKind::HFunction(number) => {
                Ok(Value::truth(self.machine.channel.functions.h_waits.contains_key(number)))
            }
            ExprKind::Place(place) => self.read(place),
            ExprKind::Negate(_) => negated(self, expr),
            ExprKind::Binary(binary) => chain(self, binary),
            ExprKind::Call(call) => functions::call(self, call, expr.span),
        }
    }

    /// Numeric value of an expression; 21461 for a text.
    pub(in crate::exec) fn number(&self, expr: &Expr) -> Outcome<f64> {
        match &expr.kind {
            ExprKind::Number(x) => Ok(*x),
            _ => as_number(&self.value(expr)?, expr.span),
        }
    }

    /// Truth value of an expression.
    pub(in crate::exec) fn condition(&self, expr: &Expr) -> Outcome<bool> {
        self.number(expr).map(is_true)
    }

    /// An integer within a range.
    pub(in crate::exec) fn whole(
        &self,
        expr: &Expr,
        what: &str,
        low: u32,
        high: u32,
    ) -> Outcome<u32> {
        let x = self.number(expr)?;
        whole(x, low, high).ok_or_else(|| {
            let text = format!("{what} is {x}, allowed: whole numbers {low} to {high}");
            Fault::new(Condition::Range, text, expr.span)
        })
    }
}

/// A run of minus signs, of any length.
fn negated(decoder: &Decoder, expr: &Expr) -> Outcome<Value> {
    let (mut negative, mut inner) = (false, expr);
    while let ExprKind::Negate(next) = &inner.kind {
        negative = !negative;
        inner = next;
    }
    let x = decoder.number(inner)?;
    Ok(Value::Number(if negative { -x } else { x }))
}

/// A chain of left-associative operators, without recursion along the chain.
fn chain(decoder: &Decoder, top: &Binary) -> Outcome<Value> {
    let mut spine = vec![top];
    let mut left = &top.left;
    while let ExprKind::Binary(binary) = &left.kind {
        spine.push(binary);
        left = &binary.left;
    }
    let mut value = decoder.value(left)?;
    let mut span = left.span;
    while let Some(binary) = spine.pop() {
        let right = decoder.value(&binary.right)?;
        let whole = span.to(binary.right.span);
        value = apply(binary.op, &value, span, &right, binary.right.span, whole)?;
        span = whole;
    }
    Ok(value)
}

fn apply(
    op: BinaryOp,
    left: &Value,
    left_span: Span,
    right: &Value,
    right_span: Span,
    span: Span,
) -> Outcome<Value> {
    if let (Value::Text(a), Value::Text(b)) = (left, right) {
        return texts(op, a, b, span);
    }
    if matches!((left, right), (Value::Text(_), _) | (_, Value::Text(_))) {
        let text = "text and number mixed in one operation";
        return Err(Fault::new(Condition::MixedTypes, text, span)
            .hint("use INT_TO_STR, REAL_TO_STR, STR_TO_INT or STR_TO_REAL to convert"));
    }
    let a = as_number(left, left_span)?;
    let b = as_number(right, right_span)?;
    let truth = |b| Ok(Value::truth(b));
    let result = match op {
        BinaryOp::Or => return truth(is_true(a) || is_true(b)),
        BinaryOp::Xor => return truth(is_true(a) != is_true(b)),
        BinaryOp::And => return truth(is_true(a) && is_true(b)),
        // the language compares exactly
        BinaryOp::Equal => return truth(a.partial_cmp(&b).is_some_and(std::cmp::Ordering::is_eq)),
        BinaryOp::NotEqual => {
            return truth(!a.partial_cmp(&b).is_some_and(std::cmp::Ordering::is_eq));
        }
        BinaryOp::Less => return truth(a < b),
        BinaryOp::LessEqual => return truth(a <= b),
        BinaryOp::Greater => return truth(a > b),
        BinaryOp::GreaterEqual => return truth(a >= b),
        BinaryOp::BitOr => f64::from(bits(a, left_span)? | bits(b, right_span)?),
        BinaryOp::BitXor => f64::from(bits(a, left_span)? ^ bits(b, right_span)?),
        BinaryOp::BitAnd => f64::from(bits(a, left_span)? & bits(b, right_span)?),
        BinaryOp::Add => a + b,
        BinaryOp::Subtract => a - b,
        BinaryOp::Multiply => a * b,
        BinaryOp::Divide | BinaryOp::Modulo if b == 0.0 => {
            let text = "division by zero";
            return Err(Fault::new(Condition::DivisionByZero, text, right_span)
                .with(|d| d.value(ValueKind::Current, b, "-")));
        }
        BinaryOp::Divide if (a / b).is_infinite() && a.is_finite() => {
            let text = format!("{a} / {b} is above the range of REAL64");
            return Err(Fault::new(Condition::QuotientTooLarge, text, span)
                .with(|d| d.value(ValueKind::Current, a, "-").value(ValueKind::Current, b, "-")));
        }
        BinaryOp::Divide => a / b,
        BinaryOp::Modulo => a % b,
        BinaryOp::Power => libm::pow(a, b),
    };
    finite(result, span).map(Value::Number)
}

fn texts(op: BinaryOp, a: &str, b: &str, span: Span) -> Outcome<Value> {
    /// Maximum length of a text built by an expression, so that a loop cannot exhaust memory.
    const LONGEST: usize = 4096;
    Ok(match op {
        BinaryOp::Add if a.len() + b.len() > LONGEST => {
            let text = format!("a text of more than {LONGEST} bytes");
            return Err(Fault::new(Condition::Range, text, span));
        }
        BinaryOp::Add => Value::Text(format!("{a}{b}").into()),
        BinaryOp::Equal => Value::truth(a == b),
        BinaryOp::NotEqual => Value::truth(a != b),
        BinaryOp::Less => Value::truth(a < b),
        BinaryOp::LessEqual => Value::truth(a <= b),
        BinaryOp::Greater => Value::truth(a > b),
        BinaryOp::GreaterEqual => Value::truth(a >= b),
        _ => {
            let text = "texts can only be joined and compared";
            return Err(Fault::new(Condition::TextOperator, text, span));
        }
    })
}
