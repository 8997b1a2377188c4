//! The lower of rise and fall with constant jerk, with a connection where one changes to the other.
//!
//! Apart from their cuts the rise never gets slower and the fall never faster, so they cross once between two points at
//! which both are cut. The rise is left before the crossing: from there the acceleration falls with the jerk of the
//! blocks until velocity and acceleration are those of the fall. The later the rise is left, the closer this connection
//! gets to the fall; the last possible moment is found by bisection. A fall within the limits brakes harder than such a
//! connection everywhere, so the connection is within the limits too. Where both hold the same speed, at a limit, there
//! is nothing to connect.

use super::Block;
use crate::profile::FLAT_MM_S2;
use crate::profile::roots::enclosed_root;
use crate::profile::{Phase, RampShape};
use std::cell::Cell;

/// Relative difference of speeds that counts as rounding.
const SAME: f64 = 1e-8;
/// Relative difference of two speeds that hold the same limit.
const EQUAL: f64 = 1e-12;
/// Relative gap that a connection may leave where it meets the fall.
const MISS: f64 = 1e-7;
/// Speed in mm/s that is used as the reference of a gap below it: where the fall comes to rest its speed may be
/// rounding.
const LEAST_MM_S: f64 = 1e-4;
/// Bisection steps for the moment at which the rise is left.
const ROUNDS: u32 = 50;
/// Accuracy of the moment at which both are closest, relative to the piece.
const MOMENT: f64 = 1e-12;

/// A rise and a fall over the same blocks.
pub(super) struct Meet<'a> {
    pub(super) cells: &'a [Block],
    pub(super) rise: &'a [Phase],
    pub(super) fall: &'a [Phase],
    /// Speed at the end.
    pub(super) v1: f64,
    pub(super) known: &'a Known,
}

/// The part of a fall that is known.
#[derive(Debug)]
pub(super) struct Known {
    /// Path length in mm behind which it lies.
    from: f64,
    /// Whether a connection was to begin before.
    is_left: Cell<bool>,
}

impl Known {
    /// All of it.
    pub(super) fn whole() -> Self {
        Self::behind(f64::NEG_INFINITY)
    }

    /// What lies behind a path length in mm.
    pub(super) fn behind(from: f64) -> Self {
        Self { from, is_left: Cell::new(false) }
    }

    /// Whether a connection was to begin before the known part, so that what was found without it is void.
    pub(super) fn is_left(&self) -> bool {
        self.is_left.get()
    }

    /// Whether the known part contains the place where a connection begins.
    fn contains(&self, s: f64) -> bool {
        let inside = s > self.from;
        self.is_left.set(self.is_left() || !inside);
        inside
    }
}

/// Where a connection ends: phase of the fall and time in it.
#[derive(Clone, Copy, Debug)]
struct Joint {
    phase: usize,
    time: f64,
    gap: f64,
}

/// A connection compared with the fall at one point.
#[derive(Clone, Copy, Debug)]
struct Beside {
    /// State of the connection.
    there: Phase,
    /// Difference of the slopes over the path, positive while the connection approaches the fall.
    closing: f64,
    /// The corresponding point of the fall.
    joint: Joint,
}

/// A connection that stays below the fall.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// Where it meets the fall; `None`: nowhere.
    joint: Option<Joint>,
    /// Whether it has no phase with a duration.
    is_empty: bool,
}

