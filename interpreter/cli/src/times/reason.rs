//! The purpose of a cycle.

use kontur_interpreter::record::{CycleRecord, Rest, SpeedLimit};
use serde::{Serialize, Serializer};

/// Accelerations below this count as 0, in mm/s2.
const NO_ACC_MM_S2: f64 = 1e-6;
/// Largest relative change of an acceleration in a cycle that still counts as constant.
const CONSTANT: f64 = 1e-6;

/// The purpose of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Reason {
    /// The programmed feed rate is reached.
    Feed,
    /// An axis is at its velocity limit.
    AxisV,
    /// The speed changes with constant acceleration: an axis is at its limit.
    AxisA,
    /// The speed changes while the acceleration is built up or reduced (ramp times, jerk, form of the slope).
    Slope,
    /// Speed of a kink between blocks.
    Corner,
    /// Curvature of the path.
    Curve,
    /// Tolerance monitoring (`AX_DEV`).
    AxDev,
    /// End of the look-ahead window.
    Lookahead,
    /// At rest without waiting.
    Stop,
    /// The path waits.
    Rest(Rest),
}

impl Reason {
    /// Every value, in the order of the columns.
    pub(crate) const ALL: [Self; 16] = [
        Self::Feed,
        Self::AxisV,
        Self::AxisA,
        Self::Slope,
        Self::Corner,
        Self::Curve,
        Self::AxDev,
        Self::Lookahead,
        Self::Stop,
        Self::Rest(Rest::Dwell),
        Self::Rest(Rest::Technology),
        Self::Rest(Rest::ExactStop),
        Self::Rest(Rest::Flush),
        Self::Rest(Rest::Spindle),
        Self::Rest(Rest::Arrival),
        Self::Rest(Rest::Held),
    ];

    /// Name in results.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Feed => "feed",
            Self::AxisV => "axis_v",
            Self::AxisA => "axis_a",
            Self::Slope => "slope",
            Self::Corner => "corner",
            Self::Curve => "curve",
            Self::AxDev => "ax_dev",
            Self::Lookahead => "lookahead",
            Self::Stop => "stop",
            Self::Rest(rest) => rest.name(),
        }
    }

    pub(super) fn of(record: &CycleRecord) -> Self {
        let path = &record.path;
        if let Some(rest) = path.rest {
            return Self::Rest(rest);
        }
        Self::of_motion(path.limit, path.v_mm_s, path.a_mm_s2, path.j_mm_s3)
    }

    fn of_motion(limit: SpeedLimit, v_mm_s: f64, a_mm_s2: f64, j_mm_s3: f64) -> Self {
        if a_mm_s2.abs() > NO_ACC_MM_S2 {
            // per ms: a jerk that would take more than a thousand seconds to remove the acceleration counts as 0
            let constant = j_mm_s3.abs() * 1e-3 <= CONSTANT * a_mm_s2.abs();
            return if constant { Self::AxisA } else { Self::Slope };
        }
        if v_mm_s == 0.0 {
            return Self::Stop;
        }
        match limit {
            SpeedLimit::Feed => Self::Feed,
            SpeedLimit::Axis => Self::AxisV,
            SpeedLimit::Corner => Self::Corner,
            SpeedLimit::Curve => Self::Curve,
            SpeedLimit::AxDev => Self::AxDev,
            SpeedLimit::Lookahead => Self::Lookahead,
            // the peak between two ramps
            SpeedLimit::Stop => Self::Slope,
        }
    }
}

impl Serialize for Reason {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}
