//! The machine as the running program sees it: actual positions, time, measured values, timers.
//!
//! Everything else of a program follows from its text, so its blocks can be decoded on another thread before the machine
//! reaches them. Whatever reads the machine goes through [`Live`], which then asks for it and waits until the machine
//! has come to the step that is being decoded: the answer is the one it would have had on one thread.

use super::step::{Feedback, Line, Probed, Told};
use super::step::{TimerAct, TimerCall};
use super::values::timers::Timers;
use std::cell::{Ref, RefCell};

/// State of the machine, as last told.
#[derive(Debug, Default)]
pub(super) struct Live(RefCell<State>);

#[derive(Debug, Default)]
struct State {
    feedback: Feedback,
    timers: Timers,
    /// The connection to the machine, if that runs on another thread.
    line: Option<Line>,
}

impl State {
    fn tell(&mut self, told: Told) {
        for TimerCall { id, act, time_s } in told.timers {
            self.timers.act(id, act, time_s);
        }
        if let Some(feedback) = told.feedback {
            self.feedback = feedback;
        }
    }

    /// The state while the current step is decoded.
    fn now(&mut self) -> &mut Self {
        if let Some(told) = self.line.as_mut().and_then(Line::ask) {
            self.tell(told);
        }
        self
    }
}

impl Live {
    /// Takes news of the machine, which runs on this thread.
    pub(super) fn tell(&mut self, told: Told) {
        self.0.get_mut().tell(told);
    }

    /// The machine runs on another thread from here on.
    pub(super) fn connect(&mut self, line: Line) {
        self.0.get_mut().line = Some(line);
    }

    /// The connection to another thread.
    pub(super) fn line(&mut self) -> Option<&mut Line> {
        self.0.get_mut().line.as_mut()
    }

    /// Positions and time.
    pub(super) fn feedback(&self) -> Ref<'_, Feedback> {
        self.0.borrow_mut().now();
        Ref::map(self.0.borrow(), |state| &state.feedback)
    }

    /// The result of a measuring run, once.
    pub(super) fn take_measured(&mut self) -> Option<Box<Probed>> {
        self.0.get_mut().now().feedback.measured.take()
    }

    /// Executes an operation on a timer now.
    pub(super) fn timer(&mut self, id: u32, act: TimerAct) {
        let state = self.0.get_mut().now();
        state.timers.act(id, act, state.feedback.time_s);
    }

    /// `V.G.TIMER[id]`: the count at the last READ in ms; 0 before the first one.
    pub(super) fn latched_ms(&self, id: u32) -> f64 {
        self.0.borrow_mut().now().timers.latched_ms(id)
    }
}
