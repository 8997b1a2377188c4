//! Values that options of several commands share.

use kontur_interpreter::machine::Override;
use std::str::FromStr;

/// One or more numbers: `4`, `1,2,5`, `1..6`, `2..200:2`, and any of these separated by commas.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers(pub Vec<f64>);

/// A request for more curves than this counts as a typing mistake.
const MOST_CURVES: usize = 1000;

impl FromStr for Numbers {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::parse(text, MOST_CURVES)
    }
}

impl Numbers {
    /// Parses at most `most` numbers.
    pub(super) fn parse(text: &str, most: usize) -> Result<Self, String> {
        let wrong = || format!("`{text}`: 4 or 1,2,5 or 1..6 or 2..200:2 expected");
        let too_many = || format!("`{text}`: more than {most} values");
        let number = |text: &str| match text.trim().parse::<f64>() {
            Ok(v) if v.is_finite() => Ok(v),
            _ => Err(wrong()),
        };
        let mut numbers = Vec::new();
        for part in text.split(',') {
            let Some((first, rest)) = part.split_once("..") else {
                numbers.push(number(part)?);
                continue;
            };
            let (last, step) = rest.split_once(':').unwrap_or((rest, "1"));
            let (first, last, step) = (number(first)?, number(last)?, number(step)?);
            if step <= 0.0 {
                return Err(format!("`{part}`: the step after `:` must be above 0"));
            }
            if last < first {
                return Err(format!("`{part}`: the first value must not be above the last one"));
            }
            if (last - first) / step >= most as f64 {
                return Err(too_many());
            }
            let steps = (last - first) / step + 1e-9;
            let indices = (0..=most).map(|i| i as f64).take_while(|i| *i <= steps);
            numbers.extend(indices.map(|i| first + i * step));
        }
        if numbers.len() > most {
            return Err(too_many());
        }
        Ok(Self(numbers))
    }
}

/// A parser for whole numbers from `least` to `most`.
pub(super) fn whole<T: TryFrom<u64>>(
    least: u64,
    most: u64,
) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync {
    move |text| {
        let number = text.trim().parse().ok().filter(|n| (least..=most).contains(n));
        number.and_then(|n| T::try_from(n).ok()).ok_or_else(|| match most {
            u64::MAX if !is_too_large(text.trim()) => {
                format!("a whole number from {least} is expected")
            }
            _ => format!("a whole number from {least} to {most} is expected"),
        })
    }
}

/// A whole number beyond the largest one.
fn is_too_large(text: &str) -> bool {
    text.bytes().all(|b| b.is_ascii_digit()) && text.parse::<u64>().is_err()
}

pub(super) fn above_zero(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(v) if v.is_finite() && v > 0.0 => Ok(v),
        _ => Err("a number above 0 is expected".to_owned()),
    }
}

/// `F1000` or `1000`: mm/min, above 0.
///
/// # Errors
/// Any other text.
pub(crate) fn feed(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_start_matches(['F', 'f']);
    match number.parse::<f64>() {
        Ok(v) if v.is_finite() && v > 0.0 => Ok(v),
        _ => Err("a feed in mm/min above 0 is expected, e.g. F1000".to_owned()),
    }
}

/// Two increasing numbers from 0 on: `50..56`.
///
/// # Errors
/// Any other text.
pub(crate) fn span(text: &str) -> Result<(f64, f64), String> {
    let parsed = text.split_once("..").and_then(|(low, high)| {
        Some((low.trim().parse::<f64>().ok()?, high.trim().parse::<f64>().ok()?))
    });
    match parsed {
        Some((low, high)) if low >= 0.0 && high > low && high.is_finite() => Ok((low, high)),
        _ => Err(format!("`{text}`: two numbers in ascending order are expected, e.g. 50..56")),
    }
}

/// Checks the form only; the machine checks what the words refer to.
pub(crate) fn setting(text: &str) -> Result<String, String> {
    match Override::parse(text) {
        Ok(_) => Ok(text.to_owned()),
        Err(d) => Err(d.hint.unwrap_or(d.text)),
    }
}

/// The name of an external variable after its `V.E.`, in any case; `None` if the text does not begin with that.
pub(crate) fn after_external(text: &str) -> Option<&str> {
    const FRONT: &str = "V.E.";
    let (front, name) = text.split_at_checked(FRONT.len())?;
    front.eq_ignore_ascii_case(FRONT).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_ranges() {
        let numbers = |text: &str| text.parse::<Numbers>().map(|n| n.0);
        assert_eq!(numbers("4").unwrap(), [4.0]);
        assert_eq!(numbers("1,2, 5").unwrap(), [1.0, 2.0, 5.0]);
        assert_eq!(numbers("1..3,10..20:5").unwrap(), [1.0, 2.0, 3.0, 10.0, 15.0, 20.0]);
        assert_eq!(numbers("0.1..0.3:0.1").unwrap().len(), 3);
        for wrong in ["", "a", "1..", "3..1", "1..2:0", "1..2:-1", "1..1e9", "nan", "1,"] {
            assert!(numbers(wrong).is_err(), "{wrong}");
        }
    }
}
