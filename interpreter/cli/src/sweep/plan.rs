//! A sweep as numbered runs, for callers that distribute them themselves.

use super::idle::idle;
use super::one::{Failure, row};
use super::rows::Row;
use crate::args::SweepArgs;
use crate::combinations::combinations;
use crate::error::Error;
use crate::request::OpenError;
use crate::table::Cell;

/// A sweep whose runs the caller distributes: over threads, processes or machines.
#[derive(Clone, Debug)]
pub struct Plan {
    args: SweepArgs,
    combinations: Vec<Vec<usize>>,
}

impl Plan {
    /// All combinations of the arguments; `output` and `shard` are not used.
    ///
    /// # Errors
    /// [`Error::Usage`] for too many of them, or a parameter given twice.
    pub fn new(args: SweepArgs) -> Result<Self, Error> {
        let combinations = combinations(&args.vary)?;
        Ok(Self { args, combinations })
    }

    /// Number of runs.
    pub const fn len(&self) -> usize {
        self.combinations.len()
    }

    /// Whether there are no runs.
    pub const fn is_empty(&self) -> bool {
        self.combinations.is_empty()
    }

    /// Names of the varied parameters: the first columns of every row.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.args.vary.iter().map(|v| v.key.as_str())
    }

    /// Performs one of the runs, by its number in the order of the table.
    ///
    /// # Errors
    /// [`OpenError`] if it cannot be run; an aborted run has a row.
    pub fn row(&self, number: usize) -> Result<Row, OpenError> {
        let usage = |text: &str| OpenError::Usage(text.to_owned());
        let combination = self.combinations.get(number).ok_or_else(|| usage("no such run"))?;
        let done = row(&self.args, combination).map_err(|failure| match failure {
            Failure::Open(e) => e,
            Failure::Interrupted => usage("interrupted"),
        });
        Ok(done?.0)
    }

    /// Keys of the parameters without influence on any row; `rows` are all of them, in order.
    pub fn without_effect(&self, rows: &[Vec<Cell>]) -> Vec<&str> {
        if rows.len() == self.len() {
            idle(&self.args.vary, &self.combinations, rows)
        } else {
            Vec::new()
        }
    }
}
