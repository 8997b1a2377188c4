//! The integration tests of this crate, one module per subject in a single target that is linked once. `allocation`
//! replaces the allocator and is a separate target.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test that fails here has failed")]

mod control;
mod shaping;
