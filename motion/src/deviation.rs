//! How far the filtered path leaves the contour: one definition for the planner, the trace and the summary.
//!
//! ```text
//!             (b) corner -> set path
//!        V  .---- the vertex is missed by this much
//!        |\ v
//!   -----+-*.                set points *, joined by straight lines,
//!      ^    *--*----*---     because the drive interpolates between them
//!      |        (a) set path -> contour
//!   contour
//! ```
//!
//! (a) Every point of the *set path* (the filtered set points joined by straight lines) has a nearest point on the contour
//! that was interpolated within the reach of the filter.
//! (b) Every point of the contour has a nearest point on the set path of the cycles in which the filter still holds it: so
//! the tips of reversals, acute corners and whole detours count that a set path passes by without ever being far from
//! some other part of the contour.
//!
//! Both are shortest vectors over all axes; what is bounded by `AX_DEV` is each of their components.
//!
//! Between two samples (a) is taken where it can be larger than at both of them: where the nearest point passes from one
//! block to another, and half way on a bent block. (b) is taken at the borders of blocks with a kink between them and, on
//! bent blocks, at the interpolated points. Along a straight block (b) follows from (a) by continuity, as long as all axes
//! have the same filter; otherwise the interpolated points count there, too.

use crate::axis::AxisVec;
use crate::contour::Contour;
use smallvec::SmallVec;
use std::ops::Range;

/// Parts into which the line between two set points is divided where it passes a border of blocks.
const PARTS: u32 = 8;

/// Share by which a vector to a point of the contour may be longer than the shortest one and still be taken for it. On a
/// straight set path that is 4.5 % of the vector along the path.
pub(crate) const ALIKE: f64 = 1e-3;

/// Halvings in the search for the point where the nearest block changes.
const HALVINGS: u32 = 8;

/// Set points of consecutive cycles.
#[derive(Clone, Debug, Default)]
pub(crate) struct SetPath {
    axes: usize,
    first: u64,
    /// Axis by axis, cycle by cycle.
    values: Vec<f64>,
}

/// Largest components found, with the vector that one of them belongs to.
#[derive(Clone, Debug, Default)]
pub(crate) struct Excursion {
    /// Component with the largest absolute value, per axis.
    pub(crate) vector: AxisVec,
    /// Length of the longest vector in mm.
    pub(crate) length: f64,
}

impl Excursion {
    pub(crate) fn none(axes: usize) -> Self {
        Self { vector: AxisVec::zeros(axes), length: 0.0 }
    }

    fn take(&mut self, vector: &[f64]) {
        for (kept, new) in self.vector.iter_mut().zip(vector) {
            if new.abs() > kept.abs() {
                *kept = *new;
            }
        }
        let length = vector.iter().map(|c| c * c).sum::<f64>().sqrt();
        self.length = self.length.max(length);
    }

    /// Largest absolute component.
    pub(crate) fn largest(&self) -> f64 {
        self.vector.iter().fold(0.0, |m, c| m.max(c.abs()))
    }

    /// Axis of the largest component.
    pub(crate) fn axis(&self) -> usize {
        let abs = |i: &usize| self.vector[*i].abs();
        (0..self.vector.len()).max_by(|a, b| abs(a).total_cmp(&abs(b))).unwrap_or(0)
    }
}

impl SetPath {
    /// No set points yet; the next one is that of cycle `first`.
    pub(crate) fn starting(first: u64, axes: usize) -> Self {
        Self { axes, first, values: Vec::new() }
    }

    /// Adds the set point of the next cycle.
    pub(crate) fn push(&mut self, point: &[f64]) {
        self.values.extend_from_slice(point);
    }

    /// The cycle behind the last one.
    pub(crate) fn end(&self) -> u64 {
        self.first + (self.values.len() / self.axes.max(1)) as u64
    }

    /// Forgets what lies before cycle `k`, now and then.
    pub(crate) fn forget_before(&mut self, k: u64) {
        let old = (k.saturating_sub(self.first) as usize * self.axes).min(self.values.len());
        if 2 * old > self.values.len() {
            self.values.drain(..old);
            self.first += (old / self.axes.max(1)) as u64;
        }
    }

    pub(crate) fn get(&self, k: u64) -> Option<&[f64]> {
        let at = k.checked_sub(self.first)? as usize * self.axes;
        self.values.get(at..at + self.axes)
    }

