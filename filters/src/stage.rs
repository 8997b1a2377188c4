//! The interface of every causal stage of an axis.
//!
//! Order of calls: [`Stage::settle`] at the position of the axis, then [`Stage::step`] once per cycle.
//!
//! ```
//! use kontur_filters::kernel::{Kernel, KernelFilter};
//! use kontur_filters::stage::Stage;
//! use std::sync::Arc;
//!
//! /// Positions of a ramp of one unit per cycle after the stage.
//! fn ramp(stage: &mut impl Stage) -> Vec<f64> {
//!     stage.settle(0.0);
//!     (1..=50).map(|k| stage.step(f64::from(k))).collect()
//! }
//! let mut delay = KernelFilter::new(Arc::new(Kernel::delay(7)), 0.0);
//! // late by its delay
//! assert_eq!(ramp(&mut delay)[49], 50.0 - delay.delay_cycles());
//! ```

/// One causal stage of one axis, called once per cycle, or once for many in a row.
pub trait Stage {
    /// Next output for the next input. Never allocates, never panics.
    fn step(&mut self, x: f64) -> f64;
    /// Replaces a row of inputs by its outputs.
    fn run(&mut self, values: &mut [f64]) {
        for x in values {
            *x = self.step(*x);
        }
    }
    /// Settles the stage at the constant input `x`; no transient follows.
    fn settle(&mut self, x: f64);
    /// Delay of slow signals in cycles, used to align curves.
    fn delay_cycles(&self) -> f64;
}
