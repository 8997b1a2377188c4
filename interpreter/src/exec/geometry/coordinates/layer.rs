//! Nested coordinate systems, each with its own zero offsets, G92 and position presets.
//!
//! Offsets that are programmed while a system is active refer to its axes, are added to those below it, and are removed
//! together with it. A new system has none. Tool and measuring offsets do not belong to a system.
//!
//! With P-CHAN-00397 = 0 this applies to the main axes only: offsets of the others belong to the channel, regardless of the
//! system that is active when they are programmed.
//!
//! Source: TF5200 programming manual 1086442763, offsets in the coordinate system; channel parameters 149618059; zero offsets
//! 15285108363 (P-ZERO-00001). Assumption: an offset in a rotated system points along the rotated axes, as its coordinates do.

use super::super::frame::Frame;
use super::{Coordinates, OffsetKind};
use kontur_motion::axis::AxisVec;
use std::collections::BTreeMap;

/// A zero-offset group without entries.
pub(super) const NO_GROUP: u32 = u32::MAX;

/// A coordinate system and the offsets in it.
#[derive(Clone, Debug)]
pub(super) struct Layer {
    /// Its frame in the system below, including the offsets of that system.
    pub(super) system: Frame,
    /// The number under which it is stored; `None` without a number.
    number: Option<u32>,
    /// Active zero-offset group, 0 = G53.
    zero_group: u32,
    /// Whether it was selected by G159.
    zero_group_by_value: bool,
    /// Values of `V.G.NP_AKT`, valid until another group is selected.
    zero_written: BTreeMap<usize, f64>,
    /// G92.
    preset: AxisVec,
    /// `#PSET`.
    position_preset: AxisVec,
}

impl Layer {
    /// Without offsets.
    pub(super) fn new(system: Frame, axes: usize) -> Self {
        Self {
            system,
            number: None,
            zero_group: NO_GROUP,
            zero_group_by_value: false,
            zero_written: BTreeMap::new(),
            preset: AxisVec::zeros(axes),
            position_preset: AxisVec::zeros(axes),
        }
    }
}

impl Coordinates {
    /// The innermost system.
    fn layer(&self) -> &Layer {
        self.systems.last().unwrap_or(&self.lowest)
    }

    /// The layer in which offsets of an axis are programmed: the innermost system, or the channel.
    fn layer_of(&self, axis: usize) -> &Layer {
        if self.is_of_channel(axis) { &self.lowest } else { self.layer() }
    }

    /// Changes offsets of an axis where they are programmed.
    fn change(&mut self, axis: usize, change: impl FnOnce(&mut Layer)) {
        let channel = self.is_of_channel(axis);
        let innermost = self.systems.last_mut().filter(|_| !channel);
        change(innermost.unwrap_or(&mut self.lowest));
        self.offsets_changed();
    }

    /// Whether the offsets of the axis belong to the channel instead of a coordinate system.
    pub(super) fn is_of_channel(&self, axis: usize) -> bool {
        self.channel_group.is_some() && self.main_index(axis).is_none()
    }

    /// Scope of the zero offsets, and the group at program start. `has_g53`: P-ZERO-00001; `in_systems`: P-CHAN-00397.
    pub(in crate::exec) fn use_zero_groups(&mut self, has_g53: bool, in_systems: bool, start: u32) {
        self.has_g53 = has_g53;
        self.channel_group = (!in_systems).then_some(NO_GROUP);
        self.select_zero_group(start, false);
    }

    /// Offsets in systems are part of the frame.
    fn offsets_changed(&mut self) {
        if !self.systems.is_empty() {
            self.frame_changed();
        }
    }

    /// All offsets of one layer.
    #[inline]
    pub(super) fn layer_offset(&self, layer: &Layer, axis: usize) -> f64 {
        self.layer_zero(layer, axis) + layer.preset[axis] + layer.position_preset[axis]
    }

    /// Offsets of one layer except those of these kinds.
    pub(super) fn layer_without(&self, layer: &Layer, kinds: &[OffsetKind], axis: usize) -> f64 {
        let without = |kind| kinds.contains(&kind);
        let zero = if without(OffsetKind::Zero) { 0.0 } else { self.layer_zero(layer, axis) };
        let additive = if without(OffsetKind::Additive) { 0.0 } else { layer.preset[axis] };
        let preset = if without(OffsetKind::Preset) { 0.0 } else { layer.position_preset[axis] };
        zero + additive + preset
    }

    #[inline]
    fn layer_zero(&self, layer: &Layer, axis: usize) -> f64 {
        if let Some(written) = layer.zero_written.get(&axis) {
            return *written;
        }
        if self.zero_table.is_empty() {
            return 0.0;
        }
        let of_channel = self.channel_group.filter(|_| self.main_index(axis).is_none());
        let group = of_channel.unwrap_or(layer.zero_group);
        if (group == 0 && !self.has_g53) || self.zero_masked.contains(&(group, axis)) {
            return 0.0;
        }
        self.zero_entry(group, axis)
    }

    /// Active zero offset in the layer where offsets of the axis are programmed.
    pub(in crate::exec) fn zero_offset(&self, axis: usize) -> f64 {
        self.layer_zero(self.layer_of(axis), axis)
    }

    /// Entry of the zero-offset table.
    pub(in crate::exec) fn zero_entry(&self, group: u32, axis: usize) -> f64 {
        self.zero_table.get(&group).map_or(0.0, |offsets| offsets[axis])
    }