    /// (a) between cycle `k - 1` and cycle `k`, from the contour interpolated between two moments (cycles). The shortest
    /// vector to the set point of cycle `k` comes back with its length in mm, if there is a contour.
    pub(crate) fn leaves(
        &self,
        contour: &Contour,
        k: u64,
        (from, to): (f64, f64),
        out: &mut Excursion,
    ) -> Option<(f64, AxisVec)> {
        let here = self.get(k)?;
        let mut vector = AxisVec::zeros(self.axes);
        let Some(before) = k.checked_sub(1).and_then(|k| self.get(k)) else {
            let now = contour.nearest(here, from, to, &mut vector);
            out.take(&vector);
            return now.map(|now| (now.distance, vector));
        };
        let around = contour.around((before, here), (from, to), (1.0, 0.0));
        let now = around.nearest(here, &mut vector);
        out.take(&vector);
        let shortest = now.map(|now| (now.distance, vector.clone()));
        let then = around.nearest_of_all(before, &mut vector);
        let parts = match (now, then) {
            (Some(now), Some(then)) if now.block == then.block => {
                if now.straight {
                    return shortest;
                }
                2
            }
            (Some(_), Some(_)) => PARTS,
            _ => return shortest,
        };
        // the largest distance lies where the nearest point passes from one block to another
        let mut point = AxisVec::zeros(self.axes);
        let mut look = |u: f64| {
            for ((p, a), b) in point.iter_mut().zip(before).zip(here) {
                *p = a + u * (b - a);
            }
            let found = around.nearest_of_all(&point, &mut vector).map(|n| n.block);
            out.take(&vector);
            found
        };
        let mut last = then.map(|n| n.block);
        for part in 1..=parts {
            let mut high = f64::from(part) / f64::from(parts);
            let found = look(high);
            if found != last {
                let mut low = high - 1.0 / f64::from(parts);
                for _ in 0..HALVINGS {
                    let mid = 0.5 * (low + high);
                    if look(mid) == last { low = mid } else { high = mid }
                }
            }
            last = found;
        }
        shortest
    }

    /// Largest component of (a) between cycle `k - 1` and cycle `k`, whatever could be called the shortest vector: from
    /// blocks within `slack` cycles of the two moments, too. Points of the line count at most `apart` mm from each other,
    /// as long as `PARTS` of them are enough.
    pub(crate) fn doubtful(
        &self,
        contour: &Contour,
        k: u64,
        (from, to): (f64, f64),
        (slack, apart): (f64, f64),
    ) -> f64 {
        let ends = k.checked_sub(1).and_then(|before| Some((self.get(before)?, self.get(k)?)));
        let Some((a, b)) = ends else { return 0.0 };
        let around = contour.around((a, b), (from, to), (slack, slack));
        let length = a.iter().zip(b).map(|(a, b)| (b - a) * (b - a)).sum::<f64>().sqrt();
        let parts = (length / apart).ceil().clamp(1.0, f64::from(PARTS)) as u32;
        let component = |part: u32| {
            let u = f64::from(part) / f64::from(parts);
            let point: AxisVec = a.iter().zip(b).map(|(a, b)| a + u * (b - a)).collect();
            around.worst_component(&point)
        };
        (1..=parts).map(component).fold(0.0, f64::max)
    }

    /// (b) of a point of the contour, from the set path between two cycles; returns the cycle that comes nearest and the
    /// vector to it. Beyond `wary_mm` whatever could be called the shortest vector counts.
    pub(crate) fn misses(
        &self,
        point: &[f64],
        (first, last): (u64, u64),
        wary_mm: f64,
        out: &mut Excursion,
    ) -> Option<(u64, AxisVec)> {
        let (first, last) = (first.max(self.first), last.min(self.end().checked_sub(1)?));
        let mut best = (f64::INFINITY, first);
        let mut distances: SmallVec<[f64; 64]> = SmallVec::new();
        for k in first..last {
            let d2 = self.to_line(k, point).0;
            distances.push(d2);
            if d2 < best.0 {
                best = (d2, k);
            }
        }
        let (d2, k) = best;
        if d2.is_infinite() {
            return None;
        }
        let mut vector = AxisVec::zeros(self.axes);
        self.aside(k, point, &mut vector);
        out.take(&vector);
        let nearest = vector.clone();
        if d2 > wary_mm * wary_mm {
            let within = (1.0 + ALIKE) * (1.0 + ALIKE) * d2;
            for (k, d2) in (first..last).zip(distances) {
                if d2 <= within {
                    self.aside(k, point, &mut vector);
                    out.take(&vector);
                }
            }
        }
        Some((k + 1, nearest))
    }

    /// Distance in mm of a point from the line to the set point of cycle `k` from the one before.
    pub(crate) fn distance(&self, k: u64, point: &[f64]) -> f64 {
        self.to_line(k.saturating_sub(1), point).0.sqrt()
    }

    /// Largest distance in mm of the set points of some cycles from the line through two points.
    pub(crate) fn bulge(&self, cycles: Range<u64>, from: &[f64], to: &[f64]) -> f64 {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let minus = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<AxisVec>();
        let along = minus(to, from);
        let square = dot(&along, &along);
        let beside = cycles.filter_map(|k| {
            let off = minus(self.get(k)?, from);
            let part = dot(&off, &along);
            let on_line = if square > 0.0 { part * part / square } else { 0.0 };
            Some(dot(&off, &off) - on_line)
        });
        beside.fold(0.0, f64::max).sqrt()
    }

