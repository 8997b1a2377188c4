//! Polynomial contouring (G61, G261, `#CONTOUR MODE`): a stage between program and planner.
//!
//! At the end of every block with [`Block::contour`] the corner is replaced by a curve ([`blend`]): the block and the
//! relevant one behind it are shortened by the corner distances, the curve takes the number of the block before it.
//! Where that is not possible the corner stays as programmed and a [`Notice`] says why. The stage holds one block, and
//! those too short to be relevant behind it, at most [`SKIPPED`] of them.

mod blend;

use crate::axis::AxisVec;
use crate::block::{Block, ChannelDynamics, CurveJerk, Feed};
use crate::limits::{PathExtremes, PathSpeeds};
use crate::path::{Path, PolyPath, PolyPiece};
use blend::{Blend, End};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// Blocks in a row that may be too short to be relevant before one of them counts all the same.
const SKIPPED: usize = 100;
/// Least tolerance and least corner distance in mm: the resolution of the vendor's lengths.
const SMALLEST_MM: f64 = 1e-4;
/// Direction changes below this are rounding of the program's numbers, as at kinks.
const TANGENT: f64 = 1e-9;
/// Pieces per half of the curve, each with a speed of its own (without CONST_VEL).
const PARTS: u32 = 4;
/// What is left of a block between two curves and shorter than this part of it is rounding.
const ROUNDING: f64 = 1e-12;

/// Which points of the blocks the curve connects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContourMode {
    /// DEV: the interim point is at most this far from the corner.
    Dev {
        /// PATH_DEV in mm, default 1.
        path_dev_mm: f64,
    },
    /// DIST: the curve begins and ends at given distances from the corner.
    Dist {
        /// PRE_DIST in mm, default 1.
        pre_mm: f64,
        /// POST_DIST in mm, default 1.
        post_mm: f64,
    },
    /// POS: the curve passes through a given point.
    Pos {
        /// PRE_DIST in mm, default 1, 0 is allowed.
        pre_mm: f64,
        /// POST_DIST in mm, default 1, 0 is allowed.
        post_mm: f64,
        /// Coordinates in the three main axes (the first three of the channel); the corner's where not given.
        point_mm: [Option<f64>; 3],
    },
    /// PTP: as DEV, the corner distance bounded as well. Assumption: the documents describe the task of this mode but not
    /// its curve.
    Ptp {
        /// PATH_DEV in mm, default 1.
        path_dev_mm: f64,
        /// PATH_DIST in mm, default 1.
        path_dist_mm: f64,
    },
    /// DIST_SOFT; not published, falls back to [`Self::Ptp`] with PATH_DEV 1 mm and a notice.
    DistSoft {
        /// PATH_DIST in mm, default 1; negative: not bounded.
        path_dist_mm: f64,
    },
    /// DIST_MASTER; falls back as [`Self::DistSoft`].
    DistMaster {
        /// PATH_DIST in mm, default 1; negative: not bounded.
        path_dist_mm: f64,
    },
}

impl Default for ContourMode {
    fn default() -> Self {
        Self::Dev { path_dev_mm: 1.0 }
    }
}

/// Parameters of `#CONTOUR MODE`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContourSettings {
    /// Mode with its lengths.
    pub mode: ContourMode,
    /// RELEVANT_PATH in mm, default 0: shorter blocks are bridged.
    pub relevant_path_mm: f64,
    /// TRACK_DEV in deg, default 0 = not monitored: deviation of the axes outside the feed group.
    pub track_dev_deg: f64,
    /// RELEVANT_TRACK in deg, default 0: a block that moves such an axis further is relevant.
    pub relevant_track_deg: f64,
    /// REMAIN_PART as a ratio 0..1, default 0: part of each block that stays.
    pub remain_ratio: f64,
    /// MAX_ANGLE in deg, default 180: corners that turn by more stay.
    pub max_angle_deg: f64,
    /// CONST_VEL, default off: one speed over the whole curve.
    pub constant_velocity: bool,
    /// CHECK_JERK; `None`: as P-CHAN-00110.
    pub curve_jerk: Option<CurveJerk>,
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
        }
    }
}

