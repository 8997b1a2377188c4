//! Kinds of keys, and their values as found in a bracket.

use crate::exec::options::Value;
use crate::syntax::ast::Span;

/// The kind of value after a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum KeyKind {
    /// A number.
    Number,
    /// A number, or nothing.
    MaybeNumber,
    /// An identifier or text.
    Word,
    /// A number or a text.
    Scalar,
    /// Nothing.
    Flag,
}

impl KeyKind {
    /// A number may follow.
    pub(super) fn takes_number(self) -> bool {
        matches!(self, Self::Number | Self::MaybeNumber | Self::Scalar)
    }
}

/// A kind of key with the type of its values.
pub(in crate::exec) trait Argument {
    /// Type passed to the command.
    type Value;
    /// The kind.
    const KIND: KeyKind;

    /// The value of a key in the bracket.
    fn take(found: &Found, name: &str) -> Option<Self::Value>;
}

/// A number with its position.
#[derive(Debug)]
pub(in crate::exec) struct Number;
/// An optional number, with its position.
#[derive(Debug)]
pub(in crate::exec) struct MaybeNumber;
/// A word or text, with its position.
#[derive(Debug)]
pub(in crate::exec) struct Word;
/// A number or a text, with its position.
#[derive(Debug)]
pub(in crate::exec) struct Scalar;
/// The position of a key without value.
#[derive(Debug)]
pub(in crate::exec) struct Flag;

impl Argument for Number {
    type Value = (f64, Span);
    const KIND: KeyKind = KeyKind::Number;

    fn take(found: &Found, name: &str) -> Option<(f64, Span)> {
        match found.get(name)? {
            (Written::Number(x), span) => Some((*x, *span)),
            (Written::Word(_) | Written::Nothing, _) => None,
        }
    }
}

impl Argument for MaybeNumber {
    type Value = (Option<f64>, Span);
    const KIND: KeyKind = KeyKind::MaybeNumber;

    fn take(found: &Found, name: &str) -> Option<(Option<f64>, Span)> {
        match found.get(name)? {
            (Written::Number(x), span) => Some((Some(*x), *span)),
            (Written::Word(_) | Written::Nothing, span) => Some((None, *span)),
        }
    }
}

impl Argument for Word {
    type Value = (Box<str>, Span);
    const KIND: KeyKind = KeyKind::Word;

    fn take(found: &Found, name: &str) -> Option<(Box<str>, Span)> {
        match found.get(name)? {
            (Written::Word(word), span) => Some((word.clone(), *span)),
            (Written::Number(_) | Written::Nothing, _) => None,
        }
    }
}

impl Argument for Scalar {
    type Value = (Value, Span);
    const KIND: KeyKind = KeyKind::Scalar;

    fn take(found: &Found, name: &str) -> Option<(Value, Span)> {
        match found.get(name)? {
            (Written::Number(x), span) => Some((Value::Number(*x), *span)),
            (Written::Word(text), span) => Some((Value::Text(text.clone()), *span)),
            (Written::Nothing, _) => None,
        }
    }
}

impl Argument for Flag {
    type Value = Span;
    const KIND: KeyKind = KeyKind::Flag;

    fn take(found: &Found, name: &str) -> Option<Span> {
        found.get(name).map(|(_, span)| *span)
    }
}

/// Value of a key.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Written {
    Number(f64),
    Word(Box<str>),
    Nothing,
}

/// The keys in the bracket.
#[derive(Debug, Default)]
pub(in crate::exec) struct Found {
    found: Vec<(&'static str, Written, Span)>,
}

impl Found {
    pub(super) fn push(&mut self, key: &'static str, written: Written, at: Span) {
        self.found.push((key, written, at));
    }

    /// Replaces the number of the key written there, if there is one.
    pub(super) fn correct(&mut self, at: Span, number: f64) {
        let written = self.found.iter_mut().find(|(.., span)| *span == at);
        if let Some((_, Written::Number(last), _)) = written {
            *last = number;
        }
    }

    pub(super) fn get(&self, name: &str) -> Option<(&Written, &Span)> {
        self.found.iter().find(|(n, _, _)| *n == name).map(|(_, written, span)| (written, span))
    }
}
