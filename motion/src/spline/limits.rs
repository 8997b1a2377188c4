//! Where blocks end: at the point of the spline that is nearest to the programmed one.
//!
//! At its knot the spline is not there if the edges differ in length. On a straight line with the intervals `g h | k l`
//! around the knot it is ahead of it by `h k / (h + k) (h / (h + k + l) - k / (g + h + k))`, which on a short edge
//! before a long one is most of the short edge; the feed rate, and everything else that changes with the block, would
//! change there. The limit therefore moves along the spline, onto one of the edges next to it. Blocks whose points are
//! passed over follow it with their lengths. Nothing else depends on it: the corners are judged ([`super::worth`]) with
//! the limits at their knots, and a programmed duration is shared among the parts of its block with their lengths there.
//!
//! At a corner with control points of its own and at a sharp one the limit is at its point in any case; in a fit it is where the
//! parameter is that of the point.

use super::edge::{Curve, Part};
use super::pace;
use crate::axis::AxisVec;
use crate::block::{Block, Feed};
use crate::path::{Path, PolyPath, PolyPiece, piece};
use kontur_filters::time::CycleTime;

/// Smallest distance in mm along the spline by which a limit moves.
const LEAST_MM: f64 = 1e-3;
/// Largest share of what is left of an edge for the blocks whose points are passed over.
const PASSED: f64 = 0.5;

/// The part of the spline that belongs to a part of a block.
#[derive(Debug)]
pub(super) struct Stretch {
    part: Part,
    curves: Vec<Curve>,
}

impl Stretch {
    /// The stretches over an edge: its parts with their curves.
    pub(super) fn over(parts: impl IntoIterator<Item = Part>, curves: Vec<Curve>) -> Vec<Self> {
        let mut curves = curves.into_iter().peekable();
        let own = |(k, part): (usize, Part)| {
            let curves = std::iter::from_fn(|| curves.next_if(|curve| curve.part == k)).collect();
            Self { part, curves }
        };
        parts.into_iter().enumerate().map(own).collect()
    }

    /// The blocks along it.
    pub(super) fn put_out(self, out: &mut Vec<Block>) {
        let whole = self.length_mm();
        let Self { part: Part { block, share, last, .. }, curves } = self;
        let count = curves.len();
        for (i, curve) in curves.into_iter().enumerate() {
            let mut block = block.clone();
            if let Feed::Duration(t) = block.feed {
                let length = curve.path.length() / whole;
                block.feed = Feed::Duration(t * share * length);
            }
            if i + 1 < count || !last {
                (block.end_velocity_mm_s, block.contour) = (None, None);
            }
            block.path = Path::Curve(Box::new(curve.path));
            out.push(block);
        }
    }

    fn length_mm(&self) -> f64 {
        self.curves.iter().map(|curve| curve.path.length()).sum()
    }

    fn ends(&self) -> Option<[&AxisVec; 2]> {
        Some([self.curves.first()?.path.start(), self.curves.last()?.path.end()])
    }

    fn pieces(&self) -> impl Iterator<Item = &PolyPiece> {
        self.curves.iter().flat_map(|curve| curve.path.pieces())
    }
}

/// Moves the limit between a block and the first of the next edge, of which the length in mm is given, from the knot to
/// the point of both that is nearest to `point`. Where that would leave nothing of either it stays.
pub(super) fn settle(
    before: &mut Stretch,
    after: &mut [Stretch],
    (point, edge_mm): (&[f64], f64),
    cycle: CycleTime,
) {
    // blocks before the one that reaches far end at points that are passed over
    let reaching = after.iter().position(|stretch| stretch.part.until >= 0.5);
    let Some(after) = reaching.and_then(|main| after.get_mut(..=main)) else { return };
    let pieces: Vec<PolyPiece> =
        before.pieces().chain(after.iter().flat_map(Stretch::pieces)).cloned().collect();
    let feed_axes = before.part.block.dynamics.feed_axes.clone();
    let is_feed = |i: &usize| feed_axes.get(*i).copied().unwrap_or(true);
    let of_feed = |piece: &PolyPiece| {
        piece.iter().enumerate().filter(|(i, _)| is_feed(i)).map(|(_, c)| *c).collect()
    };
    let ends = before.ends().zip(after.last().and_then(Stretch::ends));
    let Some(([start, _], [_, end])) = ends else { return };
    let (mut start, end) = (start.clone(), end.clone());
    let Some(feed) = PolyPath::through(pieces.iter().map(of_feed).collect(), &[]) else { return };
    let point: Vec<f64> = (0..point.len()).filter(is_feed).map(|i| point[i]).collect();
    let limit_mm = feed.nearest(&point);
    let left_mm = feed.length() - limit_mm;
    let moved_mm = (limit_mm - before.length_mm()).abs();
    if moved_mm < LEAST_MM || limit_mm < LEAST_MM || left_mm < LEAST_MM {
        return;
    }
    let untils = after.iter().map(|stretch| stretch.part.until * edge_mm);
    let passed_mm: Vec<f64> = untils.take(after.len() - 1).collect();
    let scale = passed_mm.last().map_or(1.0, |last| (PASSED * left_mm / last).min(1.0));
    let limits = passed_mm.iter().map(|until| limit_mm + scale * until);
    let cuts = std::iter::once(limit_mm).chain(limits).map(|s| feed.locate(s));
    let mut parts = piece::divided(pieces, cuts).into_iter().peekable();
    for stretch in std::iter::once(before).chain(after) {
        let Some(pieces) = parts.next() else { return };
        // a block shorter than rounding has none
        let Some(last) = pieces.last() else {
            stretch.curves.clear();
            continue;
        };
        let to = if parts.peek().is_some() { piece::point(last, 1.0) } else { end.clone() };
        let from = std::mem::replace(&mut start, to.clone());
        stretch.curves = pace::curves(&stretch.part.block, pieces, [from, to], cycle);
    }
}
