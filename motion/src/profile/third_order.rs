//! Jerk-limited motion of one coordinate from any state to any state, in the manner of Ruckig.
//!
//! - [`ThirdOrderProfile::fastest`]: minimum time (Ruckig's step 1);
//! - [`ThirdOrderProfile::with_duration`]: a given time (Ruckig's step 2);
//! - [`ThirdOrderProfile::to_velocity`]: a velocity with zero acceleration, position free.
//!
//! A state outside its limits, or on its way out, is first brought back by a brake of at most two phases. All
//! work is done in units in which the jerk is 1 and the motion of order 1 (`scaled`); every candidate is
//! integrated and checked before it is taken.
//!
//! Four facts keep the enumeration short:
//! - a profile towards lower positions is the mirror image of one towards higher positions;
//! - a profile run backwards and mirrored swaps start and end, so `ACC1` is `ACC0` of that problem;
//! - with a phase of constant velocity the two changes of speed around it are independent;
//! - for a given duration the possible displacements are an interval (limits and equations are convex in the
//!   acceleration over time), and a blend of two solutions is a solution.

mod brake;
mod candidate;
mod duration;
mod fastest;
mod leg;
mod peak;
mod polynomial;
mod profile;
mod scaled;

pub use profile::{MotionState, ThirdOrderError, ThirdOrderLimits, ThirdOrderProfile};
