//! Functions of the expression language. Angles are in degrees.
//!
//! Source: TF5200 programming manual, arithmetic functions. Assumption: `INT` truncates towards 0, `ROUND` rounds half
//! away from 0, positions in texts count from 1, `FIND` returns 0 if the text is not found.

use super::number::{as_number, bits, finite, is_true, whole};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::angle::{cos_deg, sin_deg, tan_deg, to_deg};
use crate::exec::options::Value;
use crate::syntax::ast::{Expr, ExprKind, Function, FunctionCall, Place, Span};
use crate::syntax::macros;

/// Least and greatest number of arguments of a function.
fn arity(function: Function) -> (usize, usize) {
    match function {
        Function::Atan2
        | Function::Min
        | Function::Max
        | Function::Left
        | Function::Right
        | Function::Find => (2, 2),
        Function::Mid | Function::Delete | Function::Insert => (3, 3),
        Function::Replace => (4, 4),
        Function::SizeOf | Function::Ord => (1, 2),
        _ => (1, 1),
    }
}

/// 21459.
fn argument_type(function: Function, expected: &str, span: Span) -> Box<Fault> {
    let text = format!("{} takes {expected}", function.name());
    Fault::new(Condition::ArgumentType, text, span)
}

/// Value of a call.
pub(in crate::exec) fn call(decoder: &Decoder, call: &FunctionCall, span: Span) -> Outcome<Value> {
    let (low, high) = arity(call.function);
    let n = call.arguments.len();
    if n < low || n > high {
        let name = call.function.name();
        let text = format!("{name} takes {low} argument(s), found {n}");
        let condition = if n < low { Condition::TooFewArguments } else { Condition::Syntax };
        return Err(Fault::new(condition, text, span)
            .hint(format!("kontur explain {name} shows its arguments")));
    }
    let arg = |i: usize| {
        let argument = &call.arguments[i];
        match decoder.value(argument)? {
            Value::Number(x) => Ok(x),
            Value::Text(_) => Err(argument_type(call.function, "a number", argument.span)),
        }
    };
    let place = || {
        if let ExprKind::Place(place) = &call.arguments[0].kind {
            return Ok(&**place);
        }
        let condition = match call.function {
            Function::Exist => Condition::ExistArgument,
            _ => Condition::SizeOfArgument,
        };
        Err(Fault::new(condition, "a variable is expected", call.arguments[0].span))
    };
    let number = match call.function {
        Function::Exist => {
            let argument = &call.arguments[0];
            // the functions of the list (206761227)
            if matches!(argument.kind, ExprKind::MFunction(_) | ExprKind::HFunction(_)) {
                return decoder.value(argument);
            }
            return Ok(Value::truth(decoder.exists(place()?)?));
        }
        Function::SizeOf => return size_of(decoder, place()?, call.arguments.get(1)),
        Function::IsString | Function::IsNumber => {
            let text = matches!(decoder.value(&call.arguments[0])?, Value::Text(_));
            return Ok(Value::truth(text == (call.function == Function::IsString)));
        }
        Function::Atan2 => to_deg(libm::atan2(arg(0)?, arg(1)?)),
        Function::Min => arg(0)?.min(arg(1)?),
        Function::Max => arg(0)?.max(arg(1)?),
        Function::Inv => f64::from(inverted(arg(0)?, call.arguments[0].span)?),
        Function::MacroLength | Function::MacroContent => return of_macro(decoder, call),
        f if is_text_function(f) => return text_function(decoder, call, span),
        f => of_one(f, arg(0)?, call.arguments[0].span)?,
    };
    finite(number, span).map(Value::Number)
}

/// Inverts the bits within 16 bits if the number fits, otherwise within 32.
fn inverted(x: f64, span: Span) -> Outcome<u32> {
    let pattern = bits(x, span)?;
    Ok(if pattern <= 0xFFFF { pattern ^ 0xFFFF } else { !pattern })
}

fn pole(span: Span) -> Box<Fault> {
    Fault::new(Condition::DivisionByZero, "division by zero", span)
}

