//! Least-squares fit of vibrations to a piece of a recording.
//!
//! The piece is modelled as `c0 + c1 t + c2 t^2 + sum e^(-s t) (a cos w t + b sin w t)`: offset and drift, and
//! vibrations that decay (`s > 0`) or last (`s` about 0: mains hum, a motor). The method of Levenberg and Marquardt
//! improves all coefficients together, so that neither drift nor neighbouring vibrations bias a damping. The inverse of
//! the normal equations at the end is the Cramer-Rao bound of the coefficients.

use super::detect;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Number of coefficients of offset and drift.
const DRIFT: usize = 3;
/// Number of coefficients of one vibration.
const PER_MODE: usize = 4;
/// Largest number of steps.
const STEPS: usize = 40;
/// Number of samples from one exact value of a vibration to the next.
const TURNS: usize = 64;
/// Relative gain of a step below which the fit has converged.
const CONVERGED_RATIO: f64 = 1e-9;

/// A piece of a recording; time 0 is its first sample.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// The samples.
    pub(super) samples: Vec<f64>,
    /// False where the sample is unusable: the recorder was at its limit.
    pub(super) valid: Vec<bool>,
    /// Samples per second.
    pub(super) rate_hz: f64,
}

impl Piece {
    pub(super) fn seconds(&self) -> f64 {
        self.samples.len() as f64 / self.rate_hz
    }

    /// Number of valid samples.
    fn count(&self) -> usize {
        self.valid.iter().filter(|v| **v).count()
    }
}

/// A value with the half width of its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Value.
    pub value: f64,
    /// Half width of the interval that contains the true value in 95 of 100 cases.
    pub half_width: f64,
}

/// Width of a 95 % interval in standard deviations.
const SIGMAS: f64 = 1.96;

/// One vibration of a fit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vibration {
    /// Undamped natural frequency in Hz.
    pub(super) freq: Estimate,
    /// Damping ratio.
    pub(super) damping: Estimate,
    /// Decay in 1/s.
    pub(super) decay: Estimate,
    /// Amplitude at the start of the piece.
    pub(super) amplitude: f64,
}

/// Coefficients: offset and drift, then `a, b, s, w` of every vibration.
#[derive(Clone, Debug)]
pub(super) struct Fit {
    p: Vec<f64>,
    /// Unit of the drift time in s; powers of seconds would make the equations ill-conditioned.
    seconds: f64,
}

impl Fit {
    /// Offset and drift only.
    pub(super) fn new(piece: &Piece) -> Self {
        let mut fit = Self { p: vec![0.0; DRIFT], seconds: piece.seconds() };
        fit.linear(piece);
        fit
    }

    /// Number of vibrations.
    pub(super) fn modes(&self) -> usize {
        (self.p.len() - DRIFT) / PER_MODE
    }

    fn mode(&self, i: usize) -> [f64; PER_MODE] {
        let at = DRIFT + PER_MODE * i;
        [self.p[at], self.p[at + 1], self.p[at + 2], self.p[at + 3]]
    }

    /// The fit with one more vibration, improved.
    pub(super) fn with(&self, piece: &Piece, freq_hz: f64, decay: f64) -> Self {
        let mut next = self.clone();
        next.p.extend([0.0, 0.0, decay, TAU * freq_hz]);
        next.linear(piece);
        next.improve(piece);
        next
    }

    /// The same vibrations fitted to another piece.
    pub(super) fn again(&self, piece: &Piece) -> Self {
        let mut next = Self { seconds: piece.seconds(), ..self.clone() };
        next.linear(piece);
        next.improve(piece);
        next
    }

