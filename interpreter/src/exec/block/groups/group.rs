//! Groups of G functions: a block may contain one function of each.

use crate::diag::Condition;

/// Group: two functions of one group in a block are an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::exec) enum Group {
    Path,
    FeedInterpolation,
    CompensationFeed,
    CornerDeceleration,
    Deceleration,
    Plane,
    Mirror,
    CompensationTransition,
    Compensation,
    Diameter,
    ZeroOffset,
    Transition,
    Rotation,
    Unit,
    Dimension,
    FeedType,
    SpindleMode,
    Measuring,
    LookAhead,
    CompensationSelection,
    Masking,
    Splines,
    CentreType,
    CentreCorrection,
    Manual,
    Insertion,
    Feedforward,
    FullOverride,
    RampWeight,
    VelocityWeight,
    RapidVelocityWeight,
    AccelerationWeight,
    RapidAccelerationWeight,
    HoldAccelerationWeight,
    /// No group: several may share a block.
    None,
}

impl Group {
    /// Condition of double programming; K-DUPGROUP if the documents read do not name an ID.
    pub(in crate::exec) fn duplicate(self) -> Condition {
        match self {
            Self::Path => Condition::TwoMotionModes,
            Self::FeedInterpolation => Condition::TwoFeedInterpolations,
            Self::CompensationFeed => Condition::TwoCompensationFeeds,
            Self::Mirror => Condition::TwoMirrors,
            Self::Compensation => Condition::TwoCompensations,
            Self::Diameter => Condition::TwoDiameters,
            Self::ZeroOffset => Condition::TwoZeroOffsets,
            Self::Transition => Condition::TwoTransitions,
            Self::Unit => Condition::TwoUnits,
            Self::FeedType => Condition::TwoFeedTypes,
            Self::Measuring => Condition::TwoMeasurings,
            Self::LookAhead => Condition::TwoLookAheads,
            Self::CompensationSelection => Condition::TwoCompensationSelections,
            Self::CentreType => Condition::TwoCentreTypes,
            Self::CentreCorrection => Condition::TwoCentreCorrections,
            Self::Manual => Condition::TwoManuals,
            Self::Insertion => Condition::TwoInsertions,
            Self::SpindleMode => Condition::TwoSpeedModes,
            Self::FullOverride => Condition::OverrideSwitchTwice,
            Self::CornerDeceleration => Condition::TwoCornerDecelerations,
            Self::CompensationTransition => Condition::TwoCorners,
            Self::RampWeight => Condition::TwoRampWeights,
            Self::VelocityWeight => Condition::TwoVelocityWeights,
            Self::Deceleration => Condition::TwoDecelerations,
            Self::Splines => Condition::TwoSplines,
            Self::Plane
            | Self::Rotation
            | Self::Dimension
            | Self::Masking
            | Self::Feedforward
            | Self::RapidVelocityWeight
            | Self::AccelerationWeight
            | Self::RapidAccelerationWeight
            | Self::HoldAccelerationWeight
            | Self::None => Condition::DuplicateGroup,
        }
    }

    pub(in crate::exec) fn name(self) -> &'static str {
        match self {
            Self::Path => "path condition",
            Self::FeedInterpolation => "feed interpolation",
            Self::CompensationFeed => "feed of tool radius compensation",
            Self::CornerDeceleration => "corner deceleration",
            Self::Deceleration => "deceleration to a lower feed",
            Self::Plane => "plane",
            Self::Mirror => "mirroring",
            Self::CompensationTransition => "transitions of tool radius compensation",
            Self::Compensation => "tool radius compensation",
            Self::Diameter => "diameter programming",
            Self::ZeroOffset => "zero offset",
            Self::Transition => "block transition",
            Self::Rotation => "contour rotation",
            Self::Unit => "unit",
            Self::Dimension => "dimension",
            Self::FeedType => "feed type",
            Self::SpindleMode => "spindle speed",
            Self::Measuring => "measuring",
            Self::LookAhead => "look-ahead",
            Self::CompensationSelection => "selection of tool radius compensation",
            Self::Masking => "contour masking",
            Self::Splines => "splines",
            Self::CentreType => "arc centre",
            Self::CentreCorrection => "centre correction",
            Self::Manual => "manual mode",
            Self::Insertion => "insertion",
            Self::Feedforward => "feedforward",
            Self::FullOverride => "override of the block",
            Self::RampWeight => "weights of ramp times",
            Self::VelocityWeight => "weights of the maximum speed",
            Self::RapidVelocityWeight => "the weight of the rapid speed",
            Self::AccelerationWeight => "weights of accelerations",
            Self::RapidAccelerationWeight => "weights of rapid accelerations",
            Self::HoldAccelerationWeight => "weights of the deceleration at feedhold",
            Self::None => "",
        }
    }
}
