//! Axis positions, offsets and frames: from programmed values to targets of the axes.
//!
//! `target = offsets + frame(programmed)`. The frame consists of contour rotation (first), mirroring and coordinate systems
//! with the offsets that were programmed in them. The offsets are zero offset and G92 below all systems, tool and measuring
//! offset. A change of offsets or frames does not move an axis: it takes effect when the axis is next programmed absolutely.
//!
//! Source: TF5200 programming manual, G53 to G59, G92, G20 to G23, G68, #CS, offsets in the coordinate system. Assumption: axes
//! that a rotation couples take their offsets over together.

mod active;
mod kinds;
mod layer;
mod machine;
mod offsets;
mod stack;
mod systems;
mod words;
mod zero;

use super::frame::Frame;
use crate::diag::Condition;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::Span;
pub(in crate::exec) use active::Rotation;
use active::{Active, Suspended};
pub(in crate::exec) use kinds::{OffsetKind, Target};
use kontur_motion::axis::AxisVec;
use layer::Layer;
pub(in crate::exec) use stack::SYSTEMS_MAX;
use stack::Stack;
use std::collections::BTreeMap;
pub(in crate::exec) use zero::LAST_ZERO_GROUP;
use zero::ZeroOffsets;

/// Coordinates of all axes of the machine, in channel order.
#[derive(Clone, Debug)]
pub(in crate::exec) struct Coordinates {
    /// Programmed absolute coordinates, without offsets.
    program: AxisVec,
    /// Targets of the axes after the previous block.
    target: AxisVec,
    /// Last coordinate words.
    word: AxisVec,
    /// First, second and third main axis.
    main: [Option<usize>; 3],
    zeros: ZeroOffsets,
    active: Active,
    /// Length and offsets of the tool.
    tool: AxisVec,
    stored: BTreeMap<u32, Frame>,
    /// Named systems (`#CS ADD`).
    stack: Stack,
    /// State suspended by `#MCS ON`.
    suspended: Option<Box<Suspended>>,
    frame: Frame,
    /// Whether the frame is the identity.
    plain: bool,
}

impl Coordinates {
    pub(in crate::exec) fn new(start: &AxisVec) -> Self {
        let n = start.len();
        let main = std::array::from_fn(|i| (i < n).then_some(i));
        Self {
            program: start.clone(),
            target: start.clone(),
            word: start.clone(),
            main,
            zeros: ZeroOffsets::default(),
            active: Active::none(n),
            tool: AxisVec::zeros(n),
            stored: BTreeMap::new(),
            stack: Stack::default(),
            suspended: None,
            frame: Frame::IDENTITY,
            plain: true,
        }
    }

    pub(in crate::exec) fn target(&self) -> &AxisVec {
        &self.target
    }

    /// Programmed absolute coordinate without offsets.
    pub(in crate::exec) fn programmed(&self, axis: usize) -> f64 {
        self.program[axis]
    }

    /// Last coordinate word as it is traversed: mirrored, and with a contour rotation the programmed position on the axes of
    /// the machine, without offsets.
    ///
    /// Source: TF5200 programming manual 207902603 (V.A.PROG), tccncprogramming 15556682379: the mental coordinates are those
    /// of the program, the programmed ones are mirrored. Assumption: under a rotation an increment counts as a position.
    pub(in crate::exec) fn traversed_word(&self, axis: usize) -> f64 {
        let word = match (&self.active.rotation, self.main_index(axis)) {
            (Some(r), Some(main)) => {
                let turn = Frame::rotation(r.plane[0], r.plane[1], r.deg, r.centre);
                turn.apply(self.programmed_point())[main]
            }
            _ => self.word[axis],
        };
        if self.active.mirrored[axis] { 0.0 - word } else { word }
    }

    /// Axis of a main axis index.
    pub(in crate::exec) fn main_axis(&self, main: usize) -> Option<usize> {
        self.main[main]
    }

    /// Main axis index of an axis.
    pub(in crate::exec) fn main_index(&self, axis: usize) -> Option<usize> {
        self.main.iter().position(|m| *m == Some(axis))
    }

    /// Assigns a main axis index to another axis.
    pub(in crate::exec) fn set_main_axis(&mut self, main: usize, axis: Option<usize>) {
        for slot in &mut self.main {
            if axis.is_some() && *slot == axis {
                *slot = None;
            }
        }
        self.main[main] = axis;
        self.frame_changed();
    }

