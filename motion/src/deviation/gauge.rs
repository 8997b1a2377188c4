//! The deviation of what is output, cycle by cycle.

use super::{Excursion, SetPath};
use crate::axis::AxisVec;
use crate::contour::Contour;

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
