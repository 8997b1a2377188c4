//! The largest distance from the contour between two set points.
//!
//! Along the line between them the distance from a single straight block is convex, so it is largest at an end. The
//! distance from the contour is the minimum over all blocks, which exceeds its values at both ends only where the
//! nearest block changes. These points are roots of the difference of two distances and are computed as such: first
//! between the blocks nearest to the two ends, then, where a third block is nearer still, once more on either side. A
//! component of the vector from a straight block is linear along the line except where the nearest point reaches an end
//! of the block, so it is largest there or at an end of the line. Along a curved block the midpoint is examined.

use super::Excursion;
use crate::axis::AxisVec;
use crate::contour::{Around, Nearest, ROUNDING_MM};
use crate::path::Along;
use crate::profile::roots::enclosed_root;
use smallvec::{Array, SmallVec};

/// Largest number of points examined on one line; with more changes the blocks are so short that no distance is missed
/// between them.
const LOOKS: usize = 64;

/// Accuracy of the place of a change, as a share of the section of the line.
const PRECISION: f64 = 1e-9;

/// A point on the line, as a share of its length, and the block nearest to it.
type Foot<'a> = (f64, Nearest<'a>);

/// Collects every vector that can be the largest one between the ends of a line. `now` is the nearest block at its end
/// among those that count there.
pub(super) fn largest<'a>(
    around: &Around<'a>,
    line: (&[f64], &[f64]),
    now: Option<Nearest<'a>>,
    out: &mut Excursion,
) {
    let Some(mut now) = now else { return };
    let n = line.0.len();
    let vector = &mut AxisVec::zeros(n)[..];
    let alone = around.is_single() || now.line().is_some() && !around.may_be_nearer_than(&now);
    let then = if alone { Some(now) } else { around.nearest_of_all(line.0, vector) };
    let Some(then) = then else { return };
    if then.block != now.block
        && !around.all_count()
        && let Some(nearer) = around.nearest_of_all(line.1, vector)
    {
        out.take(vector);
        now = nearer;
    }
    let point = &mut AxisVec::zeros(n)[..];
    let other = &mut AxisVec::zeros(n)[..];
    let mut open: SmallVec<[(Foot<'a>, Foot<'a>); 4]> = SmallVec::new();
    open.push(((0.0, then), (1.0, now)));
    for _ in 0..LOOKS {
        let Some((low, high)) = open.pop() else { return };
        if low.1.block == high.1.block {
            for u in places(around, line, low, high) {
                on_the_line(line, u, point);
                let Some(found) = around.nearest_of_all(point, vector) else { return };
                out.take(vector);
                if found.block != low.1.block
                    && low.1.vector_to(point, other) > found.distance + ROUNDING_MM
                {
                    open.extend([(low, (u, found)), ((u, found), high)]);
                    break;
                }
            }
        } else {
            let u = change(line, low, high);
            on_the_line(line, u, point);
            let Some(found) = around.nearest_of_all(point, vector) else { return };
            out.take(vector);
            let near = found.distance + ROUNDING_MM;
            let of_low = low.1.vector_to(point, vector);
            let of_high = high.1.vector_to(point, other);
            if of_low > near && of_high > near {
                open.extend([(low, (u, found)), ((u, found), high)]);
            } else {
                // both are equally near
                out.take(vector);
                out.take(other);
                open.extend([(low, (u, low.1)), ((u, high.1), high)]);
            }
        }
    }
}

/// The points between two points nearest to the same block at which another vector can be larger than at both of them.
fn places(
    around: &Around<'_>,
    line: (&[f64], &[f64]),
    low: Foot<'_>,
    high: Foot<'_>,
) -> SmallVec<[f64; 3]> {
    let mut places = SmallVec::new();
    let straight = low.1.line();
    if straight.is_none() || around.may_be_nearer_than(&low.1) {
        places.push(0.5 * (low.0 + high.0));
    }
    if let Some(straight) = straight {
        push_between((low.0, high.0), straight.along(line).ends(), &mut places);
    }
    places
}

/// The point between two points of the line at which their nearest blocks are equally near.
fn change(line: (&[f64], &[f64]), low: Foot<'_>, high: Foot<'_>) -> f64 {
    if let (Some(a), Some(b)) = (low.1.line(), high.1.line()) {
        return change_of_lines((low.0, a.along(line)), (high.0, b.along(line)));
    }
    let mut point = AxisVec::zeros(line.0.len());
    let mut vector = point.clone();
    let mut nearer = |u: f64| {
        on_the_line(line, u, &mut point);
        low.1.vector_to(&point, &mut vector) - high.1.vector_to(&point, &mut vector)
    };
    let ends = [low.0, high.0].map(|u| (u, nearer(u)));
    if ends[0].1 >= 0.0 {
        low.0
    } else if ends[1].1 <= 0.0 {
        high.0
    } else {
        enclosed_root(ends[0], ends[1], PRECISION, nearer).1
    }
}

