//! NC programs in files, as the library reads them.

use kontur_interpreter::source::{OpenError, Source, Sources};
use std::collections::BTreeMap;
use std::fs::{File, Metadata};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

/// The name for standard input or output instead of a file.
pub(crate) const STANDARD: &str = "-";
/// The name in messages of a program from standard input.
pub(crate) const STANDARD_INPUT: &str = "<stdin>";

/// Largest program from a pipe, in bytes: 256 MiB (about ten million blocks), since it is copied to a temporary file,
/// unlike a program in a file.
const MOST_PIPED_BYTES: u64 = 1 << 28;
/// Largest program, in bytes, that is held in memory to replace its words: 64 MiB.
const MOST_HELD_BYTES: u64 = 1 << 26;

/// NC programs in files: subroutines are searched for beside the caller, beside the main program, then in the folders given;
/// the program `-` is standard input.
///
/// Clones share the files they have opened.
#[derive(Clone, Debug)]
pub(crate) struct ProgramFiles {
    /// The main program.
    program: PathBuf,
    /// Its folder: every subroutine has to be inside it or `folders`.
    home: PathBuf,
    /// Folders of global subroutines, in the order of search.
    folders: Vec<PathBuf>,
    /// Whether subroutines may be anywhere.
    anywhere: bool,
    /// Text that replaces the main program.
    text: Option<Arc<[u8]>>,
    opened: Arc<Mutex<BTreeMap<PathBuf, State>>>,
}

/// Properties that show whether a file has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct State {
    length: u64,
    modified: Option<SystemTime>,
}

impl State {
    fn of(metadata: &Metadata) -> Self {
        Self { length: metadata.len(), modified: metadata.modified().ok() }
    }
}

/// A program in a file.
struct ProgramFile {
    name: Arc<str>,
    file: File,
    state: State,
    at: u64,
}

impl Source for ProgramFile {
    fn name(&self) -> Arc<str> {
        Arc::clone(&self.name)
    }

    fn read_at(&mut self, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
        if self.at != offset {
            self.file.seek(SeekFrom::Start(offset))?;
        }
        let count = self.file.read(buffer)?;
        self.at = offset + count as u64;
        // the last bytes read may already come from the new file
        if State::of(&self.file.metadata()?) == self.state { Ok(count) } else { Err(changed()) }
    }
}

fn changed() -> io::Error {
    io::Error::other("the file was changed while it was read")
}

/// A program from a pipe.
struct PipedProgram {
    name: Arc<str>,
    copy: Arc<Mutex<File>>,
}

impl Source for PipedProgram {
    fn name(&self) -> Arc<str> {
        Arc::clone(&self.name)
    }

    fn read_at(&mut self, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
        let mut file = self.copy.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(offset))?;
        file.read(buffer)
    }
}

/// A program with a modified text.
struct TextProgram {
    name: Arc<str>,
    text: Arc<[u8]>,
}

impl Source for TextProgram {
    fn name(&self) -> Arc<str> {
        Arc::clone(&self.name)
    }

    fn read_at(&mut self, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
        let from = usize::try_from(offset).unwrap_or(usize::MAX).min(self.text.len());
        (&self.text[from..]).read(buffer)
    }
}

/// Copies a program that can be read only once (standard input, a FIFO), because it is read repeatedly: by the check,
/// by the run, and by every run of a sweep.
///
/// # Errors
/// The system's, and for more than 256 MiB.
fn piped(path: &Path) -> io::Result<Arc<Mutex<File>>> {
    static COPIES: Mutex<BTreeMap<PathBuf, Arc<Mutex<File>>>> = Mutex::new(BTreeMap::new());
    let mut copies = COPIES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(copy) = copies.get(path) {
        return Ok(Arc::clone(copy));
    }
    let mut copy = tempfile::tempfile()?;
    let source: &mut dyn Read =
        if is_standard(path) { &mut io::stdin().lock() } else { &mut File::open(path)? };
    let length = io::copy(&mut source.take(MOST_PIPED_BYTES + 1), &mut copy)?;
    if length > MOST_PIPED_BYTES {
        return Err(io::Error::other("more than 256 MiB; only files may be longer"));
    }
    copy.flush()?;
    let copy = Arc::new(Mutex::new(copy));
    copies.insert(path.to_owned(), Arc::clone(&copy));
    Ok(copy)
}

/// Whether the path is `-`, standard input or output.
pub(crate) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == STANDARD
}

