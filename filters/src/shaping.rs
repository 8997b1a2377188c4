//! The shaping chain of one axis: a kernel (FIR, HSC or Vibration Guard), then up to three standard filters.
//!
//! The kernels share one slot because they exclude each other on an axis. The kernel acts first, on the raw set
//! position; as all stages are linear, the order only affects rounding and start-up.
//!
//! Assumption: the order; the vendor does not state it.
//!
//! Order of calls: design kernel and filters, make the chain, settle it at the position of the axis and step it once
//! per cycle.
//!
//! ```
//! use kontur_filters::kernel::Kernel;
//! use kontur_filters::shaping::Shaping;
//! use kontur_filters::stage::Stage;
//! use std::sync::Arc;
//!
//! let mut axis = Shaping::new(Vec::new(), 0.0);
//! axis.set_kernel(Some(Arc::new(Kernel::delay(3))))?;
//! assert_eq!(axis.step(5.0), 0.0);
//! // neither taken away in motion nor said to have arrived before it has
//! assert!(axis.set_kernel(None).is_err() && !axis.settled(0.001));
//! for _ in 0..3 {
//!     axis.step(5.0);
//! }
//! assert!(axis.settled(0.001));
//! axis.set_kernel(None)?;
//! assert_eq!(axis.step(5.0), 5.0);
//! # Ok::<(), kontur_filters::kernel::SwitchWhileMoving>(())
//! ```

use crate::iir::AxisFilter;
use crate::kernel::{Kernel, KernelFilter, SwitchWhileMoving};
use crate::response::{Angle, Response};
#[cfg(doc)]
use crate::ring::Ring;
use crate::stage::Stage;
use std::sync::Arc;

/// Shaping chain of one axis, with its state.
#[derive(Clone, Debug)]
pub struct Shaping {
    kernel: KernelFilter,
    filters: Vec<AxisFilter>,
    /// Last input and output.
    newest: (f64, f64),
}

/// State of a chain before a row of cycles that may have to be undone. The histories stay in place.
#[derive(Clone, Debug, Default)]
pub struct Mark {
    rest_cycles: u32,
    filters: Vec<AxisFilter>,
    newest: (f64, f64),
}

/// Origin of a standard filter when the filters of a chain change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The filter with this index, unchanged.
    Same(usize),
    /// The filter with this index, with a different design.
    Changed(usize),
    /// A new filter.
    New,
}

impl Shaping {
    /// The chain of the standard `filters` without a kernel, settled at `x`.
    pub fn new(filters: Vec<AxisFilter>, x: f64) -> Self {
        let kernel = KernelFilter::new(Arc::new(Kernel::identity()), x);
        let mut shaping = Self { kernel, filters, newest: (x, x) };
        shaping.settle(x);
        shaping
    }

    /// Puts a kernel into the slot, `None` empties it. May allocate.
    ///
    /// # Errors
    ///
    /// [`SwitchWhileMoving`] unless [`ready_for`](Self::ready_for) the kernel: the set position would jump.
    pub fn set_kernel(&mut self, kernel: Option<Arc<Kernel>>) -> Result<(), SwitchWhileMoving> {
        self.kernel.set_kernel(kernel.unwrap_or_else(|| Arc::new(Kernel::identity())))
    }

    /// Whether the kernel in the slot can be replaced by `kernel` (`None`: removed) without a jump: the axis has rested
    /// for the length of both.
    pub fn ready_for(&self, kernel: Option<&Kernel>) -> bool {
        self.kernel.settled() && kernel.is_none_or(|kernel| self.kernel.settled_for(kernel))
    }

    /// Replaces the standard filters, with the origin of each. Unchanged filters continue. The others begin at rest at
    /// the output, which is as close to the input as a wait for [`settled`](Self::settled) has left it, and settle on
    /// the input from there. If a high-pass or band-pass blocks constants, the filters begin at what reaches each of
    /// them.
    pub fn change_filters(&mut self, filters: Vec<AxisFilter>, origins: &[Origin]) {
        let before = std::mem::replace(&mut self.filters, filters);
        let (mut x, y) = self.newest;
        let passed = before.iter().chain(&self.filters).all(AxisFilter::lets_rest_through);
        if passed {
            x = y;
        }
        for (filter, origin) in self.filters.iter_mut().zip(origins) {
            match *origin {
                Origin::Same(i) => filter.clone_from(&before[i]),
                Origin::Changed(i) => filter.settle_as(&before[i], x),
                Origin::New => filter.settle(x),
            }
            x = filter.final_value(x);
        }
        self.newest.1 = x;
    }

