//! Stopping a planner from outside: the search for a plan that keeps a tolerance may take many seconds.

use super::Planner;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

impl Planner {
    /// Ends the output as soon as `stop` is set, also from another thread and in the middle of a search: the next call of
    /// [`Self::advance`] then returns [`Next::Stopped`](super::Next::Stopped). Setpoints before it do not depend on it.
    pub fn stop_with(&mut self, stop: Arc<AtomicBool>) {
        self.stop = Some(stop);
    }

    /// Whether the host has stopped it.
    pub(super) fn is_stopped(&self) -> bool {
        self.stop.as_ref().is_some_and(|stop| stop.load(Ordering::Relaxed))
    }
}
