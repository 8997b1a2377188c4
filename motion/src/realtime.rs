//! External influences on a running path: override and feedhold.
//!
//! Set on the planner at any time between two cycles, they apply from the next cycle on; see [`crate::planner`] for the
//! transition.
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! # use kontur_filters::time::CycleTime;
//! use kontur_motion::planner::{Next, Planner};
//! use kontur_motion::realtime::{FeedholdBraking, OverrideRatios};
//!
//! let mut planner = Planner::new(CycleTime::from_us(1000).unwrap(), 10, &[0.0, 0.0]);
//! planner.push(block(1, [0.0, 0.0], [50.0, 0.0], 100.0));
//! planner.finish();
//! planner.set_override(OverrideRatios { feed: 0.5, ..OverrideRatios::default() });
//! for _ in 0..200 { planner.advance().unwrap(); }
//! assert!((planner.setpoint().v_mm_s - 50.0).abs() < 1e-9);
//! planner.feedhold(true, FeedholdBraking::Active);
//! for _ in 0..200 { planner.advance().unwrap(); }
//! assert!(planner.is_held() && planner.setpoint().v_mm_s == 0.0);
//! ```

use crate::cap::Cap;
use crate::limits::PathSpeeds;

/// Real-time override, 1.0 = 100 %, range 0..=2 (values outside are clamped, NaN is 0).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverrideRatios {
    /// Feed blocks.
    pub feed: f64,
    /// Rapid blocks (G00). Whether they have a separate override is up to the caller (P-CHAN-00181).
    pub rapid: f64,
}

impl Default for OverrideRatios {
    fn default() -> Self {
        Self { feed: 1.0, rapid: 1.0 }
    }
}

impl OverrideRatios {
    pub(crate) fn clamped(self) -> Self {
        let clamp = |r: f64| if r.is_nan() { 0.0 } else { r.clamp(0.0, 2.0) };
        Self { feed: clamp(self.feed), rapid: clamp(self.rapid) }
    }
}

/// The value that the override is a percentage of (P-CHAN-00066).
///
/// `v_max` is the lowest of the limits by axes, curvature and `#VECTOR LIMIT`. No mode exceeds it, not even above 100 %
/// (Assumption: the formula of mode 0 taken literally would drive axes beyond their velocity limit).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum OverrideMode {
    /// 0: of the velocity that the path would reach, `min(v_prog, v_max) * override`.
    #[default]
    OfReached,
    /// 1: of the programmed velocity, `min(v_prog * override, v_max)`.
    OfProgrammed,
    /// 2: as 0, but as 1 while a function that reduces the velocity is active.
    ///
    /// Assumption: that function is a velocity of `#VECTOR LIMIT`, the only one in this crate.
    OfProgrammedWhileReduced,
}

/// The deceleration that a feedhold uses (P-CHAN-00097), and the path at a probe signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum FeedholdBraking {
    /// 0: that of the active slope.
    #[default]
    Active,
    /// 1: the feedhold parameters (P-AXIS-00024; P-AXIS-00053 and P-AXIS-00081).
    Own,
    /// That of rapid blocks (P-AXIS-00280 and P-AXIS-00281; P-AXIS-00004 and P-AXIS-00200): at a probe signal with
    /// P-CHAN-00214 = 1.
    Rapid,
}

/// The override with its mode.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(crate) struct Override {
    pub(crate) ratios: OverrideRatios,
    pub(crate) mode: OverrideMode,
}

impl Override {
    /// Factor of programmed speeds.
    pub(crate) fn ratio(&self, rapid: bool) -> f64 {
        if rapid { self.ratios.rapid } else { self.ratios.feed }
    }

    /// Path velocity of a block in mm/s, with its reason.
    pub(crate) fn velocity(&self, speeds: &PathSpeeds) -> Cap {
        let ratio = self.ratio(speeds.rapid);
        let of_programmed = match self.mode {
            OverrideMode::OfReached => false,
            OverrideMode::OfProgrammed => true,
            OverrideMode::OfProgrammedWhileReduced => speeds.vector_mm_s.is_finite(),
        };
        let programmed = speeds.programmed_mm_s;
        // at 100 % and above both modes are the same, because `v_max` limits the result
        let commanded = if of_programmed || ratio >= 1.0 {
            programmed * ratio
        } else {
            programmed.min(speeds.highest()) * ratio
        };
        speeds.limited(commanded)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn velocity(mode: OverrideMode, ratio: f64, speeds: &PathSpeeds) -> f64 {
        let ratios = OverrideRatios { feed: ratio, rapid: 1.0 };
        Override { ratios, mode }.velocity(speeds).v_mm_s
    }

    /// 200 mm/s programmed, 100 permitted: 50 % are 50 of the reached velocity and 100 of the programmed one.
    #[test]
    fn modes_of_p_chan_00066() {
        use OverrideMode::{OfProgrammed, OfProgrammedWhileReduced, OfReached};
        let slow_axis = PathSpeeds {
            programmed_mm_s: 200.0,
            axis_mm_s: 100.0,
            curve_mm_s: f64::INFINITY,
            vector_mm_s: f64::INFINITY,
            rapid: false,
        };
        let reduced = PathSpeeds { axis_mm_s: 1000.0, vector_mm_s: 100.0, ..slow_axis };
        let table = [
            (OfReached, &slow_axis, 0.5, 50.0),
            (OfProgrammed, &slow_axis, 0.5, 100.0),
            (OfProgrammed, &slow_axis, 0.25, 50.0),
            (OfProgrammedWhileReduced, &slow_axis, 0.5, 50.0),
            (OfProgrammedWhileReduced, &reduced, 0.5, 100.0),
            (OfReached, &reduced, 0.5, 50.0),
            (OfReached, &slow_axis, 2.0, 100.0),
            (OfProgrammed, &reduced, 2.0, 100.0),
            (OfReached, &slow_axis, 0.0, 0.0),
        ];
        for (mode, speeds, ratio, want) in table {
            let v = velocity(mode, ratio, speeds);
            assert!((v - want).abs() < 1e-12, "{mode:?} {ratio}: {v}");
        }
    }

    #[test]
    fn ratios_stay_in_range() {
        let wild = OverrideRatios { feed: f64::NAN, rapid: 7.0 }.clamped();
        assert_eq!(wild, OverrideRatios { feed: 0.0, rapid: 2.0 });
        let low = OverrideRatios { feed: -1.0, rapid: 0.3 }.clamped();
        assert_eq!(low, OverrideRatios { feed: 0.0, rapid: 0.3 });
    }
}