/// As [`change`], between straight blocks: between the points at which a nearest point reaches an end of its block, the
/// squares of both distances are parabolas.
fn change_of_lines(low: (f64, Along<'_>), high: (f64, Along<'_>)) -> f64 {
    let mut borders: SmallVec<[f64; 6]> = SmallVec::new();
    for block in [&low.1, &high.1] {
        push_between((low.0, high.0), block.ends(), &mut borders);
    }
    borders.sort_unstable_by(f64::total_cmp);
    borders.push(high.0);
    let mut from = low.0;
    for to in borders {
        let at = 0.5 * (from + to);
        let (a, b) = (low.1.square(at), high.1.square(at));
        let (c0, c1, c2) = (a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        let further = |u: f64| c0 + u * (c1 + u * c2);
        if further(from) >= 0.0 {
            return from;
        } else if further(to) > 0.0 {
            // where the difference crosses zero upwards
            let slope = (c1 * c1 - 4.0 * c2 * c0).max(0.0).sqrt();
            let root = if c1 > 0.0 { -2.0 * c0 / (c1 + slope) } else { (slope - c1) / (2.0 * c2) };
            return root.clamp(from, to);
        }
        from = to;
    }
    high.0
}

/// Adds those of two places that lie inside a section of the line.
fn push_between<A: Array<Item = f64>>(
    (low, high): (f64, f64),
    ends: [f64; 2],
    places: &mut SmallVec<A>,
) {
    for u in ends {
        if u > low && u < high {
            places.push(u);
        }
    }
}

/// The point at a share of the line.
#[inline]
pub(super) fn on_the_line((from, to): (&[f64], &[f64]), u: f64, point: &mut [f64]) {
    let n = point.len();
    let (from, to) = (&from[..n], &to[..n]);
    for i in 0..n {
        point[i] = from[i] + u * (to[i] - from[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contour::{Contour, Sight};
    use crate::example::{Arc, block};
    use crate::queue::Queued;
    use kontur_filters::time::CycleTime;
    use proptest::prelude::*;

    /// Straight blocks through points, one per cycle.
    fn contour(points: &[[f64; 2]]) -> Contour {
        let mut contour = Contour::default();
        let mut s_mm = 0.0;
        for (ends, i) in points.windows(2).zip(0_u32..) {
            let block = block(u64::from(i) + 1, ends[0], ends[1], 10.0);
            let length = block.path.length();
            let queued = Queued::new(block, CycleTime::from_us(1000).unwrap());
            contour.enter(f64::from(i), s_mm, Arc::new(queued));
            s_mm += length;
        }
        contour
    }

    /// What the function under test finds between two points, including the ends.
    fn found(points: &[[f64; 2]], ends: &[[f64; 2]; 2]) -> Excursion {
        let contour = contour(points);
        let line = (&ends[0][..], &ends[1][..]);
        let around =
            contour.around(line, (0.0, points.len() as f64), (1.0, 0.0), &mut Sight::default());
        let mut out = Excursion::none(2);
        let mut vector = [0.0; 2];
        for end in ends {
            around.nearest(end, &mut vector);
            out.take(&vector);
        }
        let now = around.nearest(line.1, &mut vector);
        largest(&around, line, now, &mut out);
        out
    }

    /// The same from 4,000 points on the line, each with its nearest point on each block: of the nearest block, and of
    /// every block that may be the nearest between two of these points. Also the spacing of the points.
    fn of_many_points(points: &[[f64; 2]], ends: &[[f64; 2]; 2]) -> ([Excursion; 2], f64) {
        let [from, to] = ends;
        let apart = libm::hypot(to[0] - from[0], to[1] - from[1]) / 4000.0;
        let mut out = [(); 2].map(|()| Excursion::none(2));
        for i in 0..=4000 {
            let u = f64::from(i) / 4000.0;
            let point = [0, 1].map(|i| from[i] + u * (to[i] - from[i]));
            let aside = points.windows(2).map(|block| -> [f64; 2] {
                let along = [0, 1].map(|i| block[1][i] - block[0][i]);
                let off = [0, 1].map(|i| point[i] - block[0][i]);
                let share = (along[0] * off[0] + along[1] * off[1])
                    / (along[0] * along[0] + along[1] * along[1]);
                [0, 1].map(|i| off[i] - share.clamp(0.0, 1.0) * along[i])
            });
            let length = |v: &[f64; 2]| libm::hypot(v[0], v[1]);
            let aside: Vec<[f64; 2]> = aside.collect();
            let nearest = aside.iter().min_by(|a, b| length(a).total_cmp(&length(b))).unwrap();
            out[0].take(nearest);
            // each distance changes by half the spacing at most up to the middle between two points
            let alike = |v: &&[f64; 2]| length(v) <= length(nearest) + apart;
            aside.iter().filter(alike).for_each(|v| out[1].take(v));
        }
        (out, apart)
    }

    proptest! {
        /// Any contour and any line: the largest distance is found, and every component found really occurs.
        #[test]
        fn the_largest_distance_is_found(
            points in prop::collection::vec(prop::array::uniform2(-1.0..1.0f64), 2..9),
            ends in prop::array::uniform2(prop::array::uniform2(-1.5..1.5f64)),
        ) {
            let out = found(&points, &ends);
            let ([many, alike], apart) = of_many_points(&points, &ends);
            prop_assert!((out.length - many.length).abs() <= apart, "{out:?} {many:?}");
            for (out, alike) in out.vector.iter().zip(alike.vector.iter()) {
                prop_assert!(out.abs() <= alike.abs() + 2.0 * apart, "{out} {alike}");
            }
        }

        /// Lines that are short compared with the blocks, as between two cycles: every component is found as well.
        #[test]
        fn of_a_short_line_every_component_is_found(
            points in prop::collection::vec(prop::array::uniform2(-1.0..1.0f64), 2..9),
            from in prop::array::uniform2(-1.5..1.5f64),
            step in prop::array::uniform2(-0.05..0.05f64),
        ) {
            let ends = [from, [0, 1].map(|i| from[i] + step[i])];
            let out = found(&points, &ends);
            let ([many, alike], apart) = of_many_points(&points, &ends);
            let of_points = many.vector.iter().zip(alike.vector.iter());
            for (out, (many, alike)) in out.vector.iter().zip(of_points) {
                prop_assert!(out.abs() >= many.abs() - 2.0 * apart, "{out} {many}");
                prop_assert!(out.abs() <= alike.abs() + 2.0 * apart, "{out} {alike}");
            }
        }
    }
}
