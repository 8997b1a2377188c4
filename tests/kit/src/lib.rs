//! The kit of all tests: random numbers, and a mass on a spring by small steps. It depends on none of the crates that it tests.

mod oscillator;
mod random;

pub use oscillator::Oscillator;
pub use random::{Random, count, environment, seed};
