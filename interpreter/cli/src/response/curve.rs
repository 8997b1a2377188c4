//! One curve of a response: a shaping chain with a name.

use kontur_filters::shaping::Shaping;
use kontur_filters::vib_guard::VibGuardSettings;

/// A filter, a shaper or the chain of an axis.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    /// Name in table and picture.
    pub(super) label: String,
    /// The chain, at rest at 0.
    pub(super) shaping: Shaping,
    /// Settings of the Vibration Guard, if the kernel is one.
    pub(super) guard: Option<VibGuardSettings>,
    /// Whether the chain contains standard filters in addition to the kernel.
    pub(super) has_filters: bool,
    /// Order of a mean or FIR filter; with many of them the contour error is drawn over it.
    pub(super) order: Option<f64>,
}
