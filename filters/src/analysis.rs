//! Analysis outside the cycle: what a filter or shaper does to a corner, which one suits a machine.
//!
//! Nothing here runs in a cycle; commands, pictures and tests use it.
//!
//! Order of calls: the bands in which a machine vibrates, from them the choice of a mode, its kernel, and what that does
//! to a corner.
//!
//! ```
//! use kontur_filters::analysis::corner::kernel_error_mm;
//! use kontur_filters::analysis::tuning::VibrationBand;
//! use kontur_filters::time::CycleTime;
//!
//! // measured between 38 and 42 Hz, damping 0.1: the frequency at which mode 2 leaves least
//! let band = VibrationBand::of(&[38.0, 42.0], 0.1).unwrap();
//! let choice = band.best(2, CycleTime::DEFAULT).unwrap();
//! assert!(choice.worst_ratio < 0.05);
//! let kernel = choice.settings.kernel(CycleTime::DEFAULT).unwrap();
//! assert!(kernel_error_mm(&kernel, 20.0, CycleTime::DEFAULT) > 0.0);
//! ```

pub mod corner;
pub mod decay;
pub mod order;
pub mod spring;
pub mod tuning;
