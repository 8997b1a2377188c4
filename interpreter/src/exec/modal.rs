//! Modal state: what words set until others of their group change it.

use kontur_motion::block::{Slope, SlopeKind};

/// Group 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PathMode {
    Rapid,
    Linear,
    Clockwise,
    CounterClockwise,
}

/// G17, G18, G19 as indices of the main axes: first, second, third (normal).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Plane {
    Xy,
    Zx,
    Yz,
}

impl Plane {
    /// Main axes of the plane: first, second, and the one perpendicular to it.
    pub(super) fn main_axes(self) -> [usize; 3] {
        match self {
            Self::Xy => [0, 1, 2],
            Self::Zx => [2, 0, 1],
            Self::Yz => [1, 2, 0],
        }
    }
}

/// G93, G94, G95, G194.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum FeedType {
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
    pub(super) fn g(self) -> u32 {
        match self {
            Self::Time => 93,
            Self::PerMinute => 94,
            Self::PerRevolution => 95,
            Self::ShareOfMaximum => 194,
        }
    }
}

/// An F word with the unit of length that was active.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FeedWord {
    pub(super) value: f64,
    pub(super) inch: bool,
}

/// G115, G116, G117.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LookAhead {
    Complete,
    StopAtTransitions,
}

/// G40, G41, G42.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compensation {
    Off,
    Left,
    Right,
}

/// G25, G26.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Corners {
    /// Neither was programmed: as [`Round`](Self::Round).
    Unsaid,
    Straight,
    Round,
}

/// Everything that G words and F, R, I keep.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a group of two words")]
pub(super) struct Modal {
    pub(super) path: PathMode,
    pub(super) plane: Plane,
    pub(super) inch: bool,
    pub(super) absolute: bool,
    pub(super) feed_type: FeedType,
    /// F of each feed type, in the order of [`FeedType`].
    pub(super) feeds: [Option<FeedWord>; 4],
    pub(super) exact_stop: bool,
    pub(super) contouring: bool,
    /// G901: a lower feed of the next block may be reached behind the end of the block.
    pub(super) late_braking: bool,
    /// G161: centres in coordinates of the program.
    pub(super) centre_absolute: bool,
    /// G165.
    pub(super) centre_correction: bool,
    /// R of the last arc that had one, in mm.
    pub(super) radius_mm: Option<f64>,
    pub(super) slope: Slope,
    /// The slope was set in the older form: selective weights act (P-CHAN-00001, P-CHAN-00073).
    pub(super) old_slope: bool,
    pub(super) look_ahead: LookAhead,
    pub(super) compensation: Compensation,
    /// Outer corners of tool radius compensation.
    pub(super) corners: Corners,
    /// G237.
    pub(super) perpendicular_selection: bool,
    /// I of G301/G302 in mm.
    pub(super) insertion_mm: Option<f64>,
    /// Transition velocity of `#TRANSVELMIN` in mm/s.
    pub(super) transition_min_mm_s: f64,
}

impl Modal {
    pub(super) fn feed(&self) -> Option<FeedWord> {
        self.feeds[self.feed_type as usize]
    }

    /// State at program start without presets of the channel list.
    pub(super) fn start(slope: SlopeKind, constant_ramp_time: bool) -> Self {
        Self {
            path: PathMode::Linear,
            plane: Plane::Xy,
            inch: false,
            absolute: true,
            feed_type: FeedType::PerMinute,
            feeds: [None; 4],
            exact_stop: false,
            contouring: false,
            late_braking: false,
            centre_absolute: false,
            centre_correction: true,
            radius_mm: None,
            slope: Slope { kind: slope, optimised: false, constant_ramp_time },
            old_slope: false,
            look_ahead: LookAhead::Complete,
            compensation: Compensation::Off,
            corners: Corners::Unsaid,
            perpendicular_selection: false,
            insertion_mm: None,
            transition_min_mm_s: 0.0,
        }
    }
}
