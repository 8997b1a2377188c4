//! Values of list entries: numbers, words and flags, read by the data type of their row.
//!
//! Order of calls: the row of a key gives the data type for [`read`] and [`write()`].
//!
//! ```
//! use kontur_interpreter::machine::table::Raw;
//! use kontur_interpreter::machine::value::{Value, read, write};
//!
//! assert_eq!(read(Raw::Uns32, "5000"), Ok(Value::Number(5000.0)));
//! assert_eq!(write(Raw::Uns32, &Value::Number(5000.0)), "5000");
//! // a text that is not a number has a substitute
//! assert_eq!(read(Raw::Uns32, "fast").unwrap_err().instead, Some(Value::Number(0.0)));
//! ```

use super::table::Raw;

/// Value of a parameter in the units of the list.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Any number, flag set or named number.
    Number(f64),
    /// A text or word.
    Text(String),
}

impl Value {
    /// The number; `None` for a text.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(x) => Some(*x),
            Self::Text(_) => None,
        }
    }

    /// The text; `None` for a number.
    pub fn text(&self) -> Option<&str> {
        match self {
            Self::Number(_) => None,
            Self::Text(text) => Some(text),
        }
    }
}

/// A value that could not be read as written.
#[derive(Clone, Debug, PartialEq)]
pub struct BadValue {
    /// The value used instead: 0 if the text is not a number, the nearest limit of the data type, or the default
    /// (`None`) for an undefined word.
    pub instead: Option<Value>,
    /// Description of the error.
    pub reason: String,
}

/// Reads a value.
///
/// # Errors
/// [`BadValue`] (1001138) for text that is not a number, a number outside the data type, or an unknown name.
pub fn read(raw: Raw, text: &str) -> Result<Value, BadValue> {
    match raw {
        Raw::Text | Raw::Code => Ok(Value::Text(text.trim_end().to_owned())),
        Raw::Word(words) => match words.iter().find(|w| w.eq_ignore_ascii_case(text)) {
            Some(word) => Ok(Value::Text((*word).to_owned())),
            None => Err(BadValue {
                instead: None,
                reason: format!("`{text}` is not one of {}", words.join(", ")),
            }),
        },
        Raw::Names(names) => match named(names, text) {
            Some(number) => Ok(Value::Number(f64::from(number))),
            None => integer(raw, text, Some(names)),
        },
        Raw::Flags(names) => {
            let mut sum = 0;
            for part in text.split('|') {
                match named(names, part.trim()) {
                    Some(bits) => sum |= bits,
                    None => match integer(raw, part.trim(), Some(names))? {
                        // flags stay below 2^32, so the conversion is exact
                        Value::Number(x) => sum |= x as u32,
                        Value::Text(_) => {}
                    },
                }
            }
            Ok(Value::Number(f64::from(sum)))
        }
        Raw::Boolean if text.eq_ignore_ascii_case("TRUE") => Ok(Value::Number(1.0)),
        Raw::Boolean if text.eq_ignore_ascii_case("FALSE") => Ok(Value::Number(0.0)),
        Raw::Real64 => match number(text) {
            Some(x) => Ok(Value::Number(x)),
            None => Err(not_a_number(text, None)),
        },
        _ => integer(raw, text, None),
    }
}

fn named(names: &[(&str, u32)], text: &str) -> Option<u32> {
    names.iter().find(|(name, _)| name.eq_ignore_ascii_case(text)).map(|(_, number)| *number)
}

fn not_a_number(text: &str, names: Option<&[(&str, u32)]>) -> BadValue {
    let what = match names {
        Some(names) => {
            let names: Vec<&str> = names.iter().map(|(name, _)| *name).collect();
            format!("neither a number nor one of {}", names.join(", "))
        }
        None => "not a number".to_owned(),
    };
    BadValue { instead: Some(Value::Number(0.0)), reason: format!("`{text}` is {what}") }
}

/// A finite number, decimal with optional exponent.
fn number(text: &str) -> Option<f64> {
    let digits = text.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
    text.parse().ok().filter(|x: &f64| digits && x.is_finite())
}

