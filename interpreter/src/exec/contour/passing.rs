//! What becomes of the corner after the last motion: it may be rounded, in a curve or a spline, unless the path stops there.

use super::Contour;
use crate::exec::step::{AtCorner, Sync};
use kontur_motion::contouring::is_tangential;
use kontur_motion::path::Path;

/// How the path passes a corner unless it stops there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Passing {
    #[default]
    Sharp,
    Contoured,
    Splined,
}

impl Contour {
    /// Whether the corner after the last motion would be rounded without this stop, which the program does not ask for. A
    /// contoured corner is rounded with functions and dwells within its curve.
    pub(in crate::exec) fn loses_corner(&self, stop: &Sync) -> bool {
        match self.corner() {
            Passing::Sharp => false,
            Passing::Contoured => stop.at_corner() == AtCorner::Lost,
            Passing::Splined => stop.at_corner() != AtCorner::Kept,
        }
    }

    /// What is to become of the corner after the last motion.
    pub(super) fn corner(&self) -> Passing {
        match &self.held {
            Some(held) if held.block.contour.is_some() => Passing::Contoured,
            Some(held) if held.block.spline.is_some() && self.hsc.spline().is_some() => {
                Passing::Splined
            }
            Some(_) => Passing::Sharp,
            None => self.waits_at,
        }
    }

    /// Whether the corner after the last motion is to be rounded by contouring.
    pub(in crate::exec) fn has_contoured_corner(&self) -> bool {
        matches!(self.corner(), Passing::Contoured)
    }

    /// No corner is lost where a path continues the last motion in its direction.
    pub(in crate::exec) fn continue_along(&mut self, path: &Path) {
        if self.held.as_ref().is_some_and(|held| is_tangential(&held.block.path, path)) {
            self.keep_corner();
        }
    }

    /// The corner after the last motion is not rounded.
    pub(in crate::exec) fn keep_corner(&mut self) {
        if let Some(held) = &mut self.held {
            held.block.contour = None;
        }
    }
}
