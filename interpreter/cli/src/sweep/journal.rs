//! The finished rows of a running sweep, so that a stopped one continues where it stopped.
//!
//! A file of JSON lines, `NAME.rows` next to the output NAME. The first line identifies the sweep, every other line is
//! a row, written when its run has ended. A journal of another sweep, or of files that have changed since, is started
//! again.

use super::rows::Row;
use crate::args::SweepArgs;
use crate::error::Error;
use crate::files::is_standard;
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::hash::{BuildHasher as _, DefaultHasher, Hasher as _, RandomState};
use std::io::{self, BufRead as _, BufReader, Read as _, Write as _};
use std::path::{Path, PathBuf};

/// The beginning of every journal, which no program or table has.
const HEAD: &[u8] = b"{\"files\":[";

/// The journal of one sweep.
pub(super) struct Journal {
    path: PathBuf,
    file: File,
    rows: Vec<(usize, Row)>,
}

#[derive(Serialize, Deserialize)]
struct Line {
    run: usize,
    row: Row,
}

impl Journal {
    /// Opens the journal and reads the rows of an earlier, identical sweep.
    ///
    /// # Errors
    /// The system's; also if the file is not a journal.
    pub(super) fn open(path: &Path, args: &SweepArgs, reads: &[PathBuf]) -> Result<Self, Error> {
        let head = head(args, reads);
        Self::begin(path.to_owned(), &head).map_err(|e| Error::io(path.display().to_string(), e))
    }

    fn begin(path: PathBuf, head: &str) -> io::Result<Self> {
        let (mut rows, mut kept) = (Vec::new(), 0);
        if let Ok(mut file) = File::open(&path) {
            let mut start = Vec::new();
            io::Read::take(&file, HEAD.len() as u64).read_to_end(&mut start)?;
            if !HEAD.starts_with(&start) {
                return Err(io::Error::other("not the journal of a sweep: left unchanged"));
            }
            io::Seek::rewind(&mut file)?;
            let mut lines = BufReader::new(file);
            let mut line = String::new();
            // a line without its end was cut off
            while lines.read_line(&mut line)? > 0 && line.ends_with('\n') {
                let text = line.trim_end();
                if kept == 0 && text != head {
                    break;
                }
                if kept > 0 {
                    let Ok(Line { run, row }) = serde_json::from_str(text) else { break };
                    rows.push((run, row));
                }
                kept += line.len() as u64;
                line.clear();
            }
        }
        let mut file = File::options().create(true).truncate(false).write(true).open(&path)?;
        file.set_len(kept)?;
        io::Seek::seek(&mut file, io::SeekFrom::End(0))?;
        if kept == 0 {
            writeln!(file, "{head}")?;
        }
        Ok(Self { path, file, rows })
    }

    /// Number of the run and row of everything that an earlier sweep finished.
    pub(super) fn take_rows(&mut self) -> Vec<(usize, Row)> {
        std::mem::take(&mut self.rows)
    }

    /// Adds a row.
    ///
    /// # Errors
    /// The system's, e.g. a full disk.
    pub(super) fn write(&mut self, run: usize, row: &Row) -> Result<(), Error> {
        let line = serde_json::to_string(&Line { run, row: row.clone() }).unwrap_or_default();
        // in one piece, so that a kill leaves whole lines
        let written = self.file.write_all(format!("{line}\n").as_bytes());
        written.map_err(|e| Error::io(self.path.display().to_string(), e))
    }

    /// Removes the journal, once the rows are in the outputs.
    pub(super) fn remove(self) {
        drop(self.file);
        // a remaining file does no harm, as it identifies its sweep
        let _ = std::fs::remove_file(&self.path);
    }
}

/// The journal of an output.
pub(super) fn beside(output: &Path) -> PathBuf {
    let mut name = output.file_name().unwrap_or_default().to_owned();
    name.push(".rows");
    output.with_file_name(name)
}

/// A hash of the contents of a file, because a changed one may have the size and the time of the old one.
fn contents(path: &Path) -> Option<u64> {
    if !path.metadata().ok()?.is_file() {
        return None;
    }
    let mut file = BufReader::new(File::open(path).ok()?);
    let mut hasher = DefaultHasher::new();
    loop {
        let piece = file.fill_buf().ok()?;
        if piece.is_empty() {
            return Some(hasher.finish());
        }
        hasher.write(piece);
        let length = piece.len();
        file.consume(length);
    }
}

