//! Determines the next block: files, levels, loops, branches and calls.
//!
//! Owns the open files, their indices and the levels of the program. It hands blocks to the decoder, and reads from the
//! state of the decoder only the values of conditions and the results of a call.

pub(super) mod ahead;
pub(super) mod calls;
pub(super) mod check;
pub(super) mod cycle_end;
pub(super) mod executor;
pub(super) mod files;
pub(super) mod flow;
pub(super) mod index;
pub(super) mod info;
mod jumps;
mod level;
mod levels;
pub(super) mod parsed;
pub(super) mod places;
mod reached;
mod reads;
pub(super) mod sequence;
pub(super) mod state;
pub(super) mod unreached;
mod unusable;
