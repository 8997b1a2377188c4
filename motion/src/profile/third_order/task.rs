//! What is asked of the solver, its answer and its errors.

use super::brake::Brake;
use super::fastest;
use super::scaled::{Problem, Units};
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
    fn is_finite(&self) -> bool {
        self.p_mm.is_finite() && self.v_mm_s.is_finite() && self.a_mm_s2.is_finite()
    }
}

/// Limits of one coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThirdOrderLimits {
    /// Highest velocity in mm/s, `> 0`.
    pub v_max_mm_s: f64,
    /// Lowest velocity in mm/s, `<= 0`; 0 forbids moving back.
    pub v_min_mm_s: f64,
    /// Highest acceleration in mm/s2, `> 0`.
    pub a_max_mm_s2: f64,
    /// Lowest acceleration in mm/s2, `< 0`.
    pub a_min_mm_s2: f64,
    /// Jerk in both directions in mm/s3, `> 0`.
    pub jerk_mm_s3: f64,
}

impl ThirdOrderLimits {
    fn check(&self) -> Result<(), ThirdOrderError> {
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

/// Why there is no profile.
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

/// Durations in s and jerks in mm/s3 of the phases of a motion, empty phases left out.
pub type ThirdOrderPhases = SmallVec<[(f64, f64); 9]>;

impl ThirdOrderLimits {
    /// The phases of the fastest motion from `start` to `target`; none if there is nothing to do.
    ///
    /// # Errors
    /// [`ThirdOrderError::Limits`], [`ThirdOrderError::State`], [`ThirdOrderError::Target`] for a request that
    /// makes no sense; [`ThirdOrderError::NotFound`] if no candidate passed the check.
    pub fn fastest(
        &self,
        start: &MotionState,
        target: &MotionState,
    ) -> Result<ThirdOrderPhases, ThirdOrderError> {
        self.check()?;
        if !start.is_finite() || !target.is_finite() {
            return Err(ThirdOrderError::State);
        }
        let Some(units) = Units::of(start, target, self.jerk_mm_s3) else {
            return Ok(ThirdOrderPhases::new());
        };
        let mut problem = Problem::new(start, target, self, &units);
        if !target_is_admissible(&problem) {
            return Err(ThirdOrderError::Target);
        }
        let brake = Brake::of(&problem);
        if let Some(brake) = &brake {
            let (s, v, a) = brake.end(problem.v0, problem.a0);
            problem.distance -= s;
            (problem.v0, problem.a0) = (v, a);
        }
        let found = fastest::fastest(&problem).ok_or(ThirdOrderError::NotFound)?;
        let first = brake.map(|Brake { t: [ramp, hold], j }| [(ramp, j), (hold, 0.0)]);
        let phases = first.into_iter().flatten().chain(found.phases());
        let scaled = phases.map(|(t, j)| (t * units.time, j * self.jerk_mm_s3));
        Ok(scaled.filter(|(t, _)| *t > 0.0).collect())
    }
}

/// The target is inside the limits and so is the motion just before it.
fn target_is_admissible(p: &Problem) -> bool {
    let rounding = 1e-12;
    let before = p.ve - 0.5 * p.ae * p.ae.abs();
    [p.ve, before].iter().all(|v| *v <= p.v_max + rounding && *v >= p.v_min - rounding)
        && p.ae <= p.a_max + rounding
        && p.ae >= p.a_min - rounding
}
