//! FIR filters of an axis: symmetric kernels given by a type and an order.
//!
//! A kernel of order N has N + 1 taps and delays by N/2 cycles; only the pure delay delays by its full order. The
//! vendor calls the filters acausal because interpolation is ahead of the output; here they are causal and their delay
//! is known, so that curves can be aligned.
//!
//! Source: TF5200 FIR filter (FCT-C37); P-AXIS-00573, 00585 to 00587, 00590, 00591, 00593.
//!
//! Order of calls: [`FirConfig::design`] gives the kernel, the [shaping chain](crate::shaping) runs it.
//!
//! ```
//! use kontur_filters::fir::{FirConfig, FirKind};
//! use kontur_filters::time::CycleTime;
//!
//! let config = FirConfig { order: 20, ..FirConfig::new(FirKind::MovingAverage) };
//! let (kernel, issues) = config.design(CycleTime::DEFAULT);
//! assert_eq!((kernel.unwrap().delay_cycles(), issues.len()), (10.0, 0));
//! ```

use crate::issue::FilterIssue;
use crate::kernel::{Kernel, Tap};
use crate::time::CycleTime;
use std::f64::consts::PI;

/// Highest order of FIR and HSC filters. Source: P-AXIS-00587, 00140.
pub const MAX_ORDER: u32 = 200;
/// Highest order of the pure delay. Source: P-AXIS-00587.
pub const MAX_DELAY_ORDER: u32 = 100;

/// Shape of a FIR kernel. Source: P-AXIS-00586.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FirKind {
    /// Type 1: equal taps.
    MovingAverage,
    /// Type 2: a Gaussian bell with the standard deviation `quality * N / 5` over N + 1 taps.
    ///
    /// Assumption: the standard deviation; the vendor only says that the quality widens the bell, not the kernel.
    Gauss,
    /// Type 3: the cardinal sine of the cut-off frequency under a Blackman window.
    ///
    /// Assumption: the Blackman window. The cut-off is the -6 dB point; kernels shorter than `1 / (fcut T)` do not
    /// reach it and act as a bell.
    WindowedSinc,
    /// Type 4: delay by N cycles, which keeps an axis synchronous with filtered ones.
    TimeDelay,
}

/// Parameters of the FIR filter of one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirConfig {
    /// Shape.
    pub kind: FirKind,
    /// Order, up to 200 (type 4: 100); 0 takes it from the time (P-AXIS-00587, ORDER).
    pub order: u32,
    /// Time in us that gives the order, from one cycle on; 0 for none (P-AXIS-00591, `ORDER_TIME`).
    pub order_time_us: u32,
    /// Share of the signal that passes through the filter, 0 to 1, default 1 (P-AXIS-00590, SHARE).
    pub share_ratio: f64,
    /// Cut-off frequency of type 3 in Hz, at least 1, default 30 (P-AXIS-00585, FCUT).
    pub fcut_hz: f64,
    /// Width of the bell of type 2, above 0 to 1, default 1 (P-AXIS-00593, QUALITY).
    pub quality: f64,
}

impl FirConfig {
    /// Lowest cut-off frequency in Hz (P-AXIS-00585).
    pub const MIN_FREQ_HZ: f64 = 1.0;

    /// A configuration of this kind with the vendor's defaults: no order yet.
    pub const fn new(kind: FirKind) -> Self {
        Self { kind, order: 0, order_time_us: 0, share_ratio: 1.0, fcut_hz: 30.0, quality: 1.0 }
    }

    /// Applies the order of an NC command: an order replaces both values of the list, otherwise a time does.
    ///
    /// Assumption: ORDER wins over `ORDER_TIME` in one command.
    pub const fn program_order(&mut self, order: Option<u32>, order_time_us: Option<u32>) {
        if let Some(order) = order {
            (self.order, self.order_time_us) = (order, 0);
        } else if let Some(order_time_us) = order_time_us {
            (self.order, self.order_time_us) = (0, order_time_us);
        }
    }

