//! What the words of a group of G functions choose between.

/// Group 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum PathMode {
    Rapid,
    Linear,
    Clockwise,
    CounterClockwise,
    /// G303.
    ArcInSpace,
    /// G33.
    Thread,
    /// G63.
    Tapping,
    /// G331.
    TapIn,
    /// G332.
    TapBack,
}

impl PathMode {
    /// G33, G63, G331, G332.
    pub(in crate::exec) fn is_thread(self) -> bool {
        matches!(self, Self::Thread) || self.is_tapping()
    }

    /// G63, G331, G332: the spindle rotates in step with the path.
    pub(in crate::exec) fn is_tapping(self) -> bool {
        matches!(self, Self::Tapping | Self::TapIn | Self::TapBack)
    }
}

/// G17, G18, G19 as indices of the main axes: first, second, third (normal).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Plane {
    Xy,
    Zx,
    Yz,
}

impl Plane {
    /// Main axes of the plane: first, second, and the one perpendicular to it.
    pub(in crate::exec) fn main_axes(self) -> [usize; 3] {
        match self {
            Self::Xy => [0, 1, 2],
            Self::Zx => [2, 0, 1],
            Self::Yz => [1, 2, 0],
        }
    }
}

/// G93, G94, G95, G194.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::exec) enum FeedType {
    /// G93: time of the block.
    Time,
    /// G94.
    PerMinute,
    /// G95.
    PerRevolution,
    /// G194.
    ShareOfMaximum,
}

impl FeedType {
    pub(in crate::exec) fn g(self) -> u32 {
        match self {
            Self::Time => 93,
            Self::PerMinute => 94,
            Self::PerRevolution => 95,
            Self::ShareOfMaximum => 194,
        }
    }
}

/// G115, G116, G117.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum LookAhead {
    Complete,
    StopAtTransitions,
}

/// G40, G41, G42.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Compensation {
    Off,
    Left,
    Right,
}

/// G25, G26.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Corners {
    Straight,
    Round,
}

/// How tool radius compensation is selected and deselected.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::exec) enum Selection {
    /// G139.
    #[default]
    Indirect,
    /// G138.
    Direct,
    /// G237.
    Perpendicular,
    /// G238.
    InsideCorner,
    /// G239.
    WithoutBlock,
}
