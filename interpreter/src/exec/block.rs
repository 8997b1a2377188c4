//! Words of one block: what letters, G functions and brackets of a block mean together.
//!
//! Owns the modal state ([`modal`]) and the words of the current block; reads values, and directs motion, contour, shaping
//! and geometry what to do. It knows no files and no other block.

mod addresses;
pub(super) mod brackets;
pub(super) mod collected;
pub(super) mod dialect;
pub(super) mod din;
pub(super) mod groups;
pub(super) mod modal;
pub(super) mod modes;
pub(super) mod words;
