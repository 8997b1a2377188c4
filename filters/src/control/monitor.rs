//! Monitors of one axis: following error, exact stop, dynamics of the set positions.
//!
//! A monitor raises a [`Fault`](super::fault::Fault) when its condition begins; what the machine does about it is the
//! cycle loop's business.

mod exact_stop;
mod lag;
mod setpoint;

pub use exact_stop::{ExactStopConfig, ExactStopMonitor};
pub use lag::{LagMonitor, LagMonitorConfig, LagMonitorType};
pub use setpoint::{SetpointMonitor, SetpointMonitorConfig, Thresholds};
