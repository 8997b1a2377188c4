//! The legs of the control polygon of a spline, and the corners between them.

use super::node::Node;
use crate::axis::AxisVec;
use crate::block::{Block, Feed, SplineSettings};
use crate::contouring::NEEDLE_RAD;
use crate::path::{LinePath, Path, PolyPath};
use smallvec::SmallVec;
use std::f64::consts::PI;

/// A leg of the control polygon.
#[derive(Debug)]
pub(super) struct Edge {
    /// The leg itself, with the conditions of the first block along it.
    pub(super) block: Block,
    pub(super) parts: SmallVec<[Part; 2]>,
    /// The settings of the corner at its start, with the tolerances that are left.
    pub(super) settings: SplineSettings,
    pub(super) direction: AxisVec,
    pub(super) length: f64,
    /// The distance of the knots at its ends: the length, unless the leg is part of a fit.
    pub(super) interval: f64,
    pub(super) fitted: bool,
    pub(super) corner: Corner,
    /// The spline over it as if every corner of the run were rounded.
    pub(super) curves: Vec<Curve>,
}

/// The part of a block along a leg.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// The block as programmed.
    pub(super) block: Block,
    /// Where the part ends, as a share of the knot interval.
    pub(super) until: f64,
    /// Share of the whole block.
    pub(super) share: f64,
    /// Whether the block ends here.
    pub(super) last: bool,
}

/// A part of the spline over an edge.
#[derive(Debug)]
pub(super) struct Curve {
    pub(super) path: PolyPath,
    /// Highest speed.
    pub(super) v_mm_s: f64,
    /// The part of the edge that it belongs to.
    pub(super) part: usize,
}

/// The corner at the start of an edge inside a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Whether it is a programmed point. Other control points belong to a fit and are never sharp.
    pub(super) programmed: bool,
    /// Largest deviation in mm for a change of direction by 1, as far as the tolerances permit.
    pub(super) reach: f64,
    /// Distance `e` in mm of control points at `e` and `2 e` on either side.
    pub(super) e: Option<f64>,
    /// Whether the spline takes longer than the sharp corner.
    pub(super) slower: bool,
    /// The round of the decision since which the spline ends here; `None`: it does not.
    pub(super) sharp_since: Option<usize>,
}

impl Edge {
    /// The leg between two control points; `None` if they are the same point.
    pub(super) fn new(
        from: &Node,
        to: &Node,
        parts: SmallVec<[Part; 2]>,
        settings: SplineSettings,
    ) -> Option<Self> {
        let first = &parts.first()?.block;
        let feed_axes = &first.dynamics.feed_axes;
        let line = LinePath::new(from.point.clone(), to.point.clone(), feed_axes)?;
        let direction = line.direction().clone();
        let block = Block { path: Path::Line(line), ..first.clone() };
        let corner = Corner {
            programmed: from.is_corner,
            reach: f64::INFINITY,
            e: None,
            slower: false,
            sharp_since: None,
        };
        let (length, curves) = (block.path.length(), Vec::new());
        let (interval, fitted) = (to.knot - from.knot, from.fitted);
        Some(Self { block, parts, settings, direction, length, interval, fitted, corner, curves })
    }

    /// The leg with the conditions of the last block along it.
    pub(super) fn as_last(&self) -> Block {
        let last = self.parts.last().map_or(&self.block, |part| &part.block);
        Block { path: self.block.path.clone(), ..last.clone() }
    }
}

impl Corner {
    /// Whether the block before it ends elsewhere than at the knot ([`super::limits`]).
    pub(super) fn moves_limit(&self) -> bool {
        self.programmed && self.e.is_none() && self.sharp_since.is_none()
    }
}

/// The settings of a block that is part of a spline.
pub(super) fn programmed(block: &Block) -> Option<SplineSettings> {
    let settings = block.spline?;
    let Path::Line(line) = &block.path else { return None };
    let long = settings.max_length_mm > 0.0 && block.path.length() > settings.max_length_mm;
    let slaved_only =
        (0..line.direction().len()).all(|i| !is_feed(block, i) || line.direction()[i] == 0.0);
    let off = long || slaved_only || (settings.off_at_rapid && block.feed == Feed::Rapid);
    (!off).then_some(settings)
}

pub(super) fn is_feed(block: &Block, i: usize) -> bool {
    block.dynamics.feed_axes.get(i).copied().unwrap_or(true)
}

/// Difference in direction between two edges.
#[derive(Clone, Copy, Debug)]
struct Turn {
    /// Length of the change of direction over the feed axes.
    jump: f64,
    /// Angle between the directions over the feed axes in rad.
    angle_rad: f64,
    /// Largest change of `dq/ds` of an axis outside the feed group.
    track: f64,
}

fn turn(from: &[f64], to: &[f64], block: &Block) -> Turn {
    let (mut jump2, mut sum2, mut track) = (0.0, 0.0, 0.0_f64);
    for (i, (u, w)) in from.iter().zip(to).enumerate() {
        if is_feed(block, i) {
            jump2 += (w - u) * (w - u);
            sum2 += (w + u) * (w + u);
        } else {
            track = track.max((w - u).abs());
        }
    }
    let jump = f64::sqrt(jump2);
    Turn { jump, angle_rad: 2.0 * libm::atan2(jump, f64::sqrt(sum2)), track }
}

/// Whether a spline ends between two blocks, whatever their directions are.
pub(super) fn stops_between(a: &Block, b: &Block) -> bool {
    // where the path stops (G116) a spline would only bend an edge that could be straight
    b.dynamics.stop_at_transitions || a.dynamics.feed_axes != b.dynamics.feed_axes
}

/// Largest reach of the spline at a corner between edges of these lengths, for any knots of the other corners.
fn most(h: f64, k: f64) -> f64 {
    h * k / (h + k) * h.max(k) / (h + k)
}

/// Whether the spline ends at the second of three points because of their directions; the block ends at the third.
pub(super) fn ends_at(points: [&[f64]; 3], block: &Block, settings: &SplineSettings) -> bool {
    let line = |k: usize| {
        let [from, to] = [points[k], points[k + 1]].map(AxisVec::from_slice);
        LinePath::new(from, to, &block.dynamics.feed_axes)
    };
    let (Some(a), Some(b)) = (line(0), line(1)) else { return true };
    let Turn { jump, angle_rad, track } = turn(a.direction(), b.direction(), block);
    let most = most(Path::Line(a).length(), Path::Line(b).length());
    let exceeds = |off: bool, dev: f64, jump: f64| off && dev > 0.0 && most * jump > dev;
    angle_rad.to_degrees() > settings.max_angle_deg
        || angle_rad >= PI - NEEDLE_RAD
        || exceeds(settings.off_at_path_dev, settings.path_dev_mm, jump)
        || exceeds(settings.off_at_track_dev, settings.track_dev_deg, track)
}

/// Largest deviation of the spline at the corner between two edges of a run, for a change of direction by 1.
pub(super) fn reach(a: &Edge, b: &Edge) -> f64 {
    let Turn { jump, track, .. } = turn(&a.direction, &b.direction, &b.block);
    // next to a fit the corner always has its own control points
    let any = a.fitted || b.fitted;
    let most = most(a.length, b.length);
    let allowed = |dev: f64, jump: f64| {
        let limited = dev > 0.0 && jump > 0.0 && (any || most * jump > dev);
        if limited { dev / jump } else { f64::INFINITY }
    };
    let SplineSettings { path_dev_mm, track_dev_deg, .. } = b.settings;
    allowed(path_dev_mm, jump).min(allowed(track_dev_deg, track))
}
