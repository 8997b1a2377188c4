//! From syntax trees to steps for the simulation: what the words mean.
//!
//! An executor runs a program block by block and hands out [`Step`]s. It holds modal state, coordinates, variables,
//! program levels and the words in between; it knows neither time nor speed. Meaning stands in tables, one row per G
//! function, `#` command and key.
//!
//! ```text
//! Executor::new(Box<dyn Sources>, program: &str, Arc<Machine>, Options) -> Executor
//! Executor::next(&mut self, &Feedback) -> Step          // after Step::End always Step::End
//! Executor::take_diagnostics(&mut self) -> Vec<Diagnostic>
//! Executor::files(&self) -> &[Arc<str>]                 // index: SourceRef::file
//! Executor::shaping(&self) -> &ShapingSetup             // the setup in force; before the first step: the lists
//! Executor::blocks(&self) -> u64                        // executed so far
//! check(Box<dyn Sources>, program: &str, Arc<Machine>, Options) -> Vec<Diagnostic>
//! ```

mod options;
mod step;

pub use options::{Access, External, Options, SkipLevels, Value};
pub use step::{
    AxisShaping, EndReason, Event, Feedback, ShapingSettings, ShapingSetup, SourceRef,
    SpindleMotion, Step, Sync,
};
