//! Input of pages and pictures.

use super::recording::Recording;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_interpreter::summary::Summary;

/// A run to be drawn.
#[derive(Debug)]
pub(super) struct Drawn {
    pub(super) recording: Recording,
    pub(super) summary: Summary,
    /// Settings used by the Vibration Guard of an axis.
    pub(super) guards: Vec<(usize, VibGuardSettings)>,
}
