//! Sequences of plain straight motions, which make up almost all of a long program.
//!
//! Everything that the general path looks up for each block is unchanged after a plain motion, because macros, names,
//! loops and levels change only in other blocks. The next line is therefore read directly from the text. If it is not
//! another plain motion, nothing is changed, and it takes the general path.

use super::{Executor, State};
use crate::exec::motion::state::Straight;
use crate::exec::motion::straight::StraightWords;
use crate::source::Position;

/// Position of the plain motion that comes next.
struct Ahead {
    number: Option<u64>,
    file: usize,
    at: Position,
    next: Position,
}

impl Executor {
    /// Executes the next block if it is another plain motion after one that left `shared`; otherwise returns false and
    /// changes nothing.
    pub(super) fn straight_on(&mut self, shared: Box<Straight>) -> bool {
        let mut words = StraightWords::default();
        let Some(ahead) = self.straight_ahead(&mut words) else { return false };
        if self.begin_straight(&ahead) {
            self.decoder.straight_motion(&words, Some(shared), None);
            self.end_straight();
        }
        true
    }

    /// During a check: executes the next block if it is another plain motion, where possible without making a step of
    /// it, and returns the time in s of the motion before it. Otherwise returns `None` and changes nothing.
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
        let inside = at.offset < level.end && !level.is_declaring();
        if !inside || level.is_repeated(at) || level.index.at(at).is_some() {
            return None;
        }
        let decoder = &self.decoder;
        let take = |word| words.add(decoder, &word);
        let (frame, next) = self.files.plain_line(file, at, take)?;
        if frame.skip.is_some() || (frame.open_remark.is_some() && self.found.has_room()) {
            return None;
        }
        words.span = frame.span;
        let number = frame.number;
        decoder.modal.moves_straight(words, &decoder.machine.channel).then_some(Ahead {
            number,
            file,
            at,
            next,
        })
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

    /// Most motions cause no messages, and there were no errors before them.
    fn end_straight(&mut self) {
        if self.decoder.report.has_faults() || self.found.errors() > 0 {
            self.settle(false);
        }
    }
}
