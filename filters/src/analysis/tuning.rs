//! Which mode and frequency of the Vibration Guard fit a machine whose natural frequency varies over its workspace.
//!
//! The residual vibration is computed, never taken from a table: the vendor's table of permitted deviations normalises
//! the set frequency by the real one, its worked example the real one by the set one.
//!
//! Source: TF5250 Vibration Guard (choice of the mode from frequencies at several positions).
//!
//! Order of calls: the band, then the choices of each mode:
//!
//! ```
//! use kontur_filters::analysis::tuning::VibrationBand;
//! use kontur_filters::time::CycleTime;
//!
//! let band = VibrationBand::of(&[6.9, 6.0, 5.4], 0.1).unwrap();
//! let [one, two] = [1, 2].map(|mode| band.best(mode, CycleTime::DEFAULT).unwrap());
//! // a longer kernel bears more deviation
//! assert!(two.worst_ratio < one.worst_ratio && two.delay_cycles > one.delay_cycles);
//! // the least contour error that still leaves at most a fifth
//! let fast = band.fastest(2, 0.2, CycleTime::DEFAULT).unwrap();
//! assert!(fast.worst_ratio <= 0.2 && fast.corner_error_s <= two.corner_error_s);
//! ```

use super::corner::kernel_error_mm;
use crate::kernel::Kernel;
use crate::response::{Impulse, residual_vibration_ratio};
use crate::time::CycleTime;
use crate::vib_guard::VibGuardSettings;

/// The vibration of a machine: its natural frequency lies between two values, depending on the position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VibrationBand {
    /// Lowest real natural frequency in Hz, undamped.
    pub low_hz: f64,
    /// Highest real natural frequency in Hz, undamped.
    pub high_hz: f64,
    /// Damping ratio, 0 to 1.
    pub damping: f64,
}

/// One choice of settings for a band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The settings.
    pub settings: VibGuardSettings,
    /// Largest residual vibration over the band, as a share of what the unshaped setpoint leaves.
    pub worst_ratio: f64,
    /// Delay in cycles for slow signals.
    pub delay_cycles: f64,
    /// Contour error at a 90 degree corner per mm/s of speed, in mm: the delay-aligned error of each axis.
    pub corner_error_s: f64,
}

/// Resolution of set frequencies in Hz: measurements are not finer, and a program line stays short.
pub(crate) const RESOLUTION_HZ: f64 = 0.01;

/// Number of real frequencies at which a band is evaluated, its ends included.
const REAL_STEPS: u32 = 200;
/// Number of set frequencies in the scan before the search is refined.
const SET_STEPS: u32 = 100;
/// Largest number of refinement steps to either side.
const MOST_FINE_STEPS: u32 = 500;

impl VibrationBand {
    /// The band of frequencies measured at several positions; `None` for an empty list or a frequency that is not above
    /// 0.
    pub fn of(freqs_hz: &[f64], damping: f64) -> Option<Self> {
        let usable = |f: &f64| f.is_finite() && *f > 0.0;
        let low_hz = freqs_hz.iter().copied().reduce(f64::min)?;
        let high_hz = freqs_hz.iter().copied().reduce(f64::max)?;
        freqs_hz.iter().all(usable).then_some(Self { low_hz, high_hz, damping })
    }

    /// Largest residual vibration that impulses leave at any frequency of the band.
    pub fn worst_ratio(&self, impulses: &[Impulse]) -> f64 {
        let at = |f_hz: f64| residual_vibration_ratio(impulses, f_hz, self.damping);
        let step = (self.high_hz - self.low_hz) / f64::from(REAL_STEPS);
        if step <= 0.0 {
            return at(self.high_hz);
        }
        let inside = (0..REAL_STEPS).map(|i| at(self.low_hz + f64::from(i) * step));
        inside.fold(at(self.high_hz), f64::max)
    }

    /// The effect of settings on the band; `None` if they give no kernel at this cycle time.
    pub fn judge(&self, settings: VibGuardSettings, cycle: CycleTime) -> Option<Choice> {
        let kernel: Kernel = settings.kernel(cycle).ok()?;
        Some(Choice {
            settings,
            worst_ratio: self.worst_ratio(&kernel.impulses(cycle)),
            delay_cycles: kernel.delay_cycles(),
            corner_error_s: kernel_error_mm(&kernel, 1.0, cycle),
        })
    }

    /// The set frequency of a mode with the smallest residual at the worst point of the band, in steps of
    /// [`RESOLUTION_HZ`]; `None` if the mode has no kernel there. The damping of the guard is that of the band.
    pub fn best(&self, mode: u8, cycle: CycleTime) -> Option<Choice> {
        let judge = |freq_hz: f64| {
            self.judge(VibGuardSettings { mode, freq_hz, damping: self.damping }, cycle)
        };
        let width = self.high_hz - self.low_hz;
        let scan = (0..=SET_STEPS)
            .map(|i| self.low_hz + width * f64::from(i) / f64::from(SET_STEPS))
            .filter_map(|f| judge(rounded(f, f64::round)));
        let coarse = scan.reduce(better)?;
        // the smallest residual lies within one scan step of the best scanned frequency
        let reach_hz = width / f64::from(SET_STEPS);
        let near = (1..=MOST_FINE_STEPS)
            .map(|i| f64::from(i) * RESOLUTION_HZ)
            .take_while(|offset| *offset < reach_hz + RESOLUTION_HZ)
            .flat_map(|offset| [-offset, offset])
            .filter_map(|offset| judge(rounded(coarse.settings.freq_hz + offset, f64::round)));
        Some(near.fold(coarse, better))
    }

    /// The highest frequency of a mode that keeps the residual vibration of the whole band within `limit_ratio`, in
    /// steps of [`RESOLUTION_HZ`]: the shortest kernel that does, hence the smallest contour error and delay. `None` if
    /// no frequency does.
    pub fn fastest(&self, mode: u8, limit_ratio: f64, cycle: CycleTime) -> Option<Choice> {
        let judge = |freq_hz: f64| {
            self.judge(VibGuardSettings { mode, freq_hz, damping: self.damping }, cycle)
                .filter(|choice| choice.worst_ratio <= limit_ratio)
        };
        let mut inside = self.best(mode, cycle).filter(|best| best.worst_ratio <= limit_ratio)?;
        // Step outward, then bisect the step that leaves the permitted range.
        let step = (0.01 * inside.settings.freq_hz).max(RESOLUTION_HZ);
        let mut outside = loop {
            let next = rounded(inside.settings.freq_hz + step, f64::round);
            match judge(next) {
                Some(choice) if next < 10.0 * self.high_hz => inside = choice,
                _ => break next,
            }
        };
        loop {
            let middle = rounded(0.5 * (inside.settings.freq_hz + outside), f64::floor);
            if middle <= inside.settings.freq_hz {
                return Some(inside);
            }
            match judge(middle) {
                Some(choice) => inside = choice,
                None => outside = middle,
            }
        }
    }
}

/// A frequency rounded to steps of [`RESOLUTION_HZ`], not below the lowest one of the guard.
fn rounded(freq_hz: f64, how: fn(f64) -> f64) -> f64 {
    (how(freq_hz / RESOLUTION_HZ + 1e-9) / (1.0 / RESOLUTION_HZ)).max(VibGuardSettings::MIN_FREQ_HZ)
}

/// The choice with the smaller residual; of two equal ones the earlier.
fn better(a: Choice, b: Choice) -> Choice {
    if b.worst_ratio < a.worst_ratio { b } else { a }
}
