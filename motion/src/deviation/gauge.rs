//! The deviation of what is output, cycle by cycle.

use super::{Excursion, SetPath};
use crate::axis::AxisVec;
use crate::contour::{Contour, ROUNDING_MM, Sight};
use smallvec::SmallVec;

/// Deviation in both directions, cycle by cycle, for the output.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gauge {
    reach: u64,
    /// Whether the filters differ between the axes.
    every: bool,
    set: SetPath,
    path: SetPath,
    found: Excursion,
    /// Largest absolute components found so far in the run, in mm.
    most: AxisVec,
    sight: Sight,
    /// Number of the last block that has left the filters.
    left: u64,
    /// The last cycle in which the shortest vector to the set point has turned.
    turned: Option<u64>,
    /// Cycle and place of the last point of the contour that was examined.
    foot: Option<(u64, Foot)>,
    /// Last cycle whose set point differed from the interpolated one.
    filtered: Option<u64>,
    /// Shortest vector to the last set point with its length in mm.
    shortest: Option<(f64, AxisVec)>,
}

/// Cosine of the angle between the shortest vectors of two cycles up to which no component between their directions is
/// larger than both of theirs, but for the eighth part of the square of the angle (0.05 rad).
const SAME_DIRECTION: f64 = 0.998_75;
/// Length of a vector in mm below which its direction does not matter.
const SHORT_MM: f64 = 1e-7;
/// Movement of the nearest set point, as a multiple of that along the contour, from which on it has passed to another
/// part of the set path: then a point between may be missed by more, or along another axis.
const JUMP: f64 = 1.5;
/// Halvings of the contour in one cycle in the search for this place.
const HALVINGS: u32 = 10;
/// Share of a vector up to which it is the mean of those on both sides.
const EVEN: f64 = 1e-3;

/// Multiple of a way along the contour by which a component of the vector changes at most, unless the nearest set point
/// passes to another part of the set path.
const STEEP: f64 = 3.0;

/// A point of the contour and the vector to the nearest set point.
#[derive(Clone, Debug)]
struct Foot {
    of: AxisVec,
    vector: AxisVec,
    /// Cycle after that of the nearest set point.
    cycle: u64,
}

