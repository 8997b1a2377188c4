//! From programmed blocks to one set of interpolated setpoints per cycle.
//!
//! Units: `_mm _mm_s _mm_s2 _mm_s3` (degrees for rotary axes), `_s`, `_rad`, `_ratio` (1.0 = 100 %), `_cycles`.
//! The crate has no notion of NC text, files or wall-clock time.
//!
//! Order of calls: limits of axes and modes of the channel become [`block::ChannelDynamics`], a programmed motion with
//! its [`path::Path`] becomes a [`block::Block`]. Where the program requires it, blocks first pass the stages that
//! change the path ([`contouring`], [`spline`]). They then go into a [`planner::Planner`], which returns one setpoint
//! per cycle. The other modules are its building blocks and can be used separately.
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! # use kontur_filters::time::CycleTime;
//! use kontur_motion::planner::{Next, Planner};
//!
//! // 10 mm along X, then 10 mm along Y, at 100 mm/s, with a cycle of 1 ms
//! let mut planner = Planner::new(CycleTime::from_us(1000).unwrap(), 10, &[0.0, 0.0]);
//! planner.push(block(1, [0.0, 0.0], [10.0, 0.0], 100.0));
//! planner.push(block(2, [10.0, 0.0], [10.0, 10.0], 100.0));
//! planner.finish();
//! let mut fastest = 0.0_f64;
//! while planner.advance().unwrap() == Next::Setpoint {
//!     fastest = fastest.max(planner.setpoint().v_mm_s);
//! }
//! assert_eq!(&planner.setpoint().position[..], [10.0, 10.0]);
//! assert!(fastest <= 100.0);
//! ```

pub mod ahead;
mod asked;
pub mod axis;
pub mod block;
pub mod cap;
#[cfg(test)]
mod closed_forms;
mod contour;
pub mod contouring;
pub mod deviation;
mod emergency;
#[cfg(test)]
#[expect(unreachable_pub, reason = "written for examples, which are outside of the crate")]
mod example {
    include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs"));
}
pub mod independent;
pub mod junction;
pub mod limits;
pub mod lookahead;
mod overshoot;
pub mod path;
mod plan;
pub mod planner;
pub mod profile;
pub mod queue;
pub mod realtime;
mod ride;
mod sections;
pub mod spline;
mod timeline;
pub mod tolerance;
mod worth;

// the documentation examples and the unit tests share these fixtures
#[cfg(test)]
extern crate self as kontur_motion;
