//! Control areas: volumes over a polygon or a circle that the tool must not leave, or must not touch.
//!
//! Source: TF5200 programming manual, 207565195; workspace monitoring, 291148299, 291161867.

use kontur_motion::axis::AxisVec;
use kontur_motion::path::Path;

/// Smallest distance that counts, in mm.
///
/// Assumption: a path along the wall of a workspace is inside, and a path within a micrometre of a protection area touches it;
/// the documents state no resolution.
const RESOLUTION_MM: f64 = 1e-3;

/// Purpose of an area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Purpose {
    /// The tool must stay inside.
    Workspace,
    /// The tool must not touch it.
    Protection,
}

/// The base of an area.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::exec) enum Base {
    /// Corners in order; the first one is not repeated at the end.
    Polygon(Vec<[f64; 2]>),
    Circle {
        centre_mm: [f64; 2],
        radius_mm: f64,
    },
}

/// A volume.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::exec) struct Area {
    /// Its ID.
    pub(in crate::exec) number: u32,
    pub(in crate::exec) purpose: Purpose,
    pub(in crate::exec) base: Base,
    /// Axes of the base, and the axis of its extent from `low_mm` to `high_mm`.
    pub(in crate::exec) axes: [usize; 3],
    pub(in crate::exec) low_mm: f64,
    pub(in crate::exec) high_mm: f64,
}

/// Position where a path violates an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Violation {
    /// Coordinates along the axes of the area.
    pub(in crate::exec) point_mm: [f64; 3],
    /// Whether it is the start or the end of the path.
    pub(in crate::exec) at_end: bool,
}

/// Distance of two points in a plane.
fn apart(p: [f64; 2], q: [f64; 2]) -> f64 {
    libm::hypot(p[0] - q[0], p[1] - q[1])
}

