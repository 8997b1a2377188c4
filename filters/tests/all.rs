//! The tests of this crate from outside, one module per subject: one target, linked once. `allocation` replaces the allocator
//! and is a target of its own.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test that fails here has failed")]

mod control;
mod shaping;
