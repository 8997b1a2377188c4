//! Parameters of contouring.

use super::CurveJerk;

/// The points of the blocks that the curve connects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContourMode {
    /// DEV: the interim point is at most this far from the corner.
    Dev {
        /// `PATH_DEV` in mm, default 1.
        path_dev_mm: f64,
    },
    /// DIST: the curve begins and ends at given distances from the corner.
    Dist {
        /// `PRE_DIST` in mm, default 1.
        pre_mm: f64,
        /// `POST_DIST` in mm, default 1.
        post_mm: f64,
    },
    /// POS: the curve passes through a given point.
    Pos {
        /// `PRE_DIST` in mm, default 1, 0 is allowed.
        pre_mm: f64,
        /// `POST_DIST` in mm, default 1, 0 is allowed.
        post_mm: f64,
        /// Coordinates in the three main axes (the first three of the channel); where not given, those of the corner.
        point_mm: [Option<f64>; 3],
    },
    /// PTP: the curve of DEV, from its deviation or, alternatively, its corner distance (475241483). Assumption: the documents
    /// describe the purpose of this mode, not its curve.
    Ptp {
        /// `PATH_DEV` in mm, if it is a limit.
        path_dev_mm: Option<f64>,
        /// `PATH_DIST` in mm, if it is a limit; negative: not bounded.
        path_dist_mm: Option<f64>,
    },
    /// `DIST_SOFT`; not published, replaced by [`Self::Ptp`] with a notice: by the distance or, without one, a deviation of 1 mm.
    DistSoft {
        /// `PATH_DIST` in mm, default 1; negative: not bounded.
        path_dist_mm: f64,
    },
    /// `DIST_MASTER`; replaced as [`Self::DistSoft`].
    DistMaster {
        /// `PATH_DIST` in mm, default 1; negative: not bounded.
        path_dist_mm: f64,
    },
}

impl Default for ContourMode {
    fn default() -> Self {
        Self::Dev { path_dev_mm: 1.0 }
    }
}

/// The place at a rounded corner where the block before it ends: there functions act, and the path waits for them.
///
/// Source: TF5200 programming manual, executing additional blocks (475113099) and its examples (475259787).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BlockLimit {
    /// `PRE_ACTION`: before the curve.
    Before,
    /// `INTER_ACTION`, the default: between its two polynomials. Assumption: with `CONST_VEL` after the curve, which has one speed.
    #[default]
    Within,
    /// `POST_ACTION`: after the curve.
    After,
}

/// Parameters of `#CONTOUR MODE`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContourSettings {
    /// Mode with its lengths.
    pub mode: ContourMode,
    /// `RELEVANT_PATH` in mm, default 0: shorter blocks are bridged.
    pub relevant_path_mm: f64,
    /// `TRACK_DEV` in deg, default 0 = not monitored: permitted deviation of the axes outside the feed group.
    pub track_dev_deg: f64,
    /// `RELEVANT_TRACK` in deg, default 0: a block that moves such an axis by more is relevant.
    pub relevant_track_deg: f64,
    /// `REMAIN_PART` as a ratio 0..1, default 0: part of each block that is kept.
    pub remain_ratio: f64,
    /// `MAX_ANGLE` in deg, default 180: corners that turn by more are kept.
    pub max_angle_deg: f64,
    /// `CONST_VEL`, default off: constant speed over the whole curve.
    pub constant_velocity: bool,
    /// `CHECK_JERK`; `None`: as P-CHAN-00110.
    pub curve_jerk: Option<CurveJerk>,
    /// Where the block ends.
    pub limit: BlockLimit,
}

impl Default for ContourSettings {
    fn default() -> Self {
        Self {
            mode: ContourMode::default(),
            relevant_path_mm: 0.0,
            track_dev_deg: 0.0,
            relevant_track_deg: 0.0,
            remain_ratio: 0.0,
            max_angle_deg: 180.0,
            constant_velocity: false,
            curve_jerk: None,
            limit: BlockLimit::default(),
        }
    }
}
