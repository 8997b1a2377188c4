//! Analysis beside the cycle: what a filter or shaper does to a corner, which one fits a machine.
//!
//! Nothing here runs in a cycle; commands, pictures and tests use it.

pub mod corner;
pub mod decay;
pub mod order;
pub mod tuning;
