//! Reader and writer of parameter lists in the vendor's text format.
//!
//! One entry per line, key and value separated by blanks; `#` at the start of a line and any text after a value are
//! comments. Errors never stop the reader: unusable entries are reported and left out.
//! Source: examples of the TF5200 manuals, rules of the start-up and parameter manuals.
//!
//! Order of calls: read a text into entries, whose keys are looked up and whose values are read; write a list from
//! entries again.
//!
//! ```
//! use kontur_interpreter::machine::lists::{read, write};
//! use kontur_interpreter::machine::table::ListKind;
//!
//! let text = b"# an axis\ngetriebe[0].kv 5000   gain\nno_such.key 1\n";
//! let mut said = Vec::new();
//! let list = read(ListKind::Axis, "x.lis", text, &mut said);
//! assert_eq!((list.entries[0].key().as_str(), said.len()), ("getriebe[0].kv", 1));
//! assert_eq!(write(&list), "getriebe[0].kv  5000\n");
//! ```

mod line;

use super::key::Key;
use super::table::{self, Indices, ListKind, Raw, Row, with_indices};
use super::value::{self, Value};
use crate::diag::{Condition, Diagnostic, Id, Location, Severity, ValueKind};
use crate::suggest;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Source of the texts of lists; the library itself does not open files.
pub trait ListFiles {
    /// The bytes of a file, `None` if there is no such file. Paths use `/` and are relative to the same folder as the
    /// caller's path to the start-up list.
    ///
    /// # Errors
    /// The reason in words if the file exists but cannot be read.
    fn read(&self, path: &str) -> Result<Option<Vec<u8>>, String>;

    /// The path of a file whose name differs from `path` in case only; called if there is no file `path`. By default
    /// there is none.
    fn in_other_case(&self, _path: &str) -> Option<String> {
        None
    }
}

/// A file from [`ListFiles`], found under its path or under one that differs in case.
pub(super) struct Found {
    pub(super) bytes: Vec<u8>,
    /// The path under which it was found, if that differs from the requested one.
    pub(super) other_case: Option<String>,
}

/// Reads a file of the control, whose file system is not case-sensitive.
///
/// # Errors
/// As [`ListFiles::read`].
pub(super) fn find(files: &dyn ListFiles, path: &str) -> Result<Option<Found>, String> {
    if let Some(bytes) = files.read(path)? {
        return Ok(Some(Found { bytes, other_case: None }));
    }
    let Some(other) = files.in_other_case(path) else { return Ok(None) };
    Ok(files.read(&other)?.map(|bytes| Found { bytes, other_case: Some(other) }))
}

/// One entry of a list.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Row of the table.
    pub row: &'static Row,
    /// Indices of the key.
    pub indices: Indices,
    /// Value in the units of the list.
    pub value: Value,
    /// Position of the entry: the key and the value.
    pub at: Location,
}

impl Entry {
    /// Key with its indices.
    pub fn key(&self) -> String {
        with_indices(self.row.key, self.indices)
    }
}

/// A list: its known entries in the order of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct List {
    /// Which list it is.
    pub kind: ListKind,
    /// Entries, each parameter at most once.
    pub entries: Vec<Entry>,
}

/// Number of messages of one kind that are shown for a list; more are only counted.
const SAID_MAX: u32 = 20;

/// Number of unknown keys that are listed in one message; beyond that their structures are listed.
const NAMED_UNKNOWN: usize = 12;

/// Number of structures that are listed; more are only counted.
const NAMED_STRUCTURES: usize = 30;

/// Reads a list. Diagnostics: 1001119 unknown element, 1030 index of a start-up list beyond its array, 1001138 bad number, K-0028 key twice, K-0029 empty index,
/// K-0030 second word after a text, K-0071 line that is not an entry, K-0072 end mark.
pub fn read(kind: ListKind, file: &str, bytes: &[u8], diagnostics: &mut Vec<Diagnostic>) -> List {
    let mut reader = Reader {
        kind,
        list: BTreeMap::new(),
        order: 0,
        unknown: BTreeMap::new(),
        said: BTreeMap::new(),
        diagnostics,
    };
    let file: Arc<str> = file.into();
    let mut end = None;
    for line in line::lines(bytes) {
        let text = line.text.trim();
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        if let Some(at) = end {
            let message = "the list ends here: what follows the end mark is not read";
            reader.diagnostics.push(Diagnostic::new(Condition::ListEnd, message).at(at));
            break;
        }
        if text.eq_ignore_ascii_case("ende") || text.eq_ignore_ascii_case("end") {
            end = Some(line.location(&file, text));
            continue;
        }
        reader.entry(&line, text, &file);
    }
    reader.report_unknown();
    reader.count_hidden();
    let mut entries: Vec<(usize, Entry)> = reader.list.into_values().collect();
    entries.sort_by_key(|(order, _)| *order);
    List { kind, entries: entries.into_iter().map(|(_, entry)| entry).collect() }
}