/// Why a corner was not contoured as asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoContour {
    /// 120216: a block is too short.
    BlockTooShort,
    /// 120129: PATH_DEV is below the minimum.
    DeviationTooSmall {
        /// PATH_DEV in mm.
        value_mm: f64,
        /// Minimum in mm.
        least_mm: f64,
    },
    /// 120131: a corner distance is below the minimum.
    DistanceTooSmall {
        /// Distance in mm.
        value_mm: f64,
        /// Minimum in mm.
        least_mm: f64,
    },
    /// 120207: the path reverses, or only one of the blocks moves axes of the feed group.
    NotPossible,
    /// 120566: the feed group differs between the blocks.
    FeedGroup,
    /// 120206 at the end of a program: no block follows before the path stops.
    NothingFollows,
    /// The corner turns by more than MAX_ANGLE.
    AngleAboveMaximum {
        /// Angle of the corner in deg.
        angle_deg: f64,
    },
    /// The mode is not available; the corner was contoured as DEV.
    ModeReplaced,
}

/// A corner that was not contoured as asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Notice {
    /// Number of the block before the corner.
    pub seq: u64,
    /// What was in the way.
    pub reason: NoContour,
}

impl Notice {
    /// The vendor's message number, if there is one.
    pub fn id(&self) -> Option<u32> {
        match self.reason {
            NoContour::BlockTooShort => Some(120_216),
            NoContour::DeviationTooSmall { .. } => Some(120_129),
            NoContour::DistanceTooSmall { .. } => Some(120_131),
            NoContour::NotPossible => Some(120_207),
            NoContour::FeedGroup => Some(120_566),
            NoContour::NothingFollows => Some(120_206),
            NoContour::AngleAboveMaximum { .. } | NoContour::ModeReplaced => None,
        }
    }
}

/// A block whose start may already belong to a curve.
#[derive(Debug)]
struct Held {
    block: Block,
    /// Path length at which what is left of the block begins.
    from: f64,
}

/// The stage.
#[derive(Debug, Default)]
pub struct Contouring {
    held: Option<Held>,
    skipped: Vec<Block>,
    ready: Vec<Block>,
    notices: Vec<Notice>,
    /// Limits with the jerk check of the settings, made from the ones beside it.
    checked: Option<(Arc<ChannelDynamics>, Arc<ChannelDynamics>)>,
}

/// A curve that fits.
struct Curve {
    blend: Blend,
    pre_mm: f64,
    post_mm: f64,
}

/// Lengths that bound the curve at one corner.
#[derive(Clone, Copy)]
struct Bounds {
    pre: f64,
    post: f64,
    /// Largest distance of the interim point from the corner.
    dev: Option<f64>,
    /// Both distances stay equal when one of them is limited.
    symmetric: bool,
    point: [Option<f64>; 3],
    passes_point: bool,
}

