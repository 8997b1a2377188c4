//! The values of the last cycles, by age.
//!
//! ```
//! use kontur_filters::ring::Ring;
//!
//! let mut ring = Ring::new(2, 0.5);
//! ring.push(1.0);
//! ring.push(2.0);
//! assert_eq!([0, 1, 2].map(|delay| ring.past(delay)), [2.0, 1.0, 0.5]);
//! ```

/// The newest inputs, at least one, as many as a power of two.
#[derive(Clone, Debug)]
pub struct Ring {
    values: Vec<f64>,
    newest: usize,
}

impl Ring {
    /// Room for delays up to `length`, filled with `x`.
    pub fn new(length: u32, x: f64) -> Self {
        Self { values: vec![x; Self::capacity(length)], newest: 0 }
    }

    fn capacity(length: u32) -> usize {
        (length as usize + 1).next_power_of_two()
    }

    /// Number of values kept.
    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.values.len()
    }

    /// Takes the value of this cycle.
    #[inline]
    pub fn push(&mut self, x: f64) {
        self.newest = (self.newest + 1) & (self.values.len() - 1);
        self.values[self.newest] = x;
    }

    /// The value of this cycle.
    #[inline]
    pub fn newest(&self) -> f64 {
        self.values[self.newest]
    }

    /// The value `delay` cycles ago, up to the length there is room for.
    #[inline]
    pub fn past(&self, delay: u32) -> f64 {
        self.values[self.newest.wrapping_sub(delay as usize) & (self.values.len() - 1)]
    }

    /// As if `x` had always been the value.
    pub fn fill(&mut self, x: f64) {
        self.values.fill(x);
    }

    /// Makes room for delays up to `length`; what is older than the history so far counts as its oldest value.
    pub(crate) fn grow(&mut self, length: u32) {
        let (old, new) = (self.values.len(), Self::capacity(length));
        if new <= old {
            return;
        }
        // Oldest first, then the room for older ones in front of it.
        self.values.rotate_left((self.newest + 1) & (old - 1));
        let oldest = self.values[0];
        self.values.splice(0..0, std::iter::repeat_n(oldest, new - old));
        self.newest = new - 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growing_keeps_the_history() {
        let mut ring = Ring::new(3, 0.0);
        for i in 1..=6 {
            ring.push(f64::from(i));
        }
        ring.grow(10);
        assert_eq!(ring.values.len(), 16);
        let past: Vec<f64> = (0..7).map(|delay| ring.past(delay)).collect();
        assert_eq!(past, [6.0, 5.0, 4.0, 3.0, 3.0, 3.0, 3.0]);
        ring.push(7.0);
        let past: Vec<f64> = [0, 1, 4].map(|delay| ring.past(delay)).to_vec();
        assert_eq!(past, [7.0, 6.0, 3.0]);
    }
}
