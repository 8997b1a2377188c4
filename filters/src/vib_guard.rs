//! Vibration Guard: a kernel per mode, frequency and damping that does not excite one natural frequency.
//!
//! The kernels are zero-vibration input shapers. The vendor does not publish the impulses, only which modes are
//! symmetric and how far the frequency may be off for a residual vibration of 5 % at damping 0.1. The four shapers
//! below are the family that fits that table.
//!
//! Source: TF5250 Vibration Guard (modes, ranges, sensitivity table), P-AXIS-00568, 00571, 00589.
//! Assumption: the impulses, identified from the sensitivity table.
//!
//! Order of calls: settings, their kernel, then the [shaping chain](crate::shaping) that runs it.
//!
//! ```
//! use kontur_filters::response::residual_vibration_ratio;
//! use kontur_filters::time::CycleTime;
//! use kontur_filters::vib_guard::VibGuardSettings;
//!
//! let settings = VibGuardSettings { mode: 1, freq_hz: 40.0, damping: 0.1 };
//! let kernel = settings.kernel(CycleTime::DEFAULT).unwrap();
//! let left = |freq_hz| residual_vibration_ratio(&kernel.impulses(CycleTime::DEFAULT), freq_hz, 0.1);
//! assert!(left(40.0) < 1e-9 && left(30.0) > 0.1);
//! ```

use crate::kernel::{Kernel, Tap};
use crate::response::Impulse;
use crate::time::CycleTime;
use crate::vibration::damped_ratio;
use std::f64::consts::PI;

/// Settings of `vib_guard.*` in an axis list or of `#VIB GUARD` for one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VibGuardSettings {
    /// Shaper, 1 to 4, default 1. Modes 1 to 3: the two-impulse shaper once, twice and three times, each less sensitive
    /// to a wrong frequency and with a larger contour error than the one before; mode 4 is the symmetric one.
    ///
    /// Source: TF5250, P-AXIS-00571.
    pub mode: u8,
    /// Undamped natural frequency in Hz that is not to be excited, at least 1, default 30. Source: TF5250,
    /// P-AXIS-00589.
    pub freq_hz: f64,
    /// Damping ratio of that vibration, 0 to 1, default 0.1; not realisable above 0.99. Source: TF5250, P-AXIS-00568.
    pub damping: f64,
}

impl Default for VibGuardSettings {
    fn default() -> Self {
        Self { mode: 1, freq_hz: 30.0, damping: 0.1 }
    }
}

/// Why settings of the Vibration Guard give no kernel.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum VibGuardError {
    /// Vendor error 22062: there is no such mode.
    #[error("Vibration Guard mode {mode}, allowed: 1 to 4")]
    Mode {
        /// The configured mode.
        mode: u8,
    },
    /// K-VIB-RANGE: the frequency is below [`VibGuardSettings::MIN_FREQ_HZ`] or not a number.
    #[error("Vibration Guard frequency {freq_hz} Hz, minimum {} Hz", VibGuardSettings::MIN_FREQ_HZ)]
    Frequency {
        /// The configured frequency in Hz.
        freq_hz: f64,
    },
    /// K-VIB-RANGE: the damping is outside 0 to 1 or not a number.
    #[error("Vibration Guard damping {damping}, allowed: 0 to 1")]
    Damping {
        /// The configured damping.
        damping: f64,
    },
    /// Vendor error 50820: half a damped period is shorter than a cycle, or the kernel would be too long.
    #[error(
        "Vibration Guard frequency {freq_hz} Hz with damping {damping}; half a damped period must be at least one cycle and the damping at most {}",
        VibGuardSettings::MAX_DAMPING
    )]
    NotRealisable {
        /// The configured frequency in Hz.
        freq_hz: f64,
        /// The configured damping.
        damping: f64,
    },
}

impl VibGuardSettings {
    /// Lowest frequency in Hz. Source: P-AXIS-00589.
    pub const MIN_FREQ_HZ: f64 = 1.0;
    /// Largest damping with a kernel: towards 1 the damped period, and with it the kernel, grows without bound.
    pub const MAX_DAMPING: f64 = 0.99;
    /// Longest kernel in taps. Assumption: a bound that prevents exhausting memory, 16 s at 1 ms.
    pub(crate) const MAX_TAPS: u32 = 16_384;

