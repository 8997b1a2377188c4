//! The largest permitted curve at one corner.

use super::blend::{Blend, End};
use super::{Held, NoContour, is_feed};
use crate::axis::AxisVec;
use crate::block::{Block, ContourMode, ContourSettings};
use crate::path::{Path, piece};
use std::f64::consts::{FRAC_PI_2, PI};

/// Least tolerance and least corner distance in mm: the resolution of the vendor's lengths.
const SMALLEST_MM: f64 = 1e-4;

/// A curve that fits.
pub(super) struct Curve {
    pub(super) blend: Blend,
    pub(super) pre_mm: f64,
    pub(super) post_mm: f64,
}

/// The lengths that bound the curve at one corner.
#[derive(Clone, Copy)]
struct Bounds {
    pre: f64,
    post: f64,
    /// Largest distance of the interim point from the corner in mm.
    dev: Option<f64>,
    /// Whether both distances stay equal when one of them is limited.
    symmetric: bool,
    point: [Option<f64>; 3],
    passes_point: bool,
}

/// A corner closer than this to a reversal, in rad, is kept. Assumption: the curvature of the curve, and that of a
/// spline at such a corner, grows with the square of the tangent of half the angle; the path would take seconds for
/// such a needle, the corner itself takes a few cycles.
pub(crate) const NEEDLE_RAD: f64 = 0.05;

/// Shortest corner distance in mm. Source: the example in the vendor's remarks on contouring, where 0.0007 mm of a
/// block of 0.0014 mm are too short (120216). Assumption: the limit is the next round number, 1 um.
const SHORTEST_MM: f64 = 0.001;

/// Largest corner distance of a block: half of what does not have to remain, on arcs at most a quarter turn (source:
/// TF5200, maximum corner distance).
fn longest(path: &Path, settings: &ContourSettings) -> f64 {
    let half = 0.5 * (1.0 - settings.remain_ratio.clamp(0.0, 1.0)) * path.length();
    match path {
        Path::Arc(arc) => half.min(path.length() * FRAC_PI_2 / arc.shape().sweep_rad.abs()),
        Path::Tilted(tilted) => {
            half.min(path.length() * FRAC_PI_2 / tilted.arc().shape().sweep_rad.abs())
        }
        _ => half,
    }
}

/// Change of direction up to which a transition counts as tangential: it is not contoured (TF5200 programming manual 475086859).
///
/// Assumption: the page prints no angle. The rounding of coordinates in steps of 0.00001 mm stays below it; a program that the
/// manual prints turns by 0.00001 rad and counts as a corner (15556713099).
const TANGENTIAL: f64 = 1e-6;

/// Whether a path continues another one in its direction, over all axes: such a transition is not contoured.
pub fn is_tangential(from: &Path, to: &Path) -> bool {
    let n = from.start().len();
    let (mut a, mut b) = (AxisVec::zeros(n), AxisVec::zeros(n));
    from.tangent(from.length(), &mut a);
    to.tangent(0.0, &mut b);
    a.iter().zip(b.iter()).all(|(a, b)| (b - a).abs() <= TANGENTIAL)
}

/// The curve at the corner between two blocks; `None` if there is no corner.
pub(super) fn curve(
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
    if skipped.is_empty() && corner.is_smooth() {
        return Ok(None);
    }
    if corner.angle_rad >= PI - NEEDLE_RAD {
        return Err(NoContour::NotPossible);
    }
    let angle_deg = corner.angle_rad.to_degrees();
    if angle_deg > settings.max_angle_deg {
        return Err(NoContour::AngleAboveMaximum { angle_deg });
    }
    let bounds = bounds(settings)?;
    let empty = bounds.passes_point && corner.keeps_the_contour(&bounds);
    if empty {
        return Ok(None);
    }
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
    let within = |dev: Option<f64>, dist: Option<f64>| {
        let dev = dev.map(deviation).transpose()?;
        let dist = match dist {
            Some(dist) if dist < 0.0 => f64::INFINITY,
            Some(dist) => distance(dist, SMALLEST_MM)?,
            None => f64::INFINITY,
        };
        Ok(Bounds { pre: dist, post: dist, dev, ..free })
    };
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
        ContourMode::Ptp { path_dev_mm, path_dist_mm } => within(path_dev_mm, path_dist_mm),
        ContourMode::DistSoft { path_dist_mm } | ContourMode::DistMaster { path_dist_mm } => {
            let unbounded = path_dist_mm < 0.0;
            within(unbounded.then_some(1.0), Some(path_dist_mm))
        }
    }
}

/// The two blocks at a corner.
struct Corner<'a> {
    from: &'a Path,
    to: &'a Path,
    skipped: &'a [Block],
    /// The axes over which lengths are measured.
    measured: Vec<bool>,
    /// Whether only one of the blocks moves measured axes.
    mixed: bool,
    /// Largest change of direction of any axis.
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

    /// Whether the transition is tangential in every axis or, without a limit for tracking axes, in the others (475086859).
    fn is_smooth(&self) -> bool {
        self.jump <= TANGENTIAL || (self.track_dev.is_none() && self.angle_rad <= TANGENTIAL)
    }

    fn distance(&self, p: &[f64], q: &[f64]) -> f64 {
        let d2 = |((p, q), _): ((&f64, &f64), &bool)| (p - q) * (p - q);
        p.iter().zip(q).zip(&self.measured).filter(|(_, m)| **m).map(d2).sum::<f64>().sqrt()
    }

    /// Whether the curve begins or ends at its interim point: a corner distance of 0 keeps the programmed contour
    /// (475227019).
    fn keeps_the_contour(&self, bounds: &Bounds) -> bool {
        let corner = self.from.end();
        let at_corner = (0..corner.len().min(3))
            .all(|i| bounds.point[i].is_none_or(|p| p.to_bits() == corner[i].to_bits()));
        at_corner && (bounds.pre <= 0.0 || bounds.post <= 0.0)
    }

    /// The largest curve within the bounds.
    fn fit(&self, bounds: Bounds) -> Option<Curve> {
        if self.longest.0.min(self.longest.1) < SHORTEST_MM {
            return None;
        }
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

    /// Whether two lines meet here directly.
    fn is_plain(&self) -> bool {
        self.skipped.is_empty() && self.from.is_straight() && self.to.is_straight()
    }

    fn at(&self, pre: f64, post: f64) -> Curve {
        let a = End::of(self.from, self.from.length() - pre);
        let b = End::of(self.to, post);
        // bridged blocks count towards both halves equally
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

    /// Whether a curve keeps the deviations.
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
        // the distance of the skipped corners from the curve, and of the curve from the contour
        let samples: Vec<AxisVec> = curve
            .blend
            .halves
            .iter()
            .flat_map(|half| (0..=16).map(|k| piece::point(half, f64::from(k) / 16.0)))
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