impl Contouring {
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
        if let Some(held) = self.held.take() {
            if held.block.contour.is_some() {
                self.notice(held.block.seq, NoContour::NothingFollows);
            }
            self.emit(&held, None);
            self.ready.append(&mut self.skipped);
        }
        self.ready.drain(..)
    }

    /// Corners that were not contoured as asked for, since the last call.
    pub fn take_notices(&mut self) -> Vec<Notice> {
        std::mem::take(&mut self.notices)
    }

    fn notice(&mut self, seq: u64, reason: NoContour) {
        self.notices.push(Notice { seq, reason });
    }

    fn take(&mut self, block: Block) {
        let Some(held) = self.held.take() else {
            self.held = Some(Held { block, from: 0.0 });
            return;
        };
        let Some(settings) = held.block.contour else {
            self.emit(&held, None);
            self.held = Some(Held { block, from: 0.0 });
            return;
        };
        if !relevant(&block, &settings) && self.skipped.len() < SKIPPED {
            self.skipped.push(block);
            self.held = Some(held);
            return;
        }
        let seq = held.block.seq;
        let mut from = 0.0;
        match curve(&held, &self.skipped, &block, &settings) {
            Ok(Some(curve)) => {
                let soft = matches!(
                    settings.mode,
                    ContourMode::DistSoft { .. } | ContourMode::DistMaster { .. }
                );
                if soft {
                    self.notice(seq, NoContour::ModeReplaced);
                }
                self.emit(&held, Some(curve.pre_mm));
                self.emit_curve(&held.block, &block, &curve, &settings);
                self.skipped.clear();
                from = curve.post_mm;
            }
            Ok(None) => {
                self.emit(&held, None);
                self.ready.append(&mut self.skipped);
            }
            Err(reason) => {
                self.notice(seq, reason);
                self.emit(&held, None);
                self.ready.append(&mut self.skipped);
            }
        }
        self.held = Some(Held { block, from });
    }

    /// What is left of a block after the curves at its start and, `pre` mm before its end, at its end.
    fn emit(&mut self, held: &Held, pre: Option<f64>) {
        let whole = held.block.path.length();
        let to = whole - pre.unwrap_or(0.0);
        if to - held.from <= ROUNDING * whole {
            return;
        }
        let mut block = held.block.clone();
        if held.from > 0.0 || pre.is_some() {
            block.feed = speed(&block);
            if let Some(path) = block.path.section(held.from, to) {
                block.path = path;
            }
        }
        block.contour = None;
        self.ready.push(block);
    }

    fn emit_curve(&mut self, from: &Block, to: &Block, curve: &Curve, settings: &ContourSettings) {
        let mut block = from.clone();
        block.contour = None;
        (block.feed, block.feed_ratio) = slower(from, to);
        if let (Some(e), Feed::PathVelocity(v)) = (from.end_velocity_mm_s, block.feed) {
            // the end of the block lies inside the curve
            block.feed = Feed::PathVelocity(v.min(e / block.feed_ratio.max(f64::MIN_POSITIVE)));
        }
        let dev = [from, to].iter().filter_map(|b| b.tolerance.ax_dev_mm).min_by(f64::total_cmp);
        block.tolerance.ax_dev_mm = dev;
        if let Some(check) = settings.curve_jerk {
            block.dynamics = self.with_check(&block.dynamics, check);
        }
        let parts = if settings.constant_velocity { 1 } else { PARTS };
        // neighbouring pieces that allow the same speed are one block
        let mut group: Vec<PolyPiece> = Vec::new();
        let mut speed = None;
        let feed_axes = from.dynamics.feed_axes.clone();
        for piece in curve.blend.pieces(parts) {
            let Some(path) = poly(vec![piece.clone()], &feed_axes) else { continue };
            block.path = Path::Curve(path);
            let speeds = PathSpeeds::of(&block, &PathExtremes::of(&block.path));
            let v = speeds.limited(speeds.programmed_mm_s).0;
            let same =
                settings.constant_velocity || speed.is_some_and(|w: f64| (v - w).abs() <= 1e-9 * w);
            if !same && !group.is_empty() {
                self.ready.extend(with_path(&block, std::mem::take(&mut group), &feed_axes));
            }
            speed = Some(v);
            group.push(piece);
        }
        self.ready.extend(with_path(&block, group, &feed_axes));
    }

    fn with_check(
        &mut self,
        dynamics: &Arc<ChannelDynamics>,
        check: CurveJerk,
    ) -> Arc<ChannelDynamics> {
        if dynamics.curve_jerk == check {
            return Arc::clone(dynamics);
        }
        match &self.checked {
            Some((of, made)) if Arc::ptr_eq(of, dynamics) && made.curve_jerk == check => {
                Arc::clone(made)
            }
            _ => {
                let mut made = ChannelDynamics::clone(dynamics);
                made.curve_jerk = check;
                let made = Arc::new(made);
                self.checked = Some((Arc::clone(dynamics), Arc::clone(&made)));
                made
            }
        }
    }
}

fn poly(pieces: Vec<PolyPiece>, feed_axes: &[bool]) -> Option<PolyPath> {
    let start = blend::point(pieces.first()?, 0.0);
    let end = blend::point(pieces.last()?, 1.0);
    PolyPath::new(start, end, pieces, feed_axes)
}

fn with_path(block: &Block, pieces: Vec<PolyPiece>, feed_axes: &[bool]) -> Option<Block> {
    let path = Path::Curve(poly(pieces, feed_axes)?);
    Some(Block { path, ..block.clone() })
}

