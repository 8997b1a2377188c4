//! Delay by a fractional number of cycles below 6: Thiran's all-pass.
//!
//! The vendor specifies an amplitude response of exactly 1, an order computed from the delay and a limit of 6 cycles;
//! the maximally flat all-pass has all three. Its group delay for slow signals is exactly the configured delay; a whole
//! number of cycles is a pure shift, bit for bit.
//!
//! Source: TF5200 axis filters, type `TIME_DELAY`, P-AXIS-00357. Assumption: Thiran's design.

use crate::response::{Angle, Response};

/// Highest order; also the limit of the delay in cycles.
const MAX_ORDER: usize = 6;

/// Coefficients of `H(z) = (a_N + ... + z^-N) / (1 + ... + a_N z^-N)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Thiran {
    order: usize,
    /// `a[k - 1]` is the coefficient of `z^-k`.
    a: [f64; MAX_ORDER],
}

/// The last inputs and outputs, newest first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ThiranState {
    inputs: [f64; MAX_ORDER],
    outputs: [f64; MAX_ORDER],
}

impl ThiranState {
    /// Settled at the constant input `x`.
    pub(super) const fn at_rest(x: f64) -> Self {
        Self { inputs: [x; MAX_ORDER], outputs: [x; MAX_ORDER] }
    }
}

impl Thiran {
    /// The delay by `cycles`, from 0 to below 6.
    ///
    /// The order is the delay rounded, at least 1; a delay outside the range is replaced by the nearest one inside.
    pub(super) fn new(cycles: f64) -> Self {
        let mut a = [0.0; MAX_ORDER];
        if cycles <= 0.0 {
            return Self { order: 0, a };
        }
        let order = ((cycles + 0.5) as usize).clamp(1, MAX_ORDER);
        let below = cycles.min(MAX_ORDER as f64) - order as f64;
        let mut binomial = 1.0;
        for k in 1..=order {
            // (-1)^k C(N, k) prod_{n = 0..N} (d - N + n) / (d - N + k + n)
            binomial *= -((order - k + 1) as f64) / k as f64;
            a[k - 1] = (0..=order)
                .map(|n| (below + n as f64) / (below + (k + n) as f64))
                .fold(binomial, |product, factor| product * factor);
        }
        Self { order, a }
    }

    /// Next output for the next input.
    pub(super) fn step(&self, state: &mut ThiranState, x: f64) -> f64 {
        let Some(oldest) = self.order.checked_sub(1) else { return x };
        let ThiranState { inputs, outputs } = state;
        // y[n] = x[n - N] + sum a_k (x[n - N + k] - y[n - k]): at rest every difference is zero.
        let newer = inputs[..oldest].iter().rev().chain(std::iter::once(&x));
        let corrections = self.a.iter().zip(newer).zip(outputs.iter());
        let y = inputs[oldest] + corrections.map(|((a, x), y)| a * (x - y)).sum::<f64>();
        inputs.rotate_right(1);
        inputs[0] = x;
        outputs.rotate_right(1);
        outputs[0] = y;
        y
    }

    /// Frequency response at one frequency.
    pub(super) fn response(&self, at: Angle) -> Response {
        let order = self.order as f64;
        let (mut numerator, mut denominator) = (Response::delay(order, at), Response::ONE);
        for (a, k) in self.a[..self.order].iter().zip(1_u32..) {
            let k = f64::from(k);
            numerator = numerator + Response::delay(order - k, at).scaled(*a);
            denominator = denominator + Response::delay(k, at).scaled(*a);
        }
        numerator / denominator
    }
}