/// Whether the path can only be read once, from the beginning, like a pipe.
fn is_pipe(path: &Path) -> bool {
    is_standard(path) || path.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir())
}

/// Opens a regular file; a pipe would make a reader wait, and devices are refused too.
///
/// # Errors
/// The system's, and for anything except a regular file.
pub(crate) fn regular(path: &Path) -> io::Result<File> {
    // checked before opening, which may already wait
    if !path.metadata()?.is_file() {
        return Err(io::Error::other("not a regular file"));
    }
    File::open(path)
}

/// Checks that a program on the command line is readable, so that the command fails before it decodes anything.
///
/// # Errors
/// The system's, and for more than 256 MiB from a pipe.
pub(crate) fn readable(program: &Path) -> io::Result<()> {
    if is_pipe(program) {
        return piped(program).map(|_| ());
    }
    if File::open(program)?.metadata()?.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    Ok(())
}

impl ProgramFiles {
    /// The files of a program on the command line.
    pub(crate) fn new(program: &Path, folders: Vec<PathBuf>, anywhere: bool) -> Self {
        let home = if is_pipe(program) { None } else { program.parent() };
        let home = home.unwrap_or_else(|| Path::new("")).to_owned();
        Self {
            program: program.to_owned(),
            home,
            folders,
            anywhere,
            text: None,
            opened: Arc::default(),
        }
    }

    /// The text of the main program.
    ///
    /// # Errors
    /// The system's, and for more than 64 MiB.
    pub(crate) fn text(&self) -> io::Result<Vec<u8>> {
        let name = self.program.display().to_string();
        let mut source = self.main(&name).map_err(|e| io::Error::other(e.reason))?;
        let (mut text, mut piece) = (Vec::new(), vec![0; 1 << 16]);
        loop {
            let count = source.read_at(text.len() as u64, &mut piece)?;
            text.extend_from_slice(&piece[..count]);
            match (count, text.len() as u64 > MOST_HELD_BYTES) {
                (0, _) => return Ok(text),
                (_, true) => return Err(io::Error::other("more than 64 MiB, too long for that")),
                _ => {}
            }
        }
    }

    /// The same files with a different text of the main program.
    pub(crate) fn with_text(mut self, text: Vec<u8>) -> Self {
        self.text = Some(text.into());
        self
    }

    /// The files opened so far.
    pub(crate) fn opened(&self) -> Vec<PathBuf> {
        self.opened.lock().unwrap_or_else(PoisonError::into_inner).keys().cloned().collect()
    }

    /// The main program.
    fn main(&self, name: &str) -> Result<Box<dyn Source>, OpenError> {
        // its name in messages need not be a path: file names may contain bytes that are not text
        let path = &self.program;
        let name = if is_standard(path) { STANDARD_INPUT } else { name };
        let error = |e: io::Error| OpenError {
            name: name.to_owned(),
            reason: e.to_string(),
            searched: vec![name.to_owned()],
        };
        if let Some(text) = &self.text {
            return Ok(Box::new(TextProgram { name: name.into(), text: Arc::clone(text) }));
        }
        if is_pipe(path) {
            return Ok(Box::new(PipedProgram {
                name: name.into(),
                copy: piped(path).map_err(error)?,
            }));
        }
        self.file(path).map_err(error)
    }

    fn file(&self, path: &Path) -> io::Result<Box<dyn Source>> {
        let file = regular(path)?;
        let metadata = file.metadata()?;
        let now = State::of(&metadata);
        let mut opened = self.opened.lock().unwrap_or_else(PoisonError::into_inner);
        let state = *opened.entry(path.to_owned()).or_insert(now);
        drop(opened);
        if state != now {
            return Err(changed());
        }
        Ok(Box::new(ProgramFile { name: path.display().to_string().into(), file, state, at: 0 }))
    }

    /// Whether a subroutine may be at this place: in or below the folder of the main program, or one of `--path`. For a
    /// place that does not exist only the name is checked, so that nothing about other folders is revealed.
    fn is_inside(&self, place: &Path) -> bool {
        if self.anywhere {
            return true;
        }
        let folders = || std::iter::once(&self.home).chain(&self.folders);
        let name = plain(place);
        if !folders().any(|folder| {
            name.as_ref().is_some_and(|n| n.starts_with(plain(folder).unwrap_or_default()))
        }) {
            return false;
        }
        // links may point elsewhere
        match place.canonicalize() {
            Ok(real) => folders().any(|folder| {
                let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
                folder.canonicalize().is_ok_and(|folder| real.starts_with(folder))
            }),
            Err(_) => true,
        }
    }
}