struct Reader<'a> {
    kind: ListKind,
    list: BTreeMap<(&'static str, Indices), (usize, Entry)>,
    order: usize,
    unknown: BTreeMap<String, (u32, Location)>,
    said: BTreeMap<Id, Said>,
    diagnostics: &'a mut Vec<Diagnostic>,
}

/// Number of messages of one kind so far.
#[derive(Default)]
struct Said {
    shown: u32,
    hidden: u32,
    first_hidden: Option<Diagnostic>,
}

impl Reader<'_> {
    /// Shows a message unless there are too many of its kind.
    fn say(&mut self, message: Diagnostic) {
        let said = self.said.entry(message.id).or_default();
        if said.shown < SAID_MAX {
            said.shown += 1;
            self.diagnostics.push(message);
        } else {
            said.first_hidden.get_or_insert(message);
            said.hidden += 1;
        }
    }

    /// Reports the number of messages that were not shown.
    fn count_hidden(&mut self) {
        for (_, said) in std::mem::take(&mut self.said) {
            if let Some(mut message) = said.first_hidden {
                if said.hidden > 1 {
                    message.text = format!("{} (and {} more)", message.text, said.hidden - 1);
                }
                self.diagnostics.push(message);
            }
        }
    }

    fn entry(&mut self, line: &line::Line<'_>, text: &str, file: &Arc<str>) {
        let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        let key_at = line.location(file, word);
        let Some((row, indices)) = self.row_of(word, &key_at) else { return };
        let parts = line::value(row.raw, rest.trim());
        let Some(written) = parts.value else {
            let message = format!("`{word}` has no value, the line is ignored");
            self.say(Diagnostic::new(Condition::ListEntry, message).at(key_at));
            return;
        };
        let value_at =
            if written.is_empty() { key_at.clone() } else { line.location(file, written) };
        if let Some(dropped) = parts.dropped {
            self.say(dropped_text(row, word, dropped).at(line.location(file, dropped)));
        }
        let indices = if row.repeated {
            [self.list.keys().filter(|(key, _)| *key == row.key).count() as u32, 0]
        } else {
            indices
        };
        let value = match value::read(row.raw, written) {
            Ok(value) => value,
            Err(bad) => {
                self.say(bad_value(row, word, &bad, written).at(value_at.clone()));
                match bad.instead {
                    Some(value) => value,
                    None => return,
                }
            }
        };
        let mut at = value_at;
        // the mark extends from the key to the end of the value
        at.length = at.column + at.length - key_at.column;
        (at.column, at.offset) = (key_at.column, key_at.offset);
        self.take(Entry { row, indices, value, at }, key_at);
    }

    /// The parameter with this key, and its indices; a message if there is none.
    fn row_of(&mut self, word: &str, key_at: &Location) -> Option<(&'static Row, Indices)> {
        let Some(key) = Key::parse(word) else {
            let message = format!("`{word}` is not a key, the line is ignored");
            let hint = "write a key, at least one blank and a value; start comments with #";
            self.say(Diagnostic::new(Condition::ListEntry, message).at(key_at.clone()).hint(hint));
            return None;
        };
        let found = key.resolve(self.kind);
        if found.is_none() {
            if let Some(beyond) = key.beyond(self.kind) {
                let message = format!("`{word}` is ignored: {beyond}");
                let condition = match self.kind {
                    ListKind::StartUp => Condition::ListIndexRange,
                    _ => Condition::ListKeyUnknown,
                };
                self.say(
                    Diagnostic::new(condition, message)
                        .value(ValueKind::Identification, 1, "-")
                        .at(key_at.clone()),
                );
            } else {
                self.unknown.entry(key.shape).or_insert((0, key_at.clone())).0 += 1;
            }
            return None;
        }
        if key.empty_index {
            let message = format!("empty index in `{word}`, read as 0");
            self.say(Diagnostic::new(Condition::ListIndex, message).at(key_at.clone()));
        }
        found
    }

    /// Keeps an entry; the last one with the same key counts.
    fn take(&mut self, entry: Entry, key_at: Location) {
        let (row, indices) = (entry.row, entry.indices);
        if let Some((_, earlier)) = self.list.get(&(row.key, indices)) {
            let message = format!(
                "`{}` occurs twice in this list, the value of line {} is replaced",
                entry.key(),
                earlier.at.line
            );
            self.say(Diagnostic::new(Condition::ListDuplicate, message).parameter(row).at(key_at));
        }
        self.order += 1;
        self.list.insert((row.key, indices), (self.order, entry));
    }

    /// 1001119: a key that resembles a known one is reported separately, the others together.
    fn report_unknown(&mut self) {
        let mut plain: Vec<(String, u32, Location)> = Vec::new();
        for (shape, (count, at)) in std::mem::take(&mut self.unknown) {
            match table::misspelt(Some(self.kind), &shape).first() {
                Some(near) => {
                    let message = format!("unknown element `{shape}`, ignored");
                    let hint = format!("did you mean `{near}`?");
                    self.say(
                        Diagnostic::new(Condition::ListKeyUnknown, message)
                            .value(ValueKind::Identification, count, "-")
                            .at(at)
                            .hint(hint),
                    );
                }
                None => plain.push((shape, count, at)),
            }
        }
        plain.sort_by_key(|(_, _, at)| at.line);
        let total: u32 = plain.iter().map(|(_, count, _)| count).sum();
        let mut names: Vec<&str> = plain.iter().map(|(shape, _, _)| shape.as_str()).collect();
        let Some((_, _, first)) = plain.first() else { return };
        let more = names.split_off(names.len().min(NAMED_UNKNOWN));
        let mut message = format!(
            "{total} unknown element{}, ignored: {}",
            if total == 1 { "" } else { "s" },
            names.join(", ")
        );
        if !more.is_empty() {
            message = format!("{message} and {} more: {}", more.len(), structures(&more));
        }
        self.diagnostics.push(
            Diagnostic::new(Condition::ListKeyUnknown, message)
                .value(ValueKind::Identification, total, "-")
                .at(first.clone()),
        );
    }
}

