//! Inputs of an axis in one cycle: while they stay the same, an axis at rest is not computed.

use super::AxisInputs;

/// The inputs of a cycle, as bits.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Given {
    pub(super) set: u64,
    gain: u64,
    jerk_limited: bool,
    inputs: [u64; 3],
}

impl Given {
    /// These inputs with the set position 0.
    #[inline]
    pub(super) fn new(gain: f64, jerk_limited: bool, inputs: &AxisInputs) -> Self {
        let AxisInputs { additional_mm, force_mm_s2, encoder_offset_mm } = *inputs;
        let inputs = [additional_mm.to_bits(), force_mm_s2.to_bits(), encoder_offset_mm.to_bits()];
        Self { set: 0, gain: gain.to_bits(), jerk_limited, inputs }
    }

    /// Whether the inputs are equal apart from the set position.
    #[inline]
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.gain == other.gain
            && self.jerk_limited == other.jerk_limited
            && self.inputs == other.inputs
    }
}
