//! What can be wrong with the settings of a filter: quantity, value and limit.
//!
//! An issue names neither the axis nor its place in a list, nor the number that a control gives the condition; the
//! caller that configured the filter adds all three. The numbers in the texts below are those of the vendor's
//! documents.
//!
//! Order of calls: a design returns the filter and its issues; each issue has an [`Effect`] and a text.
//!
//! ```
//! use kontur_filters::fir::{FirConfig, FirKind};
//! use kontur_filters::issue::{Effect, FilterIssue};
//! use kontur_filters::time::CycleTime;
//!
//! let config = FirConfig { order: 500, ..FirConfig::new(FirKind::MovingAverage) };
//! let (kernel, issues) = config.design(CycleTime::DEFAULT);
//! assert_eq!(issues, [FilterIssue::OrderTooHigh { order: 500, used: 200 }]);
//! assert_eq!(issues[0].effect(), Effect::Corrected);
//! assert_eq!(kernel.unwrap().length(), 200);
//! ```

/// The effect of a condition on the filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// The filter runs as configured; the issue is informative.
    Note,
    /// The filter runs with a corrected value.
    Corrected,
    /// The filter is off.
    Off,
}

/// A condition found while a filter was designed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FilterIssue {
    /// 110239: the number is not a filter type (7 and 9 are reserved). Source: P-AXIS-00204.
    #[error("filter type {number}, allowed: 1 to 12 except 7 and 9")]
    TypeNotPermitted {
        /// The number.
        number: u32,
    },
    /// 110500: an axis has one HSC filter at most.
    #[error("second HSC filter, an axis can have only one")]
    SecondHsc,
    /// 110501: the HSC filter must be the first filter of the axis.
    #[error("HSC filter that is not the first filter")]
    HscNotFirst,
    /// An HSC type and a standard prototype, or the reverse.
    #[error("HSC type without the prototype HSC, or the prototype HSC with another type")]
    HscPrototype,
    /// HSC filters do not exist for spindles.
    #[error("HSC filter of a spindle")]
    HscOnSpindle,
    /// The additional interface has standard filters only. Source: TF5200 axis filters.
    #[error("HSC filter of the additional interface")]
    HscOnInterface,
    /// 50663: time constant outside its range. Source: P-AXIS-00357.
    #[error("filter time constant {time_constant_us} us, allowed: {min_us} to {max_us} us")]
    TimeConstant {
        /// The time constant in us.
        time_constant_us: u32,
        /// Smallest permitted value in us.
        min_us: u32,
        /// Largest permitted value in us.
        max_us: u32,
    },
    /// 50910: the time that gives the order is shorter than a cycle. Source: P-AXIS-00591, 00357.
    #[error("time for the filter order {order_time_us} us, minimum: the cycle of {cycle_us} us")]
    OrderTimeBelowCycle {
        /// The time in us.
        order_time_us: u32,
        /// The cycle in us.
        cycle_us: u32,
    },
    /// 50911: the order is above its range; the highest one is used.
    #[error("filter order {order}, maximum {used}")]
    OrderTooHigh {
        /// The configured order.
        order: u32,
        /// The highest order.
        used: u32,
    },
    /// A PT2 has the order 2. Source: P-AXIS-00140.
    #[error("filter order {order}, fixed for this type: {used}")]
    OrderCorrected {
        /// The configured order.
        order: u32,
        /// The order used.
        used: u32,
    },
    /// 50989: the filter is on and has a type, but neither an order nor a time that gives one.
    #[error("filter order 0 without a time for the order")]
    NoOrder,
    /// 110361: the characteristic frequency is below the lowest one, which is used. Source: P-AXIS-00067.
    #[error("filter frequency {f_hz} Hz, minimum {used_hz} Hz")]
    FrequencyTooLow {
        /// The configured frequency in Hz.
        f_hz: f64,
        /// The frequency used in Hz.
        used_hz: f64,
    },
    /// A frequency outside its range. Source: P-AXIS-00067, 00585.
    #[error("filter frequency {f_hz} Hz, allowed: from {min_hz} to below {max_hz} Hz")]
    Frequency {
        /// The frequency in Hz.
        f_hz: f64,
        /// Lower limit in Hz, permitted.
        min_hz: f64,
        /// Upper limit in Hz.
        max_hz: f64,
    },
    /// A quality outside its range: 1 to 10 (P-AXIS-00080), or above 0 to 1 (P-AXIS-00593).
    #[error("filter quality {quality}, allowed: {range}")]
    Quality {
        /// The quality.
        quality: f64,
        /// The permitted range in words.
        range: &'static str,
    },
    /// A share outside 0 to 1. Source: P-AXIS-00164, 00590.
    #[error("filter share {} %, allowed: 0 to 100 %", 100.0 * share_ratio)]
    Share {
        /// The share.
        share_ratio: f64,
    },
    /// A share of a FIR filter that only delays: the rest has the same delay.
    #[error("share given for a delay, which always delays the whole signal")]
    ShareOfDelay,
    /// The vendor recommends BESSEL for the all-pass.
    #[error("all-pass without the prototype BESSEL")]
    AllPassNotBessel,
    /// The filter's gain is zero for an axis at rest, so it acts on the deviation from the switch-on position.
    #[error("high-pass or band-pass on a position")]
    RemovesConstantPart,
}

impl FilterIssue {
    /// The consequence for the filter.
    pub const fn effect(&self) -> Effect {
        match self {
            Self::ShareOfDelay | Self::AllPassNotBessel | Self::RemovesConstantPart => Effect::Note,
            Self::OrderTooHigh { .. }
            | Self::OrderCorrected { .. }
            | Self::FrequencyTooLow { .. } => Effect::Corrected,
            Self::TypeNotPermitted { .. }
            | Self::SecondHsc
            | Self::HscNotFirst
            | Self::HscPrototype
            | Self::HscOnSpindle
            | Self::HscOnInterface
            | Self::TimeConstant { .. }
            | Self::OrderTimeBelowCycle { .. }
            | Self::NoOrder
            | Self::Frequency { .. }
            | Self::Quality { .. }
            | Self::Share { .. } => Effect::Off,
        }
    }
}
