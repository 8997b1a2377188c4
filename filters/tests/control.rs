//! The axis downstream of its set position as a whole: closed loops against closed forms and documented figures.

#![expect(
    clippy::float_cmp,
    clippy::unwrap_used,
    clippy::approx_constant,
    reason = "tests: exact values, helpers outside of test functions, cycle numbers from times, measured amplitudes"
)]

#[path = "control/exact_stop.rs"]
mod exact_stop;
#[path = "control/feedforward.rs"]
mod feedforward;
#[path = "control/ipc.rs"]
mod ipc;
#[path = "control/profile.rs"]
mod profile;
#[path = "control/rest.rs"]
mod rest;
#[path = "control/robustness.rs"]
mod robustness;
#[path = "control/rows.rs"]
mod rows;
