//! One way to run a program: a [`Job`] is a program on a machine. It is checked, or started as a [`Run`] whose cycles
//! go to a [`Sink`].
//!
//! Order of calls: lists become a machine ([`MachineLists`]), machine and sources become a job, and the job a run. A
//! run always goes through its cycles in one loop ([`Run::to_end`]).
//!
//! ```
//! use kontur_interpreter::diag::render;
//! use kontur_interpreter::job::{Job, MachineLists};
//! use kontur_interpreter::record::CycleRecord;
//! use kontur_interpreter::source::MemorySources;
//!
//! let (machine, warnings) = MachineLists::default().load().map_err(|said| render::all(&said))?;
//! let sources = MemorySources::new().with("part.nc", "N10 G01 X10 F1000\nN20 M30\n");
//! let mut run = Job::new(machine, sources, "part.nc")
//!     .with_warnings(warnings)
//!     .start()
//!     .map_err(|said| render::all(&said))?;
//! let mut x_mm = Vec::new();
//! let Ok(()) = run.to_end(&mut |record: &CycleRecord| x_mm.push(record.axes[0].set));
//! assert!(run.take_diagnostics().is_empty() && !run.totals().aborted);
//! assert_eq!(x_mm.last(), Some(&10.0));
//! # Ok::<(), String>(())
//! ```

mod apart;
pub mod inputs;
mod lists;
mod run;
mod stretch;
#[cfg(test)]
mod tests;

pub use crate::exec::{
    Access, Checked, External, ForcedGuard, GuardCommands, Options, SkipLevels, Stop, Value,
};
pub use crate::record::facts::{Apart, AxisFacts, Facts, FileNames};
pub use crate::sim::{Change, Changes, SettledStop, Signal, Stops, Totals, Work};
pub use lists::MachineLists;
pub use run::{Run, Sink};

use crate::diag::{Condition, Diagnostic};
use crate::exec;
use crate::machine::{AxisKind, Machine, ToolKind};
use crate::sim::{Simulation, impossible_axes};
use crate::source::Sources;
use std::fmt;
use std::sync::Arc;

/// A program on a machine. It keeps no state of its runs: each of them starts from scratch, on any thread.
#[derive(Clone)]
pub struct Job {
    machine: Arc<Machine>,
    warnings: Vec<Diagnostic>,
    sources: Arc<dyn Sources>,
    program: String,
    options: Options,
}

impl fmt::Debug for Job {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Job")
            .field("program", &self.program)
            .field("machine", &self.machine.name)
            .finish_non_exhaustive()
    }
}

impl Job {
    /// `program` is the name used in messages and opened from `sources` without a caller.
    pub fn new(
        machine: impl Into<Arc<Machine>>,
        sources: impl Sources + 'static,
        program: impl Into<String>,
    ) -> Self {
        Self {
            machine: machine.into(),
            warnings: Vec::new(),
            sources: Arc::new(sources),
            program: program.into(),
            options: Options::default(),
        }
    }

    /// Warnings of the machine's lists: the first messages of every check and run.
    #[must_use]
    pub fn with_warnings(mut self, warnings: Vec<Diagnostic>) -> Self {
        self.warnings = warnings;
        self
    }

    /// Start position, limits, variables, a forced Vibration Guard.
    #[must_use]
    pub fn with_options(mut self, options: Options) -> Self {
        self.options = options;
        self
    }

    /// The machine.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// Decodes the program without moving anything and reports every diagnostic, not only the first.
    pub fn check(&self) -> Checked {
        let (mut checked, _) = self.decode();
        let lists = self.warnings.iter().cloned().chain(self.machine.chains().1);
        let lists = lists.chain(impossible_axes(&self.machine));
        checked.diagnostics.splice(..0, lists);
        checked
    }

    fn decode(&self) -> (Checked, exec::Structures) {
        let sources = Arc::clone(&self.sources);
        exec::check(sources, &self.program, Arc::clone(&self.machine), self.options.clone())
    }

    /// The program before its first cycle. If a check finds an error the run is refused: it has diagnostics, no cycles,
    /// and [`Totals::aborted`].
    ///
    /// # Errors
    /// The diagnostics, if the plant of an axis is not physical (K-0070).
    pub fn start(&self) -> Result<Run, Vec<Diagnostic>> {
        let (checked, structures) = self.decode();
        let refused = checked.refuses();
        let several_files = checked.files.len() > 1 || checked.calls_more;
        let mut messages = self.warnings.clone();
        if refused {
            messages.extend(self.machine.chains().1);
        }
        // the run reports all others, except in parts that it does not reach
        let unreached =
            |d: &Diagnostic| d.id == Condition::Unreached || d.id == Condition::TextBehindEnd;
        messages.extend(checked.diagnostics.into_iter().filter(|d| refused || unreached(d)));
        let simulation = Simulation::new(
            Arc::clone(&self.machine),
            Arc::clone(&self.sources),
            &self.program,
            self.options.clone(),
            structures,
        )?;
        let facts = facts(&self.program, &self.machine, &simulation, several_files);
        let stop = self.options.stop.clone();
        Ok(Run::new(simulation, Arc::clone(&self.sources), facts, messages, refused, stop))
    }
}

/// The constants of a run; `several_files`: the preceding check opened more files than the program, or found calls that
/// a run may reach.
fn facts(program: &str, machine: &Machine, simulation: &Simulation, several_files: bool) -> Facts {
    let (chains, _) = machine.chains();
    let stop = |i: usize| chains.get(i).map(|chain| chain.control.exact_stop).unwrap_or_default();
    let grinds = machine.tools.values().any(|tool| tool.kind == ToolKind::Grinding);
    let axes = machine.all_axes().zip(simulation.chains()).enumerate().map(|(i, (axis, chain))| {
        AxisFacts {
            name: axis.name().to_owned(),
            rotary: axis.kind() != AxisKind::Linear,
            spindle: axis.kind() == AxisKind::Spindle,
            apart: Apart {
                tool_point: chain.has_tool_point(),
                load: !chain.shows_load_twice(),
                additional: grinds || axis.has_additional_interface(),
            },
            v_max: axis.dynamics().v_max_mm_s,
            a_max: axis.dynamics().a_max_mm_s2,
            window: stop(i).window_mm,
            settling_s: stop(i).settling_s,
        }
    });
    let files = simulation.files().iter().map(ToString::to_string).collect();
    Facts {
        program: program.to_owned(),
        machine: machine.name.clone(),
        cycle_us: machine.cycle.us(),
        axes: axes.collect(),
        files: FileNames::new(files, several_files),
    }
}