impl Meet<'_> {
    /// The speed along rise and fall; `None` if no connection fits.
    pub(super) fn speed(&self) -> Option<Vec<Phase>> {
        let mut out: Vec<Phase> = Vec::with_capacity(self.rise.len());
        // phases of rise and fall reached, and number of phases output up to the last common cut
        let (mut r, mut base) = (0, 0);
        let mut follow = Follow::new(self.cells, self.fall);
        loop {
            let Some(next) = self.rise.get(r) else {
                // the rise alone
                let end = out.last()?.end();
                return (end.v >= self.v1 * (1.0 - MISS)).then_some(out);
            };
            let end = next.end();
            // at the end the acceleration has to be zero
            let overshoots = r + 1 == self.rise.len() && end.a > FLAT_MM_S2;
            if !follow.is_below(&end) && !overshoots {
                out.push(*next);
                r += 1;
                continue;
            }
            out.push(*next);
            let joint = self.connect(&mut out, base)?;
            // follow the fall until it is cut
            let entered = &self.fall[joint.phase];
            if joint.time < entered.t {
                out.push(entered.rest(joint.time));
            }
            let mut behind = joint.phase + 1..self.fall.len();
            let cut = behind.find(|k| is_cut(self.fall, *k)).unwrap_or(self.fall.len());
            out.extend_from_slice(&self.fall[joint.phase + 1..cut]);
            if cut == self.fall.len() {
                return Some(out);
            }
            let at = self.fall[cut].s;
            r = self.rise.partition_point(|p| p.s < at - follow.same);
            (base, follow.phase) = (out.len(), cut);
            // both have to be cut there
            let (end, next) = (out.last()?.end(), self.rise.get(r)?);
            if (next.v - end.v).abs() > MISS * end.v + 1e-9 || next.a > FLAT_MM_S2 {
                return None;
            }
        }
    }

    /// Replaces the end of the output, after `base`, by a connection to the fall.
    fn connect(&self, out: &mut Vec<Phase>, base: usize) -> Option<Joint> {
        // the last phase from whose start a connection stays below the fall
        let (mut k, mut stride) = (out.len() - 1, 1);
        let mut late = out.len();
        let search = |from: &Phase| self.way(from, |_| ());
        let mut best = loop {
            if let Some(way) = search(&out[k]) {
                break way;
            }
            if k == base {
                return None;
            }
            late = k;
            k = k.saturating_sub(stride).max(base);
            stride *= 2;
        };
        while late - k > 1 {
            let mid = usize::midpoint(late, k);
            match search(&out[mid]) {
                Some(way) => (k, best) = (mid, way),
                None => late = mid,
            }
        }
        let left = out[k];
        let (mut low, mut high) = (0.0, left.t);
        if let Some(joint) = best.joint.filter(|j| best.is_empty && j.gap.abs() <= EQUAL)
            && holds(&left)
            && holds(&self.fall[joint.phase])
        {
            out.truncate(k);
            return Some(joint);
        }
        for _ in 0..ROUNDS {
            let mid = 0.5 * (low + high);
            match search(&left.after(mid)) {
                Some(way) => (low, best) = (mid, way),
                None => high = mid,
            }
            if best.joint.is_some_and(|j| j.gap <= 0.0) && high - low <= 1e-12 * left.t {
                break;
            }
        }
        let joint = best.joint.filter(|j| j.gap <= MISS)?;
        out.truncate(k);
        let from = if low > 0.0 {
            out.push(left.until(low));
            left.after(low)
        } else {
            left
        };
        self.way(&from, |phase| out.push(phase))?;
        Some(joint)
    }

    /// The connection from a state, whose phases `take` receives; `None` if it crosses the fall.
    fn way(&self, from: &Phase, mut take: impl FnMut(Phase)) -> Option<Way> {
        #[cfg(test)]
        crate::closed_forms::add();
        if !self.known.contains(from.s) {
            return None;
        }
        let mut is_empty = true;
        let mut at = Phase::state(from.s, from.v, from.a);
        let same = same_mm(self.cells);
        let mut c = self.cells.partition_point(|b| b.end <= at.s + same);
        let mut f = self.fall.partition_point(|p| p.s <= at.s + same).max(1) - 1;
        // whether the fall brakes more, as known from the previous piece
        let mut nears = None;
        loop {
            let (Some(cell), Some(fall)) = (self.cells.get(c), self.fall.get(f)) else {
                return Some(Way { joint: None, is_empty });
            };
            let jerk = if at.a > 0.0 { cell.jerks[1] } else { cell.jerks[2] };
            // until the acceleration is zero, or to rest
            let t = if at.a > 0.0 {
                at.a / jerk
            } else {
                (at.a + (at.a * at.a + 2.0 * jerk * at.v).sqrt()) / jerk
            };
            let piece = at.ramp(RampShape::Trapez, -jerk, t);
            let fall_end = fall.end().s;
            let stop = cell.end.min(fall_end);
            let whole = piece.end().s <= stop;
            let t = if whole { t } else { piece.time_at(stop) };
            let piece = piece.until(t);
            let start = nears.unwrap_or_else(|| self.compare(&piece, 0.0, f));
            let end = self.compare(&piece, t, f);
            if let Some((time, joint)) = self.lowest(&piece, f, &start, &end) {
                if joint.gap < -SAME {
                    return None;
                }
                take(piece.until(time));
                return Some(Way { joint: Some(joint), is_empty: is_empty && time == 0.0 });
            }
            if end.joint.gap < -SAME {
                return None;
            }
            let there = end.there;
            if there.v <= 0.0 {
                return Some(Way { joint: None, is_empty });
            }
            take(piece);
            is_empty &= piece.t == 0.0;
            if there.s >= cell.end - same {
                c += 1;
            }
            nears = Some(end);
            if there.s >= fall_end - same {
                f += 1;
                // the fall may be cut here
                nears = None;
            }
            at = Phase::state(there.s, there.v, if whole && at.a > 0.0 { 0.0 } else { there.a });
        }
    }

    /// The connection `t` s after the start of a piece, compared with phase `f` of the fall.
    fn compare(&self, piece: &Phase, t: f64, f: usize) -> Beside {
        let here = piece.after(t);
        let fall = &self.fall[f];
        let time = fall.time_at(here.s);
        let on_fall = fall.after(time);
        let closing = here.a * on_fall.v - on_fall.a * here.v;
        let gap = (on_fall.v - here.v) / on_fall.v.max(LEAST_MM_S);
        Beside { there: here, closing, joint: Joint { phase: f, time, gap } }
    }

    /// Time in a piece of a connection at which the fall begins to brake less, where the two are closest.
    fn lowest(
        &self,
        piece: &Phase,
        f: usize,
        start: &Beside,
        end: &Beside,
    ) -> Option<(f64, Joint)> {
        if start.closing <= 0.0 {
            return Some((0.0, start.joint));
        }
        if end.closing > 0.0 {
            return None;
        }
        let closing = |t| self.compare(piece, t, f).closing;
        let (_, t) = enclosed_root((0.0, start.closing), (piece.t, end.closing), MOMENT, closing);
        Some((t, self.compare(piece, t, f).joint))
    }
}

