//! Splines through points, after Akima's paper: each coordinate is a cubic polynomial of the chord length.

use super::path::{Piece, Point, dot, plus};

/// Number of parts of a cubic whose lengths are added up.
const PARTS: usize = 64;

/// Nodes and weights of the three-point Gauss rule on -1 to 1.
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// `c0 + c1 x + c2 x^2 + c3 x^3`, `x` from 0 to 1.
#[derive(Clone, Debug)]
pub struct Cubic {
    pub coefficients: [Point; 4],
    /// Lengths from the beginning to the ends of equal parts.
    lengths: Vec<f64>,
}

impl Cubic {
    pub fn new(coefficients: [Point; 4]) -> Self {
        let mut cubic = Self { coefficients, lengths: vec![0.0] };
        for part in 0..PARTS {
            let (from, to) = (node(part), node(part + 1));
            let length = cubic.lengths[part] + cubic.between(from, to);
            cubic.lengths.push(length);
        }
        cubic
    }

    pub fn length(&self) -> f64 {
        self.lengths[PARTS]
    }

    pub fn at(&self, x: f64) -> Point {
        let [a, b, c, d] = self.coefficients;
        plus(plus(plus(a, b, x), c, x * x), d, x * x * x)
    }

    /// Point at this length from the beginning.
    pub fn at_length(&self, length: f64) -> Point {
        let part = self.lengths.partition_point(|l| *l <= length).clamp(1, PARTS) - 1;
        let (mut low, mut high) = (node(part), node(part + 1));
        let rest = length - self.lengths[part];
        let from = low;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.between(from, middle) < rest { low = middle } else { high = middle }
        }
        self.at(0.5 * (low + high))
    }

    fn between(&self, from: f64, to: f64) -> f64 {
        let [_, b, c, d] = self.coefficients;
        let half = 0.5 * (to - from);
        let speed = |x: f64| {
            let v = plus(plus(b, c, 2.0 * x), d, 3.0 * x * x);
            dot(v, v).sqrt()
        };
        // Gauss's rule on eight parts
        (0..8)
            .map(|i| {
                let (width, start) = (half / 8.0, from + f64::from(i) * half / 4.0);
                let middle = start + width;
                GAUSS
                    .iter()
                    .map(|(x, weight)| weight * width * speed(middle + x * width))
                    .sum::<f64>()
            })
            .sum()
    }
}

fn node(part: usize) -> f64 {
    part as f64 / PARTS as f64
}

/// The curve through the ends of consecutive lines.
pub fn akima(lines: &[Piece]) -> Vec<Piece> {
    let chords: Vec<f64> = lines.iter().map(|line| line.length).collect();
    let mut slopes: Vec<Point> =
        lines.iter().zip(&chords).map(|(line, l)| plus([0.0; 3], line.rise, 1.0 / l)).collect();
    // two more points on each side, on straight lines
    let (first, last) = (slopes[0], slopes[slopes.len() - 1]);
    let (second, before) =
        if slopes.len() > 1 { (slopes[1], slopes[slopes.len() - 2]) } else { (first, last) };
    let beyond = |edge: Point, next: Point, steps: f64| plus(edge, plus(edge, next, -1.0), steps);
    slopes.insert(0, beyond(first, second, 1.0));
    slopes.insert(0, beyond(first, second, 2.0));
    slopes.push(beyond(last, before, 1.0));
    slopes.push(beyond(last, before, 2.0));
    let tangent = |point: usize| -> Point {
        let m = &slopes[point..point + 4];
        std::array::from_fn(|axis| {
            let (w, v) = ((m[3][axis] - m[2][axis]).abs(), (m[1][axis] - m[0][axis]).abs());
            if w + v > 0.0 {
                (w * m[1][axis] + v * m[2][axis]) / (w + v)
            } else {
                0.5 * (m[1][axis] + m[2][axis])
            }
        })
    };
    lines
        .iter()
        .enumerate()
        .map(|(i, line)| {
            let scaled = |t: Point| plus([0.0; 3], t, chords[i]);
            let (a, b) = (scaled(tangent(i)), scaled(tangent(i + 1)));
            let way = line.rise;
            // Hermite's form
            let square = plus(plus(plus([0.0; 3], way, 3.0), a, -2.0), b, -1.0);
            let cube = plus(plus(a, b, 1.0), way, -2.0);
            Piece::cubic(line.number, Cubic::new([line.at(0.0), a, square, cube]))
        })
        .collect()
}
