//! A change of speed that starts with any acceleration, unlike a slope profile, whose acceleration is zero at both
//! ends.
//!
//! The acceleration builds up from its present value, stays constant and falls to zero, or falls at once. The rates are
//! those of the ramps of the slope (plateau / ramp time), also for SIN2 and for constant ramp times: a ramp that is
//! interrupted halfway has no defined shape (Assumption: the documents only describe ramps from zero). The jerk of a
//! SIN2 slope, which is `π/2` times as large in the middle of its ramps, is therefore never exceeded.

use super::phase::{Phase, State};
use super::ramp::RampShape;
use super::row::Profile;
use super::slope::SlopeLimits;
use super::step::StepLimits;

/// Relative amount by which a change of speed may be too small for its acceleration before it is refused.
const SLACK: f64 = 1e-9;

/// From a velocity and an acceleration to a velocity with zero acceleration: builds the acceleration up and reduces it
/// within the limits of a leg; `sign` is -1 for braking.
///
/// `None` if the acceleration is outside the limits, or too large to reach zero within the change.
fn change(v: f64, a: f64, target: f64, sign: f64, limits: Ramps) -> Option<Profile> {
    let Ramps { plateau, build, reduce } = limits;
    let (gain, a0) = (sign * (target - v), sign * a);
    let settling = 0.5 * a0 * a0 * reduce;
    let fits = target >= 0.0
        && a0 >= 0.0
        && a0 <= plateau * (1.0 + SLACK)
        && gain >= settling - SLACK * (settling + gain.abs());
    if !fits || gain <= 0.0 {
        return None;
    }
    // gain = (p^2 - a0^2) build / 2 + p^2 reduce / 2
    let square = (2.0 * gain + a0 * a0 * build) / (build + reduce);
    let peak = if build + reduce > 0.0 { square.max(0.0).sqrt() } else { plateau };
    let peak = peak.min(plateau).max(a0);
    let ramps = 0.5 * ((peak * peak - a0 * a0) * build + peak * peak * reduce);
    let times = [(peak - a0) * build, (gain - ramps).max(0.0) / peak, peak * reduce];
    let jerks = [1.0 / build, 0.0, -1.0 / reduce];
    let mut at = Phase::state(0.0, v, a);
    let mut phases = [at; 3];
    for (i, (t, j)) in times.into_iter().zip(jerks).enumerate() {
        // the acceleration jumps where a ramp takes no time
        let a = if i == 0 { a } else { sign * peak };
        let jerk = if t > 0.0 { sign * j } else { 0.0 };
        phases[i] = Phase::state(at.s, at.v, a).ramp(RampShape::Trapez, jerk, t);
        at = phases[i].end();
    }
    // the end state without the rounding of the phases
    let end = State { s_mm: at.s, v_mm_s: target, ..State::default() };
    Some(Profile::new(phases, end))
}

/// Plateau and, per unit of acceleration, the times in which it builds up and falls.
#[derive(Clone, Copy, Debug)]
struct Ramps {
    plateau: f64,
    build: f64,
    reduce: f64,
}

impl SlopeLimits {
    fn ramps(&self, braking: bool) -> Option<Ramps> {
        let Self::Ramped(limits) = self else { return None };
        let leg = if braking { limits.down() } else { limits.up() };
        let (plateau, [t1, t2]) = (leg.plateau(), leg.ramps_s());
        // a braking leg is its mirror image in time
        let (build, reduce) = if braking { (t2, t1) } else { (t1, t2) };
        Some(Ramps { plateau, build: build / plateau, reduce: reduce / plateau })
    }

    /// Velocity that remains when acceleration `a` is reduced to zero at once; `v` itself for STEP.
    pub(crate) fn settled(&self, v: f64, a: f64) -> f64 {
        self.ramps(a < 0.0).map_or(v, |r| v + 0.5 * a * a.abs() * r.reduce)
    }

    /// Change from velocity `v` and acceleration `a` to the velocity `target` with zero acceleration.
    ///
    /// `None` for STEP, whose acceleration jumps, and where acceleration has to cross zero on the way.
    pub(crate) fn change(&self, v: f64, a: f64, target: f64) -> Option<Profile> {
        let braking = target < v;
        let sign = if braking { -1.0 } else { 1.0 };
        change(v, a, target, sign, self.ramps(braking)?)
    }

    /// Change from velocity `v` and acceleration `a` to the velocity `target` with zero acceleration, all in mm (deg) and s, both
    /// velocities not negative. An acceleration that points the other way, or leads beyond the target, is brought to zero
    /// first.
    ///
    /// `None` for STEP, where there is nothing to change, and for an acceleration beyond the limits.
    pub fn change_of_speed(&self, v: f64, a: f64, target: f64) -> Option<Profile> {
        self.change(v, a, target).or_else(|| {
            let settled = self.settled(v, a);
            let first = self.change(v, a, settled)?;
            let second = self.change(settled, 0.0, target);
            Some(second.map_or(first.clone(), |second| first.followed_by(&second)))
        })
    }

