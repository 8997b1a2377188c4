//! Penalised regression spline: the control points of a row of points.
//!
//! The control points `c` minimise `sum w |F(t_i) - p_i|^2 + sum l^6 |F'''|^2`, the second sum over the knot intervals
//! (Eilers and Marx 1996, with the third derivative instead of differences; de Boor, *A Practical Guide to Splines*, for
//! the basis). For `w = 1` a wave of length `2 pi / k` keeps `1 / (1 + (k l)^6)` of its amplitude: waves shorter than
//! `2 pi l` vanish, and a circle of radius `r` shrinks by at most `l^6 / r^5`. The third derivative is the jerk of the
//! path at constant speed.
//!
//! `l` is shorter where the path has a small radius: a circle that would shrink by as much as its points may move would
//! be shaped by those limits instead of the spline, with a jump of the curvature at each of them. It is also shorter
//! near both ends, where the curvature rises from 0.
//!
//! Every point stays within its limit from the curve: the weights of points that would exceed it are increased until
//! they do not (multipliers of the bounds).
//!
//! A curve through the points is up to the sagitta of its chords outside the polygon. The curve is moved inwards by half
//! of it, which halves the deviation.

use super::knots::{Spline, evened};

/// Bounds of `l`: as a multiple of the knot interval, and in mm. Rounding matters for chords below the latter, and the
/// bends it causes are shorter.
const REACH_INTERVALS: f64 = 20.0;
const REACH_MM: f64 = 0.4;
/// Share of the limit of its points by which a circle may shrink. With a tenth a circle of 1 mm in chords of 0.02 mm
/// takes 13 % longer.
const SHRINKS: f64 = 0.02;
/// Distance in mm of the points that a curvature is taken from: rounding to three decimals changes it by up to 0.05 1/mm.
const SPAN: f64 = 0.2;
/// Rounds of weights, and the share of its limit to which they bring a point.
const ROUNDS: usize = 12;
const AIM: f64 = 0.9;
/// Share of the square of a chord times the curvature by which the curve moves inwards: half the sagitta.
const INWARDS: f64 = 1.0 / 16.0;
/// Number of chords on either side of which the largest counts there.
const CHORDS: usize = 3;

/// Rows of a symmetric matrix: the diagonal, and the three elements before it.
type Bands = Vec<[f64; 4]>;

/// Largest curvature around every point, in the reciprocal unit of the parameters, from points so far apart that noise
/// hardly changes it.
pub(super) fn bends(at: &[f64], axes: &[&[f64]]) -> Vec<f64> {
    let count = at.len();
    let mut own = vec![0.0; count];
    for (i, own) in own.iter_mut().enumerate() {
        let from = at.partition_point(|t| *t <= at[i] - SPAN).max(1) - 1;
        let to = at.partition_point(|t| *t < at[i] + SPAN).min(count - 1);
        if at[i] - at[from] >= SPAN && at[to] - at[i] >= SPAN {
            let [a, b] = [at[i] - at[from], at[to] - at[i]];
            let second = |p: &[f64]| 2.0 * ((p[to] - p[i]) / b - (p[i] - p[from]) / a) / (a + b);
            *own = axes.iter().map(|p| second(p) * second(p)).sum::<f64>().sqrt();
        }
    }
    let around = |i: usize| {
        let from = at.partition_point(|t| *t < at[i] - 2.0 * SPAN);
        let to = at.partition_point(|t| *t <= at[i] + 2.0 * SPAN);
        own[from..to].iter().copied().fold(0.0, f64::max)
    };
    (0..count).map(around).collect()
}

/// Factors of four control points from `first` on.
struct Equation {
    first: usize,
    factors: [f64; 4],
}

impl Equation {
    /// From the factors of the control points `j - 1..=j + 2` of `0..=n`, the outer ones of which are mirrored.
    fn new(j: usize, n: usize, [a, b, c, d]: [f64; 4]) -> Self {
        if j == 0 {
            Self { first: 0, factors: [b + 2.0 * a, c - a, d, 0.0] }
        } else if j + 1 == n {
            Self { first: n - 3, factors: [0.0, a, b - d, c + 2.0 * d] }
        } else {
            Self { first: j - 1, factors: [a, b, c, d] }
        }
    }

    /// The sum over differences from `p`.
    fn of(&self, points: &[f64], p: f64) -> f64 {
        self.factors.iter().zip(&points[self.first..]).map(|(f, c)| f * (c - p)).sum()
    }

    fn add_to(&self, bands: &mut Bands, weight: f64) {
        let f = &self.factors;
        for a in 0..4 {
            for b in 0..=a {
                bands[self.first + a][a - b] += weight * f[a] * f[b];
            }
        }
    }

    fn add_right(&self, right: &mut [f64], value: f64) {
        for (r, f) in right[self.first..].iter_mut().zip(&self.factors) {
            *r += f * value;
        }
    }
}

