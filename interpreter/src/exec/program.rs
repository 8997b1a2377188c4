//! Which block is next: files, levels, loops, branches and calls.
//!
//! Owns the open files, their indices and the levels of the program; it hands blocks to the decoder and reads nothing of
//! its state but values of conditions and what a call has left in it.

mod actual;
pub(super) mod calls;
pub(super) mod check;
pub(super) mod cycle_end;
pub(super) mod executor;
pub(super) mod files;
pub(super) mod flow;
pub(super) mod index;
pub(super) mod info;
mod jumps;
mod levels;
mod reached;
pub(super) mod sequence;
pub(super) mod state;
pub(super) mod unreached;
mod unusable;
