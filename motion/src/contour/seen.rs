//! The block nearest to a point that moves from cycle to cycle.

use super::sight::Sight;
use super::{Contour, ROUNDING_MM};
use crate::axis::AxisVec;
use crate::path::Path;
use std::ops::Range;

impl Contour {
    /// As [`Contour::nearest`], using the distances known from earlier points; returns the length of the vector in mm.
    pub(crate) fn nearest_in_sight(
        &self,
        point: &[f64],
        moments: (f64, f64),
        sight: &mut Sight,
        out: &mut [f64],
    ) -> Option<f64> {
        // the numbers of axes that occur have loops of known length
        match point.len() {
            2 => self.see(&point[..2], moments, sight, &mut out[..2]),
            3 => self.see(&point[..3], moments, sight, &mut out[..3]),
            4 => self.see(&point[..4], moments, sight, &mut out[..4]),
            _ => self.see(point, moments, sight, out),
        }
    }

    #[expect(clippy::inline_always, reason = "a call would not know the number of axes")]
    #[inline(always)]
    fn see(
        &self,
        point: &[f64],
        moments: (f64, f64),
        sight: &mut Sight,
        out: &mut [f64],
    ) -> Option<f64> {
        let Range { start, end } = self.within_reach(moments, sight);
        let end = self.whole(end);
        sight.look_from(point, self.number(start)..self.number(end));
        if start >= end {
            out.fill(0.0);
            return None;
        }
        // the block that was nearest rules out most of the others
        let last = sight.nearest.and_then(|number| self.index(number));
        let guess = last.filter(|i| (start..end).contains(i)).unwrap_or(start.midpoint(end));
        let mut square = self.away(guess, point, out);
        let mut least = f64::sqrt(square);
        let mut nearest = guess;
        let way = sight.way();
        let mut seen = way + least + ROUNDING_MM;
        let clear_of_guess = way + least;
        // it is measured already
        *sight.bound(guess - start) = f64::INFINITY;
        let vector = &mut AxisVec::zeros(point.len())[..point.len()];
        let mut i = start;
        for part in sight.bounds(end - start) {
            for clear in part {
                if *clear <= seen {
                    let ball = self.blocks[i].queued.ball.as_deref();
                    let bound = ball.map_or(0.0, |ball| ball.distance_from(point));
                    if bound > least + ROUNDING_MM {
                        *clear = way + bound;
                    } else {
                        let other = self.away(i, point, vector);
                        let distance = f64::sqrt(other);
                        *clear = way + distance;
                        // of equally near blocks the first
                        if (other, i) < (square, nearest) {
                            (square, least, nearest) = (other, distance, i);
                            seen = way + least + ROUNDING_MM;
                            out.copy_from_slice(vector);
                        }
                    }
                }
                i += 1;
            }
        }
        *sight.bound(guess - start) = clear_of_guess;
        sight.nearest = Some(self.number(nearest));
        Some(least)
    }

    /// Vector to a point from the nearest one of a block given by its index, and the square of its length in mm2.
    #[expect(clippy::inline_always, reason = "a call would not know the number of axes")]
    #[inline(always)]
    fn away(&self, index: usize, point: &[f64], out: &mut [f64]) -> f64 {
        match &self.blocks[index].queued.block.path {
            Path::Line(line) => line.away(point, out),
            path => path.vector_to(point, out),
        }
    }
}
