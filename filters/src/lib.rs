//! What happens to one axis in one cycle: shaping, feedforward, position control, monitors.
//!
//! Units: `_mm _mm_s _mm_s2 _mm_s3` (degrees for rotary axes), `_s _us`, `_hz`, `_kg _n_m`, `_ratio` (1.0 = 100 %),
//! `_cycles`. Inside the crate everything is `f64` in mm (deg) and s; vendor integers never enter it.
//!
//! The crate knows no NC text, no axis names, no files and no clock. Nothing in it allocates or panics per cycle.

pub mod analysis;
pub mod cascade;
pub mod control;
pub mod fir;
pub mod hsc;
pub mod iir;
pub mod issue;
pub mod kernel;
pub mod response;
pub mod shaping;
pub mod stage;
pub mod time;
pub mod vib_guard;
