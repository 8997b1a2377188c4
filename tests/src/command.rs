//! The command line as a test calls it: the input, and the printed output.

use kontur::console::Console;
use kontur::{Exit, run_with};
use kontur_kit::rows::settings;
use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use tempfile::TempDir;

/// Result of a command.
#[derive(Debug)]
pub struct Output {
    /// Exit code.
    pub exit: Exit,
    /// Output on stdout.
    pub out: String,
    /// Its messages.
    pub err: String,
}

#[derive(Clone, Default)]
struct Buffer(Arc<Mutex<Vec<u8>>>);

impl Buffer {
    fn text(&self) -> String {
        String::from_utf8(std::mem::take(&mut *self.0.lock().unwrap())).unwrap()
    }
}

impl Write for Buffer {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// A folder for the files of a test, and the command line over it.
#[derive(Debug)]
pub struct Folder(TempDir);

impl Folder {
    /// A folder with files.
    pub fn new(files: &[(&str, &str)]) -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        files.iter().fold(folder, |folder, (name, text)| folder.with(name, text))
    }

    /// With a file more, perhaps in a folder of its own.
    #[must_use]
    pub fn with(self, name: &str, text: impl AsRef<[u8]>) -> Self {
        let path = self.0.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
        self
    }

    /// Path of a file in it.
    pub fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().unwrap().to_owned()
    }

    /// Text of a file in it.
    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap()
    }

    /// A table in it.
    pub fn table(&self, name: &str) -> Table {
        let mut reader = csv::Reader::from_path(self.path(name)).unwrap();
        let names = reader.headers().unwrap().clone();
        Table { names, rows: reader.records().map(Result::unwrap).collect() }
    }

    /// Runs `kontur`; words that start with `@` are files of the folder.
    pub fn call(&self, words: &[impl AsRef<str>]) -> Output {
        let word = |word: &str| word.strip_prefix('@').map_or(word.to_owned(), |f| self.path(f));
        command(words.iter().map(|it| word(it.as_ref())))
    }

    /// The summary of a run of `part.nc` that finishes.
    pub fn summary(&self, more: &[impl AsRef<str>]) -> serde_json::Value {
        let words = ["run", "@part.nc", "--summary", "json"].into_iter();
        let words: Vec<&str> = words.chain(more.iter().map(AsRef::as_ref)).collect();
        let done = self.call(&words);
        assert_eq!(done.exit, Exit::Finished, "{}", done.err);
        serde_json::from_str(&done.out).unwrap()
    }
}

/// Settings in the form of the tables as words of the command line.
pub fn set(text: &str) -> Vec<String> {
    settings(text).into_iter().flat_map(|setting| ["--set".to_owned(), setting]).collect()
}

/// A table with a header.
#[derive(Debug)]
pub struct Table {
    names: csv::StringRecord,
    rows: Vec<csv::StringRecord>,
}

impl Table {
    /// The cells of a column.
    pub fn texts(&self, name: &str) -> Vec<&str> {
        let place = self.names.iter().position(|n| n == name).expect(name);
        self.rows.iter().map(|row| &row[place]).collect()
    }

    /// The numbers of a column.
    pub fn numbers(&self, name: &str) -> Vec<f64> {
        self.texts(name).into_iter().map(|cell| cell.parse().unwrap()).collect()
    }
}

/// Asserts that a number of a summary or table differs by `tolerance` at most.
#[track_caller]
pub fn near(value: &serde_json::Value, want: f64, tolerance: f64) {
    kontur_kit::near(value.as_f64().unwrap(), want, tolerance);
}

/// Runs `kontur` with the given words.
pub fn command<W: Into<OsString>>(words: impl IntoIterator<Item = W>) -> Output {
    let (out, err) = (Buffer::default(), Buffer::default());
    let mut console = Console::new(out.clone(), err.clone());
    let words = std::iter::once("kontur".into()).chain(words.into_iter().map(Into::into));
    let exit = run_with(words, &mut console);
    Output { exit, out: out.text(), err: err.text() }
}

/// A command as shown in a document, run from the root of the repository; outputs go to a folder.
pub fn run_line(line: &str, folder: &Path) -> Output {
    let root = crate::programs().join("..");
    let mut words: Vec<PathBuf> = Vec::new();
    for word in line.split_whitespace().skip(1).map(|word| word.trim_matches('\'')) {
        let output = words.last().is_some_and(|last| last.as_os_str() == "-o");
        words.push(match word {
            _ if output => folder.join(word),
            _ if word.starts_with("programs/") => root.join(word),
            _ => word.into(),
        });
    }
    command(words)
}
