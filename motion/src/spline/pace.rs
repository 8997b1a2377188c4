//! Divides the spline over an edge where one part has to be much slower than another: a block has one velocity limit,
//! and the sharpest bend would determine it for the whole edge.

use super::edge::Curve;
use crate::axis::AxisVec;
use crate::block::{Block, Feed};
use crate::cap::SpeedLimit;
use crate::limits::{PathExtremes, PathSpeeds};
use crate::path::piece::{self, section};
use crate::path::{Path, PolyPath, PolyPiece};
use kontur_filters::time::CycleTime;

/// Largest number of divisions of a piece by three: wherever a sharp bend is, one of the thirds is free of it.
const DEEPEST: u32 = 5;
/// Share of its time that a piece has to save to be divided. A saving of one cycle divides it in any case: a tenth of a long edge
/// matters, and a larger tolerance would cost that time.
const GAIN: f64 = 0.1;

/// A part of the spline with its shortest time in s.
struct Part {
    piece: PolyPiece,
    length: f64,
    time_s: f64,
    /// Whether it is limited by the programmed speed only.
    at_feed: bool,
}

impl Part {
    fn new(block: &Block, piece: PolyPiece) -> Option<Self> {
        let path = PolyPath::through(vec![piece.clone()], &block.dynamics.feed_axes)?;
        let block = Block { path: Path::Curve(Box::new(path)), ..block.clone() };
        let speeds = PathSpeeds::of(&block, &PathExtremes::of(&block.path));
        let length = block.path.length();
        let cap = speeds.limited(speeds.programmed_mm_s);
        let (time_s, at_feed) = (length / cap.v_mm_s, cap.why != SpeedLimit::Curve);
        Some(Self { piece, length, time_s, at_feed })
    }
}

/// The curves of a part of an edge between two points, each with its speed: groups of pieces of nearly equal speed.
pub(super) fn curves(
    block: &Block,
    pieces: Vec<PolyPiece>,
    [mut start, end]: [AxisVec; 2],
    cycle: CycleTime,
) -> Vec<Curve> {
    let mut groups = groups(block, pieces, cycle).into_iter();
    let mut out = Vec::with_capacity(groups.len());
    while let Some((pieces, v_mm_s)) = groups.next() {
        let inner = pieces.last().filter(|_| groups.len() > 0);
        let here = inner.map_or_else(|| end.clone(), |last| piece::point(last, 1.0));
        let from = std::mem::replace(&mut start, here.clone());
        let path = PolyPath::new(from, here, pieces, &block.dynamics.feed_axes);
        out.extend(path.map(|path| Curve { path, v_mm_s, part: 0 }));
    }
    out
}

/// The pieces of an edge in groups of nearly equal speed, each with its speed in mm/s.
fn groups(block: &Block, pieces: Vec<PolyPiece>, cycle: CycleTime) -> Vec<(Vec<PolyPiece>, f64)> {
    // a programmed duration means a constant speed over the whole edge
    let feed = match block.feed {
        Feed::Duration(t) => Feed::PathVelocity(block.path.length() / t),
        feed => feed,
    };
    let block = Block { feed, ..block.clone() };
    let mut parts = Vec::new();
    for piece in pieces {
        if let Some(part) = Part::new(&block, piece) {
            cut(&block, part, (0, cycle), &mut parts);
        }
    }
    let mut out: Vec<(Vec<PolyPiece>, f64)> = Vec::new();
    // of the present group: its length in mm, the time of its parts, and the time per mm of its slowest part
    let (mut length, mut time_s, mut pace) = (0.0, 0.0, 0.0);
    for part in parts {
        let own = part.time_s / part.length;
        let (long, apart_s, slowest) = (length + part.length, time_s + part.time_s, own.max(pace));
        match out.last_mut() {
            Some((group, v)) if !gains(apart_s, long * slowest, cycle) => {
                group.push(part.piece);
                *v = slowest.recip();
                (length, time_s, pace) = (long, apart_s, slowest);
            }
            _ => {
                out.push((vec![part.piece], own.recip()));
                (length, time_s, pace) = (part.length, part.time_s, own);
            }
        }
    }
    out
}

/// Whether parts that take `apart_s` should not share the speed with which they take `together_s`.
fn gains(apart_s: f64, together_s: f64, cycle: CycleTime) -> bool {
    apart_s < (1.0 - GAIN) * together_s || apart_s < together_s - cycle.seconds()
}

/// Divides a part as long as that saves time.
fn cut(block: &Block, part: Part, (depth, cycle): (u32, CycleTime), out: &mut Vec<Part>) {
    let third = |k: u32| {
        let at = |k: u32| f64::from(k) / 3.0;
        Part::new(block, part.piece.iter().map(|c| section(c, at(k), at(k + 1))).collect())
    };
    let may_gain = depth < DEEPEST && !part.at_feed;
    let thirds: Option<Vec<Part>> = if may_gain { (0..3).map(third).collect() } else { None };
    match thirds {
        Some(thirds) if gains(thirds.iter().map(|t| t.time_s).sum(), part.time_s, cycle) => {
            for third in thirds {
                cut(block, third, (depth + 1, cycle), out);
            }
        }
        _ => out.push(part),
    }
}
