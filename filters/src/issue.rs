//! What can be wrong with the settings of a filter or of the Vibration Guard: typed values, no text.
//!
//! A filter knows neither its axis nor its place in a list; who configured it adds both.

/// Identification of a condition: the vendor's number where a document gives one, otherwise a condition of kontur's
/// own. Numbers in the vendor's space are never invented.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IssueId {
    /// A number of the vendor's.
    Vendor(u32),
    /// A condition of kontur's own.
    Own(OwnId),
}

/// Conditions no vendor document numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OwnId {
    /// K-FILTER-RANGE: frequency, quality or share of a filter out of range.
    FilterRange,
    /// K-VIB-RANGE: frequency or damping of the Vibration Guard out of range.
    VibGuardRange,
    /// A PT2 has the order 2, whatever other order above 0 was given.
    OrderCorrected,
    /// An all-pass with another prototype than BESSEL has no flat group delay.
    AllPassNotBessel,
    /// A high-pass or band-pass takes the constant part out of a position.
    RemovesConstantPart,
    /// An HSC type without the prototype HSC, or the reverse.
    HscPrototype,
    /// HSC filters do not exist for spindles.
    HscOnSpindle,
    /// The additional interface has no HSC filters.
    HscOnInterface,
}

/// What a condition does to the filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// The filter runs as configured; something is worth knowing.
    Note,
    /// The filter runs with a corrected value.
    Corrected,
    /// The filter is off.
    Off,
}

/// A condition found while a filter was designed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FilterIssue {
    /// 110239: the number is no filter type (7 and 9 are reserved). Source: P-AXIS-00204.
    TypeNotPermitted {
        /// The number.
        number: u32,
    },
    /// 110500: an axis has one HSC filter at most.
    SecondHsc,
    /// 110501: the HSC filter must be the first filter of the axis.
    HscNotFirst,
    /// An HSC type and a standard prototype, or the reverse.
    HscPrototype,
    /// HSC filters do not exist for spindles.
    HscOnSpindle,
    /// The additional interface has standard filters only. Source: TF5200 axis filters.
    HscOnInterface,
    /// 50663: time constant outside its range. Source: P-AXIS-00357.
    TimeConstant {
        /// The time constant in us.
        time_constant_us: u32,
        /// Smallest permitted value in us.
        min_us: u32,
        /// Largest permitted value in us.
        max_us: u32,
    },
    /// 50910: the time that is to give the order is shorter than a cycle. Source: P-AXIS-00591, 00357.
    OrderTimeBelowCycle {
        /// The time in us.
        order_time_us: u32,
        /// The cycle in us.
        cycle_us: u32,
    },
    /// 50911: the order is above its range; the highest one is used.
    OrderTooHigh {
        /// The order asked for.
        order: u32,
        /// The highest order.
        used: u32,
    },
    /// A PT2 has the order 2. Source: P-AXIS-00140.
    OrderCorrected {
        /// The order asked for.
        order: u32,
        /// The order used.
        used: u32,
    },
    /// 50989: the filter is on and has a type, but neither an order nor a time that gives one.
    NoOrder,
    /// 110361: the characteristic frequency is below the lowest one, which is used. Source: P-AXIS-00067.
    FrequencyTooLow {
        /// The frequency asked for in Hz.
        f_hz: f64,
        /// The frequency used in Hz.
        used_hz: f64,
    },
    /// A frequency outside its range. Source: P-AXIS-00067, 00585.
    Frequency {
        /// The frequency in Hz.
        f_hz: f64,
        /// Lower limit in Hz, permitted.
        min_hz: f64,
        /// Upper limit in Hz.
        max_hz: f64,
    },
    /// A quality outside its range: 1 to 10 (P-AXIS-00080), or above 0 to 1 (P-AXIS-00593).
    Quality {
        /// The quality.
        quality: f64,
    },
    /// A share outside 0 to 1. Source: P-AXIS-00164, 00590.
    Share {
        /// The share.
        share_ratio: f64,
    },
    /// The vendor recommends BESSEL for the all-pass.
    AllPassNotBessel,
    /// The filter's gain is zero for a standing axis, so it acts on the deviation from the switch-on position.
    RemovesConstantPart,
}

impl FilterIssue {
    /// The ID of the condition.
    pub const fn id(&self) -> IssueId {
        match self {
            Self::TypeNotPermitted { .. } => IssueId::Vendor(110_239),
            Self::SecondHsc => IssueId::Vendor(110_500),
            Self::HscNotFirst => IssueId::Vendor(110_501),
            Self::TimeConstant { .. } => IssueId::Vendor(50_663),
            Self::OrderTimeBelowCycle { .. } => IssueId::Vendor(50_910),
            Self::OrderTooHigh { .. } => IssueId::Vendor(50_911),
            Self::NoOrder => IssueId::Vendor(50_989),
            Self::FrequencyTooLow { .. } => IssueId::Vendor(110_361),
            Self::Frequency { .. } | Self::Quality { .. } | Self::Share { .. } => {
                IssueId::Own(OwnId::FilterRange)
            }
            Self::OrderCorrected { .. } => IssueId::Own(OwnId::OrderCorrected),
            Self::AllPassNotBessel => IssueId::Own(OwnId::AllPassNotBessel),
            Self::RemovesConstantPart => IssueId::Own(OwnId::RemovesConstantPart),
            Self::HscPrototype => IssueId::Own(OwnId::HscPrototype),
            Self::HscOnSpindle => IssueId::Own(OwnId::HscOnSpindle),
            Self::HscOnInterface => IssueId::Own(OwnId::HscOnInterface),
        }
    }

    /// What becomes of the filter.
    pub const fn effect(&self) -> Effect {
        match self {
            Self::AllPassNotBessel | Self::RemovesConstantPart => Effect::Note,
            Self::OrderTooHigh { .. }
            | Self::OrderCorrected { .. }
            | Self::FrequencyTooLow { .. } => Effect::Corrected,
            _ => Effect::Off,
        }
    }
}
