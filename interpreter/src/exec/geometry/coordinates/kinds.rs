//! Words that move axes or shift their coordinates.

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
