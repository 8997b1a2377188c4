//! All combinations of parameters with several values each.

use crate::args::Vary;
use crate::args::values::after_external;
use crate::args::vary::{MOST_COMBINATIONS, used_name};
use crate::error::Error;
use crate::request::Request;
use crate::words::Word;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// All combinations of values, with the last parameter changing fastest: for each an index into the values of each
/// parameter.
///
/// # Errors
/// [`Error::Usage`] for too many of them, a parameter given twice, or a name that is not given or not used.
pub(crate) fn combinations(vary: &[Vary]) -> Result<Vec<Vec<usize>>, Error> {
    for (i, v) in vary.iter().enumerate() {
        if vary[..i].iter().any(|other| other.key.eq_ignore_ascii_case(&v.key)) {
            return Err(Error::Usage(format!("--vary: {} given twice", v.key)));
        }
    }
    let used = |v: &Vary| -> Vec<String> {
        v.values.iter().filter_map(|value| used_name(value)).map(str::to_owned).collect()
    };
    let all_used: Vec<String> = vary.iter().flat_map(used).collect();
    for name in &all_used {
        if !vary.iter().any(|v| v.is_name() && v.key == *name) {
            return Err(Error::Usage(format!("--vary: {{{name}}} requires --vary {name}=VALUES")));
        }
    }
    for v in vary.iter().filter(|v| v.is_name()) {
        if !all_used.contains(&v.key) || !used(v).is_empty() {
            let name = &v.key;
            return Err(Error::Usage(format!(
                "--vary: {name} is the name of values that another --vary uses as {{{name}}}; a list parameter is AXIS.{name}, a value of the program program.{name}"
            )));
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

/// The value of each parameter in one combination; a parameter that uses a name has the value of the name.
pub(crate) fn values(vary: &[Vary], combination: &[usize]) -> Vec<String> {
    let own = || vary.iter().zip(combination).map(|(v, &i)| (v, &v.values[i]));
    let of_name = |name: &str| own().find(|(v, _)| v.is_name() && v.key == name);
    own()
        .map(|(_, value)| {
            used_name(value)
                .and_then(of_name)
                .map_or_else(|| value.clone(), |(_, value)| value.clone())
        })
        .collect()
}

/// Applies one combination to a request.
pub(crate) fn put(vary: &[Vary], combination: &[usize], request: &mut Request) {
    for (v, value) in vary.iter().zip(values(vary, combination)) {
        if v.is_name() {
            continue;
        }
        if let Some((line, word)) = v.word() {
            request.words.push(Word { line, name: word.to_owned(), value });
        } else if let Some(name) = after_external(&v.key) {
            request.external.retain(|(other, _)| !other.eq_ignore_ascii_case(name));
            request.external.push((name.to_owned(), value));
        } else {
            request.settings.push(format!("{}={value}", v.key));
        }
    }
}

/// Parameters whose values have no influence on any result. `rows` are those of the combinations, possibly only a part
/// of all; a parameter for which no two rows can be compared is not included.
pub(crate) fn without_effect<'v, R: PartialEq>(
    vary: &'v [Vary],
    combinations: &[Vec<usize>],
    rows: &[R],
) -> Vec<&'v Vary> {
    // each row against the first one with the same values of all others
    let same = |which: usize| {
        let mut first: HashMap<[&[usize]; 2], &R> = HashMap::new();
        let mut compared = false;
        let mut all = combinations.iter().zip(rows);
        all.all(|(combination, row)| {
            match first.entry([&combination[..which], &combination[which + 1..]]) {
                Entry::Vacant(place) => {
                    place.insert(row);
                    true
                }
                Entry::Occupied(other) => {
                    compared = true;
                    *other.get() == row
                }
            }
        }) && compared
    };
    vary.iter().enumerate().filter(|(i, _)| same(*i)).map(|(_, v)| v).collect()
}

/// The settings of one combination, as `--set` takes them.
pub(crate) fn settings(vary: &[Vary], combination: &[usize]) -> Vec<String> {
    let values = values(vary, combination);
    vary.iter().zip(values).map(|(v, value)| format!("{}={value}", v.key)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

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
        // only the second one has an influence: rows 0 to 2 for X.a=1, 3 to 5 for X.a=2
        let keys = |rows: &[u32]| -> Vec<String> {
            without_effect(&vary, &all, rows).iter().map(|v| v.key.clone()).collect()
        };
        assert_eq!(keys(&[7, 8, 9, 7, 8, 9]), ["X.a"]);
        assert_eq!(keys(&[7, 7, 7, 8, 8, 8]), ["Y.b"]);
        assert_eq!(keys(&[7, 8, 9, 7, 8, 0]), [""; 0]);
        assert_eq!(keys(&[7; 6]), ["X.a", "Y.b"]);
        // rows 2 to 4 of them contain two rows that differ in Y.b alone, but none that differ in X.a alone; rows 1 to 4
        // do
        let of_part = |range: std::ops::Range<usize>, rows: &[u32]| -> Vec<String> {
            without_effect(&vary, &all[range], rows).iter().map(|v| v.key.clone()).collect()
        };
        assert_eq!(of_part(2..5, &[7, 8, 8]), ["Y.b"]);
        assert_eq!(of_part(1..5, &[7, 8, 9, 7]), ["X.a"]);
        assert_eq!(of_part(1..5, &[7, 8, 9, 9]), [""; 0]);
        let mut request = Request::default();
        let external: Vec<Vary> = vec!["v.e.Speed=100,200".parse().unwrap(), vary[0].clone()];
        put(&external, &[1, 0], &mut request);
        assert_eq!(request.external, [("Speed".to_owned(), "200".to_owned())]);
        assert_eq!(request.settings, ["X.a=1"]);
        // the values of a name are used jointly wherever others refer to it
        let texts = ["F=20,30", "X.a={F}", "program.FREQ={F}"];
        let named: Vec<Vary> = texts.iter().map(|text| text.parse().unwrap()).collect();
        assert_eq!(combinations(&named).unwrap().len(), 2);
        let mut request = Request::default();
        put(&named, &[1, 0, 0], &mut request);
        assert_eq!(request.settings, ["X.a=30"]);
        let word = Word { line: None, name: "FREQ".to_owned(), value: "30".to_owned() };
        assert_eq!(request.words, [word]);
        assert!(error(["X.a={F}", "Y.b=1"]).contains("requires --vary F="));
        assert!(error(["kv=1,2", "Y.b=1"]).contains("AXIS.kv"));
        assert!(error(["X.a=1..900", "Y.a=1..900"]).contains("more than"));
        // a single parameter may have as many values as there may be combinations
        assert_eq!("X.a=1000..60000:10".parse::<Vary>().unwrap().values.len(), 5901);
        assert!(error(["X.a=1", "x.A=2"]).contains("twice"));
    }
}
