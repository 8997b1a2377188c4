//! A programmed motion as it passes through the stages of the contour.

use super::cutting_feed::CuttingFeed;
use super::guarded::Guarded;
use crate::exec::block::choice::Selection;
use crate::exec::step::{Event, SourceRef};
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::{Block, Feed};
use kontur_motion::path::{LinePath, Path, Tilt, TiltedArc};
use std::sync::Arc;

/// A programmed motion; the number of its block is given when it becomes a step.
#[derive(Clone, Debug)]
pub(in crate::exec) struct Motion {
    pub(in crate::exec) block: Box<Block>,
    pub(in crate::exec) source: SourceRef,
    pub(in crate::exec) events: Vec<Event>,
    /// Axes of the plane that was active; with a tilt, axes of its coordinates.
    pub(in crate::exec) plane: [usize; 2],
    /// Coordinate system, if the plane is oblique to the axes.
    pub(in crate::exec) tilt: Option<Box<Tilt>>,
    /// Whether the path is in the coordinates of the tilt.
    pub(in crate::exec) local: bool,
    pub(in crate::exec) compensation: Option<Compensated>,
    /// Whether its limits were checked along the programmed path, or are checked when it is output.
    pub(in crate::exec) path_of: PathOf,
    /// The tool is at the contour of G41 or G42, on its left if true; not during approach and departure.
    pub(in crate::exec) engaged: Option<bool>,
    /// G05: it starts or ends the compensation with an arc.
    pub(in crate::exec) tangential: bool,
    /// Change of its feed rate along the path.
    pub(in crate::exec) course: Option<FeedCourse>,
    /// Whether it leads to a point of an Akima spline.
    pub(in crate::exec) akima: bool,
    /// The control areas that it must not violate.
    pub(in crate::exec) watch: Option<Arc<Guarded>>,
    /// The block, for conditions.
    pub(in crate::exec) span: Span,
}

/// The path that counts for the software limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum PathOf {
    /// The programmed path.
    Program,
    /// That of the tool, known only when it is output: with tool radius compensation, and in the departure from it.
    Tool,
}

/// Tool radius compensation of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Compensated {
    /// Distance of the tool's centre to the left of the contour.
    pub(in crate::exec) distance_mm: f64,
    /// Outer corners by lines (G25) that extend at most this number of tool radii beyond the parallels, instead of arcs (G26).
    pub(in crate::exec) straight_corners: Option<f64>,
    /// Whether the tool reverses where a contour that runs back changes its side.
    pub(in crate::exec) reverse: bool,
    /// Whether a different radius is applied by a line perpendicular to the contour.
    pub(in crate::exec) perpendicular_change: bool,
    /// Selection and deselection.
    pub(in crate::exec) selection: Selection,
    /// G11: smallest radius in mm of the arcs whose feed rate applies at the point of engagement of the tool.
    pub(in crate::exec) engagement_radius_mm: Option<f64>,
}

/// Change of the feed rate of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) enum FeedCourse {
    /// G13.
    Corner(Corner),
    /// G193: from this feed in mm/s, above 0, linearly along the path.
    OverPath(f64),
    /// G293: from this feed in mm/s, above 0, linearly over the time.
    OverTime(f64),
    /// G95 under G96.
    PerRevolution(CuttingFeed),
}

/// `#CORNER PARAM`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Corner {
    /// Distance before the corner, above 0.
    pub(in crate::exec) dist_mm: f64,
    pub(in crate::exec) feed: CornerFeed,
}

/// Feed rate at a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) enum CornerFeed {
    /// Relative to the programmed feed rate, above 0.
    Ratio(f64),
    /// In mm/s, above 0.
    MmS(f64),
}

impl Motion {
    /// Feed rate of an element inserted after the motion: the E word of its block, if it has one.
    ///
    /// Source: TF5200 programming manual 206811147. Assumption: E0 ends the block at rest and is no feed.
    pub(in crate::exec) fn feed_behind(&self) -> Feed {
        match self.block.end_velocity_mm_s {
            Some(v) if v > 0.0 => Feed::PathVelocity(v),
            _ => self.feed_beside(),
        }
    }

