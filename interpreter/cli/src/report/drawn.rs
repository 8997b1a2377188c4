//! What pages and pictures draw.

use super::recording::Recording;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_interpreter::summary::Summary;

/// A run that is drawn.
#[derive(Debug)]
pub(super) struct Drawn {
    pub(super) recording: Recording,
    pub(super) summary: Summary,
    /// Settings that the Vibration Guard of an axis worked with.
    pub(super) guards: Vec<(usize, VibGuardSettings)>,
}
