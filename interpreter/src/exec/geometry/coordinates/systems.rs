//! Coordinate systems: active ones, stored ones, and those of the stack.

use super::Coordinates;
use super::layer::Layer;
use super::stack::Stack;
use crate::exec::geometry::frame::Frame;

impl Coordinates {
    /// Active coordinate systems.
    pub(in crate::exec) fn systems(&self) -> usize {
        self.active.systems.len()
    }

    /// Whether a main axis keeps its direction in the active coordinate systems: they only shift it, or turn the others
    /// about it.
    pub(in crate::exec) fn keeps_direction(&self, main: usize) -> bool {
        let systems =
            self.active.systems.iter().fold(Frame::IDENTITY, |f, layer| f.after(&layer.system));
        let mut unit = [0.0; 3];
        unit[main] = 1.0;
        // turns about the axis and back again may leave rounding errors
        systems.direction(unit).iter().zip(unit).all(|(a, b)| (a - b).abs() < 1e-12)
    }

    /// Whether a system or a contour rotation turns an axis, so that its words move other axes as well.
    pub(in crate::exec) fn is_turned(&self, axis: usize) -> bool {
        self.main_index(axis).is_some_and(|main| {
            let rotates = self.active.rotation.as_ref().is_some_and(|r| r.plane.contains(&main));
            rotates || !self.keeps_direction(main)
        })
    }

    /// Whether a stored system with this number is active.
    pub(in crate::exec) fn is_system_active(&self, number: u32) -> bool {
        let aside = self.suspended.as_ref().map_or(&[][..], |before| &before.active.systems[..]);
        self.active.systems.iter().chain(aside).any(|layer| layer.number == Some(number))
    }

    /// Activates a system within the active ones; `number`: the one under which it is stored.
    pub(in crate::exec) fn push_system(&mut self, frame: Frame, number: Option<u32>) {
        let axes = self.target.len();
        self.active.systems.push(Layer { number, ..Layer::new(frame, axes) });
        self.frame_changed();
    }

    /// Removes it with its offsets; without a system there is no effect.
    pub(in crate::exec) fn pop_system(&mut self) {
        self.active.systems.pop();
        self.frame_changed();
    }

    pub(in crate::exec) fn clear_systems(&mut self) {
        self.active.systems.clear();
        self.frame_changed();
    }

    pub(in crate::exec) fn store_system(&mut self, id: u32, frame: Frame) {
        self.stored.insert(id, frame);
    }

    pub(in crate::exec) fn stored_system(&self, id: u32) -> Option<Frame> {
        self.stored.get(&id).copied()
    }

    pub(in crate::exec) fn stored_systems(&self) -> usize {
        self.stored.len()
    }

    /// The named systems.
    pub(in crate::exec) fn stack(&self) -> &Stack {
        &self.stack
    }

    /// Adds a system on top of the stack, not yet active; false if the stack is full.
    pub(in crate::exec) fn stack_add(&mut self, name: &str, frame: Frame) -> bool {
        self.stack.add(name, frame)
    }

    /// Activates the lowest `count` systems of the stack. The axes do not move.
    pub(in crate::exec) fn stack_select(&mut self, count: usize) {
        let axes = self.target.len();
        let systems = &mut self.active.systems;
        systems.truncate(count);
        let further = self.stack.lowest(count).skip(systems.len());
        systems.extend(further.map(|frame| Layer::new(frame, axes)));
        self.stack.active = systems.len();
        self.frame_changed();
    }

    /// Moves a system of the stack; the axes do not move.
    pub(in crate::exec) fn stack_set(&mut self, place: usize, frame: Frame) {
        self.stack.set(place, frame);
        if place < self.stack.active
            && let Some(layer) = self.active.systems.get_mut(place)
        {
            layer.system = frame;
            self.frame_changed();
        }
    }

    /// Deletes the uppermost system of the stack, or all; of the active ones those below stay active. Returns false if there is
    /// none.
    pub(in crate::exec) fn stack_delete(&mut self, all: bool) -> bool {
        let (before, after) = self.stack.delete(all);
        if self.stack.active > after {
            self.stack_select(after);
        }
        before > 0
    }
}
