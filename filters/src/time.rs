//! The interpolation cycle: a whole number of microseconds, counted and never accumulated.
//!
//! Order of calls: make the cycle first; every design and every planner takes it.
//!
//! ```
//! use kontur_filters::time::CycleTime;
//!
//! let cycle = CycleTime::from_us(500).unwrap();
//! // counted: no sum of rounded cycles after a day
//! assert_eq!(cycle.time_of(2 * 86_400_000 / 10), 8640.0);
//! assert!(CycleTime::from_us(50).is_none());
//! ```

/// Length of one interpolator cycle `T`.
///
/// Range 100 to 20 000 us; the vendor has no parameter for it (it is the cycle of the GEO task).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CycleTime {
    us: u32,
}

impl CycleTime {
    /// Shortest accepted cycle in us.
    pub(crate) const MIN_US: u32 = 100;
    /// Longest accepted cycle in us.
    pub(crate) const MAX_US: u32 = 20_000;
    /// The default of 1 ms.
    pub const DEFAULT: Self = Self { us: 1000 };

    /// A cycle of `us` microseconds, `None` outside 100..=20 000.
    pub const fn from_us(us: u32) -> Option<Self> {
        if us >= Self::MIN_US && us <= Self::MAX_US { Some(Self { us }) } else { None }
    }

    /// Length in microseconds.
    pub const fn us(self) -> u32 {
        self.us
    }

    /// Length in seconds, correctly rounded.
    pub fn seconds(self) -> f64 {
        f64::from(self.us) / 1e6
    }

    /// Time of cycle `k` in seconds, rounded once for any `k`.
    pub fn time_of(self, k: u64) -> f64 {
        (k as f64 * f64::from(self.us)) / 1e6
    }
}
