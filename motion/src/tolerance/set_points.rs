//! The set points of a plan under examination. Each is computed once: both directions of the measurement use the same
//! ones, stretch by stretch.

use super::ranges::CHUNK;
use super::view::{Buffer, View};

/// Maximum number of set points kept, so that long plans need little memory.
const MOST: u64 = 4 * CHUNK;
/// Cycle number of an empty row.
const NONE: u64 = u64::MAX;
/// Number of rows for which memory is reserved at once: most examinations ask for a few stretches of the plan only.
const PAGE: usize = 64;

/// Cache of set points, see the module.
pub(super) struct SetPoints<'a> {
    buffer: Buffer<'a>,
    axes: usize,
    /// Cycle of each row; cycle `k` uses row `k` modulo the number of rows.
    cycles: Vec<u64>,
    /// Rows in pages, the latter empty until one of their rows is requested: set point, path length beside it, path
    /// length.
    pages: Vec<Vec<f64>>,
    /// Page and start in it of the row of the last cycle requested.
    at: (usize, usize),
}

impl<'a> SetPoints<'a> {
    pub(super) fn new(view: &'a View<'a>) -> Self {
        let reach = u64::from(view.trial.kernels.length());
        let ahead = (view.rest() as u64).saturating_sub(view.trial.now);
        let count = (ahead + 8 * (reach + 1)).min(MOST) as usize;
        let buffer = Buffer::new(view);
        let axes = buffer.set().len();
        let (cycles, pages) = (vec![NONE; count], vec![Vec::new(); count.div_ceil(PAGE)]);
        Self { buffer, axes, cycles, pages, at: (0, 0) }
    }

    /// Number of axes.
    pub(super) fn axes(&self) -> usize {
        self.axes
    }

    /// Selects cycle `k`, and computes it if needed.
    pub(super) fn step(&mut self, k: u64) {
        let row = (k % self.cycles.len() as u64) as usize;
        let width = self.axes + 2;
        self.at = (row / PAGE, row % PAGE * width);
        if self.cycles[row] != k {
            #[cfg(test)]
            crate::closed_forms::add();
            self.buffer.seek(k);
            self.buffer.step(k);
            let page = &mut self.pages[self.at.0];
            if page.is_empty() {
                page.resize(PAGE * width, 0.0);
            }
            let (set, rest) = page[self.at.1..][..width].split_at_mut(self.axes);
            set.copy_from_slice(self.buffer.set());
            (rest[0], rest[1]) = (self.buffer.beside(), self.buffer.s());
            self.cycles[row] = k;
        }
    }

    /// Set point of the selected cycle.
    pub(super) fn set(&self) -> &[f64] {
        &self.row()[..self.axes]
    }

    /// See [`Buffer::beside`].
    pub(super) fn beside(&self) -> f64 {
        self.row()[self.axes]
    }

    /// Path length of the selected cycle.
    pub(super) fn s(&self) -> f64 {
        self.row()[self.axes + 1]
    }

    fn row(&self) -> &[f64] {
        &self.pages[self.at.0][self.at.1..]
    }
}