/// An integer, decimal or `0x` hexadecimal; a fraction is truncated with a warning.
fn integer(raw: Raw, text: &str, names: Option<&[(&str, u32)]>) -> Result<Value, BadValue> {
    let hex = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"));
    let value = match hex {
        Some(digits) if digits.bytes().all(|b| b.is_ascii_hexdigit()) => {
            u64::from_str_radix(digits, 16).ok().map(|n| n as f64)
        }
        Some(_) => None,
        None => number(text),
    };
    let Some(value) = value else { return Err(not_a_number(text, names)) };
    let (low, high) = raw.limits().unwrap_or((f64::MIN, f64::MAX));
    let whole = value.trunc().clamp(low, high);
    if value > high || value < low {
        let reason = format!("{text} is outside {} ({low}..{high})", raw.name());
        return Err(BadValue { instead: Some(Value::Number(whole)), reason });
    }
    if value.fract().abs() > 0.0 {
        let reason = format!("{text} is not a whole number");
        return Err(BadValue { instead: Some(Value::Number(whole)), reason });
    }
    // -0.0 and 0.0 are the same integer
    Ok(Value::Number(whole + 0.0))
}

/// A value as written in a list; reading it again gives the same value.
pub fn write(raw: Raw, value: &Value) -> String {
    match (value, raw) {
        (Value::Number(x), Raw::Names(names) | Raw::Flags(names)) => {
            let name = names.iter().find(|(_, n)| f64::from(*n).total_cmp(x).is_eq());
            name.map_or_else(|| x.to_string(), |(name, _)| (*name).to_owned())
        }
        (Value::Number(x), _) => x.to_string(),
        (Value::Text(code), Raw::Code) => code.clone(),
        (Value::Text(text), _) => {
            let plain = !text.is_empty()
                && !text.contains(char::is_whitespace)
                && !["\"", "#", "(", "/*"].iter().any(|opener| text.starts_with(opener));
            if plain { text.clone() } else { format!("\"{text}\"") }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::table;

    fn num(raw: Raw, text: &str) -> f64 {
        read(raw, text).unwrap().number().unwrap()
    }

    fn instead(raw: Raw, text: &str) -> f64 {
        read(raw, text).unwrap_err().instead.unwrap().number().unwrap()
    }

    #[test]
    #[expect(clippy::float_cmp, reason = "list numbers are exact")]
    fn numbers_in_every_form_of_the_documents() {
        assert_eq!(num(Raw::Uns32, "200000"), 200000.0);
        assert_eq!(num(Raw::Uns16, "0x101"), 257.0);
        assert_eq!(num(Raw::Real64, "3.000000e+001"), 30.0);
        assert_eq!(num(Raw::Real64, "2.150000e+001"), 21.5);
        assert_eq!(num(Raw::Sgn32, "-100000000"), -100000000.0);
        assert_eq!(num(Raw::Uns32, "1000.0"), 1000.0);
        assert_eq!(num(Raw::Boolean, "TRUE"), 1.0);
        // not a number gives 0, outside the data type the nearest limit (1001138)
        assert_eq!(instead(Raw::Uns32, "abc"), 0.0);
        assert_eq!(instead(Raw::Real64, "inf"), 0.0);
        assert_eq!(instead(Raw::Real64, "nan"), 0.0);
        assert_eq!(instead(Raw::Uns16, "70000"), 65535.0);
        assert_eq!(instead(Raw::Uns32, "-1"), 0.0);
        assert_eq!(instead(Raw::Sgn16, "-40000"), -32768.0);
        assert_eq!(instead(Raw::Boolean, "2"), 1.0);
        assert_eq!(instead(Raw::Uns32, "12.7"), 12.0);
        assert_eq!(instead(Raw::Uns32, "0xZZ"), 0.0);
    }

    #[test]
    #[expect(clippy::float_cmp, reason = "list numbers are exact")]
    fn names_and_flags() {
        let kind = table::by_id("P-AXIS-00204").unwrap().raw;
        assert_eq!(num(kind, "bandstop"), 4.0);
        assert_eq!(num(kind, "12"), 12.0);
        assert_eq!(instead(kind, "BANDSTOPP"), 0.0);
        let flags = table::by_id("P-AXIS-00223").unwrap().raw;
        assert_eq!(num(flags, "VEL | ACC"), 3.0);
        assert_eq!(num(flags, "ADD_VEL|ADD_ACC"), f64::from(0x303));
        assert_eq!(num(flags, "0x101"), 257.0);
        assert_eq!(num(flags, "NONE"), 0.0);
        let word = table::by_id("P-AXIS-00554").unwrap().raw;
        assert_eq!(read(word, "error_lr").unwrap().text(), Some("ERROR_LR"));
        assert_eq!(read(word, "IGNORE").unwrap_err().instead, None);
    }
}
