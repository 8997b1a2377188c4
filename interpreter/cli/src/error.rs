//! How commands end, and their errors.

use kontur_interpreter::diag::Diagnostic;
use std::path::PathBuf;

/// How a command ends; the number is the exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Finished, warnings allowed; for `diff`: equal.
    Finished = 0,
    /// The program was refused or aborted by an NC or axis error; for `diff`: different.
    Aborted = 1,
    /// Wrong usage or wrong machine lists.
    Usage = 2,
    /// Input or output failed.
    Io = 3,
}

/// Reasons why a command could not do its work.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Wrong usage: the message names the option and the choices.
    #[error("{0}")]
    Usage(String),
    /// The machine lists were refused; their diagnostics have been printed.
    #[error("the machine lists were refused")]
    Lists,
    /// A file of real-time inputs is wrong; its diagnostics have been printed.
    #[error("the file of real-time inputs was refused")]
    Inputs,
    /// Ctrl-C stopped the run; everything computed so far is written.
    #[error("interrupted at t = {time_s:.6} s")]
    Interrupted {
        /// Program time of the last row in seconds.
        time_s: f64,
    },
    /// Ctrl-C stopped a sweep; finished rows are kept in its journal.
    #[error("interrupted; the same sweep continues after its finished rows")]
    Stopped,
    /// Stdout is no longer read; there is nothing to report.
    #[error("stdout is closed")]
    ClosedPipe,
    /// A file could not be read or written.
    #[error("{what}: {source}")]
    Io {
        /// The file, and whether it was read or written.
        what: String,
        /// The error of the system.
        source: std::io::Error,
    },
}

impl Error {
    /// An input or output error with the name of the file.
    pub fn io(what: impl Into<String>, source: std::io::Error) -> Self {
        Self::Io { what: what.into(), source }
    }

    /// Exit code of this error.
    pub const fn exit(&self) -> Exit {
        match self {
            Self::Usage(_) | Self::Lists | Self::Inputs => Exit::Usage,
            Self::Interrupted { .. } | Self::Stopped => Exit::Aborted,
            Self::ClosedPipe | Self::Io { .. } => Exit::Io,
        }
    }
}

/// Reasons why a program could not be opened.
#[derive(Debug)]
pub enum OpenError {
    /// A setting or option is wrong.
    Usage(String),
    /// The machine lists are wrong.
    Lists(Vec<Diagnostic>),
    /// A file of real-time inputs is wrong.
    Inputs(Vec<Diagnostic>),
    /// A file cannot be read.
    Io(PathBuf, std::io::Error),
}

impl From<OpenError> for Error {
    fn from(e: OpenError) -> Self {
        match e {
            OpenError::Usage(text) => Self::Usage(text),
            OpenError::Lists(_) => Self::Lists,
            OpenError::Inputs(_) => Self::Inputs,
            OpenError::Io(path, e) => Self::io(path.display().to_string(), e),
        }
    }
}
