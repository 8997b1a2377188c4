//! Inputs of an axis in one cycle: while they stay the same, an axis at rest is skipped.

use super::AxisInputs;

/// The inputs of a cycle, as bits.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Given {
    set: u64,
    gain: u64,
    jerk_limited: bool,
    inputs: [u64; 3],
}

impl PartialEq for Given {
    /// All of them at once: they differ in almost every cycle of a moving axis, and what differs is of no interest. The derived
    /// comparison reads what has just been written in wider pieces, and waits for it.
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        let Self { set, gain, jerk_limited, inputs: [additional, force, offset] } = *self;
        let mut differ = (set ^ other.set) | (gain ^ other.gain);
        differ |= u64::from(jerk_limited != other.jerk_limited);
        differ |= (additional ^ other.inputs[0]) | (force ^ other.inputs[1]);
        differ |= offset ^ other.inputs[2];
        differ == 0
    }
}

impl Given {
    #[inline]
    pub(super) fn new(set_mm: f64, gain: f64, jerk_limited: bool, inputs: &AxisInputs) -> Self {
        let AxisInputs { additional_mm, force_mm_s2, encoder_offset_mm } = *inputs;
        let inputs = [additional_mm, force_mm_s2, encoder_offset_mm].map(f64::to_bits);
        Self { set: set_mm.to_bits(), gain: gain.to_bits(), jerk_limited, inputs }
    }
}
