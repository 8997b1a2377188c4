//! The blocks that a check has executed.

use crate::source::Position;
use std::collections::BTreeMap;

/// A sequence of blocks without gaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Run {
    file: usize,
    start: u64,
    end: Position,
}

/// The blocks that a check has executed. Text without jumps is a single run, so the memory is negligible.
#[derive(Debug, Default)]
pub(in crate::exec) struct Reached {
    /// Ends of runs by file and start.
    runs: BTreeMap<(usize, u64), Position>,
    current: Option<Run>,
}

impl Reached {
    /// Adds an executed block.
    pub(in crate::exec) fn add(&mut self, file: usize, from: Position, to: Position) {
        if let Some(run) = &mut self.current
            && run.file == file
            && run.end.offset == from.offset
        {
            run.end = to;
            return;
        }
        self.store();
        // a loop returns into an existing run
        let before = self.runs.range(..=(file, from.offset)).next_back();
        let known = before.filter(|((f, _), end)| *f == file && end.offset >= from.offset);
        self.current = Some(match known {
            Some(((_, start), end)) => Run { file, start: *start, end: to.max(*end) },
            None => Run { file, start: from.offset, end: to },
        });
    }

    pub(super) fn store(&mut self) {
        if let Some(Run { file, start, end }) = self.current.take() {
            let known = self.runs.entry((file, start)).or_insert(end);
            *known = end.max(*known);
        }
    }

    /// Parts between `from` and `to` that were not executed.
    pub(super) fn gaps(&self, file: usize, from: Position, to: u64) -> Vec<(Position, u64)> {
        let mut gaps = Vec::new();
        if to <= from.offset {
            return gaps;
        }
        let mut at = from;
        let before = self.runs.range(..=(file, from.offset)).next_back();
        let here = before.into_iter().chain(self.runs.range((file, from.offset + 1)..(file, to)));
        for ((f, start), end) in here {
            if *f != file {
                continue;
            }
            if *start > at.offset {
                gaps.push((at, *start));
            }
            at = at.max(*end);
        }
        if at.offset < to {
            gaps.push((at, to));
        }
        gaps
    }

    /// End of the last executed block between two positions.
    pub(super) fn last(&self, file: usize, from: u64, to: u64) -> Option<u64> {
        self.runs.range((file, from)..(file, to)).map(|(_, end)| end.offset.min(to)).max()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(offset: u64) -> Position {
        Position { offset, line: 1 }
    }

    #[test]
    fn loops_and_jumps_leave_the_gaps_between_them() {
        let mut reached = Reached::default();
        for (from, to) in [(0, 10), (10, 20), (50, 60), (60, 70), (10, 20), (20, 30), (50, 60)] {
            reached.add(0, at(from), at(to));
        }
        reached.add(1, at(0), at(5));
        reached.store();
        assert_eq!(reached.gaps(0, at(0), 100), [(at(30), 50), (at(70), 100)]);
        assert_eq!(reached.gaps(0, at(0), 70), [(at(30), 50)]);
        assert_eq!(reached.gaps(1, at(0), 5), []);
        // a file that was opened but not executed, because its call was one error too many
        assert_eq!(reached.gaps(2, at(0), 0), []);
        assert_eq!(reached.last(2, 0, 100), None);
        assert_eq!(reached.last(0, 0, 100), Some(70));
        assert_eq!(reached.runs.len(), 3);
    }
}
