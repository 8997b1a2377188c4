//! Named systems stacked on each other (`#CS ADD`): those from the lowest one up to a selected one are active.
//!
//! Source: TF5200 programming manual 1037259147, 1037628043, 1048405643, 1048407819. Assumption: a system that stays active keeps
//! the offsets that were programmed in it, as under `#CS ON`.

use super::super::frame::Frame;
use super::layer::Layer;
use super::{Coordinates, SYSTEMS_MAX};

/// Named systems, the lowest first.
#[derive(Clone, Debug, Default)]
pub(super) struct Stack {
    entries: Vec<(String, Frame)>,
    /// Number of active systems, counted from the lowest one.
    active: usize,
}

impl Coordinates {
    /// Names of the stack, the lowest first.
    pub(in crate::exec) fn stack(&self) -> impl Iterator<Item = &str> {
        self.stack.entries.iter().map(|(name, _)| name.as_str())
    }

    /// Systems of the stack that are active.
    pub(in crate::exec) fn stack_active(&self) -> usize {
        self.stack.active
    }

    /// Adds a system on top of the stack, not yet active; false if it already has [`SYSTEMS_MAX`] systems.
    pub(in crate::exec) fn stack_add(&mut self, name: &str, frame: Frame) -> bool {
        let fits = self.stack.entries.len() < SYSTEMS_MAX;
        if fits {
            self.stack.entries.push((name.to_owned(), frame));
        }
        fits
    }

    /// Activates the lowest `count` systems. The axes do not move.
    pub(in crate::exec) fn stack_select(&mut self, count: usize) {
        let axes = self.target.len();
        self.systems.truncate(count);
        for (_, frame) in self.stack.entries.iter().take(count).skip(self.systems.len()) {
            self.systems.push(Layer::new(*frame, axes));
        }
        self.stack.active = self.systems.len();
        self.frame_changed();
    }

    /// Moves a system of the stack; the axes do not move.
    pub(in crate::exec) fn stack_set(&mut self, place: usize, frame: Frame) {
        if let Some((_, old)) = self.stack.entries.get_mut(place) {
            *old = frame;
        }
        if place < self.stack.active
            && let Some(layer) = self.systems.get_mut(place)
        {
            layer.system = frame;
            self.frame_changed();
        }
    }

    /// Deletes the uppermost system, or all; of the active ones those below stay active. Returns false if there is none.
    pub(in crate::exec) fn stack_delete(&mut self, all: bool) -> bool {
        let was = self.stack.entries.len();
        self.stack.entries.truncate(if all { 0 } else { was.saturating_sub(1) });
        if self.stack.active > self.stack.entries.len() {
            self.stack_select(self.stack.entries.len());
        }
        was > 0
    }
}
