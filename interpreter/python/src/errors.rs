//! Errors as exceptions of the module's classes (`kontur._errors`).

use kontur::Error;
use kontur::request::OpenError;
use kontur_interpreter::diag::{Diagnostic, render};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use std::io;

/// A diagnostic as JSON and as text with its source line.
pub(crate) type Said = (String, String);

pub(crate) fn said(diagnostics: &[Diagnostic]) -> Vec<Said> {
    diagnostics.iter().map(|d| (render::json(d), render::text(d, false))).collect()
}

/// An exception of one of the classes.
fn raise(py: Python<'_>, class: &str, text: &str, diagnostics: &[Diagnostic]) -> PyErr {
    let made = py
        .import("kontur._errors")
        .and_then(|module| module.getattr(class))
        .and_then(|class| class.call_method1("of", (text, said(diagnostics))));
    match made {
        Ok(exception) => PyErr::from_value(exception),
        Err(e) => e,
    }
}

pub(crate) fn usage(py: Python<'_>, text: &str) -> PyErr {
    raise(py, "UsageError", text, &[])
}

pub(crate) fn lists(py: Python<'_>, diagnostics: &[Diagnostic]) -> PyErr {
    raise(py, "ListsError", &Error::Lists.to_string(), diagnostics)
}

fn system(what: &str, e: &io::Error) -> PyErr {
    match e.raw_os_error() {
        // from three arguments Python makes FileNotFoundError, PermissionError, ...
        Some(code) => PyOSError::new_err((code, e.to_string(), what.to_owned())),
        None => PyOSError::new_err(format!("{what}: {e}")),
    }
}

pub(crate) fn open(py: Python<'_>, e: OpenError) -> PyErr {
    match e {
        OpenError::Usage(text) => usage(py, &text),
        OpenError::Lists(said) => lists(py, &said),
        OpenError::Inputs(said) => raise(py, "InputsError", &Error::Inputs.to_string(), &said),
        OpenError::Io(path, e) => system(&path.display().to_string(), &e),
    }
}

/// An error of a command; `messages` is the output of the command about it.
pub(crate) fn command(py: Python<'_>, e: &Error, messages: &str) -> PyErr {
    match e {
        Error::Io { what, source } => system(what, source),
        Error::Lists | Error::Inputs => {
            let class = if matches!(e, Error::Lists) { "ListsError" } else { "InputsError" };
            let made = py
                .import("kontur._errors")
                .and_then(|module| module.getattr(class))
                .and_then(|class| class.call_method1("of_lines", (e.to_string(), messages)));
            made.map_or_else(|e| e, PyErr::from_value)
        }
        other => usage(py, &other.to_string()),
    }
}