    /// Offset that an absolute word of this axis would apply, except for the offsets in the frame.
    #[inline]
    pub(in crate::exec) fn active_offset(&self, axis: usize) -> f64 {
        let offset = self.layer_offset(&self.active.lowest, axis)
            + self.tool[axis]
            + self.active.measuring[axis];
        // the frame consists of the main axes only
        if self.active.systems.is_empty()
            || self.main_index(axis).is_some()
            || self.is_of_channel(axis)
        {
            return offset;
        }
        offset + self.active.systems.iter().map(|layer| self.layer_offset(layer, axis)).sum::<f64>()
    }

    /// Active offset without those of these kinds.
    pub(in crate::exec) fn offset_without(&self, kinds: &[OffsetKind], axis: usize) -> f64 {
        let tool = if kinds.contains(&OffsetKind::Tool) { 0.0 } else { self.tool[axis] };
        let measuring =
            if kinds.contains(&OffsetKind::Measuring) { 0.0 } else { self.active.measuring[axis] };
        let offset = self.layer_without(&self.active.lowest, kinds, axis) + tool + measuring;
        if self.active.systems.is_empty()
            || self.main_index(axis).is_some()
            || self.is_of_channel(axis)
        {
            return offset;
        }
        let in_systems =
            self.active.systems.iter().map(|layer| self.layer_without(layer, kinds, axis));
        offset + in_systems.sum::<f64>()
    }

    /// Offset contained in the target of an axis.
    pub(in crate::exec) fn applied_offset(&self, axis: usize) -> f64 {
        self.active.applied[axis]
    }

    /// Measuring offset included by G101.
    pub(in crate::exec) fn measuring_offset(&self, axis: usize) -> f64 {
        self.active.measuring[axis]
    }

    pub(in crate::exec) fn set_measuring_offset(&mut self, axis: usize, value_mm: f64) {
        self.active.measuring[axis] = value_mm;
    }

    /// An axis moves to a position without offsets and systems (independent axes, 208612235).
    pub(in crate::exec) fn place(&mut self, axis: usize, position_mm: f64) {
        (self.word[axis], self.target[axis]) = (position_mm, position_mm);
        self.active.applied[axis] = self.active_offset(axis);
        self.recompute_program();
    }

    /// Programmed position of the main axes, 0 for a missing one.
    pub(in crate::exec) fn programmed_point(&self) -> [f64; 3] {
        std::array::from_fn(|m| self.main_axis(m).map_or(0.0, |axis| self.programmed(axis)))
    }

    /// Length and offsets of the tool, by axis.
    pub(in crate::exec) fn tool(&self) -> &AxisVec {
        &self.tool
    }

    pub(in crate::exec) fn set_tool(&mut self, offsets: AxisVec) {
        self.tool = offsets;
    }

    pub(in crate::exec) fn mirrored(&self, axis: usize) -> bool {
        self.active.mirrored[axis]
    }

    pub(in crate::exec) fn set_mirrored(&mut self, axis: usize, mirrored: bool) {
        self.active.mirrored[axis] = mirrored;
        self.frame_changed();
    }

    pub(in crate::exec) fn rotation(&self) -> Option<&Rotation> {
        self.active.rotation.as_ref()
    }

    pub(in crate::exec) fn set_rotation(&mut self, rotation: Option<Rotation>) {
        self.active.rotation = rotation;
        self.frame_changed();
    }

    /// Contour rotation about a centre; the current coordinates apply where none are given.
    pub(in crate::exec) fn rotate_about(
        &mut self,
        plane: [usize; 2],
        deg: f64,
        centre: [Option<f64>; 2],
        span: Span,
    ) -> Outcome<()> {
        if !deg.is_finite() {
            return Err(Fault::new(Condition::Range, "the angle is not a number", span));
        }
        // the centre is given in the system without rotation
        self.set_rotation(None);
        let here = |m: usize| self.main_axis(m).map_or(0.0, |axis| self.programmed(axis));
        let centre = [centre[0].unwrap_or(here(plane[0])), centre[1].unwrap_or(here(plane[1]))];
        self.set_rotation(Some(Rotation { plane, deg, centre }));
        Ok(())
    }

    /// Frame over the main axes.
    pub(in crate::exec) fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Adopts the actual axis positions (`#CHANNEL INIT`).
    pub(in crate::exec) fn set_target(&mut self, target: &AxisVec) {
        self.target.clone_from(target);
        self.recompute_program();
    }

    fn frame_changed(&mut self) {
        self.frame = self.frame_with(|layer, axis| self.layer_offset(layer, axis));
        self.plain = self.frame.is_identity();
        self.recompute_program();
    }

