//! The file system behind the library's two doors: NC programs and parameter lists.

use kontur_interpreter::machine::ListFiles;
use kontur_interpreter::source::{MemorySources, OpenError, Source, Sources};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// The name that stands for standard input or output in place of a file.
pub const STANDARD: &str = "-";
/// What messages call a program from standard input.
pub const STANDARD_INPUT: &str = "<stdin>";

/// Bytes on standard input at most, 256 MiB (about ten million blocks): they are kept in memory, where a file is not.
const MOST_STANDARD_BYTES: u64 = 1 << 28;

/// The program on standard input. That can be read only once, a program is read again and again: by the check, by the
/// run, and by every run of a sweep.
///
/// # Errors
/// The system's, and more than 256 MiB.
pub fn standard_input() -> io::Result<&'static MemorySources> {
    static PROGRAM: OnceLock<MemorySources> = OnceLock::new();
    if let Some(program) = PROGRAM.get() {
        return Ok(program);
    }
    let mut text = Vec::new();
    io::stdin().lock().take(MOST_STANDARD_BYTES + 1).read_to_end(&mut text)?;
    if text.len() as u64 > MOST_STANDARD_BYTES {
        let text = "more than 256 MiB; only a file may be of any length";
        return Err(io::Error::other(text));
    }
    Ok(PROGRAM.get_or_init(|| MemorySources::new().with(STANDARD_INPUT, text)))
}

/// NC programs in files: relative to the caller, then in the folders given; the program `-` is standard input.
#[derive(Clone, Debug, Default)]
pub struct ProgramFiles {
    /// Folders of global subroutines, in the order of search.
    pub folders: Vec<PathBuf>,
}

struct ProgramFile {
    name: Arc<str>,
    file: File,
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
        Ok(count)
    }
}

impl Sources for ProgramFiles {
    fn open(&self, name: &str, caller: Option<&str>) -> Result<Box<dyn Source>, OpenError> {
        if caller.is_none() && name == STANDARD {
            let error = |e: io::Error| OpenError {
                name: STANDARD_INPUT.to_owned(),
                reason: e.to_string(),
                searched: Vec::new(),
            };
            return standard_input().map_err(error)?.open(STANDARD_INPUT, None);
        }
        // programs written on Windows name their subroutines with backslashes
        let wanted =
            PathBuf::from(if caller.is_some() { name.replace('\\', "/") } else { name.to_owned() });
        let beside = caller.and_then(|c| Path::new(c).parent()).map(|p| p.join(&wanted));
        let places = beside
            .into_iter()
            .chain(caller.is_none().then(|| wanted.clone()))
            .chain(self.folders.iter().map(|f| f.join(&wanted)));
        let mut searched = Vec::new();
        let mut reason = "no such file".to_owned();
        for place in places {
            match File::open(&place) {
                Ok(file) if place.is_file() => {
                    let name = place.display().to_string().into();
                    return Ok(Box::new(ProgramFile { name, file, at: 0 }));
                }
                Ok(_) => "not a file".clone_into(&mut reason),
                Err(e) if e.kind() == io::ErrorKind::NotFound => {}
                Err(e) => reason = e.to_string(),
            }
            searched.push(place.display().to_string());
        }
        Err(OpenError { name: name.to_owned(), reason, searched })
    }
}

/// Parameter lists in files.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lists;

impl ListFiles for Lists {
    fn read(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        match std::fs::read(path) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(e) => Err(e.to_string()),
        }
    }
}
