//! From syntax trees to steps for the simulation: what the words mean.
//!
//! An executor runs a program block by block and hands out [`Step`]s. It holds modal state, coordinates, variables,
//! program levels and the words in between; it knows neither time nor speed. Meaning stands in tables, one row per G
//! function, `#` command and key.

mod angle;
mod arc;
mod bottleneck;
mod brackets;
mod calls;
mod check;
pub(crate) mod commands;
mod compensation;
mod contour;
mod contouring;
mod coordinates;
mod decoder;
mod dialect;
mod din;
mod dynamics;
mod executor;
mod expr;
mod fault;
mod files;
mod flow;
mod frame;
mod functions;
mod groups;
mod independent;
mod index;
mod insertion;
mod modal;
mod modes;
mod modulo;
mod motion;
mod options;
mod overrides;
mod planar;
mod program;
mod shaping;
mod spindles;
mod step;
mod suggest;
mod system;
mod tools;
mod unreached;
mod variables;
mod words;

pub use check::{UNREACHED, check};
pub use executor::Executor;
pub use options::{Access, External, Options, SkipLevels, Value};
pub use step::{
    AxisShaping, EndReason, Event, Feedback, IndependentMotion, ShapingSettings, ShapingSetup,
    SourceRef, SpindleMotion, Step, Sync,
};

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "programmed positions are exact")]
mod tests;
