//! Motion along one scalar coordinate: how speed changes over time.
//!
//! Every speed is a [`Profile`]: a row of phases of constant jerk, or of one sine-square ramp each. Those who plan differ:
//! - slopes ([`SlopeLimits`]): the vendor's STEP, TRAPEZ and SIN2 over a path length between two velocities,
//!   acceleration zero at both ends. The look-ahead asks [`SlopeLimits::reach_up`] and
//!   [`SlopeLimits::reach_down`], the interpolator evaluates the plan.
//! - the change of speed (`SlopeLimits::change`) from a moving state with any acceleration, with the ramps of a slope:
//!   feedhold and override.
//! - the general third-order motion ([`ThirdOrderLimits::fastest`]): one coordinate from any position, velocity and
//!   acceleration to any other with one jerk limit; it connects what SIN2 has planned from either end.
//!
//! Nothing here knows axes or geometry: limits arrive already referred to the path.
//!
//! A slope is asked what it can reach, then for a profile over a length; a profile is evaluated at times.
//!
//! ```
//! use kontur_motion::profile::{RampShape, RampedLimits, SlopeLimits};
//!
//! let limits = RampedLimits::new(RampShape::Trapez, false, 3500.0, 3500.0, [0.03; 4]);
//! let slope = SlopeLimits::Ramped(limits);
//! let profile = slope.plan(0.0, 0.0, 200.0, 100.0).unwrap();
//! // one ramp comes on top of length / speed: v / a + tr, on the way half the speed
//! let expected = 100.0 / 200.0 + 200.0 / 3500.0 + 0.03;
//! assert!((profile.duration() - expected).abs() < 1e-9);
//! assert!((profile.at(0.25).v_mm_s - 200.0).abs() < 1e-9);
//! ```

mod fit;
mod leg;
mod legs;
mod phase;
mod ramp;
mod ramped;
pub(crate) mod roots;
mod row;
mod slope;
mod speed_change;
mod step;
mod third_order;
mod weaker;

pub use fit::Infeasible;
pub(crate) use phase::Phase;
pub use ramp::RampShape;
pub use ramped::RampedLimits;
pub(crate) use ramped::Rates;
pub use row::{Profile, State};
pub use slope::SlopeLimits;
pub use step::{StepAxis, StepLimits};
pub use third_order::{MotionState, ThirdOrderError, ThirdOrderLimits, ThirdOrderPhases};
