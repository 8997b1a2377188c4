//! Inputs of an axis in one cycle: while they stay the same, an axis at rest is not computed.

/// External influences on an axis; none by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisInputs {
    /// Position of the additional interface after its filter in mm, added to the set position.
    ///
    /// Controller and feedforward use the sum; the monitors of the set position and of the exact stop see the
    /// programmed part only (Assumption: the documents only name the interface).
    pub additional_mm: f64,
    /// External force (friction, process) in mm/s2, as the acceleration of the whole mass.
    pub force_mm_s2: f64,
    /// Error of the measuring system of the position loop in mm.
    pub encoder_offset_mm: f64,
}

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