/// Control points by axis for points (by axis) at the parameters `at`, the outer ones at the first and the last point.
/// `room`: largest permitted distance of a point from the curve; `at_kink`: around a kink that the curve rounds. At least five points.
pub(super) fn control_points(
    knots: &[f64],
    at: &[f64],
    axes: &[&[f64]],
    room: &[f64],
    at_kink: &[bool],
) -> Vec<Vec<f64>> {
    let n = at.len() - 1;
    let frame = Spline::new(knots, &[]);
    let mut interval = 0;
    let points: Vec<Equation> = (1..n)
        .map(|i| {
            interval = frame.interval(interval, at[i]);
            Equation::new(interval, n, frame.basis(interval, at[i]))
        })
        .collect();
    let thirds: Vec<Equation> = reaches(knots, at, axes, room, at_kink)
        .iter()
        .enumerate()
        .map(|(k, l)| Equation::new(k, n, frame.third_factors(k).map(|f| f * l * l * l)))
        .collect();
    // the unknowns are differences from the points, so that what is equal stays exactly equal
    let off: Vec<Vec<f64>> = axes
        .iter()
        .map(|p| points.iter().zip(&p[1..]).map(|(e, x)| -e.of(p, *x)).collect())
        .collect();
    let mut penalty = vec![[0.0; 4]; n + 1];
    let mut pulls = vec![vec![0.0; n + 1]; axes.len()];
    for third in &thirds {
        third.add_to(&mut penalty, 1.0);
        for (pull, p) in pulls.iter_mut().zip(axes) {
            third.add_right(pull, -third.of(p, p[third.first]));
        }
    }
    let mut weights = vec![1.0_f64; n - 1];
    let mut out = pulls.clone();
    for round in 0..ROUNDS {
        let mut bands = penalty.clone();
        for (equation, weight) in points.iter().zip(&weights) {
            equation.add_to(&mut bands, *weight);
        }
        factorise(&mut bands);
        for ((out, pull), off) in out.iter_mut().zip(&pulls).zip(&off) {
            out.copy_from_slice(pull);
            for ((equation, weight), off) in points.iter().zip(&weights).zip(off) {
                equation.add_right(out, weight * off);
            }
            (out[0], out[n]) = (0.0, 0.0);
            solve(&bands, out);
        }
        let mut worst = 0.0_f64;
        for (i, equation) in points.iter().enumerate() {
            let misses = out.iter().zip(&off).map(|(x, off)| equation.of(x, 0.0) - off[i]);
            let excess = misses.map(|d| d * d).sum::<f64>().sqrt() / room[i + 1];
            weights[i] = (weights[i] * excess / AIM).max(1.0);
            worst = worst.max(excess);
        }
        if worst <= if round == 0 { AIM } else { 1.0 } {
            break;
        }
    }
    for (out, p) in out.iter_mut().zip(axes) {
        out.iter_mut().zip(*p).for_each(|(x, p)| *x += p);
    }
    moved_inwards(knots, at, out)
}

/// Largest length `l` for a knot interval.
pub(super) fn reach(interval: f64) -> f64 {
    (REACH_INTERVALS * interval).min(REACH_MM)
}

/// The length `l` for every knot interval. Around a kink the curvature is that of the kink, which `l` has to round.
fn reaches(knots: &[f64], at: &[f64], axes: &[&[f64]], room: &[f64], at_kink: &[bool]) -> Vec<f64> {
    let bends = bends(at, axes);
    let n = knots.len() - 1;
    let of_interval = |k: usize| {
        let h = knots[k + 1] - knots[k];
        let (bend, room) = (bends[k].max(bends[k + 1]), room[k].min(room[k + 1]));
        let mut l = reach(h);
        if bend > 0.0 && !(at_kink[k] || at_kink[k + 1]) {
            let middle = 0.5 * (knots[k] + knots[k + 1]);
            let to_end = (middle - knots[0]).min(knots[n] - middle);
            l = l.min(libm::pow(SHRINKS * room / libm::pow(bend, 5.0), 1.0 / 6.0));
            l = l.min((room / bend).sqrt().max(0.5 * to_end));
        }
        l.max(0.5 * h)
    };
    (0..n).map(of_interval).collect()
}

fn moved_inwards(knots: &[f64], at: &[f64], mut points: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let n = at.len() - 1;
    let longest = |i: usize| {
        let around = &at[i.saturating_sub(CHORDS)..(i + CHORDS + 1).min(n + 1)];
        around.windows(2).map(|t| t[1] - t[0]).fold(0.0, f64::max)
    };
    let mut chords: Vec<f64> = (0..=n).map(longest).collect();
    evened(&mut chords);
    let spline = Spline::new(knots, &points);
    for (axis, points) in points.iter_mut().enumerate() {
        for j in 1..n {
            points[j] += INWARDS * chords[j] * chords[j] * spline.second(axis, j);
        }
    }
    points
}

/// Factorises a matrix as `L D L^T`, with `D` in place of the diagonal. The first and the last unknown are 0.
fn factorise(bands: &mut Bands) {
    let last = bands.len() - 1;
    for i in 0..=last {
        if i == 0 || i == last {
            bands[i] = [1.0, 0.0, 0.0, 0.0];
            continue;
        }
        let mut row = bands[i];
        for back in (1..4.min(i + 1)).rev() {
            if back == i {
                row[back] = 0.0;
                continue;
            }
            // row[far] still contains the product with the diagonal
            let before = &bands[i - back];
            let known: f64 =
                (back + 1..4.min(i + 1)).map(|far| row[far] * before[far - back]).sum();
            row[back] -= known;
        }
        for back in 1..4.min(i + 1) {
            let product = row[back];
            row[back] /= bands[i - back][0];
            row[0] -= product * row[back];
        }
        bands[i] = row;
    }
}

/// Solves for a right-hand side, in place.
fn solve(factors: &Bands, x: &mut [f64]) {
    let count = x.len();
    for i in 0..count {
        for back in 1..4.min(i + 1) {
            x[i] -= factors[i][back] * x[i - back];
        }
    }
    for (x, row) in x.iter_mut().zip(factors) {
        *x /= row[0];
    }
    for i in (0..count).rev() {
        for ahead in 1..4.min(count - i) {
            x[i] -= factors[i + ahead][ahead] * x[i + ahead];
        }
    }
}