/// A fall, followed forwards.
pub(super) struct Follow<'a> {
    fall: &'a [Phase],
    /// The phase reached.
    phase: usize,
    /// Distance in mm up to which two points count as the same.
    same: f64,
    /// Where it is cut last.
    last_cut: f64,
}

impl<'a> Follow<'a> {
    pub(super) fn new(cells: &[Block], fall: &'a [Phase]) -> Self {
        let last_cut = (1..fall.len()).rev().find(|k| is_cut(fall, *k));
        let last_cut = last_cut.map_or(f64::NEG_INFINITY, |k| fall[k].s);
        Self { fall, phase: 0, same: same_mm(cells), last_cut }
    }

    /// Whether the fall is below a state, which must not be before the last one.
    fn is_below(&mut self, at: &Phase) -> bool {
        while self.phase + 1 < self.fall.len() && self.fall[self.phase].end().s < at.s - self.same {
            self.phase += 1;
        }
        let on_fall = &self.fall[self.phase];
        let v = if holds(on_fall) { on_fall.v } else { on_fall.after(on_fall.time_at(at.s)).v };
        at.v > v * (1.0 + SAME)
    }

    /// Whether the fall is below the end of this phase of the rise, and not cut any more, so that nobody needs the rise
    /// behind it.
    pub(super) fn has_crossed_for_good(&mut self, phase: &Phase) -> bool {
        self.last_cut < phase.s - 2.0 * self.same && self.is_below(&phase.end())
    }
}

/// Whether the speed of a fall jumps at the start of phase `k`, to a limit that is higher from there on.
fn is_cut(fall: &[Phase], k: usize) -> bool {
    fall[k].v > fall[k - 1].end().v * (1.0 + MISS) + 1e-12
}

/// Distance in mm up to which two points of a stretch count as the same.
fn same_mm(cells: &[Block]) -> f64 {
    1e-13 * cells.last().map_or(0.0, |c| c.end)
}

/// Whether a phase holds its speed.
fn holds(phase: &Phase) -> bool {
    phase.a == 0.0 && phase.j == 0.0
}