    /// Square of the distance of a point from the line between cycle `k` and cycle `k + 1`, and where along the line.
    fn to_line(&self, k: u64, point: &[f64]) -> (f64, f64) {
        let n = point.len();
        let ends = k.checked_sub(self.first).and_then(|at| {
            let at = at as usize * n;
            self.values.get(at..at + 2 * n)
        });
        let Some((a, b)) = ends.map(|ends| ends.split_at(n)) else { return (f64::INFINITY, 0.0) };
        let (mut dot, mut norm) = (0.0, 0.0);
        for i in 0..n {
            let d = b[i] - a[i];
            dot += (point[i] - a[i]) * d;
            norm += d * d;
        }
        let u = if norm > 0.0 { (dot / norm).clamp(0.0, 1.0) } else { 0.0 };
        let mut d2 = 0.0;
        for i in 0..n {
            let c = a[i] + u * (b[i] - a[i]) - point[i];
            d2 += c * c;
        }
        (d2, u)
    }

    /// The shortest vector from a point to the line between cycle `k` and cycle `k + 1`.
    fn aside(&self, k: u64, point: &[f64], vector: &mut [f64]) {
        let u = self.to_line(k, point).1;
        let (Some(a), Some(b)) = (self.get(k), self.get(k + 1)) else { return };
        for (((v, p), a), b) in vector.iter_mut().zip(point).zip(a).zip(b) {
            *v = a + u * (b - a) - p;
        }
    }
}

/// Both ways, cycle by cycle, for what is output.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gauge {
    reach: u64,
    /// The filters of the axes differ.
    every: bool,
    set: SetPath,
    path: SetPath,
    found: Excursion,
    /// Cycle and set point of the last cycle in which nothing was filtered.
    unfiltered: Option<(u64, AxisVec)>,
    /// Shortest vector to the last set point with its length in mm.
    shortest: Option<(f64, AxisVec)>,
}

impl Gauge {
    /// For filters that reach `reach` cycles back; `every`: they differ between the axes.
    pub(crate) fn new(reach: u32, every: bool) -> Self {
        Self { reach: u64::from(reach), every, ..Self::default() }
    }

    /// Largest components found in the last cycle, per axis.
    pub(crate) fn found(&self) -> &[f64] {
        &self.found.vector
    }

    /// Length in mm and components of the shortest vector from the contour to the last set point, if there is a contour.
    pub(crate) fn shortest(&self) -> Option<(f64, &[f64])> {
        self.shortest.as_ref().map(|(length, vector)| (*length, &**vector))
    }

    /// Takes the set point of a cycle that filters left as it was interpolated: the line to the next one starts there.
    pub(crate) fn unfiltered(&mut self, k: u64, point: &[f64]) {
        match &mut self.unfiltered {
            Some((at, kept)) if kept.len() == point.len() => {
                *at = k;
                for (kept, new) in kept.iter_mut().zip(point) {
                    *kept = *new;
                }
            }
            unfiltered => *unfiltered = Some((k, AxisVec::from_slice(point))),
        }
    }

    /// Takes the set point and the interpolated point of cycle `k`. Finds the largest components of what the line to the
    /// set point leaves the contour by, and of what the points of the contour that the filters have just let go were
    /// missed by.
    pub(crate) fn step(&mut self, contour: &Contour, k: u64, set: &[f64], path: &[f64]) {
        let axes = set.len();
        if self.set.end() != k {
            // nothing was filtered in between: the set point was the path
            let before =
                self.unfiltered.as_ref().filter(|(at, point)| at + 1 == k && point.len() == axes);
            let mut path = SetPath::starting(before.map_or(k, |(at, _)| *at), axes);
            if let Some((_, point)) = before {
                path.push(point);
            }
            (self.set, self.path) = (path.clone(), path);
        }
        self.set.push(set);
        self.path.push(path);
        let (reach, moment) = (self.reach as f64, k as f64);
        let mut found = Excursion::none(axes);
        self.shortest = self.set.leaves(contour, k, (moment - reach, moment), &mut found);
        let passed = moment - reach - 1.0;
        for (moment, point) in contour.kinks(passed - 1.0, passed) {
            let first = moment.floor().max(0.0) as u64;
            let among = (first, first + self.reach + 2);
            self.set.misses(&point, among, f64::INFINITY, &mut found);
        }
        if let Some(first) = k.checked_sub(self.reach + 1)
            && let Some(point) = self.path.get(first)
            && (self.every || contour.is_bent(passed))
        {
            self.set.misses(point, (first, k), f64::INFINITY, &mut found);
        }
        self.found = found;
        let old = k.saturating_sub(2 * self.reach + 4);
        self.set.forget_before(old);
        self.path.forget_before(old);
    }
}
