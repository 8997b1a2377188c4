//! Timers of `#TIMER`.
//!
//! Source: TF5200 programming manual, time measurement.

use crate::exec::step::TimerAct;
use std::collections::BTreeMap;

/// One timer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Timer {
    /// Program time in s at which it was started; `None` if stopped.
    since_s: Option<f64>,
    /// Time counted before that, in s.
    counted_s: f64,
    latched_ms: f64,
}

impl Timer {
    fn count_s(&self, now_s: f64) -> f64 {
        self.counted_s + self.since_s.map_or(0.0, |since_s| now_s - since_s)
    }
}

/// All timers, by number.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::exec) struct Timers {
    timers: BTreeMap<u32, Timer>,
}

impl Timers {
    /// Executes an operation on a timer at a program time in s.
    pub(in crate::exec) fn act(&mut self, id: u32, act: TimerAct, now_s: f64) {
        let timer = self.timers.entry(id).or_default();
        match act {
            TimerAct::Start => {
                timer.since_s.get_or_insert(now_s);
            }
            TimerAct::Stop => {
                timer.counted_s = timer.count_s(now_s);
                timer.since_s = None;
            }
            TimerAct::Read => timer.latched_ms = timer.count_s(now_s) * 1e3,
            TimerAct::Clear => {
                (timer.counted_s, timer.since_s) = (0.0, None);
            }
        }
    }

    /// `V.G.TIMER[id]`: the count at the last READ in ms; 0 before the first one.
    pub(in crate::exec) fn latched_ms(&self, id: u32) -> f64 {
        self.timers.get(&id).map_or(0.0, |timer| timer.latched_ms)
    }
}
