//! The shaping chain of one axis: a kernel (FIR, HSC or Vibration Guard), then up to three standard filters.
//!
//! The kernels share one slot because they exclude each other on an axis. The kernel comes first, on the raw set
//! position; all stages are linear, so the order changes rounding and start-up only.
//!
//! Assumption: the order; the vendor does not state it.
//!
//! Order of calls: kernel and filters are designed, the chain is made of them, settled at the position of the axis and
//! stepped once per cycle.
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

/// Where a chain is before a row of cycles that may have to be taken back. What it remembers stays where it is.
#[derive(Clone, Debug, Default)]
pub struct Mark {
    rest_cycles: u32,
    filters: Vec<AxisFilter>,
    newest: (f64, f64),
}

/// What a standard filter was before the filters of its chain were changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The filter of this number, as it is.
    Same(usize),
    /// The filter of this number, otherwise designed.
    Changed(usize),
    /// None.
    New,
}

impl Shaping {
    /// The chain of the standard `filters` without a kernel, at rest at `x`.
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

    /// Whether the kernel in the slot can be replaced by `kernel` (`None`: removed) without a jump: the axis has been at rest
    /// for as long as either of them remembers.
    pub fn ready_for(&self, kernel: Option<&Kernel>) -> bool {
        self.kernel.settled() && kernel.is_none_or(|kernel| self.kernel.settled_for(kernel))
    }

    /// Other standard filters from now on, with the origin of each. The same ones continue; the others begin at rest on the
    /// output, which is as close to the input as a wait for [`settled`](Self::settled) has left it, and run into the input from
    /// there. Where a high-pass or band-pass lets no rest through they begin on what arrives at each of them.
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

    /// The kernel in the slot, the identity if it is empty.
    pub fn kernel(&self) -> &Arc<Kernel> {
        self.kernel.kernel()
    }

    /// Whether the axis has arrived: the kernel is flushed and the output is closer than `window_mm` (P-AXIS-00351) to
    /// the value it tends to, the input.
    ///
    /// A high-pass or band-pass never reaches its input; the value it tends to counts instead; otherwise a wait for it would never end.
    pub fn settled(&self, window_mm: f64) -> bool {
        let (x, y) = self.newest;
        let target = self.filters.iter().fold(x, |x, filter| filter.final_value(x));
        self.flushed() && (y - target).abs() < window_mm
    }

    /// Whether the kernel contains only the last input.
    pub fn flushed(&self) -> bool {
        self.kernel.settled()
    }

    /// Whether another cycle with the input `x` would give the output of the last one and change nothing but its number.
    ///
    /// A chain with standard filters is never said to rest: they continue for as long as their states have digits.
    #[inline]
    pub fn rests_under(&self, x: f64) -> bool {
        self.filters.is_empty() && x.to_bits() == self.newest.0.to_bits() && self.kernel.rests()
    }

    /// Instead of so many cycles while the chain [rests](Self::rests_under).
    #[inline]
    pub fn rest(&mut self, cycles: usize) {
        self.kernel.rest(cycles);
    }

    /// Marks where the chain is.
    pub fn mark(&self, mark: &mut Mark) {
        mark.rest_cycles = self.kernel.rest_cycles();
        mark.filters.clone_from(&self.filters);
        mark.newest = self.newest;
    }

    /// Returns to a mark: so many cycles have been run since, at most [`Ring::ROOM`] and all of them in one
    /// [`run`](Stage::run), besides those in which the chain rested.
    pub fn return_to(&mut self, mark: &Mark, cycles: usize) {
        self.kernel.take_back(cycles, mark.rest_cycles);
        self.filters.clone_from(&mark.filters);
        self.newest = mark.newest;
    }

    /// Cycles of constant input that flush the kernel; the standard filters come on top.
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
    /// Next set position; with neither kernel nor filters the input bit for bit.
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
