//! Whether the spline at a corner takes no longer than the corner itself.
//!
//! Each corner is judged for itself, with the spline as if all other corners were rounded. Corners with control points of
//! their own do not depend on each other. At the others an end of the spline bends it more at the corners next to it: these
//! stay sharp only if that, too, is faster.

use super::Splining;
use super::edge::{Curve, Edge};
use crate::limits::{PathExtremes, PathSpeeds};
use crate::worth::{Part, Passage};

/// Part of the time that an end of the spline at a smooth corner has to save: less is an accident of the pieces.
const GAIN: f64 = 0.01;

impl Splining {
    /// True if the spline takes no longer than the sharp corner at the start of an edge.
    pub(super) fn is_worth(&self, corner: usize, kernel_active: bool) -> bool {
        let (from, to) = (&self.run[corner - 1], &self.run[corner]);
        let (a, b) = (&from.block, &to.block);
        // only the planner knows the speed of a sharp corner under AX_DEV; an end speed is programmed explicitly
        let monitored = [a, b].iter().any(|b| b.tolerance.ax_dev_mm.is_some());
        if monitored || a.end_velocity_mm_s.is_some() || a.dynamics.stop_at_transitions {
            return true;
        }
        // beyond its own control points the spline is the edge
        let reach = |edge: &Edge| to.corner.e.map_or(0.5 * edge.length, |e| 2.0 * e);
        let (pre_mm, post_mm) = (reach(from), reach(to));
        let mut parts: Vec<Part> = near(from.curves.iter().rev(), pre_mm).collect();
        parts.reverse();
        parts.extend(near(to.curves.iter(), post_mm));
        let passage = Passage { from: a, bridged: &[], to: b, cycle: self.cycle, kernel_active };
        if passage.is_worth(&parts, pre_mm, post_mm) {
            return true;
        }
        if to.corner.e.is_some() {
            return false;
        }
        // an end of the spline bends it more next to it
        let edges = [corner - 1, corner];
        let round = edges.map(|edge| self.parts(edge, None)).concat();
        let [before, after] = edges.map(|edge| self.parts(edge, Some(corner)));
        let kink = Part { length_mm: 0.0, v_mm_s: passage.sharp_mm_s() };
        let sharp = [before, vec![kink], after].concat();
        (1.0 - GAIN) * passage.time_s(&round) <= passage.time_s(&sharp)
    }

    /// The spline over an edge, between the sharp corners known so far and one more.
    fn parts(&self, edge: usize, also: Option<usize>) -> Vec<Part> {
        let curves = self.curves(edge, &self.between_sharp(edge, &self.span(edge), also));
        let edge = &self.run[edge];
        if curves.is_empty() {
            let speeds = PathSpeeds::of(&edge.block, &PathExtremes::of(&edge.block.path));
            let v_mm_s = speeds.limited(speeds.programmed_mm_s).v_mm_s;
            return vec![Part { length_mm: edge.length, v_mm_s }];
        }
        curves.iter().map(|c| Part { length_mm: c.path.length(), v_mm_s: c.v_mm_s }).collect()
    }
}

/// The parts of curves within a distance from the first one's start.
fn near<'a>(curves: impl Iterator<Item = &'a Curve>, reach_mm: f64) -> impl Iterator<Item = Part> {
    let mut left = reach_mm;
    curves.map_while(move |curve| {
        let length_mm = curve.path.length().min(left);
        left -= length_mm;
        (length_mm > 0.0).then_some(Part { length_mm, v_mm_s: curve.v_mm_s })
    })
}
