//! What every causal stage of an axis can do.

/// One causal stage of one axis, called exactly once per cycle.
pub trait Stage {
    /// Next output for the next input. Never allocates, never panics.
    fn step(&mut self, x: f64) -> f64;
    /// Puts the stage at rest on the constant input `x`; no transient follows.
    fn settle(&mut self, x: f64);
    /// Delay of slow signals in cycles; curves are aligned with it.
    fn delay_cycles(&self) -> f64;
}