/// Feed of a block whose path gets shorter: a time becomes the speed it stands for.
fn speed(block: &Block) -> Feed {
    match block.feed {
        Feed::Duration(t) => Feed::PathVelocity(block.path.length() / t),
        feed => feed,
    }
}

/// The slower of the feeds of two blocks, with its ratio; a feed before rapid.
fn slower(a: &Block, b: &Block) -> (Feed, f64) {
    let (fa, fb) = (speed(a), speed(b));
    let of_b = match (fa, fb) {
        (Feed::PathVelocity(va), Feed::PathVelocity(vb)) => vb * b.feed_ratio < va * a.feed_ratio,
        (Feed::Rapid, Feed::Rapid) | (Feed::ShareOfMaximum(_), Feed::ShareOfMaximum(_)) => {
            b.feed_ratio < a.feed_ratio
        }
        (Feed::Rapid, _) => true,
        _ => false,
    };
    if of_b { (fb, b.feed_ratio) } else { (fa, a.feed_ratio) }
}

fn is_feed(block: &Block, i: usize) -> bool {
    block.dynamics.feed_axes.get(i).copied().unwrap_or(true)
}

/// True if a block is long enough to be the block behind a corner.
fn relevant(block: &Block, settings: &ContourSettings) -> bool {
    let (start, end) = (block.path.start(), block.path.end());
    let track = (0..start.len())
        .filter(|&i| !is_feed(block, i))
        .map(|i| (end[i] - start[i]).abs())
        .fold(0.0, f64::max);
    block.path.length() >= settings.relevant_path_mm || track > settings.relevant_track_deg
}

/// Largest corner distance of a block: half of what does not have to remain, on arcs at most a quarter turn
/// (source: TF5200, maximum corner distance).
fn longest(path: &Path, settings: &ContourSettings) -> f64 {
    let half = 0.5 * (1.0 - settings.remain_ratio.clamp(0.0, 1.0)) * path.length();
    match path {
        Path::Arc(arc) => half.min(path.length() * FRAC_PI_2 / arc.shape().sweep_rad.abs()),
        _ => half,
    }
}

/// The curve at the corner between two blocks; `None` if there is no corner.
fn curve(
    held: &Held,
    skipped: &[Block],
    to: &Block,
    settings: &ContourSettings,
) -> Result<Option<Curve>, NoContour> {
    let from = &held.block;
    if from.dynamics.feed_axes != to.dynamics.feed_axes {
        return Err(NoContour::FeedGroup);
    }
    if [from, to].iter().any(|b| matches!(b.path, Path::Curve(_))) {
        return Err(NoContour::NotPossible);
    }
    let corner = Corner::new(from, skipped, to, settings);
    if corner.mixed {
        return Err(NoContour::NotPossible);
    }
    if skipped.is_empty() && corner.jump <= TANGENT {
        return Ok(None);
    }
    if corner.angle_rad >= PI - 1e-6 {
        return Err(NoContour::NotPossible);
    }
    let angle_deg = corner.angle_rad.to_degrees();
    if angle_deg > settings.max_angle_deg {
        return Err(NoContour::AngleAboveMaximum { angle_deg });
    }
    let bounds = bounds(settings)?;
    corner.fit(bounds).map(Some).ok_or(NoContour::BlockTooShort)
}