/// The identity of a sweep: the version, the options, and the contents of the files.
fn head(args: &SweepArgs, reads: &[PathBuf]) -> String {
    let mut reads = reads.to_vec();
    reads.sort();
    let files: Vec<String> = reads
        .iter()
        .map(|path| match contents(path) {
            Some(contents) => format!("{} {contents:016x}", path.display()),
            // what can be read only once is another one the next time
            None if is_standard(path) || path.exists() => {
                let any = RandomState::new().build_hasher().finish();
                format!("{} {any:016x}", path.display())
            }
            None => path.display().to_string(),
        })
        .collect();
    let options =
        format!("{:?}", (&args.vary, &args.columns, &args.amplitude, args.shard, &args.simulation));
    let version = env!("CARGO_PKG_VERSION");
    serde_json::json!({ "sweep": version, "options": options, "files": files }).to_string()
}

#[cfg(test)]
mod tests {
    use super::{Journal, head};
    use crate::args::SweepArgs;
    use crate::table::Cell;
    use clap::Parser as _;

    const HEADS: [&str; 2] = ["{\"files\":[1]}", "{\"files\":[2]}"];

    fn sweep() -> SweepArgs {
        let words = ["kontur", "sweep", "a.nc", "--vary", "X.a=1", "-o", "a.csv"];
        let args = crate::args::Args::try_parse_from(words).unwrap();
        let crate::args::Command::Sweep(args) = args.command else { panic!("sweep") };
        args
    }

    #[test]
    fn what_is_no_journal_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv.rows");
        let head = head(&sweep(), &["a.nc".into()]);
        for (text, is_journal) in [("", true), ("{\"fil", true), (&*head, true), ("G01 X1", false)]
        {
            std::fs::write(&path, text).unwrap();
            assert_eq!(Journal::begin(path.clone(), &head).is_ok(), is_journal, "{text}");
        }
        assert_eq!(std::fs::read(&path).unwrap(), b"G01 X1");
    }

    /// Another text of the same length and time, and a program that is read only once.
    #[test]
    fn a_changed_program_is_another_sweep() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.nc");
        let args = sweep();
        let time = std::time::UNIX_EPOCH;
        let written = |text: &str| {
            std::fs::write(&path, text).unwrap();
            std::fs::File::options().write(true).open(&path).unwrap().set_modified(time).unwrap();
            head(&args, std::slice::from_ref(&path))
        };
        let before = written("G01 X1 F3000");
        assert_ne!(before, written("G01 X1 F2000"));
        assert_eq!(before, written("G01 X1 F3000"));
        assert_ne!(head(&args, &["-".into()]), head(&args, &["-".into()]));
    }

    #[test]
    fn what_was_cut_off_is_done_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv.rows");
        let row = |x: f64| {
            (vec!["a".to_owned(), "b".to_owned()], vec![Cell::Number(x, 3), Cell::Word("w".into())])
        };
        let mut journal = Journal::begin(path.clone(), HEADS[0]).unwrap();
        for (run, x) in [(2, 0.1), (0, f64::NAN), (7, -1e-300)] {
            journal.write(run, &row(x)).unwrap();
        }
        drop(journal);
        let whole = std::fs::read(&path).unwrap();
        for cut in 0..=whole.len() {
            std::fs::write(&path, &whole[..cut]).unwrap();
            let lines = memchr::memchr_iter(b'\n', &whole[..cut]).count();
            let mut journal = Journal::begin(path.clone(), HEADS[0]).unwrap();
            let found = journal.take_rows();
            assert_eq!(found.len(), lines.saturating_sub(1), "{cut}");
            if let Some((run, (_, cells))) = found.last()
                && found.len() == 3
            {
                let Cell::Number(x, 3) = cells[0] else { panic!() };
                assert_eq!((*run, x.to_bits()), (7, (-1e-300_f64).to_bits()));
            }
            // and continues after the last whole line
            journal.write(9, &row(4.0)).unwrap();
            let again = Journal::begin(path.clone(), HEADS[0]).unwrap().take_rows();
            assert_eq!(again.len(), lines.saturating_sub(1) + 1);
        }
        assert!(Journal::begin(path, HEADS[1]).unwrap().take_rows().is_empty());
    }
}
