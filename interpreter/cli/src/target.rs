//! Files that commands write.
//!
//! A file is written under a temporary name next to its target (`.NAME.*.part`) and renamed when it is complete enough;
//! until then, and if the command fails, an existing file stays as it was. The temporary file is created with the first
//! byte, so that a killed run does not leave an empty one.

use crate::error::Error;
use crate::files::is_standard;
use std::fs::{File, OpenOptions, Permissions};
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Links that are followed one after the other, as many as the system follows.
const LINKS_MAX: usize = 40;

/// A file to be written.
#[derive(Debug)]
pub(crate) struct Target {
    path: PathBuf,
    place: Place,
}

#[derive(Debug)]
enum Place {
    /// Not begun, with the permissions of the file that it replaces.
    Planned(Option<Permissions>),
    /// Under its temporary name.
    Hidden(NamedTempFile),
    /// Under its own name, as a device or pipe always is.
    Shown(File),
    /// Changing from one to the other.
    Between,
}

/// The file that a link names, even if it does not exist yet.
fn followed(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    // links may lead in a circle
    for _ in 0..LINKS_MAX {
        let Ok(next) = path.read_link() else { break };
        path = path.parent().map_or_else(|| next.clone(), |folder| folder.join(&next));
    }
    path
}

impl Target {
    /// Begins a file.
    ///
    /// # Errors
    /// The system's; also if an existing file of this name must not be written.
    pub(crate) fn create(path: &Path) -> io::Result<Self> {
        // a link is kept, and its target is replaced
        let path = path.canonicalize().unwrap_or_else(|_| followed(path));
        let existing = match path.metadata() {
            Ok(metadata) if !metadata.is_file() => {
                let file = OpenOptions::new().write(true).open(&path)?;
                return Ok(Self { path, place: Place::Shown(file) });
            }
            Ok(metadata) => {
                drop(OpenOptions::new().write(true).open(&path)?);
                Some(metadata.permissions())
            }
            Err(_) => None,
        };
        // a file that can be created now can be created later
        drop(hidden(&path, None)?);
        Ok(Self { path, place: Place::Planned(existing) })
    }

    /// The destination of the bytes.
    ///
    /// # Errors
    /// The system's, at the first call.
    pub(crate) fn file(&mut self) -> io::Result<&mut File> {
        if let Place::Planned(permissions) = &mut self.place {
            self.place = Place::Hidden(hidden(&self.path, permissions.take())?);
        }
        match &mut self.place {
            Place::Hidden(hidden) => Ok(hidden.as_file_mut()),
            Place::Shown(file) => Ok(file),
            Place::Planned(_) | Place::Between => Err(io::ErrorKind::NotFound.into()),
        }
    }

    /// Gives the file its name while it still grows, if nothing is lost: there is no file of that name, or it begins
    /// alike. Any other one might still be read.
    ///
    /// # Errors
    /// As [`Target::show`].
    pub(crate) fn show_over(&mut self, start: &[u8]) -> io::Result<()> {
        if !matches!(self.place, Place::Hidden(_)) {
            return Ok(());
        }
        let mut begins = Vec::new();
        match File::open(&self.path) {
            Ok(file) => file.take(start.len() as u64).read_to_end(&mut begins).map(|_| ())?,
            Err(e) if e.kind() == io::ErrorKind::NotFound => return self.show(),
            Err(e) => return Err(e),
        }
        if begins == start { self.show() } else { Ok(()) }
    }

    /// Gives the file its name, replacing an existing one; a file that was not begun gets none.
    ///
    /// # Errors
    /// The system's; the existing file is unchanged in that case.
    pub(crate) fn show(&mut self) -> io::Result<()> {
        match std::mem::replace(&mut self.place, Place::Between) {
            Place::Hidden(hidden) => {
                self.place = Place::Shown(hidden.persist(&self.path).map_err(|e| e.error)?);
            }
            other => self.place = other,
        }
        Ok(())
    }
}

/// A file under a temporary name next to a path.
fn hidden(path: &Path, permissions: Option<Permissions>) -> io::Result<NamedTempFile> {
    let name = path.file_name().ok_or(io::ErrorKind::IsADirectory)?.to_string_lossy();
    let prefix = format!(".{name}.");
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".part");
    #[cfg(unix)]
    let permissions = {
        use std::os::unix::fs::PermissionsExt as _;
        // the usual permissions, not those of temporary files
        permissions.or_else(|| Some(Permissions::from_mode(0o666)))
    };
    if let Some(permissions) = permissions {
        builder.permissions(permissions);
    }
    builder.tempfile_in(folder_of(path)).map_err(|e| {
        // the temporary name means nothing to a user; `tempfile` adds it to the message
        let text = e.to_string();
        let cause = text.split(" at path ").next().unwrap_or_default();
        io::Error::new(e.kind(), cause)
    })
}

/// The folder in which a file lies.
pub(crate) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or_else(|| Path::new("."))
}

/// Writes whole files: either all of them, or every existing one stays as it was.
///
/// # Errors
/// [`Error::Io`], e.g. a full disk.
pub(crate) fn write(files: &[(&Path, &[u8])]) -> Result<(), Error> {
    let each = |target: &mut [Target], what: fn(&mut Target, &[u8]) -> io::Result<()>| {
        target.iter_mut().zip(files).try_for_each(|(target, (path, bytes))| {
            what(target, bytes).map_err(|e| Error::io(path.display().to_string(), e))
        })
    };
    let mut targets = create_all(files.iter().map(|(path, _)| *path))?;
    each(&mut targets, |target, bytes| target.file()?.write_all(bytes))?;
    each(&mut targets, |target, _| target.show())
}

