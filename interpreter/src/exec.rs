//! From syntax trees to steps for the simulation: what the words mean.
//!
//! An executor runs a program block by block and hands out [`Step`]s. It holds modal state, coordinates, variables,
//! program levels and the words in between; it knows neither time nor speed. Meaning is in tables, one row per G
//! function, `#` command and key.

mod block;
pub(crate) mod commands;
mod contour;
mod decoder;
mod fault;
mod geometry;
mod live;
mod motion;
mod names;
mod options;
mod output;
mod program;
mod report;
mod shaping;
mod step;
mod values;

pub(crate) use block::dialect::unknown_g;
pub(crate) use block::groups::unsupported as unsupported_function;
pub use options::{Access, External, ForcedGuard, GuardCommands, Options, SkipLevels, Stop, Value};
pub(crate) use program::ahead::connection;
pub use program::check::Checked;
pub(crate) use program::check::check;
pub(crate) use program::executor::Executor;
pub(crate) use program::files::Structures;
pub(crate) use program::places::Places;
pub(crate) use step::{
    Ahead, Approach, AtCorner, BandingRun, CuttingSpeed, Decoded, EndReason, Event, Feedback,
    IndependentMotion, OscillatingMotion, Probed, ShapingSettings, ShapingSetup, SourceRef,
    SpindleMotion, SpindleState, Step, Sync, TimerCall, Told, WearSetting, WornPart,
};
pub(crate) use values::system::{meaning_of, meanings};

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "programmed positions are exact")]
mod tests;
