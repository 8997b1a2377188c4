//! Tables of programs: in each line a program, an arrow and the expected result. `interpreter/tests/language/README.md` describes the
//! form; the reader decides what the words after the arrow mean.

use std::path::Path;

/// A row of a table.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// Machine with its own lists, or the built-in one.
    pub machine: Option<String>,
    /// Settings of the lists.
    pub settings: Vec<String>,
    /// Other files: name and text.
    pub files: Vec<(String, String)>,
    /// Real-time inputs: time in s, signal, value.
    pub inputs: Vec<(f64, String, f64)>,
    /// The program, with the surroundings given by its paragraph and M30.
    pub program: String,
    /// The right side.
    pub expected: String,
    /// The row as written.
    pub text: String,
}

/// Settings from the form that they have at the head of a paragraph: `KEY=VALUE`, or `PREFIX: KEY=VALUE, KEY=VALUE`; several are separated
/// by `; `.
pub fn settings(text: &str) -> Vec<String> {
    let one = |text: &str| match text.split_once(": ") {
        Some((prefix, keys)) => keys.split(", ").map(|key| format!("{prefix}.{key}")).collect(),
        None => vec![text.to_owned()],
    };
    text.split("; ").filter(|text| !text.is_empty()).flat_map(one).collect()
}

/// Lines of a program from the form that it has in a row.
pub fn lines(text: &str) -> String {
    text.replace(" | ", "\n") + "\n"
}

/// The rows of a table.
///
/// # Panics
/// If a line is neither the head of a paragraph nor a row.
pub fn rows(table: &str) -> Vec<Row> {
    let (mut rows, mut always, mut each) = (Vec::new(), Vec::new(), vec![Vec::new()]);
    let (mut here, mut before, mut after) = (Row::default(), String::new(), String::new());
    for line in table.replace("\n    ", " ").lines().filter(|line| !line.starts_with("# ")) {
        if line.is_empty() {
            here = Row { settings: always.clone(), ..Row::default() };
            (before, after, each) = (String::new(), String::new(), vec![Vec::new()]);
        } else if let Some(text) = line.strip_prefix("always with ") {
            always.extend(settings(text));
            here.settings.extend(settings(text));
        } else if let Some(text) = line.strip_prefix("with ") {
            here.settings.extend(settings(text));
        } else if let Some(text) = line.strip_prefix("each with ") {
            each = text.split(" | ").map(settings).collect();
        } else if let Some(name) = line.strip_prefix("machine ") {
            here.machine = Some(name.to_owned());
        } else if let Some(text) = line.strip_prefix("before ") {
            before = lines(text);
        } else if let Some(text) = line.strip_prefix("after ") {
            after = lines(text);
        } else if let Some((name, text)) =
            line.strip_prefix("file ").and_then(|f| f.split_once(": "))
        {
            here.files.push((name.to_owned(), lines(text)));
        } else if let Some(text) = line.strip_prefix("inputs ") {
            let words = text.split(", ").map(|input| input.split(' ').collect::<Vec<_>>());
            here.inputs = words.map(|w| (number(w[0]), w[1].to_owned(), number(w[2]))).collect();
        } else {
            let sides = line.rsplit_once(" -> ");
            assert!(sides.is_some(), "no arrow: {line}");
            let (program, expected) = sides.unwrap_or_default();
            let program = format!("{before}{}{after}M30\n", lines(program));
            let (expected, text) = (expected.to_owned(), line.to_owned());
            let row = Row { program, expected, text, ..here.clone() };
            rows.extend(each.iter().map(|other| {
                let settings = [&here.settings[..], other].concat();
                let text = [&other.join(" "), " ", &row.text].concat();
                Row { settings, text: text.trim_start().to_owned(), ..row.clone() }
            }));
        }
    }
    rows
}

impl Row {
    /// The right side before its texts, and these.
    pub fn words_and_texts(&self) -> (&str, &str) {
        self.expected.split_at(self.expected.find('"').unwrap_or(self.expected.len()))
    }
}

/// The rows of all tables of a folder that are wrong, with what they state and what is not so; also tables without a row.
///
/// # Errors
/// A table cannot be read.
pub fn wrong(
    folder: impl AsRef<Path>,
    mut faults: impl FnMut(&Row) -> Vec<String>,
) -> std::io::Result<Vec<String>> {
    let mut wrong = Vec::new();
    for file in std::fs::read_dir(folder)? {
        let table = file?.path();
        if table.extension().is_none_or(|e| e != "txt") {
            continue;
        }
        let rows = rows(&std::fs::read_to_string(&table)?);
        if rows.is_empty() {
            wrong.push(format!("{} has no row", table.display()));
        }
        for row in &rows {
            let faults = faults(row).join("; ");
            if !faults.is_empty() {
                wrong.push(format!("{}: {}\n    {faults}", table.display(), row.text));
            }
        }
    }
    Ok(wrong)
}

fn number(text: &str) -> f64 {
    let number = text.parse();
    assert!(number.is_ok(), "{text} is not a number");
    number.unwrap_or_default()
}

/// Whether a thing is that of the row, as far as the row states it, numbers within 1e-9.
pub fn is(wanted: &str, found: &str) -> bool {
    let number = |text: &str| text.trim_end_matches(char::is_alphabetic).parse::<f64>().ok();
    let unit = |text: &str| text.trim_start_matches(|c: char| !c.is_alphabetic()).to_owned();
    let same = |w: &str, f: &str| {
        let near = |(w, f): (f64, f64)| (w - f).abs() < 1e-9;
        w == "_" || w == f || unit(w) == unit(f) && number(w).zip(number(f)).is_some_and(near)
    };
    let mut found = found.split([',', '@']);
    let wanted = wanted.trim_matches(['(', ')']);
    wanted.split([',', '@']).all(|w| found.next().is_some_and(|f| same(w, f)))
}

/// Whether a list is that of a row; `..` are any others.
pub fn fits(wanted: &[&str], found: &[String]) -> bool {
    match wanted {
        [] => found.is_empty(),
        ["..", rest @ ..] => (0..=found.len()).any(|n| fits(rest, &found[n..])),
        [first, rest @ ..] => {
            found.split_first().is_some_and(|(f, more)| is(first, f) && fits(rest, more))
        }
    }
}
