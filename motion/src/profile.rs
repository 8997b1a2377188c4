//! Motion along one scalar coordinate: how speed changes over time.
//!
//! Every speed is a [`Profile`]: a row of phases with constant jerk, or of one sine-square ramp each. There are three
//! ways to plan one:
//! - slopes ([`SlopeLimits`]): the vendor's STEP, TRAPEZ and SIN2 over a path length between two velocities, with zero
//!   acceleration at both ends. The look-ahead uses [`SlopeLimits::reach_up`] and [`SlopeLimits::reach_down`], the
//!   interpolator evaluates the plan.
//! - the change of speed (`SlopeLimits::change`) from a moving state with any acceleration, with the ramps of a slope:
//!   feedhold and override.
//! - the general third-order motion ([`ThirdOrderLimits::fastest`]): one coordinate from any position, velocity and
//!   acceleration to any other with one jerk limit; it connects profiles that SIN2 has planned from both ends.
//!
//! The module has no notion of axes or geometry: limits arrive already referred to the path.
//!
//! Order of calls: read the reach of a slope, plan a profile over a length, then evaluate the profile at times.
//!
//! ```
//! use kontur_motion::profile::{RampShape, RampedLimits, SlopeLimits};
//!
//! let limits = RampedLimits::new(RampShape::Trapez, false, 3500.0, 3500.0, [0.03; 4]);
//! let slope = SlopeLimits::Ramped(limits);
//! let profile = slope.plan(0.0, 0.0, 200.0, 100.0).unwrap();
//! // one ramp in addition to length / speed: v / a + tr, during which the mean speed is half
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
pub use phase::State;
pub use ramp::RampShape;
pub use ramped::RampedLimits;
pub(crate) use ramped::Rates;
pub use row::Profile;
pub use slope::SlopeLimits;
pub use step::{StepAxis, StepLimits};
pub use third_order::{MotionState, ThirdOrderError, ThirdOrderLimits, ThirdOrderPhases};

/// Acceleration in mm/s2 that counts as zero.
pub(crate) const FLAT_MM_S2: f64 = 1e-6;
