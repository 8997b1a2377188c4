//! Real-time inputs of a run from time-stamped texts.
//!
//! CSV with a header `t_s,<signal>,...` and rows with increasing times. A value holds until the next one in its column;
//! an empty cell changes nothing. Every file is read completely before the run, so that an error at its end refuses the
//! run before its first cycle; during the run it is read again line by line.
//!
//! ```
//! use kontur_interpreter::job::{Change, Signal, inputs};
//! use kontur_interpreter::machine::Machine;
//!
//! let (machine, _) = Machine::builtin(&[]).unwrap();
//! let file = ("hold.csv", || Ok(&b"t_s,feedhold\n0.2,1\n0.5,0\n"[..]));
//! // what `Run::with_inputs` takes
//! let changes = inputs::open(&[file], &machine).unwrap();
//! let hold = Change::new(0.2, Signal::Feedhold, 1.0).unwrap();
//! assert_eq!(changes.map(Result::unwrap).next(), Some(hold));
//! ```

use super::{Change, Changes, Signal};
use crate::diag::{Condition, Diagnostic, Location};
use crate::machine::Machine;
use crate::source::text::Text;
use std::collections::VecDeque;
use std::io::{self, BufRead, BufReader, Read};
use std::sync::Arc;

/// Changes of all files in the order of time. A file has a name for messages, and is opened twice from its beginning.
///
/// # Errors
/// [`Problem`] if a file cannot be read or has an error, or if two columns have the same signal.
pub fn open<R, F>(files: &[(&str, F)], machine: &Machine) -> Result<Changes, Problem>
where
    R: Read + Send + 'static,
    F: Fn() -> io::Result<R>,
{
    let mut opened = Vec::new();
    let mut taken = Vec::new();
    for (name, file) in files {
        let begin = |taken: &[Signal]| {
            let reader = file().map_err(|e| Problem::Io((*name).to_owned(), e))?;
            InputFile::begin(name, reader, machine, taken)
        };
        let mut found = begin(&taken)?;
        while found.next_row()? {
            found.changes.clear();
        }
        taken.extend(found.columns);
        opened.push(begin(&[])?);
    }
    Ok(Box::new(Merged { files: opened }))
}

/// Errors of a file.
#[derive(Debug)]
pub enum Problem {
    /// K-0076, with its position.
    Wrong(Box<Diagnostic>),
    /// The file of this name cannot be read.
    Io(String, io::Error),
}

impl Problem {
    fn diagnostic(self) -> Box<Diagnostic> {
        match self {
            Self::Wrong(diagnostic) => diagnostic,
            Self::Io(name, e) => {
                Box::new(Diagnostic::new(Condition::InputFile, format!("{name}: {e}")))
            }
        }
    }
}

/// One file, read line by line.
struct InputFile<R> {
    name: Arc<str>,
    reader: BufReader<Text<R>>,
    /// Signal of every column after the time.
    columns: Vec<Signal>,
    line: u32,
    /// Offset of the current line in bytes, and that of its end.
    offset: u64,
    end: u64,
    text: Arc<str>,
    time_s: Option<f64>,
    /// Changes of the row read last.
    changes: VecDeque<Change>,
}

impl<R: Read> InputFile<R> {
    /// Reads the header. `taken`: signals that other files have.
    fn begin(name: &str, reader: R, machine: &Machine, taken: &[Signal]) -> Result<Self, Problem> {
        let text = Text::new(reader).map_err(|e| Problem::Io(name.to_owned(), e))?;
        let mut input = Self {
            name: name.into(),
            reader: BufReader::new(text),
            columns: Vec::new(),
            line: 0,
            offset: 0,
            end: 0,
            text: "".into(),
            time_s: None,
            changes: VecDeque::new(),
        };
        input.next_line()?;
        input.header(machine, taken)?;
        Ok(input)
    }

    fn header(&mut self, machine: &Machine, taken: &[Signal]) -> Result<(), Problem> {
        let all = Signal::all(machine);
        let text = Arc::clone(&self.text);
        if text.starts_with("t_s;") {
            let problem = self.wrong(0, &text, "the columns are separated by semicolons");
            let hint = "separate them with commas, and write a decimal point in numbers: 0.5,100";
            return Err(problem.hint(hint.to_owned()));
        }
        for (i, (at, name)) in fields(&text).enumerate() {
            let known = all.iter().find(|(n, _)| n.eq_ignore_ascii_case(name));
            match known {
                _ if i == 0 && name == "t_s" => {}
                _ if i == 0 => return Err(self.wrong(at, name, "the first column has to be t_s")),
                None => {
                    let names: Vec<&str> = all.iter().map(|(n, _)| n.as_str()).collect();
                    let hint = format!("signals of this machine: {}", names.join(", "));
                    let text = format!("`{name}` is not a signal");
                    return Err(self.wrong(at, name, &text).hint(hint));
                }
                Some((_, s)) if taken.contains(s) || self.columns.contains(s) => {
                    return Err(self.wrong(at, name, &format!("{name} occurs in two columns")));
                }
                Some((_, signal)) => self.columns.push(*signal),
            }
        }
        if self.columns.is_empty() {
            return Err(self.wrong(0, &text, "a header `t_s,<signal>,...` is expected"));
        }
        Ok(())
    }