/// The structures of keys with the number of their keys, in the order of the list: `handbetrieb (12), kenngr (3)`.
fn structures(shapes: &[&str]) -> String {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    let mut others = 0;
    for shape in shapes {
        let name = shape.split(['.', '[']).next().unwrap_or(shape);
        match counts.iter().position(|(known, _)| *known == name) {
            Some(place) => counts[place].1 += 1,
            None if counts.len() < NAMED_STRUCTURES => counts.push((name, 1)),
            None => others += 1,
        }
    }
    let mut named: Vec<String> =
        counts.iter().map(|(name, count)| format!("{name} ({count})")).collect();
    if others > 0 {
        named.push(format!("others ({others})"));
    }
    named.join(", ")
}

/// Text after a value, which is not read.
fn dropped_text(row: &Row, word: &str, dropped: &str) -> Diagnostic {
    let message = format!("`{dropped}` after the value of `{word}` is dropped");
    let hint = match row.raw {
        Raw::Flags(_) => "join flags with |: VEL | ACC",
        Raw::Text => "put text with blanks in double quotes, start a comment with (",
        _ => "write a number without blanks, start a comment with #",
    };
    Diagnostic::new(Condition::ListString, message).hint(hint)
}

/// 1001138 for a value that could not be read.
pub(super) fn bad_value(
    row: &Row,
    entry: &str,
    bad: &value::BadValue,
    written: &str,
) -> Diagnostic {
    let instead = match &bad.instead {
        Some(value) => format!("{} is used", value::write(row.raw, value)),
        None => "the earlier value is kept".to_owned(),
    };
    let mut diagnostic =
        Diagnostic::new(Condition::ListNumber, format!("{entry}: {}, {instead}", bad.reason))
            .severity(Severity::Warning)
            .value(ValueKind::Wrong, written, "-");
    if let Some(Value::Number(x)) = bad.instead {
        diagnostic = diagnostic.value(ValueKind::Corrected, x, row.unit).corrected(x);
    }
    if written == "=" {
        diagnostic = diagnostic.hint("write key, blank and value, without an equals sign");
    } else if let Raw::Names(_) | Raw::Word(_) = row.raw {
        let names: Vec<&str> = match row.raw {
            Raw::Names(names) => names.iter().map(|(name, _)| *name).collect(),
            Raw::Word(words) => words.to_vec(),
            _ => Vec::new(),
        };
        let near = suggest::hint(written, names);
        diagnostic = diagnostic.hint(near.unwrap_or_else(|| "write one of these names".to_owned()));
    }
    diagnostic.parameter(row)
}

/// The text of a list; reading it gives the same entries.
pub fn write(list: &List) -> String {
    let mut text = String::new();
    for entry in &list.entries {
        text.push_str(&entry.key());
        text.push_str("  ");
        text.push_str(&value::write(entry.row.raw, &entry.value));
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests;
