//! Factors by which programmed coordinates of the axes are scaled (`#SCALE`).

/// Factors of all axes of the machine, in channel order.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::exec) struct Scale {
    factors: Vec<f64>,
    on: bool,
}

impl Scale {
    /// Without scaling.
    pub(super) fn new(axes: usize) -> Self {
        Self { factors: vec![1.0; axes], on: false }
    }

    pub(in crate::exec) fn is_on(&self) -> bool {
        self.on
    }

    pub(in crate::exec) fn switch(&mut self, on: bool) {
        self.on = on;
    }

    /// Defines the factor of an axis; it is kept while scaling is off.
    pub(in crate::exec) fn set(&mut self, axis: usize, factor: f64) {
        self.factors[axis] = factor;
    }

    /// Whether every axis has the factor 1.
    pub(in crate::exec) fn is_one(&self) -> bool {
        self.factors.iter().all(|factor| factor.to_bits() == 1.0_f64.to_bits())
    }

    /// Active factor.
    pub(in crate::exec) fn factor(&self, axis: usize) -> f64 {
        if self.on { self.factors[axis] } else { 1.0 }
    }

    /// Whether a factor changes the coordinates of this axis.
    pub(in crate::exec) fn changes(&self, axis: usize) -> bool {
        self.factor(axis).to_bits() != 1.0_f64.to_bits()
    }
}