    /// Visits the samples of a piece: index, value of the fit, and its derivatives with respect to the coefficients.
    fn over(&self, piece: &Piece, mut visit: impl FnMut(usize, f64, &[f64])) {
        let e_cos_sin = |s: f64, w: f64, t: f64| {
            let e = libm::exp(-s * t);
            let (sin, cos) = libm::sincos(w * t);
            [e * cos, e * sin]
        };
        let modes: Vec<[f64; PER_MODE]> = (0..self.modes()).map(|i| self.mode(i)).collect();
        let turns: Vec<[f64; 2]> =
            modes.iter().map(|[_, _, s, w]| e_cos_sin(*s, *w, 1.0 / piece.rate_hz)).collect();
        let mut waves = vec![[0.0; 2]; modes.len()];
        let mut row = vec![0.0; self.p.len()];
        for i in 0..piece.samples.len() {
            let t = i as f64 / piece.rate_hz;
            let u = t / self.seconds;
            row[..DRIFT].copy_from_slice(&[1.0, u, u * u]);
            let mut value = self.p[0] + u * (self.p[1] + u * self.p[2]);
            for (k, [a, b, s, w]) in modes.iter().enumerate() {
                let [cos, sin] = waves[k];
                let [turn_cos, turn_sin] = turns[k];
                // a rotation by one sample costs a tenth of the functions; exact values in between keep its rounding
                // from accumulating
                let [cos, sin] = if i % TURNS == 0 {
                    e_cos_sin(*s, *w, t)
                } else {
                    [cos * turn_cos - sin * turn_sin, cos * turn_sin + sin * turn_cos]
                };
                waves[k] = [cos, sin];
                let y = a * cos + b * sin;
                let at = DRIFT + PER_MODE * k;
                row[at..at + PER_MODE].copy_from_slice(&[
                    cos,
                    sin,
                    -t * y,
                    t * (b * cos - a * sin),
                ]);
                value += y;
            }
            visit(i, value, &row);
        }
    }

    /// Residual of the fit on the piece; 0 at invalid samples.
    pub(super) fn residual(&self, piece: &Piece) -> Vec<f64> {
        let mut residual = Vec::with_capacity(piece.samples.len());
        self.over(piece, |i, value, _| {
            residual.push(if piece.valid[i] { piece.samples[i] - value } else { 0.0 });
        });
        residual
    }

    /// The fitted curve.
    pub(super) fn curve(&self, piece: &Piece) -> Vec<f64> {
        let mut curve = Vec::with_capacity(piece.samples.len());
        self.over(piece, |_, value, _| curve.push(value));
        curve
    }

    fn error(&self, piece: &Piece) -> f64 {
        self.residual(piece).iter().map(|e| e * e).sum()
    }

    /// Normal equations of the coefficients in `used`.
    fn normal(&self, piece: &Piece, used: &[usize]) -> (DMatrix<f64>, DVector<f64>) {
        let n = used.len();
        let mut right = DVector::zeros(n);
        // lower triangle, row by row: the most expensive part
        let mut sums = vec![0.0; n * (n + 1) / 2];
        let mut picked = vec![0.0; n];
        self.over(piece, |i, value, row| {
            if !piece.valid[i] {
                return;
            }
            let e = piece.samples[i] - value;
            for (p, u) in picked.iter_mut().zip(used) {
                *p = row[*u];
            }
            let mut rest = sums.as_mut_slice();
            for (i, a) in picked.iter().enumerate() {
                right[i] += a * e;
                let (line, behind) = rest.split_at_mut(i + 1);
                for (sum, b) in line.iter_mut().zip(&picked) {
                    *sum += a * b;
                }
                rest = behind;
            }
        });
        let at = |i: usize, j: usize| sums[i * (i + 1) / 2 + j];
        (DMatrix::from_fn(n, n, |i, j| at(i.max(j), i.min(j))), right)
    }

    fn step(&mut self, used: &[usize], step: &DVector<f64>) {
        for (i, d) in used.iter().zip(step.iter()) {
            self.p[*i] += d;
        }
    }

    /// Offset, drift and amplitudes for the present frequencies and decays.
    fn linear(&mut self, piece: &Piece) {
        let is_linear = |i: &usize| *i < DRIFT || (i - DRIFT) % PER_MODE < 2;
        let used: Vec<usize> = (0..self.p.len()).filter(is_linear).collect();
        let (matrix, right) = self.normal(piece, &used);
        if let Some(step) = matrix.lu().solve(&right).filter(|s| s.iter().all(|x| x.is_finite())) {
            self.step(&used, &step);
        }
    }

    fn improve(&mut self, piece: &Piece) {
        let all: Vec<usize> = (0..self.p.len()).collect();
        let mut damping = 1e-3;
        let mut error = self.error(piece);
        let mut equations = self.normal(piece, &all);
        for _ in 0..STEPS {
            let (mut matrix, right) = equations.clone();
            for i in 0..all.len() {
                matrix[(i, i)] *= 1.0 + damping;
            }
            let Some(cholesky) = matrix.cholesky() else { return };
            let mut next = self.clone();
            next.step(&all, &cholesky.solve(&right));
            let better = next.error(piece);
            if better < error {
                let gain = error - better;
                (*self, damping) = (next, damping * 0.2);
                if gain <= CONVERGED_RATIO * error {
                    return;
                }
                error = better;
                equations = self.normal(piece, &all);
            } else {
                damping *= 5.0;
                if damping > 1e9 {
                    return;
                }
            }
        }
    }

