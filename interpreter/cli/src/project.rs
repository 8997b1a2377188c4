//! The files of a TwinCAT project given by `-m`.

use crate::error::OpenError;
use crate::files::in_other_case;
use crate::lists::Lists;
use kontur_interpreter::diag::{Condition, Diagnostic};
use kontur_interpreter::machine::project::Part;
use std::fmt::Write as _;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// Name of the start-up list of a folder of lists.
const START_UP: &str = "hochlauf.lis";
/// Folder next to a project that contains its parts in separate files.
const CONFIGURATION: &str = "_Config";
/// Number of folder levels from a solution to its projects.
const SOLUTION_LEVELS: usize = 3;

/// Location of the lists of a machine.
pub(crate) enum Place {
    /// A start-up list.
    StartUp(PathBuf),
    /// A project, and its files.
    Project {
        /// Its name in messages.
        name: PathBuf,
        /// Its files.
        paths: Vec<PathBuf>,
    },
}

impl Place {
    /// What `-m` refers to: a start-up list, a project, or a folder with one of them or with exported items.
    ///
    /// # Errors
    /// A folder with several projects, or one that cannot be read.
    pub(crate) fn of(named: &Path) -> Result<Self, OpenError> {
        if !named.is_dir() {
            return Ok(match extension(named).as_str() {
                "tsproj" => Self::project(named.to_owned())?,
                "xti" => Self::Project { name: named.to_owned(), paths: vec![named.to_owned()] },
                _ => Self::StartUp(named.to_owned()),
            });
        }
        let start_up = named.join(START_UP);
        if start_up.exists() {
            return Ok(Self::StartUp(start_up));
        }
        if let Some(start_up) = in_other_case(&start_up) {
            return Ok(Self::StartUp(start_up));
        }
        let mut projects = files(named, 1, "tsproj")?;
        if projects.is_empty() {
            // the folder of a solution, with projects in subfolders
            projects = files(named, SOLUTION_LEVELS, "tsproj")?;
        }
        if projects.len() > 1 {
            let names: Vec<String> =
                projects.iter().map(|path| path.display().to_string()).collect();
            let text = format!(
                "{} contains several projects, name one of them: {}",
                named.display(),
                names.join(", ")
            );
            return Err(OpenError::Usage(text));
        }
        if let Some(project) = projects.pop() {
            return Self::project(project);
        }
        let paths = files(named, usize::MAX, "xti")?;
        let name = named.join("*.xti");
        Ok(if paths.is_empty() { Self::StartUp(start_up) } else { Self::Project { name, paths } })
    }

    /// A project with the files of its configuration, in the order of their names.
    fn project(name: PathBuf) -> Result<Self, OpenError> {
        let folder = name.parent().unwrap_or_else(|| Path::new("")).join(CONFIGURATION);
        let parts = if folder.is_dir() { files(&folder, usize::MAX, "xti")? } else { Vec::new() };
        Ok(Self::Project { paths: [name.clone()].into_iter().chain(parts).collect(), name })
    }
}

fn extension(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

/// Files of a folder with an extension, sorted so that `Axis 2` comes before `Axis 10`.
fn files(folder: &Path, depth: usize, wanted: &str) -> Result<Vec<PathBuf>, OpenError> {
    let mut found = Vec::new();
    for entry in WalkDir::new(folder).max_depth(depth) {
        let entry = entry.map_err(|e| OpenError::Io(folder.to_owned(), e.into()))?;
        if entry.file_type().is_file() && extension(entry.path()) == wanted {
            found.push(entry.into_path());
        }
    }
    found.sort_by_cached_key(|path| natural(&path.to_string_lossy()));
    Ok(found)
}

/// A key that sorts numbers by value: all are padded to the same number of digits.
fn natural(text: &str) -> String {
    let mut key = String::new();
    let mut digits = String::new();
    for c in text.chars().chain(['\0']) {
        if c.is_ascii_digit() {
            digits.push(c);
            continue;
        }
        if !digits.is_empty() {
            let _ = write!(key, "{digits:0>20}");
            digits.clear();
        }
        key.push(c);
    }
    key
}

/// The texts of the files of a project, registered in `lists` as read.
///
/// # Errors
/// For a file that cannot be read, is too long or is not UTF-8.
pub(crate) fn parts(paths: Vec<PathBuf>, lists: &Lists) -> Result<Vec<Part>, OpenError> {
    let of = |path: PathBuf| {
        let text = lists.project(&path).map_err(|e| match e.kind() {
            ErrorKind::InvalidData => OpenError::Lists(vec![no_utf8(&path)]),
            _ => OpenError::Io(path.clone(), e),
        })?;
        Ok(Part { name: path.display().to_string(), text })
    };
    paths.into_iter().map(of).collect()
}

/// K-0141 for another encoding.
fn no_utf8(path: &Path) -> Diagnostic {
    let message = format!("{}: the text is not UTF-8", path.display());
    Diagnostic::new(Condition::ProjectWrong, message)
        .hint("the engineering tool writes UTF-8; save the file in this encoding")
}
