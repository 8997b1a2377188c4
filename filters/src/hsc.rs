//! HSC filters, the older form of the FIR filters: mean and `NoVib`.
//!
//! Configured as the first axis filter with the prototype HSC, made effective by `#FILTER ON [HSC]`. The vendor
//! recommends FIR filters instead.
//!
//! Source: TF5200 axis filters; P-AXIS-00067, 00140, 00164, 00204, 00357.
//!
//! Order of calls: the configuration gives the kernel, the [shaping chain](crate::shaping) runs it.
//!
//! ```
//! use kontur_filters::hsc::{HscConfig, HscKind};
//! use kontur_filters::response::Angle;
//! use kontur_filters::time::CycleTime;
//!
//! let cycle = CycleTime::DEFAULT;
//! let config =
//!     HscConfig { kind: HscKind::NoVib, order: 1, time_constant_us: 10_000, f_hz: 30.0, share_ratio: 1.0 };
//! let (kernel, issues) = config.design(cycle);
//! let kernel = kernel.unwrap();
//! assert!(issues.is_empty());
//! // one period of 30 Hz is 33.3 cycles: blocked completely
//! assert!(kernel.response(Angle::of(30.0, cycle)).magnitude() < 1e-12);
//! ```

use crate::fir::{MAX_ORDER, check_share, moving_average, no_filter_off, order, with_share};
use crate::issue::FilterIssue;
use crate::kernel::{Kernel, Tap};
use crate::time::CycleTime;
use std::f64::consts::PI;

/// Shape of an HSC kernel. Source: P-AXIS-00204.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HscKind {
    /// Type 8: equal taps, N + 1 of them.
    Mean,
    /// Type 12: equal taps over exactly one period of the first natural frequency, with fractional outer taps, which
    /// block that frequency completely and its multiples almost completely.
    ///
    /// Assumption: this kernel; the vendor does not publish the shape. It is the shortest positive symmetric one with
    /// that property.
    NoVib,
}

/// Parameters of the HSC filter of one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HscConfig {
    /// Shape.
    pub kind: HscKind,
    /// Order, up to 200; 0 takes it from the time constant (P-AXIS-00140). For `NoVib` any order above 0 only switches
    /// it on.
    pub order: u32,
    /// Time in us that gives the order, from one cycle on, default 10 000 (P-AXIS-00357).
    pub time_constant_us: u32,
    /// First natural frequency of `NoVib` in Hz, from 1/200 to a third of the sampling frequency (P-AXIS-00067).
    pub f_hz: f64,
    /// Share of the signal that passes through the filter, 0 to 1 (P-AXIS-00164).
    pub share_ratio: f64,
}

impl HscConfig {
    /// The kernel of the configuration, and the issues found.
    ///
    /// `None` with 50910, 50989 or a value out of range; 50911 continues with the highest order.
    pub fn design(&self, cycle: CycleTime) -> (Option<Kernel>, Vec<FilterIssue>) {
        let mut issues = Vec::new();
        let max_order = if self.kind == HscKind::NoVib { u32::MAX } else { MAX_ORDER };
        let order = order(self.order, self.time_constant_us, max_order, cycle, &mut issues);
        let sampling_hz = 1.0 / cycle.seconds();
        let (min_hz, max_hz) = (sampling_hz / f64::from(MAX_ORDER), sampling_hz / 3.0);
        if self.kind == HscKind::NoVib && !(min_hz..=max_hz).contains(&self.f_hz) {
            issues.push(FilterIssue::Frequency { f_hz: self.f_hz, min_hz, max_hz });
        }
        check_share(self.share_ratio, &mut issues);
        let kernel = order.filter(|_| no_filter_off(&issues)).and_then(|order| match self.kind {
            HscKind::Mean => moving_average(order),
            HscKind::NoVib => no_vibration(sampling_hz / self.f_hz),
        });
        (kernel.and_then(|kernel| with_share(kernel, self.share_ratio)), issues)
    }
}

/// Weights w, 1 (2K + 1 times), w, normalised, for a period of `2K + 1 + r` cycles with `0 <= r < 2`.
///
/// The response at the frequency is zero for `w = -D / (2 cos((K + 1) theta))`,
/// `D = sin((2K + 1) theta/2) / sin(theta/2)`, `theta = 2 pi / period`. Both angles are close to pi. With pi subtracted
/// the weight is `sin(r theta/2) / (2 sin(theta/2) cos((1 - r) theta/2))`: without cancellation and never negative.
fn no_vibration(period_cycles: f64) -> Option<Kernel> {
    let pairs = (0.5 * (period_cycles - 1.0)).floor().max(1.0);
    let rest = (period_cycles - 1.0 - 2.0 * pairs).max(0.0);
    let half = PI / period_cycles;
    let outer = libm::sin(rest * half) / (2.0 * libm::sin(half) * libm::cos((1.0 - rest) * half));
    let last = 2 * pairs as u32 + 2;
    Kernel::from_taps((0..=last).map(|delay| {
        let weight = if delay == 0 || delay == last { outer } else { 1.0 };
        Tap { delay, weight }
    }))
}
