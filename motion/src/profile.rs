//! Motion along one scalar coordinate: how speed changes over time.
//!
//! Two families with different tasks:
//! - slope profiles ([`SlopeLimits`], [`SpanProfile`]): the vendor's STEP, TRAPEZ and SIN2 slopes of a
//!   path length between two velocities, acceleration zero at both ends. The look-ahead asks
//!   [`SlopeLimits::reach_up`] and [`SlopeLimits::reach_down`], the interpolator evaluates the plan.
//! - the change of speed (`SpeedChange`) from a moving state with any acceleration, with the ramps of a slope: feedhold
//!   and override.
//! - the general third-order profile ([`ThirdOrderProfile`]): one coordinate from any position, velocity and
//!   acceleration to any other with one jerk limit, for replanning from a moving state and for positioning.
//!
//! Nothing here knows axes or geometry: limits arrive already referred to the path.

mod chain;
mod join;
mod leg;
mod ramp;
mod ramped;
pub(crate) mod roots;
mod slope;
mod span;
mod speed_change;
mod step;
mod third_order;

pub(crate) use chain::{Chain, Phase};
pub use ramp::RampShape;
pub use ramped::RampedLimits;
pub(crate) use ramped::Rates;
pub use slope::{Infeasible, SlopeLimits};
pub use span::{SpanProfile, State};
pub(crate) use speed_change::SpeedChange;
pub use step::{StepAxis, StepLimits};
pub use third_order::{MotionState, ThirdOrderError, ThirdOrderLimits, ThirdOrderProfile};
