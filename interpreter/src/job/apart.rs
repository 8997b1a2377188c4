//! A run on two threads: one computes stretches of cycles, the other measures them against the contour.
//!
//! While one stretch is measured the next one is computed, so a run is at most two stretches ahead of its sink.

use super::stretch::Stretch;
use crate::record::Asked;
use crate::sim::{Measuring, Samples, Simulation, Work, give};
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};

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
        start: impl FnOnce(Work) -> bool,
    ) -> Option<Self> {
        let (to_measure, samples) = sync_channel::<Samples>(AHEAD);
        let (back, measured) = sync_channel(AHEAD);
        let work = move |mut measuring: Measuring| {
            for mut samples in samples {
                measuring.measure(&mut samples);
                if back.send(samples).is_err() {
                    return;
                }
            }
        };
        if let Err(back) = give(std::mem::take(measuring), work, start) {
            *measuring = back;
            return None;
        }
        Some(Self {
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
