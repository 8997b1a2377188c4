//! A run on two threads: one computes stretches of cycles, the other measures them against the contour.
//!
//! While one stretch is measured the next one is computed, so a run is at most two stretches ahead of its sink.

use super::stretch::Stretch;
use crate::record::Asked;
use crate::sim::{Measuring, Samples, Simulation};
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};

/// Work for another thread, see [`Run::to_end_on_threads`](super::Run::to_end_on_threads).
pub type Work = Box<dyn FnOnce() + Send>;

/// Number of stretches that are being measured or waiting for it.
const AHEAD: usize = 2;

/// A run on two threads, see the module.
pub(super) struct Apart {
    to_measure: SyncSender<Samples>,
    measured: Receiver<Samples>,
    /// What the sink reads.
    asked: Option<Asked>,
    /// Computed stretches whose samples are on the other thread.
    computed: VecDeque<Stretch>,
    /// Memory for reuse.
    free: Option<Stretch>,
    over: bool,
}

impl Apart {
    /// Measures the cycles on another thread from here on, if `start` can start one.
    pub(super) fn begin(
        asked: Option<Asked>,
        measuring: &mut Measuring,
        start: impl FnOnce(&'static str, Work) -> bool,
    ) -> Option<Self> {
        let (hand_over, handed_over) = sync_channel::<Measuring>(1);
        let (to_measure, samples) = sync_channel::<Samples>(AHEAD);
        let (back, measured) = sync_channel(AHEAD);
        let work = move || {
            let Ok(mut measuring) = handed_over.recv() else { return };
            for mut samples in samples {
                measuring.measure(&mut samples);
                if back.send(samples).is_err() {
                    return;
                }
            }
        };
        let started = start("deviation", Box::new(work))
            && hand_over.try_send(std::mem::take(measuring)).is_ok();
        started.then(|| Self {
            to_measure,
            measured,
            asked,
            computed: VecDeque::new(),
            free: None,
            over: false,
        })
    }

    /// Computes ahead, and replaces `current` by the next measured stretch. When there are no more it has no cycles,
    /// but possibly messages.
    pub(super) fn next_stretch(&mut self, current: &mut Stretch, simulation: &mut Simulation) {
        let mut samples = std::mem::take(&mut current.samples);
        while !self.over && self.computed.len() < AHEAD {
            let mut stretch = self.free.take().unwrap_or_default();
            stretch.samples = std::mem::take(&mut samples);
            self.over = !stretch.compute(simulation, Stretch::ROOM, self.asked);
            // a missing thread is noticed below
            let _ = self.to_measure.send(std::mem::take(&mut stretch.samples));
            self.computed.push_back(stretch);
        }
        (current.count, current.taken) = (0, 0);
        let Some(next) = self.computed.pop_front() else {
            current.messages = None;
            return;
        };
        let Ok(samples) = self.measured.recv() else {
            simulation.fail("the deviation from the contour is no longer measured");
            (self.over, current.messages) = (true, simulation.take_messages());
            self.computed.clear();
            return;
        };
        self.free = Some(std::mem::replace(current, next));
        current.samples = samples;
        current.fill();
    }
}
