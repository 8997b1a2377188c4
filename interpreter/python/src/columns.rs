//! Columns of a trace in memory, and their way to numpy without a copy.

use kontur_interpreter::job::Facts;
use kontur_interpreter::record::columns::{self, Column, Content};
use kontur_interpreter::record::{Asked, CycleRecord, Rows, SpeedLimit};
use numpy::IntoPyArray as _;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyNone};

/// Bytes of columns at most, 2 GiB: a program without end must not take all memory.
const MOST_BYTES: usize = 1 << 31;

#[derive(Debug)]
enum Values {
    Number(Vec<f64>),
    Integer(Vec<i64>),
    /// With a true for each that is missing.
    Optional(Vec<i64>, Vec<bool>),
    /// Numbers of words.
    Word(Vec<u32>),
}

impl Values {
    fn of(column: &Column) -> Self {
        match column.content {
            Content::Time | Content::Path(_) | Content::Axis(..) => Self::Number(Vec::new()),
            Content::Line => Self::Integer(Vec::new()),
            Content::Block => Self::Optional(Vec::new(), Vec::new()),
            Content::File | Content::Limit => Self::Word(Vec::new()),
        }
    }
}

/// The rows since the last [`Columns::take`].
#[derive(Debug)]
pub(crate) struct Columns {
    which: Vec<Column>,
    values: Vec<Values>,
    cycle_us: u64,
    rows: usize,
}

impl Columns {
    pub(crate) fn new(columns: Vec<Column>, facts: &Facts) -> Self {
        let values = columns.iter().map(Values::of).collect();
        Self { which: columns, values, cycle_us: u64::from(facts.cycle_us), rows: 0 }
    }

    /// What they need of the axes.
    pub(crate) fn asked(&self) -> Asked {
        columns::asked(&self.which)
    }

    /// There is room for this many more rows.
    pub(crate) fn room(&self) -> usize {
        let most = MOST_BYTES / (self.which.len() * size_of::<f64>());
        most.saturating_sub(self.rows)
    }

    /// Adds every `decimate`-th of some cycles, from the first one on.
    pub(crate) fn extend(&mut self, rows: &Rows<'_>, decimate: usize) {
        let cycles = || rows.cycles().iter().step_by(decimate);
        let blocks = || cycles().map(|c| c.block.and_then(|n| i64::try_from(n).ok()));
        self.rows += cycles().len();
        let cycle_us = self.cycle_us;
        for (column, values) in self.which.iter().zip(&mut self.values) {
            match (values, column.content) {
                (Values::Number(v), Content::Time) => {
                    v.extend(cycles().map(|c| time_s(c, cycle_us)));
                }
                (Values::Number(v), content) => content.extend(v, rows, decimate),
                (Values::Integer(v), _) => v.extend(cycles().map(|c| i64::from(c.line))),
                (Values::Optional(v, missing), _) => {
                    v.extend(blocks().map(Option::unwrap_or_default));
                    missing.extend(blocks().map(|block| block.is_none()));
                }
                (Values::Word(v), Content::File) => v.extend(cycles().map(|c| c.file)),
                (Values::Word(v), _) => v.extend(cycles().map(|c| limit_number(c.path.limit))),
            }
        }
    }

    /// Hands the rows over by the names of their columns: an array; `(array, missing)`; or `(numbers, words)`.
    pub(crate) fn take<'py>(
        &mut self,
        py: Python<'py>,
        facts: &Facts,
    ) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        self.rows = 0;
        for (column, values) in self.which.iter().zip(&mut self.values) {
            match std::mem::replace(values, Values::of(column)) {
                Values::Number(v) => all.set_item(&column.name, v.into_pyarray(py))?,
                Values::Integer(v) => all.set_item(&column.name, v.into_pyarray(py))?,
                Values::Optional(v, missing) => {
                    all.set_item(&column.name, (v.into_pyarray(py), missing.into_pyarray(py)))?;
                }
                Values::Word(v) => {
                    let words = match column.content {
                        Content::File => facts.files.all(),
                        _ => SpeedLimit::ALL.map(|limit| limit.name().to_owned()).to_vec(),
                    };
                    all.set_item(&column.name, (v.into_pyarray(py), words))?;
                }
            }
        }
        Ok(all)
    }

    /// One cycle by the names of its columns.
    pub(crate) fn cycle<'py>(
        &self,
        py: Python<'py>,
        record: &CycleRecord,
        facts: &Facts,
    ) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for column in &self.which {
            let name = &column.name;
            match column.content {
                Content::Time => all.set_item(name, time_s(record, self.cycle_us))?,
                Content::Line => all.set_item(name, record.line)?,
                Content::Block => match record.block {
                    Some(n) => all.set_item(name, n)?,
                    None => all.set_item(name, PyNone::get(py))?,
                },
                Content::File => all.set_item(name, facts.files.name(record.file))?,
                Content::Limit => all.set_item(name, record.path.limit.name())?,
                Content::Path(_) | Content::Axis(..) => {
                    all.set_item(name, column.number(record).unwrap_or_default())?;
                }
            }
        }
        Ok(all)
    }

    /// Name and unit of each.
    pub(crate) fn units(&self) -> Vec<(String, String)> {
        self.which.iter().map(|c| (c.name.clone(), c.unit.clone())).collect()
    }
}

fn time_s(record: &CycleRecord, cycle_us: u64) -> f64 {
    record.k.saturating_mul(cycle_us) as f64 / 1e6
}

fn limit_number(limit: SpeedLimit) -> u32 {
    let found = SpeedLimit::ALL.iter().position(|l| *l == limit);
    found.and_then(|i| u32::try_from(i).ok()).unwrap_or_default()
}
