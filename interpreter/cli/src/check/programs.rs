//! The programs to be checked: files as given, and the contents of folders.

use crate::error::Error;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use walkdir::WalkDir;

/// Extension of the programs that a folder is searched for.
const EXTENSION: &str = "nc";

/// A program that may have to be checked.
pub(super) struct Program {
    pub(super) path: PathBuf,
    /// Whether it was found in a folder rather than given.
    pub(super) of_folder: bool,
}

/// The programs of the command line in order; a folder gives every `.nc` file below it, sorted by name. Links to
/// folders are not followed, and hidden folders are left out.
///
/// # Errors
/// [`Error::Usage`] for a folder without a program, [`Error::Io`] for one that cannot be read.
pub(super) fn find(named: &[PathBuf]) -> Result<Vec<Program>, Error> {
    let mut programs = Vec::new();
    for path in named {
        if !path.is_dir() {
            programs.push(Program { path: path.clone(), of_folder: false });
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
                programs.push(Program { path: entry.into_path(), of_folder: true });
            }
        }
        if programs.len() == before {
            let text = format!("{}: no .{EXTENSION} file in this folder", path.display());
            return Err(Error::Usage(text));
        }
    }
    Ok(programs)
}

/// The programs that are only subroutines: they were found in a folder, and another program calls them. They have been
/// checked with the caller; on their own they lack an F word or parameters that it sets. `files` are the files of each
/// check, its own first. Two programs that call each other are not subroutines.
pub(super) fn subroutines<'a>(
    programs: &[Program],
    files: impl Iterator<Item = &'a [Arc<str>]>,
) -> Vec<bool> {
    let real = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let own: Vec<PathBuf> = programs.iter().map(|p| real(&p.path)).collect();
    let reads: Vec<HashSet<PathBuf>> = files
        .map(|files| files.iter().skip(1).map(|file| real(Path::new(&**file))).collect())
        .collect();
    let is_called = |i: usize| {
        reads.iter().zip(&own).any(|(of_caller, caller)| {
            *caller != own[i] && of_caller.contains(&own[i]) && !reads[i].contains(caller)
        })
    };
    programs.iter().enumerate().map(|(i, program)| program.of_folder && is_called(i)).collect()
}

fn unreadable(folder: &Path, e: walkdir::Error) -> Error {
    let what = e.path().unwrap_or(folder).display().to_string();
    let reason = e.to_string();
    Error::io(what, e.into_io_error().unwrap_or_else(|| std::io::Error::other(reason)))
}