/// Functions of one number.
fn of_one(function: Function, x: f64, span: Span) -> Outcome<f64> {
    Ok(match function {
        Function::Abs => x.abs(),
        Function::Sqr => x * x,
        Function::Sqrt if x < 0.0 => {
            return Err(Fault::new(
                Condition::Sqrt,
                format!("square root of the negative number {x}"),
                span,
            ));
        }
        Function::Sqrt => x.sqrt(),
        Function::Exp => libm::exp(x),
        Function::DecExp => libm::pow(10.0, x),
        Function::Ln | Function::Log if x <= 0.0 => {
            return Err(Fault::new(Condition::Logarithm, format!("logarithm of {x}"), span)
                .with(|d| d.value(ValueKind::Wrong, x, "-")));
        }
        Function::Ln => libm::log(x),
        Function::Log => libm::log10(x),
        Function::Sin => sin_deg(x),
        Function::Cos => cos_deg(x),
        Function::Tan => tan_deg(x).ok_or_else(|| pole(span))?,
        Function::Cot => {
            let s = sin_deg(x);
            if s == 0.0 {
                return Err(pole(span));
            }
            cos_deg(x) / s
        }
        Function::Asin | Function::Acos if x.abs() > 1.0 => {
            let text = format!("{} of {x} does not exist", function.name());
            return Err(Fault::new(Condition::ArcFunctionRange, text, span)
                .with(|d| d.value(ValueKind::Wrong, x, "-")));
        }
        Function::Asin if (x.abs() - 0.5).abs() == 0.0 => 30.0_f64.copysign(x),
        Function::Asin => to_deg(libm::asin(x)),
        Function::Acos if (x.abs() - 0.5).abs() == 0.0 => {
            if x > 0.0 {
                60.0
            } else {
                120.0
            }
        }
        Function::Acos => to_deg(libm::acos(x)),
        Function::Atan => to_deg(libm::atan(x)),
        Function::Acot => 90.0 - to_deg(libm::atan(x)),
        Function::Int => x.trunc(),
        Function::Fract => x.fract(),
        Function::Round => x.round(),
        Function::Floor => x.floor(),
        Function::Ceil => x.ceil(),
        Function::Sign if x == 0.0 => 0.0,
        Function::Sign => x.signum(),
        Function::Not => f64::from(u8::from(!is_true(x))),
        _ => return Err(Fault::unsupported(function.name(), span)),
    })
}

/// `MACRO_CONTENT["NAME"]`, `MACRO_LENGTH["NAME"]`: the text of a macro with its own macros replaced, and the number of
/// its characters.
///
/// Source: TF5200 diagnosis 1097005579, 1152060811, 1147344395. Assumption: the length is that of the expanded text;
/// the documents do not specify it. An unknown macro has no length: K-UNDEFINED.
fn of_macro(decoder: &Decoder, call: &FunctionCall) -> Outcome<Value> {
    let argument = &call.arguments[0];
    let wants_length = call.function == Function::MacroLength;
    let ExprKind::Text(name) = &argument.kind else {
        let condition = if wants_length {
            Condition::MacroLengthArgument
        } else {
            Condition::MacroContentArgument
        };
        let text = format!("{} needs the name of a macro in quotes", call.function.name());
        return Err(Fault::new(condition, text, argument.span));
    };
    let table = &decoder.calls.macros;
    let lookup = |name: &str| table.get(name).map(|text| &**text);
    let name = name.trim_ascii();
    let resolved = lookup(name).and_then(|text| macros::resolved(text, &lookup));
    match resolved {
        Some(text) if wants_length => Ok(Value::Number(text.chars().count() as f64)),
        Some(text) => Ok(Value::Text(text.into())),
        None => {
            let known = table.contains_key(name);
            let why = if known { "cannot be resolved" } else { "is not defined" };
            let condition = if wants_length && !known {
                Condition::Undefined
            } else {
                Condition::MacroContentFailed
            };
            Err(Fault::new(condition, format!("the macro \"{name}\" {why}"), argument.span))
        }
    }
}

