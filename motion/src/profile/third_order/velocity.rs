//! Fastest change to a velocity, position free.

use super::leg::Leg;
use smallvec::SmallVec;

/// Phases (duration, jerk) from `(v0, a0)` to `(v1, 0)` with jerk 1.
///
/// An acceleration outside its limits is first brought to the limit.
pub(super) fn to_velocity(
    v0: f64,
    a0: f64,
    v1: f64,
    a_min: f64,
    a_max: f64,
) -> SmallVec<[(f64, f64); 4]> {
    let inside = a0.clamp(a_min, a_max);
    let ramp = (a0 - inside).abs();
    let v = v0 + 0.5 * ramp * (a0 + inside);
    let leg = Leg::new(v, inside, v1, a_min, a_max);
    let brake = (ramp, (inside - a0).signum());
    [brake].into_iter().chain(leg.t.into_iter().zip(leg.jerks())).collect()
}
