//! Rounding of corners and smoothing of short blocks: the programmed settings of the stages before the planner.
//!
//! Source: TF5200 programming manual, #CONTOUR MODE, #HSC. Assumption: `AUTO_OFF_G60` is what happens anyway, a stop ends
//! the spline.

use crate::exec::block::choice::FeedType;
use kontur_motion::block::{ContourMode, ContourSettings, SplineSettings};

/// Mode of `#CONTOUR MODE`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::exec) enum Mode {
    #[default]
    Dev,
    Dist,
    Pos,
    Ptp,
    DistSoft,
    DistMaster,
}

/// What limits a curve of PTP: the values written last, of which one is an alternative to the other (475241483).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::exec) enum PtpLimit {
    #[default]
    Deviation,
    Distance,
    Both,
}

/// Parameters of `#CONTOUR MODE`; each keeps its value until it is programmed again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct ContourParameters {
    pub(in crate::exec) mode: Mode,
    pub(in crate::exec) path_dev_mm: f64,
    pub(in crate::exec) pre_mm: f64,
    pub(in crate::exec) post_mm: f64,
    pub(in crate::exec) path_dist_mm: f64,
    pub(in crate::exec) ptp: PtpLimit,
    pub(in crate::exec) point_mm: [Option<f64>; 3],
    /// Common to all modes.
    pub(in crate::exec) common: ContourSettings,
}

impl Default for ContourParameters {
    /// DEV with 1 mm. Source: TF5200 programming manual, state at program start.
    fn default() -> Self {
        Self {
            mode: Mode::Dev,
            path_dev_mm: 1.0,
            pre_mm: 1.0,
            post_mm: 1.0,
            path_dist_mm: 1.0,
            ptp: PtpLimit::default(),
            point_mm: [None; 3],
            common: ContourSettings::default(),
        }
    }
}

impl ContourParameters {
    /// Settings of a block.
    pub(in crate::exec) fn settings(&self) -> ContourSettings {
        let Self { path_dev_mm, pre_mm, post_mm, path_dist_mm, point_mm, .. } = *self;
        let mode = match self.mode {
            Mode::Dev => ContourMode::Dev { path_dev_mm },
            Mode::Dist => ContourMode::Dist { pre_mm, post_mm },
            Mode::Pos => ContourMode::Pos { pre_mm, post_mm, point_mm },
            Mode::Ptp => ContourMode::Ptp {
                path_dev_mm: (self.ptp != PtpLimit::Distance || path_dist_mm < 0.0)
                    .then_some(path_dev_mm),
                path_dist_mm: (self.ptp != PtpLimit::Deviation).then_some(path_dist_mm),
            },
            Mode::DistSoft => ContourMode::DistSoft { path_dist_mm },
            Mode::DistMaster => ContourMode::DistMaster { path_dist_mm },
        };
        ContourSettings { mode, ..self.common }
    }
}

/// State of `#HSC`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Hsc {
    pub(in crate::exec) on: bool,
    /// The older form OPMODE=1: corners are rounded within `contour_error_mm`. It is also that of `#HSC ON` in a program that
    /// has not selected a B-spline (15556991115).
    pub(in crate::exec) rounds_corners: bool,
    pub(in crate::exec) contour_error_mm: f64,
    /// AUTO_OFF_G60: an exact stop is to end the spline, as it always does here.
    pub(in crate::exec) off_at_stop: bool,
    pub(in crate::exec) spline: SplineSettings,
}

impl Default for Hsc {
    fn default() -> Self {
        let spline = SplineSettings::default();
        Self { on: false, rounds_corners: true, contour_error_mm: 0.1, off_at_stop: false, spline }
    }
}

impl Hsc {
    /// Settings of a block that becomes part of a spline.
    pub(in crate::exec) fn spline(&self) -> Option<SplineSettings> {
        (self.on && !self.rounds_corners).then_some(self.spline)
    }

    /// The effective feed type: in a B-spline G94 replaces G93 (120847).
    pub(in crate::exec) fn feed_type(&self, programmed: FeedType) -> FeedType {
        match programmed {
            FeedType::Time if self.spline().is_some() => FeedType::PerMinute,
            other => other,
        }
    }

    /// Settings of a block whose corner the older form rounds.
    pub(in crate::exec) fn contour(&self) -> Option<ContourSettings> {
        let mode = ContourMode::Dev { path_dev_mm: self.contour_error_mm };
        let settings = ContourSettings { mode, ..ContourSettings::default() };
        (self.on && self.rounds_corners).then_some(settings)
    }
}
