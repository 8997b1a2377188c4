//! Parameter lists in files, as the library reads them.

use crate::files::{in_other_case, regular};
use kontur_interpreter::machine::ListFiles;
use kontur_interpreter::source::text::Text;
use std::cell::RefCell;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Largest list, in bytes: 16 MiB.
const MOST_LIST_BYTES: u64 = 1 << 24;
/// Largest file of a project, in bytes; it contains far more than lists.
const MOST_PROJECT_BYTES: u64 = 1 << 26;

/// Parameter lists in files.
#[derive(Clone, Debug, Default)]
pub struct Lists {
    read: RefCell<Vec<PathBuf>>,
}

impl Lists {
    /// The lists that were read.
    pub(crate) fn read_so_far(self) -> Vec<PathBuf> {
        self.read.into_inner()
    }

    /// The text of a file of a project; its lines may have any length.
    ///
    /// # Errors
    /// The system's, and for a file of more than 64 MiB or text that is not UTF-8.
    pub(crate) fn project(&self, path: &Path) -> io::Result<String> {
        let file = regular(path)?;
        self.read.borrow_mut().push(path.into());
        let mut text = String::new();
        file.take(MOST_PROJECT_BYTES + 1).read_to_string(&mut text)?;
        if text.len() as u64 > MOST_PROJECT_BYTES {
            return Err(io::Error::other("more than 64 MiB, too long for a project"));
        }
        Ok(text)
    }
}

impl ListFiles for Lists {
    fn read(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        let file = match regular(path.as_ref()) {
            Ok(file) => file,
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(e.to_string()),
        };
        self.read.borrow_mut().push(path.into());
        let mut bytes = Vec::new();
        Text::new(file)
            .and_then(|text| text.take(MOST_LIST_BYTES + 1).read_to_end(&mut bytes))
            .map_err(|e| e.to_string())?;
        if bytes.len() as u64 > MOST_LIST_BYTES {
            return Err("more than 16 MiB, too long for a list".to_owned());
        }
        Ok(Some(bytes))
    }

    fn in_other_case(&self, path: &str) -> Option<String> {
        in_other_case(path.as_ref())?.to_str().map(str::to_owned)
    }
}
