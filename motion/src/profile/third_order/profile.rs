//! The profile type with its states and errors.

use super::brake::Brake;
use super::leg::Leg;
use super::scaled::{Problem, Units};
use super::{duration, fastest};
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
    /// State after `t` s of constant jerk.
    pub(super) fn after(&self, t: f64, j: f64) -> Self {
        let Self { p_mm: p, v_mm_s: v, a_mm_s2: a } = *self;
        Self {
            p_mm: p + t * (v + t * (0.5 * a + t * j / 6.0)),
            v_mm_s: v + t * (a + 0.5 * t * j),
            a_mm_s2: a + t * j,
        }
    }

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
    /// The prescribed duration is below the shortest one.
    #[error("{duration_s} s is less than the shortest duration of {shortest_s} s")]
    TooShort {
        /// Prescribed duration in s.
        duration_s: f64,
        /// Shortest duration in s.
        shortest_s: f64,
    },
    /// No profile has this duration: the states allow a shorter and a longer one, but not this one.
    #[error("no profile lasts {duration_s} s")]
    Blocked {
        /// Prescribed duration in s.
        duration_s: f64,
    },
    /// No candidate passed the check.
    #[error("no profile found")]
    NotFound,
}

/// A phase of constant jerk.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Phase {
    duration_s: f64,
    jerk: f64,
}

/// A motion in phases of constant jerk.
#[derive(Clone, Debug, PartialEq)]
pub struct ThirdOrderProfile {
    phases: SmallVec<[Phase; 9]>,
    start: MotionState,
    end: MotionState,
    duration: f64,
    brake: f64,
}

impl ThirdOrderProfile {
    /// The fastest motion from `start` to `target`.
    ///
    /// # Errors
    /// [`ThirdOrderError::Limits`], [`ThirdOrderError::State`], [`ThirdOrderError::Target`] for a request that
    /// makes no sense; [`ThirdOrderError::NotFound`] if no candidate passed the check.
    pub fn fastest(
        start: &MotionState,
        target: &MotionState,
        limits: &ThirdOrderLimits,
    ) -> Result<Self, ThirdOrderError> {
        let Some(task) = Task::new(start, target, limits)? else { return Ok(Self::still(start)) };
        let found = fastest::fastest(&task.problem).ok_or(ThirdOrderError::NotFound)?;
        Ok(task.profile(*target, found.phases()))
    }

    /// A motion from `start` to `target` that lasts `duration_s`.
    ///
    /// # Errors
    /// As [`Self::fastest`], and [`ThirdOrderError::TooShort`] or [`ThirdOrderError::Blocked`] if the duration is
    /// not possible.
    pub fn with_duration(
        start: &MotionState,
        target: &MotionState,
        limits: &ThirdOrderLimits,
        duration_s: f64,
    ) -> Result<Self, ThirdOrderError> {
        let shortest = Self::fastest(start, target, limits)?;
        let surplus = duration_s - shortest.duration;
        if surplus.abs() <= 1e-12 * duration_s {
            return Ok(shortest);
        }
        if surplus.is_nan() || surplus < 0.0 {
            return Err(ThirdOrderError::TooShort { duration_s, shortest_s: shortest.duration });
        }
        let Some(task) = Task::new(start, target, limits)? else {
            let mut still = Self::still(start);
            still.push(duration_s, 0.0);
            return Ok(still);
        };
        let available = duration_s / task.units.time - task.brake_time();
        let found = duration::with_duration(&task.problem, available)
            .ok_or(ThirdOrderError::Blocked { duration_s })?;
        Ok(task.profile(*target, found))
    }

    /// The fastest motion from `start` to a velocity with zero acceleration, wherever it ends.
    ///
    /// Used for feedhold (`velocity_mm_s` = 0) and changes of the override. Only acceleration and jerk limits
    /// apply; the velocity stays between its extremes of start, settled start and target.
    ///
    /// # Errors
    /// [`ThirdOrderError::Limits`], [`ThirdOrderError::State`].
    pub fn to_velocity(
        start: &MotionState,
        velocity_mm_s: f64,
        limits: &ThirdOrderLimits,
    ) -> Result<Self, ThirdOrderError> {
        limits.check()?;
        if !start.is_finite() || !velocity_mm_s.is_finite() {
            return Err(ThirdOrderError::State);
        }
        let jerk = limits.jerk_mm_s3;
        let mut profile = Self::still(start);
        // in units of jerk 1 and seconds
        let (v0, a0, v1) = (start.v_mm_s / jerk, start.a_mm_s2 / jerk, velocity_mm_s / jerk);
        let (a_min, a_max) = (limits.a_min_mm_s2 / jerk, limits.a_max_mm_s2 / jerk);
        // an acceleration outside its limits is first brought to the limit
        let inside = a0.clamp(a_min, a_max);
        profile.push((a0 - inside).abs(), jerk.copysign(inside - a0));
        profile.brake = profile.duration;
        let v = v0 + 0.5 * (a0 - inside).abs() * (a0 + inside);
        let leg = Leg::new(v, inside, v1, a_min, a_max);
        for (t, j) in leg.t.into_iter().zip(leg.jerks()) {
            profile.push(t, j * jerk);
        }
        let p_mm = profile
            .integrated()
            .last()
            .map_or(start.p_mm, |(from, phase)| from.after(phase.duration_s, phase.jerk).p_mm);
        profile.end = MotionState { p_mm, v_mm_s: velocity_mm_s, a_mm_s2: 0.0 };
        Ok(profile)
    }

