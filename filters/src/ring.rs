//! The values of the last cycles by age, contiguous in memory, so that many cycles can be read as one slice.
//!
//! ```
//! use kontur_filters::ring::Ring;
//!
//! let mut ring = Ring::new(2, 0.5);
//! ring.extend(&[1.0, 2.0]);
//! assert_eq!([0, 1, 2].map(|delay| ring.past(delay)), [2.0, 1.0, 0.5]);
//! // of both cycles the value one cycle before
//! assert_eq!(ring.recent(2, 1), [0.5, 1.0]);
//! ```

/// The newest inputs, at least one.
#[derive(Clone, Debug)]
pub struct Ring {
    /// The values that are kept, and room for new ones.
    values: Vec<f64>,
    /// Number of values up to the newest one.
    end: usize,
    /// Number of values that can be read.
    kept: usize,
}

impl Ring {
    /// Most cycles that can be taken at once.
    pub const ROOM: usize = 256;

    /// A ring with room for delays up to `length`, filled with `x`.
    pub fn new(length: u32, x: f64) -> Self {
        let kept = length as usize + 1;
        Self { values: vec![x; kept + Self::ROOM], end: kept, kept }
    }

    /// Number of values kept.
    #[inline]
    pub(crate) const fn len(&self) -> usize {
        self.kept
    }

    /// Takes the value of the next cycle.
    #[inline]
    pub fn push(&mut self, x: f64) {
        if self.end == self.values.len() {
            self.move_to_front();
        }
        self.values[self.end] = x;
        self.end += 1;
    }

    #[cold]
    fn move_to_front(&mut self) {
        self.values.copy_within(self.end - self.kept..self.end, 0);
        self.end = self.kept;
    }

    /// Takes the values of the next cycles, at most [`Self::ROOM`].
    #[inline]
    pub fn extend(&mut self, values: &[f64]) {
        if self.end + values.len() > self.values.len() {
            self.move_to_front();
        }
        self.values[self.end..][..values.len()].copy_from_slice(values);
        self.end += values.len();
    }

    /// Undoes the last `cycles` values, all taken at once; the values before them are still stored.
    #[inline]
    pub fn take_back(&mut self, cycles: usize) {
        debug_assert!(self.end >= self.kept + cycles, "more than were taken at once");
        self.end -= cycles;
    }

    /// The value of the present cycle.
    #[inline]
    pub fn newest(&self) -> f64 {
        self.values[self.end - 1]
    }

    /// The value `delay` cycles ago, up to the capacity.
    #[inline]
    pub fn past(&self, delay: u32) -> f64 {
        self.values[self.end - 1 - delay as usize]
    }

    /// For each of the last `cycles` values, taken at once, the value `delay` cycles earlier.
    #[inline]
    pub fn recent(&self, cycles: usize, delay: u32) -> &[f64] {
        &self.values[self.end - cycles - delay as usize..][..cycles]
    }

    /// Fills the history as if `x` had always been the value.
    pub fn fill(&mut self, x: f64) {
        self.values.fill(x);
    }

    /// Makes room for delays up to `length`; values older than the history so far are taken to equal its oldest one.
    pub(crate) fn grow(&mut self, length: u32) {
        let kept = length as usize + 1;
        if kept <= self.kept {
            return;
        }
        let mut grown = Self::new(length, self.past(self.kept as u32 - 1));
        let known = &self.values[self.end - self.kept..self.end];
        grown.values[kept - self.kept..kept].copy_from_slice(known);
        *self = grown;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against a list of all values, over many moves to the front.
    #[test]
    fn what_is_taken_back_was_never_there() {
        let mut ring = Ring::new(5, 0.0);
        let mut all = vec![0.0; 6];
        for i in 1..2000_u32 {
            let row: Vec<f64> =
                (0..i % 257).map(|j| f64::from(i) + f64::from(j) / 1024.0).collect();
            ring.extend(&row);
            if i % 3 == 0 {
                ring.take_back(row.len());
            } else {
                all.extend(row);
            }
            ring.push(f64::from(i));
            all.push(f64::from(i));
            let past: Vec<f64> = (0..6).rev().map(|age| ring.past(age)).collect();
            assert_eq!(past, all[all.len() - 6..], "{i}");
        }
    }

    #[test]
    fn growing_keeps_the_history() {
        let mut ring = Ring::new(3, 0.0);
        for i in 1..=6 {
            ring.extend(&[f64::from(i)]);
        }
        ring.grow(10);
        let past: Vec<f64> = (0..7).map(|delay| ring.past(delay)).collect();
        assert_eq!(past, [6.0, 5.0, 4.0, 3.0, 3.0, 3.0, 3.0]);
        ring.extend(&[7.0]);
        let past: Vec<f64> = [0, 1, 4].map(|delay| ring.past(delay)).to_vec();
        assert_eq!(past, [7.0, 6.0, 3.0]);
    }
}