    /// Root mean square of the white part of the residual.
    pub(super) fn white(&self, piece: &Piece) -> f64 {
        detect::white(&self.residual(piece), piece.count(), piece.rate_hz)
    }

    /// Root mean square of the residual.
    pub(super) fn noise(&self, piece: &Piece) -> f64 {
        let free = piece.count().saturating_sub(self.p.len()).max(1);
        (self.error(piece) / free as f64).sqrt()
    }

    /// Residual as a multiple of its white part: about 1 for a complete fit.
    pub(super) fn misfit(&self, piece: &Piece) -> f64 {
        self.noise(piece) / self.white(piece).max(f64::MIN_POSITIVE)
    }

    /// The vibrations with their intervals. `density` is the ratio of the residual's spectral density at a frequency to
    /// its mean: where the model is incomplete the intervals grow with it.
    pub(super) fn vibrations(&self, piece: &Piece, density: impl Fn(f64) -> f64) -> Vec<Vibration> {
        let all: Vec<usize> = (0..self.p.len()).collect();
        let (matrix, _) = self.normal(piece, &all);
        let noise = self.noise(piece);
        let scale = matrix.diagonal().map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 });
        let scaled =
            DMatrix::from_fn(all.len(), all.len(), |i, j| matrix[(i, j)] * scale[i] * scale[j]);
        let Some(inverse) = scaled.try_inverse() else { return Vec::new() };
        let covariance = |i: usize, j: usize| inverse[(i, j)] * scale[i] * scale[j] * noise * noise;
        (0..self.modes())
            .map(|m| {
                let [a, b, s, w] = self.mode(m);
                let (i, j) = (DRIFT + PER_MODE * m + 2, DRIFT + PER_MODE * m + 3);
                let undamped = libm::hypot(s, w);
                let grow = density(w.abs() / TAU).max(1.0);
                // gradients with respect to s and w
                let spread = |ds: f64, dw: f64| {
                    let v = ds * ds * covariance(i, i)
                        + 2.0 * ds * dw * covariance(i, j)
                        + dw * dw * covariance(j, j);
                    // two vibrations that are nearly the same leave a matrix that is no covariance
                    if v < 0.0 { f64::INFINITY } else { SIGMAS * (v * grow).sqrt() }
                };
                let cubed = undamped * undamped * undamped;
                Vibration {
                    freq: Estimate {
                        value: undamped / TAU,
                        half_width: spread(s / undamped / TAU, w / undamped / TAU),
                    },
                    damping: Estimate {
                        value: s / undamped,
                        half_width: spread(w * w / cubed, -s * w / cubed),
                    },
                    decay: Estimate { value: s, half_width: spread(1.0, 0.0) },
                    amplitude: libm::hypot(a, b),
                }
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without noise the fit is exact, from a start that is off by a few percent, on a quadratic drift.
    #[test]
    fn two_vibrations_are_found_again() {
        let real = [(8.0, 0.03, 1.0), (11.0, 0.08, 0.7)];
        let at = |t: f64| {
            let part = |(f, z, a): (f64, f64, f64)| {
                let w = TAU * f;
                a * libm::exp(-z * w * t) * libm::cos(w * (1.0 - z * z).sqrt() * t)
            };
            0.2 - 3.0 * t + t * t + real.map(part).iter().sum::<f64>()
        };
        let samples: Vec<f64> = (0..3000).map(|i| at(f64::from(i) / 1000.0)).collect();
        let piece = Piece { valid: vec![true; 3000], samples, rate_hz: 1000.0 };
        let mut fit = Fit::new(&piece);
        for (f, z, _) in real {
            fit = fit.with(&piece, 1.02 * f, 1.2 * z * TAU * f);
        }
        for (found, (f, z, a)) in fit.vibrations(&piece, |_| 1.0).iter().zip(real) {
            assert!((found.freq.value - f).abs() < 1e-6, "{found:?}");
            assert!((found.damping.value - z).abs() < 1e-6, "{found:?}");
            assert!((found.amplitude - a).abs() < 1e-6, "{found:?}");
        }
    }
}
