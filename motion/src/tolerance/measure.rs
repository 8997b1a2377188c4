//! Measures by how far the set path misses points of the contour.

use super::harvest::Harvest;
use super::search::Suspects;
use super::set_points::SetPoints;
use super::view::View;
use super::violation::{Record, Violation, within};
use crate::axis::AxisVec;
use crate::contour::ROUNDING_MM;
use crate::deviation::Unkept;
use crate::deviation::{ALIKE, Excursion, SetPath, distance};
use smallvec::{SmallVec, smallvec};

/// Cycles around the set point nearest to one point of the contour within which that of the next point is searched for.
const HINT: u64 = 3;
/// Halvings of a piece of the contour in the search for the point missed most: from the path of one cycle down to
/// rounding.
const HALVINGS: u32 = 24;
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
/// Maximum number of points of the contour examined per cycle.
const PARTS: f64 = 4.0;
/// Distance between the points examined, in tolerances.
pub(super) const SPACING: f64 = 0.02;

/// Length in mm up to which no component of a vector, or of one that may be taken for it, exceeds the tolerance.
fn certain(tolerance_mm: f64) -> f64 {
    within(tolerance_mm) / (1.0 + ALIKE)
}

/// A point of the contour, by its path length, and its nearest set point.
#[derive(Clone)]
struct Foot {
    s: f64,
    /// The point of the contour.
    of: AxisVec,
    /// Cycle after the set point.
    cycle: u64,
    /// Distance in mm.
    length: f64,
    /// Largest component in mm.
    deviation_mm: f64,
    /// The set point.
    point: AxisVec,
    /// First and last cycle among which it was searched for.
    among: (u64, u64),
    /// Whether these are only those near the one of a neighbouring point; another part of the set path may be closer.
    is_local: bool,
}

impl Foot {
    fn apart(&self, other: &Self) -> f64 {
        distance(&self.point, &other.point)
    }

