//! Random numbers that are the same everywhere, without a dependency.

/// Linear congruential generator; the number is its seed.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// From 0 up to, not including, 1.
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Evenly spread.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// Every decade as likely as the others.
    pub(crate) fn log(&mut self, low: f64, high: f64) -> f64 {
        low * libm::pow(high / low, self.next())
    }

    /// True in this share of the cases.
    pub(crate) fn chance(&mut self, share: f64) -> bool {
        self.next() < share
    }

    /// One of several values.
    pub(crate) fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[(self.next() * of.len() as f64) as usize]
    }

    /// Points of a contour of lines: corners, gentle bends, or up to `chords` chords of arcs.
    pub(crate) fn contour(&mut self, chords: u32) -> Vec<[f64; 3]> {
        let kinds = [(2.8, 0.05, 20.0, 20), (0.2, 0.05, 5.0, 20), (0.03, 0.1, 0.3, chords)];
        let (turn, low, high, most) = self.pick(&kinds);
        let count = 3 + (self.next() * f64::from(most)) as usize;
        let (mut at, mut heading) = ([0.0_f64; 3], 6.3 * self.next());
        let curve = turn * self.between(-0.5, 0.5);
        let mut out = vec![at];
        for _ in 0..count {
            heading += curve + turn * self.between(-0.5, 0.5);
            let (sin, cos) = libm::sincos(heading);
            let l = self.log(low, high);
            at = [at[0] + l * cos, at[1] + l * sin, at[2] + 0.2 * l * self.between(-1.0, 1.0)];
            out.push(at);
        }
        out
    }
}
