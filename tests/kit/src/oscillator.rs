//! A mass on a spring, integrated in small steps of its differential equation.

use std::f64::consts::TAU;

/// A mass on a spring with an accelerated base, by the Runge-Kutta method.
#[derive(Clone, Debug)]
pub struct Oscillator {
    w: f64,
    damping: f64,
    /// Deflection.
    pub q: f64,
    /// Its rate in 1/s.
    pub v: f64,
}

impl Oscillator {
    /// At rest; natural frequency in Hz, damping ratio below 1.
    pub fn new(freq_hz: f64, damping: f64) -> Self {
        Self { w: TAU * freq_hz, damping, q: 0.0, v: 0.0 }
    }

    /// Advances the time by `t_s` under a constant acceleration of the base, in `steps` steps.
    pub fn advance(&mut self, acceleration: f64, t_s: f64, steps: u32) {
        let slope = |q: f64, v: f64| {
            (v, -acceleration - 2.0 * self.damping * self.w * v - self.w * self.w * q)
        };
        let h = t_s / f64::from(steps);
        let (mut q, mut v) = (self.q, self.v);
        for _ in 0..steps {
            let (a1, b1) = slope(q, v);
            let (a2, b2) = slope(q + 0.5 * h * a1, v + 0.5 * h * b1);
            let (a3, b3) = slope(q + 0.5 * h * a2, v + 0.5 * h * b2);
            let (a4, b4) = slope(q + h * a3, v + h * b3);
            q += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
            v += h / 6.0 * (b1 + 2.0 * b2 + 2.0 * b3 + b4);
        }
        (self.q, self.v) = (q, v);
    }

    /// Amplitude of the free vibration that would follow now.
    pub fn amplitude(&self) -> f64 {
        let damped = self.w * (1.0 - self.damping * self.damping).sqrt();
        libm::hypot(self.q, (self.v + self.damping * self.w * self.q) / damped)
    }
}
