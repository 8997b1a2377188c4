//! Upper bound of the distance between set path and contour, from one cycle to the next.
//!
//! Any path length `m` that the filters hold defines a point `q(m)` of the contour. From one cycle to the next, `m` moves
//! along the contour without gaps, and the set point `y` moves with it: so `|y - q(m)|` bounds both the distance by
//! which the set path leaves the contour and that by which it misses it. Along one straight block both move linearly
//! from one cycle to the next, so the bound is evaluated at the set points and where `m` passes to another block; on
//! bends the sagitta of the arc is added. Where the filters of the axes are equal, `m` is the mean of the path lengths
//! that they hold: the bound is then close to the measured value, because the vector has no component along the path, to
//! first order. Filters that differ move the set point along the path, and `m` is moved with it.
//!
//! The length bounds every component of the shortest vector, which the tolerance is about. The components of `y - q(m)`
//! do not: the shortest vector may be shorter than this one and have a larger component.

use super::marks::Mark;
use crate::axis::AxisVec;
use crate::contour::{Contour, Walk};
use crate::deviation::distance;

/// The point of the contour that accompanies the set point.
pub(super) struct Companion<'a> {
    marks: &'a [Mark],
    walk: Walk<'a>,
    /// Set point and path length `m` of the cycle before, and the distance there.
    before: Option<(AxisVec, f64, f64)>,
    /// Number of marks that the path length has passed.
    passed: usize,
    point: AxisVec,
}

impl<'a> Companion<'a> {
    /// For the blocks of `marks`, which are those of `contour`.
    pub(super) fn new(marks: &'a [Mark], contour: &'a Contour, axes: usize) -> Self {
        let point = AxisVec::zeros(axes);
        Self { marks, walk: contour.walk(), before: None, passed: 0, point }
    }

    /// Call it if the next cycle does not follow the last one.
    pub(super) fn jump(&mut self) {
        self.before = None;
    }

    /// Largest distance in mm on the segment from the set point of the cycle before to `set`, where the path length
    /// is `beside`.
    pub(super) fn step(&mut self, set: &[f64], beside: f64) -> f64 {
        self.walk.position(beside, &mut self.point);
        let here = distance(set, &self.point);
        let Some((from, start, there)) = &mut self.before else {
            self.before = Some((AxisVec::from_slice(set), beside, here));
            return here;
        };
        let mut largest = here.max(*there);
        let marks = self.marks;
        let (low, high) = (start.min(beside), start.max(beside));
        while self.passed > 0 && marks[self.passed - 1].s_mm > low {
            self.passed -= 1;
        }
        while marks.get(self.passed).is_some_and(|m| m.s_mm <= low) {
            self.passed += 1;
        }
        let ahead = marks[self.passed..].iter().take_while(|m| m.s_mm < high);
        for m in ahead.clone() {
            let u = (m.s_mm - *start) / (beside - *start);
            for ((p, a), b) in self.point.iter_mut().zip(from.iter()).zip(set) {
                *p = a + u * (b - a);
            }
            largest = largest.max(distance(&self.point, m.point()));
        }
        let on = marks[..self.passed].last();
        let bends = on.into_iter().chain(ahead).filter(|m| m.queued.bend > 0.0);
        let bend = bends
            .map(|m| m.queued.bend_between(low - m.s_mm, high - m.s_mm))
            .fold(0.0_f64, f64::max);
        let way = high - low;
        from.copy_from_slice(set);
        (*start, *there) = (beside, here);
        largest + bend * way * way / 8.0 * (set.len() as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    #[expect(unreachable_pub, reason = "written for examples, which are outside of the crate")]
    mod doc {
        include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs"));
    }

    use super::*;
    use crate::queue::Queued;
    use doc::{Arc, block};
    use kontur_filters::time::CycleTime;
    use proptest::prelude::*;

    /// A polygon as marks and as contour; the times do not matter here.
    fn polygon(points: &[[f64; 2]]) -> (Vec<Mark>, Contour) {
        let (mut marks, mut contour, mut s_mm) = (Vec::new(), Contour::default(), 0.0);
        for (ends, i) in points.windows(2).zip(1..) {
            let block = block(i, ends[0], ends[1], 10.0);
            let length = block.path.length();
            let queued = Arc::new(Queued::new(block, CycleTime::from_us(1000).unwrap()));
            contour.enter(0.0, s_mm, Arc::clone(&queued));
            let (cycles, jump, axis) = (0.0, 1.0, 0);
            let (boundary, block) = (None, None);
            let (inside, goes_on) = (None, false);
            marks.push(Mark { cycles, boundary, block, queued, s_mm, jump, axis, inside, goes_on });
            s_mm += length;
        }
        (marks, contour)
    }

    /// Distance of a point from the segment between two points.
    fn aside(point: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
        let along = [b[0] - a[0], b[1] - a[1]];
        let off = [point[0] - a[0], point[1] - a[1]];
        let norm = along[0] * along[0] + along[1] * along[1];
        let dot = off[0] * along[0] + off[1] * along[1];
        let u = if norm > 0.0 { (dot / norm).clamp(0.0, 1.0) } else { 0.0 };
        libm::hypot(off[0] - u * along[0], off[1] - u * along[1])
    }

    proptest! {
        /// For any polygon, any speeds, any positive weights and any path lengths beside the set points: no point of the
        /// segment between two set points is further from the polygon than the bound, and no point of the polygon
        /// between the two path lengths is further from the segment.
        #[test]
        fn nothing_between_two_set_points_is_further_apart(
            points in prop::collection::vec(prop::array::uniform2(-1.0..1.0f64), 3..9),
            weights in prop::collection::vec(0.01..1.0f64, 1..9),
            steps in prop::collection::vec(0.0..0.5f64, 20),
            shifts in prop::collection::vec(-0.5..0.5f64, 30),
        ) {
            let (marks, contour) = polygon(&points);
            let end = marks.last().map_or(0.0, |m| m.s_mm + m.queued.length);
            let mut s = vec![0.0; weights.len()];
            for step in steps {
                s.push((s[s.len() - 1] + step).min(end));
            }
            let total: f64 = weights.iter().sum();
            let place = |s: f64| {
                let mut at = [0.0; 2];
                contour.walk().position(s, &mut at);
                at
            };
            let mut companion = Companion::new(&marks, &contour, 2);
            let mut before: Option<([f64; 2], f64)> = None;
            for k in weights.len()..s.len() {
                let mean = |f: &dyn Fn(f64) -> f64| -> f64 {
                    weights.iter().zip(&s[..=k].iter().rev().collect::<Vec<_>>())
                        .map(|(w, s)| w / total * f(**s)).sum()
                };
                let set = [0, 1].map(|i| mean(&|s| place(s)[i]));
                let beside = (mean(&|s| s) + shifts[k]).clamp(0.0, end);
                let bound = companion.step(&set, beside);
                let (from, start) = before.unwrap_or((set, beside));
                for part in 0..=16 {
                    let u = f64::from(part) / 16.0;
                    let at = [0, 1].map(|i| from[i] + u * (set[i] - from[i]));
                    let left = points.windows(2).map(|b| aside(at, b[0], b[1]));
                    prop_assert!(left.fold(f64::INFINITY, f64::min) <= bound + 1e-9);
                    let missed = aside(place(start + u * (beside - start)), from, set);
                    prop_assert!(missed <= bound + 1e-9, "{missed} {bound}");
                }
                before = Some((set, beside));
            }
        }
    }
}
