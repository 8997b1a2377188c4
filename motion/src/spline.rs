//! B-spline through runs of short linear blocks (`#HSC ON [BSPLINE]`): a stage between program and planner.
//!
//! The programmed points, freed from the noise of rounding ([`fairing`]), are the control points of a cubic B-spline whose knots lie at their distances along the
//! polygon (source: TF5200, extended HSC programming, control points; Assumption: degree and knots). In Bezier form the
//! piece of an edge has both inner points on that edge, and its ends lie on the lines that cut the corners. So every
//! piece belongs to one block, and is never further from its edge than its ends are: the deviation of the whole spline is
//! known from the corners alone.
//!
//! At even edges the deviation is a sixth of an edge times the change of direction: `h^2 / (6 r)` where the polygon runs
//! along a radius. A corner that would deviate more is drawn back. With a little too small a tolerance, knots in the
//! middles of its edges leave only the corner itself to move back to the programmed point, by as much as is needed; the
//! full way halves the deviation, and the next knots continue from there. So the tolerance is used, and a larger one makes
//! the spline neither sharper nor abruptly different. A corner whose tolerance is small compared with its edges, or whose edges
//! are uneven and whose deviation could exceed the tolerance for any other edges, gets two more control points on either side, at distances `e` and `2 e`; its deviation is then `e/3 sin(theta/2)` and the spline
//! touches the polygon before and after it (P-CHAN-00129 = 0). Or the spline ends there (`AUTO_OFF_PATH`; this goes by the
//! bound for any other edges, at even ones a quarter of an edge). At its ends the spline meets the polygon with its
//! direction and without curvature. Position, tangent and curvature are continuous everywhere else.
//!
//! Whatever the control points: a spline that passes a corner at the distance `d` with a change of direction by `jump`
//! has a curvature of about `jump^2 / (6 d)` there. Below the deviation of the even polygon a smaller tolerance therefore
//! costs speed, as its root: the edges get straighter and the corners sharper, and the path speed has a ripple. A corner
//! just short of a reversal stays a corner, as in contouring.
//!
//! `PATH_DEV` and `TRACK_DEV` hold for both together: what fairing takes is missing for the corners.
//!
//! An edge becomes several blocks with the number of the programmed one where its parts allow different speeds.
//!
//! In front of the planner, as [`crate::contouring`]: [`Splining::push`] block by block, [`Splining::flush`] where the path stops.
//!
//! ```
//! # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
//! # use doc::*;
//! use kontur_motion::block::SplineSettings;
//! use kontur_motion::spline::Splining;
//!
//! // a circle of 10 mm in chords of 10 degrees
//! let point = |i: u64| { let (sin, cos) = libm::sincos(i as f64 * 0.1745); [10.0 * cos, 10.0 * sin] };
//! let mut stage = Splining::new();
//! let mut out: Vec<Block> = Vec::new();
//! for i in 0..36 {
//!     let mut chord = block(i, point(i), point(i + 1), 100.0);
//!     chord.spline = Some(SplineSettings::default());
//!     out.extend(stage.push(chord));
//! }
//! out.extend(stage.flush());
//! assert!(out.iter().all(|block| !block.path.is_straight()));
//! ```

mod fairing;
mod pace;
mod polygon;

use crate::axis::AxisVec;
use crate::block::{Block, Feed, SplineSettings};
use crate::contouring::NEEDLE_RAD;
use crate::path::{Path, PolyPath, piece};
use fairing::Fairing;
use polygon::ControlPolygon;
use std::collections::VecDeque;
use std::f64::consts::PI;

/// Edges after the present one that decide its piece.
const AHEAD: usize = 5;
/// Edges before the present one that decide its piece.
const BEHIND: usize = 3;
/// Part of an edge that `e` takes at most, so that the control points added at both ends stay in order. Below a quarter,
/// where twice halved edges have the same control points.
const SHARE: f64 = 0.245;
/// Edges around a corner whose lengths differ by no more than this ratio can be halved: each halving takes at least a
/// third of the deviation. Otherwise the control points would crowd at the ends of short edges.
const EVEN: f64 = 2.0;

/// A linear block of a run.
#[derive(Debug)]
struct Edge {
    block: Block,
    settings: SplineSettings,
    direction: AxisVec,
    length: f64,
    corner: Corner,
}

/// The corner at the start of an edge inside a run.
#[derive(Clone, Copy, Debug)]
struct Corner {
    /// Largest deviation there for a change of direction by 1 in mm, as far as the tolerances go.
    reach: f64,
    /// Control points at `e` and `2 e` on either side.
    e: Option<f64>,
}

impl Corner {
    const FREE: Self = Self { reach: f64::INFINITY, e: None };
}

/// The stage. It holds at most [`AHEAD`] blocks after those of [`fairing`], and what it needs of the [`BEHIND`] before them.
#[derive(Debug, Default)]
pub struct Splining {
    fairing: Fairing,
    run: VecDeque<Edge>,
    /// Edges at the front that have been put out.
    done: usize,
    /// The first edge in the buffer is the first of the run.
    from_start: bool,
    ready: Vec<Block>,
}

impl Splining {
    /// A stage that holds nothing.
    pub fn new() -> Self {
        Self::default()
    }

    /// The block does not belong to a spline, and none is waiting: pushed, it would be returned at once and unchanged.
    pub fn passes(&self, block: &Block) -> bool {
        block.spline.is_none() && self.run.is_empty() && self.fairing.is_empty()
    }

