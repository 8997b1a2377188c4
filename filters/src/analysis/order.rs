//! The largest order of a FIR or HSC filter that keeps a corner within a tolerance.
//!
//! Source: TF5200 axis filters (contour error over filter order at a 90 degree corner), FCT-C37.
//!
//! Order of calls: none, the functions are independent; the returned order goes into the configuration of
//! [`crate::fir`] or [`crate::hsc`].
//!
//! ```
//! use kontur_filters::analysis::order::largest_order;
//! use kontur_filters::fir::{FirConfig, FirKind};
//! use kontur_filters::time::CycleTime;
//!
//! let choice =
//!     largest_order(&FirConfig::new(FirKind::MovingAverage), 0.1, 2000.0 / 60.0, CycleTime::DEFAULT);
//! assert!(choice.contour_error_mm <= 0.1 && (22..=24).contains(&choice.order));
//! ```

use super::corner::kernel_error_mm;
use crate::fir::{FirConfig, MAX_ORDER};
use crate::time::CycleTime;

/// A filter order and the contour error it makes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrderChoice {
    /// Order N; the kernel has N + 1 taps.
    pub order: u32,
    /// Contour error at a 90 degree corner in mm.
    pub contour_error_mm: f64,
}

/// The largest order of the filter `config` (its own order is ignored) with which the contour error at a 90 degree
/// corner passed at `speed_mm_s` stays within `tolerance_mm`; order 0, no filter, if even the first order is too much.
///
/// An odd order delays by half a cycle, which the delay filter of an unfiltered axis cannot match; take the next lower
/// even order then.
pub fn largest_order(
    config: &FirConfig,
    tolerance_mm: f64,
    speed_mm_s: f64,
    cycle: CycleTime,
) -> OrderChoice {
    let error_mm = |order: u32| {
        let (kernel, _) = FirConfig { order, ..*config }.design(cycle);
        kernel.map_or(f64::INFINITY, |kernel| kernel_error_mm(&kernel, speed_mm_s, cycle))
    };
    // An order that meets the tolerance exactly counts as within it: 24/8 cycles at 33.3 mm/s are 0.1 mm.
    let within = |error: f64| error <= tolerance_mm * (1.0 + 1e-12);
    let none = OrderChoice { order: 0, contour_error_mm: 0.0 };
    (1..=MAX_ORDER)
        .map(|order| OrderChoice { order, contour_error_mm: error_mm(order) })
        .take_while(|choice| within(choice.contour_error_mm))
        .last()
        .unwrap_or(none)
}
