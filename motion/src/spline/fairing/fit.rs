//! Smoothing spline of third differences: the noise of a row of points, and the points without it.
//!
//! The displacements `d` of the points `p` minimise `sum w |d|^2 + sum l^6 |p''' + d'''|^2`, where the third
//! derivatives are divided differences over the distances along the polygon (Whittaker and Henderson's graduation;
//! Reinsch 1967 for the corresponding spline). For all `w = 1` a wave of length `2 pi / k` keeps `1 / (1 + (k l)^6)` of
//! its amplitude: waves shorter than `2 pi l` vanish, and a circle of radius `r` shrinks by at most `l^6 / r^5`. A
//! third difference is the jerk of the path at constant speed.
//!
//! `l` is shorter where the path has a small radius. A circle that would shrink by as much as its points may move would be
//! shaped by those limits instead of the spline, with a jump of the curvature at each of them.
//!
//! Every displacement stays within its limit: the weights of points that would exceed it are increased until they do
//! not (multipliers of the bounds).

use std::iter::zip;

/// The length `l`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    /// Upper bound as a multiple of the average distance between neighbours.
    points: f64,
    /// Upper bound in the unit of the distances.
    whole: f64,
}

impl Reach {
    /// Limited so that a circle of this curvature shrinks by no more than [`SHRINKS`] of the limit of its points.
    fn on_a_bend(self, bend: f64, room: f64) -> Self {
        let most = libm::pow(SHRINKS * room / libm::pow(bend, 5.0), 1.0 / 6.0);
        Self { whole: if bend > 0.0 { self.whole.min(most) } else { self.whole }, ..self }
    }
}

/// Largest curvature around every point, in the reciprocal unit of the distances, from points so far apart that noise
/// hardly changes it.
fn bends(knots: &[f64], axes: &[Vec<f64>]) -> Vec<f64> {
    let count = knots.len();
    let mut own = vec![0.0; count];
    for (i, own) in own.iter_mut().enumerate() {
        let from = knots.partition_point(|t| *t <= knots[i] - SPAN).max(1) - 1;
        let to = knots.partition_point(|t| *t < knots[i] + SPAN).min(count - 1);
        if knots[i] - knots[from] >= SPAN && knots[to] - knots[i] >= SPAN {
            let [a, b] = [knots[i] - knots[from], knots[to] - knots[i]];
            let second = |p: &Vec<f64>| 2.0 * ((p[to] - p[i]) / b - (p[i] - p[from]) / a) / (a + b);
            *own = axes.iter().map(|p| second(p) * second(p)).sum::<f64>().sqrt();
        }
    }
    let around = |i: usize| {
        let from = knots.partition_point(|t| *t < knots[i] - 2.0 * SPAN);
        let to = knots.partition_point(|t| *t <= knots[i] + 2.0 * SPAN);
        own[from..to].iter().copied().fold(0.0, f64::max)
    };
    (0..count).map(around).collect()
}

/// For points on a path in mm: rounding matters for chords below this length, and the bends it causes are shorter.
pub(super) const PATH: Reach = Reach { points: 20.0, whole: 0.4 };
/// For distances over the number of the point.
pub(super) const STEPS: Reach = Reach { points: 8.0, whole: f64::INFINITY };
/// Share of the limit of its points by which a circle may shrink. With a tenth a circle of 1 mm in chords of 0.02 mm
/// takes 13 % longer.
const SHRINKS: f64 = 0.02;
/// Distance in mm of the points that a curvature is taken from: rounding to three decimals changes it by up to 0.05 1/mm.
const SPAN: f64 = 0.2;
/// Rounds of weights, and the share of its limit to which they bring a point; an excess after the last round is cut
/// off. The number is the same for every row in which a point needs a weight, so that no point depends on how difficult
/// distant ones are.
const ROUNDS: usize = 12;
const AIM: f64 = 0.9;
/// Number of points in a difference that measures noise, and of points on either side for which the largest one counts:
/// rounded coordinates that hardly change keep their value for many points, and their noise is in the steps between.
const STENCIL: usize = 9;
const SPREAD: usize = 64;

/// Rows of a symmetric matrix: the diagonal, and the three elements before it.
type Bands = Vec<[f64; 4]>;

/// Magnitude of the roughness around every point, in the unit of the coordinates.
///
/// It is the eighth divided difference, divided by the root of the sum of the squares of its factors. For independent
/// errors it is their standard deviation, for a circle with steps of `t` rad it is `r t^8 / 113`.
pub(super) fn roughness(knots: &[f64], axes: &[Vec<f64>]) -> Vec<f64> {
    let count = knots.len();
    let mut own = vec![0.0; count];
    for (first, t) in knots.windows(STENCIL).enumerate() {
        let factor = |k: usize| {
            let others = (0..STENCIL).filter(|m| *m != k);
            1.0 / others.map(|m| t[k] - t[m]).product::<f64>()
        };
        let factors: [f64; STENCIL] = std::array::from_fn(factor);
        let norm2: f64 = factors.iter().map(|c| c * c).sum();
        let squares = axes.iter().map(|p| {
            let p = &p[first..first + STENCIL];
            let sum: f64 = zip(&factors, p).map(|(c, x)| c * (x - p[STENCIL / 2])).sum();
            sum * sum
        });
        own[first + STENCIL / 2] = (squares.sum::<f64>() / norm2).sqrt();
    }
    let around = |i: usize| &own[i.saturating_sub(SPREAD)..(i + SPREAD + 1).min(count)];
    (0..count).map(|i| around(i).iter().copied().fold(0.0, f64::max)).collect()
}

