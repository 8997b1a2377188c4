//! The filter kernels of the axes, in the form the tolerance needs.

use kontur_filters::kernel::{Kernel, Tap};
use kontur_filters::time::CycleTime;
use std::sync::Arc;

/// Taps per kernel in the search for an even speed.
const COARSE: usize = 24;

/// The filter kernels of the axes of a channel.
#[derive(Clone, Debug, Default)]
pub struct Kernels {
    pub(super) axes: Vec<Option<Arc<Kernel>>>,
    /// Whether a kernel has negative weights and so overshoots at starts and stops, on straight blocks as well.
    pub(super) overshoot: bool,
    /// Whether the axes have different kernels.
    pub(super) unequal: bool,
    /// Axis of the longest kernel.
    longest: Option<usize>,
    /// Delay of the longest kernel in cycles.
    pub(super) delay: f64,
    /// Largest variance of a kernel in cycles squared.
    spread_cycles2: f64,
    /// The kernel of each axis reduced to few taps: weights, and mean delays in cycles.
    pub(super) coarse: Vec<Vec<(f64, f64)>>,
}

impl Kernels {
    /// One kernel per axis, `None` for an axis without a filter.
    pub fn new(axes: Vec<Option<Arc<Kernel>>>) -> Self {
        let mut taps = axes.iter().flatten().flat_map(|k| k.taps());
        let overshoot = taps.any(|tap| tap.weight < 0.0);
        let unequal = axes.windows(2).any(|pair| pair[0] != pair[1]);
        let length = |i: &usize| axes[*i].as_ref().map_or(0, |k| k.length());
        let longest = (0..axes.len()).filter(|i| axes[*i].is_some()).max_by_key(length);
        let delay = longest.and_then(|i| axes[i].as_ref()).map_or(0.0, |k| k.delay_cycles());
        let spread_cycles2 = axes.iter().flatten().map(|k| spread_cycles2(k)).fold(0.0, f64::max);
        let coarse = axes.iter().map(|k| k.as_ref().map_or_else(|| vec![(1.0, 0.0)], coarse));
        let coarse = coarse.collect();
        Self { axes, overshoot, unequal, longest, delay, spread_cycles2, coarse }
    }

    /// Whether any axis has a kernel.
    pub fn any(&self) -> bool {
        self.axes.iter().any(Option::is_some)
    }

    /// Cycles after the path has come to rest until every axis is constant.
    pub fn length(&self) -> u32 {
        self.longest().map_or(0, Kernel::length)
    }

    /// The kernel that all axes share, without overshoot, and its taps reduced to few: weights, and mean delays in
    /// cycles. The speed at a corner is then known before any trial.
    pub(crate) fn shared(&self) -> Option<(&Kernel, &[(f64, f64)])> {
        let kernel = self.longest().filter(|_| !self.unequal && !self.overshoot)?;
        Some((kernel, self.coarse.first()?))
    }

    /// Whether the axes have different kernels.
    pub(crate) fn differ(&self) -> bool {
        self.unequal
    }

    /// The kernel that reaches back furthest.
    pub(super) fn longest(&self) -> Option<&Kernel> {
        self.get(self.longest?)
    }

    /// The kernel of an axis.
    pub(super) fn get(&self, i: usize) -> Option<&Kernel> {
        self.axes.get(i).and_then(|k| k.as_deref())
    }

    /// Speed in mm/s, constant along direction `u`, at which the set points leave the line by a tolerance in mm: each
    /// axis lags by its own delay, and only the component across the line counts. Infinite if the delays are equal.
    pub(super) fn speed_along(&self, u: &[f64], tolerance_mm: f64, cycle: CycleTime) -> f64 {
        let delay = |i: usize| self.get(i).map_or(0.0, Kernel::delay_cycles) * cycle.seconds();
        let norm: f64 = u.iter().map(|c| c * c).sum();
        let along: f64 = u.iter().enumerate().map(|(i, c)| c * c * delay(i)).sum::<f64>() / norm;
        let aside = |(i, c): (usize, &f64)| (c * (delay(i) - along)).abs();
        tolerance_mm / u.iter().enumerate().map(aside).fold(0.0, f64::max)
    }

    /// Speed in mm/s at which a bend in 1/mm alone uses up a tolerance in mm: `v^2 T^2 spread bend / 2` (derived for a
    /// parabola).
    pub(super) fn speed_on_bend(&self, bend: f64, tolerance_mm: f64, cycle: CycleTime) -> f64 {
        let t = cycle.seconds();
        (2.0 * tolerance_mm / (self.spread_cycles2 * t * t * bend.max(1e-6))).sqrt()
    }

    /// Filters rows that contain the positions of all axes and the path length, which takes the longest kernel;
    /// `row(d)` is the row `d` cycles ago.
    pub(super) fn filter<'a>(&self, row: impl Fn(u32) -> &'a [f64], out: &mut [f64]) {
        let n = out.len();
        let now = &row(0)[..n];
        out.fill(0.0);
        if let (false, Some(kernel)) = (self.unequal, self.longest()) {
            // the numbers of axes that occur have loops of known length
            match n {
                3 => add::<3>(kernel, row, out),
                4 => add::<4>(kernel, row, out),
                5 => add::<5>(kernel, row, out),
                _ => {
                    for tap in kernel.taps() {
                        let row = &row(tap.delay)[..n];
                        for i in 0..n {
                            out[i] += tap.weight * (row[i] - now[i]);
                        }
                    }
                }
            }
        } else {
            for (i, y) in out.iter_mut().enumerate() {
                let kernel = if i + 1 < n { self.get(i) } else { self.longest() };
                for tap in kernel.map_or(&[][..], Kernel::taps) {
                    *y += tap.weight * (row(tap.delay)[i] - now[i]);
                }
            }
        }
        for (y, now) in out.iter_mut().zip(now) {
            *y += now;
        }
    }
}

/// Adds the weighted differences of rows of `N` values from the newest one.
#[inline]
fn add<'a, const N: usize>(kernel: &Kernel, row: impl Fn(u32) -> &'a [f64], out: &mut [f64]) {
    let rows = |delay: u32| row(delay).first_chunk::<N>();
    let (Some(now), Some(out)) = (rows(0), out.first_chunk_mut::<N>()) else { return };
    for tap in kernel.taps() {
        let Some(row) = rows(tap.delay) else { return };
        for i in 0..N {
            out[i] += tap.weight * (row[i] - now[i]);
        }
    }
}

/// Variance of the kernel in cycles squared; negative weights count as positive ones.
fn spread_cycles2(kernel: &Kernel) -> f64 {
    let mean = kernel.delay_cycles();
    let part = |tap: &Tap| {
        let d = f64::from(tap.delay) - mean;
        tap.weight.abs() * d * d
    };
    kernel.taps().iter().map(part).sum()
}

/// Reduces a kernel of many taps to few.
fn coarse(kernel: &Arc<Kernel>) -> Vec<(f64, f64)> {
    let taps = kernel.taps();
    let parts = taps.chunks(taps.len().div_ceil(COARSE)).filter_map(|part| {
        let weight: f64 = part.iter().map(|t| t.weight).sum();
        let delay: f64 = part.iter().map(|t| t.weight * f64::from(t.delay)).sum();
        (weight.abs() > 0.0).then(|| (weight, delay / weight))
    });
    parts.collect()
}
