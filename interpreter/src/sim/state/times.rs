//! The time of a motion that is programmed with G93.

use crate::exec::SourceRef;

/// The motion under way, if its time is programmed.
#[derive(Clone, Copy, Debug)]
pub(in crate::sim) struct Timed {
    pub(in crate::sim) time_s: f64,
    /// Cycle after which it began.
    pub(in crate::sim) from_k: u64,
    pub(in crate::sim) source: SourceRef,
    /// Whether an override or a feedhold acts on it.
    pub(in crate::sim) changed: bool,
}

/// Programmed times and what became of them.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::sim) struct Times {
    pub(in crate::sim) current: Option<Timed>,
    pub(in crate::sim) told: bool,
}
