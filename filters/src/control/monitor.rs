//! Monitors of one axis: following error, exact stop, dynamics of the set positions, range of the actual positions.
//!
//! A monitor raises a [`Fault`](super::fault::Fault) when its condition begins; the cycle loop decides how the machine
//! reacts.
//!
//! Start each at a position and step it once per cycle:
//!
//! ```
//! use kontur_filters::control::monitor::{LagMonitor, LagMonitorConfig, LagMonitorType};
//! use kontur_filters::time::CycleTime;
//!
//! let config = LagMonitorConfig {
//!     kind: LagMonitorType::VelocityIndependent,
//!     lag_max_mm: 1.0,
//!     ..LagMonitorConfig::default()
//! };
//! let mut monitor = LagMonitor::new(config, CycleTime::DEFAULT);
//! monitor.start(0.0);
//! // the axis lags by 10 % of the way: reported once, when 1 mm is exceeded
//! let path = (0..200).map(|k| 0.1 * f64::from(k));
//! let faults = path.filter_map(|x| monitor.step(x, 0.9 * x, 50.0));
//! assert_eq!(faults.count(), 1);
//! ```

mod exact_stop;
mod lag;
mod range;
mod setpoint;

pub use exact_stop::{ExactStopConfig, ExactStopMonitor};
pub use lag::{LagMonitor, LagMonitorConfig, LagMonitorType};
pub use range::RangeMonitor;
pub use setpoint::{SetpointMonitor, SetpointMonitorConfig, Thresholds};