    /// Takes a block; what is final comes back.
    pub fn push(&mut self, block: Block) -> impl Iterator<Item = Block> + '_ {
        let mut fairing = std::mem::take(&mut self.fairing);
        for block in fairing.push(block) {
            self.take(block);
        }
        self.fairing = fairing;
        self.ready.drain(..)
    }

    /// The path stops after the last block: everything comes back.
    pub fn flush(&mut self) -> impl Iterator<Item = Block> + '_ {
        let mut fairing = std::mem::take(&mut self.fairing);
        for block in fairing.flush() {
            self.take(block);
        }
        self.fairing = fairing;
        self.end_run();
        self.ready.drain(..)
    }

    fn take(&mut self, block: Block) {
        let Some(mut edge) = Edge::new(&block) else {
            self.end_run();
            self.ready.push(block);
            return;
        };
        if let Some(last) = self.run.back() {
            match corner(last, &edge) {
                Some(corner) => edge.corner = corner,
                None => self.end_run(),
            }
        }
        self.from_start |= self.run.is_empty();
        self.settle(edge.length);
        self.run.push_back(edge);
        if self.run.len() > self.done + AHEAD {
            self.put_out(false);
        }
    }

    /// Settles the corner at the start of the last edge, which the length of the next edge has a part in.
    fn settle(&mut self, next: f64) {
        let Some(at) = self.run.len().checked_sub(2) else { return };
        let (h, k) = (self.run[at].length, self.run[at + 1].length);
        let g = if at > 0 { self.run[at - 1].length } else { h };
        let lengths = [g, h, k, next];
        let shortest = lengths.into_iter().fold(f64::INFINITY, f64::min);
        let even = lengths.iter().all(|l| *l <= EVEN * shortest);
        let most = SHARE * h.min(k);
        let Corner { reach, e } = &mut self.run[at + 1].corner;
        if reach.is_finite() {
            let exact = 6.0 * *reach;
            *e = (!even || exact < most).then_some(exact.min(most));
        }
    }

    fn end_run(&mut self) {
        if let Some(last) = self.run.back() {
            // mirrored at the end
            self.settle(last.length);
        }
        while self.done < self.run.len() {
            self.put_out(true);
        }
        self.run.clear();
        (self.done, self.from_start) = (0, false);
    }

    /// Puts out the piece of the next edge.
    fn put_out(&mut self, to_end: bool) {
        let single = self.from_start && to_end && self.run.len() == 1;
        let curves = if single { Vec::new() } else { self.curves(to_end) };
        let block = &self.run[self.done].block;
        if curves.is_empty() {
            self.ready.push(block.clone());
        }
        let whole: f64 = curves.iter().map(PolyPath::length).sum();
        let parts = curves.len();
        for (i, curve) in curves.into_iter().enumerate() {
            let mut part = block.clone();
            if let Feed::Duration(t) = block.feed {
                part.feed = Feed::Duration(t * curve.length() / whole);
            }
            if i + 1 < parts {
                (part.end_velocity_mm_s, part.contour) = (None, None);
            }
            part.path = Path::Curve(Box::new(curve));
            self.ready.push(part);
        }
        self.done += 1;
        if self.done > BEHIND {
            self.run.pop_front();
            self.done -= 1;
            self.from_start = false;
        }
    }

    /// The spline over the next edge: one curve, or one for each part with its own speed.
    fn curves(&self, to_end: bool) -> Vec<PolyPath> {
        let polygon = ControlPolygon::around(&self.run, self.done, self.from_start, to_end);
        let pieces = polygon.pieces();
        let block = &self.run[self.done].block;
        let mut start = if self.from_start && self.done == 0 {
            block.path.start().clone()
        } else {
            polygon.joint(polygon.first)
        };
        let end = if to_end && self.done + 1 == self.run.len() {
            block.path.end().clone()
        } else {
            polygon.joint(polygon.last)
        };
        // a stop at every transition (G116) means those of the program
        let groups = if block.dynamics.stop_at_transitions {
            vec![pieces]
        } else {
            pace::groups(block, pieces)
        };
        let mut groups = groups.into_iter();
        let mut out = Vec::with_capacity(groups.len());
        while let Some(pieces) = groups.next() {
            let here = match pieces.last() {
                Some(last) if groups.len() > 0 => piece::point(last, 1.0),
                _ => end.clone(),
            };
            let from = std::mem::replace(&mut start, here.clone());
            out.extend(PolyPath::new(from, here, pieces, &block.dynamics.feed_axes));
        }
        out
    }
}

impl Edge {
    /// `None` if the block is not part of a spline.
    fn new(block: &Block) -> Option<Self> {
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
        Some(Self { block: block.clone(), settings, direction, length, corner: Corner::FREE })
    }
}

fn is_feed(block: &Block, i: usize) -> bool {
    block.dynamics.feed_axes.get(i).copied().unwrap_or(true)
}

/// How two edges differ in direction.
#[derive(Clone, Copy, Debug)]
struct Turn {
    /// Length of the change of direction over the feed axes.
    jump: f64,
    /// Angle between the directions over the feed axes in rad.
    angle_rad: f64,
    /// Largest change of `dq/ds` of an axis outside the feed group.
    track: f64,
}

fn turn(a: &Edge, b: &Edge) -> Turn {
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
fn corner(a: &Edge, b: &Edge) -> Option<Corner> {
    if a.block.dynamics.feed_axes != b.block.dynamics.feed_axes {
        return None;
    }
    let Turn { jump, angle_rad: angle, track } = turn(a, b);
    let settings = &b.settings;
    if angle.to_degrees() > settings.max_angle_deg || angle >= PI - NEEDLE_RAD {
        return None;
    }
    // the reach whatever the knots of the other corners are
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
    Some(Corner { reach, e: None })
}