    /// Takes the next line; false at the end of the file.
    fn next_line(&mut self) -> Result<bool, Problem> {
        self.offset = self.end;
        self.line += 1;
        let mut bytes = Vec::new();
        let read = match self.reader.read_until(b'\n', &mut bytes) {
            Ok(read) => read,
            Err(e) if e.kind() == io::ErrorKind::InvalidData => {
                self.text = "".into();
                return Err(self.wrong(0, "", &e.to_string()));
            }
            Err(e) => return Err(Problem::Io(self.name.to_string(), e)),
        };
        self.end += read as u64;
        let text = String::from_utf8_lossy(&bytes);
        // a byte order mark before the header
        self.text = text.trim_start_matches('\u{feff}').trim_end_matches(['\r', '\n']).into();
        Ok(read > 0)
    }

    /// Reads the next row into [`Self::changes`]; false at the end of the file.
    fn next_row(&mut self) -> Result<bool, Problem> {
        loop {
            if !self.next_line()? {
                return Ok(false);
            }
            if !self.text.trim().is_empty() {
                break;
            }
        }
        let text = Arc::clone(&self.text);
        let mut count = 0;
        for (i, (at, field)) in fields(&text).enumerate() {
            count = i;
            if i == 0 {
                let time_s = self.number(at, field)?;
                let rises = self.time_s.is_none_or(|before| time_s > before);
                if time_s < 0.0 || !rises {
                    return Err(self.wrong(
                        at,
                        field,
                        "the time does not increase, or is negative",
                    ));
                }
                self.time_s = Some(time_s);
                continue;
            }
            let Some(signal) = self.columns.get(i - 1).copied() else { continue };
            if field.is_empty() {
                continue;
            }
            let value = self.number(at, field)?;
            let change = Change::new(self.time_s.unwrap_or_default(), signal, value)
                .map_err(|reason| self.wrong(at, field, &reason))?;
            self.changes.push_back(change);
        }
        if count != self.columns.len() {
            let text =
                format!("{} columns where the header has {}", count + 1, self.columns.len() + 1);
            return Err(self.wrong(0, &self.text, &text));
        }
        Ok(true)
    }

    fn number(&self, at: usize, field: &str) -> Result<f64, Problem> {
        let number = field.parse::<f64>().ok().filter(|x| x.is_finite());
        number.ok_or_else(|| self.wrong(at, field, &format!("`{field}` is not a number")))
    }

    /// An error in the current line, `at` characters from its start.
    fn wrong(&self, at: usize, marked: &str, text: &str) -> Problem {
        let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        let diagnostic = Diagnostic::new(Condition::InputFile, text).at(Location {
            file: Arc::clone(&self.name),
            line: self.line,
            column: count(at + 1),
            offset: self.offset,
            length: count(marked.chars().count().max(1)),
            block: None,
            text: Arc::clone(&self.text),
        });
        Problem::Wrong(Box::new(diagnostic))
    }

    /// Time of the next change; `None` at the end of the file.
    fn peek(&mut self) -> Result<Option<f64>, Problem> {
        while self.changes.is_empty() {
            if !self.next_row()? {
                return Ok(None);
            }
        }
        Ok(self.changes.front().map(Change::time_s))
    }
}

impl Problem {
    fn hint(self, hint: String) -> Self {
        match self {
            Self::Wrong(diagnostic) => Self::Wrong(Box::new(diagnostic.hint(hint))),
            io @ Self::Io(..) => io,
        }
    }
}

/// Fields of a line without surrounding blanks and quotes, each with the number of characters before it. A field cannot
/// contain a comma.
fn fields(line: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut at = 0;
    line.split(',').map(move |field| {
        let blanks = field.chars().take_while(|c| c.is_whitespace()).count();
        let start = at + blanks;
        at += field.chars().count() + 1;
        let field = field.trim();
        match field.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')) {
            Some(quoted) => (start + 1, quoted),
            None => (start, field),
        }
    })
}

/// Several files as one.
struct Merged<R> {
    files: Vec<InputFile<R>>,
}

