//! Whether the spline at a corner takes no longer than the sharp corner, under `AX_DEV` as well if all axes share a filter
//! without overshoot. Otherwise only the planner knows the speeds, and corners are rounded.
//!
//! Each corner is judged separately, with the spline as if all other corners were rounded. For corners with additional
//! control points, which are independent of each other, this is decisive. At other corners an end of the spline makes
//! it bend more at the neighbouring corners: these corners stay sharp only if that is still faster, together with the
//! corners already found sharp. There are several rounds, as an end may pay off next to another one; each round uses
//! the results of the earlier ones. A contour and its reverse therefore have the same sharp corners, except for those
//! that take the same time either way.

use super::edge::{Curve, Edge};
use super::stage::Stage;
use crate::block::Block;
use crate::limits::{PathExtremes, PathSpeeds};
use crate::tolerance::Kernels;
use crate::worth::{Monitored, Part, Passage};

/// Share of the time that an end of the spline at a smooth corner has to save: less may be due to the division into
/// pieces.
const GAIN: f64 = 0.01;

/// See [`Passage::corner_share`]. Half of the spline around a corner is nearly straight.
const AS_CORNER: f64 = 1.0;

impl Stage {
    /// Whether the spline takes no longer than the sharp corner at the start of an edge.
    pub(super) fn is_worth(&self, corner: usize, kernels: &Kernels) -> bool {
        let (from, to) = (&self.run[corner - 1], &self.run[corner]);
        let (a, b) = (&from.as_last(), &to.block);
        // an end speed is programmed explicitly
        let Some(passage) = self.passage((a, b), kernels).filter(|_| a.end_velocity_mm_s.is_none())
        else {
            return true;
        };
        // beyond its additional control points the spline coincides with the edge
        let reach = |edge: &Edge| to.corner.e.map_or(0.5 * edge.length, |e| 2.0 * e);
        let (pre_mm, post_mm) = (reach(from), reach(to));
        let bent = passage.monitored.is_some();
        let mut around: Vec<Part> = near(from.curves.iter().rev(), pre_mm, bent).collect();
        around.reverse();
        around.extend(near(to.curves.iter(), post_mm, bent));
        let off_mm = to.corner.e.unwrap_or(0.0) / 6.0 * passage.turn();
        passage.is_worth(&around, [pre_mm, post_mm], off_mm)
    }

    /// Whether ending the spline at the start of an edge saves time, although it then bends more next to it.
    pub(super) fn gains_as_end(&self, corner: usize, round: usize, kernels: &Kernels) -> bool {
        let (from, to) = (self.run[corner - 1].as_last(), &self.run[corner].block);
        let Some(passage) = self.passage((&from, to), kernels) else { return false };
        let time_with = |and: Option<usize>| {
            let known =
                |i: usize| self.run[i].corner.sharp_since.is_some_and(|since| since < round);
            let is_sharp = |i: &usize| known(*i) || and == Some(*i);
            let legs = [corner - 1, corner].map(|edge| {
                let whole = self.span(edge);
                let span = Self::between(edge, &whole, is_sharp);
                let edge_at = &self.run[edge];
                if span == whole {
                    parts(edge_at, &edge_at.curves, passage.monitored.is_some())
                } else {
                    parts(edge_at, &self.curves(edge, &span), passage.monitored.is_some())
                }
            });
            passage.time_s(legs, and.is_some())
        };
        time_with(Some(corner)) < (1.0 - GAIN) * time_with(None)
    }

    /// `None` if the speed of the sharp corner under `AX_DEV` is only known in the planner.
    fn passage<'a>(
        &self,
        (from, to): (&'a Block, &'a Block),
        kernels: &'a Kernels,
    ) -> Option<Passage<'a>> {
        let cycle = self.cycle;
        let monitored = Monitored::between([from, to], kernels, cycle).ok()?;
        let kernel_active = kernels.any();
        Some(Passage {
            from,
            bridged: &[],
            to,
            cycle,
            kernel_active,
            monitored,
            corner_share: AS_CORNER,
        })
    }
}

/// The spline over an edge, or the edge itself without one; `bent`: with its bends.
fn parts(edge: &Edge, curves: &[Curve], bent: bool) -> Vec<Part> {
    if curves.is_empty() {
        let speeds = PathSpeeds::of(&edge.block, &PathExtremes::of(&edge.block.path));
        let v_mm_s = speeds.limited(speeds.programmed_mm_s).v_mm_s;
        return vec![Part { length_mm: edge.length, v_mm_s, bend: 0.0 }];
    }
    let part = |curve: &Curve| Part::of(&curve.path, curve.path.length(), curve.v_mm_s, bent);
    curves.iter().map(part).collect()
}

/// The parts of curves within a distance from the start of the first one.
fn near<'a>(
    curves: impl Iterator<Item = &'a Curve>,
    reach_mm: f64,
    bent: bool,
) -> impl Iterator<Item = Part> {
    let mut left = reach_mm;
    curves.map_while(move |curve| {
        let length_mm = curve.path.length().min(left);
        left -= length_mm;
        (length_mm > 0.0).then(|| Part::of(&curve.path, length_mm, curve.v_mm_s, bent))
    })
}
