//! Decaying vibrations fitted to a record by least squares: what the band-limited decrement says is the start.
//!
//! From the largest swing on the record is taken as `c + sum e^(-s t) (a cos w t + b sin w t)`; Levenberg and Marquardt's
//! method improves all coefficients together, so that neither noise nor neighbouring vibrations bend the damping.

use std::f64::consts::PI;

/// Coefficients of one vibration beside the constant.
const PER_MODE: usize = 4;
/// Amplitude ratio at which a vibration has decayed.
const DECAYED_RATIO: f64 = 0.01;
/// Samples that are fitted; longer records are thinned out.
const MOST_SAMPLES: usize = 8192;
/// Steps tried.
const STEPS: usize = 60;
/// Relative gain of a step at which the fit has ended.
const CONVERGED_RATIO: f64 = 1e-10;
/// A fit this many times away from where it started has found something else.
const TRUSTED_RATIO: f64 = 3.0;

/// Undamped frequency in Hz and damping ratio of one vibration.
pub(super) type Vibration = (f64, f64);

/// The vibrations after the fit, in their order; `None` where it found nothing near the start.
pub(super) fn refine(samples: &[f64], rate_hz: f64, start: &[Vibration]) -> Vec<Option<Vibration>> {
    let Some(points) = free_decay(samples, rate_hz, start) else { return vec![None; start.len()] };
    let mut fit = Fit::new(start);
    fit.linear(&points);
    fit.improve(&points);
    start.iter().enumerate().map(|(i, from)| near(fit.vibration(i), *from)).collect()
}

fn near((f_hz, damping): Vibration, from: Vibration) -> Option<Vibration> {
    let close = |is: f64, was: f64| is > was / TRUSTED_RATIO && is < was * TRUSTED_RATIO;
    let sound = f_hz.is_finite() && (0.0..1.0).contains(&damping);
    (sound && close(f_hz, from.0) && close(damping, from.1)).then_some((f_hz, damping))
}

/// Time in s and value of the samples from the largest swing to the end of the slowest decay.
fn free_decay(samples: &[f64], rate_hz: f64, start: &[Vibration]) -> Option<Vec<[f64; 2]>> {
    let size = |i: usize| samples.get(i).map_or(0.0, |x| x.abs());
    let first = (0..samples.len()).reduce(|best, i| if size(i) > size(best) { i } else { best })?;
    let lasts = start.iter().map(|(f_hz, z)| -libm::log(DECAYED_RATIO) / (2.0 * PI * f_hz * z));
    let seconds = lasts.fold(0.0, f64::max);
    let count = ((seconds * rate_hz) as usize).min(samples.len() - first);
    let stride = count.div_ceil(MOST_SAMPLES).max(1);
    let points: Vec<[f64; 2]> = samples[first..first + count]
        .iter()
        .enumerate()
        .step_by(stride)
        .map(|(i, x)| [i as f64 / rate_hz, *x])
        .collect();
    (points.len() > 4 * (1 + PER_MODE * start.len())).then_some(points)
}

/// Coefficients: the constant, then `a, b, s, w` of every vibration.
#[derive(Clone)]
struct Fit {
    p: Vec<f64>,
}

impl Fit {
    fn new(start: &[Vibration]) -> Self {
        let mut p = vec![0.0];
        for (f_hz, z) in start {
            let w = 2.0 * PI * f_hz;
            p.extend([0.0, 0.0, z * w, w * (1.0 - z * z).sqrt()]);
        }
        Self { p }
    }

    fn vibration(&self, i: usize) -> Vibration {
        let [_, _, s, w] = self.mode(i);
        let undamped = libm::hypot(s, w);
        (undamped / (2.0 * PI), s / undamped)
    }

    fn mode(&self, i: usize) -> [f64; PER_MODE] {
        let at = 1 + PER_MODE * i;
        [self.p[at], self.p[at + 1], self.p[at + 2], self.p[at + 3]]
    }

    /// Value at a time, and its derivatives by the coefficients.
    fn at(&self, t: f64, row: &mut [f64]) -> f64 {
        row[0] = 1.0;
        let mut value = self.p[0];
        for (i, part) in row[1..].chunks_exact_mut(PER_MODE).enumerate() {
            let [a, b, s, w] = self.mode(i);
            let e = libm::exp(-s * t);
            let (sin, cos) = (e * libm::sin(w * t), e * libm::cos(w * t));
            let y = a * cos + b * sin;
            part.copy_from_slice(&[cos, sin, -t * y, t * (b * cos - a * sin)]);
            value += y;
        }
        value
    }