/// A third derivative: the factors of the four points from `first` on, times `l^3`.
fn third(knots: &[f64], first: usize, reach: Reach) -> [f64; 4] {
    let t = &knots[first..first + 4];
    let reach = (reach.points * (t[3] - t[0]) / 3.0).min(reach.whole);
    let scale = 6.0 * reach * reach * reach;
    std::array::from_fn(|k| {
        let others = (0..4).filter(|m| *m != k);
        scale / others.map(|m| t[k] - t[m]).product::<f64>()
    })
}

/// The third derivative of coordinates, difference by difference, so that it is exactly 0 where they are all equal.
fn third_of(knots: &[f64], factors: &[f64; 4], p: &[f64]) -> f64 {
    let slope = |i: usize| (p[i + 1] - p[i]) / (knots[i + 1] - knots[i]);
    let bend = |i: usize| (slope(i + 1) - slope(i)) / (knots[i + 2] - knots[i]);
    let whole = (bend(1) - bend(0)) / (knots[3] - knots[0]);
    // the last factor contains `whole` as a divisor
    factors[3] * (knots[3] - knots[0]) * (knots[3] - knots[1]) * (knots[3] - knots[2]) * whole
}

/// Displacements of the points along every axis. `room` is the largest permitted displacement of a point; with 0 it
/// stays.
pub(super) fn displacements(
    knots: &[f64],
    axes: &[Vec<f64>],
    room: &[f64],
    reach: Reach,
) -> Vec<Vec<f64>> {
    let count = knots.len();
    let mut out = vec![vec![0.0; count]; axes.len()];
    if count < 4 || room.iter().all(|r| *r <= 0.0) {
        return out;
    }
    let bends = if reach.whole.is_finite() { bends(knots, axes) } else { vec![0.0; count] };
    let thirds: Vec<[f64; 4]> = (0..count - 3)
        .map(|j| {
            let [bend, room] = [&bends[..], room].map(|of| f64::max(of[j + 1], of[j + 2]));
            third(knots, j, reach.on_a_bend(bend, room))
        })
        .collect();
    let pulls: Vec<Vec<f64>> = axes.iter().map(|p| pull(knots, &thirds, p)).collect();
    let penalty = penalty(&thirds, count);
    let mut weights = vec![1.0_f64; count];
    for round in 0..ROUNDS {
        let bands = factorised(&penalty, &weights, room);
        for (out, pull) in zip(&mut out, &pulls) {
            out.copy_from_slice(pull);
            for (x, room) in zip(out.iter_mut(), room) {
                *x = if *room > 0.0 { *x } else { 0.0 };
            }
            solve(&bands, out);
        }
        let mut worst = 0.0_f64;
        for i in 0..count {
            if room[i] > 0.0 {
                let excess = size(&out, i) / room[i];
                weights[i] = (weights[i] * excess / AIM).max(1.0);
                worst = worst.max(excess);
            }
        }
        if round == 0 && worst <= AIM {
            break;
        }
    }
    for i in 0..count {
        let size = size(&out, i);
        if size > room[i] {
            for d in &mut out {
                d[i] *= room[i] / size;
            }
        }
    }
    out
}

/// Length of the displacement of a point.
pub(super) fn size(displacements: &[Vec<f64>], i: usize) -> f64 {
    displacements.iter().map(|d| d[i] * d[i]).sum::<f64>().sqrt()
}

/// The pull of the third derivatives of the programmed points on each of them.
fn pull(knots: &[f64], thirds: &[[f64; 4]], p: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; p.len()];
    for (j, factors) in thirds.iter().enumerate() {
        let here = third_of(&knots[j..j + 4], factors, &p[j..j + 4]);
        for (o, c) in zip(&mut out[j..], factors) {
            *o -= c * here;
        }
    }
    out
}

/// The matrix of the third derivatives.
fn penalty(thirds: &[[f64; 4]], count: usize) -> Bands {
    let mut out = vec![[0.0; 4]; count];
    for (j, c) in thirds.iter().enumerate() {
        for a in 0..4 {
            for b in 0..=a {
                out[j + a][a - b] += c[a] * c[b];
            }
        }
    }
    out
}

/// The matrix with the weights, as factors `L D L^T` with `D` in place of the diagonal. Points with `room` 0 are
/// decoupled.
fn factorised(penalty: &Bands, weights: &[f64], room: &[f64]) -> Bands {
    let mut out = penalty.clone();
    for i in 0..out.len() {
        if room[i] <= 0.0 {
            out[i] = [1.0, 0.0, 0.0, 0.0];
            continue;
        }
        let mut row = out[i];
        row[0] += weights[i];
        for back in (1..4.min(i + 1)).rev() {
            if room[i - back] <= 0.0 {
                row[back] = 0.0;
                continue;
            }
            // row[far] still contains the product with the diagonal
            let before = &out[i - back];
            let known: f64 =
                (back + 1..4.min(i + 1)).map(|far| row[far] * before[far - back]).sum();
            row[back] -= known;
        }
        for back in 1..4.min(i + 1) {
            let product = row[back];
            row[back] /= out[i - back][0];
            row[0] -= product * row[back];
        }
        out[i] = row;
    }
    out
}

/// Solves for a right-hand side, in place.
fn solve(factors: &Bands, x: &mut [f64]) {
    let count = x.len();
    for i in 0..count {
        for back in 1..4.min(i + 1) {
            x[i] -= factors[i][back] * x[i - back];
        }
    }
    for (x, row) in zip(x.iter_mut(), factors) {
        *x /= row[0];
    }
    for i in (0..count).rev() {
        for ahead in 1..4.min(count - i) {
            x[i] -= factors[i + ahead][ahead] * x[i + ahead];
        }
    }
}
