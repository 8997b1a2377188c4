//! Finite impulse responses on the cycle grid, and the filter that applies one.
//!
//! A [`Kernel`] is configuration: FIR filters, HSC filters and the Vibration Guard are kernels that differ in their
//! taps only. A [`KernelFilter`] is the state of one axis: its raw input history and a shared kernel.
//!
//! Order of calls: a kernel once, a filter for each axis, settled at its position, then one step per cycle.
//!
//! ```
//! use kontur_filters::kernel::{Kernel, KernelFilter, Tap};
//! use kontur_filters::stage::Stage;
//! use std::sync::Arc;
//!
//! // two equal impulses, half a period of 25 Hz apart at 1 ms: the shaper ZV of an undamped axis
//! let kernel = Kernel::from_taps([0, 20].map(|delay| Tap { delay, weight: 1.0 })).unwrap();
//! assert_eq!(kernel.delay_cycles(), 10.0);
//! let mut axis = KernelFilter::new(Arc::new(kernel), 0.0);
//! let step: Vec<f64> = (0..30).map(|_| axis.step(1.0)).collect();
//! assert_eq!((step[0], step[19], step[20]), (0.5, 0.5, 1.0));
//! ```

use crate::ring::Ring;
use crate::stage::Stage;
use std::sync::Arc;

/// One impulse of a kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tap {
    /// Delay in cycles.
    pub delay: u32,
    /// Share of the input that arrives with this delay; the weights of a kernel sum to 1.
    pub weight: f64,
}

/// A finite impulse response with the sum 1: taps on the cycle grid, sorted by delay, each delay at most once.
///
/// Because the sum is 1, an axis at rest stays where it is, and a long ramp comes out as the same ramp
/// [`delay_cycles`](Self::delay_cycles) later.
#[derive(Clone, Debug, PartialEq)]
pub struct Kernel {
    taps: Vec<Tap>,
}

impl Kernel {
    /// The kernel that changes nothing: one tap of weight 1 without delay.
    pub fn identity() -> Self {
        Self::delay(0)
    }

    /// A pure delay by `cycles`.
    pub fn delay(cycles: u32) -> Self {
        Self { taps: vec![Tap { delay: cycles, weight: 1.0 }] }
    }

    /// A kernel of the given taps in any order: taps of equal delay are added, zero weights dropped, the sum is
    /// normalised to 1.
    ///
    /// `None` if a weight is not finite or the weights do not sum to a positive number, since such taps cannot be
    /// normalised.
    pub fn from_taps(taps: impl IntoIterator<Item = Tap>) -> Option<Self> {
        let mut taps: Vec<Tap> = taps.into_iter().collect();
        taps.sort_by_key(|tap| tap.delay);
        taps.dedup_by(|next, kept| {
            let same = next.delay == kept.delay;
            if same {
                kept.weight += next.weight;
            }
            same
        });
        taps.retain(|tap| tap.weight != 0.0);
        // Division by the compensated sum rounds each tap once, so the exact sum of the result is within half an ulp
        // per unit weight. Correcting single taps would only spoil the symmetry of a symmetric kernel.
        let sum = compensated_sum(taps.iter().map(|tap| tap.weight));
        if !(sum.is_finite() && sum > 0.0) {
            return None;
        }
        for tap in &mut taps {
            tap.weight /= sum;
        }
        taps.iter().all(|tap| tap.weight.is_finite()).then_some(Self { taps })
    }

    /// The taps, sorted by delay.
    #[inline]
    pub fn taps(&self) -> &[Tap] {
        &self.taps
    }

    /// Largest delay in cycles: the number of cycles of constant input that flush the kernel.
    #[inline]
    pub fn length(&self) -> u32 {
        self.taps.last().map_or(0, |tap| tap.delay)
    }

    /// Mean delay `tbar = sum h_k t_k` in cycles, the delay of slow signals.
    pub fn delay_cycles(&self) -> f64 {
        compensated_sum(self.taps.iter().map(|tap| tap.weight * f64::from(tap.delay)))
    }

    /// First one-sided moment `M1 = sum h_k max(0, tbar - t_k)` in cycles, half the mean absolute deviation.
    ///
    /// A velocity jump `dv` of the axis shifts the delay-aligned output by `|dv| M1 T` if no tap is negative.
    pub fn m1_cycles(&self) -> f64 {
        self.central_moment(|s| (-s).max(0.0))
    }

