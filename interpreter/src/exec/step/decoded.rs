//! A step with what its decoding has brought about.

use super::{ShapingSetup, Step};
use crate::diag::Diagnostic;
use crate::machine::Machine;
use std::sync::Arc;

/// A step, and what else its decoding has brought about.
#[derive(Debug)]
pub(crate) struct Decoded {
    pub step: Step,
    /// Blocks executed so far.
    pub blocks: u64,
    /// What few steps bring about.
    pub rare: Option<Box<Rare>>,
}

/// See [`Decoded`].
#[derive(Debug)]
pub(crate) struct Rare {
    pub diagnostics: Vec<Diagnostic>,
    /// Files opened.
    pub files: Vec<Opened>,
    /// The machine and its kernels, if `#MACHINE DATA` has changed them.
    pub changed: Option<(Arc<Machine>, ShapingSetup)>,
}

/// A program file, and how it was found.
#[derive(Clone, Debug)]
pub(crate) struct Opened {
    /// Its full name.
    pub name: Arc<str>,
    /// Its name as written.
    pub written: Box<str>,
    /// The file in which that is written; `None`: the main program.
    pub caller: Option<Arc<str>>,
}
