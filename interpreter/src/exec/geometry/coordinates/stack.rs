//! Named systems stacked on each other (`#CS ADD`): those from the lowest one up to a selected one are active.
//!
//! Source: TF5200 programming manual 1037259147, 1037628043, 1048405643, 1048407819. Assumption: a system that stays active keeps
//! the offsets that were programmed in it, as under `#CS ON`.

use crate::exec::geometry::frame::Frame;

/// Coordinate systems that can be stored. Source: TF5200, #CS DEF.
pub(in crate::exec) const SYSTEMS_MAX: usize = 5;

/// Named systems, the lowest first.
#[derive(Clone, Debug, Default)]
pub(in crate::exec) struct Stack {
    entries: Vec<(String, Frame)>,
    /// Number of active systems, counted from the lowest one.
    pub(super) active: usize,
}

impl Stack {
    /// Names of the systems, the lowest first.
    pub(in crate::exec) fn names(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|(name, _)| name.as_str())
    }

    /// Number of active systems.
    pub(in crate::exec) fn active(&self) -> usize {
        self.active
    }

    /// Adds a system on top, not yet active; false if there are already [`SYSTEMS_MAX`] systems.
    pub(super) fn add(&mut self, name: &str, frame: Frame) -> bool {
        let fits = self.entries.len() < SYSTEMS_MAX;
        if fits {
            self.entries.push((name.to_owned(), frame));
        }
        fits
    }

    /// The lowest `count` systems.
    pub(super) fn lowest(&self, count: usize) -> impl Iterator<Item = Frame> {
        self.entries.iter().take(count).map(|(_, frame)| *frame)
    }

    /// Replaces a system.
    pub(super) fn set(&mut self, place: usize, frame: Frame) {
        if let Some((_, old)) = self.entries.get_mut(place) {
            *old = frame;
        }
    }

    /// Deletes the uppermost system, or all; returns the number of those before and after.
    pub(super) fn delete(&mut self, all: bool) -> (usize, usize) {
        let before = self.entries.len();
        self.entries.truncate(if all { 0 } else { before.saturating_sub(1) });
        (before, self.entries.len())
    }
}
