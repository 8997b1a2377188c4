//! Points and vectors in a plane of two axes.

/// A point in the plane, first and second axis in mm.
pub(in crate::exec) type Point = [f64; 2];

pub(in crate::exec) fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(in crate::exec) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(in crate::exec) fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(in crate::exec) fn norm(a: Point) -> f64 {
    libm::hypot(a[0], a[1])
}
