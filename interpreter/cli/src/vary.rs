//! Parameters that take several values, and all combinations of them.

use crate::Error;
use crate::args::setting;
use crate::request::Request;
use crate::response::args::Numbers;
use kontur_interpreter::machine::Override;
use kontur_interpreter::machine::table::{Bound, Raw};
use std::str::FromStr;

/// A whole parameter with fewer values than this chooses one of several ways.
const MOST_CHOICES: f64 = 8.0;
/// More combinations than this are a slip of the hand.
const MOST_COMBINATIONS: usize = 100_000;

/// One list parameter and its values: `X.getriebe[0].kv=2000..60000:1000`, `X.vorsteuer.vorsteuerung=NONE,VEL,VEL|ACC`.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    /// What `--set` calls it.
    pub key: String,
    /// Its values as they stand in a list.
    pub values: Vec<String>,
}

impl FromStr for Vary {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (key, list) = text
            .split_once('=')
            .ok_or("KEY=VALUES expected, e.g. X.getriebe[0].kv=1000..5000:500")?;
        let mut values = Vec::new();
        for part in list.split(',') {
            if part.contains("..") {
                let numbers: Numbers = part.parse()?;
                values.extend(numbers.0.into_iter().map(plain));
            } else {
                values.push(part.trim().to_owned());
            }
        }
        let vary = Self { key: key.trim().to_owned(), values };
        for value in &vary.values {
            setting(&format!("{}={value}", vary.key))?;
        }
        Ok(vary)
    }
}

/// A number without the digits that steps leave behind: 0.3, not 0.30000000000000004.
fn plain(value: f64) -> String {
    let text = format!("{value:.9}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

impl Vary {
    /// The last part of the key, where it says enough: `kv`, `enable`.
    pub(crate) fn short(&self) -> &str {
        self.key.rsplit('.').next().unwrap_or(&self.key)
    }

    /// True if its numbers only name one of a few ways, as a mode does: nothing lies between two of them.
    pub(crate) fn is_choice(&self) -> bool {
        let row =
            self.values.first().and_then(|v| Override::parse(&format!("{}={v}", self.key)).ok());
        let Some(row) = row.and_then(|o| o.parameter()) else { return false };
        match (row.raw, row.low, row.high) {
            (Raw::Boolean | Raw::Names(_) | Raw::Word(_) | Raw::Flags(_), _, _) => true,
            (Raw::Real64 | Raw::Text, _, _) => false,
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

    /// What the parameter is, with its ID, as `explain` says it.
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

/// Every combination of values, the last parameter changing fastest: for each an index into the values of each parameter.
///
/// # Errors
/// [`Error::Usage`] for too many of them, or a parameter given twice.
pub(crate) fn combinations(vary: &[Vary]) -> Result<Vec<Vec<usize>>, Error> {
    for (i, v) in vary.iter().enumerate() {
        if vary[..i].iter().any(|other| other.key.eq_ignore_ascii_case(&v.key)) {
            return Err(Error::Usage(format!("--vary: {} twice", v.key)));
        }
    }
    let count = vary.iter().try_fold(1_usize, |n, v| n.checked_mul(v.values.len()));
    if count.is_none_or(|n| n > MOST_COMBINATIONS) {
        let text = format!("--vary: more than {MOST_COMBINATIONS} combinations");
        return Err(Error::Usage(text));
    }
    let mut all = vec![Vec::new()];
    for v in vary {
        let longer = |one: &Vec<usize>| {
            let one = one.clone();
            (0..v.values.len()).map(move |i| one.iter().copied().chain([i]).collect())
        };
        all = all.iter().flat_map(longer).collect();
    }
    Ok(all)
}

/// External variables (`V.E.NAME`) vary beside list parameters: a program reads them.
const EXTERNAL: &str = "V.E.";

/// Puts one combination into a request.
pub(crate) fn put(vary: &[Vary], combination: &[usize], request: &mut Request) {
    for (v, &i) in vary.iter().zip(combination) {
        let value = v.values[i].clone();
        if let Some((_, name)) = v
            .key
            .split_at_checked(EXTERNAL.len())
            .filter(|(front, _)| front.eq_ignore_ascii_case(EXTERNAL))
        {
            request.external.retain(|(other, _)| !other.eq_ignore_ascii_case(name));
            request.external.push((name.to_owned(), value));
        } else {
            request.settings.push(format!("{}={value}", v.key));
        }
    }
}

/// Parameters whose values make no difference to any result: `rows` holds the results in the order of [`combinations`].
pub(crate) fn without_effect<'v, R: PartialEq>(
    vary: &'v [Vary],
    combinations: &[Vec<usize>],
    rows: &[R],
) -> Vec<&'v Vary> {
    // each row against that of the parameter's first value, all others being equal
    let same = |which: usize| {
        let stride: usize = vary[which + 1..].iter().map(|v| v.values.len()).product();
        let mut all = combinations.iter().zip(rows).enumerate();
        all.all(|(i, (combination, row))| rows[i - combination[which] * stride] == *row)
    };
    let several = vary.iter().enumerate().filter(|(_, v)| v.values.len() > 1);
    several.filter(|(i, _)| same(*i)).map(|(_, v)| v).collect()
}

/// The settings of one combination, as `--set` takes them.
pub(crate) fn settings(vary: &[Vary], combination: &[usize]) -> Vec<String> {
    vary.iter().zip(combination).map(|(v, &i)| format!("{}={}", v.key, v.values[i])).collect()
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
        for wrong in ["X.a", "a=1", "X.=1", "X.a=3..1", "X.a=1..2:0"] {
            assert!(wrong.parse::<Vary>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_last_parameter_changes_fastest() {
        let vary: Vec<Vary> =
            ["X.a=1,2", "Y.b=5..7"].iter().map(|text| text.parse().unwrap()).collect();
        let all = combinations(&vary).unwrap();
        assert_eq!(all.len(), 6);
        assert_eq!(settings(&vary, &all[1]), ["X.a=1", "Y.b=6"]);
        assert_eq!(settings(&vary, &all[5]), ["X.a=2", "Y.b=7"]);
        let error = |texts: [&str; 2]| {
            let vary: Vec<Vary> = texts.iter().map(|text| text.parse().unwrap()).collect();
            combinations(&vary).unwrap_err().to_string()
        };
        // only the second one makes a difference: rows 0 to 2 for X.a=1, 3 to 5 for X.a=2
        let keys = |rows: &[u32]| -> Vec<String> {
            without_effect(&vary, &all, rows).iter().map(|v| v.key.clone()).collect()
        };
        assert_eq!(keys(&[7, 8, 9, 7, 8, 9]), ["X.a"]);
        assert_eq!(keys(&[7, 7, 7, 8, 8, 8]), ["Y.b"]);
        assert_eq!(keys(&[7, 8, 9, 7, 8, 0]), [""; 0]);
        assert_eq!(keys(&[7; 6]), ["X.a", "Y.b"]);
        let mut request = Request::default();
        let external: Vec<Vary> = vec!["v.e.Speed=100,200".parse().unwrap(), vary[0].clone()];
        put(&external, &[1, 0], &mut request);
        assert_eq!(request.external, [("Speed".to_owned(), "200".to_owned())]);
        assert_eq!(request.settings, ["X.a=1"]);
        assert!(error(["X.a=1..900", "Y.a=1..900"]).contains("more than"));
        assert!(error(["X.a=1", "x.A=2"]).contains("twice"));
    }
}
