//! Brake: brings a state that is outside its limits, or bound to leave them, back inside.
//!
//! The cases are those of Ruckig (Copyright (c) 2021 Lars Berscheid, MIT License, see the notice in
//! `RUCKIG-LICENSE`), in units with jerk 1.

use super::scaled::{Problem, settled_velocity};

/// Up to two phases: a ramp of acceleration, then constant acceleration.
#[derive(Clone, Copy, Debug)]
pub(super) struct Brake {
    pub(super) t: [f64; 2],
    /// Jerk of the ramp, `+1` or `-1`.
    pub(super) j: f64,
}

impl Brake {
    /// `None` if the state is inside its limits and can stay there.
    pub(super) fn of(problem: &Problem) -> Option<Self> {
        let down = |p: &Problem, j: f64| Self { t: lower(p), j };
        let mirror = problem.mirrored();
        if problem.a0 > problem.a_max {
            Some(Self { t: lower_acceleration(problem), j: -1.0 })
        } else if mirror.a0 > mirror.a_max {
            Some(Self { t: lower_acceleration(&mirror), j: 1.0 })
        } else if leaves(problem) {
            Some(down(problem, -1.0))
        } else if leaves(&mirror) {
            Some(down(&mirror, 1.0))
        } else {
            None
        }
    }

    /// State at the end of the brake: displacement, velocity, acceleration.
    pub(super) fn end(&self, v0: f64, a0: f64) -> (f64, f64, f64) {
        let [t, u] = self.t;
        let a = a0 + self.j * t;
        let v = v0 + t * (a0 + 0.5 * self.j * t);
        let s = t * (v0 + t * (0.5 * a0 + self.j * t / 6.0));
        (s + u * (v + 0.5 * a * u), v + a * u, a)
    }
}

/// Whether the velocity is above its limit, or bound to get there even if the acceleration is reduced at once.
fn leaves(p: &Problem) -> bool {
    let rounding = 1e-14 * (1.0 + p.v0.abs());
    let too_fast = p.v0 > p.v_max + rounding && p.v0 - 0.5 * p.a0 * p.a0 > p.v_min;
    too_fast || (p.a0 > 0.0 && settled_velocity(p.v0, p.a0) > p.v_max + rounding)
}

/// Acceleration above its limit: reduced to the limit, or further if the velocity requires it.
fn lower_acceleration(p: &Problem) -> [f64; 2] {
    let ramp = p.a0 - p.a_max;
    let v_at_limit = p.v0 + 0.5 * (p.a0 * p.a0 - p.a_max * p.a_max);
    if settled_velocity(p.v0, p.a0) > p.v_max {
        lower(p)
    } else if v_at_limit < p.v_min {
        let to_v_min = (p.v_min - v_at_limit) / p.a_max;
        let to_v_max = (p.v_max - v_at_limit) / p.a_max - 0.5 * p.a_max;
        [ramp, to_v_min.min(to_v_max).max(0.0)]
    } else {
        [ramp, 0.0]
    }
}

/// Reduces the acceleration until the velocity is at its upper limit, but at most so far that the velocity can still be
/// stopped above the lower limit.
fn lower(p: &Problem) -> [f64; 2] {
    let to_a_min = p.a0 - p.a_min;
    let to_v_max = p.a0 + (p.a0 * p.a0 + 2.0 * (p.v0 - p.v_max)).max(0.0).sqrt();
    let to_v_min = p.a0 + (0.5 * p.a0 * p.a0 + (p.v0 - p.v_min)).max(0.0).sqrt();
    let ramp = to_v_max.min(to_v_min);
    if to_a_min < ramp {
        let v = p.v0 + to_a_min * (p.a0 - 0.5 * to_a_min);
        let hold = ((p.v_max - v) / p.a_min).min((p.v_min - v) / p.a_min + 0.5 * p.a_min);
        [to_a_min.max(0.0), hold.max(0.0)]
    } else {
        [ramp.max(0.0), 0.0]
    }
}
