//! Knots: the boundaries of a window at which the acceleration is zero.
//!
//! Only the marks are modified; the window is read.

use super::outline::{ALIKE, rates};
use super::stretch::Stretch;
use super::{Window, is_above};
use crate::cap::Cap;
use crate::ride::has_hill;

/// Relative difference of the path acceleration up to which blocks of a run are planned as one span with the smaller
/// value (Assumption: the direction of a CAM contour changes little from block to block, and the control does not
/// reduce its acceleration to zero there).
const NEARLY_EQUAL: f64 = 0.1;

impl Window<'_> {
    /// Boundaries at which the fastest speed without a jerk limit has a distinct local minimum. There the acceleration
    /// passes through zero in any case, so as knots they cost no time. `plain`: blocks that are not planned across
    /// boundaries.
    pub(super) fn minima(&self, knot: &[bool], plain: &[bool]) -> Vec<bool> {
        let Self { blocks, limits, v_start, .. } = *self;
        let n = blocks.len();
        let inside = limits[1..].iter().map(|limit| limit.v_mm_s);
        let own = std::iter::once(v_start.v_mm_s).chain(inside).chain([0.0]).map(|v| v * v);
        let own: Vec<f64> = own.collect();
        // the fastest speed, squared: no faster than braking to the next boundary and speeding up from the last one allow
        let mut square = own.clone();
        let mut next = 0.0;
        for (here, block) in square.iter_mut().zip(blocks).rev() {
            *here = here.min(next + block.gain.map_or(0.0, |(_, down)| down));
            next = *here;
        }
        let mut last = square[0];
        for (here, block) in square[1..].iter_mut().zip(blocks) {
            *here = here.min(last + block.gain.map_or(0.0, |(up, _)| up));
            last = *here;
        }
        // at a boundary that merely divides a line there is nothing to decide, and a hill may extend across it
        let divides: Vec<bool> = (0..=n).map(|b| b > 0 && b < n && self.only_divides(b)).collect();
        // whether the part of a line between two boundaries has a hill
        let own_hill = |from: usize, to: usize| {
            let v = square[from].max(square[to]).sqrt();
            let length = blocks[from..to].iter().map(|b| b.length).sum();
            rates(&blocks[from].queued).is_some_and(|r| has_hill(length, v, &r))
        };
        // the two ends of a rounded corner have the same limit up to rounding
        let lowest = |i: usize, neighbour: usize| square[i] <= square[neighbour] * (1.0 + ALIKE);
        let is_minimum = |i: usize| {
            if divides[i]
                || knot[i]
                || plain[i]
                || !blocks[i].plans_across
                || blocks[i].gain.is_none()
                || square[i] < own[i] * (1.0 - ALIKE)
            {
                return false;
            }
            let mut begin = i - 1;
            while divides[begin] {
                begin -= 1;
            }
            let mut end = i + 1;
            while divides[end] {
                end += 1;
            }
            (lowest(i, begin) || own_hill(begin, i)) && (lowest(i, end) || own_hill(i, end))
        };
        (0..=n).map(|i| i > 0 && i < n && is_minimum(i)).collect()
    }

    /// Whether the planner may treat the blocks on both sides of a boundary as parts of one line.
    pub(super) fn only_divides(&self, b: usize) -> bool {
        let feed = self.feeds[b].v_mm_s;
        // between the lines of a contour the acceleration differs most often, so it is asked for first
        self.blocks[b].same_rates()
            && !self.forced[b]
            && !self.carried[b]
            && !is_above(feed, self.limits[b].v_mm_s)
            && (self.feeds[b - 1].v_mm_s - feed).abs() <= ALIKE * self.feeds[b - 1].v_mm_s.abs()
    }

    /// Drops the minima at which zero acceleration would cost speed; true if there were any.
    pub(super) fn drop_lowered(
        &self,
        stretches: &[Stretch<'_>],
        speeds: &[Cap],
        knot: &[bool],
        soft: &mut [bool],
    ) -> bool {
        let mut any = false;
        // the speed at the start is final, and the first minimum may be out of reach from it
        if let [first, second, ..] = stretches {
            let (v0, v1) = (speeds[0].v_mm_s, speeds[1].v_mm_s);
            if soft[second.first] && first.slope.down_distance(v0.max(v1), v1) > first.length {
                soft[second.first] = false;
                any = true;
            }
        }
        for (s, v) in stretches.iter().zip(speeds).skip(1) {
            let b = s.first;
            if soft[b] && !knot[b] && v.v_mm_s < self.limits[b].v_mm_s * (1.0 - 1e-9) {
                soft[b] = false;
                any = true;
            }
        }
        any
    }

    /// Marks the boundaries that are knots in any case. Returns which blocks are planned as with plain TRAPEZ or SIN2:
    /// the run of equal feed rate in which braking under G901 begins.
    pub(super) fn mark_knots(&self, knot: &mut [bool]) -> Vec<bool> {
        let Self { blocks, feeds, caps, .. } = *self;
        let mut run = 0;
        let mut plain = vec![false; blocks.len()];
        plain[0] = is_above(self.v_start.v_mm_s, feeds[0].v_mm_s);
        for i in 1..blocks.len() {
            let (a, b) = (&blocks[i - 1], &blocks[i]);
            let drops = is_above(self.entries[i].v_mm_s, feeds[i].v_mm_s);
            let joined = self.carried[i]
                || !self.forced[i]
                    && b.same_slope()
                    && if a.plans_across && !plain[i - 1] {
                        caps[i].v_mm_s > 0.0 && !drops
                    } else {
                        let feed = feeds[i - 1].v_mm_s.min(feeds[i].v_mm_s);
                        caps[i].v_mm_s >= feed
                            && (feeds[i - 1].v_mm_s - feeds[i].v_mm_s).abs() <= 1e-9 * feed
                            && blocks[run].queued.slope.nearly_equals(&b.queued.slope, NEARLY_EQUAL)
                    };
            plain[i] = if joined { plain[i - 1] } else { drops };
            if !joined {
                knot[i] = true;
                run = i;
            }
        }
        plain
    }
}
