//! All combinations of parameters that take several values each.

use crate::Error;
use crate::args::Vary;
use crate::request::Request;

/// More combinations than this are a slip of the hand.
const MOST_COMBINATIONS: usize = 100_000;

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
