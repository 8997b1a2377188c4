//! The reason for the present path speed.
//!
//! Every stage passes it on, up to [`crate::planner::Setpoint::limit`].
//!
//! Order of calls: caps are made for blocks and junctions, the lowest one applies, and the planner reports its reason.
//!
//! ```
//! use kontur_motion::cap::{Cap, SpeedLimit};
//!
//! assert_eq!(SpeedLimit::AxDev.name(), "ax_dev");
//! assert_eq!(SpeedLimit::ALL.len(), 7);
//! let corner = Cap::new(12.0, SpeedLimit::Corner);
//! assert_eq!(corner.lower(Cap::new(3.0, SpeedLimit::AxDev)).why, SpeedLimit::AxDev);
//! ```

/// What limits the path speed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum SpeedLimit {
    /// At rest, or braking for and starting from a stop.
    #[default]
    Stop,
    /// Programmed feed reached.
    Feed,
    /// Velocity limit of an axis.
    Axis,
    /// Velocity at a kink between blocks.
    Corner,
    /// Curvature of the path.
    Curve,
    /// Tolerance monitoring (`AX_DEV`).
    AxDev,
    /// End of the look-ahead window.
    Lookahead,
}

impl SpeedLimit {
    /// All values, in the order of the summary.
    pub const ALL: [Self; 7] = [
        Self::Feed,
        Self::Axis,
        Self::Corner,
        Self::Curve,
        Self::AxDev,
        Self::Lookahead,
        Self::Stop,
    ];

    /// Name in the trace.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stop => "stop",
            Self::Feed => "feed",
            Self::Axis => "axis",
            Self::Corner => "corner",
            Self::Curve => "curve",
            Self::AxDev => "ax_dev",
            Self::Lookahead => "lookahead",
        }
    }
}

/// An upper bound of the path velocity, and its reason.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cap {
    /// Velocity in mm/s; infinite if not bounded.
    pub v_mm_s: f64,
    /// The reason.
    pub why: SpeedLimit,
}

impl Cap {
    /// Standstill.
    pub const STOP: Self = Self::new(0.0, SpeedLimit::Stop);

    /// A velocity in mm/s with its reason.
    pub const fn new(v_mm_s: f64, why: SpeedLimit) -> Self {
        Self { v_mm_s, why }
    }

    /// The lower of two caps, this one if they are equal.
    #[must_use]
    pub fn lower(self, other: Self) -> Self {
        if other.v_mm_s < self.v_mm_s { other } else { self }
    }
}
