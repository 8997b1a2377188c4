//! Positions programmed by the words of a block.

use super::Coordinates;
use super::active::Active;
use super::kinds::{OffsetKind, Target};
use kontur_motion::axis::AxisVec;

impl Coordinates {
    /// `#SUPPRESS OFFSETS`: targets of axes without offsets of these kinds. Systems, rotation and mirroring remain (207072907).
    ///
    /// Assumption: in a rotated system a coordinate that is not programmed keeps its value in the system without these offsets.
    pub(in crate::exec) fn program_without(&mut self, kinds: &[OffsetKind], words: &[Target]) {
        let frame = self.frame_with(|layer, axis| self.layer_without(layer, kinds, axis));
        let rest = self.main.map(|m| m.map_or(0.0, |axis| self.offset_without(kinds, axis)));
        let at = |i: usize| self.main[i].map_or(0.0, |axis| self.target[axis] - rest[i]);
        let mut point = frame.inverse(std::array::from_fn(at));
        let mut programmed = [false; 3];
        for &Target { axis, value, .. } in words {
            self.word[axis] = value;
            if let Some(main) = self.main_index(axis) {
                (point[main], programmed[main]) = (value, true);
            } else {
                let value = if self.active.mirrored[axis] { -value } else { value };
                self.target[axis] = value + self.offset_without(kinds, axis);
                self.active.applied[axis] = self.active_offset(axis);
            }
        }
        let moved = frame.apply(point);
        for main in 0..3 {
            let follows = (0..3).any(|i| programmed[i] && frame.m[main][i] != 0.0);
            if let (Some(axis), true) = (self.main[main], follows) {
                self.target[axis] = moved[main] + rest[main];
                self.active.applied[axis] = self.active_offset(axis);
            }
        }
        self.recompute_program();
    }

    /// Applies the words of a block; the new targets are in [`target`](Self::target).
    pub(in crate::exec) fn program(&mut self, words: impl IntoIterator<Item = Target>) {
        self.program_with(None, words);
    }

    /// The offset that an absolute word of each axis would apply. It stays valid until a block does anything but move axes.
    pub(in crate::exec) fn active_offsets(&self) -> AxisVec {
        let mut offsets = AxisVec::zeros(self.target.len());
        for (axis, offset) in offsets.iter_mut().enumerate() {
            *offset = self.active_offset(axis);
        }
        offsets
    }

    /// The same as [`Self::program`], with the [active offsets](Self::active_offsets) if they are known.
    pub(in crate::exec) fn program_with(
        &mut self,
        offsets: Option<&[f64]>,
        words: impl IntoIterator<Item = Target>,
    ) {
        let own = if offsets.is_none() { Some(self.active_offsets()) } else { None };
        let n = self.target.len();
        let offsets = &offsets.or(own.as_deref()).unwrap_or_default()[..n];
        let Active { mirrored, applied, .. } = &mut self.active;
        let (mirrored, applied) = (&mirrored[..n], &mut applied[..n]);
        let (word, program) = (&mut self.word[..n], &mut self.program[..n]);
        let target = &mut self.target[..n];
        let mut framed = [None; 3];
        for Target { axis, value, absolute } in words {
            word[axis] = value;
            if absolute {
                program[axis] = value;
            } else {
                program[axis] += value;
            }
            let main = || self.main.iter().position(|main| *main == Some(axis));
            if !self.plain
                && let Some(main) = main()
            {
                framed[main] = Some(absolute);
                continue;
            }
            let value = if mirrored[axis] { -value } else { value };
            if absolute {
                applied[axis] = offsets[axis];
                target[axis] = value + offsets[axis];
            } else {
                target[axis] += value;
            }
        }
        if !self.plain && framed.iter().any(Option::is_some) {
            self.program_in_frame(framed);
        }
    }

    /// Targets of the programmed main axes (`Some(absolute)`), and of those that the frame couples to them.
    fn program_in_frame(&mut self, programmed: [Option<bool>; 3]) {
        let p = self.main.map(|m| m.map_or(0.0, |axis| self.program[axis]));
        let q = self.frame.apply(p);
        let coupled: [bool; 3] =
            std::array::from_fn(|i| (0..3).any(|j| i != j && self.frame.m[i][j] != 0.0));
        let coupling = || (0..3).filter(|i| coupled[*i]).filter_map(|i| programmed[i]);
        let (couples, absolute) =
            (coupling().next().is_some(), coupling().any(|absolute| absolute));
        for main in 0..3 {
            let affected = programmed[main].is_some() || (couples && coupled[main]);
            if let (Some(axis), true) = (self.main[main], affected) {
                if programmed[main].unwrap_or(absolute) {
                    self.active.applied[axis] = self.active_offset(axis);
                }
                self.target[axis] = q[main] + self.active.applied[axis];
            }
        }
    }
}
