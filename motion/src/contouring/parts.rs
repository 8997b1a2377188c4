//! The curve at a corner as blocks, each with the speed that its bend permits.

use super::rounding::Curve;
use super::{Contouring, ROUNDING, speed};
use crate::block::{
    Block, BlockLimit, ChannelDynamics, ContourSettings, CurveJerk, Feed, SlopeKind,
};
use crate::limits::{PathExtremes, PathSpeeds};
use crate::path::piece::section;
use crate::path::{Path, PolyPath, PolyPiece};
use std::sync::Arc;

/// Pieces per half of the curve, each with its own speed (unless `CONST_VEL` is set).
const PARTS: u32 = 4;
/// Relative gain of speed in a half of a piece from which on the piece is divided: a block has one speed, that of its
/// sharpest bend. Assumption: 4 % is worth two more blocks.
const GAIN: f64 = 0.04;
/// Number of times that a piece may be halved.
const DIVISIONS: u32 = 2;

/// Blocks, each with its speed in mm/s.
pub(super) type Parts = Vec<(Block, f64)>;

impl Contouring {
    /// The blocks of a curve. Each part has the limits of the block that it belongs to and its feed rate, unless the speed in the
    /// curve is to be constant.
    ///
    /// Assumption: the documents do not mention different feed rates or limits; they change where the block ends. A constant
    /// speed is that of the slower feed rate, within the limits of both.
    pub(super) fn parts(
        &mut self,
        from: &Block,
        to: &Block,
        curve: &Curve,
        settings: &ContourSettings,
    ) -> Parts {
        let dev = [from, to].iter().filter_map(|b| b.tolerance.ax_dev_mm).min_by(f64::total_cmp);
        let limits = limits(from, to, settings.constant_velocity);
        let mut half = |of: &Block, limits: Arc<ChannelDynamics>| {
            let mut half = Block { seq: of.seq, contour: None, ..from.clone() };
            half.tolerance.ax_dev_mm = dev;
            half.full_override = of.full_override;
            half.dynamics = match settings.curve_jerk {
                Some(check) => self.with_check(&limits, check),
                None => limits,
            };
            (half.feed, half.feed_ratio) = feed(of, from, to, settings);
            half
        };
        let [before, after] = limits;
        let halves = [half(from, before), half(to, after)];
        let parts = if settings.constant_velocity { 1 } else { PARTS };
        let feed_axes = from.dynamics.feed_axes.clone();
        let limit = match settings.limit {
            BlockLimit::Before => 0,
            BlockLimit::Within if !settings.constant_velocity => parts,
            // one block, so that both halves have one speed
            BlockLimit::Within | BlockLimit::After => 2 * parts,
        };
        let timed = |piece: PolyPiece, i: u32| {
            let path = Path::Curve(Box::new(PolyPath::through(vec![piece.clone()], &feed_axes)?));
            let block = Block { path, ..halves[usize::from(i >= limit)].clone() };
            let speeds = PathSpeeds::of(&block, &PathExtremes::of(&block.path));
            let v = speeds.limited(speeds.programmed_mm_s).v_mm_s;
            let is_limited = v < speeds.programmed_mm_s * (1.0 - ROUNDING);
            Some(Timed { piece, block, v, is_limited })
        };
        // where the acceleration is zero at every boundary, and with the ramps of SIN2, shorter blocks are not faster;
        // under AX_DEV the planner divides what bends unevenly, and more blocks only take it longer
        let gains = |b: &Block| b.slope.plans_across() && b.slope.kind != SlopeKind::Sin2;
        let divided = !settings.constant_velocity && dev.is_none() && gains(from) && gains(to);
        let divisions = if divided { DIVISIONS } else { 0 };
        let mut pieces = Vec::new();
        for (i, piece) in (0..).zip(curve.blend.pieces(parts)) {
            if let Some(whole) = timed(piece, i) {
                divide(whole, divisions, &|piece| timed(piece, i), &mut pieces);
            }
        }
        joined(&pieces, &feed_axes, settings.constant_velocity)
    }

