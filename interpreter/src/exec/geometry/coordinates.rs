//! Axis positions, offsets and frames: from programmed values to targets of the axes.
//!
//! `target = offsets + frame(programmed)`. The frame consists of contour rotation (first), mirroring and coordinate systems
//! with the offsets that were programmed in them. The offsets are zero offset and G92 below all systems, tool and measuring
//! offset. A change of offsets or frames does not move an axis: it takes effect when the axis is next programmed absolutely.
//!
//! Source: TF5200 programming manual, G53 to G59, G92, G20 to G23, G68, #CS, offsets in the coordinate system. Assumption: axes
//! that a rotation couples take their offsets over together.

mod layer;
mod machine;
mod stack;
mod words;

use super::frame::Frame;
use crate::diag::Condition;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use layer::Layer;
use machine::Suspended;
use stack::Stack;
use std::collections::{BTreeMap, BTreeSet};

/// Last group of the table of zero offsets (P-ZERO-00002).
pub(in crate::exec) const LAST_ZERO_GROUP: u32 = 96;

/// Contour rotation (G68, `#ROTATION`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Rotation {
    /// Main axes of the plane.
    pub(in crate::exec::geometry) plane: [usize; 2],
    pub(in crate::exec) deg: f64,
    /// Centre in mm in the plane.
    pub(in crate::exec) centre: [f64; 2],
}

/// A coordinate word in mm (deg).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Target {
    pub(in crate::exec) axis: usize,
    pub(in crate::exec) value: f64,
    /// G90 (absolute) instead of an increment (G91).
    pub(in crate::exec) absolute: bool,
}

/// Kind of offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) enum OffsetKind {
    /// G54 to G59, G159.
    Zero,
    /// G92.
    Additive,
    /// `#PSET`.
    Preset,
    Tool,
    /// G101.
    Measuring,
}

impl OffsetKind {
    pub(in crate::exec) const ALL: [Self; 5] =
        [Self::Zero, Self::Additive, Self::Preset, Self::Tool, Self::Measuring];
}

/// Coordinate systems that can be stored. Source: TF5200, #CS DEF.
pub(in crate::exec) const SYSTEMS_MAX: usize = 5;

