//! The set points of a plan under examination, each computed once: what leaves the contour and what of it is missed are looked
//! for along the same ones, stretch by stretch.

use super::ranges::CHUNK;
use super::view::{Buffer, View};

/// Set points kept, at most, so that long plans need little memory.
const MOST: u64 = 4 * CHUNK;
/// Cycle of a row that holds nothing.
const NONE: u64 = u64::MAX;

/// See the module.
pub(super) struct SetPoints<'a> {
    buffer: Buffer<'a>,
    axes: usize,
    /// Cycle of each row; a cycle has the row of its number, counted around.
    cycles: Vec<u64>,
    /// Rows of set point, mean path length and path length.
    rows: Vec<f64>,
    /// Where the row of the cycle asked for last begins.
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

    /// Goes to cycle `k`.
    pub(super) fn step(&mut self, k: u64) {
        let row = (k % self.cycles.len() as u64) as usize;
        self.at = row * (self.axes + 2);
        if self.cycles[row] != k {
            self.buffer.seek(k);
            self.buffer.step(k);
            let (set, rest) = self.rows[self.at..][..self.axes + 2].split_at_mut(self.axes);
            set.copy_from_slice(self.buffer.set());
            (rest[0], rest[1]) = (self.buffer.middle(), self.buffer.s());
            self.cycles[row] = k;
        }
    }

    /// Set point of the cycle.
    pub(super) fn set(&self) -> &[f64] {
        &self.rows[self.at..][..self.axes]
    }

    /// See [`Buffer::middle`].
    pub(super) fn middle(&self) -> f64 {
        self.rows[self.at + self.axes]
    }

    /// Path length of the cycle.
    pub(super) fn s(&self) -> f64 {
        self.rows[self.at + self.axes + 1]
    }
}
