//! The axis behind its set position as a whole: closed loops against closed forms and documented figures.

#[path = "control/exact_stop.rs"]
mod exact_stop;
#[path = "control/feedforward.rs"]
mod feedforward;
#[path = "control/ipc.rs"]
mod ipc;
#[path = "control/profile.rs"]
mod profile;
#[path = "control/robustness.rs"]
mod robustness;