/// Coordinates of all axes of the machine, in channel order.
#[derive(Clone, Debug)]
pub(in crate::exec) struct Coordinates {
    /// Programmed absolute coordinates, without offsets.
    program: AxisVec,
    /// Targets of the axes after the previous block.
    target: AxisVec,
    /// Offset contained in the target of each axis.
    applied: AxisVec,
    /// Last coordinate words.
    word: AxisVec,
    /// First, second and third main axis.
    main: [Option<usize>; 3],
    zero_table: BTreeMap<u32, AxisVec>,
    /// Whether G53 has its own offsets (P-ZERO-00001).
    has_g53: bool,
    /// Zero-offset group of the axes that are not main axes, if their offsets belong to the channel instead of a coordinate
    /// system (P-CHAN-00397 = 0).
    channel_group: Option<u32>,
    /// Axes with entries excluded from a group (G160).
    zero_masked: BTreeSet<(u32, usize)>,
    /// Offsets below all coordinate systems.
    lowest: Layer,
    /// Active coordinate systems, the last one innermost.
    systems: Vec<Layer>,
    tool: AxisVec,
    /// Measuring offsets (G101).
    measuring: AxisVec,
    mirrored: Vec<bool>,
    rotation: Option<Rotation>,
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
            applied: AxisVec::zeros(n),
            word: start.clone(),
            main,
            zero_table: BTreeMap::new(),
            has_g53: false,
            channel_group: None,
            zero_masked: BTreeSet::new(),
            lowest: Layer::new(Frame::IDENTITY, n),
            systems: Vec::new(),
            tool: AxisVec::zeros(n),
            measuring: AxisVec::zeros(n),
            mirrored: vec![false; n],
            rotation: None,
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
        let word = match (&self.rotation, self.main_index(axis)) {
            (Some(r), Some(main)) => {
                let turn = Frame::rotation(r.plane[0], r.plane[1], r.deg, r.centre);
                turn.apply(self.programmed_point())[main]
            }
            _ => self.word[axis],
        };
        if self.mirrored[axis] { 0.0 - word } else { word }
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
        let offset = self.layer_offset(&self.lowest, axis) + self.tool[axis] + self.measuring[axis];
        // the frame consists of the main axes only
        if self.systems.is_empty() || self.main_index(axis).is_some() || self.is_of_channel(axis) {
            return offset;
        }
        offset + self.systems.iter().map(|layer| self.layer_offset(layer, axis)).sum::<f64>()
    }

    /// Active offset without those of these kinds.
    pub(in crate::exec) fn offset_without(&self, kinds: &[OffsetKind], axis: usize) -> f64 {
        let tool = if kinds.contains(&OffsetKind::Tool) { 0.0 } else { self.tool[axis] };
        let measuring =
            if kinds.contains(&OffsetKind::Measuring) { 0.0 } else { self.measuring[axis] };
        let offset = self.layer_without(&self.lowest, kinds, axis) + tool + measuring;
        if self.systems.is_empty() || self.main_index(axis).is_some() || self.is_of_channel(axis) {
            return offset;
        }
        let in_systems = self.systems.iter().map(|layer| self.layer_without(layer, kinds, axis));
        offset + in_systems.sum::<f64>()
    }

    /// Offset contained in the target of an axis.
    pub(in crate::exec) fn applied_offset(&self, axis: usize) -> f64 {
        self.applied[axis]
    }

    /// Measuring offset included by G101.
    pub(in crate::exec) fn measuring_offset(&self, axis: usize) -> f64 {
        self.measuring[axis]
    }

    pub(in crate::exec) fn set_measuring_offset(&mut self, axis: usize, value_mm: f64) {
        self.measuring[axis] = value_mm;
    }

    /// An axis moves to a position without offsets and systems (independent axes, 208612235).
    pub(in crate::exec) fn place(&mut self, axis: usize, position_mm: f64) {
        (self.word[axis], self.target[axis]) = (position_mm, position_mm);
        self.applied[axis] = self.active_offset(axis);
        self.recompute_program();
    }

    /// Programmed position of the main axes, 0 for a missing one.
    pub(in crate::exec) fn programmed_point(&self) -> [f64; 3] {
        std::array::from_fn(|m| self.main_axis(m).map_or(0.0, |axis| self.programmed(axis)))
    }

    /// Offsets of the tool by axis.
    pub(in crate::exec) fn tool_offsets(&self) -> &AxisVec {
        &self.tool
    }

    /// Replaces the tool offsets of all axes.
    /// Length and offsets of the tool, by axis.
    pub(in crate::exec) fn tool(&self) -> &AxisVec {
        &self.tool
    }

    pub(in crate::exec) fn set_tool(&mut self, offsets: AxisVec) {
        self.tool = offsets;
    }

    pub(in crate::exec) fn mirrored(&self, axis: usize) -> bool {
        self.mirrored[axis]
    }

    pub(in crate::exec) fn set_mirrored(&mut self, axis: usize, mirrored: bool) {
        self.mirrored[axis] = mirrored;
        self.frame_changed();
    }

    pub(in crate::exec) fn rotation(&self) -> Option<&Rotation> {
        self.rotation.as_ref()
    }

    pub(in crate::exec) fn set_rotation(&mut self, rotation: Option<Rotation>) {
        self.rotation = rotation;
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

    pub(in crate::exec) fn store_system(&mut self, id: u32, frame: Frame) {
        self.stored.insert(id, frame);
    }

    pub(in crate::exec) fn stored_system(&self, id: u32) -> Option<Frame> {
        self.stored.get(&id).copied()
    }

    pub(in crate::exec) fn stored_systems(&self) -> usize {
        self.stored.len()
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
            self.main[i].is_some_and(|axis| self.mirrored[axis])
        }));
        let mut frame = match &self.rotation {
            Some(r) => mirror.after(&Frame::rotation(r.plane[0], r.plane[1], r.deg, r.centre)),
            None => mirror,
        };
        for layer in self.systems.iter().rev() {
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
            let bare = position[axis] - self.applied[axis];
            program[axis] = if self.mirrored[axis] { -bare } else { bare };
        }
        if self.plain {
            return;
        }
        let bare = self.main.map(|m| m.map_or(0.0, |axis| position[axis] - self.applied[axis]));
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
        std::array::from_fn(|i| q[i] + self.main[i].map_or(0.0, |axis| self.applied[axis]))
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
