//! The causes found for the violations of one round.

use super::violation::Violation;

/// The excesses of one round, by cause.
pub(super) struct Findings {
    /// Largest excess in mm attributed to each boundary alone.
    pub(super) corner: Vec<f64>,
    /// Even speed in mm/s demanded of each block.
    pub(super) even: Vec<f64>,
    /// The same for each boundary.
    pub(super) even_at: Vec<f64>,
    /// Largest excess in mm and its tolerance for each block to blame.
    pub(super) block: Vec<Option<(f64, f64)>>,
    /// First and last mark within reach of the last violation examined of either kind, with its excess.
    pub(super) last: [Option<((usize, usize), f64)>; 2],
}

impl Findings {
    pub(super) fn none(blocks: usize) -> Self {
        Self {
            corner: vec![0.0; blocks + 1],
            even: vec![f64::INFINITY; blocks],
            even_at: vec![f64::INFINITY; blocks + 1],
            block: vec![None; blocks],
            last: [None; 2],
        }
    }

    /// Demands an even speed of a block because of a violation.
    pub(super) fn evenly(&mut self, block: usize, speed: f64, v: &Violation) {
        self.even[block] = self.even[block].min(speed);
        let slot = &mut self.block[block];
        if slot.is_none_or(|(e, _)| e < v.excess()) {
            *slot = Some((v.excess(), v.tolerance_mm));
        }
    }
}