    /// Shifts everything at standstill by `by_mm`: the axis gets another coordinate. The next output is the last one plus
    /// `by_mm`; what a high-pass or band-pass blocks moves with it.
    pub fn shift(&mut self, by_mm: f64) {
        let (x, y) = self.newest;
        let mut x = if self.filters.iter().all(AxisFilter::lets_rest_through) { y } else { x };
        x += by_mm;
        self.kernel.settle(x);
        let newest = x;
        for filter in &mut self.filters {
            filter.shift(by_mm, x);
            x = filter.final_value(x);
        }
        self.newest = (newest, x);
    }

    /// The input at the last step.
    pub fn input(&self) -> f64 {
        self.newest.0
    }

    /// The kernel in the slot, the identity if the slot is empty.
    pub fn kernel(&self) -> &Arc<Kernel> {
        self.kernel.kernel()
    }

    /// Whether the axis has arrived: the kernel is flushed and the output is closer than `window_mm` (P-AXIS-00351) to
    /// its final value, the input.
    ///
    /// For a high-pass or band-pass, which never reaches its input, the final value of the filter counts instead;
    /// otherwise a wait for it would never end.
    pub fn settled(&self, window_mm: f64) -> bool {
        let (x, y) = self.newest;
        let target = self.filters.iter().fold(x, |x, filter| filter.final_value(x));
        self.flushed() && (y - target).abs() < window_mm
    }

    /// Whether all values in the kernel equal the last input.
    pub fn flushed(&self) -> bool {
        self.kernel.settled()
    }

    /// Whether another cycle with the input `x` would repeat the last output and only advance the count.
    ///
    /// False for a chain with standard filters: their states change for as long as they have digits.
    #[inline]
    pub fn rests_under(&self, x: f64) -> bool {
        self.filters.is_empty() && x.to_bits() == self.newest.0.to_bits() && self.kernel.rests()
    }

    /// Replaces a number of cycles while the chain [rests](Self::rests_under).
    #[inline]
    pub fn rest(&mut self, cycles: usize) {
        self.kernel.rest(cycles);
    }

    /// Saves the state of the chain in `mark`.
    pub fn mark(&self, mark: &mut Mark) {
        mark.rest_cycles = self.kernel.rest_cycles();
        mark.filters.clone_from(&self.filters);
        mark.newest = self.newest;
    }

    /// Returns to a mark, `cycles` cycles later: at most [`Ring::ROOM`], all of them in one [`run`](Stage::run), apart
    /// from those in which the chain rested.
    pub fn return_to(&mut self, mark: &Mark, cycles: usize) {
        self.kernel.take_back(cycles, mark.rest_cycles);
        self.filters.clone_from(&mark.filters);
        self.newest = mark.newest;
    }

    /// Cycles of constant input that flush the kernel, without those of the standard filters.
    pub fn flush_cycles(&self) -> u32 {
        self.kernel().length()
    }

    /// Frequency response of the whole chain at one frequency.
    pub fn response(&self, at: Angle) -> Response {
        self.filters
            .iter()
            .fold(self.kernel().response(at), |chain, filter| chain * filter.response(at))
    }
}

impl Stage for Shaping {
    /// Next set position; without kernel and filters the input bit for bit.
    #[inline]
    fn step(&mut self, x: f64) -> f64 {
        let shaped = self.kernel.step(x);
        let y = self.filters.iter_mut().fold(shaped, |x, filter| filter.step(x));
        self.newest = (x, y);
        y
    }

    fn run(&mut self, values: &mut [f64]) {
        let Some(newest) = values.last().copied() else { return };
        self.kernel.run(values);
        for filter in &mut self.filters {
            filter.run(values);
        }
        self.newest = (newest, values[values.len() - 1]);
    }

    fn settle(&mut self, x: f64) {
        self.kernel.settle(x);
        for filter in &mut self.filters {
            filter.settle(x);
        }
        self.newest = (x, x);
    }

    fn delay_cycles(&self) -> f64 {
        self.filters
            .iter()
            .fold(self.kernel().delay_cycles(), |sum, filter| sum + filter.delay_cycles())
    }
}
