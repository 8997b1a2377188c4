//! Reasons why a corner was not contoured as programmed.

/// The reason why a corner was not contoured as programmed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoContour {
    /// 120216: a block is too short.
    BlockTooShort,
    /// 120129: `PATH_DEV` is below the minimum.
    DeviationTooSmall {
        /// `PATH_DEV` in mm.
        value_mm: f64,
        /// Minimum in mm.
        least_mm: f64,
    },
    /// 120131: a corner distance is below the minimum.
    DistanceTooSmall {
        /// Distance in mm.
        value_mm: f64,
        /// Minimum in mm.
        least_mm: f64,
    },
    /// 120207: the path reverses, or only one of the blocks moves axes of the feed group.
    NotPossible,
    /// 120566: the feed group differs between the blocks.
    FeedGroup,
    /// 120206 at the end of a program: no block follows before the path stops.
    NothingFollows,
    /// The corner turns by more than `MAX_ANGLE`.
    AngleAboveMaximum {
        /// Angle of the corner in deg.
        angle_deg: f64,
    },
    /// Passing the curve would take longer than passing the sharp corner.
    Slower,
    /// The mode is not available; the corner was contoured as DEV.
    ModeReplaced,
}

/// A corner that was not contoured as programmed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Notice {
    /// Number of the block before the corner.
    pub seq: u64,
    /// The reason.
    pub reason: NoContour,
}
