//! From programmed blocks to one set of interpolated setpoints per cycle.
//!
//! Units: `_mm _mm_s _mm_s2 _mm_s3` (degrees for rotary axes), `_s`, `_rad`, `_ratio` (1.0 = 100 %), `_cycles`.
//! The crate knows axes, paths and limits; it knows no NC text, no files and no clock.

pub mod axis;
pub mod block;
mod brake;
mod contour;
pub mod contouring;
pub mod corner;
mod course;
mod deviation;
pub mod independent;
pub mod limit;
pub mod limits;
pub mod lookahead;
mod overshoot;
pub mod path;
pub mod planner;
pub mod profile;
pub mod queue;
pub mod realtime;
mod ride;
mod short;
pub mod spline;
mod timeline;
pub mod tolerance;
#[cfg(test)]
mod work;
