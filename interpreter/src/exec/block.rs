//! Words of one block: what letters, G functions and brackets of a block mean together.
//!
//! Owns the modal state ([`modal`]) and the words of the current block; reads values, and directs motion, contour, shaping
//! and geometry. It knows neither files nor other blocks.

mod addresses;
pub(super) mod brackets;
pub(super) mod collected;
pub(super) mod dialect;
pub(super) mod din;
pub(super) mod groups;
pub(super) mod modal;
pub(super) mod modes;
pub(super) mod words;