/// Size of a dimension of an array; if none is given, that of the first one, or -1 for a scalar.
fn size_of(decoder: &Decoder, place: &Place, dimension: Option<&Expr>) -> Outcome<Value> {
    let sizes = decoder.dimensions(place)?;
    let Some(dimension) = dimension else {
        return Ok(Value::Number(sizes.first().map_or(-1.0, |n| *n as f64)));
    };
    let x = decoder.number(dimension)?;
    let index = whole(x, 1, u32::MAX).and_then(|i| sizes.get(i as usize - 1));
    index.map(|n| Value::Number(*n as f64)).ok_or_else(|| {
        let text = format!("{place} has {} dimension(s), not {x}", sizes.len());
        Fault::new(Condition::NoSuchDimension, text, dimension.span)
            .with(|d| d.value(ValueKind::Current, x, "-"))
    })
}

fn is_text_function(function: Function) -> bool {
    use Function as F;
    matches!(
        function,
        F::Left
            | F::Mid
            | F::Right
            | F::Len
            | F::Ord
            | F::Find
            | F::Delete
            | F::Insert
            | F::Replace
            | F::IntToStr
            | F::RealToStr
            | F::StrToInt
            | F::StrToReal
    )
}

/// Largest number of characters as an argument. Assumption: the vendor prints no limit for 21472; this is the length of
/// a block.
const COUNT_MAX: u32 = 4096;

/// Largest result of `STR_TO_INT`. Assumption: the vendor prints no limit for 21465; this is that of the widest integer
/// type, UNS32.
const INTEGER_MAX: f64 = u32::MAX as f64;

/// A function of texts with its arguments.
struct TextCall<'a> {
    decoder: &'a Decoder,
    call: &'a FunctionCall,
}

impl TextCall<'_> {
    fn text(&self, i: usize) -> Outcome<Vec<char>> {
        let argument = &self.call.arguments[i];
        match self.decoder.value(argument)? {
            Value::Text(text) => Ok(text.chars().collect()),
            Value::Number(_) => Err(argument_type(self.call.function, "a text", argument.span)),
        }
    }

    fn count(&self, i: usize) -> Outcome<usize> {
        let x = self.decoder.number(&self.call.arguments[i])?;
        whole(x, 0, COUNT_MAX).map(|n| n as usize).ok_or_else(|| {
            let text = format!("a character count is {x}, allowed: 0 to {COUNT_MAX}");
            Fault::new(Condition::TextCount, text, self.call.arguments[i].span)
        })
    }

    /// Position at which a text is split, counted from 0. Assumption: 21545 has limits, but the documents print no
    /// numbers for them; MID, DELETE and REPLACE begin at one of the characters, INSERT may also insert before the first
    /// one.
    fn position(&self, i: usize, least: usize, s: &[char]) -> Outcome<usize> {
        let (x, most) = (self.decoder.number(&self.call.arguments[i])?, s.len());
        let at = whole(x, 0, u32::MAX).map(|at| at as usize);
        at.filter(|at| (least..=most).contains(at)).map(|at| at - least).ok_or_else(|| {
            let name = self.call.function.name();
            let text =
                format!("{name}: the text has {most} characters, position {x} does not exist");
            Fault::new(Condition::TextPosition, text, self.call.arguments[i].span).with(|d| {
                d.value(ValueKind::Wrong, x, "-")
                    .value(ValueKind::LowerLimit, least as f64, "-")
                    .value(ValueKind::UpperLimit, most as f64, "-")
            })
        })
    }

    /// Start and end, counted from 0, of the part that begins at the position in argument `at` and has at most the
    /// number of characters in argument `count`.
    fn part(&self, at: usize, count: usize, s: &[char]) -> Outcome<(usize, usize)> {
        let from = self.position(at, 1, s)?;
        Ok((from, (from + self.count(count)?).min(s.len())))
    }

    /// The number that the text of the first argument contains.
    fn parsed(&self, largest: f64) -> Outcome<f64> {
        let written: String = self.text(0)?.iter().collect();
        let span = self.call.arguments[0].span;
        // `inf` and `NaN` are not digits
        let digits = written.bytes().any(|b| b.is_ascii_digit());
        let number: Option<f64> = written.trim().parse().ok();
        let number = number.filter(|_| digits).ok_or_else(|| {
            let text = format!("`{written}` is not a number");
            Fault::new(Condition::DigitExpected, text, span)
        })?;
        if number.abs() > largest {
            let text = format!("`{written}` has too many digits: it is above {largest:e}");
            return Err(Fault::new(Condition::DigitsTooMany, text, span));
        }
        Ok(number)
    }
}

