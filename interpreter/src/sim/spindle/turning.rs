//! Changes of the speed of a spindle, with the accelerations and ramp times of its list.
//!
//! Source: TF5200 axis parameters, P-AXIS-00270: since V2.11.2800 the slope type no longer matters; a ramp time shorter
//! than the cycle does not count, others make the speed non-linear. P-AXIS-00556: the accelerations are those of the
//! jerk-limited slope.
//!
//! Assumptions: each of the four ramp times is judged separately; ramps are linear, and short ones keep their jerk; on
//! a reversal the acceleration is zero at standstill; a change under way keeps its weight (G130).

use kontur_filters::time::CycleTime;
use kontur_motion::axis::FeedSlope;
use kontur_motion::profile::{Profile, RampShape, RampedLimits, SlopeLimits};

/// Limits of the changes of speed; `acc_ratio`: weight of the acceleration.
pub(super) fn limits(slope: FeedSlope, acc_ratio: f64, cycle: CycleTime) -> SlopeLimits {
    let ramps_s = slope.ramps_s.map(|t| if t < cycle.seconds() { 0.0 } else { t });
    let [acc, dec] = [slope.acc_mm_s2, slope.dec_mm_s2].map(|a| a * acc_ratio);
    SlopeLimits::Ramped(RampedLimits::new(RampShape::Trapez, false, acc, dec, ramps_s))
}

/// A change of speed under way.
#[derive(Clone, Debug)]
struct Change {
    profile: Profile,
    /// Speed at its end in deg/s, with sign.
    target_deg_s: f64,
    /// 1, or -1 for counter-clockwise.
    sense: f64,
    /// Time in s since its start.
    at_s: f64,
}

/// Speed and angle of a freely turning spindle.
#[derive(Clone, Debug, Default)]
pub(super) struct Turning {
    speed_deg_s: f64,
    change: Option<Change>,
}

impl Turning {
    /// Turning at this speed.
    pub(super) fn at(speed_deg_s: f64) -> Self {
        Self { speed_deg_s, change: None }
    }

    /// Speed in deg/s, with sign.
    pub(super) fn speed_deg_s(&self) -> f64 {
        self.speed_deg_s
    }

    /// Changes the speed at once.
    pub(super) fn set_speed(&mut self, speed_deg_s: f64, cycle: CycleTime) -> f64 {
        let way_deg = 0.5 * (self.speed_deg_s + speed_deg_s) * cycle.seconds();
        self.speed_deg_s = speed_deg_s;
        way_deg
    }

    /// Whether no change is under way.
    pub(super) fn is_steady(&self) -> bool {
        self.change.is_none()
    }

    /// One cycle towards a speed; returns the way in deg. `limits` is only called where a change begins.
    pub(super) fn step(
        &mut self,
        target_deg_s: f64,
        limits: impl Fn() -> SlopeLimits,
        cycle: CycleTime,
    ) -> f64 {
        let (mut left_s, mut way_deg) = (cycle.seconds(), 0.0);
        // to standstill, from there to the speed in the other direction, and the rest of the cycle at that speed
        for _ in 0..3 {
            self.head_for(target_deg_s, &limits);
            let Some(change) = &mut self.change else { break };
            let before_deg = change.profile.at(change.at_s).s_mm;
            let rest_s = change.profile.duration() - change.at_s;
            if left_s < rest_s {
                change.at_s += left_s;
                let now = change.profile.at(change.at_s);
                self.speed_deg_s = change.sense * now.v_mm_s;
                return way_deg + change.sense * (now.s_mm - before_deg);
            }
            way_deg += change.sense * (change.profile.length() - before_deg);
            left_s -= rest_s;
            self.speed_deg_s = change.target_deg_s;
            self.change = None;
        }
        way_deg + self.speed_deg_s * left_s
    }

    /// Plans a change to a speed that differs from that of the change under way.
    fn head_for(&mut self, target_deg_s: f64, limits: impl Fn() -> SlopeLimits) {
        let now = self.change.as_ref();
        let sense = match now {
            Some(change) => change.sense,
            None if self.speed_deg_s == 0.0 => target_deg_s.signum(),
            None => self.speed_deg_s.signum(),
        };
        // through standstill to the other direction of rotation
        let target_deg_s = if target_deg_s * sense < 0.0 { 0.0 } else { target_deg_s };
        let aimed = now.map_or(self.speed_deg_s, |change| change.target_deg_s);
        if aimed.to_bits() == target_deg_s.to_bits() {
            return;
        }
        let (v, a) = now.map_or((self.speed_deg_s.abs(), 0.0), |change| {
            let state = change.profile.at(change.at_s);
            (state.v_mm_s, state.a_mm_s2)
        });
        // where the acceleration leaves no room, the present change continues
        if let Some(profile) = limits().change_of_speed(v, a, target_deg_s.abs()) {
            self.change = Some(Change { profile, target_deg_s, sense, at_s: 0.0 });
        }
    }
}