    /// The same limits with another deceleration; `ramp_s` is not used by STEP.
    #[must_use]
    pub(crate) fn with_braking(&self, dec_mm_s2: f64, ramp_s: f64) -> Self {
        match self {
            Self::Step(limits) => Self::Step(StepLimits::with_braking(limits, dec_mm_s2)),
            Self::Ramped(limits) => Self::Ramped(limits.with_braking(dec_mm_s2, ramp_s)),
        }
    }

    /// Whether both are linear or both non-linear; only then they can be combined.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        matches!(self, Self::Step(_)) == matches!(other, Self::Step(_))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{MotionState, RampShape, RampedLimits, ThirdOrderLimits};
    use super::*;

    fn limits(ramps: [f64; 4]) -> SlopeLimits {
        SlopeLimits::Ramped(RampedLimits::new(RampShape::Trapez, false, 1200.0, 900.0, ramps))
    }

    #[test]
    fn equal_jerks_give_the_third_order_profile() {
        // jerk 20000 in all ramps
        let slope = limits([0.06, 0.06, 0.045, 0.045]);
        let third = ThirdOrderLimits {
            v_max_mm_s: 1e3,
            v_min_mm_s: 0.0,
            a_max_mm_s2: 1200.0,
            a_min_mm_s2: -900.0,
            jerk_mm_s3: 20000.0,
        };
        for (v, a, target) in [
            (100.0, -300.0, 0.0),
            (100.0, -300.0, 97.0),
            (100.0, 400.0, 200.0),
            (30.0, 400.0, 40.0),
            (10.0, -600.0, 1.0),
            (20.0, 0.0, 0.0),
        ] {
            let change = slope.change(v, a, target).unwrap();
            // no motion over the length of the fastest change of speed is faster
            let from = MotionState { p_mm: 0.0, v_mm_s: v, a_mm_s2: a };
            let to = MotionState { p_mm: change.length(), v_mm_s: target, a_mm_s2: 0.0 };
            let mut row = vec![from];
            let mut duration = 0.0;
            for (t, j) in third.fastest(&from, &to).unwrap() {
                let MotionState { p_mm: p, v_mm_s: v, a_mm_s2: a } = row[row.len() - 1];
                row.push(MotionState {
                    p_mm: p + t * (v + t * (0.5 * a + t * j / 6.0)),
                    v_mm_s: v + t * (a + 0.5 * t * j),
                    a_mm_s2: a + t * j,
                });
                duration += t;
                let (x, y) = (change.at(duration), row[row.len() - 1]);
                assert!((x.s_mm - y.p_mm).abs() < 1e-8, "{v} {a} {target}: {x:?} {y:?}");
                assert!((x.v_mm_s - y.v_mm_s).abs() < 1e-6, "{v} {a} {target}: {x:?} {y:?}");
                assert!((x.a_mm_s2 - y.a_mm_s2).abs() < 0.1, "{v} {a} {target}: {x:?} {y:?}");
            }
            assert!((change.duration() - duration).abs() < 1e-9, "{v} {a} {target}: {duration}");
            for i in 0..=50 {
                let x = change.at(change.duration() * f64::from(i) / 50.0);
                assert!((change.at(change.time_at(x.s_mm)).s_mm - x.s_mm).abs() < 1e-12);
            }
        }
    }

    /// From (50, -450) with 30 ms to build 900 mm/s2 (1/30000 s3/mm) and 70 ms to reduce them (7/90000):
    /// p^2 (1/30000 + 7/90000) = 2 * 50 + 450^2 / 30000, p = 983.9 > 900, so the plateau is held.
    #[test]
    fn different_ramps_by_hand() {
        let slope = limits([0.04, 0.06, 0.03, 0.07]);
        let change = slope.change(50.0, -450.0, 0.0).unwrap();
        // 450 -> 900: 15 ms, 10.125 mm/s; 900 -> 0: 70 ms, 31.5 mm/s; the rest of 8.375 mm/s at 900
        assert!((change.duration() - (0.015 + 0.07 + 8.375 / 900.0)).abs() < 1e-12);
        assert!(change.at(1.0).v_mm_s.abs() < 1e-15);
        assert!((change.at(0.015).v_mm_s - 39.875).abs() < 1e-10);
        // reducing 450 mm/s2 alone costs 450^2 * 7/90000 / 2 = 7.875 mm/s
        assert!((slope.settled(50.0, -450.0) - 42.125).abs() < 1e-12);
        assert!(slope.change(50.0, -450.0, 42.2).is_none());
        let settled = slope.change(50.0, -450.0, slope.settled(50.0, -450.0)).unwrap();
        assert!((settled.duration() - 0.035).abs() < 1e-9);
        // 600 mm/s2 fall in 30 ms: 600 * 0.03 / 2 = 9 mm/s more
        assert!((slope.settled(50.0, 600.0) - 59.0).abs() < 1e-12);
        assert!(slope.change(50.0, 1201.0, 500.0).is_none());
    }

    #[test]
    fn without_ramps_the_acceleration_jumps() {
        let slope = limits([0.0; 4]);
        let change = slope.change(90.0, -900.0, 0.0).unwrap();
        assert!((change.duration() - 0.1).abs() < 1e-12);
        assert!((change.length() - 4.5).abs() < 1e-12);
        assert!((slope.settled(90.0, -900.0) - 90.0).abs() < 1e-12);
    }
}