    /// `sum h_k max(0, t_k - tbar)^2` in cycles squared: the weight of an acceleration before a corner.
    pub fn m2_before_cycles2(&self) -> f64 {
        self.central_moment(|s| s.max(0.0) * s.max(0.0))
    }

    /// `sum h_k max(0, tbar - t_k)^2` in cycles squared: the weight of an acceleration after a corner.
    pub fn m2_after_cycles2(&self) -> f64 {
        self.central_moment(|s| (-s).max(0.0) * (-s).max(0.0))
    }

    /// Variance `sigma^2 = sum h_k (t_k - tbar)^2` in cycles squared: on a circle of radius R the path shrinks by about
    /// `v^2 sigma^2 T^2 / (2 R)`.
    pub fn variance_cycles2(&self) -> f64 {
        self.central_moment(|s| s * s)
    }

    /// The kernel of both in series.
    #[must_use]
    pub(crate) fn convolve(&self, other: &Self) -> Self {
        let products = self.taps.iter().flat_map(|a| {
            other.taps.iter().map(|b| Tap {
                delay: a.delay.saturating_add(b.delay),
                weight: a.weight * b.weight,
            })
        });
        // Sums of 1 multiply to 1, so the product can always be normalised.
        Self::from_taps(products).unwrap_or_else(Self::identity)
    }

    /// The same kernel backwards in time, starting at delay 0.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let length = self.length();
        let taps =
            self.taps.iter().rev().map(|tap| Tap { delay: length - tap.delay, weight: tap.weight });
        Self { taps: taps.collect() }
    }

    /// Whether the kernel passes its input through unchanged.
    pub fn is_identity(&self) -> bool {
        self.length() == 0
    }

    /// Whether a weight is negative: the step response then overshoots, and [`m1_cycles`](Self::m1_cycles) does not
    /// bound the corner error.
    pub fn has_negative_taps(&self) -> bool {
        self.taps.iter().any(|tap| tap.weight < 0.0)
    }

    /// `sum h_k f(t_k - tbar)`.
    fn central_moment(&self, f: impl Fn(f64) -> f64) -> f64 {
        let mean = self.delay_cycles();
        compensated_sum(self.taps.iter().map(|tap| tap.weight * f(f64::from(tap.delay) - mean)))
    }
}

/// Sum with Neumaier's running compensation, which leaves a single rounding for the sums that occur here.
fn compensated_sum(values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut lost) = (0.0_f64, 0.0);
    for value in values {
        let next = sum + value;
        lost += if sum.abs() >= value.abs() { (sum - next) + value } else { (value - next) + sum };
        sum = next;
    }
    sum + lost
}

/// A change of the kernel was requested while it would have made the output jump.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the kernel cannot be changed until the axis has been at rest for {needed_cycles} cycles; so far {rest_cycles}"
)]
pub struct SwitchWhileMoving {
    /// Equal inputs in a row so far.
    pub rest_cycles: u32,
    /// Equal inputs in a row after which the change causes no jump.
    pub needed_cycles: u32,
}

/// A kernel and the raw input history of one axis.
///
/// Evaluates `y = x + sum h_k (x[n-k] - x)` with the newest input `x`. At rest all differences are zero, so the output
/// equals the input bit for bit, however the weights are rounded. The history is recorded from the first cycle on, also
/// while the kernel is the identity.
#[derive(Clone, Debug)]
pub struct KernelFilter {
    kernel: Arc<Kernel>,
    history: Ring,
    /// Equal inputs in a row, the newest included.
    rest_cycles: u32,
}

impl KernelFilter {
    /// A filter that runs `kernel`, settled at `x`.
    pub fn new(kernel: Arc<Kernel>, x: f64) -> Self {
        let history = Ring::new(kernel.length(), x);
        Self { kernel, history, rest_cycles: u32::MAX }
    }

    /// Whether all inputs in reach of the kernel are equal bit for bit: the output then equals the input, and stays
    /// equal.
    #[inline]
    pub fn settled(&self) -> bool {
        self.settled_for(&self.kernel)
    }

    /// Whether the whole history is equal: another cycle of the same input only increases the count.
    #[inline]
    pub fn rests(&self) -> bool {
        self.rest_cycles as usize > self.history.len()
    }

    /// Processes a number of cycles with the input of the last one, while the filter [rests](Self::rests).
    #[inline]
    pub fn rest(&mut self, cycles: usize) {
        let cycles = u32::try_from(cycles).unwrap_or(u32::MAX);
        self.rest_cycles = self.rest_cycles.saturating_add(cycles);
    }

