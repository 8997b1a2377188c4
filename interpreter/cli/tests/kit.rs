//! The command line as called by tests: without a process and a terminal.

use kontur::console::Console;
use kontur::{Exit, run_with};
use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use tempfile::TempDir;

#[derive(Clone, Default)]
struct Buffer(Arc<Mutex<Vec<u8>>>);

impl Write for Buffer {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// A square of 1 mm, executed three times: with exact stops, with its corners rounded by the guard, and without a guard.
pub(crate) const CORNER: &str = "\
N10 G01 F3600
N20 G90
N30 #VIB GUARD ON [MODE=1 FREQ=30]
N40 G60 X1
N50 G60 Y1
N60 G60 X0
N70 G60 Y0
N80 F3600
N90 X1
N100 Y1
N110 X0
N120 Y0
N130 #VIB GUARD OFF
N140 X1
N150 Y1
N160 X0
N170 Y0
N180 M30
";

/// A folder with programs, and the command line over it.
pub(crate) struct Folder(TempDir);

impl Folder {
    /// The folder with its programs.
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        // the last edge of the first pass at a lower feed rate; an error; a guard in the lists
        for (name, text) in [
            ("corner.nc", CORNER.to_owned()),
            ("slow.nc", CORNER.replace("N70 G60 Y0", "N70 G60 Y0 F600")),
            ("listed.nc", CORNER.replace(" #VIB GUARD ON [MODE=1 FREQ=30]", " G90")),
            ("bad.nc", CORNER.replace("N60 G60 X0", "N60 G777 X0")),
        ] {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        Self(folder)
    }

    /// A file in it.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Calls a command and returns exit code, stdout and stderr. Words that start with `@` are files in the folder.
    pub(crate) fn call(&self, words: &[&str]) -> (Exit, String, String) {
        let (out, err) = (Buffer::default(), Buffer::default());
        let mut console = Console::new(out.clone(), err.clone());
        let word = |w: &&str| match w.strip_prefix('@') {
            Some(name) => self.path(name).into_os_string(),
            None => OsString::from(w),
        };
        let args = std::iter::once(OsString::from("kontur")).chain(words.iter().map(word));
        let exit = run_with(args, &mut console);
        let text = |b: &Buffer| String::from_utf8(b.0.lock().unwrap().clone()).unwrap();
        (exit, text(&out), text(&err))
    }

    /// The same with the words of a line.
    pub(crate) fn line(&self, line: &str) -> (Exit, String, String) {
        self.call(&line.split_whitespace().collect::<Vec<_>>())
    }

    /// Text of a file in it.
    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap()
    }
}
