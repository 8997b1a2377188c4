//! Why the path is not faster.
//!
//! The answer that every stage passes on, up to [`crate::planner::Setpoint::limit`].
//!
//! ```
//! use kontur_motion::limit::SpeedLimit;
//!
//! assert_eq!(SpeedLimit::AxDev.name(), "ax_dev");
//! assert_eq!(SpeedLimit::ALL.len(), 7);
//! ```

/// What held the path speed down.
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
    /// Every value, in the order of the summary.
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
