//! The command line as a test calls it: the input, and the printed output.

use kontur::console::Console;
use kontur::{Exit, run_with};
use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

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