    pub(in crate::exec) fn set_zero_entry(&mut self, group: u32, axis: usize, value_mm: f64) {
        let n = self.target.len();
        self.zero_table.entry(group).or_insert_with(|| AxisVec::zeros(n))[axis] = value_mm;
        self.offsets_changed();
    }

    /// G53 (group 0), G54 to G59; G159 is `by_value`.
    pub(in crate::exec) fn select_zero_group(&mut self, group: u32, by_value: bool) {
        let layer = self.systems.last_mut().unwrap_or(&mut self.lowest);
        layer.zero_group = group;
        layer.zero_group_by_value = by_value;
        layer.zero_written.clear();
        if self.channel_group.is_some() {
            self.channel_group = Some(group);
            let main = self.main;
            self.lowest.zero_written.retain(|axis, _| main.contains(&Some(*axis)));
        }
        self.offsets_changed();
    }

    /// Group in the innermost system, and whether G159 selected it.
    pub(in crate::exec) fn zero_group(&self) -> (u32, bool) {
        let layer = self.layer();
        (layer.zero_group, layer.zero_group_by_value)
    }

    /// `V.G.NP_AKT`: replaces the active zero offset; the table keeps its value.
    pub(in crate::exec) fn set_zero_offset(&mut self, axis: usize, value_mm: f64) {
        self.change(axis, |layer| {
            layer.zero_written.insert(axis, value_mm);
        });
    }

    /// G160: excludes the entry of an axis from a group, or includes it again.
    pub(in crate::exec) fn mask_zero_entry(&mut self, group: u32, axis: usize, masked: bool) {
        if masked {
            self.zero_masked.insert((group, axis));
        } else {
            self.zero_masked.remove(&(group, axis));
        }
        self.offsets_changed();
    }

    /// `#PSET`: assigns this coordinate to the current position of the axis, in the innermost system; `None` (`#PRESET`)
    /// cancels it. The axis does not move. Within a system for main axes only.
    pub(in crate::exec) fn preset_position(&mut self, axis: usize, value_mm: Option<f64>) {
        if !self.systems.is_empty() {
            self.recompute_program();
            let here = self.program[axis];
            self.change(axis, |layer| match value_mm {
                Some(value) => layer.position_preset[axis] += here - value,
                None => layer.position_preset[axis] = 0.0,
            });
            return;
        }
        let before = self.lowest.position_preset[axis];
        let after = match value_mm {
            Some(value) => before + (self.target[axis] - self.applied[axis]) - value,
            None => 0.0,
        };
        self.lowest.position_preset[axis] = after;
        self.applied[axis] += after - before;
        self.recompute_program();
    }

    /// G92 offset in the layer where offsets of the axis are programmed.
    pub(in crate::exec) fn preset(&self, axis: usize) -> f64 {
        self.layer_of(axis).preset[axis]
    }

    pub(in crate::exec) fn set_preset(&mut self, axis: usize, value_mm: f64) {
        self.change(axis, |layer| layer.preset[axis] = value_mm);
    }

    /// Programmed distance of an axis from the turning centre in mm.
    pub(in crate::exec) fn turning_distance(&self, axis: usize) -> f64 {
        let presets = self.systems.iter().map(|layer| layer.preset[axis]).sum::<f64>();
        self.programmed(axis) + self.lowest.preset[axis] + presets
    }

    /// Machine position of the turning centre in mm.
    pub(in crate::exec) fn turning_centre(&self, axis: usize) -> f64 {
        self.target[axis] - self.turning_distance(axis)
    }

    /// Active coordinate systems.
    pub(in crate::exec) fn systems(&self) -> usize {
        self.systems.len()
    }

    /// Whether a main axis keeps its direction in the active coordinate systems: they only shift it, or turn the others
    /// about it.
    pub(in crate::exec) fn keeps_direction(&self, main: usize) -> bool {
        let systems = self.systems.iter().fold(Frame::IDENTITY, |f, layer| f.after(&layer.system));
        let mut unit = [0.0; 3];
        unit[main] = 1.0;
        // turns about the axis and back again may leave rounding errors
        systems.direction(unit).iter().zip(unit).all(|(a, b)| (a - b).abs() < 1e-12)
    }

    /// Whether a system or a contour rotation turns an axis, so that its words move other axes as well.
    pub(in crate::exec) fn is_turned(&self, axis: usize) -> bool {
        self.main_index(axis).is_some_and(|main| {
            let rotates = self.rotation.as_ref().is_some_and(|r| r.plane.contains(&main));
            rotates || !self.keeps_direction(main)
        })
    }

    /// Whether a stored system with this number is active.
    pub(in crate::exec) fn is_system_active(&self, number: u32) -> bool {
        let aside = self.suspended.as_ref().map_or(&[][..], |before| before.systems());
        self.systems.iter().chain(aside).any(|layer| layer.number == Some(number))
    }

    /// Activates a system within the active ones; `number`: the one under which it is stored.
    pub(in crate::exec) fn push_system(&mut self, frame: Frame, number: Option<u32>) {
        let axes = self.target.len();
        self.systems.push(Layer { number, ..Layer::new(frame, axes) });
        self.frame_changed();
    }

    /// Removes it with its offsets; without a system there is no effect.
    pub(in crate::exec) fn pop_system(&mut self) {
        self.systems.pop();
        self.frame_changed();
    }

    pub(in crate::exec) fn clear_systems(&mut self) {
        self.systems.clear();
        self.frame_changed();
    }
}