/// An absolute path without `.` and `..`; `None` if there is no such path.
fn plain(path: &Path) -> Option<PathBuf> {
    let mut plain = PathBuf::new();
    for part in std::path::absolute(path).ok()?.components() {
        match part {
            Component::ParentDir => {
                plain.pop();
            }
            Component::CurDir => {}
            part => plain.push(part),
        }
    }
    Some(plain)
}

impl Sources for ProgramFiles {
    fn open(&self, name: &str, caller: Option<&str>) -> Result<Box<dyn Source>, OpenError> {
        let Some(caller) = caller else { return self.main(name) };
        // programs written on Windows use backslashes in the names of subroutines
        let wanted = PathBuf::from(name.replace('\\', "/"));
        // a path that leads upwards starts at the caller
        let upwards = wanted.components().any(|part| part == Component::ParentDir);
        let beside = Path::new(caller).parent();
        let home = Some(&*self.home).filter(|home| !upwards && beside != Some(home));
        let folders = beside.into_iter().chain(home);
        let folders = folders.chain(self.folders.iter().map(PathBuf::as_path));
        let mut searched = Vec::new();
        let mut reason = "no such file".to_owned();
        for place in folders.map(|folder| folder.join(&wanted)) {
            if self.is_inside(&place) {
                match self.file(&place) {
                    Err(e) if e.kind() == io::ErrorKind::NotFound => {
                        match in_other_case(&place).map(|found| self.file(&found)) {
                            Some(Ok(file)) => return Ok(file),
                            Some(Err(e)) => reason = e.to_string(),
                            None => {}
                        }
                    }
                    Ok(file) => return Ok(file),
                    Err(e) => reason = e.to_string(),
                }
            } else {
                "outside the program's folder and --path; use --allow-outside to permit it"
                    .clone_into(&mut reason);
            }
            searched.push(place.display().to_string());
        }
        Err(OpenError { name: name.to_owned(), reason, searched })
    }

    fn changed(&self) -> Option<(String, io::Error)> {
        let opened = self.opened.lock().unwrap_or_else(PoisonError::into_inner);
        opened.iter().find_map(|(path, state)| match path.metadata() {
            Ok(now) if State::of(&now) == *state => None,
            Ok(_) => Some((path.display().to_string(), changed())),
            Err(e) => Some((path.display().to_string(), e)),
        })
    }
}

/// The file whose name and folders differ from the wanted ones in case only; of several in a folder the first by name.
pub(crate) fn in_other_case(place: &Path) -> Option<PathBuf> {
    /// Largest number of files in a folder that are examined.
    const LOOKED_AT: usize = 100_000;
    let wanted = place.file_name()?.to_str()?;
    let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = match folder {
        Some(folder) if !folder.is_dir() => Some(in_other_case(folder)?),
        folder => folder.map(Path::to_path_buf),
    };
    let entries = std::fs::read_dir(folder.as_deref().unwrap_or(Path::new("."))).ok()?;
    let entries = entries.take(LOOKED_AT);
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let wanted = wanted.to_lowercase();
    let found = names.filter(|name| name.to_lowercase() == wanted).min()?;
    Some(folder.map_or_else(|| PathBuf::from(&found), |folder| folder.join(&found)))
}

#[cfg(test)]
mod tests {
    use super::in_other_case;
    use std::path::{Path, PathBuf};

    /// Tests are executed in the folder of the crate.
    #[test]
    fn names_in_other_capital_letters_are_found_in_the_current_folder_too() {
        let found = |place: &str| in_other_case(Path::new(place));
        assert_eq!(found("cargo.TOML"), Some(PathBuf::from("Cargo.toml")));
        assert_eq!(found("./SRC/../cargo.toml"), None);
        assert_eq!(found("src/FILES.rs"), Some(PathBuf::from("src/files.rs")));
        assert_eq!(found("SRC/Tune/order.rs"), Some(PathBuf::from("src/tune/order.rs")));
        assert_eq!(found("SRC/no folder/order.rs"), None);
        assert_eq!(found("no such file"), None);
        let folder = tempfile::tempdir().unwrap();
        let place = |name: &str| folder.path().join(name);
        std::fs::write(place("Fräsen 1.nc"), "M30").unwrap();
        assert_eq!(in_other_case(&place("FRÄSEN 1.NC")), Some(place("Fräsen 1.nc")));
    }
}
