//! Which programs are checked: files as they are named, and what folders hold.

use crate::Error;
use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// Extension of the programs that a folder is searched for. Subroutines of other extensions are checked with the programs
/// that call them.
const EXTENSION: &str = "nc";

/// The programs of the command line in its order; a folder gives every `.nc` file below it, by name. Links to folders are
/// not followed, and hidden folders are left out.
///
/// # Errors
/// [`Error::Usage`] for a folder without a program, [`Error::Io`] for one that cannot be read.
pub(super) fn find(named: &[PathBuf]) -> Result<Vec<PathBuf>, Error> {
    let mut programs = Vec::new();
    for path in named {
        if !path.is_dir() {
            programs.push(path.clone());
            continue;
        }
        let before = programs.len();
        let hidden = |name: &std::ffi::OsStr| name.as_encoded_bytes().starts_with(b".");
        let entries = WalkDir::new(path).sort_by_file_name().into_iter();
        for entry in entries.filter_entry(|e| e.depth() == 0 || !hidden(e.file_name())) {
            let entry = entry.map_err(|e| unreadable(path, e))?;
            let is_program =
                entry.path().extension().is_some_and(|e| e.eq_ignore_ascii_case(EXTENSION));
            if is_program && entry.path().is_file() {
                programs.push(entry.into_path());
            }
        }
        if programs.len() == before {
            let text = format!("{}: no .{EXTENSION} file in this folder", path.display());
            return Err(Error::Usage(text));
        }
    }
    Ok(programs)
}

fn unreadable(folder: &Path, e: walkdir::Error) -> Error {
    let what = e.path().unwrap_or(folder).display().to_string();
    let reason = e.to_string();
    Error::io(what, e.into_io_error().unwrap_or_else(|| std::io::Error::other(reason)))
}
