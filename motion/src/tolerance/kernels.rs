//! The filter kernels of the axes, as the tolerance looks at them.

use kontur_filters::kernel::Kernel;
use std::sync::Arc;

/// Taps of a kernel in the search for an even speed.
const COARSE: usize = 24;

/// The filter kernels of the axes of a channel.
#[derive(Clone, Debug, Default)]
pub struct Kernels {
    pub(super) axes: Vec<Option<Arc<Kernel>>>,
    /// A kernel with negative weights overshoots where the path starts and stops, straight blocks included.
    pub(super) overshoot: bool,
    /// Not all axes have the same kernel.
    pub(super) unequal: bool,
    /// Delay of the longest kernel in cycles.
    pub(super) delay: f64,
    /// Every axis' kernel in few taps: weights, and mean delays in cycles.
    pub(super) coarse: Vec<Vec<(f64, f64)>>,
}

impl Kernels {
    /// One kernel per axis, `None` without one.
    pub fn new(axes: Vec<Option<Arc<Kernel>>>) -> Self {
        let mut taps = axes.iter().flatten().flat_map(|k| k.taps());
        let overshoot = taps.any(|tap| tap.weight < 0.0);
        let unequal = axes.windows(2).any(|pair| pair[0] != pair[1]);
        let delay = longest(&axes).map_or(0.0, Kernel::delay_cycles);
        let coarse = axes.iter().map(|k| k.as_ref().map_or_else(|| vec![(1.0, 0.0)], coarse));
        let coarse = coarse.collect();
        Self { axes, overshoot, unequal, delay, coarse }
    }

    /// True if any axis has a kernel.
    pub fn any(&self) -> bool {
        self.axes.iter().any(Option::is_some)
    }

    /// Cycles until every axis is constant after the path has come to rest.
    pub fn length(&self) -> u32 {
        self.axes.iter().flatten().map(|k| k.length()).max().unwrap_or(0)
    }

    /// True if not all axes have the same kernel.
    pub(crate) fn differ(&self) -> bool {
        self.unequal
    }

    /// The kernel that reaches back furthest.
    pub(super) fn longest(&self) -> Option<&Kernel> {
        longest(&self.axes)
    }

    /// The kernel of an axis.
    pub(super) fn get(&self, i: usize) -> Option<&Kernel> {
        self.axes.get(i).and_then(|k| k.as_deref())
    }
}

fn longest(axes: &[Option<Arc<Kernel>>]) -> Option<&Kernel> {
    axes.iter().flatten().max_by_key(|k| k.length()).map(|k| &**k)
}

/// A kernel of many taps in few.
fn coarse(kernel: &Arc<Kernel>) -> Vec<(f64, f64)> {
    let taps = kernel.taps();
    let parts = taps.chunks(taps.len().div_ceil(COARSE)).filter_map(|part| {
        let weight: f64 = part.iter().map(|t| t.weight).sum();
        let delay: f64 = part.iter().map(|t| t.weight * f64::from(t.delay)).sum();
        (weight.abs() > 0.0).then(|| (weight, delay / weight))
    });
    parts.collect()
}
