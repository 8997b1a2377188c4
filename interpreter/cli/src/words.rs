//! Numbers in a program and their replacements: values that the program sets can be varied without editing it.
//!
//! A word is a name, `=` and a number: `P1=10`, `V.P.R=2.5`, `FREQ=40` of a guard command. Remarks and texts are
//! skipped.
//!
//! Add words to a [`Request`](crate::request::Request) before it is opened and run.
//!
//! ```
//! use kontur::request::Request;
//! use kontur::words::Word;
//!
//! let mut request = Request { program: "../../programs/square_corner.nc".into(), ..Request::default() };
//! request.words.push(Word { line: Some(7), name: "FREQ".into(), value: "30".into() });
//! assert!(request.open().is_ok());
//! request.words[0].line = Some(8);
//! assert!(request.open().is_err(), "there is no such word in line 8");
//! ```

/// A number that replaces one in the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// The line that contains it; without one the word must occur exactly once.
    pub line: Option<u32>,
    /// The key before `=`, in any case.
    pub name: String,
    /// The number in its place.
    pub value: String,
}

/// The text with the values of the words.
///
/// # Errors
/// A description of the error, if there is no such word, several of them, or one that is not a number.
pub(crate) fn put(text: &[u8], words: &[Word]) -> Result<Vec<u8>, String> {
    let mut text = text.to_vec();
    for word in words {
        let found: Vec<Place> = places(&text, &word.name)
            .into_iter()
            .filter(|place| word.line.is_none_or(|line| line == place.line))
            .collect();
        let Word { name, value, .. } = word;
        match &found[..] {
            [] => {
                let place =
                    word.line.map_or("in the program".to_owned(), |l| format!("in line {l}"));
                return Err(format!(
                    "{name}= not found {place}: write a number to be varied with `=`, as in {name}={value}"
                ));
            }
            [Place { number: Some((from, to)), .. }] => {
                text.splice(*from..*to, value.bytes());
            }
            [Place { line, .. }] => {
                return Err(format!("{name}= in line {line} is not a plain number"));
            }
            [first, .., last] if first.line == last.line => {
                return Err(format!("{name}= occurs several times in line {}", first.line));
            }
            [first, .., last] => {
                let (first, last) = (first.line, last.line);
                return Err(format!(
                    "{name}= occurs in several lines, from {first} to {last}; use program[{first}].{name} for the first"
                ));
            }
        }
    }
    Ok(text)
}

/// Position of a word.
struct Place {
    line: u32,
    /// Its number, as bytes of the text.
    number: Option<(usize, usize)>,
}

fn places(text: &[u8], name: &str) -> Vec<Place> {
    let mut places = Vec::new();
    let mut line = 1;
    // inside of a remark in round brackets, or of a text
    let (mut remark, mut quoted, mut at) = (false, false, 0);
    while at < text.len() {
        let before = at.checked_sub(1).map_or(b' ', |i| text[i]);
        match text[at] {
            b'\n' => {
                line += 1;
                (remark, quoted) = (false, false);
            }
            b')' if remark => remark = false,
            b'"' if !remark => quoted = !quoted,
            _ if remark || quoted => {}
            b'(' => remark = true,
            b';' => {
                while at < text.len() && text[at] != b'\n' {
                    at += 1;
                }
                continue;
            }
            _ if !is_of_name(before)
                && text[at..].len() >= name.len()
                && text[at..at + name.len()].eq_ignore_ascii_case(name.as_bytes()) =>
            {
                if let Some(from) = after_equals(text, at + name.len()) {
                    places.push(Place { line, number: number(text, from) });
                }
            }
            _ => {}
        }
        at += 1;
    }
    places
}

const fn is_of_name(c: u8) -> bool {
    c.is_ascii_alphanumeric() || matches!(c, b'_' | b'.')
}

fn skip_spaces(text: &[u8], from: usize) -> usize {
    from + text[from..].iter().take_while(|c| matches!(c, b' ' | b'\t')).count()
}

/// Position of the value, if `=` follows.
fn after_equals(text: &[u8], from: usize) -> Option<usize> {
    let at = skip_spaces(text, from);
    let next = text.get(at + 1);
    (text.get(at) == Some(&b'=') && next != Some(&b'=')).then(|| skip_spaces(text, at + 1))
}

/// The number at a position, unless it is part of an expression.
fn number(text: &[u8], from: usize) -> Option<(usize, usize)> {
    let sign = usize::from(matches!(text.get(from), Some(b'+' | b'-')));
    let digits = from + sign;
    let end =
        digits + text[digits..].iter().take_while(|c| c.is_ascii_digit() || **c == b'.').count();
    let behind = skip_spaces(text, end);
    let alone = !matches!(text.get(behind), Some(b'+' | b'-' | b'*' | b'/' | b'^' | b'<' | b'>'))
        && !text.get(end).is_some_and(|c| is_of_name(*c));
    (text[digits..end].iter().any(u8::is_ascii_digit) && alone).then_some((from, end))
}

#[cfg(test)]
mod tests {
    use super::{Word, put};

    fn with(text: &str, line: Option<u32>, name: &str) -> Result<String, String> {
        let word = Word { line, name: name.to_owned(), value: "7.5".to_owned() };
        put(text.as_bytes(), &[word]).map(|text| String::from_utf8(text).unwrap())
    }

    #[test]
    fn numbers_of_words_are_replaced() {
        let text = "; P1=1\n(P1=2) P1 = -10 ; P1=3\n#MSG [\"P1=4\"]\nP11=5 V.P.P1=6\n";
        let put = text.replace("P1 = -10", "P1 = 7.5");
        assert_eq!(with(text, None, "p1"), Ok(put));
        assert_eq!(with(text, Some(4), "V.P.P1"), Ok(text.replace("V.P.P1=6", "V.P.P1=7.5")));
        let guard = "#VIB GUARD ON [MODE=2 FREQ=40 AX_DEV=.01]\nFREQ=3\n";
        assert_eq!(with(guard, None, "MODE"), Ok(guard.replace("MODE=2", "MODE=7.5")));
        assert_eq!(with(guard, None, "AX_DEV"), Ok(guard.replace(".01", "7.5")));
        assert_eq!(with(guard, Some(1), "FREQ"), Ok(guard.replace("40", "7.5")));
        for (text, line, name, why) in [
            (guard, None, "FREQ", "from 1 to 2; use program[1].FREQ"),
            (guard, None, "P1", "P1= not found in the program"),
            (guard, Some(2), "MODE", "MODE= not found in line 2"),
            ("P1=10+5", None, "P1", "not a plain number"),
            ("P1=P2", None, "P1", "not a plain number"),
            ("P1=", None, "P1", "not a plain number"),
            ("P1=1 P1=2", None, "P1", "several times in line 1"),
            ("$IF P1==1", None, "P1", "P1= not found"),
        ] {
            let said = with(text, line, name).unwrap_err();
            assert!(said.contains(why), "{text} {name}: {said}");
        }
    }
}
