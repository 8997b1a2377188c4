//! B-spline through runs of short linear blocks (`#HSC ON [BSPLINE]`): a stage between program and planner.
//!
//! The programmed points are the control points of a cubic B-spline whose knots lie at their distances along the
//! polygon (source: TF5200, extended HSC programming, control points; Assumption: degree and knots). In Bezier form the
//! piece of an edge has both inner points on that edge, and its ends lie on the lines that cut the corners. So every
//! piece belongs to one block, and is never further from its edge than its ends are: the deviation of the whole spline is
//! known from the corners alone.
//!
//! A corner whose deviation could exceed the tolerance gets two more control points on either side, at distances `e`
//! and `2 e`; its deviation is then `e/3 sin(theta/2)` and the spline touches the polygon before and behind it (P-CHAN-00129
//! = 0), or the spline ends there (`AUTO_OFF_PATH`). At its ends the spline meets the polygon with its direction and
//! without curvature. Position, tangent and curvature are continuous everywhere else.
//!
//! An edge becomes several blocks with the number of the programmed one where its parts allow different speeds.

mod pace;

use crate::axis::AxisVec;
use crate::block::{Block, Feed};
use crate::path::{Path, PolyPath, PolyPiece, piece};
use smallvec::SmallVec;
use std::collections::VecDeque;

/// Edges behind the present one that decide its piece.
const AHEAD: usize = 3;
/// Edges before the present one that decide its piece.
const BEHIND: usize = 3;
/// Part of an edge that `e` takes at most, so that the control points added at both ends stay in order.
const SHARE: f64 = 0.2;

/// Parameters of `#HSC [BSPLINE]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplineSettings {
    /// `PATH_DEV` in mm, default 0.2: largest deviation from the polygon; 0 = not monitored.
    pub path_dev_mm: f64,
    /// `TRACK_DEV` in deg, default 5: largest deviation of the axes outside the feed group; 0 = not monitored.
    pub track_dev_deg: f64,
    /// `AUTO_OFF_PATH`, default off: the spline ends where `PATH_DEV` would be exceeded.
    pub off_at_path_dev: bool,
    /// `AUTO_OFF_TRACK`, default off: the spline ends where `TRACK_DEV` would be exceeded.
    pub off_at_track_dev: bool,
    /// `AUTO_OFF_G00`, default on: rapid blocks are not part of the spline (Assumption: default).
    pub off_at_rapid: bool,
    /// `MAX_PATH_LENGTH` in mm, default 0 = any: longer blocks are not part of the spline.
    pub max_length_mm: f64,
    /// `MAX_ANGLE` in deg, default 180: the spline ends at corners that turn by more.
    pub max_angle_deg: f64,
}

impl Default for SplineSettings {
    fn default() -> Self {
        Self {
            path_dev_mm: 0.2,
            track_dev_deg: 5.0,
            off_at_path_dev: false,
            off_at_track_dev: false,
            off_at_rapid: true,
            max_length_mm: 0.0,
            max_angle_deg: 180.0,
        }
    }
}

/// A linear block of a run.
#[derive(Debug)]
struct Edge {
    block: Block,
    settings: SplineSettings,
    direction: AxisVec,
    length: f64,
    /// Distance of the control points added on either side of the corner at its start.
    corner: Option<f64>,
}

/// What the corner between two edges asks for.
enum Corner {
    Plain,
    /// Control points at `e` and `2 e` on either side.
    Refined(f64),
    /// The spline ends.
    End,
}

/// The stage. It holds at most [`AHEAD`] blocks, and what it needs of the [`BEHIND`] before them.
#[derive(Debug, Default)]
pub struct Splining {
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

    /// Takes a block; what is final comes back.
    pub fn push(&mut self, block: Block) -> impl Iterator<Item = Block> + '_ {
        self.take(block);
        self.ready.drain(..)
    }

    /// The path stops behind the last block: everything comes back.
    pub fn flush(&mut self) -> impl Iterator<Item = Block> + '_ {
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
                Corner::Plain => {}
                Corner::Refined(e) => edge.corner = Some(e),
                Corner::End => self.end_run(),
            }
        }
        self.from_start |= self.run.is_empty();
        self.run.push_back(edge);
        if self.run.len() > self.done + AHEAD {
            self.put_out(false);
        }
    }

    fn end_run(&mut self) {
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

    /// The spline over the next edge: one curve, or one for each part with a speed of its own.
    fn curves(&self, to_end: bool) -> Vec<PolyPath> {
        let polygon = ControlPolygon::around(&self.run, self.done, self.from_start, to_end);
        let pieces: Vec<PolyPiece> =
            (polygon.first..polygon.last).map(|j| polygon.piece(j)).collect();
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
        Some(Self { block: block.clone(), settings, direction, length, corner: None })
    }

    fn start(&self) -> &AxisVec {
        self.block.path.start()
    }
}

fn is_feed(block: &Block, i: usize) -> bool {
    block.dynamics.feed_axes.get(i).copied().unwrap_or(true)
}