    fn still(start: &MotionState) -> Self {
        Self { phases: SmallVec::new(), start: *start, end: *start, duration: 0.0, brake: 0.0 }
    }

    fn push(&mut self, t: f64, jerk: f64) {
        if t > 0.0 {
            self.phases.push(Phase { duration_s: t, jerk });
            self.duration += t;
        }
    }

    /// The phases with the states they start from. Profiles are made far more often than followed, so the states are
    /// not kept.
    fn integrated(&self) -> impl Iterator<Item = (MotionState, Phase)> + '_ {
        let mut next = self.start;
        let mut a_largest = next.a_mm_s2.abs();
        self.phases.iter().map(move |phase| {
            let from = next;
            next = from.after(phase.duration_s, phase.jerk);
            // what is left of a ramp to zero is rounding, and would add up over a long cruise
            a_largest = a_largest.max(next.a_mm_s2.abs());
            if next.a_mm_s2.abs() <= 1e-14 * a_largest {
                next.a_mm_s2 = 0.0;
            }
            (from, *phase)
        })
    }

    /// Duration in s, brake included.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Duration in s of the leading brake, 0 if the start is inside its limits.
    pub fn brake_duration(&self) -> f64 {
        self.brake
    }

    /// Duration in s and jerk in mm/s3 of every phase, brake included, empty phases left out.
    pub fn phases(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.phases.iter().map(|p| (p.duration_s, p.jerk))
    }

    /// Lowest and highest velocity in mm/s.
    pub fn velocity_range(&self) -> (f64, f64) {
        let mut range = (self.start.v_mm_s, self.start.v_mm_s);
        let mut include = |v: f64| range = (range.0.min(v), range.1.max(v));
        for (from, Phase { duration_s: t, jerk: j }) in self.integrated() {
            let MotionState { v_mm_s: v, a_mm_s2: a, .. } = from;
            include(v);
            if a * (a + j * t) < 0.0 {
                include(v - 0.5 * a * a / j);
            }
        }
        include(self.end.v_mm_s);
        range
    }

    /// State at time `t` in s since the start; before the start and after the end the state of that end.
    pub fn at(&self, t: f64) -> MotionState {
        if t >= self.duration {
            return self.end;
        }
        if t <= 0.0 {
            return self.start;
        }
        let mut rest = t;
        for (from, phase) in self.integrated() {
            if rest < phase.duration_s {
                return from.after(rest, phase.jerk);
            }
            rest -= phase.duration_s;
        }
        self.end
    }
}

/// A request in scaled units, its brake separated.
struct Task {
    start: MotionState,
    units: Units,
    jerk: f64,
    brake: Option<Brake>,
    problem: Problem,
}

impl Task {
    /// `None` if there is nothing to do.
    fn new(
        start: &MotionState,
        target: &MotionState,
        limits: &ThirdOrderLimits,
    ) -> Result<Option<Self>, ThirdOrderError> {
        limits.check()?;
        if !start.is_finite() || !target.is_finite() {
            return Err(ThirdOrderError::State);
        }
        let jerk = limits.jerk_mm_s3;
        let Some(units) = Units::of(start, target, jerk) else { return Ok(None) };
        let mut problem = Problem::new(start, target, limits, &units);
        if !target_is_admissible(&problem) {
            return Err(ThirdOrderError::Target);
        }
        let brake = Brake::of(&problem);
        if let Some(brake) = &brake {
            let (s, v, a) = brake.end(problem.v0, problem.a0);
            problem.distance -= s;
            (problem.v0, problem.a0) = (v, a);
        }
        Ok(Some(Self { start: *start, units, jerk, brake, problem }))
    }

    fn brake_time(&self) -> f64 {
        self.brake.map_or(0.0, |brake| brake.t[0] + brake.t[1])
    }

    fn profile(
        &self,
        target: MotionState,
        phases: impl IntoIterator<Item = (f64, f64)>,
    ) -> ThirdOrderProfile {
        let mut profile = ThirdOrderProfile::still(&self.start);
        if let Some(Brake { t: [ramp, hold], j }) = self.brake {
            profile.push(ramp * self.units.time, j * self.jerk);
            profile.push(hold * self.units.time, 0.0);
            profile.brake = profile.duration;
        }
        for (t, j) in phases {
            profile.push(t * self.units.time, j * self.jerk);
        }
        profile.end = target;
        profile
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