    fn error(&self, points: &[[f64; 2]]) -> f64 {
        let mut row = vec![0.0; self.p.len()];
        points.iter().map(|[t, x]| x - self.at(*t, &mut row)).map(|e| e * e).sum()
    }

    /// Normal equations of the coefficients in `used`.
    fn normal(&self, points: &[[f64; 2]], used: &[usize]) -> (Vec<Vec<f64>>, Vec<f64>) {
        let n = used.len();
        let (mut matrix, mut right) = (vec![vec![0.0; n]; n], vec![0.0; n]);
        let mut row = vec![0.0; self.p.len()];
        for [t, x] in points {
            let e = x - self.at(*t, &mut row);
            for (i, &u) in used.iter().enumerate() {
                right[i] += row[u] * e;
                for (j, &v) in used.iter().enumerate() {
                    matrix[i][j] += row[u] * row[v];
                }
            }
        }
        (matrix, right)
    }

    /// Amplitudes and constant for the present frequencies and decays.
    fn linear(&mut self, points: &[[f64; 2]]) {
        let is_linear = |i: &usize| *i == 0 || (i - 1) % PER_MODE < 2;
        let used: Vec<usize> = (0..self.p.len()).filter(is_linear).collect();
        let (matrix, right) = self.normal(points, &used);
        if let Some(step) = solve(matrix, right) {
            for (&i, d) in used.iter().zip(step) {
                self.p[i] += d;
            }
        }
    }

    fn improve(&mut self, points: &[[f64; 2]]) {
        let all: Vec<usize> = (0..self.p.len()).collect();
        let mut damping = 1e-3;
        let mut error = self.error(points);
        for _ in 0..STEPS {
            let (mut matrix, right) = self.normal(points, &all);
            for (i, row) in matrix.iter_mut().enumerate() {
                row[i] *= 1.0 + damping;
            }
            let mut next = self.clone();
            let Some(step) = solve(matrix, right) else { return };
            for (p, d) in next.p.iter_mut().zip(step) {
                *p += d;
            }
            let better = next.error(points);
            if better < error {
                let gain = error - better;
                (*self, damping) = (next, damping * 0.2);
                if gain <= CONVERGED_RATIO * error {
                    return;
                }
                error = better;
            } else {
                damping *= 5.0;
            }
        }
    }
}

/// Solves linear equations; `None` if they are singular.
fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let n = right.len();
    for k in 0..n {
        let pivot =
            (k..n).reduce(|a, b| if matrix[b][k].abs() > matrix[a][k].abs() { b } else { a })?;
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        let head = matrix[k].clone();
        if head[k].abs() < f64::MIN_POSITIVE {
            return None;
        }
        for i in k + 1..n {
            let factor = matrix[i][k] / head[k];
            for (x, h) in matrix[i][k..].iter_mut().zip(&head[k..]) {
                *x -= factor * h;
            }
            right[i] -= factor * right[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| matrix[k][j] * right[j]).sum();
        right[k] = (right[k] - known) / matrix[k][k];
    }
    right.iter().all(|x| x.is_finite()).then_some(right)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without noise the fit is exact, from a start that is 10 % off.
    #[test]
    fn two_vibrations_are_found_again() {
        let real = [(8.0, 0.03), (11.0, 0.08)];
        let samples: Vec<f64> = (0..3000)
            .map(|i| f64::from(i) / 1000.0)
            .map(|t| {
                let part = |(f, z): (f64, f64), a: f64| {
                    let w = 2.0 * PI * f;
                    a * libm::exp(-z * w * t) * libm::cos(w * (1.0 - z * z).sqrt() * t)
                };
                0.2 + part(real[0], 1.0) + part(real[1], 0.7)
            })
            .collect();
        let start = real.map(|(f, z)| (1.02 * f, 1.2 * z));
        for (found, (f, z)) in refine(&samples, 1000.0, &start).iter().zip(real) {
            let (is_f, is_z) = found.unwrap();
            assert!((is_f - f).abs() < 1e-6 && (is_z - z).abs() < 1e-6, "{is_f} {is_z}");
        }
    }

    #[test]
    fn equations() {
        let x = solve(vec![vec![0.0, 2.0], vec![1.0, 1.0]], vec![4.0, 5.0]).unwrap();
        assert!((x[0] - 3.0).abs() < 1e-15 && (x[1] - 2.0).abs() < 1e-15);
        assert_eq!(solve(vec![vec![1.0, 1.0]; 2], vec![1.0, 2.0]), None);
    }
}
