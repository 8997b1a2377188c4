//! Request to the solver, its answer and its errors.

use smallvec::SmallVec;

/// State of one coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionState {
    /// Position in mm.
    pub p_mm: f64,
    /// Velocity in mm/s.
    pub v_mm_s: f64,
    /// Acceleration in mm/s2.
    pub a_mm_s2: f64,
}

impl MotionState {
    pub(super) fn is_finite(&self) -> bool {
        self.p_mm.is_finite() && self.v_mm_s.is_finite() && self.a_mm_s2.is_finite()
    }
}

/// Limits of one coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThirdOrderLimits {
    /// Highest velocity in mm/s, `> 0`.
    pub v_max_mm_s: f64,
    /// Lowest velocity in mm/s, `<= 0`; 0 forbids reversing.
    pub v_min_mm_s: f64,
    /// Highest acceleration in mm/s2, `> 0`.
    pub a_max_mm_s2: f64,
    /// Lowest acceleration in mm/s2, `< 0`.
    pub a_min_mm_s2: f64,
    /// Jerk in both directions in mm/s3, `> 0`.
    pub jerk_mm_s3: f64,
}

impl ThirdOrderLimits {
    pub(super) fn check(&self) -> Result<(), ThirdOrderError> {
        let valid = self.v_max_mm_s > 0.0
            && self.v_min_mm_s <= 0.0
            && self.a_max_mm_s2 > 0.0
            && self.a_min_mm_s2 < 0.0
            && self.jerk_mm_s3 > 0.0
            && (self.v_max_mm_s - self.v_min_mm_s).is_finite()
            && (self.a_max_mm_s2 - self.a_min_mm_s2).is_finite()
            && self.jerk_mm_s3.is_finite();
        if valid { Ok(()) } else { Err(ThirdOrderError::Limits) }
    }
}

/// Reasons why there is no profile.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ThirdOrderError {
    /// A limit has the wrong sign or is not finite.
    #[error("limits need v_max > 0 >= v_min, a_max > 0 > a_min, jerk > 0, all finite")]
    Limits,
    /// A state is not finite.
    #[error("start or target is not a finite state")]
    State,
    /// The target is outside the limits, or cannot be reached without leaving them just before.
    #[error("target velocity and acceleration cannot be reached within the limits")]
    Target,
    /// No candidate passed the check.
    #[error("no profile found")]
    NotFound,
}

/// Durations in s and jerks in mm/s3 of the phases of a motion, without empty phases.
pub type ThirdOrderPhases = SmallVec<[(f64, f64); 9]>;
