//! Points of the contour with their nearest set points, and what can be missed between two of them.

use super::measure::SPACING;
use super::violation::within;
use crate::axis::AxisVec;
use crate::contour::ROUNDING_MM;
use crate::deviation::{ALIKE, SetPath, distance};

/// Ratio of the movement of the nearest set point to that along the contour from which on it has passed to another part
/// of the set path.
const JUMP: f64 = 1.1;
/// Distance between points of the contour, in tolerances, up to which their vectors to the set path are similar.
const CLOSE: f64 = 0.1;
/// Share of a vector along the set path with which it may still count as the shortest one, see [`ALIKE`].
const ALONG: f64 = 0.045;
/// Sum of the turns of the set path in rad up to which their sine hardly differs from them.
const MOST_TURN: f64 = 0.3;
/// Number of segments of the set path that the nearest set point may pass between two points.
const MOST_LINES: u64 = 8;

/// Length in mm up to which no component of a vector, or of one that may be taken for it, exceeds the tolerance.
pub(super) fn certain(tolerance_mm: f64) -> f64 {
    within(tolerance_mm) / (1.0 + ALIKE)
}

/// A point of the contour, by its path length, and its nearest set point.
#[derive(Clone)]
pub(super) struct Foot {
    pub(super) s: f64,
    /// The point of the contour.
    pub(super) of: AxisVec,
    /// Cycle after the set point.
    pub(super) cycle: u64,
    /// Distance in mm.
    pub(super) length: f64,
    /// Largest component in mm.
    pub(super) deviation_mm: f64,
    /// The set point.
    pub(super) point: AxisVec,
    /// First and last cycle among which it was searched for.
    pub(super) among: (u64, u64),
    /// Whether these are only those near the one of a neighbouring point; another part of the set path may be closer.
    pub(super) is_local: bool,
}

impl Foot {
    fn apart(&self, other: &Self) -> f64 {
        distance(&self.point, &other.point)
    }

    /// Whether no set point of some cycles is within a distance in mm of another point of the contour.
    pub(super) fn excludes(&self, of: &[f64], (first, last): (u64, u64), mm: f64) -> bool {
        self.among.0 <= first
            && last <= self.among.1
            && distance(&self.of, &self.point) - distance(&self.of, of) > mm + ROUNDING_MM
    }

    /// Distance along the contour in mm over all axes; the path length counts only those of the feed group.
    fn way(&self, other: &Self) -> f64 {
        (other.s - self.s).abs().max(distance(&self.of, &other.of))
    }

    /// Whether a point of the contour between two others can be missed by more than both of them and the tolerance.
    /// `bend` is that of the contour between them, 0 for a straight line.
    ///
    /// The distance of a point changes at most by the movement of the point. On straight lines the length of the vector
    /// between two points that move linearly has no maximum inside. So a point between can exceed both ends only by the
    /// sagitta of the bend (`bend way^2 / 8` per axis) and by the distance of the set path from the chord between the
    /// nearest set points. Where the nearest set point passes to another part of the set path, both ends may still keep
    /// the tolerance to the same segment of it. A vector longer than the tolerance may have components within it: these
    /// are compared only between points close to each other, or where the set path, and with it the vector, hardly
    /// turns.
    pub(super) fn may_hide_more(
        &self,
        other: &Self,
        set: &SetPath,
        bend: f64,
        tolerance_mm: f64,
    ) -> bool {
        let limit = within(tolerance_mm);
        let most = self.deviation_mm.max(other.deviation_mm);
        if most > limit {
            return false;
        }
        let way = self.way(other);
        if 0.5 * (self.length + other.length + way) <= certain(tolerance_mm) {
            return false;
        }
        let along = other.s - self.s;
        let beside = bend * along * along / 8.0 * (self.of.len() as f64).sqrt();
        let lines = [self.cycle.min(other.cycle), self.cycle.max(other.cycle)];
        let aside = if lines[1] - lines[0] <= MOST_LINES {
            set.bulge(lines[0]..lines[1], &self.point, &other.point)
        } else {
            f64::INFINITY
        };
        let close = lines[0] == lines[1] || way <= CLOSE * tolerance_mm;
        let longest = self.length.max(other.length);
        let follows = self.apart(other) <= JUMP * way;
        let goes_along = close && follows;
        let largest = if goes_along {
            most
        } else if follows && aside.is_finite() && longest + aside + beside > limit {
            // perpendicular to the set path, the vector turns with it; along it the nearest point lags by as much
            let turn = set.turn(lines[0].saturating_sub(1)..lines[1] + 1);
            if turn <= MOST_TURN {
                most + longest * ALONG + 1.1 * (longest * turn + aside)
            } else {
                longest
            }
        } else {
            longest
        };
        if goes_along && way <= SPACING * tolerance_mm || largest + aside + beside <= limit {
            return false;
        }
        let keeps = |foot: &Self, line: u64| set.distance(line, &foot.of) + beside <= limit;
        !lines.iter().any(|line| keeps(self, *line) && keeps(other, *line))
    }
}