    /// The kernel of these settings at the cycle time `cycle`.
    ///
    /// The impulse times of a zero-vibration shaper are not multiples of the cycle, and rounding them would leave 5 %
    /// of the vibration from 40 Hz on at 1 ms. Instead the second impulse is split over the two cycles around its time
    /// such that the zeros lie exactly on the poles of the vibration.
    ///
    /// # Errors
    ///
    /// [`VibGuardError`], by the IDs 22062, K-VIB-RANGE and 50820.
    pub fn kernel(&self, cycle: CycleTime) -> Result<Kernel, VibGuardError> {
        let Self { mode, freq_hz, damping } = *self;
        if !(1..=4).contains(&mode) {
            return Err(VibGuardError::Mode { mode });
        }
        if !(freq_hz.is_finite() && freq_hz >= Self::MIN_FREQ_HZ) {
            return Err(VibGuardError::Frequency { freq_hz });
        }
        if !(0.0..=1.0).contains(&damping) {
            return Err(VibGuardError::Damping { damping });
        }
        let zv =
            self.zero_vibration(cycle).ok_or(VibGuardError::NotRealisable { freq_hz, damping })?;
        let kernel = match mode {
            1 => zv,
            2 => zv.convolve(&zv),
            3 => zv.convolve(&zv).convolve(&zv),
            _ => zv.convolve(&zv.reversed()),
        };
        if kernel.length() >= Self::MAX_TAPS {
            return Err(VibGuardError::NotRealisable { freq_hz, damping });
        }
        Ok(kernel)
    }

    /// The impulses of the ideal shaper, before they are put on the cycle grid; `None` for
    /// settings that give no kernel in any cycle time.
    ///
    /// `K = exp(-z pi / sqrt(1 - z^2))`, impulses half a damped period `1 / (2 f sqrt(1 - z^2))` apart; modes 1 to 3
    /// the powers of `(1 + K) / (1 + K)`, mode 4 mode 1 and its time reverse in series.
    pub fn ideal_impulses(&self) -> Option<Vec<Impulse>> {
        let usable = self.freq_hz.is_finite()
            && self.freq_hz >= Self::MIN_FREQ_HZ
            && (0.0..=Self::MAX_DAMPING).contains(&self.damping);
        let root = damped_ratio(self.damping);
        let k = libm::exp(-self.damping * PI / root);
        let amplitudes = match self.mode {
            1 => vec![1.0, k],
            2 => vec![1.0, 2.0 * k, k * k],
            3 => vec![1.0, 3.0 * k, 3.0 * k * k, k * k * k],
            4 => vec![k, 1.0 + k * k, k],
            _ => return None,
        };
        let half_period_s = 0.5 / (self.freq_hz * root);
        let sum: f64 = amplitudes.iter().sum();
        let impulse = |(amplitude, i): (f64, u32)| Impulse {
            time_s: f64::from(i) * half_period_s,
            amplitude: amplitude / sum,
        };
        usable.then(|| amplitudes.into_iter().zip(0..).map(impulse).collect())
    }

    /// Mode 1 on the cycle grid: the taps a, b, c at 0, n, n + 1 whose sum is 1 and whose transfer function vanishes
    /// at the poles `s = -z w +- j w sqrt(1 - z^2)` of the vibration.
    ///
    /// With `theta = w sqrt(1 - z^2) T`, `e = exp(z w T)` and `u = pi / theta` half a damped period in cycles,
    /// `n = floor(u)`, the two equations `a + b exp(-s n T) + c exp(-s (n + 1) T) = 0` (real and imaginary part) have
    /// the solution `a : b : c = sin theta : sin((n + 1 - u) theta) e^-n : sin((u - n) theta) e^-(n + 1)`, which is
    /// never negative. If u is an integer, c vanishes and the two impulses of the textbook remain.
    fn zero_vibration(&self, cycle: CycleTime) -> Option<Kernel> {
        /// Half a period this close to a whole number of cycles counts as one: the split would only reflect rounding
        /// errors.
        const WHOLE: f64 = 1e-10;
        if self.damping > Self::MAX_DAMPING {
            return None;
        }
        let root = damped_ratio(self.damping);
        let half_period_cycles = 1e6 / (2.0 * self.freq_hz * f64::from(cycle.us()) * root);
        if half_period_cycles > f64::from(Self::MAX_TAPS) {
            return None;
        }
        let nearest = half_period_cycles.round();
        let whole = (half_period_cycles - nearest).abs() <= WHOLE * nearest;
        let u = if whole { nearest } else { half_period_cycles };
        if u < 1.0 {
            return None;
        }
        let n = u.floor();
        let theta = PI / u;
        let decay = |cycles: f64| libm::exp(-self.damping / root * theta * cycles);
        let delay = n as u32;
        Kernel::from_taps([
            Tap { delay: 0, weight: libm::sin(theta) },
            Tap { delay, weight: libm::sin((n + 1.0 - u) * theta) * decay(n) },
            Tap { delay: delay + 1, weight: libm::sin((u - n) * theta) * decay(n + 1.0) },
        ])
    }
}