/// Distance of a point from a segment.
fn from_segment(p: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let along = [b[0] - a[0], b[1] - a[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let t = ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / square;
    let t = if square > 0.0 { t.clamp(0.0, 1.0) } else { 0.0 };
    apart(p, [a[0] + t * along[0], a[1] + t * along[1]])
}

/// The sides of a polygon.
fn sides(corners: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| [*a, *b])
}

/// Whether the sides of a polygon cross or touch each other other than at their common corners.
pub(in crate::exec) fn overlaps(corners: &[[f64; 2]]) -> bool {
    let sides: Vec<_> = sides(corners).collect();
    let count = sides.len();
    (0..count).any(|i| {
        let [a, b] = sides[i];
        // the next side may only start at the end of this one
        let next = sides[(i + 1) % count];
        from_segment(next[1], [a, b]) == 0.0
            || from_segment(a, next) == 0.0
            || (i + 2..count).filter(|j| (j + 1) % count != i).any(|j| cross([a, b], sides[j]))
    })
}

/// Whether two segments have a point in common.
fn cross([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let turn = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    let apart = |x: f64, y: f64| (x > 0.0) != (y > 0.0) && x != 0.0 && y != 0.0;
    let touches = [(a, [c, d]), (b, [c, d]), (c, [a, b]), (d, [a, b])]
        .into_iter()
        .any(|(point, segment)| from_segment(point, segment) == 0.0);
    touches || (apart(turn(a, b, c), turn(a, b, d)) && apart(turn(c, d, a), turn(c, d, b)))
}

impl Base {
    /// Distance of a point from the edge, negative inside.
    fn distance(&self, p: [f64; 2]) -> f64 {
        match self {
            Self::Circle { centre_mm, radius_mm } => apart(p, *centre_mm) - radius_mm,
            Self::Polygon(corners) => {
                let edge =
                    sides(corners).map(|side| from_segment(p, side)).fold(f64::MAX, f64::min);
                let crossed = |[a, b]: &[[f64; 2]; 2]| {
                    (a[1] > p[1]) != (b[1] > p[1])
                        && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
                };
                if sides(corners).filter(crossed).count() % 2 == 1 { -edge } else { edge }
            }
        }
    }
}

impl Area {
    /// Distance of a point from the surface, negative inside.
    fn distance(&self, [x, y, z]: [f64; 3]) -> f64 {
        let base = self.base.distance([x, y]);
        let height = (self.low_mm - z).max(z - self.high_mm);
        if base > 0.0 && height > 0.0 { libm::hypot(base, height) } else { base.max(height) }
    }

    /// Distance by which a point violates the area; not above 0 for an admissible point.
    fn excess(&self, point: [f64; 3]) -> f64 {
        let distance = self.distance(point);
        match self.purpose {
            Purpose::Workspace => distance - RESOLUTION_MM,
            Purpose::Protection => RESOLUTION_MM - distance,
        }
    }

    /// Whether these axis positions are admissible for the tool.
    pub(in crate::exec) fn admits(&self, positions_mm: &[f64]) -> bool {
        self.excess(self.axes.map(|axis| positions_mm[axis])) <= 0.0
    }

    /// The first position where a path, shifted by `offsets_mm`, violates the area.
    pub(in crate::exec) fn violation(
        &self,
        path: &Path,
        offsets_mm: &AxisVec,
    ) -> Option<Violation> {
        let length = path.length();
        let mut positions = path.start().clone();
        let mut point = |s: f64| {
            path.position(s, &mut positions);
            self.axes.map(|axis| positions[axis] + offsets_mm[axis])
        };
        let [start, end] = [point(0.0), point(length)];
        if self.excess(start) > 0.0 {
            return Some(Violation { point_mm: start, at_end: true });
        }
        // along a wall of a workspace the search below would advance in steps of a micrometre
        let in_height = self.purpose == Purpose::Workspace && self.keeps_height(path, offsets_mm);
        if in_height && self.keeps_base(path, offsets_mm, [start, end]) {
            return None;
        }
        let excess = |point: [f64; 3]| {
            if in_height {
                self.base.distance([point[0], point[1]]) - RESOLUTION_MM
            } else {
                self.excess(point)
            }
        };
        let speed = self.speed_bound(path);
        let least = RESOLUTION_MM / speed;
        let mut found = None;
        let mut open = vec![(0.0, length)];
        while let Some((from, to)) = open.pop() {
            let middle = 0.5 * (from + to);
            let here = point(middle);
            let excess = excess(here);
            if excess > 0.0 {
                found = Some(Violation { point_mm: here, at_end: false });
                open.clear();
                if to - from > least {
                    open.push((from, middle));
                }
            } else if -excess < 0.5 * (to - from) * speed && to - from > least {
                open.push((middle, to));
                open.push((from, middle));
            }
        }
        // if the end violates the area as well, the programmed position is reported
        if self.excess(end) > 0.0 {
            return Some(Violation { point_mm: end, at_end: true });
        }
        found
    }

    /// Upper bound for the speed of the monitored point along a path, hence for the change of its distance.
    fn speed_bound(&self, path: &Path) -> f64 {
        let mut tangent = path.start().clone();
        path.tangent(0.0, &mut tangent);
        let squares = self.axes.iter().map(|axis| tangent[*axis] * tangent[*axis]);
        squares.sum::<f64>().sqrt().max(1.0)
    }

    /// Whether a path stays between the limits of a workspace along its extent.
    fn keeps_height(&self, path: &Path, offsets_mm: &AxisVec) -> bool {
        let axis = self.axes[2];
        path.extent(axis).is_some_and(|(low, high)| {
            low + offsets_mm[axis] >= self.low_mm - RESOLUTION_MM
                && high + offsets_mm[axis] <= self.high_mm + RESOLUTION_MM
        })
    }

    /// Whether the base of a workspace certainly contains a path: a line, or an arc in a circle.
    fn keeps_base(&self, path: &Path, offsets_mm: &AxisVec, ends: [[f64; 3]; 2]) -> bool {
        let [from, to] = ends.map(|[x, y, _]| [x, y]);
        let is_in = |p: [f64; 2]| self.base.distance(p) <= RESOLUTION_MM;
        match (path, &self.base) {
            (Path::Line(_), Base::Circle { .. }) => is_in(from) && is_in(to),
            (Path::Line(_), Base::Polygon(corners)) => {
                // between two intersections with the sides a line is either inside or outside
                let mut places: Vec<f64> =
                    sides(corners).filter_map(|side| meeting([from, to], side)).collect();
                places.extend([0.0, 1.0]);
                places.sort_by(f64::total_cmp);
                let at = |t: f64| [0, 1].map(|i| from[i] + t * (to[i] - from[i]));
                is_in(from)
                    && is_in(to)
                    && places.windows(2).all(|w| is_in(at(0.5 * (w[0] + w[1]))))
            }
            (Path::Arc(arc), Base::Circle { centre_mm, radius_mm }) => {
                let plane = arc.shape().plane;
                let [Some(first), Some(second)] = [self.axes[0], self.axes[1]]
                    .map(|axis| plane.iter().position(|of_arc| *of_arc == axis))
                else {
                    return false;
                };
                let shifted = [0, 1].map(|i| arc.shape().centre_mm[i] + offsets_mm[plane[i]]);
                let centre = [shifted[first], shifted[second]];
                // the farthest point of the full circle of the arc
                apart(centre, *centre_mm) + arc.radius() <= radius_mm + RESOLUTION_MM
            }
            _ => false,
        }
    }
}

/// Intersection of a segment with a side, as a share of the length of the segment.
fn meeting([from, to]: [[f64; 2]; 2], [a, b]: [[f64; 2]; 2]) -> Option<f64> {
    let along = [to[0] - from[0], to[1] - from[1]];
    let side = [b[0] - a[0], b[1] - a[1]];
    let cross = along[0] * side[1] - along[1] * side[0];
    let t = ((a[0] - from[0]) * side[1] - (a[1] - from[1]) * side[0]) / cross;
    (0.0..=1.0).contains(&t).then_some(t)
}
