//! The integration tests of this crate, one module per subject in a single target that is linked once.

#![expect(clippy::unwrap_used, reason = "a test that fails here has failed")]

mod common;
mod contour_time;
mod contouring;
mod halt;
mod independent;
mod invariants;
mod kinks;
mod late_braking;
mod limits;
mod lookahead;
mod measured;
mod monitored_time;
mod optimum;
mod promise;
mod realtime;
mod realtime_tolerance;
mod rests;
mod same_time;
mod short_kernels;
mod slope_properties;
mod slope_tables;
mod spline;
mod spline_noise;
mod stopped;
mod third_order_properties;
mod third_order_reference;
mod tilted;
mod tolerance;
mod tolerance_arcs;
mod tolerance_curves;
