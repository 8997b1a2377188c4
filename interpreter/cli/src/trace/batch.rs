//! Rows on their way to a file: only the values shown by the trace, which keeps the amount of data between the threads
//! small.

use kontur_interpreter::record::columns::{Column, Content};
use kontur_interpreter::record::{CycleRecord, Rows, SpeedLimit};

/// The values of a cycle that are not in a numeric column; see [`CycleRecord`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Head {
    pub(crate) k: u64,
    pub(crate) block: Option<u64>,
    pub(crate) file: u32,
    pub(crate) line: u32,
    pub(crate) limit: SpeedLimit,
}

impl Head {
    const fn of(record: &CycleRecord) -> Self {
        let CycleRecord { k, block, file, line, .. } = *record;
        Self { k, block, file, line, limit: record.path.limit }
    }
}

/// Sources of the numeric columns of a trace.
#[derive(Clone, Debug)]
pub(crate) struct Numbers(Vec<Content>);

impl Numbers {
    /// Those of the given columns.
    pub(crate) fn of(columns: &[Column]) -> Self {
        Self(columns.iter().map(|c| c.content).filter(|content| content.is_number()).collect())
    }
}

/// Rows of a trace, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Batch {
    heads: Vec<Head>,
    /// Column by column.
    numbers: Vec<Vec<f64>>,
}

impl Batch {
    /// Adds every `decimate`-th cycle, from the first one on; the sources must be the same for every row.
    pub(crate) fn extend(&mut self, Numbers(contents): &Numbers, rows: &Rows<'_>, decimate: usize) {
        let cycles = rows.cycles().iter();
        if decimate == 1 {
            self.heads.extend(cycles.map(Head::of));
        } else {
            self.heads.extend(cycles.step_by(decimate).map(Head::of));
        }
        self.numbers.resize_with(contents.len(), Vec::new);
        for (column, content) in self.numbers.iter_mut().zip(contents) {
            content.extend(column, rows, decimate);
        }
    }

    /// Number of rows.
    pub(crate) fn len(&self) -> usize {
        self.heads.len()
    }

    /// Removes all rows but keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.heads.clear();
        self.numbers.iter_mut().for_each(Vec::clear);
    }

    /// The values of each row that are not in a numeric column.
    pub(crate) fn heads(&self) -> &[Head] {
        &self.heads
    }

    /// Numeric columns.
    pub(crate) fn numbers(&self) -> &[Vec<f64>] {
        &self.numbers
    }
}

#[cfg(test)]
impl Batch {
    /// Adds the row of a record.
    pub(crate) fn push(&mut self, Numbers(contents): &Numbers, record: &CycleRecord) {
        self.heads.push(Head::of(record));
        self.numbers.resize_with(contents.len(), Vec::new);
        for (column, content) in self.numbers.iter_mut().zip(contents) {
            column.extend(content.number(record));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_interpreter::job::{Job, MachineLists, Run, Sink};
    use kontur_interpreter::record::{Asked, columns};
    use kontur_interpreter::source::MemorySources;
    use std::convert::Infallible;

    struct Gathered(Batch, Numbers, Asked, usize);

    impl Sink for Gathered {
        type Stop = Infallible;

        fn reads(&self) -> Option<Asked> {
            Some(self.2)
        }

        fn rows(&mut self, rows: &Rows<'_>) -> Result<(), Infallible> {
            let Self(batch, numbers, _, decimate) = self;
            batch.extend(numbers, &rows.from_multiple_of(*decimate as u64), *decimate);
            Ok(())
        }
    }

    /// The values of each row equal those in the record of its cycle, for axes computed in a row and cycle by cycle,
    /// for all columns and for some, for each cycle and for some.
    #[test]
    fn rows_hold_what_columns_show() {
        let text = "#VIB GUARD ON [MODE=2 FREQ=20]\nN10 G01 X5 F3000 M3 S100\nG60 Y3\nG04 0.1\nX0 Y0\nM30\n";
        let start = || -> Run {
            let (machine, _) = MachineLists::default().load().unwrap();
            let sources = MemorySources::new().with("a.nc", text);
            Job::new(machine, sources, "a.nc").start().unwrap()
        };
        let mut records: Vec<CycleRecord> = Vec::new();
        let Ok(()) = start().to_end(&mut |r: &CycleRecord| records.push(r.clone()));
        let facts = start().facts().clone();
        let groups = columns::GROUPS.join(",");
        for signals in [groups.as_str(), columns::DEFAULT_SIGNALS, "kin", "X_cmd_mm_s", "line"] {
            for decimate in [1, 7] {
                let columns = columns::select(signals, &facts).unwrap();
                let numbers = Numbers::of(&columns);
                let asked = columns::asked(&columns);
                let mut gathered = Gathered(Batch::default(), numbers.clone(), asked, decimate);
                let Ok(()) = start().to_end(&mut gathered);
                let batch = gathered.0;
                let mut wanted = Batch::default();
                records.iter().step_by(decimate).for_each(|record| wanted.push(&numbers, record));
                assert_eq!(format!("{batch:?}"), format!("{wanted:?}"), "{signals} {decimate}");
                assert_eq!(batch.len(), records.len().div_ceil(decimate));
            }
        }
    }
}