    /// The frame with these offsets in its systems.
    fn frame_with(&self, offset: impl Fn(&Layer, usize) -> f64) -> Frame {
        let mirror = Frame::mirror(std::array::from_fn(|i| {
            self.main[i].is_some_and(|axis| self.active.mirrored[axis])
        }));
        let mut frame = match &self.active.rotation {
            Some(r) => mirror.after(&Frame::rotation(r.plane[0], r.plane[1], r.deg, r.centre)),
            None => mirror,
        };
        for layer in self.active.systems.iter().rev() {
            for (t, axis) in frame.t.iter_mut().zip(self.main) {
                *t += axis.map_or(0.0, |axis| offset(layer, axis));
            }
            frame = layer.system.after(&frame);
        }
        frame
    }

    /// Programmed coordinates of the current axis positions.
    fn recompute_program(&mut self) {
        let mut program = std::mem::take(&mut self.program);
        self.write_program(&self.target, &mut program);
        self.program = program;
    }

    /// Programmed coordinates of axis positions: in the active system, without offsets.
    pub(in crate::exec) fn program_at(&self, position: &AxisVec) -> AxisVec {
        let mut program = position.clone();
        self.write_program(position, &mut program);
        program
    }

    fn write_program(&self, position: &AxisVec, program: &mut AxisVec) {
        for axis in 0..position.len() {
            let bare = position[axis] - self.active.applied[axis];
            program[axis] = if self.active.mirrored[axis] { -bare } else { bare };
        }
        if self.plain {
            return;
        }
        let bare =
            self.main.map(|m| m.map_or(0.0, |axis| position[axis] - self.active.applied[axis]));
        let inside = self.frame.inverse(bare);
        for (main, value) in inside.into_iter().enumerate() {
            if let Some(axis) = self.main[main] {
                program[axis] = value;
            }
        }
    }

    /// Machine coordinates of a programmed point, over the main axes, with the offsets contained in the targets.
    pub(in crate::exec) fn to_machine(&self, p: [f64; 3]) -> [f64; 3] {
        let q = self.frame.apply(p);
        std::array::from_fn(|i| q[i] + self.main[i].map_or(0.0, |axis| self.active.applied[axis]))
    }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "exact values are the point")]
mod tests {
    use super::{Coordinates, Rotation, Target};
    use kontur_motion::axis::AxisVec;

    fn word(axis: usize, value: f64, absolute: bool) -> Target {
        Target { axis, value, absolute }
    }

    fn at(positions: &[f64]) -> Coordinates {
        Coordinates::new(&AxisVec::from_slice(positions))
    }

    #[test]
    fn an_offset_acts_with_the_next_absolute_word_of_the_axis() {
        let mut c = at(&[0.0, 0.0, 0.0]);
        c.set_zero_entry(1, 0, 10.0);
        c.set_zero_entry(1, 1, 5.0);
        c.select_zero_group(1, false);
        c.program([word(0, 0.0, false)]);
        assert_eq!(c.target()[..], [0.0, 0.0, 0.0]);
        c.program([word(0, 0.0, true)]);
        assert_eq!(c.target()[..], [10.0, 0.0, 0.0]);
        c.program([word(1, 1.0, false)]);
        assert_eq!(c.target()[..], [10.0, 1.0, 0.0]);
        assert_eq!((c.programmed(0), c.programmed(1)), (0.0, 1.0));
    }

    #[test]
    fn mirrored_words_and_increments_change_their_sign() {
        let mut c = at(&[5.0, 0.0, 0.0]);
        c.set_mirrored(0, true);
        assert_eq!(c.programmed(0), -5.0);
        c.program([word(0, 10.0, true)]);
        assert_eq!(c.target()[0], -10.0);
        c.program([word(0, 1.0, false)]);
        assert_eq!(c.target()[0], -11.0);
    }

    #[test]
    fn rotation_acts_before_offsets() {
        let mut c = at(&[0.0, 0.0, 0.0]);
        c.set_zero_entry(1, 0, 100.0);
        c.select_zero_group(1, false);
        c.set_rotation(Some(Rotation { plane: [0, 1], deg: 90.0, centre: [0.0, 0.0] }));
        c.program([word(0, 10.0, true)]);
        assert_eq!(c.target()[..], [100.0, 10.0, 0.0]);
        c.set_rotation(None);
        assert_eq!((c.programmed(0), c.programmed(1)), (0.0, 10.0));
    }
}