/// `ORD`: the code of a character, of the first one if no position is given.
fn code(arguments: &TextCall<'_>, span: Span) -> Outcome<f64> {
    let s = arguments.text(0)?;
    let at = arguments.call.arguments.get(1).map_or(Ok(1), |_| arguments.count(1))?;
    let character = at.checked_sub(1).and_then(|i| s.get(i)).ok_or_else(|| {
        let text = format!("ORD: the text has {} characters, none at {at}", s.len());
        Fault::new(Condition::Range, text, span)
    })?;
    Ok(f64::from(u32::from(*character)))
}

/// Functions of texts (206023179): `LEFT[s, n]`, `MID[s, n, position]`, `DELETE[s, n, position]`, `INSERT[s, t, position]`,
/// `REPLACE[s, t, n, position]`.
fn text_function(decoder: &Decoder, call: &FunctionCall, span: Span) -> Outcome<Value> {
    let arguments = TextCall { decoder, call };
    let joined =
        |parts: [&[char]; 3]| Value::Text(parts.concat().iter().collect::<String>().into());
    Ok(match call.function {
        Function::Len => Value::Number(arguments.text(0)?.len() as f64),
        Function::Ord => Value::Number(code(&arguments, span)?),
        Function::Left => {
            let s = arguments.text(0)?;
            joined([&s[..arguments.count(1)?.min(s.len())], &[], &[]])
        }
        Function::Right => {
            let s = arguments.text(0)?;
            joined([&s[s.len() - arguments.count(1)?.min(s.len())..], &[], &[]])
        }
        Function::Mid => {
            let s = arguments.text(0)?;
            let (from, to) = arguments.part(2, 1, &s)?;
            joined([&s[from..to], &[], &[]])
        }
        Function::Delete => {
            let s = arguments.text(0)?;
            let (from, to) = arguments.part(2, 1, &s)?;
            joined([&s[..from], &s[to..], &[]])
        }
        Function::Insert => {
            let (s, t) = (arguments.text(0)?, arguments.text(1)?);
            let at = arguments.position(2, 0, &s)?;
            joined([&s[..at], &t, &s[at..]])
        }
        Function::Replace => {
            let (s, t) = (arguments.text(0)?, arguments.text(1)?);
            let (from, to) = arguments.part(3, 2, &s)?;
            joined([&s[..from], &t, &s[to..]])
        }
        Function::Find => {
            let (s, t) = (arguments.text(0)?, arguments.text(1)?);
            let found = if t.is_empty() { None } else { s.windows(t.len()).position(|w| w == t) };
            Value::Number(found.map_or(0.0, |i| i as f64 + 1.0))
        }
        Function::IntToStr => {
            Value::Text(format!("{}", decoder.number(&call.arguments[0])?.trunc() + 0.0).into())
        }
        Function::RealToStr => {
            let x = as_number(&decoder.value(&call.arguments[0])?, span)?;
            Value::Text(format!("{x:.6}").into())
        }
        Function::StrToInt => Value::Number(arguments.parsed(INTEGER_MAX)?.trunc()),
        Function::StrToReal => Value::Number(arguments.parsed(f64::MAX)?),
        other => return Err(Fault::unsupported(other.name(), span)),
    })
}