    /// The kernel of the configuration, and the issues found.
    ///
    /// `None` with 50910, 50989 or a value out of range; 50911 continues with the highest order.
    pub fn design(&self, cycle: CycleTime) -> (Option<Kernel>, Vec<FilterIssue>) {
        let mut issues = Vec::new();
        let max_order = if self.kind == FirKind::TimeDelay { MAX_DELAY_ORDER } else { MAX_ORDER };
        let order = order(self.order, self.order_time_us, max_order, cycle, &mut issues);
        let max_hz = 0.5 / cycle.seconds();
        if self.kind == FirKind::WindowedSinc
            && !(Self::MIN_FREQ_HZ..max_hz).contains(&self.fcut_hz)
        {
            issues.push(FilterIssue::Frequency {
                f_hz: self.fcut_hz,
                min_hz: Self::MIN_FREQ_HZ,
                max_hz,
            });
        }
        if self.kind == FirKind::Gauss && !(self.quality > 0.0 && self.quality <= 1.0) {
            issues.push(FilterIssue::Quality { quality: self.quality, range: "above 0 to 1" });
        }
        check_share(self.share_ratio, &mut issues);
        if self.kind == FirKind::TimeDelay && (0.0..1.0).contains(&self.share_ratio) {
            issues.push(FilterIssue::ShareOfDelay);
        }
        let kernel = order.filter(|_| no_filter_off(&issues)).and_then(|order| match self.kind {
            FirKind::MovingAverage => moving_average(order),
            FirKind::Gauss => gauss(order, self.quality),
            FirKind::WindowedSinc => windowed_sinc(order, self.fcut_hz * cycle.seconds()),
            FirKind::TimeDelay => Some(Kernel::delay(order)),
        });
        (kernel.and_then(|kernel| with_share(kernel, self.share_ratio)), issues)
    }
}

/// The order itself or, if it is 0, the time in whole cycles.
pub(crate) fn order(
    order: u32,
    time_us: u32,
    max_order: u32,
    cycle: CycleTime,
    issues: &mut Vec<FilterIssue>,
) -> Option<u32> {
    let cycle_us = cycle.us();
    let order = match (order, time_us) {
        (0, 0) => {
            issues.push(FilterIssue::NoOrder);
            return None;
        }
        (0, order_time_us) if order_time_us < cycle_us => {
            issues.push(FilterIssue::OrderTimeBelowCycle { order_time_us, cycle_us });
            return None;
        }
        (0, time_us) => time_us / cycle_us + u32::from(time_us % cycle_us >= cycle_us.div_ceil(2)),
        (order, _) => order,
    };
    if order > max_order {
        issues.push(FilterIssue::OrderTooHigh { order, used: max_order });
    }
    Some(order.min(max_order))
}

pub(crate) fn check_share(share_ratio: f64, issues: &mut Vec<FilterIssue>) {
    if !(0.0..=1.0).contains(&share_ratio) {
        issues.push(FilterIssue::Share { share_ratio });
    }
}

pub(crate) fn no_filter_off(issues: &[FilterIssue]) -> bool {
    issues.iter().all(|issue| issue.effect() != crate::issue::Effect::Off)
}

/// Equal taps.
pub(crate) fn moving_average(order: u32) -> Option<Kernel> {
    weighted(order, |_| 1.0)
}

fn gauss(order: u32, quality: f64) -> Option<Kernel> {
    let sigma = quality * f64::from(order) / 5.0;
    weighted(order, |offset| libm::exp(-0.5 * (offset / sigma) * (offset / sigma)))
}

fn windowed_sinc(order: u32, fcut_per_cycle: f64) -> Option<Kernel> {
    let width = f64::from(order) + 2.0;
    weighted(order, |offset| {
        let angle = 2.0 * PI * fcut_per_cycle * offset;
        let sinc = if offset.abs() > 0.0 { libm::sin(angle) / angle } else { 1.0 };
        // Blackman window about its centre; its zeros lie one tap outside the kernel on either side.
        let turn = 2.0 * PI * offset / width;
        sinc * (0.42 + 0.5 * libm::cos(turn) + 0.08 * libm::cos(2.0 * turn))
    })
}

/// N + 1 taps whose weights are a function of the distance from the centre in cycles.
fn weighted(order: u32, weight: impl Fn(f64) -> f64) -> Option<Kernel> {
    let centre = 0.5 * f64::from(order);
    Kernel::from_taps(
        (0..=order).map(|delay| Tap { delay, weight: weight(f64::from(delay) - centre) }),
    )
}

/// Passes only a share through the kernel, the rest around it with the same delay.
///
/// Assumption: the bypass is delayed; without that the two parts would no longer belong to the same time.
pub(crate) fn with_share(kernel: Kernel, share_ratio: f64) -> Option<Kernel> {
    if share_ratio >= 1.0 {
        return Some(kernel);
    }
    // All kernels here are symmetric, so the midpoint between the outer taps is the mean delay.
    let ends = kernel.taps().first()?.delay + kernel.length();
    let bypass = |delay| Tap { delay, weight: 0.5 * (1.0 - share_ratio) };
    let filtered = kernel
        .taps()
        .iter()
        .map(|tap| Tap { delay: tap.delay, weight: share_ratio * tap.weight })
        .collect::<Vec<_>>();
    Kernel::from_taps(filtered.into_iter().chain([bypass(ends / 2), bypass(ends.div_ceil(2))]))
}