impl<R: Read> Iterator for Merged<R> {
    type Item = Result<Change, Box<Diagnostic>>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut first: Option<(f64, usize)> = None;
        for (i, file) in self.files.iter_mut().enumerate() {
            match file.peek() {
                Ok(Some(time_s)) if first.is_none_or(|(t, _)| time_s < t) => {
                    first = Some((time_s, i));
                }
                Ok(_) => {}
                Err(problem) => return Some(Err(problem.diagnostic())),
            }
        }
        let (_, i) = first?;
        self.files[i].changes.pop_front().map(Ok)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changes(texts: &[&str]) -> Result<Vec<Change>, Problem> {
        let bytes = |text: &str| io::Cursor::new(text.to_owned());
        let files: Vec<_> = texts.iter().map(|t| ("a.csv", move || Ok(bytes(t)))).collect();
        let machine = Machine::builtin(&[]).unwrap().0;
        Ok(open(&files, &machine)?.map(Result::unwrap).collect())
    }

    fn change(time_s: f64, signal: Signal, value: f64) -> Change {
        Change::new(time_s, signal, value).unwrap()
    }

    #[test]
    fn rows_become_changes() {
        let text =
            "\u{feff}t_s, override_percent,feedhold,y_add_mm\r\n0,50,0,\r\n\r\n0.25,,1,-1.5e-1\r\n";
        let expected = [
            change(0.0, Signal::Override, 50.0),
            change(0.0, Signal::Feedhold, 0.0),
            change(0.25, Signal::Feedhold, 1.0),
            change(0.25, Signal::Additional(1), -0.15),
        ];
        assert_eq!(changes(&[text]).unwrap(), expected);
        // as spreadsheets write it
        let quoted = "\"t_s\",\"override_percent\",feedhold,Y_add_mm\n\"0\",\"50\",\"0\",\"\"\n0.25,,1,\"-0.15\"\n";
        assert_eq!(changes(&[quoted]).unwrap(), expected);
        assert_eq!(changes(&["t_s,feedhold\n"]).unwrap(), []);
    }

    #[test]
    fn files_are_merged_by_time() {
        let (a, b) = ("t_s,feedhold\n0.1,1\n0.3,0\n", "t_s,X_force_mm_s2\n0.2,5\n");
        let expected = [
            change(0.1, Signal::Feedhold, 1.0),
            change(0.2, Signal::Force(0), 5.0),
            change(0.3, Signal::Feedhold, 0.0),
        ];
        assert_eq!(changes(&[a, b]).unwrap(), expected);
        assert_eq!(changes(&[b, a]).unwrap(), expected);
    }

    /// Line and column of the first error.
    #[test]
    fn mistakes_have_a_place() {
        for (text, line, column, marked) in [
            ("", 1, 1, 1),
            ("t_s\n0\n", 1, 1, 3),
            ("time,feedhold\n", 1, 1, 4),
            ("t_s,feedhold, X_foo_mm\n", 1, 15, 8),
            ("t_s,feedhold,feedhold\n", 1, 14, 8),
            ("t_s,feedhold\n0,1\n0,0\n", 3, 1, 1),
            ("t_s,feedhold\n-1,1\n", 2, 1, 2),
            ("t_s,feedhold\nnan,1\n", 2, 1, 3),
            ("t_s,feedhold\n0,  yes\n", 2, 5, 3),
            ("t_s,feedhold\n0,0.5\n", 2, 3, 3),
            ("t_s,override_percent\n0,201\n", 2, 3, 3),
            ("t_s,feedhold\n0,1,1\n", 2, 1, 5),
            ("t_s,feedhold\n0\n", 2, 1, 1),
        ] {
            let Err(Problem::Wrong(found)) = changes(&[text]) else { panic!("{text:?}") };
            let place = found.source.as_ref().unwrap();
            assert_eq!(
                (place.line, place.column, place.length),
                (line, column, marked),
                "{text:?}"
            );
            assert_eq!(found.id.to_string(), "K-0076");
        }
        let twice = changes(&["t_s,feedhold\n", "t_s,feedhold\n"]);
        assert!(matches!(twice, Err(Problem::Wrong(_))));
        let long = format!("t_s,feedhold\n0,{}\n", "1".repeat(70_000));
        assert!(matches!(changes(&[&long]), Err(Problem::Wrong(_))));
        let machine = Machine::builtin(&[]).unwrap().0;
        let missing = || Err::<&[u8], _>(io::ErrorKind::NotFound.into());
        assert!(matches!(open(&[("a.csv", missing)], &machine), Err(Problem::Io(..))));
    }
}