    /// The dynamics with another jerk check; those made last are kept, because most corners share theirs.
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

/// A piece of a curve as a block.
struct Timed {
    piece: PolyPiece,
    block: Block,
    /// Highest speed in mm/s.
    v: f64,
    /// Whether the curve is slower than the feed rate.
    is_limited: bool,
}

/// Outputs a piece, or its parts where its bend limits the speed of one part less than that of the other: up to
/// `divisions` halvings. `timed` makes a block of a part.
fn divide(
    whole: Timed,
    divisions: u32,
    timed: &impl Fn(PolyPiece) -> Option<Timed>,
    out: &mut Vec<Timed>,
) {
    let half =
        |from: f64| timed(whole.piece.iter().map(|c| section(c, from, from + 0.5)).collect());
    let halves = (divisions > 0 && whole.is_limited).then(|| half(0.0).zip(half(0.5))).flatten();
    match halves.filter(|(a, b)| a.v.max(b.v) > (1.0 + GAIN) * whole.v) {
        Some((first, second)) => {
            divide(first, divisions - 1, timed, out);
            divide(second, divisions - 1, timed, out);
        }
        None => out.push(whole),
    }
}

/// Limits of the two parts of a curve: those of its blocks, in the modes of the first one. With a constant velocity both have the
/// lower speeds.
fn limits(from: &Block, to: &Block, constant_velocity: bool) -> [Arc<ChannelDynamics>; 2] {
    let (a, b) = (&from.dynamics, &to.dynamics);
    if Arc::ptr_eq(a, b) || (a.axes == b.axes && a.vector == b.vector) {
        return [Arc::clone(a), Arc::clone(a)];
    }
    if !constant_velocity {
        let after =
            ChannelDynamics { axes: b.axes.clone(), vector: b.vector, ..ChannelDynamics::clone(a) };
        return [Arc::clone(a), Arc::new(after)];
    }
    let mut both = ChannelDynamics::clone(a);
    for (axis, other) in both.axes.iter_mut().zip(&b.axes) {
        axis.v_max_mm_s = axis.v_max_mm_s.min(other.v_max_mm_s);
    }
    both.vector.vel_mm_s =
        [a.vector.vel_mm_s, b.vector.vel_mm_s].into_iter().flatten().min_by(f64::total_cmp);
    let both = Arc::new(both);
    [Arc::clone(&both), both]
}

/// Feed and override ratio of the part of a curve that belongs to `of`, one of the blocks `from` and `to`.
fn feed(of: &Block, from: &Block, to: &Block, settings: &ContourSettings) -> (Feed, f64) {
    let constant = settings.constant_velocity.then(|| slower(from, to));
    // the end of the block lies inside the curve
    match (from.end_velocity_mm_s, constant.unwrap_or_else(|| (speed(of), of.feed_ratio))) {
        (Some(e), (Feed::PathVelocity(v), ratio)) => (Feed::PathVelocity(v.min(e)), ratio),
        (_, feed) => feed,
    }
}

/// The pieces as blocks with their speeds in mm/s: neighbours with the same feed rate and the same permitted speed are one
/// block, under a constant velocity also those with different speeds.
fn joined(pieces: &[Timed], feed_axes: &[bool], constant_velocity: bool) -> Parts {
    let groups = pieces.chunk_by(|one, next| {
        let same = constant_velocity || (next.v - one.v).abs() <= 1e-9 * one.v;
        let (a, b) = (&one.block, &next.block);
        same && (a.seq, a.feed, a.feed_ratio, a.full_override)
            == (b.seq, b.feed, b.feed_ratio, b.full_override)
            && (Arc::ptr_eq(&a.dynamics, &b.dynamics) || a.dynamics == b.dynamics)
    });
    let joined = |group: &[Timed]| {
        if let [single] = group {
            return Some((single.block.clone(), single.v));
        }
        let pieces = group.iter().map(|timed| timed.piece.clone()).collect();
        let path = Path::Curve(Box::new(PolyPath::through(pieces, feed_axes)?));
        let slowest = group.iter().map(|timed| timed.v).fold(f64::INFINITY, f64::min);
        Some((Block { path, ..group.first()?.block.clone() }, slowest))
    };
    groups.filter_map(joined).collect()
}

/// The slower of the feeds of two blocks, with its ratio; a programmed feed counts as slower than rapid.
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
