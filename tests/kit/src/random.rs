//! Random numbers that are the same everywhere, without a dependency.

/// Linear congruential generator; two generators of the same seed give the same numbers.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// A generator for a seed; neighbouring seeds give unrelated numbers.
    pub fn new(seed: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(1));
        for _ in 0..4 {
            random.ratio();
        }
        random
    }

    /// A generator with the given number as its state.
    pub fn from_state(state: u64) -> Self {
        Self(state)
    }

    /// 64 bits; the upper ones are good, the lower ones repeat after a short period.
    pub fn bits(&mut self) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0
    }

    /// From 0 up to but not including 1.
    pub fn ratio(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Evenly spread.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.ratio()
    }

    /// Each decade as likely as the others.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        low * libm::pow(high / low, self.ratio())
    }

    /// Normal distribution with mean 0 and standard deviation 1 (Box-Muller).
    pub fn normal(&mut self) -> f64 {
        let (a, b) = (self.ratio().max(f64::MIN_POSITIVE), self.ratio());
        (-2.0 * libm::log(a)).sqrt() * libm::cos(std::f64::consts::TAU * b)
    }

    /// 0 to `count - 1`.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 <= ratio < 1")]
    pub fn below(&mut self, count: usize) -> usize {
        (self.ratio() * count as f64) as usize
    }

    /// True in the given share of the cases.
    pub fn chance(&mut self, share: f64) -> bool {
        self.ratio() < share
    }

    /// One of several values.
    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }
}

/// An integer from the environment, else `default`.
pub fn environment(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(default)
}

/// Number of random cases of a test: `COUNT` of the environment, else `default`.
pub fn count(default: usize) -> usize {
    environment("COUNT", default as u64) as usize
}

/// First seed of a test: `SEED` of the environment, else 1.
pub fn seed() -> u64 {
    environment("SEED", 1)
}