fn bounds(settings: &ContourSettings) -> Result<Bounds, NoContour> {
    let free = Bounds {
        pre: f64::INFINITY,
        post: f64::INFINITY,
        dev: None,
        symmetric: true,
        point: [None; 3],
        passes_point: false,
    };
    let deviation = |value_mm: f64| {
        // written so that NaN is refused
        if value_mm >= SMALLEST_MM {
            Ok(value_mm)
        } else {
            Err(NoContour::DeviationTooSmall { value_mm, least_mm: SMALLEST_MM })
        }
    };
    let distance = |value_mm: f64, least_mm: f64| {
        if value_mm >= least_mm {
            Ok(value_mm)
        } else {
            Err(NoContour::DistanceTooSmall { value_mm, least_mm })
        }
    };
    let within = |dev: f64, dist: f64| Bounds { pre: dist, post: dist, dev: Some(dev), ..free };
    match settings.mode {
        ContourMode::Dev { path_dev_mm } => {
            Ok(Bounds { dev: Some(deviation(path_dev_mm)?), ..free })
        }
        ContourMode::Dist { pre_mm, post_mm } => {
            let (pre, post) = (distance(pre_mm, SMALLEST_MM)?, distance(post_mm, SMALLEST_MM)?);
            Ok(Bounds { pre, post, symmetric: pre.to_bits() == post.to_bits(), ..free })
        }
        ContourMode::Pos { pre_mm, post_mm, point_mm } => {
            let (pre, post) = (distance(pre_mm, 0.0)?, distance(post_mm, 0.0)?);
            Ok(Bounds { pre, post, symmetric: false, point: point_mm, passes_point: true, ..free })
        }
        ContourMode::Ptp { path_dev_mm, path_dist_mm } => {
            Ok(within(deviation(path_dev_mm)?, distance(path_dist_mm, SMALLEST_MM)?))
        }
        ContourMode::DistSoft { path_dist_mm } | ContourMode::DistMaster { path_dist_mm } => {
            let dist = if path_dist_mm < 0.0 {
                f64::INFINITY
            } else {
                distance(path_dist_mm, SMALLEST_MM)?
            };
            Ok(within(1.0, dist))
        }
    }
}

/// The two blocks at a corner.
struct Corner<'a> {
    from: &'a Path,
    to: &'a Path,
    skipped: &'a [Block],
    /// Axes over which lengths are measured.
    measured: Vec<bool>,
    /// Only one of the blocks moves measured axes.
    mixed: bool,
    /// Largest change of direction of an axis.
    jump: f64,
    angle_rad: f64,
    /// Largest corner distances of both blocks.
    longest: (f64, f64),
    /// Largest deviation of the axes outside the feed group.
    track_dev: Option<f64>,
}

impl<'a> Corner<'a> {
    fn new(
        from: &'a Block,
        skipped: &'a [Block],
        to: &'a Block,
        settings: &ContourSettings,
    ) -> Self {
        let n = from.path.start().len();
        let (mut a, mut b) = (AxisVec::zeros(n), AxisVec::zeros(n));
        from.path.tangent(from.path.length(), &mut a);
        to.path.tangent(0.0, &mut b);
        let feed: Vec<bool> = (0..n).map(|i| is_feed(from, i)).collect();
        let square = |v: &[f64], mask: &[bool]| -> f64 {
            v.iter().zip(mask).filter(|(_, m)| **m).map(|(c, _)| c * c).sum()
        };
        let moves = [square(&a, &feed) > 0.0, square(&b, &feed) > 0.0];
        let mixed = moves[0] != moves[1];
        let measured = if moves[0] { feed } else { vec![true; n] };
        let jumps: Vec<f64> = (0..n).map(|i| b[i] - a[i]).collect();
        let sum: Vec<f64> = (0..n).map(|i| b[i] + a[i]).collect();
        let half = libm::atan2(square(&jumps, &measured).sqrt(), square(&sum, &measured).sqrt());
        Self {
            from: &from.path,
            to: &to.path,
            skipped,
            mixed,
            jump: jumps.iter().fold(0.0, |m: f64, j| m.max(j.abs())),
            angle_rad: 2.0 * half,
            longest: (longest(&from.path, settings), longest(&to.path, settings)),
            track_dev: (settings.track_dev_deg > 0.0).then_some(settings.track_dev_deg),
            measured,
        }
    }

    fn distance(&self, p: &[f64], q: &[f64]) -> f64 {
        let d2 = |((p, q), _): ((&f64, &f64), &bool)| (p - q) * (p - q);
        p.iter().zip(q).zip(&self.measured).filter(|(_, m)| **m).map(d2).sum::<f64>().sqrt()
    }

