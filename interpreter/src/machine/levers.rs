//! Groups of axis parameters that shorten a run together; `kontur run --times` varies them.

use super::axis::Axis;
use super::table::axis_dynamics as dynamics;
use super::table::param::{Number, Param};

/// A group of parameters of one kind. Those that a list leaves at 0 follow others and are not varied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lever {
    /// Highest speed and rapid speed.
    Speed,
    /// Every acceleration of the slopes.
    Acceleration,
    /// Ramp times of the non-linear slope.
    Ramps,
    /// Ramp time that limits the jerk of a curve.
    GeometricRamp,
}

impl Lever {
    const fn parameters(self) -> &'static [Param<Number>] {
        match self {
            Self::Speed => &[dynamics::SPEED_MAX, dynamics::RAPID_SPEED],
            Self::Acceleration => &[
                dynamics::FEED_ACC,
                dynamics::FEED_DEC,
                dynamics::RAPID_ACC,
                dynamics::STEP_RAPID_ACC_1,
                dynamics::STEP_RAPID_ACC_2,
                dynamics::STEP_ACC_1,
                dynamics::STEP_ACC_2,
                dynamics::ACC_MAX,
            ],
            Self::Ramps => &[
                dynamics::RAMP_ACC_UP,
                dynamics::RAMP_ACC_DOWN,
                dynamics::RAMP_DEC_UP,
                dynamics::RAMP_DEC_DOWN,
                dynamics::RAPID_RAMP,
            ],
            Self::GeometricRamp => &[dynamics::GEOMETRIC_RAMP],
        }
    }

    /// The parameters as they are shown: `P-AXIS-00212, 00209`.
    pub fn ids(self) -> String {
        let number = |p: &Param<Number>| p.place().row.id.trim_start_matches("P-AXIS-");
        let numbers: Vec<_> = self.parameters().iter().map(number).collect();
        format!("P-AXIS-{}", numbers.join(", "))
    }

    /// Settings as for `--set` that multiply the list values of an axis by `factor`, in whole units of the list and at
    /// least 1.
    pub fn settings(self, axis: &Axis, factor: f64) -> Vec<String> {
        let listed = self.parameters().iter().map(|p| (axis.place(*p), axis.listed(*p)));
        listed
            .filter(|(_, value)| *value > 0.0)
            .map(|(key, value)| {
                format!("{}.{key}={}", axis.name(), (value * factor).round().max(1.0))
            })
            .collect()
    }
}