    /// Whether no set point of some cycles is within a distance in mm of another point of the contour.
    fn excludes(&self, of: &[f64], (first, last): (u64, u64), mm: f64) -> bool {
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
    fn may_hide_more(&self, other: &Self, set: &SetPath, bend: f64, tolerance_mm: f64) -> bool {
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

impl View<'_> {
    /// Reports to `found` what is missed of the contour among the suspects and becomes known in the cycles `from..=to`,
    /// at most the worst per half kernel, and updates the worst of all.
    pub(super) fn missed(
        &self,
        (from, to): (u64, u64),
        suspects: &Suspects,
        points: &mut SetPoints<'_>,
        found: &mut impl FnMut(&Violation, &Record),
        worst: &mut Option<Unkept>,
    ) {
        let Self { trial, marks, contour, .. } = self;
        let length = u64::from(trial.kernels.length());
        let reach = length as f64;
        let n = points.axes();
        let first = from.saturating_sub(2 * length + 4);
        let mut record = Record::of((first, to));
        let mut set = SetPath::of((first, to), n);
        let mut at = marks.partition_point(|m| m.cycles < from as f64 - reach - 2.0);
        let mut harvest = Harvest::new(self, worst, found);
        let mut between = AxisVec::zeros(n);
        let mut walk = contour.walk();
        let mut hint = from;
        let (mut looked, mut last): (Option<f64>, Option<Foot>) = (None, None);
        for k in first..=to {
            points.step(k);
            record.push(points.s());
            set.push(points.set());
            if k < from {
                continue;
            }
            let moment = k as f64;
            // cycles in which the filters may hold a point of the contour
            let all = |moment: f64| {
                let first = moment.floor().max(0.0) as u64;
                (first, first + length + 2)
            };
            // a neighbouring point leads to the nearest set point
            let mut look =
                |point: &[f64], near: (u64, u64), moment: f64, s: f64, by: Option<&Foot>| {
                    let tolerance_mm = self.tolerance(moment, moment + reach);
                    let wary_mm = certain(tolerance_mm);
                    let all = all(moment);
                    let hint = by.map(|foot| foot.cycle);
                    let mut out = Excursion::none(n);
                    let excluded = by.is_some_and(|foot| foot.excludes(point, near, wary_mm));
                    let mut nearest = None;
                    if near == all || !excluded {
                        nearest = set.misses(point, near, hint, wary_mm, &mut out);
                    }
                    let is_local = near != all && !excluded && out.length <= wary_mm;
                    if near != all && !is_local {
                        out = Excursion::none(n);
                        nearest = set.misses(point, all, hint, wary_mm, &mut out);
                    }
                    let (cycle, vector) = nearest?;
                    let deviation_mm = out.largest();
                    if deviation_mm > within(tolerance_mm) {
                        let axis = out.axis();
                        let vector = out.vector.clone();
                        let missed = Some((AxisVec::from_slice(point), s));
                        harvest.take(
                            Violation { cycle, deviation_mm, tolerance_mm, axis, vector, missed },
                            &record,
                        );
                    }
                    let of = AxisVec::from_slice(point);
                    let point = point.iter().zip(vector.iter()).map(|(p, v)| p + v).collect();
                    let among = if is_local { near } else { all };
                    let among = (among.0, among.1.min(set.end() - 1));
                    Some(Foot {
                        s,
                        of,
                        cycle,
                        length: out.length,
                        deviation_mm,
                        point,
                        among,
                        is_local,
                    })
                };
            while at < marks.len() && marks[at].cycles + reach + 1.0 <= moment {
                let mark = &marks[at];
                if at > 0 && mark.is_kink() && suspects.way_at(mark.s_mm).is_some() {
                    look(mark.point(), all(mark.cycles), mark.cycles, mark.s_mm, None);
                }
                at += 1;
            }
            // the other points of the contour, at the spacing that matters
            let passed = k.saturating_sub(length + 1);
            if passed <= first {
                continue;
            }
            let tolerance = self.tolerance(passed as f64, moment);
            // on a slow path not in every cycle, but from where the last one was examined
            let (from, to) = (looked.unwrap_or_else(|| record.s(passed - 1)), record.s(passed));
            looked = Some(from);
            if to - from < SPACING * tolerance && tolerance.is_finite() {
                continue;
            }
            looked = Some(to);
            if !suspects.misses(from, to) {
                last = None;
                continue;
            }
            let parts =
                ((to - from) / (10.0 * SPACING * tolerance)).ceil().clamp(1.0, PARTS) as u32;
            let even = (1..=parts).map(|i| from + f64::from(i) / f64::from(parts) * (to - from));
            // the contour is not straight at a kink
            let first_mark = marks.partition_point(|m| m.s_mm <= from);
            let ahead = marks[first_mark..].iter().take_while(|m| m.s_mm < to);
            let kinks = ahead.filter(|m| m.is_kink() || m.queued.bend > 0.0).map(|m| m.s_mm);
            let mut places: SmallVec<[f64; 8]> = even.chain(kinks).collect();
            places.sort_by(f64::total_cmp);
            for s in places {
                let Some(way) = suspects.way_at(s) else {
                    last = None;
                    continue;
                };
                walk.position(s, &mut between);
                let held = record.leaves(s).min(passed);
                // the nearest set point is close to the last one found
                hint = if last.is_some() { hint } else { way.cycle }.max(held);
                let near = (hint.saturating_sub(HINT).max(held), hint + HINT);
                let foot = look(&between, near, held as f64, s, last.as_ref());
                hint = foot.as_ref().map_or(near.0, |foot| foot.cycle);
                let before = std::mem::replace(&mut last, foot);
                let (Some(low), Some(high)) = (before, last.clone()) else { continue };
                let bend = self.bend_between(low.s, high.s);
                let mut open: SmallVec<[(Foot, Foot, u32); 4]> = smallvec![(low, high, HALVINGS)];
                while let Some((mut low, mut high, halvings)) = open.pop() {
                    // next to a point that may be missed, the nearest part of the set path may be another one
                    if low.length.max(high.length) > certain(tolerance) {
                        for foot in [&mut low, &mut high].into_iter().filter(|foot| foot.is_local) {
                            let held = record.leaves(foot.s).min(passed);
                            let moment = held as f64;
                            let by = Some(&*foot);
                            if let Some(other) = look(&foot.of, all(moment), moment, foot.s, by) {
                                *foot = other;
                            }
                        }
                    }
                    if halvings == 0 || !low.may_hide_more(&high, &set, bend, tolerance) {
                        continue;
                    }
                    let mid = 0.5 * (low.s + high.s);
                    walk.position(mid, &mut between);
                    let held = record.leaves(mid).min(passed);
                    let around = [low.cycle, high.cycle];
                    let near = (
                        around[0].min(around[1]).saturating_sub(HINT).max(held),
                        around[0].max(around[1]) + HINT,
                    );
                    let by = Some(&low);
                    let Some(foot) = look(&between, near, held as f64, mid, by) else { break };
                    open.push((foot.clone(), high, halvings - 1));
                    open.push((low, foot, halvings - 1));
                }
            }
        }
        harvest.end(&record);
    }

    /// Largest `|q''|` of an axis in 1/mm between two path lengths.
    fn bend_between(&self, from: f64, to: f64) -> f64 {
        let first = self.marks.partition_point(|m| m.s_mm <= from).max(1) - 1;
        let inside = self.marks[first..].iter().take_while(|m| m.s_mm <= to);
        inside.map(|m| m.queued.bend_between(from - m.s_mm, to - m.s_mm)).fold(0.0, f64::max)
    }

    /// Smallest tolerance in mm of the blocks interpolated between two times.
    pub(super) fn tolerance(&self, from: f64, to: f64) -> f64 {
        if let Some(tolerance) = self.tolerance_mm {
            return tolerance;
        }
        let bounds =
            self.contour.between(from, to).filter_map(|p| p.queued.block.tolerance.ax_dev_mm);
        bounds.fold(f64::INFINITY, f64::min)
    }

    /// Component in the direction `toward` of the change of direction at the entry of a mark's block.
    pub(super) fn turn(&self, m: usize, toward: &[f64]) -> f64 {
        let Some(before) = m.checked_sub(1).map(|b| &self.marks[b]) else { return 0.0 };
        if self.marks[m].goes_on {
            return 0.0;
        }
        let [out, into] = [&before.queued.ends.tangent_out, &self.marks[m].queued.ends.tangent_in];
        toward.iter().zip(into.iter().zip(out.iter())).map(|(u, (b, a))| u * (b - a)).sum()
    }
}
