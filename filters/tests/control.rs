//! The axis downstream of its set position as a whole: closed loops compared with closed forms and documented figures.

#![expect(
    clippy::float_cmp,
    clippy::approx_constant,
    reason = "tests: exact values, helpers outside of test functions, cycle numbers from times, measured amplitudes"
)]

mod exact_stop;
mod feedforward;
mod ipc;
mod profile;
mod rest;
mod robustness;
mod rows;
