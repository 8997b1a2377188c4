//! Constants of a run: names and units of the values in its records.

use std::sync::{Arc, PoisonError, RwLock};

/// Constants of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts {
    /// Name of the program as the user gave it.
    pub program: String,
    /// Name of the machine.
    pub machine: String,
    /// Cycle time in microseconds.
    pub cycle_us: u32,
    /// Path axes in channel order, then spindles: the order of [`CycleRecord::axes`](crate::record::CycleRecord::axes).
    pub axes: Vec<AxisFacts>,
    /// Source files of the run.
    pub files: FileNames,
}

impl Facts {
    /// Cycle time in s.
    pub fn cycle_s(&self) -> f64 {
        f64::from(self.cycle_us) / 1e6
    }
}

/// Constants of one axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AxisFacts {
    /// Name in the NC program.
    pub name: String,
    /// Degrees instead of millimetres.
    pub rotary: bool,
    /// A spindle.
    pub spindle: bool,
    /// Positions that differ from the others.
    pub apart: Apart,
    /// Largest velocity in mm/s or deg/s (P-AXIS-00212).
    pub v_max: f64,
    /// Largest acceleration in mm/s2 or deg/s2 (P-AXIS-00008).
    pub a_max: f64,
    /// Half width of the exact-stop window in mm or deg (P-AXIS-00236).
    pub window: f64,
    /// Time limit to reach it in s (P-AXIS-00532), if there is one.
    pub settling_s: Option<f64>,
}

/// Positions of an axis that can differ from the others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Apart {
    /// Whether the plant model has a tool point (`X_tcp_mm`).
    pub tool_point: bool,
    /// Whether the load can be elsewhere than the actual position (`X_load_mm`): an elastic plant, an encoder with
    /// increments, or inputs that may disturb it.
    pub load: bool,
    /// Whether positions can be added after the axis filters (`X_add_mm`): the additional interface is on, or the tool
    /// list has a grinding tool for `#OTC`.
    pub additional: bool,
}

impl AxisFacts {
    /// `mm`, or `deg` for rotary axes.
    pub const fn unit(&self) -> &'static str {
        if self.rotary { "deg" } else { "mm" }
    }
}

/// Source files of a run in the order in which it opens them; [`CycleRecord::file`](crate::record::CycleRecord::file) is an
/// index.
///
/// A subroutine is opened when it is called; copies of the list also receive the names of later files.
#[derive(Clone, Debug, Default)]
pub struct FileNames {
    names: Arc<RwLock<Vec<String>>>,
    known: usize,
    several: bool,
}

impl FileNames {
    /// The files opened so far; `several`: there will be more than one.
    pub fn new(names: Vec<String>, several: bool) -> Self {
        let (known, several) = (names.len(), several || names.len() > 1);
        Self { names: Arc::new(RwLock::new(names)), known, several }
    }

    /// Whether a trace has to state the file of each line.
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
    pub(crate) fn update(&mut self, open: &[Arc<str>]) {
        if open.len() > self.known {
            let mut names = self.names.write().unwrap_or_else(PoisonError::into_inner);
            names.extend(open[self.known..].iter().map(ToString::to_string));
            self.known = open.len();
        }
    }
}

impl PartialEq for FileNames {
    fn eq(&self, other: &Self) -> bool {
        self.several == other.several && self.all() == other.all()
    }
}
