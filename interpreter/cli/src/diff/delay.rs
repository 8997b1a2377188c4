//! Is one trace only later than the other?
//!
//! Up to the first difference both traces are the same. If from there on every row of one equals the row of the other that
//! lies a fixed number of rows back, one only does later what the other does: it stood still for longer, at the start or
//! between two motions.

use csv::ByteRecord;
use std::collections::VecDeque;

/// Delays up to this many rows are recognised: 1 s at the default cycle.
pub(super) const MOST_ROWS: usize = 1000;

/// Rows of a motion that have to agree before it is taken for the same one, later.
const LEAST_CHANGES: usize = 3;

/// A delay that may still explain everything.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    /// Rows by which B is later; negative: A is.
    rows: i64,
    compared: usize,
    /// Rows among them that were not the same as the one before: the traces move.
    changes: usize,
}

/// The candidates, from the first difference on.
#[derive(Debug)]
pub(super) struct Delays {
    candidates: Vec<Candidate>,
    /// The rows before, the last one in front; nothing where a trace has ended.
    before: [VecDeque<Option<ByteRecord>>; 2],
}

impl Delays {
    pub(super) fn new() -> Self {
        let sizes = (1..).take(MOST_ROWS).flat_map(|n: i64| [n, -n]);
        let candidate = |rows| Candidate { rows, compared: 0, changes: 0 };
        Self {
            candidates: sizes.map(candidate).collect(),
            before: [VecDeque::new(), VecDeque::new()],
        }
    }

    /// Takes the cells of the next row of both traces in one order and without the time; nothing of a trace that has ended.
    /// `equal` compares a row of A with one of B.
    pub(super) fn take(
        &mut self,
        a: Option<ByteRecord>,
        b: Option<ByteRecord>,
        equal: impl Fn(&ByteRecord, &ByteRecord) -> bool,
    ) {
        if self.candidates.is_empty() {
            return;
        }
        let [before_a, before_b] = &self.before;
        self.candidates.retain_mut(|candidate| {
            let back = usize::try_from(candidate.rows.unsigned_abs()).unwrap_or(usize::MAX) - 1;
            let (earlier, later, before) = if candidate.rows > 0 {
                (before_a.get(back), &b, before_b.front())
            } else {
                (before_b.get(back), &a, before_a.front())
            };
            let (Some(earlier), Some(later)) = (earlier, later) else { return true };
            let goes_on = earlier.as_ref().is_some_and(|earlier| equal(earlier, later));
            let before = before.and_then(Option::as_ref);
            let changes = candidate.compared > 0 && before.is_some_and(|b| b != later);
            candidate.changes += usize::from(changes);
            candidate.compared += 1;
            goes_on
        });
        for (before, row) in self.before.iter_mut().zip([a, b]) {
            before.truncate(MOST_ROWS - 1);
            before.push_front(row);
        }
    }

    /// Rows by which B is later (negative: earlier), if a delay explains the rest: the smallest one over which both traces move.
    pub(super) fn found(&self) -> Option<i64> {
        self.candidates.iter().find(|c| c.changes >= LEAST_CHANGES).map(|c| c.rows)
    }
}
