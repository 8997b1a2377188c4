//! Detects whether one trace is merely later than the other.
//!
//! Up to the first difference of a number both traces are the same. If from there on every row of one equals the row of
//! the other a fixed number of rows earlier, the second one merely does the same later: it rested for longer, at the
//! start or between two motions. Only numbers are decisive, because a line inserted into a program shifts the numbers
//! of all later lines.

use csv::ByteRecord;
use std::collections::VecDeque;

/// Delays up to this many rows are recognised: 1 s at the default cycle.
pub(super) const MOST_ROWS: usize = 1000;

/// Rows with motion that have to agree before a motion counts as the same one, delayed.
const LEAST_CHANGES: usize = 3;

/// A delay after which all numbers of both traces are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Delay {
    /// Rows by which B is later; negative: A is.
    pub(super) rows: i64,
    /// Whether texts are the same as well: line, block, file, speed reason.
    pub(super) texts: bool,
}

/// A delay that is still possible.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    delay: Delay,
    compared: usize,
    /// Number of these rows that differed from the previous one: the traces move.
    changes: usize,
}

/// A row of a trace.
#[derive(Debug)]
struct Row {
    /// `None` where the trace has ended.
    cells: Option<ByteRecord>,
    /// Whether it equals the previous row.
    repeats: bool,
}

/// The candidates, from the first difference on.
#[derive(Debug)]
pub(super) struct Delays {
    candidates: Vec<Candidate>,
    /// The rows before, newest first.
    before: [VecDeque<Row>; 2],
}

impl Delays {
    pub(super) fn new() -> Self {
        let sizes = (1..).take(MOST_ROWS).flat_map(|n: i64| [n, -n]);
        let candidate = |rows| {
            let delay = Delay { rows, texts: true };
            Candidate { delay, compared: 0, changes: 0 }
        };
        Self {
            candidates: sizes.map(candidate).collect(),
            before: [VecDeque::new(), VecDeque::new()],
        }
    }

    /// Takes the cells of the next row of both traces in the same order and without the time; `None` for a trace that
    /// has ended. `equal` compares a row of A with one of B: whether the numbers are equal and, if so, the texts.
    pub(super) fn take(
        &mut self,
        a: Option<ByteRecord>,
        b: Option<ByteRecord>,
        equal: impl Fn(&ByteRecord, &ByteRecord) -> Option<bool>,
    ) {
        if self.candidates.is_empty() {
            return;
        }
        let [before_a, before_b] = &self.before;
        let row = |cells: Option<ByteRecord>, before: &VecDeque<Row>| {
            let repeats = before.front().is_some_and(|b| b.cells == cells);
            Row { cells, repeats }
        };
        let (a, b) = (row(a, before_a), row(b, before_b));
        self.candidates.retain_mut(|candidate| {
            let back =
                usize::try_from(candidate.delay.rows.unsigned_abs()).unwrap_or(usize::MAX) - 1;
            let (earlier, later) = if candidate.delay.rows > 0 {
                (before_a.get(back), &b)
            } else {
                (before_b.get(back), &a)
            };
            let (Some(earlier), Some(cells)) = (earlier, &later.cells) else { return true };
            let first = candidate.compared == 0;
            candidate.changes += usize::from(!first && !later.repeats);
            candidate.compared += 1;
            // where both are constant the result of the previous rows holds, which makes a long standstill cheap
            let at_rest = !first && earlier.repeats && later.repeats;
            if at_rest {
                return true;
            }
            let Some(texts) = earlier.cells.as_ref().and_then(|earlier| equal(earlier, cells))
            else {
                return false;
            };
            candidate.delay.texts &= texts;
            true
        });
        for (before, row) in self.before.iter_mut().zip([a, b]) {
            before.truncate(MOST_ROWS - 1);
            before.push_front(row);
        }
    }

    /// The delay that explains the remaining rows, if there is one: the smallest one during which both traces move.
    pub(super) fn found(&self) -> Option<Delay> {
        self.candidates.iter().find(|c| c.changes >= LEAST_CHANGES).map(|c| c.delay)
    }
}

#[cfg(test)]
mod tests {
    use super::{Delays, LEAST_CHANGES};
    use csv::ByteRecord;
    use kontur_kit::Random;

    /// For the rows from the first difference on, every delay tried according to its definition.
    fn brute_force(a: &[u8], b: &[u8]) -> Option<i64> {
        let explains = |earlier: &[u8], later: &[u8], n: usize| {
            let pairs = || (n..later.len()).map(|k| (earlier.get(k - n), later[k]));
            let changes = (n + 1..later.len()).filter(|k| later[*k] != later[k - 1]).count();
            pairs().all(|(x, y)| x == Some(&y)) && changes >= LEAST_CHANGES
        };
        (1..a.len().max(b.len())).zip(1_i64..).find_map(|(n, rows)| {
            let behind = explains(a, b, n).then_some(rows);
            behind.or_else(|| explains(b, a, n).then_some(-rows))
        })
    }

    /// Steps between a few values with pauses; one trace has a different pause or step, or ends elsewhere.
    #[test]
    fn as_every_delay_tried_out() {
        let mut random = Random::new(7);
        let mut found = 0;
        for _ in 0..3000 {
            let mut a: Vec<u8> = Vec::new();
            for _ in 0..=random.below(8) {
                let (value, pause) = (random.below(4) as u8, 1 + random.below(6));
                a.extend((0..pause).map(|_| value));
            }
            let mut b = a.clone();
            let place = random.below(a.len());
            match random.below(4) {
                0 => b[place] = 9,
                1 => b.truncate(place),
                _ => (0..=random.below(9)).for_each(|_| b.insert(place, a[place])),
            }
            if random.below(2) == 0 {
                std::mem::swap(&mut a, &mut b);
            }
            let same = a.iter().zip(&b).take_while(|(x, y)| x == y).count();
            let (a, b) = (&a[same..], &b[same..]);
            let mut delays = Delays::new();
            let record = |x: &u8| ByteRecord::from(vec![vec![*x]]);
            for k in 0..a.len().max(b.len()) {
                delays.take(a.get(k).map(record), b.get(k).map(record), |x, y| {
                    (x == y).then_some(true)
                });
            }
            let rows = delays.found().map(|d| d.rows);
            assert_eq!(rows, brute_force(a, b), "{a:?} {b:?}");
            found += usize::from(delays.found().is_some());
        }
        assert!(found > 100, "{found} delays");
    }
}
