//! Motions with ends moved within the plane.

use crate::exec::contour::motion::Motion;
use crate::exec::geometry::point::Point;
use kontur_motion::axis::AxisVec;
use kontur_motion::path::{LinePath, Path};

/// Start and end of a motion, replaced within the plane.
pub(super) fn ends(
    motion: &Motion,
    plane: [usize; 2],
    start: Point,
    end: Point,
) -> (AxisVec, AxisVec) {
    let place = |v: &AxisVec, p: Point| {
        let mut v = v.clone();
        (v[plane[0]], v[plane[1]]) = (p[0], p[1]);
        v
    };
    (place(motion.block.path.start(), start), place(motion.block.path.end(), end))
}

/// The line of a motion between two points of the plane; `None` if they are equal.
pub(super) fn line(motion: &Motion, plane: [usize; 2], start: Point, end: Point) -> Option<Path> {
    let (from, to) = ends(motion, plane, start, end);
    LinePath::new(from, to, &motion.block.dynamics.feed_axes).map(Path::Line)
}
