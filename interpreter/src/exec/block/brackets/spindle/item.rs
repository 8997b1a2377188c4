//! The items of a spindle bracket and their meanings.

use crate::diag::Condition;
use crate::exec::block::brackets::{function, value_of_function};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::motion::state::Function;
use crate::syntax::ast::{Item, ItemKind, ItemValue, Span};

/// Prefixes of further words of spindle brackets in the manual. Source: TF5200 programming manual, programming in
/// spindle-specific syntax.
const OTHER_WORDS: &[&str] = &[
    "CALLAX",
    "PUTAX",
    "SYNC",
    "LINK",
    "FEED_LINK",
    "TRANS",
    "MC_",
    "G112",
    "G131",
    "G132",
    "G133",
    "G134",
    "G230",
    "G231",
    "G233",
];

/// M functions of the control, which cannot be functions of an axis or spindle (21192). M0 and M1 can.
pub(in crate::exec::block::brackets) fn is_internal(word: &str) -> bool {
    let number = word.get(1..).and_then(|digits| digits.parse().ok());
    is_function(word, 'M') && matches!(number, Some(2..=5 | 17 | 19 | 29 | 30))
}

/// `G01`, `M30`: a letter and a number.
fn is_function(word: &str, letter: char) -> bool {
    let digits = word.strip_prefix([letter, letter.to_ascii_lowercase()]);
    digits.is_some_and(|d| !d.is_empty() && d.bytes().all(|b| b.is_ascii_digit()))
}

/// Meaning of one item of a spindle bracket.
pub(super) enum SpindleItem {
    /// M3, M4, M5, M19.
    Turn(u32),
    /// REV=, SPEED=.
    Speed(f64),
    /// POS=.
    Position(f64),
    /// G130=.
    Acceleration(f64),
    /// G135, G137.
    Feedforward(bool),
    /// G136=.
    Weight(f64),
    /// M or H function of the user, with its value.
    Function(Function, Option<f64>),
    /// G167.
    FullOverride,
    /// G74.
    Home,
}

impl SpindleItem {
    /// Meaning of an item of the bracket.
    pub(super) fn read(decoder: &Decoder, item: &Item) -> Outcome<Self> {
        let unknown = |shown: &str| {
            let text = format!("unknown word `{shown}` in a spindle bracket");
            Fault::new(Condition::SpindleToken, text, item.span)
        };
        if let Some((function, _)) = function(item) {
            return Ok(Self::Function(function, value_of_function(decoder, item)?));
        }
        let (word, value) = match &item.kind {
            ItemKind::Flag(word) => match word.split_number() {
                Some((name, number))
                    if ["REV", "SPEED", "POS"].iter().any(|n| name.eq_ignore_ascii_case(n)) =>
                {
                    (name.to_ascii_uppercase(), Some(number))
                }
                _ => (word.text.to_ascii_uppercase(), None),
            },
            ItemKind::Pair { key, value: ItemValue::Expr(expr) } => {
                (key.text.to_ascii_uppercase(), Some(decoder.number(expr)?))
            }
            ItemKind::Pair { key, .. } => return Err(unknown(&key.text)),
            ItemKind::Value(_) | ItemKind::Target { .. } | ItemKind::Missing => {
                return Err(unknown("value"));
            }
        };
        Ok(match (word.as_str(), value) {
            ("M3" | "M03", None) => Self::Turn(3),
            ("M4" | "M04", None) => Self::Turn(4),
            ("M5" | "M05", None) => Self::Turn(5),
            ("M19", None) => Self::Turn(19),
            ("REV" | "SPEED", Some(x)) => Self::Speed(x),
            ("POS", Some(x)) => Self::Position(x),
            ("G135", None) => Self::Feedforward(true),
            ("G137", None) => Self::Feedforward(false),
            ("G136", Some(x)) => Self::Weight(x),
            ("G130", Some(x)) => Self::Acceleration(x),
            // an external override has no effect on spindles
            ("G167", None) => Self::FullOverride,
            ("G74", None) => Self::Home,
            (other, _) if OTHER_WORDS.iter().any(|w| other.starts_with(w)) => {
                let name = format!("{other} in a spindle bracket");
                return Err(Fault::unsupported(name, item.span));
            }
            (other, _) if is_internal(other) => {
                let text = format!("{other} in a spindle bracket: it controls the program");
                return Err(Fault::new(Condition::InternalFunction, text, item.span));
            }
            (other, _) if is_function(other, 'G') => {
                let text = format!("{other} is not a spindle function");
                return Err(Fault::new(Condition::SpindleCommand, text, item.span));
            }
            (other, _) => return Err(unknown(other)),
        })
    }
}

/// `GET_DYNAMIC_DATA` (false) and `DEFAULT_DYNAMIC_DATA`.
pub(super) fn tool_limits(item: &Item) -> Option<(bool, Span)> {
    let ItemKind::Flag(word) = &item.kind else { return None };
    let default = word.is("DEFAULT_DYNAMIC_DATA");
    (default || word.is("GET_DYNAMIC_DATA")).then_some((default, item.span))
}
