//! A run on two threads: cycles are computed here in stretches, and measured against the contour on the other one.
//!
//! While one stretch is measured the next one is computed, so a run is ahead of what its sink has seen by two at most.

use crate::record::CycleRecord;
use crate::sim::{Measuring, Messages, Samples, Simulation};
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};

/// Work for another thread, see [`Run::to_end_on_threads`](super::Run::to_end_on_threads).
pub type Work = Box<dyn FnOnce() + Send>;

/// Cycles of a stretch, at most.
const TOGETHER: usize = 256;

/// Stretches that are measured or wait for it.
const AHEAD: usize = 2;

/// See the module.
pub(super) struct Apart {
    to_measure: SyncSender<Samples>,
    measured: Receiver<Samples>,
    /// Computed stretches, the one first that is shown.
    stretches: VecDeque<Stretch>,
    /// Memory that is used again.
    free: Option<Stretch>,
    samples: Samples,
    /// Cycles of the first stretch that were taken.
    taken: usize,
    over: bool,
    /// Raised after the last cycle.
    closing: Option<Messages>,
}

/// Consecutive cycles.
#[derive(Default)]
struct Stretch {
    records: Vec<CycleRecord>,
    count: usize,
    /// Raised in the last one of them.
    messages: Option<Messages>,
}

impl Stretch {
    /// Computes cycles until one raises a message; false if there are no more.
    fn compute(&mut self, simulation: &mut Simulation, samples: &mut Samples) -> bool {
        self.count = 0;
        samples.clear();
        while self.count < TOGETHER && self.messages.is_none() {
            if !simulation.next_cycle() {
                return false;
            }
            self.messages = simulation.take_messages();
            simulation.sample(samples);
            match self.records.get_mut(self.count) {
                Some(record) => simulation.give_record(record),
                None => self.records.push(simulation.record().clone()),
            }
            self.count += 1;
        }
        true
    }
}

impl Apart {
    /// Has cycles measured on another thread from here on, if `start` can start one; `record`: the state now.
    pub(super) fn begin(
        record: &CycleRecord,
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
        let first = Stretch { records: vec![record.clone()], count: 1, ..Stretch::default() };
        started.then(|| Self {
            to_measure,
            measured,
            stretches: [first].into(),
            free: None,
            samples: Samples::default(),
            taken: 1,
            over: false,
            closing: None,
        })
    }

    /// The cycle taken last; before the first one the state at the beginning.
    pub(super) fn record(&self) -> &CycleRecord {
        &self.stretches[0].records[self.taken - 1]
    }

    /// Advances to the next cycle, with the messages up to it; false if there are no more.
    pub(super) fn next_cycle(
        &mut self,
        simulation: &mut Simulation,
        raised: &mut Messages,
    ) -> bool {
        if self.taken == self.stretches[0].count && !self.next_stretch(simulation, raised) {
            return false;
        }
        let stretch = &mut self.stretches[0];
        self.samples.fill(self.taken, &mut stretch.records[self.taken]);
        if self.taken + 1 == stretch.count {
            raised.absorb(stretch.messages.take());
        }
        simulation.exceeded(&self.samples, self.taken).into_iter().for_each(|d| raised.push(d));
        self.taken += 1;
        true
    }

    /// Computes ahead, and takes the next stretch that is measured.
    fn next_stretch(&mut self, simulation: &mut Simulation, raised: &mut Messages) -> bool {
        while !self.over && self.stretches.len() <= AHEAD {
            let mut stretch = self.free.take().unwrap_or_default();
            let mut samples = std::mem::take(&mut self.samples);
            if !stretch.compute(simulation, &mut samples) {
                (self.over, self.closing) = (true, simulation.take_messages());
            }
            if stretch.count > 0 {
                self.stretches.push_back(stretch);
                // a thread that is gone is noticed below
                let _ = self.to_measure.send(samples);
            }
        }
        if self.stretches.len() == 1 {
            raised.absorb(self.closing.take());
            return false;
        }
        let Ok(samples) = self.measured.recv() else {
            simulation.fail("the deviation from the contour is no longer measured");
            raised.absorb(simulation.take_messages());
            return false;
        };
        (self.samples, self.taken) = (samples, 0);
        self.free = self.stretches.pop_front();
        true
    }
}
