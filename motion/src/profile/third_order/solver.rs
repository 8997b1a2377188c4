//! From the task to the phases of the fastest motion.

use super::brake::Brake;
use super::fastest;
use super::scaled::{Problem, Units};
use super::task::{MotionState, ThirdOrderError, ThirdOrderLimits, ThirdOrderPhases};

impl ThirdOrderLimits {
    /// The phases of the fastest motion from `start` to `target`; none if they are equal.
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

/// Whether the target is inside the limits, as is the motion just before it.
fn target_is_admissible(p: &Problem) -> bool {
    let rounding = 1e-12;
    let before = p.ve - 0.5 * p.ae * p.ae.abs();
    [p.ve, before].iter().all(|v| *v <= p.v_max + rounding && *v >= p.v_min - rounding)
        && p.ae <= p.a_max + rounding
        && p.ae >= p.a_min - rounding
}
