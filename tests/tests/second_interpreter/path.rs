//! Lines, arcs, helices and cubic curves of the model, by their lengths.

use super::map::Map;
use super::spline::Cubic;

pub type Point = [f64; 3];

pub fn plus(a: Point, b: Point, times: f64) -> Point {
    std::array::from_fn(|i| a[i] + times * b[i])
}

pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn norm(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// `centre + cos(t) u + sin(t) v + t / angle * rise`, `t` from 0 to `angle`; a line is its rise.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Number of the motion block.
    pub number: usize,
    pub centre: Point,
    pub u: Point,
    pub v: Point,
    pub angle: f64,
    pub rise: Point,
    /// A curve in place of all of these.
    pub cubic: Option<Box<Cubic>>,
    pub length: f64,
}

impl Piece {
    pub fn line(number: usize, from: Point, to: Point) -> Self {
        let rise = plus(to, from, -1.0);
        let zero = [0.0; 3];
        let (cubic, length) = (None, norm(rise));
        Self { number, centre: from, u: zero, v: zero, angle: 0.0, rise, cubic, length }
    }

    /// An arc about a centre from `centre + u` towards `v`, which is as long as `u` and perpendicular to it.
    pub fn arc(number: usize, centre: Point, [u, v]: [Point; 2], angle: f64, rise: Point) -> Self {
        let length = (dot(u, u) * angle * angle + dot(rise, rise)).sqrt();
        Self { number, centre, u, v, angle, rise, cubic: None, length }
    }

    pub fn cubic(number: usize, cubic: Cubic) -> Self {
        let (from, to, length) = (cubic.at(0.0), cubic.at(1.0), cubic.length());
        Self { cubic: Some(Box::new(cubic)), length, ..Self::line(number, from, to) }
    }

    /// Transformed by a rigid motion or a reflection.
    pub fn moved(&self, map: &Map) -> Self {
        if let Some(cubic) = &self.cubic {
            let [at, b, c, d] = cubic.coefficients;
            let [b, c, d] = [b, c, d].map(|v| map.direction(v));
            return Self::cubic(self.number, Cubic::new([map.of(at), b, c, d]));
        }
        Self {
            centre: map.of(self.centre),
            u: map.direction(self.u),
            v: map.direction(self.v),
            rise: map.direction(self.rise),
            ..self.clone()
        }
    }

    /// Position at this fraction of the piece.
    pub fn at(&self, share: f64) -> Point {
        if let Some(cubic) = &self.cubic {
            return cubic.at_length(share * self.length);
        }
        let (s, c) = libm::sincos(self.angle * share);
        plus(plus(plus(self.centre, self.u, c), self.v, s), self.rise, share)
    }
}

/// The whole path driven.
#[derive(Clone, Debug, Default)]
pub struct Driven {
    pub pieces: Vec<Piece>,
    /// Path lengths at the beginnings of the pieces.
    starts: Vec<f64>,
    pub length: f64,
}

impl Driven {
    pub fn push(&mut self, piece: Piece) {
        self.starts.push(self.length);
        self.length += piece.length;
        self.pieces.push(piece);
    }

    /// The piece at a path length, and the distance from its beginning.
    pub fn find(&self, s: f64) -> Option<(&Piece, f64)> {
        let next = self.starts.partition_point(|start| *start <= s);
        let i = next.checked_sub(1)?;
        Some((&self.pieces[i], (s - self.starts[i]).max(0.0)))
    }
}
