//! The edges of a run, and the corners between them.

use crate::axis::AxisVec;
use crate::block::{Block, Feed, SplineSettings};
use crate::contouring::NEEDLE_RAD;
use crate::path::{Path, PolyPath};
use std::f64::consts::PI;

/// A linear block of a run.
#[derive(Debug)]
pub(super) struct Edge {
    pub(super) block: Block,
    pub(super) settings: SplineSettings,
    pub(super) direction: AxisVec,
    pub(super) length: f64,
    pub(super) corner: Corner,
    /// The spline over it as if every corner of the run were rounded.
    pub(super) curves: Vec<Curve>,
}

/// A part of the spline over an edge.
#[derive(Debug)]
pub(super) struct Curve {
    pub(super) path: PolyPath,
    /// Highest speed.
    pub(super) v_mm_s: f64,
}

/// The corner at the start of an edge inside a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Largest deviation in mm for a change of direction by 1, as far as the tolerances permit.
    pub(super) reach: f64,
    /// Distance `e` in mm of control points at `e` and `2 e` on either side.
    pub(super) e: Option<f64>,
    /// Whether the spline takes longer than the sharp corner.
    pub(super) slower: bool,
    /// The round of the decision since which the spline ends here; `None`: it does not.
    pub(super) sharp_since: Option<usize>,
}

impl Corner {
    pub(super) const FREE: Self =
        Self { reach: f64::INFINITY, e: None, slower: false, sharp_since: None };
}

impl Edge {
    /// `None` if the block is not part of a spline.
    pub(super) fn new(block: &Block) -> Option<Self> {
        let settings = block.spline?;
        let Path::Line(line) = &block.path else { return None };
        let length = block.path.length();
        let long = settings.max_length_mm > 0.0 && length > settings.max_length_mm;
        let slaved_only =
            (0..line.direction().len()).all(|i| !is_feed(block, i) || line.direction()[i] == 0.0);
        if long || slaved_only || (settings.off_at_rapid && block.feed == Feed::Rapid) {
            return None;
        }
        let direction = line.direction().clone();
        let (corner, curves) = (Corner::FREE, Vec::new());
        Some(Self { block: block.clone(), settings, direction, length, corner, curves })
    }
}

pub(super) fn is_feed(block: &Block, i: usize) -> bool {
    block.dynamics.feed_axes.get(i).copied().unwrap_or(true)
}

/// Difference in direction between two edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    /// Length of the change of direction over the feed axes.
    pub(super) jump: f64,
    /// Angle between the directions over the feed axes in rad.
    pub(super) angle_rad: f64,
    /// Largest change of `dq/ds` of an axis outside the feed group.
    pub(super) track: f64,
}

pub(super) fn turn(a: &Edge, b: &Edge) -> Turn {
    let (mut jump2, mut sum2, mut track) = (0.0, 0.0, 0.0_f64);
    for i in 0..a.direction.len() {
        let (u, w) = (a.direction[i], b.direction[i]);
        if is_feed(&b.block, i) {
            jump2 += (w - u) * (w - u);
            sum2 += (w + u) * (w + u);
        } else {
            track = track.max((w - u).abs());
        }
    }
    let jump = jump2.sqrt();
    Turn { jump, angle_rad: 2.0 * libm::atan2(jump, sum2.sqrt()), track }
}

/// Judges the corner between two edges of a run; `None` where the spline ends.
pub(super) fn corner(a: &Edge, b: &Edge) -> Option<Corner> {
    // where the path stops (G116) a spline would only bend an edge that could be straight
    let stops = b.block.dynamics.stop_at_transitions;
    if stops || a.block.dynamics.feed_axes != b.block.dynamics.feed_axes {
        return None;
    }
    let Turn { jump, angle_rad: angle, track } = turn(a, b);
    let settings = &b.settings;
    if angle.to_degrees() > settings.max_angle_deg || angle >= PI - NEEDLE_RAD {
        return None;
    }
    // the reach for any knots of the other corners
    let (h, k) = (a.length, b.length);
    let most = h * k / (h + k) * h.max(k) / (h + k);
    let allowed = |dev: f64, off: bool, jump: f64| {
        (dev > 0.0 && most * jump > dev).then_some((off, dev / jump))
    };
    let path = allowed(settings.path_dev_mm, settings.off_at_path_dev, jump);
    let slaved = allowed(settings.track_dev_deg, settings.off_at_track_dev, track);
    let mut reach = f64::INFINITY;
    for (off, allowed) in [path, slaved].into_iter().flatten() {
        if off {
            return None;
        }
        reach = reach.min(allowed);
    }
    Some(Corner { reach, ..Corner::FREE })
}
