//! The set points of a plan under examination. Each is computed once: both directions of the measurement use the same
//! ones, stretch by stretch.

use super::ranges::CHUNK;
use super::view::{Buffer, View};

/// Maximum number of set points kept, so that long plans need little memory.
const MOST: u64 = 4 * CHUNK;
/// Cycle number of an empty row.
const NONE: u64 = u64::MAX;

/// Cache of set points, see the module.
pub(super) struct SetPoints<'a> {
    buffer: Buffer<'a>,
    axes: usize,
    /// Cycle of each row; cycle `k` uses row `k` modulo the number of rows.
    cycles: Vec<u64>,
    /// Rows: set point, path length beside it, path length.
    rows: Vec<f64>,
    /// Start of the row of the last cycle requested.
    at: usize,
}

impl<'a> SetPoints<'a> {
    pub(super) fn new(view: &'a View<'a>) -> Self {
        let reach = u64::from(view.trial.kernels.length());
        let ahead = (view.rest() as u64).saturating_sub(view.trial.now);
        let count = (ahead + 8 * (reach + 1)).min(MOST) as usize;
        let buffer = Buffer::new(view);
        let axes = buffer.set().len();
        let (cycles, rows) = (vec![NONE; count], vec![0.0; count * (axes + 2)]);
        Self { buffer, axes, cycles, rows, at: 0 }
    }

    /// Number of axes.
    pub(super) fn axes(&self) -> usize {
        self.axes
    }

    /// Selects cycle `k`, and computes it if needed.
    pub(super) fn step(&mut self, k: u64) {
        let row = (k % self.cycles.len() as u64) as usize;
        self.at = row * (self.axes + 2);
        if self.cycles[row] != k {
            #[cfg(test)]
            crate::closed_forms::add();
            self.buffer.seek(k);
            self.buffer.step(k);
            let (set, rest) = self.rows[self.at..][..self.axes + 2].split_at_mut(self.axes);
            set.copy_from_slice(self.buffer.set());
            (rest[0], rest[1]) = (self.buffer.beside(), self.buffer.s());
            self.cycles[row] = k;
        }
    }

    /// Set point of the selected cycle.
    pub(super) fn set(&self) -> &[f64] {
        &self.rows[self.at..][..self.axes]
    }

    /// See [`Buffer::beside`].
    pub(super) fn beside(&self) -> f64 {
        self.rows[self.at + self.axes]
    }

    /// Path length of the selected cycle.
    pub(super) fn s(&self) -> f64 {
        self.rows[self.at + self.axes + 1]
    }
}
