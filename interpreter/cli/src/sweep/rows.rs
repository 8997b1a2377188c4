//! Results of the runs of a sweep.

use crate::table::{Cell, Table};
use kontur_interpreter::summary::Summary;
use std::path::PathBuf;

/// Results of one run.
#[derive(Clone, Debug)]
pub(super) struct Outcome {
    pub(super) summary: Summary,
    /// In the order of `--amplitude`; NaN if the run ended before.
    pub(super) amplitudes: Vec<f64>,
    /// Files that were read.
    pub(super) reads: Vec<PathBuf>,
}

/// The row of one run under its header.
pub type Row = (Vec<String>, Vec<Cell>);

/// All rows of a sweep.
pub(super) struct Rows {
    /// Program and machine.
    pub(super) title: String,
    pub(super) header: Vec<String>,
    pub(super) cells: Vec<Vec<Cell>>,
}

impl Rows {
    /// Adds a column with the same text in every row.
    pub(super) fn noting(mut self, name: &str, text: &str) -> Self {
        self.header.push(name.to_owned());
        for row in &mut self.cells {
            row.push(Cell::Word(text.to_owned()));
        }
        self
    }

    pub(super) fn table(&self) -> Table {
        let mut table = Table::new(&self.header.iter().map(String::as_str).collect::<Vec<_>>());
        for row in &self.cells {
            table.push(row.iter().cloned());
        }
        table
    }
}