/// Judges the corner between two edges of a run.
fn corner(a: &Edge, b: &Edge) -> Corner {
    if a.block.dynamics.feed_axes != b.block.dynamics.feed_axes {
        return Corner::End;
    }
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
    let angle = 2.0 * libm::atan2(jump, sum2.sqrt());
    let settings = &b.settings;
    if angle.to_degrees() > settings.max_angle_deg || sum2 <= 1e-12 {
        return Corner::End;
    }
    // both points that cut the corner are at most `cut` away from it, whatever the other knots are, and the joint
    // between them divides their distance in the ratio of the edges
    let (h, k) = (a.length, b.length);
    let cut = h * k / (h + k) * h.max(k) / (h + k);
    let monitored = |dev: f64, off: bool, jump: f64| {
        (dev > 0.0 && cut * jump > dev).then_some((off, 6.0 * dev / jump))
    };
    let path = monitored(settings.path_dev_mm, settings.off_at_path_dev, jump);
    let slaved = monitored(settings.track_dev_deg, settings.off_at_track_dev, track);
    let demands = [path, slaved];
    if demands.iter().flatten().any(|(off, _)| *off) {
        return Corner::End;
    }
    match demands.iter().flatten().map(|(_, e)| *e).min_by(f64::total_cmp) {
        None => Corner::Plain,
        Some(e) => Corner::Refined(e.min(SHARE * h.min(k))),
    }
}

/// Control points around an edge with their knots.
struct ControlPolygon {
    points: SmallVec<[AxisVec; 24]>,
    /// Distances along the polygon.
    knots: SmallVec<[f64; 24]>,
    /// Control points at the start and the end of the edge.
    first: usize,
    last: usize,
}

impl ControlPolygon {
    fn around(run: &VecDeque<Edge>, edge: usize, from_start: bool, to_end: bool) -> Self {
        let mut out = Self { points: SmallVec::new(), knots: SmallVec::new(), first: 0, last: 0 };
        let begin = edge.saturating_sub(2);
        let end = (edge + AHEAD).min(run.len());
        let mut at = 0.0;
        for i in begin..end {
            let Edge { length, corner, .. } = run[i];
            out.last = if i == edge + 1 { out.points.len() } else { out.last };
            out.first = if i == edge { out.points.len() } else { out.first };
            out.points.push(run[i].start().clone());
            out.knots.push(at);
            let behind = run.get(i + 1).and_then(|next| next.corner);
            let near = corner.into_iter().flat_map(|e| [e, 2.0 * e]);
            let far = behind.into_iter().flat_map(|e| [length - 2.0 * e, length - e]);
            for d in near.chain(far) {
                let mut p = run[i].start().clone();
                run[i].block.path.position(d, &mut p);
                out.points.push(p);
                out.knots.push(at + d);
            }
            at += length;
        }
        if let Some(last) = run.get(end.wrapping_sub(1)) {
            out.last = if end == edge + 1 { out.points.len() } else { out.last };
            out.points.push(last.block.path.end().clone());
            out.knots.push(at);
        }
        if to_end && end == run.len() {
            out.mirror_end();
        }
        if from_start && begin == 0 {
            out.mirror_start();
        }
        out
    }

    /// Two control points mirrored at the end, which make it an exact end without curvature.
    fn mirror_end(&mut self) {
        let n = self.points.len() - 1;
        for back in 1..=2 {
            let at = n.saturating_sub(back);
            let p = self.points[n].iter().zip(self.points[at].iter()).map(|(e, p)| 2.0 * e - p);
            self.points.push(p.collect());
            self.knots.push(2.0 * self.knots[n] - self.knots[at]);
        }
    }

    fn mirror_start(&mut self) {
        for _ in 0..2 {
            // what stands at 0, 1 first is the start; after one insertion it stands at 1
            let start = self.knots.iter().position(|k| *k >= 0.0).unwrap_or(0);
            let at = 2 * start + 1;
            let p = self.points[start].iter().zip(self.points[at].iter()).map(|(s, p)| 2.0 * s - p);
            self.points.insert(0, p.collect());
            self.knots.insert(0, 2.0 * self.knots[start] - self.knots[at]);
            self.first += 1;
            self.last += 1;
        }
    }

    /// Point on the leg behind control point `j` with the knots around it and the third knot `t`.
    fn on_leg(&self, j: usize, t: f64) -> AxisVec {
        let (before, behind) = (self.knots[j - 1], self.knots[j + 2]);
        let ratio = (t - before) / (behind - before);
        self.points[j]
            .iter()
            .zip(self.points[j + 1].iter())
            .map(|(p, q)| p + ratio * (q - p))
            .collect()
    }

    /// Inner Bezier points of the interval behind knot `j`.
    fn inner(&self, j: usize) -> [AxisVec; 2] {
        [self.on_leg(j, self.knots[j]), self.on_leg(j, self.knots[j + 1])]
    }

    /// Point of the spline at knot `j`.
    fn joint(&self, j: usize) -> AxisVec {
        let before = self.on_leg(j - 1, self.knots[j]);
        let behind = self.on_leg(j, self.knots[j]);
        let ratio = (self.knots[j] - self.knots[j - 1]) / (self.knots[j + 1] - self.knots[j - 1]);
        before.iter().zip(behind.iter()).map(|(p, q)| p + ratio * (q - p)).collect()
    }

    /// The polynomial between knot `j` and the next one.
    fn piece(&self, j: usize) -> PolyPiece {
        let (b0, b3) = (self.joint(j), self.joint(j + 1));
        let [b1, b2] = self.inner(j);
        (0..b0.len())
            .map(|i| {
                let (p, q, r, s) = (b0[i], b1[i], b2[i], b3[i]);
                let second = (p - q) - (q - r);
                [p, 3.0 * (q - p), 3.0 * second, (s - p) - 3.0 * (r - q), 0.0, 0.0]
            })
            .collect()
    }
}
