//! Geometry of programs as the tests know it, without any of the paths of kontur: lines, circles, helices and the curve that replaces a
//! corner. Distances come from Newton's method applied to these formulas.

/// A point or vector of the three main axes in mm.
pub type Point = [f64; 3];

/// One curve, with a parameter from 0 to 1.
#[derive(Clone, Debug)]
pub enum Piece {
    /// Straight line between two points.
    Line(Point, Point),
    /// Circle in X and Y, Z linear with the angle.
    Helix {
        /// Centre in X and Y.
        centre: [f64; 2],
        /// Radius in mm.
        radius: f64,
        /// Angle at the start in rad.
        from: f64,
        /// Angle passed in rad, with its sign.
        sweep: f64,
        /// Z at the start and at the end.
        z: [f64; 2],
    },
    /// One half of the symmetric curve that replaces the corner `c` between two lines: `c - d alpha a + d beta b`,
    /// `alpha = 1 - x + x^3/4 - x^4/16`, `beta = x^3/4 - x^4/16`; `a`, `b` are unit vectors of the direction of travel
    /// (both reversed for the second half).
    Rounding {
        /// The corner.
        c: Point,
        /// Corner distance in mm.
        d: f64,
        /// Direction of the line that this half touches.
        a: Point,
        /// Direction of the other line.
        b: Point,
    },
}

/// Difference of two points.
pub fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Scalar product.
pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Length of a vector.
pub fn norm(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// Unit vector from `a` to `b`.
pub fn direction(a: Point, b: Point) -> Point {
    let d = minus(b, a);
    let n = norm(d);
    d.map(|c| c / n)
}

impl Piece {
    /// Both halves of the curve that replaces the corner `c` between lines with the directions `u1`, `u2`.
    pub fn corner(c: Point, d: f64, u1: Point, u2: Point) -> [Self; 2] {
        let back = |u: Point| u.map(|c| -c);
        [Self::Rounding { c, d, a: u1, b: u2 }, Self::Rounding { c, d, a: back(u2), b: back(u1) }]
    }

    /// Position and its first two derivatives with respect to the parameter.
    fn at(&self, u: f64) -> [Point; 3] {
        match self {
            Self::Line(a, b) => {
                let d = minus(*b, *a);
                [[0, 1, 2].map(|i| a[i] + u * d[i]), d, [0.0; 3]]
            }
            Self::Helix { centre, radius, from, sweep, z } => {
                let angle = from + u * sweep;
                let (s, c) = (libm::sin(angle), libm::cos(angle));
                let (r1, r2) = (radius * sweep, radius * sweep * sweep);
                [
                    [centre[0] + radius * c, centre[1] + radius * s, z[0] + u * (z[1] - z[0])],
                    [-r1 * s, r1 * c, z[1] - z[0]],
                    [-r2 * c, -r2 * s, 0.0],
                ]
            }
            Self::Rounding { c, d, a, b } => {
                let bulge = [
                    u * u * u / 4.0 - u * u * u * u / 16.0,
                    0.75 * u * u - 0.25 * u * u * u,
                    1.5 * u - 0.75 * u * u,
                ];
                let line = [1.0 - u, -1.0, 0.0];
                [0, 1, 2].map(|k| {
                    [0, 1, 2].map(|i| {
                        let corner = if k == 0 { c[i] } else { 0.0 };
                        corner - d * (line[k] + bulge[k]) * a[i] + d * bulge[k] * b[i]
                    })
                })
            }
        }
    }

    /// Point at a parameter.
    pub fn point(&self, u: f64) -> Point {
        self.at(u)[0]
    }

    /// Last point.
    pub fn end(&self) -> Point {
        self.point(1.0)
    }

    /// Direction of travel at the end, a unit vector.
    pub fn end_direction(&self) -> Point {
        let d = self.at(1.0)[1];
        let n = norm(d);
        d.map(|c| c / n)
    }

    /// Shortest vector from the piece to a point.
    pub fn shortest(&self, p: Point) -> Point {
        let samples: u32 = match self {
            Self::Line(..) => 1,
            Self::Helix { sweep, .. } => 8 + (6.0 * sweep.abs()) as u32,
            Self::Rounding { .. } => 8,
        };
        let at = |u: f64| minus(p, self.at(u)[0]);
        let grid: Vec<(f64, f64)> = (0..=samples)
            .map(|k| f64::from(k) / f64::from(samples))
            .map(|u| (u, norm(at(u))))
            .collect();
        let mut best = at(0.0);
        for (k, &(u, far)) in grid.iter().enumerate() {
            let beside = |i: Option<usize>| i.and_then(|i| grid.get(i)).map_or(f64::MAX, |g| g.1);
            if beside(k.checked_sub(1)) < far || beside(Some(k + 1)) < far {
                continue;
            }
            // the derivative of the squared distance is zero there
            let mut u = u;
            for _ in 0..12 {
                let [q, d1, d2] = self.at(u);
                let e = minus(p, q);
                let curvature = dot(d1, d1) - dot(e, d2);
                let slope = if curvature > 0.0 { curvature } else { dot(d1, d1) };
                let step = if slope > 0.0 { dot(e, d1) / slope } else { 0.0 };
                u = (u + step).clamp(0.0, 1.0);
            }
            for candidate in [at(u), at(grid[k].0)] {
                if norm(candidate) < norm(best) {
                    best = candidate;
                }
            }
        }
        best
    }
}

/// Largest component of the shortest vector from several pieces to a point.
pub fn deviation<'a>(pieces: impl Iterator<Item = &'a Piece>, p: Point) -> f64 {
    let shortest = pieces.map(|q| q.shortest(p)).min_by(|a, b| norm(*a).total_cmp(&norm(*b)));
    shortest.map_or(0.0, |v| v.iter().fold(0.0, |m: f64, c| m.max(c.abs())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: Point, b: Point) {
        assert!(norm(minus(a, b)) < 1e-12, "{a:?} {b:?}");
    }

    #[test]
    fn shortest_vectors() {
        let line = Piece::Line([0.0; 3], [2.0, 0.0, 0.0]);
        near(line.shortest([1.0, 0.3, -0.2]), [0.0, 0.3, -0.2]);
        near(line.shortest([3.0, 1.0, 0.0]), [1.0, 1.0, 0.0]);
        let quarter = std::f64::consts::FRAC_PI_2;
        let arc = Piece::Helix {
            centre: [1.0, 1.0],
            radius: 2.0,
            from: 0.0,
            sweep: quarter,
            z: [0.0; 2],
        };
        let on = 1.0 + 2.5 * std::f64::consts::FRAC_1_SQRT_2;
        let e = 0.5 * std::f64::consts::FRAC_1_SQRT_2;
        near(arc.shortest([on, on, 0.0]), [e, e, 0.0]);
        near(arc.end(), [1.0, 3.0, 0.0]);
        near(arc.end_direction(), [-1.0, 0.0, 0.0]);
    }

    /// The middle is 3/8 d sin(theta/2) from the corner; the ends lie on the lines.
    #[test]
    fn a_rounded_corner() {
        let (c, d) = ([1.0, 2.0, 3.0], 0.4);
        let [first, second] = Piece::corner(c, d, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        near(first.at(0.0)[0], [0.6, 2.0, 3.0]);
        near(second.at(0.0)[0], [1.0, 2.4, 3.0]);
        near(first.end(), second.end());
        let middle = norm(minus(first.end(), c));
        assert!((middle - 0.375 * d * std::f64::consts::FRAC_1_SQRT_2).abs() < 1e-15);
    }
}
