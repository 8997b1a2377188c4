//! Rigid motions and reflections of the three main axes.

use super::angle::{cos_deg, sin_deg};

/// `q = m p + t`, with an orthogonal matrix `m`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Frame {
    pub(in crate::exec) m: [[f64; 3]; 3],
    pub(in crate::exec::geometry) t: [f64; 3],
}

impl Frame {
    pub(in crate::exec) const IDENTITY: Self =
        Self { m: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], t: [0.0; 3] };

    pub(in crate::exec) fn is_identity(&self) -> bool {
        *self == Self::IDENTITY
    }

    /// Whether it is a pure translation, without rotation or mirroring.
    pub(in crate::exec) fn only_shifts(&self) -> bool {
        self.m == Self::IDENTITY.m
    }

    pub(in crate::exec) fn apply(&self, p: [f64; 3]) -> [f64; 3] {
        let d = self.direction(p);
        [d[0] + self.t[0], d[1] + self.t[1], d[2] + self.t[2]]
    }

    /// The linear part.
    pub(in crate::exec) fn direction(&self, p: [f64; 3]) -> [f64; 3] {
        self.m.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2])
    }

    /// The point that [`apply`](Self::apply) maps to `q`.
    pub(in crate::exec) fn inverse(&self, q: [f64; 3]) -> [f64; 3] {
        let d = [q[0] - self.t[0], q[1] - self.t[1], q[2] - self.t[2]];
        let column = |j: usize| self.m[0][j] * d[0] + self.m[1][j] * d[1] + self.m[2][j] * d[2];
        [column(0), column(1), column(2)]
    }

    /// Composition: `inner` first, then `self`.
    pub(in crate::exec) fn after(&self, inner: &Self) -> Self {
        let column = |j: usize| self.direction([inner.m[0][j], inner.m[1][j], inner.m[2][j]]);
        let (a, b, c) = (column(0), column(1), column(2));
        let m = [[a[0], b[0], c[0]], [a[1], b[1], c[1]], [a[2], b[2], c[2]]];
        Self { m, t: self.apply(inner.t) }
    }

    /// Rotation in the plane of the main axes `a`, `b` about a centre.
    pub(in crate::exec) fn rotation(a: usize, b: usize, deg: f64, centre: [f64; 2]) -> Self {
        let (s, c) = (sin_deg(deg), cos_deg(deg));
        let mut f = Self::IDENTITY;
        (f.m[a][a], f.m[a][b], f.m[b][a], f.m[b][b]) = (c, -s, s, c);
        f.t[a] = centre[0] - (c * centre[0] - s * centre[1]);
        f.t[b] = centre[1] - (s * centre[0] + c * centre[1]);
        f
    }

    /// Mirroring of single axes.
    pub(in crate::exec) fn mirror(negative: [bool; 3]) -> Self {
        let mut f = Self::IDENTITY;
        for (i, negative) in negative.into_iter().enumerate() {
            if negative {
                f.m[i][i] = -1.0;
            }
        }
        f
    }

    /// Coordinate system: translation, then rotations about the third, the new second and the new first axis.
    ///
    /// Source: TF5200, #CS, P-CHAN-00394 (sequence ZYX).
    pub(in crate::exec) fn coordinate_system(shift: [f64; 3], deg: [f64; 3]) -> Self {
        let z = Self::rotation(0, 1, deg[2], [0.0; 2]);
        let y = Self::rotation(2, 0, deg[1], [0.0; 2]);
        let x = Self::rotation(1, 2, deg[0], [0.0; 2]);
        let mut f = z.after(&y).after(&x);
        f.t = shift;
        f
    }

    /// The plane of the main axes `a`, `b` after the transformation, if it is again a plane of two main axes: their indices in
    /// cyclic order and whether the sense of rotation is preserved.
    pub(in crate::exec) fn image_of_plane(&self, a: usize, b: usize) -> Option<([usize; 2], bool)> {
        const FLAT: f64 = 1e-12;
        let normal = (0..3).find(|r| self.m[*r][a].abs() < FLAT && self.m[*r][b].abs() < FLAT)?;
        let (i, j) = ((normal + 1) % 3, (normal + 2) % 3);
        let determinant = self.m[i][a] * self.m[j][b] - self.m[i][b] * self.m[j][a];
        Some(([i, j], determinant > 0.0))
    }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "exact values are the point")]
mod tests {
    use super::Frame;

    #[test]
    fn a_quarter_turn_is_exact_and_reversible() {
        let f = Frame::rotation(0, 1, 90.0, [10.0, 0.0]);
        assert_eq!(f.apply([20.0, 0.0, 5.0]), [10.0, 10.0, 5.0]);
        assert_eq!(f.inverse([10.0, 10.0, 5.0]), [20.0, 0.0, 5.0]);
        assert_eq!(f.image_of_plane(0, 1), Some(([0, 1], true)));
        // Y Z is mapped to X Z with the direction of X reversed
        assert_eq!(f.image_of_plane(1, 2), Some(([2, 0], true)));
    }

    #[test]
    fn coordinate_systems_turn_about_z_then_y_then_x() {
        // ZYX: the x axis of the system is rotated about Z, then about the new Y
        let f = Frame::coordinate_system([1.0, 2.0, 3.0], [0.0, 90.0, 90.0]);
        assert_eq!(f.apply([0.0; 3]), [1.0, 2.0, 3.0]);
        assert_eq!(f.direction([1.0, 0.0, 0.0]), [0.0, 0.0, -1.0]);
        assert_eq!(f.direction([0.0, 1.0, 0.0]), [-1.0, 0.0, 0.0]);
        let tilted = Frame::coordinate_system([0.0; 3], [0.0, 30.0, 0.0]);
        assert_eq!(tilted.image_of_plane(0, 1), None);
        assert_eq!(tilted.image_of_plane(2, 0), Some(([2, 0], true)));
    }

    #[test]
    fn mirroring_turns_the_sense_of_rotation() {
        let f = Frame::mirror([true, false, false]);
        assert_eq!(f.image_of_plane(0, 1), Some(([0, 1], false)));
        let both = Frame::mirror([true, true, false]);
        assert_eq!(both.image_of_plane(0, 1), Some(([0, 1], true)));
    }
}
