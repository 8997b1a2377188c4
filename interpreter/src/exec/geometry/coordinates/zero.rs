//! The table of zero offsets.

use kontur_motion::axis::AxisVec;
use std::collections::{BTreeMap, BTreeSet};

/// Last group of the table (P-ZERO-00002).
pub(in crate::exec) const LAST_ZERO_GROUP: u32 = 96;

/// Zero offsets by group.
#[derive(Clone, Debug, Default)]
pub(super) struct ZeroOffsets {
    groups: BTreeMap<u32, AxisVec>,
    /// Whether G53 has its own offsets (P-ZERO-00001).
    pub(super) has_g53: bool,
    /// Axes with entries excluded from a group (G160).
    masked: BTreeSet<(u32, usize)>,
}

impl ZeroOffsets {
    /// The entry, whether it is excluded or not.
    pub(super) fn entry(&self, group: u32, axis: usize) -> f64 {
        self.groups.get(&group).map_or(0.0, |offsets| offsets[axis])
    }

    /// The offset of an axis while a group is active.
    #[inline]
    pub(super) fn offset(&self, group: u32, axis: usize) -> f64 {
        if (group == 0 && !self.has_g53) || self.masked.contains(&(group, axis)) {
            return 0.0;
        }
        self.entry(group, axis)
    }

    /// Whether no entry was ever written.
    pub(super) fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    pub(super) fn write(&mut self, group: u32, axis: usize, value_mm: f64, axes: usize) {
        self.groups.entry(group).or_insert_with(|| AxisVec::zeros(axes))[axis] = value_mm;
    }

    /// Excludes the entry of an axis from a group, or includes it again.
    pub(super) fn mask(&mut self, group: u32, axis: usize, masked: bool) {
        if masked {
            self.masked.insert((group, axis));
        } else {
            self.masked.remove(&(group, axis));
        }
    }
}
