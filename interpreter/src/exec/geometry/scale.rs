//! Factors by which the program's coordinates of the axes are enlarged or reduced (`#SCALE`).

/// Factors of all axes of the machine, in channel order.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::exec) struct Scale {
    factors: Vec<f64>,
    on: bool,
}

impl Scale {
    /// Nothing is scaled.
    pub(super) fn new(axes: usize) -> Self {
        Self { factors: vec![1.0; axes], on: false }
    }

    pub(in crate::exec) fn is_on(&self) -> bool {
        self.on
    }

    pub(in crate::exec) fn switch(&mut self, on: bool) {
        self.on = on;
    }

    /// Defines the factor of an axis, which is kept while scaling is off.
    pub(in crate::exec) fn set(&mut self, axis: usize, factor: f64) {
        self.factors[axis] = factor;
    }

    /// Factor in force.
    pub(in crate::exec) fn factor(&self, axis: usize) -> f64 {
        if self.on { self.factors[axis] } else { 1.0 }
    }

    /// True if a factor changes the coordinates of this axis.
    pub(in crate::exec) fn changes(&self, axis: usize) -> bool {
        self.factor(axis).to_bits() != 1.0_f64.to_bits()
    }
}