fn length(vector: &[f64]) -> f64 {
    vector.iter().map(|c| c * c).sum::<f64>().sqrt()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

impl Foot {
    /// Whether a point of the contour between this and another point may be missed by more than both of them, or along
    /// another axis. `bend` is that of the contour between them.
    fn may_hide_more(&self, other: &Self, bend: f64) -> bool {
        let way = distance(&self.of, &other.of);
        let square = |i: usize| {
            let moved = other.of[i] + other.vector[i] - self.of[i] - self.vector[i];
            moved * moved
        };
        let moved = (0..self.of.len()).map(square).sum::<f64>().sqrt();
        let [own, its] = [self, other].map(|foot| length(&foot.vector));
        let both = self.vector.iter().zip(other.vector.iter()).map(|(a, b)| a * b).sum::<f64>();
        let most = own.max(its);
        way > ROUNDING_MM
            && most > SHORT_MM
            && (moved > JUMP * way
                || both < SAME_DIRECTION * own * its
                // set path and contour are chord and arc
                || bend * way * way > EVEN * most)
    }

    /// Largest component in mm along an axis of the vectors from the points between this and another one.
    fn potential(&self, other: &Self, way: f64, axis: usize) -> f64 {
        let [own, its] = [self, other].map(|foot| length(&foot.vector));
        let component = self.vector[axis].abs().max(other.vector[axis].abs());
        (component + STEEP * way).min(0.5 * (own + its + way))
    }

    /// Whether this point is missed as the points on both sides of it are, which are equally far away.
    fn is_mean_of(&self, low: &Self, high: &Self) -> bool {
        let (mut off, mut most) = (0.0, 0.0);
        for (i, v) in self.vector.iter().enumerate() {
            let apart = v - 0.5 * (low.vector[i] + high.vector[i]);
            off += apart * apart;
            most += v * v;
        }
        off <= EVEN * EVEN * most
    }
}

impl Gauge {
    /// Continues with filters that reach back `reach` cycles; `every`: they differ between the axes.
    pub(crate) fn with(&self, reach: u32, every: bool) -> Self {
        Self { reach: u64::from(reach), every, most: self.most.clone(), ..Self::default() }
    }

    /// Forgets known distances, because the contour was replaced.
    pub(crate) fn look_anew(&mut self) {
        self.sight = Sight::default();
    }

    /// Largest components found in the last cycle, per axis.
    pub(crate) fn found(&self) -> &[f64] {
        &self.found.vector
    }

    /// Length in mm and components of the shortest vector from the contour to the last set point, if there is a contour.
    pub(crate) fn shortest(&self) -> Option<(f64, &[f64])> {
        self.shortest.as_ref().map(|(length, vector)| (*length, &**vector))
    }

    /// Processes the set point of a cycle in which the filters change nothing, and finds what was missed of the part of
    /// the contour that has just left the filters: axes that have all arrived may still have cut a corner that the
    /// filters held until now. `least_mm`: see [`Self::step`].
    pub(crate) fn unfiltered(
        &mut self,
        contour: &Contour,
        k: u64,
        point: &[f64],
        least_mm: Option<f64>,
    ) {
        self.shortest = None;
        if self.filtered.is_some_and(|last| k <= last + self.reach + 2) {
            self.enter(k, point, point);
            if let Some(least_mm) = least_mm {
                self.begin(point.len());
                self.let_go(contour, k, least_mm);
            }
        } else {
            self.found.clear();
            self.foot = None;
            self.set.restart(k, point);
            self.path.restart(k, point);
        }
    }

    /// Processes the set point and the interpolated point of cycle `k`. Finds the largest components of the vectors
    /// from the contour to the line that ends at the set point, and of the vectors to the set path from those points of
    /// the contour that have just left the filters; for the least tolerance of the run see [`Self::miss`]. Without such
    /// a tolerance only the shortest vector to the set point is found.
    pub(crate) fn step(
        &mut self,
        contour: &Contour,
        k: u64,
        (set, path): (&[f64], &[f64]),
        least_mm: Option<f64>,
    ) {
        self.enter(k, set, path);
        self.filtered = Some(k);
        let (reach, moment) = (self.reach as f64, k as f64);
        let within = (moment - reach, moment);
        if let Some(least_mm) = least_mm {
            self.begin(set.len());
            let now = self.set.leaves(contour, k, within, &mut self.sight, &mut self.found);
            self.keep();
            let before = std::mem::replace(&mut self.shortest, now);
            if let (Some((a, from)), Some((b, to))) = (&before, &self.shortest) {
                let both = from.iter().zip(to.iter()).map(|(a, b)| a * b).sum::<f64>();
                if both < SAME_DIRECTION * a * b && a.max(*b) > SHORT_MM {
                    self.turned = Some(k);
                }
            }
            self.let_go(contour, k, least_mm);
        } else {
            let new = || (0.0, AxisVec::zeros(set.len()));
            let (length, vector) = self.shortest.get_or_insert_with(new);
            match contour.nearest_in_sight(set, within, &mut self.sight, vector) {
                Some(found) => *length = found,
                None => self.shortest = None,
            }
        }
    }

    /// Begins a cycle in which both directions are measured; nothing has been found in it yet.
    fn begin(&mut self, axes: usize) {
        self.set.measure();
        if self.found.vector.len() == axes {
            self.found.clear();
        } else {
            self.found = Excursion::none(axes);
        }
    }

    fn enter(&mut self, k: u64, set: &[f64], path: &[f64]) {
        if self.set.end() != k || self.set.axes() != set.len() {
            self.set = SetPath::starting(k, set.len());
            self.path = self.set.clone();
        }
        let old = k.saturating_sub(2 * self.reach + 4);
        for (kept, point) in [(&mut self.set, set), (&mut self.path, path)] {
            kept.append(point);
            kept.forget_before(old);
        }
    }

    /// Finds what was missed of the part of the contour that leaves the filters in cycle `k`.
    fn let_go(&mut self, contour: &Contour, k: u64, least_mm: f64) {
        let passed = k as f64 - self.reach as f64 - 1.0;
        let entered = contour.entered_near(passed, contour.index(self.left).unwrap_or_default());
        self.left = contour.number(entered);
        let bend = contour.bend(passed - 1.0, entered);
        let turned = self.turned.is_some_and(|at| k <= at + self.reach + 2);
        // under a tolerance the planner has examined the points between
        let free = least_mm.is_infinite();
        let is_examined = self.every || bend > 0.0 || turned && free;
        let first = k.checked_sub(self.reach + 1).filter(|_| is_examined);
        let point = first.and_then(|first| self.path.get(first)).map(AxisVec::from_slice);
        let examined = first.zip(point).filter(|(_, point)| {
            // the distance changes at most by the way along the contour
            let last = self.foot.as_ref().map(|(_, foot)| foot);
            !free
                || last.is_none_or(|foot| {
                    let mm = length(&foot.vector) + distance(&foot.of, point);
                    self.matters(|_| mm)
                })
        });
        let mut last = None;
        if let Some((first, _)) = examined.as_ref().filter(|_| free) {
            last = self.foot_before(contour, k, *first, least_mm);
        }
        for (moment, point) in contour.kinks(passed - 1.0, entered) {
            let first = moment.floor().max(0.0) as u64;
            let among = (first, first + self.reach + 2);
            let from = last.filter(|_| free);
            last = self.follow(contour, (k, passed), point, among, (from, bend), least_mm);
        }
        if let Some((first, point)) = examined {
            let among = (first, k);
            let from = last.filter(|_| free);
            last = self.follow(contour, (k, passed), point, among, (from, bend), least_mm);
            self.foot = last.map(|foot| (k, foot));
        }
    }

    /// Whether components up to some mm per axis may be larger than the largest ones so far.
    fn matters(&self, mm: impl Fn(usize) -> f64) -> bool {
        // an axis that deviates anywhere does so at a set point first
        let mut known = self.most.iter().enumerate().filter(|(_, most)| **most > 0.0);
        known.any(|(axis, most)| mm(axis) > *most)
    }

    /// Keeps the largest components found in this cycle.
    fn keep(&mut self) {
        let found = &self.found.vector;
        if self.most.len() != found.len() {
            self.most = AxisVec::zeros(found.len());
        }
        for (most, found) in self.most.iter_mut().zip(found.iter()) {
            *most = most.max(found.abs());
        }
    }

    /// The point of the contour that was interpolated before cycle `first`.
    fn foot_before(
        &mut self,
        contour: &Contour,
        k: u64,
        first: u64,
        least_mm: f64,
    ) -> Option<Foot> {
        if let Some((at, foot)) = self.foot.take()
            && at + 1 == k
        {
            return Some(foot);
        }
        let before = first.checked_sub(1)?;
        let point = AxisVec::from_slice(self.path.get(before)?);
        self.miss(contour, k, point, (before, k), None, least_mm)
    }

    /// Examines a point of the contour, and the points between it and the last one where another one may be missed by
    /// more.
    fn follow(
        &mut self,
        contour: &Contour,
        (k, passed): (u64, f64),
        point: AxisVec,
        among: (u64, u64),
        (last, bend): (Option<Foot>, f64),
        least_mm: f64,
    ) -> Option<Foot> {
        let hint = last.as_ref().map(|foot| foot.cycle);
        let foot = self.miss(contour, k, point, among, hint, least_mm)?;
        // between the last cycle and this one the path passed everything that lies between two points
        let inside = (k.saturating_sub(self.reach + 2), k);
        if let Some(last) = last.filter(|last| last.may_hide_more(&foot, bend)) {
            let mut open: SmallVec<[(Foot, Foot, u32); 4]> = SmallVec::new();
            open.push((last, foot.clone(), HALVINGS));
            while let Some((low, high, halvings)) = open.pop() {
                let way = distance(&low.of, &high.of);
                if !self.matters(|axis| low.potential(&high, way, axis)) {
                    continue;
                }
                let mut middle: AxisVec =
                    low.of.iter().zip(high.of.iter()).map(|(a, b)| 0.5 * (a + b)).collect();
                if bend > 0.0 {
                    // the middle of a chord lies beside the block
                    let mut aside = AxisVec::zeros(middle.len());
                    contour.nearest(&middle, passed - 1.0, passed, &mut aside);
                    middle.iter_mut().zip(aside.iter()).for_each(|(m, a)| *m -= a);
                }
                let hint = Some(low.cycle);
                let middle = self.miss(contour, k, middle, inside, hint, least_mm);
                let Some(middle) = middle else { continue };
                if halvings == 0 || middle.is_mean_of(&low, &high) {
                    continue;
                }
                open.push((middle.clone(), high, halvings - 1));
                open.push((low, middle, halvings - 1));
            }
        }
        Some(foot)
    }

    /// Adds the vector from a point of the contour to the set path between two cycles: the shortest one or, if that
    /// exceeds the tolerance of the blocks that the filters held, the one with the smallest largest component. Vectors
    /// up to `least_mm`, the least tolerance of the run, do not exceed any.
    fn miss(
        &mut self,
        contour: &Contour,
        k: u64,
        of: AxisVec,
        among: (u64, u64),
        near: Option<u64>,
        least_mm: f64,
    ) -> Option<Foot> {
        let mut shortest = Excursion::none(of.len());
        let found = self.set.misses(&of, among, near, f64::INFINITY, &mut shortest);
        let (cycle, vector) = found?;
        let exceeds = shortest.largest() > least_mm
            && loosest(contour, k, self.reach).is_some_and(|(mm, _)| shortest.largest() > mm);
        let least = exceeds.then(|| self.set.reaches(&of, among)).flatten();
        self.found.take(&least.unwrap_or(shortest.vector));
        self.keep();
        Some(Foot { of, vector, cycle })
    }
}

/// Loosest tolerance in mm of the blocks that filters with this reach held until cycle `k`, with the number of its
/// block; infinite if one of them is not monitored.
pub(crate) fn loosest(contour: &Contour, k: u64, reach: u64) -> Option<(f64, u64)> {
    let (reach, moment) = (reach as f64, k as f64);
    let held = contour.between(moment - 2.0 * reach - 3.0, moment);
    let tolerances = held.map(|passed| {
        let block = &passed.queued.block;
        (block.tolerance.ax_dev_mm.unwrap_or(f64::INFINITY), block.seq)
    });
    tolerances.max_by(|a, b| a.0.total_cmp(&b.0))
}
