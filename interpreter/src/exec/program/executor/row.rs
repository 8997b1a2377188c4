//! Plain straight motions in a row: almost all of a long program.
//!
//! What the general route looks up for each block cannot have changed after a plain motion: macros, names, loops
//! and levels change in other blocks only. So the next line is taken as it is in the text; if it is anything but one
//! more plain motion, nothing has happened and it takes the general route.

use super::{Executor, State};
use crate::exec::motion::state::Straight;
use crate::exec::motion::straight::StraightWords;
use crate::source::Position;

/// Where a plain motion is that comes next.
struct Ahead {
    number: Option<u64>,
    file: usize,
    at: Position,
    next: Position,
}

impl Executor {
    /// Executes the next block if it is one more plain motion after one that has left `shared`; false, and nothing done,
    /// if not.
    pub(super) fn straight_on(&mut self, shared: Box<Straight>) -> bool {
        let mut words = StraightWords::default();
        let Some(ahead) = self.straight_ahead(&mut words) else { return false };
        if self.begin_straight(&ahead) {
            self.decoder.straight_motion(&words, Some(shared), None);
            self.end_straight();
        }
        true
    }

    /// While the program is only looked at: executes the next block if it is one more plain motion, without making a step
    /// of it where that is possible, and returns the time in s of the motion before it; `None`, and nothing done, if it is
    /// anything else.
    pub(in crate::exec::program) fn straight_by(&mut self) -> Option<f64> {
        let in_row = self.decoder.straight.is_some() && self.state == State::Running;
        if !in_row || !self.decoder.contour.lets_by() {
            return None;
        }
        let mut words = StraightWords::default();
        let ahead = self.straight_ahead(&mut words)?;
        let shared = self.decoder.straight.take();
        let mut passed = None;
        if self.begin_straight(&ahead) {
            self.decoder.straight_motion(&words, shared, Some(&mut passed));
            self.end_straight();
        }
        if passed.is_some() {
            self.budget.moved();
        }
        Some(passed.unwrap_or(0.0))
    }

    /// Reads the next line if it is a plain motion.
    fn straight_ahead(&mut self, words: &mut StraightWords) -> Option<Ahead> {
        let [level] = &self.levels[..] else { return None };
        let (file, at) = (level.file, level.at);
        let inside = at.offset < level.end && !level.declarations;
        if !inside || level.index.at(at).is_some() || level.runs_again(at) {
            return None;
        }
        let decoder = &self.decoder;
        let take = |word| decoder.straight_word(&word, words);
        let (frame, next) = self.files.plain_line(file, at, take)?;
        words.span = frame.span;
        let number = frame.number;
        decoder.moves_straight(words).then_some(Ahead { number, file, at, next })
    }

    /// Counts the block and makes it the current one; false if the program ends before it.
    fn begin_straight(&mut self, &Ahead { number, file, at, next }: &Ahead) -> bool {
        let counted = self.count_block();
        if counted {
            self.enter(file, at, next);
            self.source_of(file, at, number);
        }
        counted
    }

    /// Most motions have nothing to say, and nothing was wrong before them.
    fn end_straight(&mut self) {
        if self.decoder.report.has_faults() || self.found.errors() > 0 {
            self.settle(false);
        }
    }
}