    /// Whether it becomes a step without further processing.
    pub(super) fn is_complete(&self) -> bool {
        self.compensation.is_none()
            && self.path_of == PathOf::Program
            && self.tilt.is_none()
            && self.course.is_none()
            && !self.tangential
    }

    /// Feed rate of an element inserted next to the motion.
    ///
    /// Assumption: under G93, where F is the time of the programmed motion, its velocity on the programmed path; an element
    /// with an assigned time would almost stop the path at every corner.
    pub(super) fn feed_beside(&self) -> Feed {
        match self.block.feed {
            Feed::Duration(time_s) => Feed::PathVelocity(self.block.path.length() / time_s),
            feed => feed,
        }
    }

    /// Transforms the path to the coordinates of the tilt.
    pub(super) fn enter_tilt(&mut self) {
        let Some(tilt) = &self.tilt else { return };
        if std::mem::replace(&mut self.local, true) {
            return;
        }
        let path = match &self.block.path {
            Path::Line(_) => {
                let (start, end) = local_ends(tilt, self.block.path.start(), self.block.path.end());
                LinePath::new(start, end, &self.block.dynamics.feed_axes).map(Path::Line)
            }
            Path::Tilted(tilted) => Some(Path::Arc(tilted.arc().clone())),
            Path::Arc(_) | Path::Curve(_) => None,
        };
        match path {
            Some(path) => self.block.path = path,
            None => self.local = false,
        }
    }

    /// Transforms the path back to machine coordinates.
    pub(super) fn leave_tilt(&mut self) {
        let Some(tilt) = self.tilt.as_deref() else { return };
        if !std::mem::take(&mut self.local) {
            return;
        }
        let (start, end) = (self.block.path.start(), self.block.path.end());
        let (start, end) = (tilt.position(start), tilt.position(end));
        let path = match &self.block.path {
            Path::Arc(arc) => {
                Some(Path::Tilted(Box::new(TiltedArc::new(arc.clone(), *tilt, start, end))))
            }
            Path::Line(_) | Path::Tilted(_) | Path::Curve(_) => {
                LinePath::new(start, end, &self.block.dynamics.feed_axes).map(Path::Line)
            }
        };
        if let Some(path) = path {
            self.block.path = path;
        }
    }
}

/// Ends of a path in the coordinates of a tilt. Values that differ only by rounding are made equal, so that an axis of the
/// system at standstill is exactly at standstill.
pub(in crate::exec) fn local_ends(tilt: &Tilt, start: &[f64], end: &[f64]) -> (AxisVec, AxisVec) {
    const ROUNDING_MM: f64 = 1e-9;
    let (start, mut end) = (tilt.local(start), tilt.local(end));
    for axis in tilt.axes {
        if (end[axis] - start[axis]).abs() < ROUNDING_MM {
            end[axis] = start[axis];
        }
    }
    (start, end)
}

/// Time in s of a motion at its programmed velocity, without ramps.
pub(in crate::exec) fn programmed_time_s(block: &Block) -> f64 {
    let path = &block.path;
    let (from, to, axes) = (&path.start()[..], &path.end()[..], &block.dynamics.axes[..]);
    let n = from.len().min(axes.len());
    let (from, to, axes) = (&from[..n], &to[..n], &axes[..n]);
    let mut of_axes = 0.0_f64;
    for i in 0..n {
        if from[i].to_bits() != to[i].to_bits() {
            let time_s = (to[i] - from[i]).abs() / axes[i].v_max_mm_s;
            of_axes = of_axes.max(if time_s.is_finite() { time_s } else { 0.0 });
        }
    }
    match block.feed {
        Feed::PathVelocity(v) => of_axes.max(path.length() / (v * block.feed_ratio.max(1.0))),
        Feed::Duration(t) => of_axes.max(t),
        Feed::Rapid | Feed::ShareOfMaximum(_) => of_axes,
    }
}

/// A path with ends that are not programmed.
#[derive(Debug)]
pub(in crate::exec) struct Driven {
    /// Lowest and highest position of every axis.
    pub(in crate::exec) extents_mm: Vec<(f64, f64)>,
    pub(in crate::exec) source: SourceRef,
    pub(in crate::exec) span: Span,
}
