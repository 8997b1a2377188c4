//! What happens to one axis in one cycle: shaping, feedforward, position control, monitors.
//!
//! Units: `_mm _mm_s _mm_s2 _mm_s3` (degrees for rotary axes), `_s _us`, `_hz`, `_kg _n_m`, `_ratio` (1.0 = 100 %),
//! `_cycles`. Inside the crate everything is `f64` in mm (deg) and s; vendor integers never enter it.
//!
//! The crate has no notion of NC text, axis names, files or wall-clock time. It neither allocates nor panics per cycle.
//!
//! Order of calls: settings become a kernel or a filter, these the [`shaping`] chain of an axis, and the [`control`]
//! loop follows its output. Both are stepped once per cycle, or run through many cycles in a row.
//!
//! ```
//! use kontur_filters::control::{AxisControl, AxisControlConfig};
//! use kontur_filters::shaping::Shaping;
//! use kontur_filters::time::CycleTime;
//! use kontur_filters::vib_guard::VibGuardSettings;
//! use std::sync::Arc;
//!
//! let cycle = CycleTime::DEFAULT;
//! let guard = VibGuardSettings { mode: 2, freq_hz: 40.0, damping: 0.1 };
//! let kernel = Arc::new(guard.kernel(cycle)?);
//! let mut shaping = Shaping::new(Vec::new(), 0.0);
//! shaping.set_kernel(Some(Arc::clone(&kernel)))?;
//! let mut control = AxisControl::new(AxisControlConfig::new(1000.0, 5000.0, 1e6), cycle)?;
//! control.start(0.0);
//!
//! let mut set_mm = Vec::new();
//! for k in 0..200_u32 {
//!     let ipo_mm = 0.01 * f64::from(k.min(100));
//!     set_mm.push(kontur_filters::stage::Stage::step(&mut shaping, ipo_mm));
//!     let _seen = control.step(set_mm[k as usize], 0.0, true);
//! }
//! // at constant speed the set position is late by the delay of the kernel; at rest it is exact
//! assert!((set_mm[90] - 0.01 * (90.0 - kernel.delay_cycles())).abs() < 1e-12);
//! assert!(set_mm[199].to_bits() == 1.0_f64.to_bits());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod analysis;
pub mod cascade;
pub mod control;
pub mod fir;
pub mod hsc;
pub mod iir;
pub mod issue;
pub mod kernel;
pub mod response;
pub mod ring;
pub mod shaping;
pub mod stage;
pub mod time;
pub mod vib_guard;
mod vibration;
