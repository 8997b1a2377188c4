//! A ball that contains a path: a path far from a point need not be examined for it.

use super::Path;
use crate::axis::AxisVec;

/// Centre and radius over all axes in mm; every point of the path is inside.
#[derive(Clone, Debug)]
pub(crate) struct Ball {
    center: AxisVec,
    radius: f64,
}

impl Ball {
    /// The ball around a path.
    pub(crate) fn around(path: &Path) -> Self {
        let mut center = path.start().clone();
        let mut square = 0.0;
        if let Path::Curve(curve) = path {
            for (c, end) in center.iter_mut().zip(path.end().iter()) {
                *c = 0.5 * (*c + end);
            }
            let radius = curve.radius_around(&center);
            return Self { center, radius };
        }
        for (i, c) in center.iter_mut().enumerate() {
            let half = match path.extent(i) {
                Some((low, high)) => {
                    *c = 0.5 * (low + high);
                    0.5 * (high - low)
                }
                None => f64::INFINITY,
            };
            square += half * half;
        }
        Self { center, radius: f64::sqrt(square) }
    }

    /// Upper bound in mm of the distance between two points of the path.
    pub(crate) fn width(&self) -> f64 {
        2.0 * self.radius
    }

    /// Lower bound in mm of the distance from `point` to any point of the path; negative for a point inside the ball.
    pub(crate) fn distance_from(&self, point: &[f64]) -> f64 {
        let mut square = 0.0;
        for (c, p) in self.center.iter().zip(point) {
            square += (c - p) * (c - p);
        }
        f64::sqrt(square) - self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::Ball;
    use crate::axis::AxisVec;
    use crate::path::{ArcPath, ArcShape, LinePath, Path, PolyPath, PolyPiece};
    use std::f64::consts::PI;

    /// A line, a helix and a curve with a loop seen from points all around: none of a thousand points of the path is
    /// nearer than the bound, and no two of them are further apart than the width.
    #[test]
    fn no_point_of_the_path_lies_outside() {
        let at = AxisVec::from_slice;
        let line = LinePath::new(at(&[1.0, -20.0, 3.0]), at(&[14.0, 7.0, 2.5]), &[true; 3]);
        let centre_mm = [3.0, -1.0];
        let shape = ArcShape { plane: [0, 1], centre_mm, sweep_rad: 1.7 * PI };
        let (sin, cos) = libm::sincos(1.7 * PI);
        let end = at(&[3.0 + 8.0 * cos, -1.0 + 8.0 * sin, 6.0]);
        let helix = ArcPath::new(at(&[11.0, -1.0, -2.0]), end, shape, &[true; 3]);
        let loops = PolyPiece::from_slice(&[
            [0.0, 40.0, -120.0, 80.0, 0.0, 0.0],
            [1.0, 30.0, -30.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, 0.0, 2.0],
        ]);
        let curve = PolyPath::through(vec![loops], &[true; 3]).unwrap();
        let paths =
            [Path::Line(line.unwrap()), Path::Arc(helix.unwrap()), Path::Curve(Box::new(curve))];
        for path in paths {
            let ball = Ball::around(&path);
            assert!(ball.radius.is_finite());
            for point in [[0.0; 3], [30.0, 5.0, -9.0], [-12.0, 40.0, 1.0], [3.0, -1.0, 2.0]] {
                for i in 0..=1000 {
                    let mut q = [0.0; 3];
                    path.position(path.length() * f64::from(i) / 1000.0, &mut q);
                    let squares = q.iter().zip(&point).map(|(q, p)| (q - p) * (q - p));
                    let distance = squares.sum::<f64>().sqrt();
                    assert!(ball.distance_from(&point) <= distance + 1e-9);
                    let squares = q.iter().zip(path.start().iter()).map(|(q, p)| (q - p) * (q - p));
                    assert!(squares.sum::<f64>().sqrt() <= ball.width() + 1e-9);
                }
            }
        }
    }
}
