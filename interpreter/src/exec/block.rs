//! Words of one block: the combined meaning of letters, G functions and brackets.
//!
//! Owns the modal state ([`modal`]) and the words of the current block. Reads values, and controls motion, contour, shaping and
//! geometry. It has no access to files or other blocks.

mod addresses;
pub(super) mod brackets;
pub(super) mod choice;
pub(super) mod collected;
pub(super) mod dialect;
pub(super) mod din;
pub(super) mod groups;
pub(super) mod modal;
pub(super) mod modes;
pub(super) mod words;
