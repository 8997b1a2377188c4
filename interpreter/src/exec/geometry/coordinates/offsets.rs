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

use super::Coordinates;
use super::kinds::OffsetKind;
use super::layer::{Layer, NO_GROUP};

impl Coordinates {
    /// The innermost system.
    fn layer(&self) -> &Layer {
        self.active.systems.last().unwrap_or(&self.active.lowest)
    }

    /// The layer in which offsets of an axis are programmed: the innermost system, or the channel.
    fn layer_of(&self, axis: usize) -> &Layer {
        if self.is_of_channel(axis) { &self.active.lowest } else { self.layer() }
    }

    /// Changes offsets of an axis where they are programmed.
    fn change(&mut self, axis: usize, change: impl FnOnce(&mut Layer)) {
        let channel = self.is_of_channel(axis);
        let innermost = self.active.systems.last_mut().filter(|_| !channel);
        change(innermost.unwrap_or(&mut self.active.lowest));
        self.offsets_changed();
    }

    /// Whether the offsets of the axis belong to the channel instead of a coordinate system.
    pub(super) fn is_of_channel(&self, axis: usize) -> bool {
        self.active.channel_group.is_some() && self.main_index(axis).is_none()
    }

    /// Scope of the zero offsets, and the group at program start. `has_g53`: P-ZERO-00001; `in_systems`: P-CHAN-00397.
    pub(in crate::exec) fn use_zero_groups(&mut self, has_g53: bool, in_systems: bool, start: u32) {
        self.zeros.has_g53 = has_g53;
        self.active.channel_group = (!in_systems).then_some(NO_GROUP);
        self.select_zero_group(start, false);
    }

    /// Offsets in systems are part of the frame.
    fn offsets_changed(&mut self) {
        if !self.active.systems.is_empty() {
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
        if self.zeros.is_empty() {
            return 0.0;
        }
        let of_channel = self.active.channel_group.filter(|_| self.main_index(axis).is_none());
        self.zeros.offset(of_channel.unwrap_or(layer.zero_group), axis)
    }

    /// Active zero offset in the layer where offsets of the axis are programmed.
    pub(in crate::exec) fn zero_offset(&self, axis: usize) -> f64 {
        self.layer_zero(self.layer_of(axis), axis)
    }

    /// Entry of the zero-offset table.
    pub(in crate::exec) fn zero_entry(&self, group: u32, axis: usize) -> f64 {
        self.zeros.entry(group, axis)
    }

    pub(in crate::exec) fn set_zero_entry(&mut self, group: u32, axis: usize, value_mm: f64) {
        self.zeros.write(group, axis, value_mm, self.target.len());
        self.offsets_changed();
    }

    /// G53 (group 0), G54 to G59; G159 is `by_value`.
    pub(in crate::exec) fn select_zero_group(&mut self, group: u32, by_value: bool) {
        let layer = self.active.systems.last_mut().unwrap_or(&mut self.active.lowest);
        layer.zero_group = group;
        layer.zero_group_by_value = by_value;
        layer.zero_written.clear();
        if self.active.channel_group.is_some() {
            self.active.channel_group = Some(group);
            let main = self.main;
            self.active.lowest.zero_written.retain(|axis, _| main.contains(&Some(*axis)));
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
        self.zeros.mask(group, axis, masked);
        self.offsets_changed();
    }

    /// `#PSET`: assigns this coordinate to the current position of the axis, in the innermost system; `None` (`#PRESET`)
    /// cancels it. The axis does not move. Within a system for main axes only.
    pub(in crate::exec) fn preset_position(&mut self, axis: usize, value_mm: Option<f64>) {
        if !self.active.systems.is_empty() {
            self.recompute_program();
            let here = self.program[axis];
            self.change(axis, |layer| match value_mm {
                Some(value) => layer.position_preset[axis] += here - value,
                None => layer.position_preset[axis] = 0.0,
            });
            return;
        }
        let before = self.active.lowest.position_preset[axis];
        let after = match value_mm {
            Some(value) => before + (self.target[axis] - self.active.applied[axis]) - value,
            None => 0.0,
        };
        self.active.lowest.position_preset[axis] = after;
        self.active.applied[axis] += after - before;
        self.recompute_program();
    }

    /// G92 offset in the layer where offsets of the axis are programmed.
    pub(in crate::exec) fn preset(&self, axis: usize) -> f64 {
        self.layer_of(axis).preset[axis]
    }

    pub(in crate::exec) fn set_preset(&mut self, axis: usize, value_mm: f64) {
        self.change(axis, |layer| layer.preset[axis] = value_mm);
    }

    /// Position of an axis in mm with its tool at the turning centre: the programmed coordinate and its G92 offset are 0
    /// there. `None` where rotation makes other axes part of the coordinate.
    ///
    /// Assumption: other offsets move the centre where they are programmed, although the axis itself follows only when it
    /// is programmed next; the tool is as far from the workpiece in both blocks.
    pub(in crate::exec) fn turning_centre(&self, axis: usize) -> Option<f64> {
        let presets = self.active.systems.iter().map(|layer| layer.preset[axis]).sum::<f64>();
        let offset = self.active_offset(axis) - self.active.lowest.preset[axis];
        let Some(main) = self.main_index(axis) else { return Some(offset - presets) };
        let row = self.frame.m[main];
        let is_rotated = (0..3).any(|i| i != main && row[i] != 0.0);
        (!is_rotated).then(|| offset + self.frame.t[main] - row[main] * presets)
    }
}