    /// The largest curve within the bounds.
    fn fit(&self, bounds: Bounds) -> Option<Curve> {
        let mut pre = bounds.pre.min(self.longest.0);
        let mut post = bounds.post.min(self.longest.1);
        if bounds.symmetric {
            (pre, post) = (pre.min(post), pre.min(post));
        }
        if bounds.passes_point {
            return self.through_point(pre, post, &bounds.point);
        }
        if let Some(dev) = bounds.dev.filter(|_| self.is_plain()) {
            // eps = 3/8 d sin(theta / 2)
            let d = 8.0 * dev / (3.0 * libm::sin(0.5 * self.angle_rad));
            (pre, post) = (pre.min(d), post.min(d));
        }
        let try_at = |ratio: f64| {
            let (pre, post) = (pre * ratio, post * ratio);
            let curve = self.at(pre, post);
            self.keeps(&curve, bounds.dev).then_some(curve)
        };
        let mut best = try_at(1.0);
        if best.is_none() {
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..50 {
                let mid = 0.5 * (low + high);
                if let Some(curve) = try_at(mid) {
                    low = mid;
                    best = Some(curve);
                } else {
                    high = mid;
                }
            }
        }
        best.filter(|c| c.pre_mm >= SMALLEST_MM && c.post_mm >= SMALLEST_MM)
    }

    /// Two lines that meet.
    fn is_plain(&self) -> bool {
        self.skipped.is_empty() && self.from.is_straight() && self.to.is_straight()
    }

    fn at(&self, pre: f64, post: f64) -> Curve {
        let a = End::of(self.from, self.from.length() - pre);
        let b = End::of(self.to, post);
        // blocks that are bridged belong to both halves alike
        let bridged = 0.5 * self.skipped.iter().map(|b| b.path.length()).sum::<f64>();
        let blend = Blend::new(&a, &b, pre + bridged, post + bridged, |_| None);
        Curve { blend, pre_mm: pre, post_mm: post }
    }

    fn through_point(&self, pre: f64, post: f64, point: &[Option<f64>; 3]) -> Option<Curve> {
        let a = End::of(self.from, self.from.length() - pre);
        let b = End::of(self.to, post);
        let corner = self.from.end();
        let interim = |i: usize| (i < 3).then(|| point[i].unwrap_or(corner[i]));
        let middle: AxisVec = (0..corner.len()).map(|i| interim(i).unwrap_or(corner[i])).collect();
        let (to, behind) = (self.distance(&a.point, &middle), self.distance(&middle, &b.point));
        if to <= 0.0 || behind <= 0.0 {
            return None;
        }
        let blend = Blend::new(&a, &b, to, behind, interim);
        Some(Curve { blend, pre_mm: pre, post_mm: post })
    }

    /// True if a curve keeps the deviations.
    fn keeps(&self, curve: &Curve, dev: Option<f64>) -> bool {
        const SLACK: f64 = 1.0 + 1e-12;
        let interim = curve.blend.interim();
        if let Some(track) = self.track_dev {
            let corner = self.from.end();
            let off = |i: usize| (interim[i] - corner[i]).abs() > track * SLACK;
            if (0..corner.len()).any(|i| !self.measured[i] && off(i)) {
                return false;
            }
        }
        let Some(dev) = dev else { return true };
        if self.skipped.is_empty() && self.distance(&interim, self.from.end()) > dev * SLACK {
            return false;
        }
        if self.is_plain() {
            return true;
        }
        // the corners that are cut, from the curve; and the curve, from the contour
        let samples: Vec<AxisVec> = curve
            .blend
            .halves
            .iter()
            .flat_map(|half| (0..=16).map(|k| blend::point(half, f64::from(k) / 16.0)))
            .collect();
        let near =
            |p: &[f64]| samples.iter().map(|q| self.distance(p, q)).fold(f64::INFINITY, f64::min);
        let cut = !self.skipped.is_empty()
            && (self.skipped.iter().map(|b| b.path.end()).chain([self.from.end()]))
                .any(|p| near(p) > dev * SLACK);
        let strays = samples.iter().any(|p| {
            let paths =
                [self.from, self.to].into_iter().chain(self.skipped.iter().map(|b| &b.path));
            paths
                .map(|path| {
                    let mut q = AxisVec::zeros(p.len());
                    path.position(path.nearest(p), &mut q);
                    self.distance(p, &q)
                })
                .fold(f64::INFINITY, f64::min)
                > dev * SLACK
        });
        !cut && !strays
    }
}
