//! Jerk-limited motion of one coordinate from any state to any state, in the manner of Ruckig.
//!
//! [`ThirdOrderLimits::fastest`] returns the phases of the fastest motion (step 1 of Ruckig).
//!
//! A state outside its limits, or bound to leave them, is first brought back by a brake of at most two phases. All
//! computations use units in which the jerk is 1 and the motion of order 1 (`scaled`); every candidate is integrated
//! and checked before it is accepted.
//!
//! Three properties keep the enumeration short:
//! - a profile towards lower positions is the mirror image of one towards higher positions;
//! - a profile run backwards and mirrored swaps start and end, so `ACC1` is `ACC0` of that problem;
//! - with a phase of constant velocity the two changes of speed around it are independent.

mod brake;
mod candidate;
mod fastest;
mod peak;
mod polynomial;
mod scaled;
mod solver;
mod task;

pub use task::{MotionState, ThirdOrderError, ThirdOrderLimits, ThirdOrderPhases};
