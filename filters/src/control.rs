//! Everything downstream of the set position of one axis: feedforward, position controller, drive and mechanics,
//! Improved Position Control and the monitors of the position controller.
//!
//! One call of [`AxisControl::step`] per interpolation cycle. The configuration of each part (`…Config`, in mm and s)
//! is separate from its state. Axis names and parameter lists do not occur here: a list reader converts vendor integers
//! into the configuration structs, and the cycle loop adds axis and block to a [`Fault`].
//!
//! Done elsewhere: filtering of set positions (module `shaping`), stopping other axes after a fault (the cycle loop),
//! correcting list values that must not be zero (the list reader).
//!
//! Order of calls: check the configuration, make the axis from it, start it at its position, then step it once per
//! cycle.
//!
//! ```
//! use kontur_filters::control::{AxisControl, AxisControlConfig};
//! use kontur_filters::time::CycleTime;
//!
//! let (config, issues) =
//!     AxisControlConfig::new(1000.0, 5000.0, 1e6).checked(CycleTime::DEFAULT);
//! let mut axis = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
//! axis.start(12.5);
//! let seen = axis.step(12.5, 0.0, true);
//! assert!(issues.is_empty() && seen.act_mm == 12.5 && seen.lag_mm == 0.0);
//! ```

pub mod axis_control;
pub mod buffer;
pub mod fault;
pub mod feedforward;
pub mod ipc;
pub mod monitor;
pub mod plant;
pub mod position;
pub mod scaling;

pub use axis_control::{AxisControl, AxisControlConfig, AxisInputs, ControlOutput, Encoder};
pub use fault::{Fault, Faults, Issue};
pub use feedforward::{FeedforwardConfig, FeedforwardMode};
pub use ipc::{IpcConfig, IpcMode};
pub use plant::{Plant, PlantConfig, PlantModel};
pub use position::{PositionConfig, PositionLoop};

/// Largest set position in mm: far beyond any machine, and small enough for all differences to stay finite.
const RANGE_MM: f64 = 1e9;
