//! Rows on their way to a file: of each record only what the trace shows, so that little is handed from thread to thread.

use kontur_interpreter::record::columns::{Column, Content};
use kontur_interpreter::record::{CycleRecord, SpeedLimit};

/// What of a cycle is in no numeric column; see [`CycleRecord`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Head {
    pub(crate) k: u64,
    pub(crate) block: Option<u64>,
    pub(crate) file: u32,
    pub(crate) line: u32,
    pub(crate) limit: SpeedLimit,
}

/// Where the numeric columns of a trace find their values, and nothing else of them: this is read for every row.
#[derive(Clone, Debug)]
pub(crate) struct Numbers(Vec<Content>);

impl Numbers {
    /// Of these columns.
    pub(crate) fn of(columns: &[Column]) -> Self {
        Self(columns.iter().map(|c| c.content).filter(|content| content.is_number()).collect())
    }
}

/// Rows of a trace, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Batch {
    heads: Vec<Head>,
    /// Row by row.
    numbers: Vec<f64>,
}

impl Batch {
    /// Adds the row of a record; the numbers are the same for every row.
    pub(crate) fn push(&mut self, Numbers(contents): &Numbers, record: &CycleRecord) {
        let CycleRecord { k, block, file, line, .. } = *record;
        self.heads.push(Head { k, block, file, line, limit: record.path.limit });
        // room for all of them at once: this is done for every value of a trace
        let end = self.numbers.len();
        self.numbers.resize(end + contents.len(), 0.0);
        for (value, content) in self.numbers[end..].iter_mut().zip(contents) {
            *value = content.number(record).unwrap_or_default();
        }
    }

    /// Number of rows.
    pub(crate) fn len(&self) -> usize {
        self.heads.len()
    }

    /// No rows, keeping the memory.
    pub(crate) fn clear(&mut self) {
        self.heads.clear();
        self.numbers.clear();
    }

    /// Every row: its head and the values of its numeric columns.
    pub(crate) fn rows(&self) -> impl Iterator<Item = (&Head, &[f64])> {
        self.stretches(1).map(|(heads, numbers)| (&heads[0], numbers))
    }

    /// So many rows at a time, and what is left at the end: heads, and values row by row.
    pub(crate) fn stretches(&self, rows: usize) -> impl Iterator<Item = (&[Head], &[f64])> {
        let width = self.numbers.len().checked_div(self.len()).unwrap_or_default();
        self.heads.chunks(rows).enumerate().map(move |(i, heads)| {
            let first = i * rows * width;
            (heads, &self.numbers[first..first + heads.len() * width])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_interpreter::job::{AxisFacts, Facts};
    use kontur_interpreter::record::columns;
    use kontur_interpreter::record::{AxisRecord, PathRecord};

    /// The values of each row are those that the columns find in its record, also where the last stretch is short and where no
    /// column is a number.
    #[test]
    fn rows_hold_what_columns_show() {
        let axes = vec![AxisFacts { name: "X".to_owned(), ..AxisFacts::default() }];
        let facts = Facts { cycle_us: 1000, axes, ..Facts::default() };
        let record = |k: u64| CycleRecord {
            k,
            block: k.is_multiple_of(2).then_some(10 * k),
            path: PathRecord { s_mm: 0.5 * k as f64, ..PathRecord::default() },
            axes: vec![AxisRecord { set: -(k as f64), ..AxisRecord::default() }],
            ..CycleRecord::default()
        };
        for (signals, width) in [("s_mm,v_limit,set", 2), ("line", 0)] {
            let columns = columns::select(signals, &facts).unwrap();
            let mut batch = Batch::default();
            let shown = Numbers::of(&columns);
            (0..10).for_each(|k| batch.push(&shown, &record(k)));
            let mut seen = Vec::new();
            for (heads, numbers) in batch.stretches(4) {
                assert_eq!(numbers.len(), width * heads.len());
                seen.extend(heads.iter().map(|head| (head.k, head.block)));
            }
            assert!(seen.into_iter().eq((0..10).map(|k| (k, record(k).block))));
            for ((head, numbers), k) in batch.rows().zip(0..) {
                assert_eq!(head.k, k);
                assert_eq!(numbers, &[0.5 * k as f64, -(k as f64)][..width]);
            }
            batch.clear();
            assert_eq!((batch.len(), batch.rows().count()), (0, 0));
        }
    }
}
