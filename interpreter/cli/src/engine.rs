//! What computes, as the commands see it: a thin seam between the command line and the simulation.
//!
//! The commands know three questions: open a program for a run, check programs, explain a thing. Everything that a
//! trace, a summary or a report shows comes through [`Source`], one cycle at a time.

use crate::Error;
use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::record::CycleRecord;
pub use kontur_interpreter::sim::Totals;
use std::path::PathBuf;
use std::sync::{Arc, PoisonError, RwLock};

/// What a user may say about a run, apart from what becomes of its results.
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own for the user")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// The NC program.
    pub program: PathBuf,
    /// Folder or start-up list of the machine; none: the built-in `xyz`.
    pub machine: Option<PathBuf>,
    /// `AXIS.key=value` or `channel.key=value`, in the order given.
    pub settings: Vec<String>,
    /// Folders of global subroutines, in the order of search.
    pub path: Vec<PathBuf>,
    /// Subroutines may lie outside the program's folder and those.
    pub allow_outside: bool,
    /// Files of real-time inputs.
    pub inputs: Vec<PathBuf>,
    /// Cycle time in microseconds in place of the machine's.
    pub cycle_us: Option<u32>,
    /// Start positions in mm (deg) by axis name.
    pub start: Vec<(String, f64)>,
    /// Active skip levels (`/`, `/1` ... `/9`).
    pub skip: Vec<u8>,
    /// Program time in seconds after which a run is stopped.
    pub max_time_s: f64,
    /// Number of decoded blocks after which a run is stopped.
    pub max_blocks: u64,
    /// Keys of a list that are not modelled are refused.
    pub strict: bool,
    /// Transformations of the kinematics are taken as identity.
    pub identity_trafo: bool,
    /// Declared durations of M, H and S functions are waited for.
    pub techno_times: bool,
    /// External variables by their name behind `V.E.`: a number, or else a text.
    pub external: Vec<(String, String)>,
}

/// What stays the same during a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts {
    /// Name of the program as the user gave it.
    pub program: String,
    /// Name of the machine.
    pub machine: String,
    /// Cycle time in microseconds.
    pub cycle_us: u32,
    /// Path axes in channel order, then spindles: the order of [`CycleRecord::axes`].
    pub axes: Vec<AxisFacts>,
    /// Source files of the run.
    pub files: FileNames,
}

/// Source files of a run in the order in which it opens them; [`CycleRecord::file`] is an index.
///
/// A subroutine is opened when it is called: copies of the list learn the names of later files too.
#[derive(Clone, Debug, Default)]
pub struct FileNames {
    names: Arc<RwLock<Vec<String>>>,
    several: bool,
}

impl FileNames {
    /// The files opened so far; `several`: there will be more than one.
    pub fn new(names: Vec<String>, several: bool) -> Self {
        let several = several || names.len() > 1;
        Self { names: Arc::new(RwLock::new(names)), several }
    }

    /// A trace has to say which file a line belongs to.
    pub const fn several(&self) -> bool {
        self.several
    }

    /// The name of a file; empty for one that is not open.
    pub fn name(&self, file: u32) -> String {
        let i = usize::try_from(file).unwrap_or(usize::MAX);
        let names = self.names.read().unwrap_or_else(PoisonError::into_inner);
        names.get(i).cloned().unwrap_or_default()
    }

    /// Every name.
    pub fn all(&self) -> Vec<String> {
        self.names.read().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Takes the names of all files that are open now.
    pub fn update<'a>(&self, names: impl Iterator<Item = &'a str>) {
        let mut list = self.names.write().unwrap_or_else(PoisonError::into_inner);
        let known = list.len();
        list.extend(names.skip(known).map(str::to_owned));
    }
}

impl PartialEq for FileNames {
    fn eq(&self, other: &Self) -> bool {
        self.several == other.several && self.all() == other.all()
    }
}

/// What stays the same for one axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AxisFacts {
    /// Name in the NC program.
    pub name: String,
    /// Degrees instead of millimetres.
    pub rotary: bool,
    /// A spindle.
    pub spindle: bool,
    /// The plant model has a tool point of its own (`X_tcp_mm`).
    pub modal: bool,
    /// Largest velocity in mm/s or deg/s (P-AXIS-00212).
    pub v_max: f64,
    /// Largest acceleration in mm/s2 or deg/s2 (P-AXIS-00008).
    pub a_max: f64,
    /// Half width of the exact-stop window in mm or deg (P-AXIS-00236).
    pub window: f64,
    /// Time limit to reach it in s (P-AXIS-00532), if there is one.
    pub settling_s: Option<f64>,
}

impl AxisFacts {
    /// `mm`, or `deg` for rotary axes.
    pub const fn unit(&self) -> &'static str {
        if self.rotary { "deg" } else { "mm" }
    }
}

/// A running program.
pub trait Source {
    /// What stays the same.
    fn facts(&self) -> &Facts;
    /// Every file that the run reads: programs, lists, inputs.
    fn reads(&self) -> Vec<PathBuf>;
    /// Computes the next cycle; none at the end of the program or after an abort.
    fn next_cycle(&mut self) -> Option<&CycleRecord>;
    /// The diagnostics raised since the last call, by cycle, then in the order of raising.
    fn take_diagnostics(&mut self) -> Vec<Diagnostic>;
    /// Totals; complete once `next_cycle` has returned none.
    fn totals(&self) -> Totals;
}

/// Why a program could not be opened.
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

/// What computes. It keeps nothing between two questions, so that a sweep asks from every core at once.
pub trait Engine: Sync {
    /// Opens a program. A program that is refused opens too: it yields diagnostics, no cycles, and `aborted`.
    ///
    /// # Errors
    /// [`OpenError`] if options, lists or files are wrong.
    fn open(&self, request: &Request) -> Result<Box<dyn Source>, OpenError>;

    /// Decodes a program without moving anything and reports every diagnostic.
    ///
    /// # Errors
    /// [`OpenError`] if options, lists or files are wrong.
    fn check(&self, request: &Request, report: &mut dyn FnMut(Diagnostic))
    -> Result<(), OpenError>;

    /// Meaning, range, default and example of an ID, a parameter or a command.
    ///
    /// # Errors
    /// Words that resemble an unknown one, best first.
    fn explain(&self, thing: &str) -> Result<String, Vec<String>>;
}
