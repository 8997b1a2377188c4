//! Rigid motions and reflections of the coordinates of the model.

use super::path::{Point, dot, plus};

/// Rows of a matrix, and a shift.
#[derive(Clone, Copy, Debug)]
pub struct Map {
    pub m: [Point; 3],
    pub t: Point,
}

pub const UNIT: Map = Map { m: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], t: [0.0; 3] };

impl Map {
    pub fn of(&self, p: Point) -> Point {
        plus(self.direction(p), self.t, 1.0)
    }

    pub fn direction(&self, p: Point) -> Point {
        std::array::from_fn(|i| dot(self.m[i], p))
    }

    /// The transpose: rotations and reflections are orthogonal.
    pub fn back(&self, q: Point) -> Point {
        let d = plus(q, self.t, -1.0);
        std::array::from_fn(|j| (0..3).map(|i| self.m[i][j] * d[i]).sum())
    }

    pub fn then_inner(&self, inner: &Self) -> Self {
        let column = |j: usize| self.direction(std::array::from_fn(|i| inner.m[i][j]));
        let columns = [column(0), column(1), column(2)];
        let m = std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]));
        Self { m, t: self.of(inner.t) }
    }

    pub fn shift(t: Point) -> Self {
        Self { t, ..UNIT }
    }

    /// Rotated from main axis `a` towards `b`.
    pub fn turn(a: usize, b: usize, deg: f64) -> Self {
        let (s, c) = libm::sincos(deg.to_radians());
        let mut map = UNIT;
        (map.m[a][a], map.m[a][b], map.m[b][a], map.m[b][b]) = (c, -s, s, c);
        map
    }

    pub fn scale(signs: Point) -> Self {
        let mut map = UNIT;
        for (i, sign) in signs.into_iter().enumerate() {
            map.m[i][i] = sign;
        }
        map
    }
}
