//! Parameters that take several values, as `--vary` names them.

use super::values::{Numbers, setting};
use kontur_interpreter::machine::Override;
use kontur_interpreter::machine::table::{Bound, Raw};
use std::str::FromStr;

/// An integer parameter with fewer values than this selects a mode.
const MOST_CHOICES: f64 = 8.0;

/// Prefix of the key of a word in the program.
const PROGRAM: &str = "program";

/// One list parameter and its values: `X.getriebe[0].kv=2000..60000:1000`, `X.vorsteuer.vorsteuerung=NONE,VEL,VEL|ACC`; a word of the
/// program: `program.P1=1..5`, `program[12].FREQ=20,40`; or a name that others use: `F=20..60:10` with `X.vib_guard.freq={F}`.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    /// Key as for `--set`.
    pub key: String,
    /// Values as written in a list.
    pub values: Vec<String>,
}

/// A request for more combinations than this counts as a typing mistake.
pub(crate) const MOST_COMBINATIONS: usize = 100_000;

impl FromStr for Vary {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (key, list) = text
            .split_once('=')
            .ok_or("KEY=VALUES expected, e.g. X.getriebe[0].kv=1000..5000:500")?;
        let mut values = Vec::new();
        for part in list.split(',') {
            if part.contains("..") {
                let numbers = Numbers::parse(part, MOST_COMBINATIONS)?;
                values.extend(numbers.0.into_iter().map(plain));
            } else {
                values.push(part.trim().to_owned());
            }
        }
        let vary = Self { key: key.trim().to_owned(), values };
        for value in &vary.values {
            if vary.word().is_some() {
                let number = used_name(value).is_some() || value.parse::<f64>().is_ok();
                number
                    .then_some(())
                    .ok_or(format!("`{value}`: a number is expected for a word of the program"))?;
            } else if !vary.is_name() {
                setting(&format!("{}={value}", vary.key))?;
            }
        }
        Ok(vary)
    }
}

/// A number without the rounding errors of its steps: 0.3, not 0.30000000000000004.
fn plain(value: f64) -> String {
    let text = format!("{value:.9}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The name in `{NAME}`, if the value has this form.
pub(crate) fn used_name(value: &str) -> Option<&str> {
    value.strip_prefix('{')?.strip_suffix('}')
}

impl Vary {
    /// Whether this is a name for values that others use.
    pub(crate) fn is_name(&self) -> bool {
        let mut letters = self.key.chars();
        letters.next().is_some_and(char::is_alphabetic)
            && letters.all(|c| c.is_alphanumeric() || c == '_')
    }

    /// The word of the program that the key refers to, with its line if given.
    pub(crate) fn word(&self) -> Option<(Option<u32>, &str)> {
        let (front, word) = self.key.split_once('.')?;
        let (front, line) = match front.split_once('[') {
            Some((front, line)) => (front, Some(line.strip_suffix(']')?.parse().ok()?)),
            None => (front, None),
        };
        front.eq_ignore_ascii_case(PROGRAM).then_some((line, word))
    }

    /// The last part of the key, if it is clear enough: `kv`, `enable`.
    pub(crate) fn short(&self) -> &str {
        self.key.rsplit('.').next().unwrap_or(&self.key)
    }

    /// Whether its numbers only select modes, with nothing in between.
    pub(crate) fn is_choice(&self) -> bool {
        let row =
            self.values.first().and_then(|v| Override::parse(&format!("{}={v}", self.key)).ok());
        let Some(row) = row.and_then(|o| o.parameter()) else { return false };
        match (row.raw, row.low, row.high) {
            (Raw::Boolean | Raw::Names(_) | Raw::Word(_) | Raw::Flags(_), _, _) => true,
            (Raw::Real64 | Raw::Text | Raw::Code, _, _) => false,
            (_, Bound::At(low), Bound::At(high)) => high - low < MOST_CHOICES,
            _ => false,
        }
    }

    /// The key with the unit of its numbers in a list.
    pub(crate) fn label(&self) -> String {
        let first = self.values.first().map_or("", String::as_str);
        let row = Override::parse(&format!("{}={first}", self.key)).ok();
        let unit = row.and_then(|o| o.parameter()).map_or("-", |row| row.unit);
        let unit = if unit == "-" { "" } else { unit };
        crate::chart::scale::label(&self.key, unit)
    }

    /// Meaning of the parameter with its ID, as in `explain`.
    pub(crate) fn meaning(&self) -> Option<String> {
        let row = Override::parse(&format!("{}={}", self.key, self.values.first()?)).ok()?;
        let row = row.parameter()?;
        let id = if row.id.is_empty() { String::new() } else { format!(" ({})", row.id) };
        Some(format!("{}{id}: {}", self.short(), row.meaning))
    }

    /// The values as numbers, if all of them are.
    pub(crate) fn numbers(&self) -> Option<Vec<f64>> {
        self.values.iter().map(|v| v.parse().ok()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_ranges_numbers_and_words() {
        let values = |text: &str| text.parse::<Vary>().unwrap().values;
        assert_eq!(values("X.a=1..3"), ["1", "2", "3"]);
        assert_eq!(values("X.a=0.1..0.3:0.1,7"), ["0.1", "0.2", "0.3", "7"]);
        assert_eq!(values("X.v=NONE,VEL, VEL|ACC"), ["NONE", "VEL", "VEL|ACC"]);
        let vary: Vary = "channel.prog_start.slope.profile=0..3".parse().unwrap();
        let meaning = vary.meaning().unwrap();
        assert!(meaning.starts_with("profile (P-CHAN-00071): slope at program start"), "{meaning}");
        assert_eq!("X.a=1".parse::<Vary>().unwrap().meaning(), None);
        let word =
            |text: &str| text.parse::<Vary>().unwrap().word().map(|(l, w)| (l, w.to_owned()));
        assert_eq!(word("program.V.P.R=1..3"), Some((None, "V.P.R".to_owned())));
        assert_eq!(word("Program[12].FREQ={F}"), Some((Some(12), "FREQ".to_owned())));
        assert_eq!(word("X.vib_guard.freq={F}"), None);
        assert!("F=1..3".parse::<Vary>().unwrap().is_name());
        for wrong in ["X.a", "1=1", "program.FREQ=high", "X.=1", "X.a=3..1", "X.a=1..2:0"] {
            assert!(wrong.parse::<Vary>().is_err(), "{wrong}");
        }
    }
}