    /// Whether all inputs in reach of `kernel` are equal.
    #[inline]
    pub(crate) fn settled_for(&self, kernel: &Kernel) -> bool {
        self.rest_cycles > kernel.length()
    }

    /// Replaces the kernel, keeping the raw input history. May allocate: a longer kernel grows the history.
    ///
    /// # Errors
    ///
    /// [`SwitchWhileMoving`] unless the present and the new kernel are both [settled](Self::settled_for). Both then
    /// output the position at rest, since their sums are 1; otherwise the output would jump by the difference between
    /// the two.
    pub fn set_kernel(&mut self, kernel: Arc<Kernel>) -> Result<(), SwitchWhileMoving> {
        if !(self.settled() && self.settled_for(&kernel)) {
            let longest = self.kernel.length().max(kernel.length());
            return Err(SwitchWhileMoving {
                rest_cycles: self.rest_cycles,
                needed_cycles: longest.saturating_add(1),
            });
        }
        self.history.grow(kernel.length());
        self.kernel = kernel;
        Ok(())
    }

    /// Adds tap by tap over all cycles; each cycle gets the same sum as if it were computed alone.
    #[inline]
    fn run_in_room(&mut self, values: &mut [f64]) {
        let (before, cycles) = (self.history.newest(), values.len());
        self.history.extend(values);
        let inputs = self.history.recent(cycles, 0);
        match self.kernel.taps() {
            [Tap { delay, .. }] => values.copy_from_slice(self.history.recent(cycles, *delay)),
            taps => {
                // an empty sum is -0, which keeps the sign of the first term
                values.fill(-0.0);
                for Tap { delay, weight } in taps {
                    let past = self.history.recent(cycles, *delay);
                    for ((sum, past), x) in values.iter_mut().zip(past).zip(inputs) {
                        *sum += weight * (past - x);
                    }
                }
                for (sum, x) in values.iter_mut().zip(inputs) {
                    *sum += x;
                }
            }
        }
        let same = |a: f64, b: f64| a.to_bits() == b.to_bits();
        // the output rests only where inputs stay the same: not while an axis moves
        if !same(before, inputs[0]) && !inputs.windows(2).any(|pair| same(pair[0], pair[1])) {
            self.rest_cycles = 1;
            return;
        }
        let (mut before, mut rest_cycles) = (before, self.rest_cycles);
        for (value, x) in values.iter_mut().zip(inputs) {
            rest_cycles = if same(before, *x) { rest_cycles.saturating_add(1) } else { 1 };
            if rest_cycles > self.kernel.length() {
                *value = *x;
            }
            before = *x;
        }
        self.rest_cycles = rest_cycles;
    }

    /// Equal inputs in a row so far, needed to [take back](Self::take_back) a row of cycles.
    pub(crate) const fn rest_cycles(&self) -> u32 {
        self.rest_cycles
    }

    /// Undoes the last row, of `cycles` cycles; before it the inputs had been equal for `rest_cycles`.
    pub(crate) fn take_back(&mut self, cycles: usize, rest_cycles: u32) {
        self.history.take_back(cycles);
        self.rest_cycles = rest_cycles;
    }

    /// The kernel in use.
    pub fn kernel(&self) -> &Arc<Kernel> {
        &self.kernel
    }
}

impl Stage for KernelFilter {
    #[inline]
    fn step(&mut self, x: f64) -> f64 {
        let at_rest = x.to_bits() == self.history.newest().to_bits();
        self.rest_cycles = if at_rest { self.rest_cycles.saturating_add(1) } else { 1 };
        self.history.push(x);
        match self.kernel.taps() {
            _ if self.settled() => x,
            [Tap { delay, .. }] => self.history.past(*delay),
            taps => {
                let pull = |tap: &Tap| tap.weight * (self.history.past(tap.delay) - x);
                x + taps.iter().map(pull).sum::<f64>()
            }
        }
    }

    fn run(&mut self, values: &mut [f64]) {
        // a row of one cycle costs ten times as much as a step
        if let [x] = values {
            *x = self.step(*x);
            return;
        }
        for values in values.chunks_mut(Ring::ROOM) {
            self.run_in_room(values);
        }
    }

    fn settle(&mut self, x: f64) {
        self.history.fill(x);
        self.rest_cycles = u32::MAX;
    }

    fn delay_cycles(&self) -> f64 {
        self.kernel.delay_cycles()
    }
}

#[cfg(test)]
mod tests;