/// Begins files.
///
/// # Errors
/// [`Error::Io`] if one of them cannot be written.
pub(crate) fn create_all<'a>(
    paths: impl IntoIterator<Item = &'a Path>,
) -> Result<Vec<Target>, Error> {
    let create =
        |path: &Path| Target::create(path).map_err(|e| Error::io(path.display().to_string(), e));
    paths.into_iter().map(create).collect()
}

/// Refuses to overwrite a file that is read, or to write two outputs into one file, under any name.
///
/// # Errors
/// [`Error::Usage`] that names the file.
pub(crate) fn keep_apart(read: &[PathBuf], outputs: &[PathBuf]) -> Result<(), Error> {
    let of_files = |paths: &[PathBuf]| {
        let files = paths.iter().filter(|p| !is_standard(p));
        files.map(|p| Identity::of(p)).filter(|i| *i != Identity::Device).collect::<Vec<_>>()
    };
    let (read, mut taken) = (of_files(read), Vec::new());
    for output in outputs {
        let this = Identity::of(output);
        let wrong = if read.contains(&this) {
            "the command reads this file"
        } else if taken.contains(&this) && this != Identity::Device {
            "two outputs to the same file"
        } else {
            taken.push(this);
            continue;
        };
        return Err(Error::Usage(format!("-o {}: {wrong}", output.display())));
    }
    Ok(())
}

/// The identity of a file with several names.
#[derive(PartialEq)]
enum Identity {
    /// An existing file, whatever its links.
    File(same_file::Handle),
    /// One that does not exist yet: its folder and name.
    Name(PathBuf),
    /// Pipes and devices may be used several times.
    Device,
}

impl Identity {
    fn of(path: &Path) -> Self {
        let metadata = path.metadata();
        if metadata.as_ref().is_ok_and(|metadata| !metadata.is_file()) {
            return Self::Device;
        }
        if let Ok(handle) = metadata.and_then(|_| same_file::Handle::from_path(path)) {
            return Self::File(handle);
        }
        let folder = folder_of(path);
        let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        Self::Name(folder.join(path.file_name().unwrap_or_default()))
    }
}

#[cfg(test)]
mod tests {
    use super::{Target, keep_apart, write};
    use std::fs;
    use std::io::Write as _;

    #[test]
    fn a_file_that_is_not_shown_leaves_no_trace() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let names = || {
            let names = fs::read_dir(folder.path()).unwrap();
            names.map(|e| e.unwrap().file_name().into_string().unwrap()).collect::<Vec<_>>()
        };
        fs::write(&path, "old").unwrap();
        let mut target = Target::create(&path).unwrap();
        target.file().unwrap().write_all(b"new").unwrap();
        assert_eq!(names().len(), 2);
        // a file that is not a trace is kept until the end
        target.show_over(b"t_s,").unwrap();
        assert_eq!((names().len(), fs::read(&path).unwrap()), (2, b"old".to_vec()));
        drop(target);
        assert_eq!(
            (names(), fs::read(&path).unwrap()),
            (vec!["a.csv".to_owned()], b"old".to_vec())
        );
        write(&[(&path, b"new")]).unwrap();
        assert_eq!(
            (names(), fs::read(&path).unwrap()),
            (vec!["a.csv".to_owned()], b"new".to_vec())
        );
        // and writing continues under the final name
        let mut target = Target::create(&path).unwrap();
        assert_eq!(names().len(), 1, "nothing was written");
        target.file().unwrap().write_all(b"1").unwrap();
        target.show_over(b"ne").unwrap();
        target.file().unwrap().write_all(b"2").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"12");
        assert!(write(&[(&path, b"3"), (&folder.path().join("no/such.csv"), b"")]).is_err());
        assert_eq!(fs::read(&path).unwrap(), b"12");
        assert!(write(&[(folder.path(), b"")]).is_err());
    }

    #[test]
    #[cfg(unix)]
    fn links_stay_and_devices_are_written() {
        use std::os::unix::fs::{PermissionsExt as _, symlink};
        let folder = tempfile::tempdir().unwrap();
        let [file, link] = ["a", "b"].map(|name| folder.path().join(name));
        fs::write(&file, "old").unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
        symlink(&file, &link).unwrap();
        write(&[(&link, b"new")]).unwrap();
        assert!(link.symlink_metadata().unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
        assert_eq!(file.metadata().unwrap().permissions().mode() & 0o777, 0o640);
        write(&[("/dev/null".as_ref(), b"x")]).unwrap();
        // the file that a link names is made, next to the link
        let waiting = folder.path().join("c");
        symlink("later", &waiting).unwrap();
        write(&[(&waiting, b"made")]).unwrap();
        assert!(waiting.symlink_metadata().unwrap().is_symlink());
        assert_eq!(fs::read(folder.path().join("later")).unwrap(), b"made");
        let lost = folder.path().join("d");
        symlink("/no/such/folder/file", &lost).unwrap();
        assert!(write(&[(&lost, b"x")]).is_err());
    }

    #[test]
    fn one_file_has_many_names() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::write(path("a.nc"), "").unwrap();
        fs::hard_link(path("a.nc"), path("hard")).unwrap();
        let apart = |read: &str, outputs: &[&str]| {
            let outputs: Vec<_> = outputs.iter().map(|o| path(o)).collect();
            keep_apart(&[path(read)], &outputs).is_ok()
        };
        assert!(apart("a.nc", &["b", "c"]) && apart("-", &["b"]));
        assert!(!apart("a.nc", &["a.nc"]) && !apart("a.nc", &["./a.nc"]));
        assert!(!apart("a.nc", &["hard"]));
        assert!(!apart("a.nc", &["b", "./b"]) && !apart("x", &["hard", "a.nc"]));
        #[cfg(unix)]
        assert!(keep_apart(&[], &["/dev/null".into(), "/dev/null".into()]).is_ok());
    }
}
